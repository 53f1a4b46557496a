// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Second routes of the questions about general meshes: every pair of triangles, every vertex, in rational
// numbers and by the definitions; and the nearest triangle by asking them all.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include "oracle/likeness.h"
#include "oracle/soundness.h"
#include "properties/faults/faults.h"
#include "tests/oracle/conformity_meshes.h"

namespace plumbline::oracle {
namespace {

using Rational = CGAL::Exact_rational;
using Point = std::array<Rational, 3>;
using Corners = std::array<std::uint32_t, 3>;

Point exact(const Vec3& p) { return {p.x, p.y, p.z}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point outer(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
const Point kZero{0, 0, 0};

struct Solid {
  std::array<Point, 3> corner;
  Point normal;
};
Solid solid(const Mesh& mesh, const Corners& t) {
  Solid s{{exact(mesh.positions[t[0]]), exact(mesh.positions[t[1]]), exact(mesh.positions[t[2]])}, {}};
  s.normal = outer(s.corner[1] - s.corner[0], s.corner[2] - s.corner[0]);
  return s;
}

/// Whether p, in the triangle's plane, is in the closed triangle.
bool holds(const Solid& s, const Point& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Point &a = s.corner[k], &b = s.corner[(k + 1) % 3];
    if (inner(outer(b - a, p - a), s.normal) < 0) return false;
  }
  return true;
}

/// Points of the closed segment ab and the closed triangle that span what they have in common.
void common_points(const Point& a, const Point& b, const Solid& s, std::vector<Point>& found) {
  const Rational above = inner(a - s.corner[0], s.normal), below = inner(b - s.corner[0], s.normal);
  if (above != below) {
    const Rational share = above / (above - below);
    if (share < 0 || share > 1) return;
    Point p = a;
    for (std::size_t k = 0; k < 3; ++k) p[k] += share * (b[k] - a[k]);
    if (holds(s, p)) found.push_back(p);
    return;
  }
  if (above != 0) return;
  // In the plane: the segment's part inside all three sides.
  Rational from = 0, to = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point &c = s.corner[k], &d = s.corner[(k + 1) % 3];
    const Rational at_a = inner(outer(d - c, a - c), s.normal), at_b = inner(outer(d - c, b - c), s.normal);
    if (at_a < 0 && at_b < 0) return;
    if (at_a == at_b) {
      if (at_a < 0) return;
      continue;
    }
    const Rational share = at_a / (at_a - at_b);
    if (at_a < at_b) {
      if (share > from) from = share;
    } else if (share < to) {
      to = share;
    }
  }
  if (from > to) return;
  for (const Rational& share : {from, to}) {
    Point p = a;
    for (std::size_t k = 0; k < 3; ++k) p[k] += share * (b[k] - a[k]);
    found.push_back(p);
  }
}

/// Whether two triangles have a point in common that is not in the corner or edge they share. What they have
/// in common is convex, so the points that span it tell.
bool meet_elsewhere(const Mesh& mesh, const Corners& s, const Corners& t) {
  const Solid a = solid(mesh, s), b = solid(mesh, t);
  std::vector<Point> shared, found;
  for (const std::uint32_t v : s) {
    if (std::find(t.begin(), t.end(), v) != t.end()) shared.push_back(exact(mesh.positions[v]));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    common_points(a.corner[k], a.corner[(k + 1) % 3], b, found);
    common_points(b.corner[k], b.corner[(k + 1) % 3], a, found);
  }
  return std::any_of(found.begin(), found.end(), [&](const Point& p) {
    if (shared.empty()) return true;
    if (shared.size() == 1) return p != shared[0];
    const Point along = shared[1] - shared[0], to = p - shared[0];
    return outer(along, to) != kZero || inner(along, to) < 0 || inner(along, to) > inner(along, along);
  });
}

/// A disc or a closed surface with corners at random points of a small lattice: folded, pierced, flattened.
Mesh crumpled(Random& random) {
  Mesh mesh;
  const std::uint64_t side = 3 + random.below(4);
  const auto anywhere = [&] {
    return Vec3{static_cast<double>(random.below(side)), static_cast<double>(random.below(side)),
                static_cast<double>(random.below(side))};
  };
  if (random.below(3) == 0) {  // an octahedron
    for (int v = 0; v < 6; ++v) mesh.positions.push_back(anywhere());
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
    return mesh;
  }
  for (int v = 0; v < 9; ++v) mesh.positions.push_back(anywhere());
  for (std::uint32_t j = 0; j < 2; ++j) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      const std::uint32_t a = 3 * j + i;
      mesh.triangles.push_back({a, a + 1, a + 4});
      mesh.triangles.push_back({a, a + 4, a + 3});
    }
  }
  return mesh;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kMeshes = 60;
#else
constexpr std::uint64_t kMeshes = 1500;
#endif

TEST(IntersectionRoute, EveryPairInRationalsAgrees) {
  std::size_t pairs = 0, clean = 0, neighbours = 0;
  for (std::uint64_t seed = 0; seed < kMeshes; ++seed) {
    Random random(seed, "crumpled");
    const Mesh mesh = crumpled(random);
    const auto told = self_intersections(mesh);
    ASSERT_TRUE(told) << seed;
    std::vector<std::array<std::uint32_t, 2>> expected;
    for (std::uint32_t s = 0; s < mesh.triangles.size(); ++s) {
      for (std::uint32_t t = s + 1; t < mesh.triangles.size(); ++t) {
        const Corners &a = mesh.triangles[s], &b = mesh.triangles[t];
        if (solid(mesh, a).normal == kZero || solid(mesh, b).normal == kZero) continue;
        if (!meet_elsewhere(mesh, a, b)) continue;
        expected.push_back({s, t});
        neighbours += std::any_of(a.begin(), a.end(),
                                  [&](auto v) { return std::find(b.begin(), b.end(), v) != b.end(); });
      }
    }
    ASSERT_EQ(*told, expected) << "seed " << seed;
    pairs += expected.size();
    clean += expected.empty();
  }
  EXPECT_GT(pairs, kMeshes);
  EXPECT_GT(neighbours, kMeshes) << "pairs that share a corner or an edge";
  if (kMeshes >= 1000) {  // a sanitizer's share is too small to draw one
    EXPECT_GT(clean, kMeshes / 100);
  }
}

/// A finding of soundness: code, kind, vertices.
using Told = std::tuple<FindingCode, std::string, std::set<std::uint32_t>>;

std::multiset<Told> by_definition(const Mesh& mesh) {
  using enum FindingCode;
  std::multiset<Told> all;
  const auto finite = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const bool used = std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Corners& t) {
      return std::find(t.begin(), t.end(), v) != t.end();
    });
    if (!used) all.insert({unused_vertex, "", {v}});
    if (!finite(v)) all.insert({non_finite, "", {v}});
  }
  std::vector<Corners> sound;
  for (const Corners& t : mesh.triangles) {
    const std::set<std::uint32_t> corners(t.begin(), t.end());
    if (*corners.rbegin() >= mesh.positions.size()) {
      all.insert({bad_index, "", corners});
      continue;
    }
    if (!std::all_of(t.begin(), t.end(), finite)) continue;
    if (corners.size() < 3) {
      all.insert({degenerate, "repeated_vertex", corners});
      continue;
    }
    if (solid(mesh, t).normal == kZero) all.insert({degenerate, "", corners});
    const bool again = std::any_of(sound.begin(), sound.end(), [&](const Corners& other) {
      return std::set<std::uint32_t>(other.begin(), other.end()) == corners;
    });
    if (again) all.insert({duplicate, "", corners});
    sound.push_back(t);
  }
  const auto runs = [](const Corners& t, std::uint32_t a, std::uint32_t b) {
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
  };
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) {
      std::size_t forwards = 0, backwards = 0;
      for (const Corners& t : sound) {
        forwards += runs(t, a, b);
        backwards += runs(t, b, a);
      }
      if (forwards + backwards > 2) {
        all.insert({non_manifold, "edge", {a, b}});
      } else if (forwards == 2 || backwards == 2) {
        all.insert({non_manifold, "orientation", {a, b}});
      }
    }
    // Fans: from one triangle at the vertex over shared edges to as many as it reaches.
    std::vector<Corners> star;
    for (const Corners& t : sound) {
      if (std::find(t.begin(), t.end(), a) != t.end()) star.push_back(t);
    }
    std::vector<bool> reached(star.size());
    std::size_t fans = 0;
    for (std::size_t first = 0; first < star.size(); ++first) {
      if (reached[first]) continue;
      ++fans;
      std::vector<std::size_t> queue{first};
      reached[first] = true;
      for (std::size_t k = 0; k < queue.size(); ++k) {
        for (std::size_t other = 0; other < star.size(); ++other) {
          const Corners& t = star[other];
          const auto shared = std::count_if(star[queue[k]].begin(), star[queue[k]].end(), [&](auto v) {
            return v != a && std::find(t.begin(), t.end(), v) != t.end();
          });
          if (reached[other] || shared == 0) continue;
          reached[other] = true;
          queue.push_back(other);
        }
      }
    }
    if (fans > 1) all.insert({non_manifold, "vertex", {a}});
  }
  return all;
}

