// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// O7 in space: planted faults, answers in closed form, and second routes (brute force) that share no code.
#include "oracle/likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "scenarios/random.h"

namespace plumbline::oracle {
namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

/// A closed tetrahedron of edge about `size` with its lowest corner at `at`, outward oriented.
Mesh tetrahedron(Vec3 at, double size) {
  return {{at, at + Vec3{size, 0, 0}, at + Vec3{0, size, 0}, at + Vec3{0, 0, size}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh out = a;
  const auto base = static_cast<std::uint32_t>(a.positions.size());
  out.positions.insert(out.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& [p, q, r] : b.triangles) out.triangles.push_back({base + p, base + q, base + r});
  return out;
}

/// A square sheet of n × n cells of 1 m with heights in [0, rough].
Mesh sheet(std::uint32_t n, double rough, std::uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i)
      mesh.positions.push_back({1.0 * i, 1.0 * j, rough * random.unit()});
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = (n + 1) * j + i;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  return mesh;
}

TEST(SelfIntersections, CleanMeshesHaveNone) {
  EXPECT_EQ(self_intersections(tetrahedron({0, 0, 0}, 1)), Pairs{});
  EXPECT_EQ(self_intersections(sheet(12, 3, 1)), Pairs{});
  EXPECT_EQ(self_intersections(joined(tetrahedron({0, 0, 0}, 1), tetrahedron({2, 0, 0}, 1))), Pairs{});
}

TEST(SelfIntersections, APlantedPiercingIsFoundAtItsTriangles) {
  // A needle from below through the middle of one cell's south-east triangle, and through nothing else.
  Mesh mesh = sheet(6, 0, 1);
  const std::uint32_t cell = 2 * (6 * 3 + 2);
  const Mesh needle{{{2.7, 3.2, -1}, {2.71, 3.2, -1}, {2.7, 3.21, 1}}, {{0, 1, 2}}};
  mesh = joined(mesh, needle);
  const auto last = static_cast<std::uint32_t>(mesh.triangles.size() - 1);
  EXPECT_EQ(self_intersections(mesh), (Pairs{{cell, last}}));
}

TEST(SelfIntersections, TouchingInACornerOrEdgeThatIsSharedIsNone) {
  EXPECT_EQ(self_intersections({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}}),
            Pairs{});
}

TEST(SelfIntersections, AFoldOntoItsNeighbourIsFound) {
  // The second triangle lies back on the first.
  EXPECT_EQ(self_intersections({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}}}),
            (Pairs{{0, 1}}));
}

TEST(SelfIntersections, WhatIsNoManifoldIsNotJudged) {
  Mesh mesh = tetrahedron({0, 0, 0}, 1);
  mesh.positions.push_back({1, 1, 1});
  mesh.triangles.push_back({0, 1, 4});
  EXPECT_FALSE(self_intersections(mesh).has_value());
}

/// Whether the open edge pq passes through the open triangle, in whole numbers.
bool pierces(std::array<std::int64_t, 3> p, std::array<std::int64_t, 3> q,
             const std::array<std::array<std::int64_t, 3>, 3>& t) {
  const auto volume = [](const auto& a, const auto& b, const auto& c, const auto& d) {
    const std::int64_t x1 = b[0] - a[0], y1 = b[1] - a[1], z1 = b[2] - a[2], x2 = c[0] - a[0],
                       y2 = c[1] - a[1], z2 = c[2] - a[2], x3 = d[0] - a[0], y3 = d[1] - a[1],
                       z3 = d[2] - a[2];
    const std::int64_t v = x1 * (y2 * z3 - z2 * y3) - y1 * (x2 * z3 - z2 * x3) + z1 * (x2 * y3 - y2 * x3);
    return v > 0 ? 1 : v < 0 ? -1 : 0;
  };
  const int above = volume(t[0], t[1], t[2], p), below = volume(t[0], t[1], t[2], q);
  if (above * below >= 0) return false;
  const int a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
  return a != 0 && a == b && b == c;
}

TEST(SelfIntersections, AgreeWithABruteForceOnSeparateTriangles) {
  // Triangles with corners of their own: what pierces is decided by five volumes in whole numbers.
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    Mesh mesh;
    std::vector<std::array<std::array<std::int64_t, 3>, 3>> whole;
    for (std::uint32_t t = 0; t < 8; ++t) {
      whole.emplace_back();
      for (std::uint32_t k = 0; k < 3; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          whole.back()[k][axis] = static_cast<std::int64_t>(random.between(0, 1000));
        const auto& c = whole.back()[k];
        mesh.positions.push_back(
            {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])});
      }
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    Pairs expected;
    for (std::uint32_t s = 0; s < 8; ++s) {
      for (std::uint32_t t = s + 1; t < 8; ++t) {
        bool meet = false;
        for (std::size_t k = 0; k < 3; ++k) {
          meet = meet || pierces(whole[s][k], whole[s][(k + 1) % 3], whole[t]) ||
                 pierces(whole[t][k], whole[t][(k + 1) % 3], whole[s]);
        }
        if (meet) expected.push_back({s, t});
      }
    }
    ASSERT_EQ(self_intersections(mesh), expected) << "seed " << seed;
    found += expected.size();
  }
  EXPECT_GT(found, 1000U);
}

TEST(CompareInSpace, EqualMeshesDifferByNothingBeyondTheBound) {
  const Mesh mesh = sheet(8, 2, 3);
  const auto likeness = compare_in_space(mesh, mesh, 0.001);
  ASSERT_TRUE(likeness.has_value());
  EXPECT_EQ(likeness->hausdorff().least_m, 0);
  EXPECT_LE(likeness->hausdorff().most_m, 0.002);
  EXPECT_EQ(likeness->normal_max_deg, 0);
  EXPECT_EQ(likeness->turned_share, 0);
}

