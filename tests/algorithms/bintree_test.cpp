// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The right-triangle bintree's geometry, checked against a plain recursion from the root triangles.
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/bintree/cluster_grid.h"
#include "algorithms/bintree/sweep.h"
#include "lattice.h"
#include "scenarios/error.h"

namespace plumbline::bintree {
namespace {

using ::testing::HasSubstr;
using Key = std::pair<int, int>;

struct Met {
  int level = -1;
  std::vector<RightTriangle> triangles;
};

void recurse(const RightTriangle& t, int level, int levels, std::map<Key, Met>& met,
             std::vector<int>& per_level) {
  ++per_level[static_cast<std::size_t>(level)];
  if (level == levels) return;
  const GridPoint node = t.split_node();
  met[{node.i, node.j}].level = level;
  met[{node.i, node.j}].triangles.push_back(t);
  recurse(t.left_half(node), level + 1, levels, met, per_level);
  recurse(t.right_half(node), level + 1, levels, met, per_level);
}

struct Whole {
  std::map<Key, Met> met;
  std::vector<int> per_level;
};

Whole whole(const ClusterGrid& grid) {
  Whole out;
  out.per_level.assign(static_cast<std::size_t>(grid.levels()) + 1, 0);
  for (int b = 0; b < grid.cluster_rows(); ++b) {
    for (int a = 0; a < grid.cluster_columns(); ++a) {
      for (const RightTriangle& half : grid.halves(grid.root(a, b)))
        recurse(half, 0, grid.levels(), out.met, out.per_level);
    }
  }
  return out;
}

bool has(const PointList& list, GridPoint p) { return std::find(list.begin(), list.end(), p) != list.end(); }

TEST(ClusterGrid, LevelLHasTwoToTheLPlusOneTriangles) {
  const Terrain terrain = lattice::flat(17, 17);
  const Whole tree = whole(ClusterGrid(terrain, 0, "test"));
  for (std::size_t level = 0; level < tree.per_level.size(); ++level) {
    EXPECT_EQ(tree.per_level[level], 2 << level) << "level " << level;
  }
}

TEST(ClusterGrid, RootDiagonalRunsFromSouthWestToNorthEast) {
  const Terrain terrain = lattice::flat(9, 9);
  const ClusterGrid grid(terrain, 0, "test");
  const auto halves = grid.halves(grid.root(0, 0));
  EXPECT_EQ(halves[0].apex, (GridPoint{8, 0}));
  EXPECT_EQ(halves[1].apex, (GridPoint{0, 8}));
  for (const RightTriangle& t : halves) {
    EXPECT_EQ(std::min(t.left.i, t.right.i), 0);
    EXPECT_EQ(t.left.i, t.left.j);
    EXPECT_EQ(t.right.i, t.right.j);
  }
}

// Closed forms (level, diamond, parents, children) against the recursion, over several clusters.
TEST(ClusterGrid, ClosedFormsAgreeWithTheRecursion) {
  for (const auto& [columns, rows, cluster] :
       {std::tuple{17, 17, 0.0}, std::tuple{17, 9, 0.0}, std::tuple{25, 17, 9.0}, std::tuple{3, 3, 0.0}}) {
    const Terrain terrain = lattice::flat(columns, rows, 2.5);
    const ClusterGrid grid(terrain, cluster, "test");
    const Whole tree = whole(grid);
    int nodes = 0;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const GridPoint p{i, j};
        const auto found = tree.met.find({i, j});
        ASSERT_EQ(grid.is_split_node(p), found != tree.met.end()) << i << "," << j;
        if (found == tree.met.end()) continue;
        ++nodes;
        const Met& met = found->second;
        ASSERT_EQ(grid.level(p), met.level) << i << "," << j;
        const Diamond diamond = grid.diamond(p);
        ASSERT_EQ(static_cast<std::size_t>(diamond.apexes.count), met.triangles.size());
        for (const RightTriangle& t : met.triangles) {
          EXPECT_TRUE(has(diamond.apexes, t.apex));
          EXPECT_TRUE((t.left == diamond.left && t.right == diamond.right) ||
                      (t.left == diamond.right && t.right == diamond.left));
          if (met.level > 0) {
            EXPECT_TRUE(has(grid.parents(p), t.apex));
            EXPECT_TRUE(has(grid.children(t.apex), p));
          }
          const double d = std::hypot((t.left.i - t.right.i) * 2.5, (t.left.j - t.right.j) * 2.5);
          EXPECT_NEAR(grid.hypotenuse_m(met.level), d, 1e-12 * d);
        }
        if (met.level == 0) {
          EXPECT_EQ(grid.parents(p).count, 0);
        }
        for (const GridPoint child : grid.children(p)) {
          EXPECT_EQ(grid.level(child), met.level + 1);
          EXPECT_TRUE(has(grid.parents(child), p));
        }
      }
    }
    EXPECT_EQ(static_cast<std::size_t>(nodes), tree.met.size());
  }
}

TEST(ClusterGrid, HalvesAreCounterClockwiseAtEverySquare) {
  const Terrain terrain = lattice::flat(17, 17);
  const ClusterGrid grid(terrain, 0, "test");
  for (const auto& [key, met] : whole(grid).met) {
    if (met.level % 2 != 0) continue;
    for (const RightTriangle& t : grid.halves({key.first, key.second})) {
      EXPECT_GT(
          (t.left.i - t.apex.i) * (t.right.j - t.apex.j) - (t.left.j - t.apex.j) * (t.right.i - t.apex.i), 0);
    }
  }
}