std::multiset<Told> told_by(const ConformityReport& report) {
  std::multiset<Told> all;
  for (const Finding& f : report.findings)
    all.insert({f.code, f.kind, std::set<std::uint32_t>(f.vertices.begin(), f.vertices.end())});
  return all;
}

TEST(SoundnessRoute, EveryVertexEdgeAndPairByDefinitionAgrees) {
  std::map<std::string, std::size_t> seen;
  std::size_t clean = 0;
  for (std::uint64_t seed = 0; seed < kMeshes; ++seed) {
    Random random(seed, "soup");
    Mesh mesh;
    switch (random.below(3)) {
      case 0: {  // triangles over few vertices, anyhow
        for (int v = 0; v < 9; ++v) {
          mesh.positions.push_back({static_cast<double>(random.below(3)),
                                    static_cast<double>(random.below(3)),
                                    static_cast<double>(random.below(3))});
        }
        for (std::uint64_t t = 1 + random.below(9); t > 0; --t) {
          const auto corner = [&] { return static_cast<std::uint32_t>(random.below(9)); };
          mesh.triangles.push_back({corner(), corner(), corner()});
        }
        break;
      }
      case 1:
        mesh = crumpled(random);
        break;
      default: {
        const plumbline::test::Surface s = plumbline::test::random_grid(4, random);
        const auto& kinds = faults::fault_kinds();
        const auto fault = faults::plant(kinds[random.below(kinds.size())].name, s.mesh, s.domain, random);
        mesh = fault ? fault->mesh : s.mesh;
      }
    }
    const ConformityReport report = check_soundness(mesh);
    const auto expected = by_definition(mesh);
    ASSERT_EQ(told_by(report), expected) << "seed " << seed;
    ASSERT_EQ(report.counts.total(), expected.size());
    for (const auto& [code, kind, vertices] : expected) ++seen[std::string(finding_name(code)) + ' ' + kind];
    clean += expected.empty();
  }
  if (kMeshes >= 1000) {  // a sanitizer's share is too small to draw them all
    EXPECT_EQ(seen.size(), 9U) << "every kind of finding must come up";
  }
  for (const auto& [kind, count] : seen) EXPECT_GT(count, 0U) << kind;
  EXPECT_GT(clean, kMeshes / 20);
}

