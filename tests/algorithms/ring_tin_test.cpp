// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// M2's rings, levels, frames and options. What the collapses do: collapse_map_test. What is kept: store test.
#include "algorithms/ring_tin/ring_tin.h"

#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "lattice.h"
#include "oracle/conformity.h"
#include "scenarios/error.h"
#include "scenarios/random.h"

namespace plumbline::ring_tin {
namespace {

using ::testing::HasSubstr;
using Refusal = CollapseMap::Refusal;

Camera at(double x, double y, double look_x = 0, double z = 200) {
  return make_camera({x, y, z}, {x + look_x, y + 10, z - 5}, 60, 1280, 720);
}

/// Rings of a few cells around a terrain of 10 m cells.
Settings small_rings(Variant variant) {
  Settings s;
  s.variant = variant;
  s.rings = {{25, 60, 120}, {0, 1, 2}, false};
  s.focal_px = 100;
  return s;
}

Terrain terrain_of(int columns, int rows, std::uint64_t seed, int amplitude) {
  Terrain terrain = lattice::rough(columns, rows, seed, amplitude);
  terrain.spacing_m = 10;
  return terrain;
}

TEST(Rings, Table1) {
  // METHODS M2: the paper's text says d_i is the ring's mean distance; its table fits the outer one alone.
  const Rings rings;
  const std::vector<double> printed_by_pixel{0, 0.46, 1.17, 2.54, 5.86};
  const std::vector<double> printed_equal{0, 0.46, 0.98, 1.95, 3.91};
  Rings equal = rings;
  equal.delta_px = {0, 1, 1, 1, 1};
  constexpr double kFocalPx = 512;
  const auto two_decimals = [](double x) { return std::round(x * 100) / 100; };
  for (int i = 0; i < rings.levels(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i == 1) continue;  // below
    EXPECT_DOUBLE_EQ(two_decimals(rings.tolerance_m(i, 1, kFocalPx)), printed_by_pixel[k]) << "level " << i;
    EXPECT_DOUBLE_EQ(two_decimals(equal.tolerance_m(i, 1, kFocalPx)), printed_equal[k]) << "level " << i;
  }
  // The misprint: 250 · 1.0 / 512 = 0.488, in both columns; the paper prints 0.46.
  EXPECT_DOUBLE_EQ(rings.tolerance_m(1, 1, kFocalPx), 250.0 / 512);
  EXPECT_DOUBLE_EQ(two_decimals(rings.tolerance_m(1, 1, kFocalPx)), 0.49);
  EXPECT_NE(0.49, printed_by_pixel[1]);
  // The mean distance fits no row.
  Rings mean = rings;
  mean.mean_distance = true;
  for (int i = 1; i < rings.levels(); ++i) {
    EXPECT_GT(std::abs(mean.tolerance_m(i, 1, kFocalPx) - printed_by_pixel[static_cast<std::size_t>(i)]),
              0.1);
  }
}

TEST(Rings, AreClosedSquares) {
  const Rings rings{{10, 20}, {0, 1}, false};
  EXPECT_EQ(rings.level({0, 0}, {10, -10}), 0);
  EXPECT_EQ(rings.level({0, 0}, {10.5, 0}), 1);
  EXPECT_EQ(rings.level({5, 5}, {5, -6}), 1);
  EXPECT_EQ(rings.level({0, 0}, {0, 1e9}), 1) << "beyond the last ring: the last level";
  EXPECT_DOUBLE_EQ(rings.tolerance_m(1, 3, 10), 1 * 3 * 20 / 10.0);
}

TEST(VertexLevels, FollowTheViewpointVertexByVertex) {
  const Terrain terrain = terrain_of(60, 45, 3, 5);
  const std::vector<Vec3> points = reference_mesh(terrain).positions;
  const PlanCells cells(points);
  ASSERT_GT(cells.cells.size(), 20U);
  VertexLevels levels(cells, points);
  Random random(2);
  Rings rings{{25, 60, 120}, {0, 1, 2}, false};
  std::vector<int> before(points.size(), 0);
  std::uint64_t visited = 0;
  for (int frame = 0; frame < 200; ++frame) {
    const Vec2 viewpoint{random.between(-200, 800), random.between(-200, 700)};
    if (frame == 120) rings.half_size_m = {40, 90, 300};
    if (frame == 160) rings = {{60, 300}, {0, 1}, false};
    std::vector<std::uint32_t> changed;
    visited += levels.move(viewpoint, rings, changed);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      const int level = rings.level(viewpoint, {points[v].x, points[v].y});
      ASSERT_EQ(levels.level(v), level);
      if (level != before[v]) expected.push_back(v);
      before[v] = level;
    }
    ASSERT_EQ(changed, expected);
  }
  EXPECT_LT(visited, 200U * points.size() * 9 / 10) << "cells that lie in one ring are passed over";
}

class EveryVariant : public ::testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(RingTin, EveryVariant,
                         ::testing::Values(Variant::published, Variant::fixpoint, Variant::guarded),
                         [](const auto& v) {
                           return v.param == Variant::published  ? "published"
                                  : v.param == Variant::fixpoint ? "fixpoint"
                                                                 : "guarded";
                         });

TEST_P(EveryVariant, NearestRingAndBorderStayWhole) {
  const Terrain terrain = terrain_of(40, 30, 1, 8);
  RingTin method(small_rings(GetParam()));
  method.prepare(terrain);
  method.set_threshold_px(20);
  LodFrame frame;
  Random random(7);
  for (int k = 0; k < 30; ++k) {
    const Vec2 p{std::floor(random.between(0, 390)), std::floor(random.between(0, 290))};
    method.update(at(p.x, p.y), frame);
    const std::set<std::uint64_t> keys(frame.vertex_keys.begin(), frame.vertex_keys.end());
    for (int j = 0; j < terrain.rows; ++j) {
      for (int i = 0; i < terrain.columns; ++i) {
        const bool border = i == 0 || j == 0 || i + 1 == terrain.columns || j + 1 == terrain.rows;
        const bool near = std::max(std::abs(i * 10 - p.x), std::abs(j * 10 - p.y)) <= 25;
        if (border || near) {
          EXPECT_TRUE(keys.contains(terrain.index(i, j))) << i << ", " << j;
        }
      }
    }
    EXPECT_LT(frame.mesh.triangles.size(), method.full_tin().mesh.triangles.size());
    EXPECT_EQ(frame.counters.nodes, 40U * 30 + method.prepared().adjacency.edges().size());
  }
}

TEST_P(EveryVariant, TurningOnTheSpotChangesNothing) {
  const Terrain terrain = terrain_of(40, 30, 1, 8);
  RingTin method(small_rings(GetParam()));
  method.prepare(terrain);
  LodFrame frame, turned;
  Random random(8);
  for (int k = 0; k < 20; ++k) {
    const Vec2 p{random.between(0, 390), random.between(0, 290)};
    method.update(at(p.x, p.y), frame);
    for (const double look_x : {-50.0, 0.0, 70.0}) {
      method.update(at(p.x, p.y, look_x, 50 + 10 * k), turned);
      EXPECT_TRUE(lattice::same_mesh(frame, turned));
      EXPECT_EQ(method.statistics().changed, 0U);
      EXPECT_EQ(method.statistics().candidates, 0U);
    }
  }
}

TEST_P(EveryVariant, DepthOfTreesIsCapped) {
  const Terrain terrain = terrain_of(40, 30, 1, 2);
  for (const int cap : {1, 2, 4, 6}) {
    Settings settings = small_rings(GetParam());
    settings.depth_cap = cap;
    RingTin method(settings);
    method.prepare(terrain);
    method.set_threshold_px(100);
    LodFrame frame;
    method.update(at(0, 0), frame);
    int deepest = 0;
    std::vector<std::size_t> members(terrain.heights_m.size(), 0);
    for (std::uint32_t v = 0; v < members.size(); ++v) {
      ++members[method.collapses().rep(v)];
      if (method.collapses().is_live(v)) deepest = std::max(deepest, method.collapses().depth(v));
    }
    EXPECT_EQ(deepest, cap);
    EXPECT_LE(*std::max_element(members.begin(), members.end()), std::size_t{1} << (cap - 1));
    if (cap == 1) {
      EXPECT_EQ(frame.mesh.triangles.size(), method.full_tin().mesh.triangles.size());
    }
  }
}

TEST(Fixpoint, LeavesNoEdgeThatQualifies) {
  const Terrain terrain = terrain_of(40, 30, 5, 8);
  RingTin method(small_rings(Variant::fixpoint));
  RingTin once(small_rings(Variant::published));
  method.prepare(terrain);
  once.prepare(terrain);
  Random random(9);
  std::uint64_t left_over = 0;
  for (int k = 0; k < 40; ++k) {
    LodFrame frame;
    const Camera camera = at(random.between(-50, 450), random.between(-50, 350));
    const double threshold_px = random.between(0.5, 20);
    method.set_threshold_px(threshold_px);  // also the tolerances change, from frame to frame
    once.set_threshold_px(threshold_px);
    method.update(camera, frame);
    EXPECT_EQ(method.count_refused(Refusal::none), 0U);
    once.update(camera, frame);
    left_over += once.count_refused(Refusal::none);
  }
  EXPECT_GT(left_over, 0U) << "one scan does leave some";
}

TEST(Guarded, NeverFolds) {
  int resets = 0, collapses = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Terrain terrain = terrain_of(25, 25, seed, 12);
    RingTin method(small_rings(Variant::guarded));
    method.prepare(terrain);
    Random random(seed);
    LodFrame frame;
    for (int k = 0; k < 15; ++k) {
      method.set_threshold_px(random.between(1, 60));
      method.update(at(random.between(-50, 300), random.between(-50, 300)), frame);
      ASSERT_TRUE(oracle::check_conformity(frame.mesh, frame.domain).clean());
      resets += static_cast<int>(method.statistics().trees_reset);
      collapses += static_cast<int>(method.statistics().collapses);
    }
  }
  EXPECT_GT(resets, 1000);
  EXPECT_GT(collapses, 1000);
}

