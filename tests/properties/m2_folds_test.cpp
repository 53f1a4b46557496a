// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// M2.S2, M2.S6, M2.C4: what folds the published method over, the least cases of it, and that `guarded` never
// does (docs/proofs/m2_guarded_never_folds.md). Verdicts: docs/claims.md.

#include <cstdlib>
#include <filesystem>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "algorithms/registry.h"
#include "algorithms/ring_tin/ring_tin.h"
#include "oracle/conformity.h"
#include "properties/atlas/case_file.h"
#include "properties/laws/trial.h"
#include "scenarios/random.h"

namespace plumbline::properties {
namespace {

using ring_tin::RingTin;

/// Every frame but the last is conforming, and the last one does nothing but reset trees.
bool only_a_reset_at_the_end(const LawInput& input) {
  if (input.poses.size() < 2) return false;
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const auto& ring = dynamic_cast<const RingTin&>(*method);
  const std::vector<Camera> flight = cameras(input);
  LodFrame frame;
  for (std::size_t k = 0; k < flight.size(); ++k) {
    method->update(flight[k], frame);
    if (k + 1 < flight.size() && !oracle::check_conformity(frame.mesh, frame.domain).clean()) return false;
  }
  return ring.statistics().trees_reset > 0 && ring.statistics().collapses == 0;
}

/// From far away, then near: all in the outer ring first, a few cells in the inner one then.
LawInput drawn_approach(const char* method, std::uint64_t seed) {
  Random random(seed, "approach");
  LawInput input;
  input.method = method;
  const auto whole = [&](int low, int high) {
    return low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low + 1)));
  };
  Terrain& terrain = input.terrain;
  terrain.id = "drawn";
  terrain.columns = whole(6, 9);
  terrain.rows = whole(6, 9);
  terrain.heights_m.assign(static_cast<std::size_t>(terrain.columns * terrain.rows), 0);
  const int share = whole(1, 6);
  for (double& z : terrain.heights_m) z = whole(1, 6) <= share ? whole(0, 4) : 0;
  input.fov_y_deg = 90;
  input.width_px = input.height_px = 2;  // κ = 1 pixel
  input.options["rings_m"] = fmt::format("{} 10", whole(1, 4) * 0.5);
  input.options["delta_px"] = std::string("0 1");
  input.threshold_px = whole(1, 40) * 0.0125;  // tolerance 1/8 m to 5 m
  const double x = whole(1, terrain.columns - 2), y = whole(1, terrain.rows - 2);
  input.poses = {{{100, 0, 9}, {100, 1, 9}}, {{x, y, 9}, {x, y + 1, 9}}};
  return input;
}

const std::filesystem::path kAtlas = std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "properties" / "atlas";

TEST(M2Folds, M2_S6_OneCollapseOfAGridNeverFolds) {
  // All directions of all edges at an inner vertex: its six neighbours stand on a convex hexagon.
  Terrain terrain;
  terrain.columns = terrain.rows = 7;
  terrain.heights_m.assign(49, 0);
  const tin::Tin tin = tin::grid_tin(terrain);
  const tin::Adjacency adjacency(tin);
  const std::uint32_t middle = 24;
  int triangles = 0;
  for (const std::uint32_t e : adjacency.edges_at(middle)) {
    const tin::Edge ends = adjacency.edges()[e];
    const std::uint32_t to = ends[0] == middle ? ends[1] : ends[0];
    for (const std::uint32_t t : adjacency.triangles_at(middle)) {
      auto corners = tin.mesh.triangles[t];
      if (std::find(corners.begin(), corners.end(), to) != corners.end()) continue;
      std::replace(corners.begin(), corners.end(), middle, to);
      EXPECT_EQ(tin::plan_orientation(tin.mesh.positions[corners[0]], tin.mesh.positions[corners[1]],
                                      tin.mesh.positions[corners[2]]),
                1);
      ++triangles;
    }
  }
  EXPECT_EQ(triangles, 6 * 4);
}