double squared_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  // The foot on the plane if it is inside, else the nearest of the three sides.
  const Vec3 n = cross(b - a, c - a);
  const double nn = dot(n, n);
  const double u = dot(cross(c - b, p - b), n), v = dot(cross(a - c, p - c), n),
               w = dot(cross(b - a, p - a), n);
  if (u >= 0 && v >= 0 && w >= 0) return dot(p - a, n) * dot(p - a, n) / nn;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
    const Vec3 e = to - from;
    const Vec3 off = p - (from + e * std::clamp(dot(p - from, e) / dot(e, e), 0.0, 1.0));
    least = std::min(least, dot(off, off));
  }
  return least;
}

TEST(LikenessRoute, NormalsOfTheNearestTrianglesByAskingThemAll) {
  // A sheet against another: near ties between nearest triangles are left to either.
  constexpr double kTie = 1e-9, kAngleRounding_deg = 1e-6;  // acos near 0 knows half of the digits
  constexpr double kDegreesPerRadian = 57.29577951308232;
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed, "normals");
    const auto sheet = [&] {
      Mesh mesh = plumbline::test::random_grid(5, random).mesh;
      for (Vec3& p : mesh.positions) p.z = random.between(0, 2) * (mesh.positions[1].x - mesh.positions[0].x);
      return mesh;
    };
    const Mesh reference = sheet();
    Mesh mesh = reference;
    for (Vec3& p : mesh.positions) p.z += random.between(-1, 1) * (reference.positions[1].x);
    if (seed % 2 == 0)
      std::swap(mesh.triangles[seed % 7][0], mesh.triangles[seed % 7][1]);  // no manifold then
    const auto likeness = compare_in_space(mesh, reference, reference.positions[1].x * 0.125);
    if (!likeness) {
      EXPECT_EQ(seed % 2, 0U);
      continue;
    }
    double most = 0, area = 0, weighted = 0, turned = 0;
    bool tie = false;
    for (const auto& [a, b, c] : reference.triangles) {
      const Vec3 &pa = reference.positions[a], &pb = reference.positions[b], &pc = reference.positions[c];
      const Vec3 centroid = (pa + pb + pc) * (1.0 / 3);
      double nearest = std::numeric_limits<double>::infinity(), second = nearest;
      Vec3 normal;
      for (const auto& [d, e, f] : mesh.triangles) {
        const Vec3 &pd = mesh.positions[d], &pe = mesh.positions[e], &pf = mesh.positions[f];
        const double far = squared_distance(centroid, pd, pe, pf);
        if (far < nearest) {
          second = nearest;
          nearest = far;
          normal = cross(pe - pd, pf - pd);
        } else {
          second = std::min(second, far);
        }
      }
      tie = tie || second - nearest <= kTie * second;
      const Vec3 n = cross(pb - pa, pc - pa);
      const double cosine = dot(n, normal) / (length(n) * length(normal));
      const double angle_deg = std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegreesPerRadian;
      most = std::max(most, angle_deg);
      area += length(n);
      weighted += length(n) * angle_deg;
      if (cosine < 0) turned += length(n);
    }
    if (tie) continue;
    EXPECT_NEAR(likeness->normal_max_deg, most, kAngleRounding_deg) << seed;
    EXPECT_NEAR(likeness->normal_mean_deg, weighted / area, kAngleRounding_deg) << seed;
    EXPECT_NEAR(likeness->turned_share, turned / area, 1e-12) << seed;
    ++compared;
  }
  EXPECT_GT(compared, 5U);
}

}  // namespace
}  // namespace plumbline::oracle
