// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faults for O6 (shape in plan) and O7 (closed meshes in space).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "properties/faults/measured_faults.h"
#include "properties/faults/sound_meshes.h"

namespace plumbline::faults {
namespace {

using oracle::FindingCode;

/// A vertex put into a triangle, so near its longest edge that one of the three is a sliver in plan.
std::optional<Tally> sliver(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  Mesh mesh = random_grid(5 + static_cast<int>(random.below(6)), random).mesh;
  const oracle::ShapeReport before = judges.shape(mesh);
  const std::size_t t = random.below(mesh.triangles.size());
  const auto [a, b, c] = mesh.triangles[t];
  const Vec3 pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
  // At a hundredth of the height above the middle of edge a–b: quality about 4 √3 · h/100 / (1.5 · length).
  mesh.positions.push_back((pa + pb) * 0.495 + pc * 0.01);
  const auto v = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  mesh.triangles[t] = {a, b, v};
  mesh.triangles.push_back({b, c, v});
  mesh.triangles.push_back({c, a, v});
  const oracle::ShapeReport after = judges.shape(mesh);
  const auto quality = [&](Vec3 p, Vec3 q, Vec3 r) {
    const auto plan2 = [](Vec3 u, Vec3 w) { return (u.x - w.x) * (u.x - w.x) + (u.y - w.y) * (u.y - w.y); };
    const double area = ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) / 2;
    return 4 * std::sqrt(3.0) * area / (plan2(p, q) + plan2(q, r) + plan2(r, p));
  };
  const double worst = quality(pa, pb, mesh.positions[v]);
  const bool size = after.slivers == 1 && std::fabs(after.min_quality - worst) <= 1e-12;
  return tally(false, after.slivers > 0, size, true, before.slivers > 0);
}

std::optional<Tally> no_sliver(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  const Mesh mesh = random_grid(5 + static_cast<int>(random.below(6)), random).mesh;
  return tally(true, judges.shape(mesh).slivers > 0, false, false, false);
}

/// A defect of a closed mesh, and the finding that it must cause: code, kind, and a witness.
struct SolidFault {
  FindingCode code{};
  std::string kind;
  std::vector<std::uint32_t> vertices, triangles;
  std::size_t findings = 1;  ///< of that code; nothing else may be reported
};

using PlantSolid = SolidFault (*)(Mesh&, Random&);

std::optional<Tally> unsound(const Judges& judges, Random& random, const MakeSolid& solid, PlantSolid plant) {
  Mesh mesh = solid(random);
  const SolidFault fault = plant(mesh, random);
  const oracle::ConformityReport report = judges.soundness(mesh);
  std::size_t of_the_code = 0;
  bool place = false, elsewhere = false;
  for (const oracle::Finding& finding : report.findings) {
    if (finding.code != fault.code || finding.kind != fault.kind) {
      elsewhere = true;
      continue;
    }
    ++of_the_code;
    const auto names = [](const auto& all, const auto& wanted) {
      return std::all_of(wanted.begin(), wanted.end(), [&all](std::uint32_t v) {
        return std::find(all.begin(), all.end(), v) != all.end();
      });
    };
    if (names(finding.vertices, fault.vertices) && names(finding.triangles, fault.triangles)) place = true;
  }
  return tally(false, of_the_code > 0, of_the_code == fault.findings, place, elsewhere);
}

std::uint32_t any(std::size_t count, Random& random) {
  return static_cast<std::uint32_t>(random.below(count));
}

SolidFault break_vertex(Mesh& mesh, Random& random) {
  const std::uint32_t v = any(mesh.positions.size(), random);
  mesh.positions[v].y = std::numeric_limits<double>::quiet_NaN();
  return {FindingCode::non_finite, "", {v}, {}, 1};
}

SolidFault break_index(Mesh& mesh, Random& random) {
  const std::uint32_t t = any(mesh.triangles.size(), random);
  mesh.triangles[t][random.below(3)] = static_cast<std::uint32_t>(mesh.positions.size() + random.below(9));
  return {FindingCode::bad_index, "", {}, {t}, 1};
}

SolidFault leave_vertex(Mesh& mesh, Random& random) {
  mesh.positions.push_back({random.unit(), random.unit(), random.unit()});
  return {FindingCode::unused_vertex, "", {static_cast<std::uint32_t>(mesh.positions.size() - 1)}, {}, 1};
}

SolidFault flip_triangle(Mesh& mesh, Random& random) {
  const std::uint32_t t = any(mesh.triangles.size(), random);
  std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  return {FindingCode::non_manifold, "orientation", {}, {t}, 3};  // along each of its edges
}

/// A third triangle at an edge, standing off.
SolidFault add_fin(Mesh& mesh, Random& random) {
  const auto corners = mesh.triangles[any(mesh.triangles.size(), random)];
  const std::size_t k = random.below(3);
  const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
  mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 2);
  mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(mesh.positions.size() - 1)});
  return {
      FindingCode::non_manifold, "edge", {a, b}, {static_cast<std::uint32_t>(mesh.triangles.size() - 1)}, 1};
}

/// A second fan at a vertex: a small triangle that shares nothing else.
SolidFault add_fan(Mesh& mesh, Random& random) {
  const std::uint32_t v = any(mesh.positions.size(), random);
  const Vec3 p = mesh.positions[v];
  // Sideways by a vector that is never parallel to p: across the axis along which p is shortest.
  const double x = std::fabs(p.x), y = std::fabs(p.y), z = std::fabs(p.z);
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  mesh.positions.push_back(p * 1.5);
  mesh.positions.push_back(p * 1.5 + cross(p, axis) * 0.25);
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  mesh.triangles.push_back({v, last - 1, last});
  return {FindingCode::non_manifold, "vertex", {v}, {}, 1};
}