/// Frames of a case's flight: triangles, collapses and trees reset.
struct Step {
  std::size_t triangles;
  std::uint64_t collapses, resets;
  bool clean;
};
std::vector<Step> steps_of(const char* file) {
  const Case c = load_case(kAtlas / file);
  const std::unique_ptr<LodMethod> method = prepared_method(c.input);
  const auto& ring = dynamic_cast<const RingTin&>(*method);
  std::vector<Step> steps;
  LodFrame frame;
  for (const Camera& camera : cameras(c.input)) {
    method->update(camera, frame);
    steps.push_back({frame.mesh.triangles.size(), ring.statistics().collapses, ring.statistics().trees_reset,
                     oracle::check_conformity(frame.mesh, frame.domain).clean()});
  }
  return steps;
}

TEST(M2Folds, M2_S6_TwoCollapsesAreTheLeast) {
  const std::vector<Step> steps = steps_of("m2_s6_6x5.toml");
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].triangles, 40U - 2 * 2);
  EXPECT_EQ(steps[0].collapses, 2U);
  EXPECT_FALSE(steps[0].clean);
}

TEST(M2Folds, M2_S2_ThreeCollapsesAndAResetAreTheLeast) {
  // After the reset two collapses must be left (one never folds), and it undid one: three at least.
  const std::vector<Step> steps = steps_of("m2_s2_6x6.toml");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].collapses, 3U);
  EXPECT_TRUE(steps[0].clean);
  EXPECT_EQ(steps[1].resets, 1U);
  EXPECT_EQ(steps[1].collapses, 0U);
  EXPECT_EQ(steps[1].triangles, 50U - 2 * 2);
  EXPECT_FALSE(steps[1].clean);
}

TEST(M2Folds, M2_S2_S6_HowOftenAndNeverGuarded) {
  const Law& law = find_law("conforming");
  struct Tally {
    int first = 0, first_folded = 0, reset = 0, reset_folded = 0;
  };
  for (const char* id : {"ring_tin", "ring_tin:fixpoint", "ring_tin:guarded"}) {
    Tally tally;
    for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
      LawInput input = drawn_approach(id, seed);
      if (only_a_reset_at_the_end(input)) {
        ++tally.reset;
        tally.reset_folded += judge(law, input).kind == LawOutcome::Kind::violated ? 1 : 0;
      }
      input.poses.resize(1);
      ++tally.first;
      tally.first_folded += judge(law, input).kind == LawOutcome::Kind::violated ? 1 : 0;
    }
    fmt::print("{}: {} of {} first frames fold, {} of {} frames that only reset trees\n", id,
               tally.first_folded, tally.first, tally.reset_folded, tally.reset);
    EXPECT_GT(tally.reset, 100);
    if (std::string(id) == "ring_tin:guarded") {
      EXPECT_EQ(tally.first_folded, 0);
      EXPECT_EQ(tally.reset_folded, 0);
    } else {
      EXPECT_GT(tally.first_folded, 1000);
      EXPECT_GT(tally.reset_folded, 5);
    }
  }
}

// ---- random flights over random networks
// --------------------------------------------------------------------------------------------------------

/// A move: to (x, y), by a step or a jump, with the threshold and rings of the frame.
using Move = std::tuple<int, int, int, int>;

/// What a flight of `moves` over the terrain of `seed` did.
struct Flown {
  int frames = 0, folded = 0, holes = 0, resets = 0;
};

