// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// docs/proofs/m4_threshold.md in numbers: below the threshold slope no camera breaks M4.C3, not even those
// chosen by the proof; just above it one always does, and M4.C1 with it; what the repair does, and where its
// formula ends.

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "algorithms/block_bintree/split_function.h"
#include "properties/laws/generators.h"
#include "properties/laws/split_function_laws.h"
#include "scenarios/random.h"

namespace plumbline::properties {
namespace {

using bintree::ClusterGrid;
using bintree::GridPoint;
using block_bintree::SplitConstants;
using block_bintree::SplitFunction;

/// The proof's threshold for published constants: C3 can fail iff the slope between a split node and its
/// parent exceeds this. s*² = 2/q² − 1, as an angle arccos(q/√2).
double threshold_slope(double q) { return std::sqrt(2 / (q * q) - 1); }

/// The largest distance between parent and child at which C3 cannot fail, in units of the child's hypotenuse
/// d₂.
double safe_distance(double depth_ratio, double q) {
  const double by_error = (1 - 1 / q) * std::sqrt(2.0) / depth_ratio;
  const double by_length = (std::sqrt(2.0) - 1) / depth_ratio;
  return std::min(by_error, by_length);
}

struct Attack {
  Camera camera;
  double threshold_px;
};

/// The proof's worst cameras for a parent and child: on the line from the parent through the child, looking
/// along it, at the depths where the margin is least. `nudge` moves the child's depth by a relative amount to
/// either side.
std::vector<Attack> attacks(const SplitFunction& function, GridPoint parent, GridPoint child) {
  const ClusterGrid& grid = function.grid();
  const auto [depth_ratio, q] = function.constants();
  const double d2 = grid.hypotenuse_m(grid.level(child));
  const double e2 = function.e_m(child);
  const Vec3 p1 = function.point(parent), p2 = function.point(child);
  const Vec3 way = normalized(p1 - p2);
  std::vector<Attack> result;
  const auto attack = [&](double depth_m, double reach_m) {
    const Vec3 position = p2 - way * depth_m;
    const Camera camera = make_camera(position, p1, 90, 200, 200);
    // τ such that e₂·κ/τ is the reach.
    result.push_back({camera, e2 > 0 ? e2 * camera.kappa_px / reach_m : 1e12});
  };
  const double worst_reach = std::sqrt(2.0) * d2 / (depth_ratio * q);
  for (const double nudge : {0.0, 1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3}) {
    if (e2 > 0) attack(worst_reach * (1 + nudge) * (1 - 1e-13), worst_reach * (1 + nudge));
    attack(d2 / depth_ratio * (1 - 1e-12 + nudge), d2 / depth_ratio * 1e-9);  // by its length alone
  }
  return result;
}

/// How many attacks on all parent and child pairs of a terrain break C3; `tried` counts them.
int broken(const Terrain& terrain, const SplitConstants& constants, int& tried) {
  const ClusterGrid grid(terrain, 0, "test");
  const SplitFunction function(terrain, grid, constants);
  int count = 0;
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const GridPoint child{i, j};
      if (!grid.is_split_node(child)) continue;
      for (const GridPoint parent : grid.parents(child)) {
        for (const Attack& a : attacks(function, parent, child)) {
          const LawOutcome outcome = check_split_test_is_monotone(function, a.camera, a.threshold_px);
          tried += outcome.kind != LawOutcome::Kind::vacuous ? 1 : 0;
          count += outcome.kind == LawOutcome::Kind::violated ? 1 : 0;
        }
      }
    }
  }
  return count;
}

/// A drawn terrain of at most 9 samples a side, its heights scaled so that its steepest slope is `slope`.
/// False if it is level.
bool scale_to_slope(Terrain& terrain, double slope) {
  const ClusterGrid grid(terrain, 0, "test");
  const double steepest = block_bintree::steepest_slope(terrain, grid);
  if (!(steepest > 0)) return false;
  for (double& z : terrain.heights_m) z *= slope / steepest;
  return true;
}

