// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/border.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/faults/sound_meshes.h"
#include "scenarios/random.h"

namespace plumbline::oracle {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

/// 3 ---- 2    A square of two triangles; vertex k + 4 stands below vertex k, `deep` metres.
/// |    / |    Walls hang from the sides that `skirted` names: side k runs from vertex k to k + 1.
/// |  /   |
/// 0 ---- 1
Mesh skirted_square(const std::vector<std::uint32_t>& skirted, std::array<double, 4> deep = {1, 1, 1, 1}) {
  Mesh mesh;
  mesh.positions = {{0, 0, 10}, {4, 0, 11}, {4, 4, 12}, {0, 4, 13}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 p = mesh.positions[k];
    mesh.positions.push_back({p.x, p.y, p.z - deep[k]});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const std::uint32_t a : skirted) {
    const std::uint32_t b = (a + 1) % 4;
    mesh.triangles.push_back({a, a + 4, b + 4});
    mesh.triangles.push_back({a, b + 4, b});
  }
  return mesh;
}

Border border_of(const Mesh& mesh, std::span<const Vec3> normals = {}) {
  return border_of(mesh, take_walls_off(mesh), normals);
}

/// The edge of the border from vertex a to vertex b.
BorderEdge edge_of(const Border& border, std::uint32_t a, std::uint32_t b) {
  for (const BorderEdge& edge : border.edges) {
    if (edge.vertices == std::array{a, b}) return edge;
  }
  ADD_FAILURE() << "no border edge from " << a << " to " << b;
  return {};
}

/// Plan and heights of all edges, sorted: what does not depend on numbering.
using Places = std::vector<std::array<double, 6>>;
Places places(const Border& border) {
  Places out;
  for (const BorderEdge& e : border.edges)
    out.push_back({e.plan[0].x, e.plan[0].y, e.height[0].low, e.plan[1].x, e.plan[1].y, e.height[1].low});
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Walls, AreTakenOffAndTheSurfaceKeepsItsNumbers) {
  const Mesh mesh = skirted_square({0, 1, 2, 3});
  const Sheet sheet = take_walls_off(mesh);
  EXPECT_EQ(sheet.surface.positions, mesh.positions);
  EXPECT_THAT(sheet.triangle_of, ElementsAre(0, 1));
  EXPECT_THAT(sheet.walls, ElementsAre(2, 3, 4, 5, 6, 7, 8, 9));
  Mesh walls_first = mesh;
  std::rotate(walls_first.triangles.begin(), walls_first.triangles.begin() + 2, walls_first.triangles.end());
  EXPECT_THAT(take_walls_off(walls_first).triangle_of, ElementsAre(8, 9));
  EXPECT_THAT(take_walls_off(walls_first).surface.triangles,
              ElementsAre(mesh.triangles[0], mesh.triangles[1]));
}

TEST(Walls, HaveAVerticalSideToTheLastBit) {
  const auto is_wall = [](Vec3 a, Vec3 b, Vec3 c) {
    return take_walls_off({{a, b, c}, {{0, 1, 2}}}).walls.size() == 1;
  };
  EXPECT_TRUE(is_wall({0, 0, 0}, {1, 0, 0}, {1, 0, -5}));
  EXPECT_TRUE(is_wall({0, 0, 0}, {1, 3, 0}, {0, 0, 1e-300}));
  EXPECT_TRUE(is_wall({0.1, 0.7, 0}, {0.1, 0.7, up(0)}, {0.3, 0.2, 9}));
  EXPECT_FALSE(is_wall({0, 0, 0}, {1, 0, 0}, {up(1), 0, -5})) << "an ulp aside";
  EXPECT_FALSE(is_wall({0, 0, 0}, {2, 6, 0}, {1, 3, 1})) << "flat in plan, but no side is upright";
  EXPECT_FALSE(is_wall({0, 0, 0}, {0, 0, 1}, {0, 0, 2})) << "over one plan point";
  EXPECT_FALSE(is_wall({0, 0, 0}, {0, 0, 0}, {0, 0, 1})) << "a place twice";
  EXPECT_FALSE(is_wall({0, 0, 0}, {-0.0, 0, 0}, {1, 0, 1})) << "a place twice, with a signed zero";
}

TEST(Walls, WhatIsBrokenStaysInTheSurface) {
  Mesh mesh = skirted_square({0});
  mesh.triangles.push_back({0, 4, 99});
  mesh.positions.push_back({0, 0, std::numeric_limits<double>::quiet_NaN()});
  mesh.triangles.push_back({0, 1, 8});
  const Sheet sheet = take_walls_off(mesh);
  EXPECT_THAT(sheet.walls, ElementsAre(2, 3));
  EXPECT_THAT(sheet.triangle_of, ElementsAre(0, 1, 4, 5));
  EXPECT_THAT(border_of(mesh).edges, SizeIs(4)) << "and bounds nothing";
}

TEST(BorderOf, RunsWithTheSurfaceToItsLeft) {
  const Mesh mesh = skirted_square({});
  const std::vector<Vec3> normals{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0.6, 0.8}};
  std::vector<Vec3> all = normals;
  all.resize(8);
  const Border border = border_of(mesh, all);
  ASSERT_THAT(border.edges, SizeIs(4));
  EXPECT_EQ(border.low, (Vec2{0, 0}));
  EXPECT_EQ(border.high, (Vec2{4, 4}));
  for (const std::uint32_t a : {0u, 1u, 2u, 3u}) {
    const std::uint32_t b = (a + 1) % 4;
    const BorderEdge edge = edge_of(border, a, b);
    EXPECT_EQ(edge.plan[0], (Vec2{mesh.positions[a].x, mesh.positions[a].y}));
    EXPECT_EQ(edge.plan[1], (Vec2{mesh.positions[b].x, mesh.positions[b].y}));
    EXPECT_EQ(edge.height[0].metres(), 10.0 + a);
    EXPECT_EQ(edge.height[1].metres(), 10.0 + b);
    EXPECT_EQ(edge.triangle, a < 2 ? 0u : 1u);
    EXPECT_EQ(edge.normal[0], normals[a]);
    EXPECT_EQ(edge.normal[1], normals[b]);
    EXPECT_FALSE(edge.has_skirt);
  }
  EXPECT_EQ(border_of(mesh).edges.at(0).normal[0], (Vec3{})) << "none were given";
}