TEST(RingTin, RingsMayChangeInMidFlight) {
  // After new rings, every vertex stands as its new level asks: what a tree's collapse may not exceed, and in
  // the fixpoint nothing more qualifies.
  const Terrain terrain = terrain_of(40, 30, 5, 8);
  for (const Variant variant : {Variant::published, Variant::fixpoint, Variant::guarded}) {
    RingTin method(small_rings(variant));
    method.prepare(terrain);
    method.set_threshold_px(5);
    LodFrame before, after;
    method.update(at(200, 150), before);
    for (const Rings& rings :
         {Rings{{40, 80}, {0, 0.5}, false}, Rings{{10, 20, 30, 60, 400}, {0, 1, 1, 2, 9}, false},
          Rings{{25, 60, 120}, {0, 1, 2}, true}}) {
      method.set_rings(rings);
      method.update(at(200, 150), after);
      EXPECT_FALSE(lattice::same_mesh(before, after));
      const auto& tolerances_m = method.tolerances_m();
      ASSERT_EQ(tolerances_m.size(), rings.half_size_m.size());
      for (std::uint32_t v = 0; v < terrain.heights_m.size(); ++v) {
        const Vec3 p = method.full_tin().mesh.positions[v];
        ASSERT_EQ(method.level(v), rings.level({200, 150}, {p.x, p.y}));
        const std::uint32_t edge = method.collapses().removed_by(v);
        if (edge == CollapseMap::kNone) continue;
        EXPECT_LE(method.collapses().error_m(edge), tolerances_m[static_cast<std::size_t>(method.level(v))]);
      }
      if (variant == Variant::fixpoint) {
        EXPECT_EQ(method.count_refused(Refusal::none), 0U);
      }
      std::swap(before, after);
    }
  }
}

