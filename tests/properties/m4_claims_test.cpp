// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Suspicions of METHODS M4 that are no laws: what e bounds and what it does not (S3), and what the length
// term costs on a plane (S4). Verdicts and figures: docs/claims.md.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "algorithms/block_bintree/split_function.h"
#include "properties/laws/generators.h"
#include "properties/laws/split_function_laws.h"

namespace plumbline::properties {
namespace {

using bintree::ClusterGrid;
using bintree::GridPoint;
using bintree::RightTriangle;

/// The largest |sample − plane of the triangle| over the samples in a triangle, metres.
double deviation_m(const Terrain& terrain, const RightTriangle& t) {
  const auto area = [](GridPoint a, GridPoint b, GridPoint c) {
    return (b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i);
  };
  const int whole = area(t.apex, t.left, t.right);
  const auto [i0, i1] = std::minmax({t.apex.i, t.left.i, t.right.i});
  const auto [j0, j1] = std::minmax({t.apex.j, t.left.j, t.right.j});
  double largest = 0;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const GridPoint p{i, j};
      const int a = area(p, t.left, t.right), l = area(p, t.right, t.apex), r = area(p, t.apex, t.left);
      if (a < 0 || l < 0 || r < 0) continue;
      const double plane = (a * terrain.z(t.apex.i, t.apex.j) + l * terrain.z(t.left.i, t.left.j) +
                            r * terrain.z(t.right.i, t.right.j)) /
                           whole;
      largest = std::max(largest, std::fabs(terrain.z(i, j) - plane));
    }
  }
  return largest;
}

/// Over all triangles that can be drawn unsplit: how far the samples deviate, against e of the split node
/// left out.
struct Bound {
  int triangles = 0, exceeded = 0;
  double largest_ratio = 0;
};

void compare(const block_bintree::SplitFunction& function, const Terrain& terrain, const RightTriangle& t,
             int level, Bound& bound) {
  if (level == function.grid().levels()) return;
  const GridPoint node = t.split_node();
  const double deviation = deviation_m(terrain, t);
  if (const double e_m = function.e_m(node); e_m > 0) {
    ++bound.triangles;
    bound.exceeded += deviation > e_m ? 1 : 0;
    bound.largest_ratio = std::max(bound.largest_ratio, deviation / e_m);
  } else {
    EXPECT_EQ(deviation, 0) << "e = 0 leaves out nothing";
  }
  compare(function, terrain, t.left_half(node), level + 1, bound);
  compare(function, terrain, t.right_half(node), level + 1, bound);
}

Bound compare_all(const Terrain& terrain) {
  const ClusterGrid grid(terrain, 0, "test");
  const block_bintree::SplitFunction function(terrain, grid, block_bintree::published_constants(0.1));
  Bound bound;
  for (int b = 0; b < grid.cluster_rows(); ++b) {
    for (int a = 0; a < grid.cluster_columns(); ++a) {
      const int side = grid.side(), i = a * side, j = b * side;
      const GridPoint south_west{i, j}, north_east{i + side, j + side};
      compare(function, terrain, {{i + side, j}, north_east, south_west}, 0, bound);
      compare(function, terrain, {{i, j + side}, south_west, north_east}, 0, bound);
    }
  }
  return bound;
}

TEST(M4Claims, M4_S3_eIsNoBoundOnTheDeviation) {
  Bound all;
  for (std::uint64_t k = 0; k < 600; ++k) {
    const Terrain terrain = draw_case("block_bintree", 41, k).input.terrain;
    const Bound bound = compare_all(terrain);
    all.triangles += bound.triangles;
    all.exceeded += bound.exceeded;
    all.largest_ratio = std::max(all.largest_ratio, bound.largest_ratio);
  }
  fmt::print("random terrains: {} of {} triangles deviate by more than e, at most {:.3f} e\n", all.exceeded,
             all.triangles, all.largest_ratio);
  EXPECT_GT(all.triangles, 10000);
  EXPECT_GT(all.exceeded, 0);
  EXPECT_GT(all.largest_ratio, 1.2);
}

/// On a plane two triangles are exact; every other one is the length term's doing.
TEST(M4Claims, M4_S4_ThePlaneIsSplitNearTheCamera) {
  const auto triangles = [](double height_m) {
    LawInput input;
    input.method = "block_bintree";
    input.terrain.columns = input.terrain.rows = 65;
    input.terrain.spacing_m = 10;
    input.terrain.heights_m.assign(65 * 65, 0.0);
    const std::unique_ptr<LodMethod> method = make_method(input.method, {{"cull", false}});
    method->prepare(input.terrain);
    method->set_threshold_px(1e6);
    LodFrame frame;
    method->update(make_camera({320, 320, height_m}, {320, 320, 0}, 60, 1280, 720), frame);
    return frame.mesh.triangles.size();
  };
  for (const double height_m : {10.0, 100.0, 300.0, 1000.0, 3000.0, 9000.0, 10000.0}) {
    fmt::print("plane of 640 m, seen from {:>6} m above, tau = 10^6 px: {} triangles\n", height_m,
               triangles(height_m));
  }
  EXPECT_EQ(triangles(10), 2u * 64 * 64);  // all of them
  EXPECT_GT(triangles(1000), 2u);
  // d = 905 m at the root: from 9051 m on nothing forces a split.
  EXPECT_GT(triangles(9000), 2u);
  EXPECT_EQ(triangles(10000), 2u);
}

}  // namespace
}  // namespace plumbline::properties