TEST(BorderOf, SkirtsAreMeasuredWhereTheyHang) {
  const Mesh all = skirted_square({0, 1, 2, 3}, {1, 2, 3, 4});
  for (const BorderEdge& edge : border_of(all).edges) {
    EXPECT_TRUE(edge.has_skirt);
    for (const std::size_t k : {0u, 1u}) {
      const std::uint32_t v = edge.vertices[k];
      EXPECT_EQ(edge.foot[k].metres(), all.positions[v + 4].z) << v;
    }
  }
  // On part of the border: the vertices that these sides share with others make those no skirt.
  const Border part = border_of(skirted_square({0, 2}));
  EXPECT_TRUE(edge_of(part, 0, 1).has_skirt);
  EXPECT_FALSE(edge_of(part, 1, 2).has_skirt);
  EXPECT_TRUE(edge_of(part, 2, 3).has_skirt);
  EXPECT_FALSE(edge_of(part, 3, 0).has_skirt);
}

TEST(BorderOf, ADeeperSkirtRoundTheCornerLendsNoDepth) {
  // Side 0 goes down by 1 at both ends; side 1, from the same vertex 1, by 100.
  Mesh mesh = skirted_square({0});
  mesh.positions.push_back({4, 0, 11 - 100.0});
  mesh.positions.push_back({4, 4, 12 - 100.0});
  mesh.triangles.push_back({1, 8, 9});
  mesh.triangles.push_back({1, 9, 2});
  const Border border = border_of(mesh);
  EXPECT_EQ(edge_of(border, 0, 1).foot[1].metres(), 10);
  EXPECT_EQ(edge_of(border, 1, 2).foot[0].metres(), -89);
  EXPECT_EQ(edge_of(border, 1, 2).foot[1].metres(), -88);
}

TEST(BorderOf, HalfASkirtIsNone) {
  // The square of the skirt has two triangles; without either, light comes through.
  for (const std::size_t lost : {0u, 1u}) {
    Mesh mesh = skirted_square({3, 0, 1});
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(4 + lost));
    const Border border = border_of(mesh);
    EXPECT_FALSE(edge_of(border, 0, 1).has_skirt) << lost;
    EXPECT_TRUE(edge_of(border, 3, 0).has_skirt);
    EXPECT_TRUE(edge_of(border, 1, 2).has_skirt);
  }
}

TEST(BorderOf, TheDeepestOfTwoSkirtsCounts) {
  // A second pair of walls from the first one's foot, 10 deeper, which end a little beside: not below.
  Mesh mesh = skirted_square({0});
  mesh.positions.insert(mesh.positions.end(), {{0, 0, -1}, {4, 0, -2}});
  mesh.triangles.insert(mesh.triangles.end(), {{4, 8, 9}, {4, 9, 5}});
  EXPECT_EQ(edge_of(border_of(mesh), 0, 1).foot[0].metres(), -1);
  EXPECT_EQ(edge_of(border_of(mesh), 0, 1).foot[1].metres(), -2);
  mesh.positions[8].x = mesh.positions[9].x = 2;
  EXPECT_EQ(edge_of(border_of(mesh), 0, 1).foot[0].metres(), 9);
}

