// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// check_conformity against its slow twin, and sound meshes against zero findings.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "oracle/conformity.h"
#include "properties/faults/faults.h"
#include "tests/oracle/conformity_meshes.h"
#include "tests/oracle/slow_conformity.h"

namespace plumbline {
namespace {

using oracle::check_conformity;
using oracle::ConformityReport;
using oracle::Finding;
using oracle::FindingCode;

/// Areas of regions are sums of up to a few hundred rounded products of numbers below 2¹²: relative to the
/// 2²⁴ m² of those products, 2⁻⁴⁰ m² is a thousand roundings.
constexpr double kAreaRounding_m2 = 0x1p-20;

/// Small meshes that are wrong in all sorts of ways: on a coarse lattice (so that edges overlap, corners meet
/// edges, triangles are flat), or a sound mesh after a fault of the catalogue or a few random blows.
test::Surface wrong_mesh(Random& random, std::map<std::string, std::size_t>& planted) {
  test::Surface s;
  const std::uint64_t sort = random.below(8);
  if (sort < 3) {
    for (int v = 0; v < 12; ++v) {
      s.mesh.positions.push_back({static_cast<double>(random.below(5)), static_cast<double>(random.below(5)),
                                  static_cast<double>(random.below(2))});
    }
    const auto corner = [&] { return static_cast<std::uint32_t>(random.below(12)); };
    const std::uint64_t count = 1 + random.below(6);
    while (s.mesh.triangles.size() < count) {
      std::array<std::uint32_t, 3> c{corner(), corner(), corner()};
      const auto& p = s.mesh.positions;
      const double turn = (p[c[1]].x - p[c[0]].x) * (p[c[2]].y - p[c[0]].y) -
                          (p[c[1]].y - p[c[0]].y) * (p[c[2]].x - p[c[0]].x);  // small integers: exact
      if (turn < 0) std::swap(c[0], c[1]);
      if (turn != 0) s.mesh.triangles.push_back(c);
    }
    s.domain.add_rectangle({0, 0}, {3, 4});  // some triangles stick out
    return s;
  }
  s = random.below(2) == 0 ? test::random_bintree(2, random)
                           : test::random_delaunay(10, random.below(2) == 0, random);
  if (s.mesh.triangles.empty() || sort == 3) return s;  // clean
  if (sort < 6) {
    const auto& kinds = faults::fault_kinds();
    const std::size_t k = random.below(kinds.size());
    // The twin takes good indices and finite coordinates only.
    if (kinds[k].name == "vertex_nan" || kinds[k].name == "index_bad") return s;
    if (const auto fault = faults::plant(kinds[k].name, s.mesh, s.domain, random)) {
      s = {fault->mesh, fault->domain};
      ++planted[std::string(kinds[k].name)];
    }
    return s;
  }
  for (std::uint64_t blows = random.below(4); blows > 0; --blows) {
    auto& mesh = s.mesh;
    const auto t = static_cast<std::size_t>(random.below(mesh.triangles.size()));
    const auto k = static_cast<std::size_t>(random.below(3));
    const auto own_corner = [&] {
      mesh.positions.push_back(mesh.positions[mesh.triangles[t][k]]);
      mesh.triangles[t][k] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    switch (random.below(5)) {
      case 0:
        mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        break;
      case 1:
        own_corner();
        break;
      case 2:
        own_corner();
        mesh.positions.back().z += 1;
        break;
      case 3: {  // a corner of its own, half way along an edge: a T-vertex with a hole or an overlap
        own_corner();
        const Vec3 next = mesh.positions[mesh.triangles[t][(k + 1) % 3]];
        mesh.positions.back() = (mesh.positions.back() + next) * 0.5;
        break;
      }
      default: {  // an edge split on this side only
        const auto c = mesh.triangles[t];
        const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
        const Vec3 a = mesh.positions[c[k]], b = mesh.positions[c[(k + 1) % 3]];
        mesh.positions.push_back((a + b) * 0.5);
        mesh.triangles[t] = {c[k], middle, c[(k + 2) % 3]};
        mesh.triangles.push_back({middle, c[(k + 1) % 3], c[(k + 2) % 3]});
      }
    }
    if (mesh.triangles.empty()) break;
  }
  return s;
}

/// Areas of the regions of one sort, ascending.
std::vector<double> areas_of(const ConformityReport& report, FindingCode code, std::string_view kind = "") {
  std::vector<double> areas_m2;
  for (const Finding& f : report.findings) {
    if (f.code == code && f.kind == kind) areas_m2.push_back(f.area_m2);
  }
  std::sort(areas_m2.begin(), areas_m2.end());
  return areas_m2;
}

testing::AssertionResult same_regions(const std::vector<double>& fast, const std::vector<double>& slow) {
  if (fast.size() != slow.size())
    return testing::AssertionFailure() << fast.size() << " regions, not " << slow.size();
  for (std::size_t i = 0; i < fast.size(); ++i) {
    if (!(std::fabs(fast[i] - slow[i]) <= kAreaRounding_m2))
      return testing::AssertionFailure()
             << "a region of " << fast[i] << ", not " << slow[i] << " square metres";
  }
  return testing::AssertionSuccess();
}

/// Sanitizers make rational arithmetic some thirty times slower; a share of the meshes then has to do.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kMeshes = 500;
#elif !defined(NDEBUG)
constexpr std::uint64_t kMeshes = 1000;
#else
constexpr std::uint64_t kMeshes = 10000;
#endif

TEST(ConformityRoute, AnExactArrangementOfAllEdgesAgrees) {
  using enum FindingCode;
  std::map<std::string, std::size_t> planted;
  std::size_t clean = 0, holes = 0, missing = 0, overlaps = 0, extras = 0, t_vertices = 0, cracks = 0,
              turned_meshes = 0, duplicates = 0;
  for (std::uint64_t seed = 0; seed < kMeshes; ++seed) {
    Random random(seed, "route");
    const test::Surface s = wrong_mesh(random, planted);
    ConformityReport fast = check_conformity(s.mesh, s.domain);
    // Which clockwise triangles are read the other way round is a rule of naming, not of geometry; the twin
    // is told. That they are clockwise it sees itself.
    std::set<std::size_t> turned;
    for (const Finding& f : fast.findings) {
      if (f.code == fold_over && f.kind == "reversed") turned.insert(f.triangles[0]);
    }
    const test::SlowVerdict slow = test::slow_conformity(s.mesh, s.domain, turned);
    const auto context = [&] { return "seed " + std::to_string(seed) + "\n" + test::text(fast); };

    // Unused vertices and crowded edges are told by index alone; the twin does not look at indices.
    fast.counts.unused_vertex = fast.counts.non_manifold = 0;
    ASSERT_EQ(fast.clean(), slow.clean()) << context();
    ASSERT_EQ(fast.counts.degenerate, slow.degenerate) << context();
    ASSERT_EQ(fast.counts.duplicate, slow.duplicates) << context();
    ASSERT_EQ(fast.counts.fold_over, slow.clockwise) << context();
    // What is counted is what is listed; a T-vertex with a gap counts twice.
    std::map<FindingCode, std::size_t> listed;
    double widest_m = 0;
    for (const Finding& f : fast.findings) {
      ++listed[f.code == crack && f.kind == "t_vertex" ? t_junction : f.code];
      if (f.code != crack) continue;
      widest_m = std::max(widest_m, std::fabs(f.gap_m));
      if (f.kind == "t_vertex") ++listed[crack];
    }
    ASSERT_EQ(fast.counts.t_junction, listed[t_junction]) << context();
    ASSERT_EQ(fast.counts.crack, listed[crack]) << context();
    ASSERT_EQ(fast.counts.hole, listed[hole]) << context();
    ASSERT_EQ(fast.counts.overlap, listed[overlap]) << context();
    ASSERT_EQ(fast.counts.outline, listed[outline]) << context();
    ASSERT_EQ(fast.largest_gap_m, widest_m) << context();
    clean += slow.clean();
    turned_meshes += !turned.empty();
    duplicates += slow.duplicates;
    if (slow.degenerate > 0) continue;  // told instead of its consequences, which the twin does see

    // Every region by itself, by its class and area; then the balance: what is promised is covered once, or
    // is in one of them.
    ASSERT_TRUE(same_regions(areas_of(fast, hole), slow.holes_m2)) << context();
    ASSERT_TRUE(same_regions(areas_of(fast, outline, "missing"), slow.missing_m2)) << context();
    ASSERT_TRUE(same_regions(areas_of(fast, overlap), slow.overlaps_m2)) << context();
    ASSERT_TRUE(same_regions(areas_of(fast, outline, "extra"), slow.extras_m2)) << context();
    double wrong_m2 = 0;
    for (const Finding& f : fast.findings) {
      const bool inside = f.code == hole || f.code == overlap || (f.code == outline && f.kind == "missing");
      if (inside) wrong_m2 += f.area_m2;
    }
    ASSERT_NEAR(slow.promised_m2 - wrong_m2, slow.covered_once_m2, kAreaRounding_m2) << context();
    holes += slow.holes_m2.size();
    missing += slow.missing_m2.size();
    overlaps += slow.overlaps_m2.size();
    extras += slow.extras_m2.size();

    // Where triangles lie upon each other, the twin sees vertices on edges that are matched already, and
    // several pairings of edges; elsewhere both must see the same.
    std::set<std::array<double, 6>> places;
    std::map<std::array<double, 6>, double> gaps;
    std::size_t mismatches = 0;
    for (const Finding& f : fast.findings) {
      if (f.kind == "height_mismatch") ++mismatches;
      if (f.kind != "t_vertex") continue;
      auto corners = s.mesh.triangles[f.triangles[0]];
      if (turned.contains(f.triangles[0])) std::swap(corners[1], corners[2]);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
        if (std::min(a, b) != f.vertices[1] || std::max(a, b) != f.vertices[2]) continue;
        const Vec3 &pa = s.mesh.positions[a], &pb = s.mesh.positions[b];
        const std::array place{f.at.x, f.at.y, pa.x, pa.y, pb.x, pb.y};
        places.insert(place);
        if (f.code == crack) gaps[place] = std::max(gaps[place], std::fabs(f.gap_m));
      }
    }
    ASSERT_TRUE(std::includes(slow.t_places.begin(), slow.t_places.end(), places.begin(), places.end()))
        << context();
    if (slow.overlaps_m2.empty() && slow.extras_m2.empty() && slow.clockwise == turned.size()) {
      ASSERT_EQ(places, slow.t_places) << context();
      ASSERT_EQ(gaps, slow.gaps) << context();
      if (slow.t_places.empty()) {
        ASSERT_EQ(mismatches, slow.cracks) << context();
      }
      t_vertices += places.size();
      cracks += mismatches;
    }
  }
  // The comparison must have had something to compare, of every sort, and faults of every kind.
  EXPECT_GT(clean, kMeshes / 10);
  EXPECT_GT(holes, kMeshes / 20);
  EXPECT_GT(missing, kMeshes / 20);
  EXPECT_GT(overlaps, kMeshes / 20);
  EXPECT_GT(extras, kMeshes / 20);
  EXPECT_GT(t_vertices, kMeshes / 20);
  EXPECT_GT(cracks, kMeshes / 40);
  EXPECT_GT(turned_meshes, 0u);
  EXPECT_GT(duplicates, 0u);
  // A sanitizer's share of the meshes is too small to draw every kind.
  if (kMeshes >= 1000) {
    EXPECT_EQ(planted.size(), faults::fault_kinds().size() - 2) << "all but the two that are no geometry";
  }
}

TEST(ConformityRoute, CleanMeansClean) {
  std::size_t triangles = 0;
  for (std::uint64_t seed = 0; seed < 10000; ++seed) {
    Random random(seed, "clean");
    test::Surface s;
    switch (seed % 4) {
      case 0:
        s = test::random_grid(2 + static_cast<int>(random.below(7)), random);
        break;
      case 1:
        s = test::random_bintree(1 + static_cast<int>(random.below(3)), random);
        break;
      case 2:
        s = test::random_delaunay(3 + static_cast<int>(random.below(40)), false, random);
        break;
      default:
        s = test::random_delaunay(3 + static_cast<int>(random.below(40)), true, random);
    }
    const ConformityReport report = check_conformity(s.mesh, s.domain);
    ASSERT_TRUE(report.clean()) << "seed " << seed << '\n' << test::text(report);
    triangles += s.mesh.triangles.size();
  }
  EXPECT_GT(triangles, 100000u);
}

}  // namespace
}  // namespace plumbline