TEST(CompareInSpace, ALiftedSheetIsAsFarAsItWasLifted) {
  const Mesh low = sheet(8, 0, 1);
  Mesh high = low;
  for (Vec3& p : high.positions) p.z += 0.75;
  const auto likeness = compare_in_space(high, low, 0.001);
  ASSERT_TRUE(likeness.has_value());
  EXPECT_LE(likeness->to_mesh.least_m, 0.75);
  EXPECT_GE(likeness->to_mesh.most_m, 0.75);
  constexpr double kRounding = 1e-12;  // of two sums
  EXPECT_LE(likeness->from_mesh.most_m - likeness->from_mesh.least_m, 0.002 + kRounding);
  EXPECT_EQ(likeness->normal_mean_deg, 0);
}

TEST(CompareInSpace, DistancesAreOneSided) {
  // The mesh lacks half of the reference: from the mesh nothing is far, to it the missing half is.
  const Mesh whole = sheet(8, 0, 1);
  Mesh half = whole;
  half.triangles.resize(half.triangles.size() / 2);  // the south half
  const auto likeness = compare_in_space(half, whole, 0.001);
  ASSERT_TRUE(likeness.has_value());
  EXPECT_LE(likeness->from_mesh.most_m, 0.002);
  EXPECT_LE(likeness->to_mesh.least_m, 4);
  EXPECT_GE(likeness->to_mesh.most_m, 4);
}

TEST(CompareInSpace, ATurnedTriangleShowsInTheNormals) {
  const Mesh reference = tetrahedron({0, 0, 0}, 1);
  Mesh turned = reference;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  const auto likeness = compare_in_space(turned, reference, 0.001);
  ASSERT_TRUE(likeness.has_value());
  EXPECT_EQ(likeness->normal_max_deg, 180);
  EXPECT_EQ(likeness->turned_share, 1);
}

double point_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  // Closest point by dense barycentric sampling would miss; Ericson's regions, written out.
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return length(ap);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return length(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(p - (a + ab * (d1 / (d1 - d3))));
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return length(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(p - (a + ac * (d2 / (d2 - d6))));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return length(p - (b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)))));
  const double scale = 1 / (va + vb + vc);
  return length(p - (a + ab * (vb * scale) + ac * (vc * scale)));
}

/// Greatest distance of sampled points of `from`, spacing 1/n of each triangle, from `to`.
double sampled(const Mesh& from, const Mesh& to, int n) {
  double greatest = 0;
  for (const auto& [a, b, c] : from.triangles) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const double u = 1.0 * i / n, v = 1.0 * j / n;
        const Vec3 p = from.positions[a] * (1 - u - v) + from.positions[b] * u + from.positions[c] * v;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [d, e, f] : to.triangles)
          least = std::min(least, point_triangle(p, to.positions[d], to.positions[e], to.positions[f]));
        greatest = std::max(greatest, least);
      }
    }
  }
  return greatest;
}

TEST(CompareInSpace, DenseSamplingNeverExceedsAndComesNear) {
  constexpr double kWithin = 0.001;
  constexpr double kRounding = 1e-12;  // of coordinates of a few metres
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh a = sheet(3, 2, seed), b = sheet(3, 2, seed + 100);
    const auto likeness = compare_in_space(a, b, kWithin);
    ASSERT_TRUE(likeness.has_value());
    const double to = sampled(b, a, 40), from = sampled(a, b, 40);
    EXPECT_LE(to, likeness->to_mesh.most_m + kRounding);
    EXPECT_LE(from, likeness->from_mesh.most_m + kRounding);
    // A sample stands within a fortieth of an edge (under 2.5 m) of any point, so it misses no more than
    // that.
    EXPECT_GE(to, likeness->to_mesh.least_m - 2.5 / 40);
    EXPECT_GE(from, likeness->from_mesh.least_m - 2.5 / 40);
  }
}

TEST(CompareInSpace, ScalesByPowersOfTwoExactly) {
  const Mesh a = sheet(4, 2, 7), b = sheet(4, 2, 8);
  const auto one = compare_in_space(a, b, 0x1p-10);
  Mesh wide_a = a, wide_b = b;
  for (Vec3& p : wide_a.positions) p = p * 1024;
  for (Vec3& p : wide_b.positions) p = p * 1024;
  const auto wide = compare_in_space(wide_a, wide_b, 1);
  ASSERT_TRUE(one && wide);
  EXPECT_EQ(wide->to_mesh.most_m, 1024 * one->to_mesh.most_m);
  EXPECT_EQ(wide->from_mesh.least_m, 1024 * one->from_mesh.least_m);
  EXPECT_EQ(wide->normal_mean_deg, one->normal_mean_deg);
}

TEST(CompareInSpace, NoManifoldNoAnswer) {
  Mesh mesh = tetrahedron({0, 0, 0}, 1);
  mesh.triangles.push_back({0, 1, 2});  // a second triangle on three edges
  EXPECT_FALSE(compare_in_space(mesh, tetrahedron({0, 0, 0}, 1), 0.1).has_value());
}

TEST(ProjectedArea, CountsPixels) {
  PixelHits reference, mesh;
  reference.triangle = {0, 0, 0, 0, PixelHits::kNoHit};
  mesh.triangle = {0, 0, 0, PixelHits::kNoHit, PixelHits::kNoHit};
  EXPECT_EQ(projected_area_error(reference, mesh), -0.25);
  EXPECT_EQ(projected_area_error(mesh, reference), 1.0 / 3);
  EXPECT_EQ(projected_area_error(mesh, mesh), 0);
}

}  // namespace
}  // namespace plumbline::oracle