template <typename F>
void each_small_terrain(std::uint64_t seed, int count, F&& f) {
  for (std::uint64_t k = 0; count > 0; ++k) {
    Terrain terrain = draw_case("block_bintree", seed, k).input.terrain;
    if (terrain.heights_m.size() > 81) continue;
    --count;
    f(terrain);
  }
}

TEST(M4Threshold, M4_S1_TheFiguresOfMethods) {
  const SplitConstants published = block_bintree::published_constants(0.1);
  EXPECT_EQ(published.saturation, 1.05);
  EXPECT_NEAR(safe_distance(0.1, 1.05), 0.6734, 5e-5);
  EXPECT_NEAR(threshold_slope(1.05), 0.902, 5e-4);
  EXPECT_NEAR(std::atan(threshold_slope(1.05)) * 180 / 3.14159265358979, 42.06, 5e-3);
  // The slope belongs to the distance: sqrt(1+s²)·d₂/2 = 0.6734·d₂.
  EXPECT_NEAR(std::sqrt(1 + threshold_slope(1.05) * threshold_slope(1.05)) / 2, safe_distance(0.1, 1.05),
              1e-12);
}

/// The closed form against a search over the child's reach e₂κ/τ and both ways in which a child can pass.
TEST(M4Threshold, M4_S1_ClosedFormIsTheInfimum) {
  for (const double depth_ratio : {0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 1.0}) {
    for (const double q : {1 + depth_ratio / 2, 1.01, 1.2, 1.4, 1.5, 3.0}) {
      const double root2 = std::sqrt(2.0);
      double least = (root2 - 1) / depth_ratio;  // the child passes by its length d₂/ε (d₂ = 1), with e₂ = 0
      for (int k = 0; k <= 200000; ++k) {
        const double reach = k * 1e-4 / depth_ratio;  // 0 … 20/ε
        const double child_depth = std::max(reach, 1 / depth_ratio);
        least = std::min(least, std::max(q * reach, root2 / depth_ratio) - child_depth);
      }
      EXPECT_NEAR(least, safe_distance(depth_ratio, q), 2e-4 / depth_ratio) << depth_ratio << ' ' << q;
      EXPECT_GE(least, safe_distance(depth_ratio, q) - 1e-9) << depth_ratio << ' ' << q;
    }
  }
}

TEST(M4Threshold, PlanDistanceOfParentAndChildIsHalfTheChildsHypotenuse) {
  Terrain terrain;
  terrain.columns = terrain.rows = 17;
  terrain.spacing_m = 3;
  terrain.heights_m.assign(289, 0.0);
  const ClusterGrid grid(terrain, 9, "test");
  int pairs = 0;
  for (int j = 0; j < 17; ++j) {
    for (int i = 0; i < 17; ++i) {
      if (!grid.is_split_node({i, j})) continue;
      for (const GridPoint parent : grid.parents({i, j})) {
        const double dx = 3.0 * (parent.i - i), dy = 3.0 * (parent.j - j);
        EXPECT_NEAR(std::sqrt(dx * dx + dy * dy), grid.hypotenuse_m(grid.level({i, j})) / 2, 1e-12);
        EXPECT_NEAR(grid.hypotenuse_m(grid.level(parent)),
                    std::sqrt(2.0) * grid.hypotenuse_m(grid.level({i, j})), 1e-12);
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 289);
}

TEST(M4Threshold, M4_C3_HoldsBelowTheThresholdForTheWorstCameras) {
  const SplitConstants published = block_bintree::published_constants(0.1);
  // One part in 10⁹ below: beyond the rounding of a few hundred metres' depths, 10⁻¹³.
  for (const double slope : {threshold_slope(1.05) * (1 - 1e-9), 0.9, 0.7, 0.1}) {
    int tried = 0;
    each_small_terrain(11, 60, [&](Terrain& terrain) {
      if (scale_to_slope(terrain, slope)) {
        EXPECT_EQ(broken(terrain, published, tried), 0) << terrain.columns << ' ' << slope;
      }
    });
    EXPECT_GT(tried, 1000);
  }
}

/// A ramp on 5 × 5 samples with a small bump at node (2, 1), so that the slope from there to node (1, 1) is
/// `slope`.
Terrain ramp_with_bump(double slope) {
  constexpr double kBumpM = 0.01, kSpacingM = 10;
  Terrain terrain;
  terrain.columns = terrain.rows = 5;
  terrain.spacing_m = kSpacingM;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) terrain.heights_m.push_back(i * (slope * kSpacingM - kBumpM));
  }
  terrain.heights_m[terrain.index(2, 1)] += kBumpM;
  return terrain;
}

