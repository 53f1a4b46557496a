// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Canaries: a law that cannot fail is worth nothing. Each law is given methods with one planted fault, which
// it must catch on the cases it is usually judged on, and the same method without the fault, which it must
// pass.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

#include "algorithms/block_bintree/split_function.h"
#include "properties/laws/generators.h"
#include "properties/laws/split_function_laws.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

/// What a faulty method may remember.
struct Memory {
  int updates = 0;  ///< since the start or reset
  bool was_reset = false;
  bool is_clone = false;  ///< of one that had flown
  double width_m = 0;     ///< of the terrain
  std::optional<Vec3> last_position;
};

/// A fault: changes the threshold that the method below is given, or its frame, or nothing.
struct Fault {
  std::function<double(const Memory&, double threshold_px)> threshold =
      [](const Memory&, double threshold_px) { return threshold_px; };
  std::function<void(const Memory&, LodFrame&)> spoil = [](const Memory&, LodFrame&) {};
};

/// restricted_quadtree, with a fault.
class Faulty final : public LodMethod {
 public:
  explicit Faulty(Fault fault) : fault_(std::move(fault)), inner_(make_method("restricted_quadtree")) {}
  void prepare(const Terrain& terrain) override {
    inner_->prepare(terrain);
    memory_.width_m = terrain.width_m();
  }
  void update(const Camera& camera, LodFrame& frame) override {
    inner_->set_threshold_px(fault_.threshold(memory_, threshold_px()));
    inner_->update(camera, frame);
    fault_.spoil(memory_, frame);
    ++memory_.updates;
    memory_.last_position = camera.position;
  }
  void reset() override {
    inner_->reset();
    memory_ = {
        .updates = 0, .was_reset = true, .is_clone = false, .width_m = memory_.width_m, .last_position = {}};
  }
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    auto copy = std::make_unique<Faulty>(fault_);
    copy->inner_ = inner_->clone();
    copy->memory_.width_m = memory_.width_m;
    copy->memory_.is_clone = memory_.updates > 0;
    return copy;
  }

 private:
  Fault fault_;
  std::unique_ptr<LodMethod> inner_;
  Memory memory_;
};

void drop_last_triangle(LodFrame& frame) {
  if (!frame.mesh.triangles.empty()) frame.mesh.triangles.pop_back();
}

struct Count {
  int held = 0, violated = 0;
};

Count judge_cases(const std::string& law_id, const std::optional<Fault>& fault) {
  constexpr std::uint64_t kCases = 60;
  const Law& law = find_law(law_id);
  Count count;
  for (std::uint64_t k = 0; k < kCases; ++k) {
    LawInput input = draw_case("restricted_quadtree", 7, k).input;
    if (fault) {
      input.make = [&] { return std::make_unique<Faulty>(*fault); };
    } else {
      input.make = [] { return std::make_unique<Faulty>(Fault{}); };
    }
    const LawOutcome outcome = judge(law, input);
    count.held += outcome.kind == LawOutcome::Kind::held ? 1 : 0;
    count.violated += outcome.kind == LawOutcome::Kind::violated ? 1 : 0;
    if (outcome.kind == LawOutcome::Kind::violated) {
      EXPECT_TRUE(outcome.finding.has_value());
      EXPECT_FALSE(outcome.what.empty());
      EXPECT_EQ(outcome.what.find('\n'), std::string::npos);
    }
  }
  return count;
}

void expect_caught(const std::string& law, const Fault& fault) {
  const Count sound = judge_cases(law, std::nullopt);
  EXPECT_EQ(sound.violated, 0) << law;
  EXPECT_GT(sound.held, 0) << law;
  EXPECT_GT(judge_cases(law, fault).violated, 0) << law;
}

TEST(Canary, ConformingCatchesALostTriangle) {
  Fault fault;
  fault.spoil = [](const Memory&, LodFrame& frame) { drop_last_triangle(frame); };
  expect_caught("conforming", fault);
}

TEST(Canary, ConformingCatchesAVertexMovedByOneUlp) {
  Fault fault;
  fault.spoil = [](const Memory&, LodFrame& frame) {
    // The same corner twice, at two heights: a seam that opens by a bit.
    if (frame.mesh.triangles.empty()) return;
    Vec3 p = frame.mesh.positions[frame.mesh.triangles.back()[0]];
    p.z = std::nextafter(p.z, 1e9);
    frame.mesh.triangles.back()[0] = static_cast<std::uint32_t>(frame.mesh.positions.size());
    frame.mesh.positions.push_back(p);
    frame.vertex_keys.push_back(1u << 30);
  };
  expect_caught("conforming", fault);
}

TEST(Canary, TrianglesFallWithTauCatchesAThresholdUpsideDown) {
  Fault fault;
  fault.threshold = [](const Memory&, double threshold_px) { return 1 / threshold_px; };
  expect_caught("triangles_fall_with_tau", fault);
}

TEST(Canary, IdempotentCatchesAnUpdateThatCounts) {
  Fault fault;
  fault.spoil = [](const Memory& memory, LodFrame& frame) {
    if (memory.updates % 2 == 1) drop_last_triangle(frame);
  };
  expect_caught("idempotent", fault);
}

TEST(Canary, PathIndependentCatchesAMemoryOfTheFlight) {
  Fault fault;
  fault.threshold = [](const Memory& memory, double threshold_px) {
    return memory.last_position && memory.last_position->z > 50 ? threshold_px / 16 : threshold_px;
  };
  expect_caught("path_independent", fault);
}