TEST(BorderOf, WallsThatStandElsewhereAreNoSkirt) {
  // A fence across the square, a wall beside it, one on top of its side: none hangs from the border.
  Mesh mesh = skirted_square({});
  mesh.positions.insert(mesh.positions.end(), {{0, 0, 20}, {4, 0, 20}, {1, 1, 0}, {3, 3, 0}, {3, 3, -9}});
  mesh.triangles.insert(mesh.triangles.end(), {{10, 11, 12}, {0, 1, 9}, {0, 9, 8}});
  EXPECT_THAT(take_walls_off(mesh).walls, SizeIs(3));
  for (const BorderEdge& edge : border_of(mesh).edges) EXPECT_FALSE(edge.has_skirt);
}

TEST(BorderOf, CliffsAreBordersOnBothSides) {
  // Two squares side by side, the second 5 lower, a wall between: the wall hangs from the upper edge.
  //   y
  //   4  3 ---- 2/6 ---- 5
  //   0  0 ---- 1/7 ---- 4
  Mesh mesh;
  mesh.positions = {{0, 0, 5}, {4, 0, 5}, {4, 4, 5}, {0, 4, 5}, {8, 0, 0}, {8, 4, 0}, {4, 4, 0}, {4, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {7, 4, 5}, {7, 5, 6}, {1, 7, 6}, {1, 6, 2}};
  const Border border = border_of(mesh);
  EXPECT_THAT(border.edges, SizeIs(8));
  EXPECT_TRUE(edge_of(border, 1, 2).has_skirt);
  EXPECT_EQ(edge_of(border, 1, 2).foot[0].metres(), 0);
  EXPECT_FALSE(edge_of(border, 6, 7).has_skirt);
}

TEST(BorderOf, DoubledVerticesAreOnePlace) {
  // Every triangle with vertices of its own, and grids cut into blocks: the border is that of the grid.
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Mesh grid = faults::random_grid(3 + trial % 7, random).mesh;
    Mesh soup, cut = grid;
    std::vector<std::uint32_t> copy(grid.positions.size(), 0xffffffffu);
    for (auto& corners : cut.triangles) {
      const bool east =
          grid.positions[corners[0]].x + grid.positions[corners[1]].x + grid.positions[corners[2]].x >
          3 * grid.positions[grid.positions.size() / 2].x;
      for (std::uint32_t& v : corners) {
        soup.positions.push_back(grid.positions[v]);
        if (!east) continue;
        if (copy[v] == 0xffffffffu) {
          copy[v] = static_cast<std::uint32_t>(cut.positions.size());
          cut.positions.push_back(grid.positions[v]);
        }
        v = copy[v];
      }
      const auto n = static_cast<std::uint32_t>(soup.positions.size());
      soup.triangles.push_back({n - 3, n - 2, n - 1});
    }
    const Places wanted = places(border_of(grid));
    EXPECT_THAT(wanted, SizeIs(4 * (2 + static_cast<std::size_t>(trial) % 7)));
    EXPECT_EQ(places(border_of(soup)), wanted);
    EXPECT_EQ(places(border_of(cut)), wanted);
    // A vertex of one side lifted: the cut opens along its edges, on both sides.
    for (std::uint32_t v = 0; v < copy.size(); ++v) {
      if (copy[v] == 0xffffffffu) continue;
      cut.positions[copy[v]].z = up(cut.positions[copy[v]].z);
      const Places open = places(border_of(cut));
      EXPECT_GE(open.size(), wanted.size());
      EXPECT_EQ((open.size() - wanted.size()) % 2, 0u);
      break;
    }
  }
}

TEST(BorderOf, DoesNotDependOnTheOrderOfTriangles) {
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const faults::Surface surface = faults::random_bintree(4, random);
    EXPECT_EQ(places(border_of(faults::shuffled(surface, random).mesh)), places(border_of(surface.mesh)));
  }
}

TEST(BorderOf, NothingHasNoBorder) {
  EXPECT_THAT(border_of(Mesh{}).edges, IsEmpty());
  // Closed: none either. Two triangles of one place, back to back.
  const Mesh closed{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(border_of(closed).edges, IsEmpty());
}

TEST(ExactHeight, MeetsTheEndsOfItsRangeExactly) {
  const double low = 0.1, high = 1234.7;
  EXPECT_EQ((ExactHeight{low, high, 0, 0}.metres()), low);
  EXPECT_EQ((ExactHeight{low, high, 32767, 0}.metres()), high);
  EXPECT_EQ((ExactHeight{low, high, 32767, 2}.metres()), high - 2);
  EXPECT_EQ((ExactHeight{0, 32767, 77, 0}.metres()), 77);
  double before = -1;
  for (std::uint32_t step = 0; step <= 32767; ++step) {
    const double z = ExactHeight{low, high, step, 0}.metres();
    EXPECT_GT(z, before);
    before = z;
  }
}

}  // namespace
}  // namespace plumbline::oracle
