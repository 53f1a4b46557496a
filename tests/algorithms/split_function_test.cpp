// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// M4.C2, M4.C3 and M4.S1, node by node over the whole split-node graph.
#include <gtest/gtest.h>

#include "algorithms/block_bintree/block_bintree.h"
#include "algorithms/registry.h"
#include "lattice.h"
#include "oracle/conformity.h"

namespace plumbline::block_bintree {
namespace {

template <class Visit>
void every_node(const ClusterGrid& grid, Visit&& visit) {
  for (int j = 0; j < grid.rows(); ++j) {
    for (int i = 0; i < grid.columns(); ++i) {
      if (grid.is_split_node({i, j})) visit(GridPoint{i, j});
    }
  }
}

/// Nodes that split while a parent does not; and how many nodes with a parent split, so that no pass is
/// vacuous.
struct Monotony {
  int violations = 0;
  int judged = 0;
};

Monotony check_monotony(const SplitFunction& f, const Camera& camera, double threshold_px) {
  Monotony out;
  const SplitFunction::Frame frame = f.frame(camera, threshold_px);
  every_node(f.grid(), [&](GridPoint node) {
    if (!f.splits(frame, node, f.grid().level(node))) return;
    for (const GridPoint parent : f.grid().parents(node)) {
      ++out.judged;
      if (!f.splits(frame, parent, f.grid().level(parent))) ++out.violations;
    }
  });
  return out;
}

/// Scales the heights so that the steepest slope of the node graph becomes `slope`.
Terrain with_slope(Terrain terrain, double slope) {
  const ClusterGrid grid(terrain, 0, "test");
  const double factor = slope / steepest_slope(terrain, grid);
  for (double& z : terrain.heights_m) z *= factor;
  return terrain;
}

// METHODS M4.S1: spacing 10 m, z = 11·i, plus 3 m at node (2,1).
Terrain s1_terrain() {
  Terrain terrain = lattice::flat(5, 5, 10);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) terrain.heights_m[terrain.index(i, j)] = 11 * i;
  }
  terrain.heights_m[terrain.index(2, 1)] += 3;
  return terrain;
}

/// Looking straight down from (20, 20, 304) with κ = 93 px, so that κ/τ = 93 at τ = 1 px.
Camera s1_camera() {
  Camera camera = make_camera({20, 20, 304}, {20, 20, 0}, 90, 186, 186);
  camera.kappa_px = 93;
  return camera;
}

TEST(SplitFunction, M4_S1_TheSteepFiveByFiveCaseBreaksMonotony) {
  const Terrain terrain = s1_terrain();
  const ClusterGrid grid(terrain, 0, "test");
  const SplitFunction f(terrain, grid, published_constants(0.1));
  const Camera camera = s1_camera();
  const GridPoint child{2, 1}, parent{1, 1}, other_parent{3, 1};
  EXPECT_TRUE(grid.parents(child).count == 2 && grid.parents(child).points[0] == parent &&
              grid.parents(child).points[1] == other_parent);
  EXPECT_EQ(f.e_m(child), 3);
  EXPECT_EQ(camera.depth(f.point(child)), 279);
  EXPECT_TRUE(f.splits(child, camera, 1));
  EXPECT_EQ(f.deviation_m(parent), 0);
  EXPECT_DOUBLE_EQ(f.e_m(parent), 3.15);
  EXPECT_EQ(camera.depth(f.point(parent)), 293);
  EXPECT_FALSE(f.splits(parent, camera, 1));
  EXPECT_TRUE(f.splits(other_parent, camera, 1));
}

TEST(SplitFunction, M4_S1_TheMeshHasATJunctionWithAGapOfThreeMetres) {
  const Terrain terrain = s1_terrain();
  const auto method = make_method("block_bintree");
  method->prepare(terrain);
  method->set_threshold_px(1);
  LodFrame frame;
  method->update(s1_camera(), frame);
  const lattice::Faults faults = lattice::look_at(terrain, frame);
  EXPECT_EQ(faults.t_junctions, 1);
  EXPECT_EQ(faults.largest_gap_m, 3);
  EXPECT_EQ(faults.turned, 0);
  EXPECT_EQ(faults.double_area, lattice::double_area(terrain));

  const oracle::ConformityReport report = oracle::check_conformity(frame.mesh, frame.domain);
  EXPECT_EQ(report.counts.t_junction, 1U);
  EXPECT_EQ(report.counts.crack, 1U);
  EXPECT_EQ(report.largest_gap_m, 3);
  ASSERT_FALSE(report.findings.empty());
  EXPECT_EQ(report.findings.front().at, terrain.point(2, 1));

  const auto repaired = make_method("block_bintree:repaired");
  repaired->prepare(terrain);
  repaired->update(s1_camera(), frame);
  EXPECT_EQ(lattice::look_at(terrain, frame).t_junctions, 0);
  EXPECT_TRUE(oracle::check_conformity(frame.mesh, frame.domain).clean());
}