TEST(M4Threshold, M4_C3_and_C1_FailAtEverySlopeAboveTheThreshold) {
  const double limit = threshold_slope(1.05);
  const SplitConstants published = block_bintree::published_constants(0.1);
  for (const double slope :
       {limit * (1 + 1e-7), limit * (1 + 1e-5), limit * 1.001, 0.95, 1.0, 1.5, 3.0, 10.0}) {
    const Terrain terrain = ramp_with_bump(slope);
    const ClusterGrid grid(terrain, 0, "test");
    const SplitFunction function(terrain, grid, published);
    bool split_test_failed = false, cracked = false;
    for (const Attack& a : attacks(function, {1, 1}, {2, 1})) {
      if (check_split_test_is_monotone(function, a.camera, a.threshold_px).kind != LawOutcome::Kind::violated)
        continue;
      split_test_failed = true;
      LawInput input;
      input.method = "block_bintree";
      input.terrain = terrain;
      input.poses = {{a.camera.position, terrain.point(1, 1)}};
      input.fov_y_deg = 90;
      input.width_px = input.height_px = 200;
      input.threshold_px = a.threshold_px;
      cracked = cracked || judge(find_law("conforming"), input).kind == LawOutcome::Kind::violated;
    }
    EXPECT_TRUE(split_test_failed) << slope;
    EXPECT_TRUE(cracked) << slope;
  }
  // The same construction below.
  int tried = 0;
  EXPECT_EQ(broken(ramp_with_bump(limit * (1 - 1e-7)), published, tried), 0);
  EXPECT_GT(tried, 0);
}

TEST(M4Threshold, M4_S1_RepairedConstantsHoldOnSteepGround) {
  for (const double slope : {0.95, 1.5, 3.0, 8.0, 8.5, 20.0, 28.0, 30.0, 100.0}) {
    int tried = 0;
    each_small_terrain(13, 40, [&](Terrain& terrain) {
      if (!scale_to_slope(terrain, slope)) return;
      const ClusterGrid grid(terrain, 0, "test");
      const SplitConstants repaired =
          block_bintree::repaired_constants(0.1, block_bintree::steepest_slope(terrain, grid));
      EXPECT_EQ(broken(terrain, repaired, tried), 0) << terrain.columns << " at slope " << slope;
    });
    EXPECT_GT(tried, 1000) << slope;
  }
}

/// METHODS' candidate repair takes q alone. Past g = 1 − 1/√2 (slope 8.22, 83°) the hypotenuse's own term d/ε
/// breaks C3 whatever q is; the formula's pole at slope 28.3 is never reached.
TEST(M4Threshold, M4_S1_RepairByQAloneEndsAt83Degrees) {
  const auto by_q_alone = [](double slope) {
    const double g = 0.1 * std::sqrt(1 + slope * slope) / (2 * std::sqrt(2.0));
    return SplitConstants{.depth_ratio = 0.1, .saturation = 1 / (1 - g)};
  };
  const double last_slope = std::sqrt(std::pow(20 * (std::sqrt(2.0) - 1), 2) - 1);
  EXPECT_NEAR(last_slope, 8.2237, 1e-4);
  int tried = 0;
  EXPECT_EQ(broken(ramp_with_bump(last_slope * 0.999), by_q_alone(last_slope * 0.999), tried), 0);
  EXPECT_GT(tried, 0);
  EXPECT_GT(broken(ramp_with_bump(last_slope * 1.001), by_q_alone(last_slope * 1.001), tried), 0);
  EXPECT_GT(broken(ramp_with_bump(20), by_q_alone(20), tried), 0);
}