TEST(RingTin, ThinnedPointsAndRoadsAreCovered) {
  Terrain terrain = terrain_of(30, 30, 5, 8);
  terrain.roads = {{{12, 30}, {100, 110}, {260.5, 170}}, {{100, 110}, {80, 285}}};
  for (const double share : {1.0, 0.4}) {
    for (const char* id : {"ring_tin:guarded", "ring_tin:fixpoint"}) {
      const auto method = make_method(id, {{"point_share", share},
                                           {"rings_m", std::string("25,60,120")},
                                           {"delta_px", std::string("0 1 2")}});
      method->prepare(terrain);
      method->set_threshold_px(20);
      const auto& ring = dynamic_cast<const RingTin&>(*method);
      EXPECT_GE(ring.full_tin().roads.size(), 3U);
      EXPECT_TRUE(oracle::check_conformity(ring.full_tin().mesh, full_domain(terrain)).clean());
      LodFrame frame;
      method->update(at(150, 150), frame);
      EXPECT_LT(frame.mesh.triangles.size(), ring.full_tin().mesh.triangles.size());
      if (std::string(id) == "ring_tin:guarded") {
        EXPECT_TRUE(oracle::check_conformity(frame.mesh, frame.domain).clean());
      }
    }
  }
  terrain.roads = {{{10, 10}, {1000, 10}}};
  RingTin method(small_rings(Variant::published));
  try {
    method.prepare(terrain);
    FAIL() << "a road off the terrain was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("off the terrain"));
  }
}

std::string option_error(const Options& options) {
  try {
    (void)make_method("ring_tin", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Options, BadOnesAreRefusedInOneLine) {
  using std::string;
  const std::vector<std::pair<Options, const char*>> cases{
      {{{"rings_m", string("100 fifty")}}, "no list"},
      {{{"rings_m", string("100 nan")}}, "no list"},
      {{{"rings_m", string("100 -5")}}, "no list"},
      {{{"rings_m", string("")}}, "0 half sizes"},
      {{{"rings_m", string("100 100")}, {"delta_px", string("0 1")}}, "rising"},
      {{{"rings_m", string("0 100")}, {"delta_px", string("0 1")}}, "rising"},
      {{{"rings_m", string("100 200")}}, "one a ring"},
      {{{"depth_cap", 0.0}}, "depth_cap"},
      {{{"depth_cap", 2.5}}, "depth_cap"},
      {{{"depth_cap", 1e9}}, "depth_cap"},
      {{{"focal_px", -1.0}}, "focal_px"},
      {{{"point_share", 1.5}}, "point_share"},
      {{{"point_seed", 0.5}}, "point_seed"},
      {{{"rings", string("1 2")}}, "rings_m"},
  };
  for (const auto& [options, expected] : cases) {
    const std::string error = option_error(options);
    EXPECT_THAT(error, HasSubstr(expected));
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
  EXPECT_EQ(option_error({{"rings_m", string("10, 20.5 ,1e3")}, {"delta_px", string("0 1 2")}}), "");
}

}  // namespace
}  // namespace plumbline::ring_tin