TEST(SplitFunction, M4_C2_EIsMonotoneOverTheGraph) {
  int judged = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const double relief_m : {0.0, 1.0, 200.0}) {
      const Terrain terrain = lattice::rough(33, 17, seed, relief_m);
      const ClusterGrid grid(terrain, 0, "test");
      const SplitFunction f(terrain, grid, published_constants(0.1));
      every_node(grid, [&](GridPoint node) {
        EXPECT_GE(f.e_m(node), f.deviation_m(node));
        double expected = f.deviation_m(node);
        for (const GridPoint child : grid.children(node)) {
          ++judged;
          EXPECT_GE(f.e_m(node), f.constants().saturation * f.e_m(child));
          expected = std::max(expected, f.constants().saturation * f.e_m(child));
        }
        EXPECT_EQ(f.e_m(node), expected);  // and no larger than it must be
      });
    }
  }
  EXPECT_GT(judged, 1000);
}

TEST(SplitFunction, M4_C3_SplitTestIsMonotoneBelow42Degrees) {
  Random random(5);
  int judged = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Terrain terrain = with_slope(lattice::rough(33, 33, seed, 20), 0.9);
    const ClusterGrid grid(terrain, 0, "test");
    const SplitFunction f(terrain, grid, published_constants(0.1));
    for (int k = 0; k < 60; ++k) {
      const Monotony m = check_monotony(f, lattice::any_camera(random, terrain), random.between(0.2, 200));
      EXPECT_EQ(m.violations, 0) << "seed " << seed << " camera " << k;
      judged += m.judged;
    }
  }
  EXPECT_GT(judged, 10000);
}

// The published test fails on steep terrain, the repaired one never: also where no q alone would do (slope
// over 8.2).
TEST(SplitFunction, M4_C3_RepairedHoldsWherePublishedFails) {
  Random random(6);
  int published_violations = 0, judged = 0;
  for (const double slope : {1.5, 3.0, 8.0, 20.0, 300.0}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Terrain terrain = with_slope(lattice::rough(33, 33, seed, 20), slope);
      const ClusterGrid grid(terrain, 0, "test");
      const SplitFunction published(terrain, grid, published_constants(0.1));
      const SplitFunction repaired(terrain, grid, repaired_constants(0.1, steepest_slope(terrain, grid)));
      for (int k = 0; k < 60; ++k) {
        const Camera camera = lattice::any_camera(random, terrain);
        const double threshold_px = random.between(0.2, 400);
        published_violations += check_monotony(published, camera, threshold_px).violations;
        const Monotony m = check_monotony(repaired, camera, threshold_px);
        EXPECT_EQ(m.violations, 0) << "slope " << slope << " seed " << seed << " camera " << k;
        judged += m.judged;
      }
    }
  }
  EXPECT_GT(published_violations, 0);
  EXPECT_GT(judged, 10000);
}

TEST(SplitFunction, M4_C3_ThePublishedConstantSufficesUpToSlope0902) {
  // q = 1 + ε/2 against the bound 1/(1 − ε·sqrt(1+s²)/(2√2)): they meet at s = 0.9023 for ε = 0.1.
  EXPECT_EQ(repaired_constants(0.1, 0.0).saturation, published_constants(0.1).saturation);
  EXPECT_EQ(repaired_constants(0.1, 0.902).saturation, published_constants(0.1).saturation);
  EXPECT_GT(repaired_constants(0.1, 0.903).saturation, published_constants(0.1).saturation);
}

TEST(SplitFunction, RepairedLowersTheDepthRatioBeforeThePole) {
  EXPECT_EQ(repaired_constants(0.1, 8.2).depth_ratio, 0.1);
  for (const double slope : {8.3, 28.0, 29.0, 1e6}) {
    const SplitConstants c = repaired_constants(0.1, slope);
    EXPECT_LT(c.depth_ratio, 0.1);
    EXPECT_LE(c.depth_ratio * std::sqrt(1 + slope * slope), 2 * (std::sqrt(2.0) - 1));
    EXPECT_NEAR(c.saturation, std::sqrt(2.0), 1e-5);
  }
}

TEST(SplitFunction, BehindTheCameraAlwaysSplits) {
  const Terrain terrain = lattice::flat(9, 9);
  const ClusterGrid grid(terrain, 0, "test");
  const SplitFunction f(terrain, grid, published_constants(0.1));
  const Camera away = make_camera({4, -1, 1}, {4, -100, 1}, 60, 640, 480);
  every_node(grid, [&](GridPoint node) {
    ASSERT_LT(away.depth(f.point(node)), 0);
    EXPECT_TRUE(f.splits(node, away, 1));
  });
}

}  // namespace
}  // namespace plumbline::block_bintree