/// Where it happens, for cameras that are aimed: drawn terrains scaled to one steepest slope; a camera on the
/// line from a parent through its child, at a random depth near the worst one; a threshold at which the child
/// passes by at most q − 1.
TEST(M4Threshold, M4_S1_MapForAimedCameras) {
  const SplitConstants published = block_bintree::published_constants(0.1);
  Random random(5, "m4 map");
  fmt::print("steepest slope | judged | violated | share (aimed cameras)\n");
  for (const double slope : {0.5, 0.85, 0.9, 0.91, 0.95, 1.0, 1.2, 1.5, 2.0, 4.0, 8.0}) {
    int judged = 0, violated = 0;
    each_small_terrain(17, 150, [&](Terrain& terrain) {
      if (!scale_to_slope(terrain, slope)) return;
      const ClusterGrid grid(terrain, 0, "test");
      const SplitFunction function(terrain, grid, published);
      for (int k = 0; k < 20; ++k) {
        const GridPoint child{static_cast<int>(random.below(static_cast<std::uint64_t>(terrain.columns))),
                              static_cast<int>(random.below(static_cast<std::uint64_t>(terrain.rows)))};
        const double away = random.between(0.8, 1.25), passes_by = random.between(1, 1.05);
        if (!grid.is_split_node(child) || grid.parents(child).count == 0 || function.e_m(child) == 0)
          continue;
        const Vec3 p1 = function.point(grid.parents(child).points[0]), p2 = function.point(child);
        const double depth_m = away * std::sqrt(2.0) * grid.hypotenuse_m(grid.level(child)) / (0.1 * 1.05);
        const Camera camera = make_camera(p2 - normalized(p1 - p2) * depth_m, p1, 90, 200, 200);
        const double threshold_px = function.e_m(child) * camera.kappa_px / (depth_m * passes_by);
        const LawOutcome outcome = check_split_test_is_monotone(function, camera, threshold_px);
        judged += outcome.kind != LawOutcome::Kind::vacuous ? 1 : 0;
        violated += outcome.kind == LawOutcome::Kind::violated ? 1 : 0;
      }
    });
    fmt::print("{:>14} | {:>6} | {:>8} | {:.2f} %\n", slope, judged, violated, 100.0 * violated / judged);
    EXPECT_GT(judged, 500) << slope;
    if (slope < threshold_slope(1.05)) {
      EXPECT_EQ(violated, 0) << slope;
    }
    if (slope >= 1) {
      EXPECT_GT(violated, 0) << slope;
    }
  }
}

/// The same for the laws' random cases, whose cameras and thresholds know nothing of the proof.
TEST(M4Threshold, M4_S1_MapForRandomCases) {
  constexpr std::array<double, 5> kFrom{0, 0.9, 2, 4, 8};
  std::array<int, kFrom.size()> judged{}, violated{};
  const Law& law = find_law("M4_C3_split_test_is_monotone");
  for (std::uint64_t k = 0; k < 12000; ++k) {
    const LawInput input = draw_case("block_bintree", 21, k).input;
    if (input.terrain.heights_m.size() > 81 || input.options.contains("depth_ratio")) continue;
    const LawOutcome outcome = judge(law, input);
    if (outcome.kind == LawOutcome::Kind::vacuous) continue;
    const double slope = block_bintree::steepest_slope(input.terrain, split_function_of(input).grid());
    std::size_t band = kFrom.size() - 1;
    while (slope < kFrom[band]) --band;
    ++judged[band];
    violated[band] += outcome.kind == LawOutcome::Kind::violated ? 1 : 0;
  }
  fmt::print("steepest slope from | judged | violated | share (random cases)\n");
  for (std::size_t b = 0; b < kFrom.size(); ++b) {
    fmt::print("{:>19} | {:>6} | {:>8} | {:.2f} %\n", kFrom[b], judged[b], violated[b],
               judged[b] > 0 ? 100.0 * violated[b] / judged[b] : 0.0);
    EXPECT_GT(judged[b], 200) << kFrom[b];
  }
  EXPECT_EQ(violated[0], 0);
  for (std::size_t b = 2; b < kFrom.size(); ++b) EXPECT_GT(violated[b], 0) << kFrom[b];
}

}  // namespace
}  // namespace plumbline::properties