Flown fly_random(ring_tin::Variant variant, int seed, const std::vector<Move>& moves) {
  Random random(static_cast<std::uint64_t>(seed), "network");
  Terrain terrain;
  terrain.id = "drawn";
  terrain.columns = 8 + static_cast<int>(random.below(7));
  terrain.rows = 8 + static_cast<int>(random.below(7));
  const double roughness = static_cast<double>(random.below(4));
  for (int k = 0; k < terrain.columns * terrain.rows; ++k) {
    terrain.heights_m.push_back(std::floor(random.between(0, 1 + 3 * roughness)));
  }
  if (random.below(2) == 0) {
    terrain.roads = {
        {{0.5, 1.25}, {terrain.width_m() / 2, terrain.depth_m() / 2}, {terrain.width_m() - 1, 2.5}},
        {{terrain.width_m() / 2, terrain.depth_m() / 2}, {1.75, terrain.depth_m() - 1}}};
  }
  ring_tin::Settings settings;
  settings.variant = variant;
  settings.points.share = random.below(2) == 0 ? 1 : 0.6;
  settings.points.seed = static_cast<std::uint64_t>(seed);
  settings.depth_cap = 2 + static_cast<int>(random.below(7));
  settings.focal_px = 1;
  settings.rings = {{1, 3, 6}, {0, 1, 2}, false};
  RingTin method(settings);
  method.prepare(terrain);
  Flown flown;
  LodFrame frame;
  Vec2 at{terrain.width_m() / 2, terrain.depth_m() / 2};
  for (const auto& [x, y, threshold, rings] : moves) {
    // Even: a step; odd: a teleport.
    at = x % 2 == 0 ? Vec2{at.x + x % 3, at.y + y % 3} : Vec2{double{1} * x, double{1} * y};
    if (rings % 4 == 1) method.set_rings({{1.0 + rings % 3, 6.0 + rings % 5}, {0, 0.5}, false});
    if (rings % 4 == 3) method.set_rings(settings.rings);
    if (threshold % 3 == 0) method.set_threshold_px(0.25 * (1 + threshold));
    method.update(make_camera({at.x, at.y, 50}, {at.x, at.y + 1, 40}, 60, 640, 480), frame);
    const oracle::ConformityReport report = oracle::check_conformity(frame.mesh, frame.domain);
    ++flown.frames;
    flown.folded += report.clean() ? 0 : 1;
    flown.holes += report.counts.hole > 0 || report.counts.outline > 0 ? 1 : 0;
    flown.resets += static_cast<int>(method.statistics().trees_reset);
  }
  return flown;
}

rc::Gen<std::vector<Move>> some_moves() {
  return rc::gen::container<std::vector<Move>>(rc::gen::tuple(
      rc::gen::inRange(-8, 20), rc::gen::inRange(-8, 20), rc::gen::inRange(0, 12), rc::gen::inRange(0, 12)));
}

/// RapidCheck reads this when it is first used: the same flights in every run.
const bool kSeeded = ::setenv("RC_PARAMS", "seed=1 max_success=800 max_size=50", 0) == 0;

TEST(M2Folds, M2_C4_GuardedNeverFoldsOverRandomFlights) {
  ASSERT_TRUE(kSeeded);
  int frames = 0, resets = 0, flights = 0;
  const bool held = rc::check("guarded: every frame of every flight is conforming", [&] {
    const int seed = *rc::gen::inRange(0, 1 << 20);
    const std::vector<Move> moves = *some_moves();
    const Flown flown = fly_random(ring_tin::Variant::guarded, seed, moves);
    ++flights;
    frames += flown.frames;
    resets += flown.resets;
    RC_ASSERT(flown.folded == 0);
  });
  EXPECT_TRUE(held);
  fmt::print("guarded: {} flights, {} frames, {} trees reset, none folded\n", flights, frames, resets);
  EXPECT_GT(frames, 8000);
  EXPECT_GT(resets, 8000);
}

TEST(M2Folds, M2_C4_NoVariantLeavesAHole) {
  ASSERT_TRUE(kSeeded);
  int frames = 0, folded = 0;
  for (const ring_tin::Variant variant : {ring_tin::Variant::published, ring_tin::Variant::fixpoint}) {
    const bool held = rc::check("every frame covers its domain, folded or not", [&] {
      const int seed = *rc::gen::inRange(0, 1 << 20);
      const Flown flown = fly_random(variant, seed, *some_moves());
      frames += flown.frames;
      folded += flown.folded;
      RC_ASSERT(flown.holes == 0);
    });
    EXPECT_TRUE(held);
  }
  fmt::print("published, fixpoint: {} of {} frames fold, none has a hole\n", folded, frames);
  EXPECT_GT(folded, frames / 10);
}

}  // namespace
}  // namespace plumbline::properties