TEST(SweepBottomUp, VisitsEveryNodeOnceAfterItsChildren) {
  for (const auto& [columns, rows, cluster] :
       {std::tuple{17, 17, 0.0}, std::tuple{17, 25, 0.0}, std::tuple{17, 9, 5.0}, std::tuple{3, 3, 0.0}}) {
    const Terrain terrain = lattice::flat(columns, rows);
    const ClusterGrid grid(terrain, cluster, "test");
    std::vector<int> seen(grid.samples(), 0);
    std::size_t visits = 0;
    const auto width = static_cast<std::size_t>(columns);
    const auto point = [width](std::size_t k) {
      return GridPoint{static_cast<int>(k % width), static_cast<int>(k / width)};
    };
    sweep_bottom_up(grid, [&](const SweepNode& s) {
      ++visits;
      EXPECT_EQ(seen[s.node]++, 0);
      const GridPoint p = point(s.node);
      EXPECT_EQ(s.at, p);
      EXPECT_EQ(s.level, grid.level(p));
      const Diamond diamond = grid.diamond(p);
      EXPECT_TRUE(point(s.left) == diamond.left && point(s.right) == diamond.right);
      ASSERT_EQ(s.apex_count, diamond.apexes.count);
      for (int a = 0; a < s.apex_count; ++a) {
        EXPECT_TRUE(has(diamond.apexes, point(s.apexes[static_cast<std::size_t>(a)])));
      }
      ASSERT_EQ(s.child_count, grid.children(p).count);
      for (int c = 0; c < s.child_count; ++c) {
        const std::size_t child = s.children[static_cast<std::size_t>(c)];
        EXPECT_EQ(seen[child], 1);
        EXPECT_TRUE(has(grid.children(p), point(child)));
      }
    });
    std::size_t nodes = 0;
    for (std::size_t k = 0; k < grid.samples(); ++k) nodes += grid.is_split_node(point(k));
    EXPECT_EQ(visits, nodes);
  }
}

TEST(LevelOrder, NumbersEverySampleOnceCoarseLevelsFirst) {
  for (const auto& [columns, rows, cluster] :
       {std::tuple{17, 17, 0.0}, std::tuple{17, 25, 0.0}, std::tuple{25, 9, 3.0}, std::tuple{3, 3, 0.0}}) {
    const Terrain terrain = lattice::flat(columns, rows);
    const ClusterGrid grid(terrain, cluster, "test");
    const LevelOrder order(grid);
    std::vector<int> level_of(order.size(), -1);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const GridPoint p{i, j};
        const int level = grid.is_split_node(p) ? grid.level(p) : grid.levels();
        ASSERT_LT(order.index(p), order.size());
        EXPECT_EQ(order.index(p), order.index(p, level));
        EXPECT_EQ(std::exchange(level_of[order.index(p)], level), -1) << i << "," << j;
      }
    }
    std::erase(level_of, -1);
    EXPECT_EQ(level_of.size(), grid.samples());
    EXPECT_TRUE(std::is_sorted(level_of.begin(), level_of.end()));
  }
}

void samples_below(const Terrain& terrain, const RightTriangle& t, int level, int levels,
                   std::vector<Vec3>& out) {
  for (const GridPoint p : {t.apex, t.left, t.right}) out.push_back(terrain.point(p.i, p.j));
  if (level == levels) return;
  samples_below(terrain, t.left_half(t.split_node()), level + 1, levels, out);
  samples_below(terrain, t.right_half(t.split_node()), level + 1, levels, out);
}

TEST(DiamondRadii, HoldEverySampleOfTheDiamond) {
  const Terrain terrain = lattice::rough(17, 17, 3, 40);
  const ClusterGrid grid(terrain, 0, "test");
  const LevelOrder order(grid);
  const std::vector<double> radii_m = diamond_radii_m(terrain, grid, order);
  constexpr double kRounding = 1e-12;  // relative: a square root of a sum of two squares
  for (const auto& [key, met] : whole(grid).met) {
    const GridPoint node{key.first, key.second};
    for (const RightTriangle& t : met.triangles) {
      std::vector<Vec3> samples;
      samples_below(terrain, t, met.level, grid.levels(), samples);
      for (const Vec3 p : samples) {
        EXPECT_LE(length(p - terrain.point(node.i, node.j)), radii_m[order.index(node)] * (1 + kRounding));
      }
    }
  }
}

TEST(ClusterGrid, RefusesSizesWithoutABintree) {
  const auto message = [](int columns, int rows, double cluster) -> std::string {
    try {
      const Terrain terrain = lattice::flat(columns, rows);
      (void)ClusterGrid(terrain, cluster, "block_bintree");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message(402, 344, 0), HasSubstr("size = 513"));
  EXPECT_THAT(message(2, 2, 0), HasSubstr("block_bintree: terrain of 2 x 2"));
  EXPECT_THAT(message(1, 1, 0), HasSubstr("no cell"));
  EXPECT_THAT(message(17, 17, 6), HasSubstr("cluster_size = 6"));
  EXPECT_THAT(message(17, 17, -3), HasSubstr("cluster_size = -3"));
  EXPECT_THAT(message(17, 17, 1e300), HasSubstr("cluster_size"));
  EXPECT_THAT(message(17, 9, 17), HasSubstr("the largest that does has 9"));
  EXPECT_EQ(message(17, 9, 0), "");
  EXPECT_EQ(message(17, 9, 3), "");
}

}  // namespace
}  // namespace plumbline::bintree