SolidFault repeat_corner(Mesh& mesh, Random& random) {
  const std::uint32_t v = any(mesh.positions.size(), random);
  const std::uint32_t w = (v + 1) % static_cast<std::uint32_t>(mesh.positions.size());
  mesh.triangles.push_back({v, w, w});
  return {FindingCode::degenerate,
          "repeated_vertex",
          {v, w},
          {static_cast<std::uint32_t>(mesh.triangles.size() - 1)},
          1};
}

std::optional<Tally> sound_solid(const Judges& judges, Random& random, const MakeSolid& solid) {
  Mesh mesh = solid(random);
  if (random.below(2) == 0) mesh.triangles.pop_back();  // open is no fault of a general mesh
  const auto pairs = judges.intersections(mesh);
  return tally(true, !judges.soundness(mesh).clean(), false, false, !pairs || !pairs->empty());
}

/// A vertex pushed out through the far side: each pair that pierces names a triangle of its star.
std::optional<Tally> pierced(const Judges& judges, Random& random, const MakeSolid& solid) {
  Mesh mesh = solid(random);
  const std::uint32_t v = any(mesh.positions.size(), random);
  mesh.positions[v] = mesh.positions[v] * -2;
  const auto pairs = judges.intersections(mesh);
  if (!pairs) return tally(false, false, false, false, false);
  const bool place = std::all_of(pairs->begin(), pairs->end(), [&](const auto& pair) {
    return std::any_of(pair.begin(), pair.end(), [&](std::uint32_t t) {
      const auto& corners = mesh.triangles[t];
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    });
  });
  return tally(false, !pairs->empty(), true, place, false);
}

constexpr double kBoxSide_m = 8;
constexpr double kWithin_m = 0.01;  ///< of the certified distances asked for

/// The middle of a flat side pulled out by h: the mesh is exactly h away from the box.
std::optional<Tally> pulled_vertex(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  const Mesh reference = box(4, kBoxSide_m);
  Mesh mesh = reference;
  std::vector<std::uint32_t> middles;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    const int zeros = (p.x == 0 ? 1 : 0) + (p.y == 0 ? 1 : 0) + (p.z == 0 ? 1 : 0);
    if (zeros == 2) middles.push_back(v);
  }
  Vec3& p = mesh.positions[middles[random.below(middles.size())]];
  const double pull_m = std::ldexp(1, static_cast<int>(random.below(5)) - 3);
  p = p * ((kBoxSide_m / 2 + pull_m) / (kBoxSide_m / 2));
  const auto likeness = judges.likeness(mesh, reference, kWithin_m);
  if (!likeness) return tally(false, false, false, false, false);
  const auto holds = [](const oracle::CertifiedDistance& distance, double wanted_m) {
    return distance.least_m <= wanted_m && wanted_m <= distance.most_m &&
           distance.most_m - distance.least_m <= 2 * kWithin_m * (1 + 1e-9);
  };
  return tally(false, likeness->from_mesh.least_m > 0,
               holds(likeness->from_mesh, pull_m) && holds(likeness->hausdorff(), pull_m), true,
               likeness->to_mesh.least_m > pull_m || likeness->turned_share > 0);
}

std::optional<Tally> same_solid(const Judges& judges, Random& random, const MakeSolid& solid) {
  const Mesh mesh = solid(random);
  const auto likeness = judges.likeness(mesh, mesh, kWithin_m);
  return tally(true, !likeness || likeness->hausdorff().least_m > 0 || likeness->turned_share > 0, false,
               false, false);
}

}  // namespace

std::vector<MeasuredFault> solid_faults() {
  constexpr auto kShape = "O6 shape", kSolid = "O7 general meshes";
  const auto soundness = [](std::string_view name, std::string_view what, PlantSolid plant) {
    return MeasuredFault{kSolid, name, what, false,
                         [plant](const Judges& judges, Random& random, const MakeSolid& solid) {
                           return unsound(judges, random, solid, plant);
                         }};
  };
  return {
      {kShape, "sliver", "a vertex a hundredth of the height off an edge: one sliver, its quality", false,
       sliver},
      {kShape, "right_triangles", "right isosceles triangles: no sliver", true, no_sliver},
      soundness("solid_vertex_nan", "a coordinate that is not finite", break_vertex),
      soundness("solid_index_bad", "a triangle that names a vertex that is not there", break_index),
      soundness("solid_vertex_unused", "a vertex that no triangle names", leave_vertex),
      soundness("solid_triangle_flipped", "a triangle wound inwards: each of its edges", flip_triangle),
      soundness("solid_fin", "a third triangle at an edge", add_fin),
      soundness("solid_two_fans", "two fans of triangles that share a vertex only", add_fan),
      soundness("solid_corner_twice", "a triangle that names a vertex twice", repeat_corner),
      {kSolid, "solid_pierced", "a vertex pushed out through the far side: pairs of its star", false,
       pierced},
      {kSolid, "solid_pulled_out", "the middle of a box's side pulled out by h: certified distance holds h",
       false, pulled_vertex},
      {kSolid, "solid_sound", "a closed or open rough ball: nothing, and no self-intersection", true,
       sound_solid},
      {kSolid, "solid_same", "a rough ball against itself: distance 0 within the bound", true, same_solid},
  };
}

}  // namespace plumbline::faults
