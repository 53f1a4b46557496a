// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TINs: their triangulation, and who is next to whom.
#include "algorithms/tin/tin.h"

#include <algorithm>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lattice.h"
#include "scenarios/error.h"
#include "scenarios/random.h"

namespace plumbline::tin {
namespace {

using ::testing::HasSubstr;

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Triangles by their corners' places, each from its least corner on.
using Places = std::set<std::array<std::pair<double, double>, 3>>;
Places places(const Mesh& mesh) {
  Places out;
  for (const auto& t : mesh.triangles) {
    std::array<std::pair<double, double>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {mesh.positions[t[k]].x, mesh.positions[t[k]].y};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    out.insert(corners);
  }
  return out;
}

std::vector<Vec3> shuffled(std::vector<Vec3> points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t k = points.size(); k > 1; --k) std::swap(points[k - 1], points[random.below(k)]);
  return points;
}

/// Twice the area in plan, summed.
double double_area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 u = mesh.positions[t[1]] - mesh.positions[t[0]];
    const Vec3 v = mesh.positions[t[2]] - mesh.positions[t[0]];
    sum += u.x * v.y - u.y * v.x;
  }
  return sum;
}

TEST(Delaunay, OfAGridIsItsReferenceMeshWhateverTheOrder) {
  const Terrain terrain = lattice::rough(9, 7, 3, 5);
  const Mesh grid = reference_mesh(terrain);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Tin made = delaunay_tin(shuffled(grid.positions, seed), {});
    EXPECT_EQ(places(made.mesh), places(grid)) << "order " << seed;
    EXPECT_TRUE(made.roads.empty());
  }
  EXPECT_EQ(grid_tin(terrain).mesh.triangles, grid.triangles);
}

TEST(Delaunay, RegularPolygonIsAFanFromItsLeastPoint) {
  // Twelve points on one circle with whole coordinates: x² + y² = 65·25 would do; 5² = 3² + 4² has these.
  std::vector<Vec3> circle;
  for (const auto& [x, y] : {std::pair{5, 0}, std::pair{4, 3}, std::pair{3, 4}, std::pair{0, 5},
                             std::pair{-3, 4}, std::pair{-4, 3}, std::pair{-5, 0}, std::pair{-4, -3},
                             std::pair{-3, -4}, std::pair{0, -5}, std::pair{3, -4}, std::pair{4, -3}}) {
    circle.push_back({double{1} * x, double{1} * y, 0});
  }
  const Tin first = delaunay_tin(circle, {});
  ASSERT_EQ(first.mesh.triangles.size(), 10U);
  for (const auto& t : places(first.mesh)) EXPECT_EQ(t[0], std::pair(-5.0, 0.0));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(places(delaunay_tin(shuffled(circle, seed), {}).mesh), places(first.mesh));
  }
}

TEST(Delaunay, EveryTriangleIsCounterClockwiseAndItsCircleEmpty) {
  Random random(9);
  std::vector<Vec3> points;
  for (int k = 0; k < 60; ++k) {
    const double x = std::floor(random.between(0, 14));
    const double y = std::floor(random.between(0, 14));
    points.push_back({x, y, 0});
  }
  const Mesh mesh = delaunay_tin(points, {}).mesh;
  EXPECT_LT(mesh.positions.size(), points.size()) << "a place that is drawn twice counts once";
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    ASSERT_EQ(plan_orientation(a, b, c), 1);
    for (const Vec3& d : mesh.positions) {  // whole numbers: the determinant is exact
      const Vec3 u = a - d, v = b - d, w = c - d;
      const auto square = [](Vec3 p) { return p.x * p.x + p.y * p.y; };
      const double inside = square(u) * (v.x * w.y - v.y * w.x) - square(v) * (u.x * w.y - u.y * w.x) +
                            square(w) * (u.x * v.y - u.y * v.x);
      ASSERT_LE(inside, 0);
    }
  }
}