TEST(Canary, PathIndependentCatchesACloneThatRemembers) {
  Fault fault;
  fault.spoil = [](const Memory& memory, LodFrame& frame) {
    if (memory.is_clone) drop_last_triangle(frame);
  };
  expect_caught("path_independent", fault);
}

TEST(Canary, PathIndependentCatchesAResetThatForgetsNot) {
  Fault fault;
  fault.spoil = [](const Memory& memory, LodFrame& frame) {
    if (memory.was_reset) drop_last_triangle(frame);
  };
  expect_caught("path_independent", fault);
}

TEST(Canary, ExactAtZeroCatchesAThresholdWithAFloor) {
  Fault fault;
  fault.threshold = [](const Memory&, double threshold_px) { return std::max(threshold_px, 1000.0); };
  expect_caught("exact_at_zero", fault);
}

TEST(Canary, ScalingCatchesALengthAmongTheConstants) {
  Fault fault;
  fault.threshold = [](const Memory& memory, double threshold_px) {
    return memory.width_m > 50 ? threshold_px * 1000 : threshold_px;
  };
  expect_caught("scaling_keeps_topology", fault);
}

TEST(Canary, SymmetricCatchesAPreferredCorner) {
  Fault fault;
  fault.spoil = [](const Memory&, LodFrame& frame) { drop_last_triangle(frame); };
  expect_caught("symmetric", fault);
}

TEST(Canary, ScreenErrorWithinTauCatchesARaisedSurface) {
  // The sound method is the reference itself: another choice of diagonals is displaced too.
  const Law& law = find_law("screen_error_within_tau");
  int held = 0;
  for (std::uint64_t k = 0; k < 60; ++k) {
    LawInput input = draw_case("full", 7, k).input;
    const LawOutcome outcome = judge(law, input);
    EXPECT_NE(outcome.kind, LawOutcome::Kind::violated) << outcome.what;
    held += outcome.kind == LawOutcome::Kind::held ? 1 : 0;
  }
  EXPECT_GT(held, 0);
  Fault raised;
  raised.threshold = [](const Memory&, double) { return 0x1p-60; };
  raised.spoil = [](const Memory&, LodFrame& frame) {
    for (Vec3& p : frame.mesh.positions) p.z += 1000;
  };
  EXPECT_GT(judge_cases("screen_error_within_tau", raised).violated, held / 2);
}

TEST(Canary, ContinuousInCameraCatchesAVertexThatMovesInAMerge) {
  Fault still;
  still.spoil = [](const Memory&, LodFrame& frame) {
    frame.counters.split = 0;
    frame.counters.merged = 1;
  };
  const Count sound = judge_cases("continuous_in_camera", still);
  EXPECT_EQ(sound.violated, 0);
  EXPECT_GT(sound.held, 0);
  Fault moving;
  moving.spoil = [](const Memory& memory, LodFrame& frame) {
    frame.counters.split = 0;
    frame.counters.merged = 1;
    if (!frame.mesh.positions.empty()) frame.mesh.positions[0].z += memory.updates;
  };
  EXPECT_GT(judge_cases("continuous_in_camera", moving).violated, 0);
}

/// A 9 × 9 terrain with one bump: errors of the children reach the parents by saturation alone.
Terrain bump() {
  Terrain terrain;
  terrain.columns = terrain.rows = 9;
  terrain.spacing_m = 10;
  terrain.heights_m.assign(81, 0.0);
  terrain.heights_m[terrain.index(3, 4)] = 5;
  return terrain;
}

TEST(Canary, M4_C2_CatchesASplitFunctionWithoutSaturation) {
  const Terrain terrain = bump();
  const bintree::ClusterGrid grid(terrain, 0, "canary");
  const block_bintree::SplitConstants published = block_bintree::published_constants(0.1);
  block_bintree::SplitConstants weak = published;
  weak.saturation = 1;
  EXPECT_EQ(check_error_is_monotone({terrain, grid, published}, published.saturation).kind,
            LawOutcome::Kind::held);
  EXPECT_EQ(check_error_is_monotone({terrain, grid, weak}, published.saturation).kind,
            LawOutcome::Kind::violated);
}

TEST(Canary, M4_C3_CatchesASplitFunctionWithoutSaturation) {
  // A bump of 5 m on level ground is gentle enough for the published constants (m4_threshold.md); without q,
  // a parent a cell away from its child along the view does not split.
  const Terrain terrain = bump();
  const bintree::ClusterGrid grid(terrain, 0, "canary");
  block_bintree::SplitConstants weak = block_bintree::published_constants(0.1);
  weak.saturation = 1;
  int violated_weak = 0, violated_published = 0, held_published = 0;
  for (int away = 200; away <= 600; away += 10) {
    const Camera camera = make_camera({30.0 - away, 40, 20}, {30, 40, 5}, 60, 640, 480);
    // The bump is just worth a split at its own depth.
    const double threshold_px = 5 * camera.kappa_px / camera.depth({30, 40, 5}) * 0.999;
    const auto judge_one = [&](const block_bintree::SplitConstants& constants) {
      return check_split_test_is_monotone({terrain, grid, constants}, camera, threshold_px).kind;
    };
    violated_weak += judge_one(weak) == LawOutcome::Kind::violated ? 1 : 0;
    const LawOutcome::Kind published = judge_one(block_bintree::published_constants(0.1));
    violated_published += published == LawOutcome::Kind::violated ? 1 : 0;
    held_published += published == LawOutcome::Kind::held ? 1 : 0;
  }
  EXPECT_GT(violated_weak, 0);
  EXPECT_EQ(violated_published, 0);
  EXPECT_GT(held_published, 0);
}

}  // namespace
}  // namespace plumbline::properties