TEST(Roads, AreEdgesOfTheNetwork) {
  const Terrain terrain = lattice::rough(12, 12, 4, 5);
  const Mesh grid = reference_mesh(terrain);
  // Off the samples, through samples, and with a common corner.
  const double s = terrain.spacing_m;
  const std::vector<std::vector<Vec3>> roads{
      {{0.3 * s, 2.5 * s, 1}, {5.5 * s, 6.25 * s, 1}, {10.5 * s, 3 * s, 1}},
      {{1 * s, 9 * s, 1}, {4 * s, 9 * s, 1}, {5.5 * s, 6.25 * s, 1}}};
  const Tin made = delaunay_tin(grid.positions, roads);
  EXPECT_DOUBLE_EQ(double_area(made.mesh), 2 * terrain.width_m() * terrain.depth_m());
  const Adjacency adjacency(made);
  // Every point along a road lies on a road edge.
  for (const auto& road : roads) {
    for (std::size_t k = 0; k + 1 < road.size(); ++k) {
      double covered_m = 0;
      const Vec3 along = road[k + 1] - road[k];
      for (const Edge& e : made.roads) {
        const Vec3 p = made.mesh.positions[e[0]], q = made.mesh.positions[e[1]];
        const auto offset = [&](Vec3 v) {
          return ((v.x - road[k].x) * along.x + (v.y - road[k].y) * along.y) /
                 (along.x * along.x + along.y * along.y);
        };
        const auto beside = [&](Vec3 v) {
          return std::abs((v.x - road[k].x) * along.y - (v.y - road[k].y) * along.x);
        };
        if (beside(p) > 1e-9 || beside(q) > 1e-9) continue;  // square metres; rounding only
        covered_m += std::abs(offset(q) - offset(p));
      }
      EXPECT_NEAR(covered_m, 1, 1e-12);
    }
  }
  std::size_t road_edges = 0;
  for (std::uint32_t e = 0; e < adjacency.edges().size(); ++e) road_edges += adjacency.is_road(e) ? 1 : 0;
  EXPECT_EQ(road_edges, made.roads.size());
  // 5·s·(0…) passes three samples between (1, 9) and (4, 9): three edges there.
  EXPECT_EQ(made.roads.size(), 3U + 3U);
}

TEST(Delaunay, RefusesWhatMakesNoNetwork) {
  EXPECT_THAT(error_of([] {
                delaunay_tin(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, {});
              }),
              HasSubstr("three"));
  EXPECT_THAT(error_of([] {
                delaunay_tin(std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {2, 2, 5}, {7, 7, 1}}, {});
              }),
              HasSubstr("one line"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of([&] {
                delaunay_tin(std::vector<Vec3>{{0, 0, 0}, {1, 0, nan}, {0, 1, 0}}, {});
              }),
              HasSubstr("finite"));
  const std::vector<Vec3> square{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
  const std::vector<std::vector<Vec3>> crossing{{{1, 1, 0}, {8, 8, 0}}, {{1, 8, 0}, {8, 1, 0}}};
  EXPECT_THAT(error_of([&] { delaunay_tin(square, crossing); }), HasSubstr("cross"));
}

TEST(Adjacency, CountsWhatEulerSays) {
  const Terrain terrain = lattice::rough(7, 5, 1, 5);
  const Tin made = grid_tin(terrain);
  const Adjacency adjacency(made);
  const std::size_t vertices = made.mesh.positions.size(), triangles = made.mesh.triangles.size();
  EXPECT_EQ(adjacency.edges().size(), vertices + triangles - 1);
  std::size_t border = 0;
  for (std::uint32_t e = 0; e < adjacency.edges().size(); ++e) border += adjacency.is_border(e) ? 1 : 0;
  EXPECT_EQ(border, 2U * (6 + 4));
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto i = static_cast<int>(v) % 7, j = static_cast<int>(v) / 7;
    EXPECT_EQ(adjacency.is_border_vertex(v), i == 0 || i == 6 || j == 0 || j == 4);
    for (const std::uint32_t e : adjacency.edges_at(v)) {
      const Edge ends = adjacency.edges()[e];
      EXPECT_TRUE(ends[0] == v || ends[1] == v);
    }
    for (const std::uint32_t t : adjacency.triangles_at(v)) {
      const auto& corners = made.mesh.triangles[t];
      EXPECT_NE(std::find(corners.begin(), corners.end(), v), corners.end());
    }
  }
  EXPECT_TRUE(adjacency.joined_on_border(0, 1));
  EXPECT_FALSE(adjacency.joined_on_border(0, 8)) << "the cell's diagonal";
  EXPECT_FALSE(adjacency.joined_on_border(1, 7)) << "both on the border, not joined";
}

TEST(PlanOrientation, IsExactWherePlainDoublesAreNot) {
  // Points of one line through (0.1, 0.1)-like coordinates: the plain determinant is noise there.
  Random random(4);
  int exact_needed = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 a{random.between(0.5, 0.5 + 0x1p-40), random.between(0.5, 0.5 + 0x1p-40), 0};
    const Vec3 b{12, 12, 0}, c{24, 24, 0};
    const int turn = plan_orientation(a, b, c);
    EXPECT_EQ(turn, a.x < a.y ? 1 : a.x > a.y ? -1 : 0);
    EXPECT_EQ(plan_orientation(b, c, a), turn);
    EXPECT_EQ(plan_orientation(b, a, c), -turn);
    const double plain = (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
    exact_needed += (plain > 0) - (plain < 0) != turn ? 1 : 0;
  }
  EXPECT_GT(exact_needed, 0);
}

}  // namespace
}  // namespace plumbline::tin
