// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// O5 in flight: made-up methods, each unstable in one way, and a steady one. Every figure must name its own
// and none of the others.

#include <limits>

#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "properties/harness/flight.h"

namespace plumbline {
namespace {

constexpr int kSide = 9;

Terrain hills() {
  Terrain terrain{"hills", kSide, kSide, 10, {}};
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) terrain.heights_m.push_back((i * 7 + j * 5) % 4);
  }
  return terrain;
}

/// Draws every `step`-th sample of a terrain whose side is 9.
void draw_grid(const Terrain& terrain, int step, LodFrame& frame) {
  frame.clear();
  frame.domain = full_domain(terrain);
  if (step == 0) return;  // nothing at all
  const int across = (kSide - 1) / step + 1;
  for (int j = 0; j < kSide; j += step) {
    for (int i = 0; i < kSide; i += step) {
      frame.mesh.positions.push_back(terrain.point(i, j));
      frame.vertex_keys.push_back(terrain.index(i, j));
    }
  }
  for (int j = 0; j + 1 < across; ++j) {
    for (int i = 0; i + 1 < across; ++i) {
      const auto a = static_cast<std::uint32_t>(j * across + i);
      const auto up = static_cast<std::uint32_t>(across);
      frame.mesh.triangles.push_back({a, a + 1, a + up + 1});
      frame.mesh.triangles.push_back({a, a + up + 1, a + up});
    }
  }
}

/// `step(camera, frame)`: what a method draws in its how manieth frame.
class Scripted final : public LodMethod {
 public:
  using Step = std::function<int(const Camera&, int)>;
  explicit Scripted(Step step) : step_(std::move(step)) {}
  void prepare(const Terrain& terrain) override { terrain_ = &terrain; }
  void update(const Camera& camera, LodFrame& frame) override {
    draw_grid(*terrain_, step_(camera, frame_++), frame);
  }
  void reset() override { frame_ = 0; }
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    auto copy = std::make_unique<Scripted>(step_);
    copy->terrain_ = terrain_;
    return copy;
  }

 private:
  Step step_;
  const Terrain* terrain_ = nullptr;
  int frame_ = 0;
};

/// Flies over `frames` cameras; the camera is cut where `cut_at` says, and comes back to the first one in the
/// last frame.
verdict::StabilitySummary fly(const Scripted::Step& step, double threshold_px = 1000) {
  static const oracle::RayDevice device;
  TerrainStage stage;
  stage.terrain = hills();
  stage.reference = reference_mesh(stage.terrain);
  stage.surface = std::make_unique<oracle::RaySurface>(device, stage.reference);
  auto method = std::make_unique<Scripted>(step);
  method->prepare(stage.terrain);
  method->set_threshold_px(threshold_px);
  Flight flight(std::move(method), stage, device);
  std::vector<verdict::FrameVerdict> frames;
  constexpr int kFrames = 8, kCut = 3;
  for (int f = 0; f < kFrames; ++f) {
    const bool last = f == kFrames - 1;
    const double x = last ? 0 : f < kCut ? 0.5 * f : 200 + 0.5 * f;
    FrameScene scene;
    scene.index = f;
    scene.camera = make_camera({x, -60, 70}, {40, 40, 0}, 60, 64, 48);
    scene.mean_depth_m = 80;
    scene.cut = f == kCut;
    scene.comes_again = f == 0;
    scene.first_visit = last ? 0 : -1;
    const oracle::PixelHits hits = stage.surface->look(scene.camera);
    scene.reference_hits = &hits;
    frames.push_back(flight.next(scene));
  }
  return verdict::summarize(frames).stability;
}

TEST(StabilityInFlight, ASteadyMethodHasNothing) {
  const verdict::StabilitySummary all = fly([](const Camera&, int) { return 2; });
  EXPECT_EQ(all.cuts, 1U);
  EXPECT_EQ(all.recovery_frames, 0);
  EXPECT_EQ(all.unrecovered, 0U);
  EXPECT_EQ(all.lag_frames, 0);
  EXPECT_EQ(all.unsettled, 0U);
  EXPECT_EQ(all.toggles, 0U);
  EXPECT_EQ(all.jitter_vertices, 0U);
  EXPECT_EQ(all.jitter_px, 0);
  EXPECT_EQ(all.path_share, 0);
  EXPECT_EQ(all.path_px, 0);
  EXPECT_EQ(all.revisits, 1U);
  EXPECT_EQ(all.revisit_share, 0);
}

TEST(StabilityInFlight, AFlickeringMethodToggles) {
  const verdict::StabilitySummary all = fly([](const Camera&, int frame) { return frame % 2 == 0 ? 1 : 2; });
  // 81 samples or 25: 56 change in each of seven frames, the first time without having changed before.
  EXPECT_EQ(all.toggles, 6U * 56);
  EXPECT_GT(all.path_share, 0.5);
  EXPECT_GT(all.path_px, 0);
  EXPECT_EQ(all.jitter_vertices, 0U) << "it changes without any jitter";
}

TEST(StabilityInFlight, AMethodThatFollowsTheCameraIsNoneOfIt) {
  // Coarse on one side of the cut, fine on the other: change, but no flicker, lag or memory.
  const verdict::StabilitySummary all =
      fly([](const Camera& camera, int) { return camera.position.x < 100 ? 2 : 1; });
  EXPECT_EQ(all.path_share, 0);
  EXPECT_EQ(all.revisit_share, 0);
  EXPECT_EQ(all.lag_frames, 0);
}

TEST(StabilityInFlight, ALateMethodLagsAfterACut) {
  // Frames count from the start of the flight: the cut comes at 3, the mesh is fine again from 6 on. A fresh
  // start is always fine.
  const verdict::StabilitySummary all =
      fly([](const Camera&, int frame) { return frame >= 3 && frame < 6 ? 8 : 1; }, 1e-6);
  EXPECT_EQ(all.recovery_frames, 3);
  EXPECT_EQ(all.unrecovered, 0U);
  EXPECT_EQ(all.lag_frames, 3);
  EXPECT_EQ(all.unsettled, 0U);
}

TEST(StabilityInFlight, AMethodThatNeverComesBackIsUnrecovered) {
  const verdict::StabilitySummary all =
      fly([](const Camera&, int frame) { return frame >= 3 ? 8 : 1; }, 1e-6);
  EXPECT_EQ(all.recovery_frames, 5);  // frames 3 to 7
  EXPECT_EQ(all.unrecovered, 1U);
  EXPECT_EQ(all.unsettled, 1U);
  EXPECT_GT(all.revisit_share, 0.9);  // 4 corners of 81 samples are left
}

TEST(StabilityInFlight, DrawingNothingIsNoRecovery) {
  const verdict::StabilitySummary all =
      fly([](const Camera&, int frame) { return frame >= 3 ? 0 : 1; }, 1e-6);
  EXPECT_EQ(all.recovery_frames, 5);
  EXPECT_EQ(all.unrecovered, 1U);
  EXPECT_EQ(all.unsettled, 1U);
}

TEST(StabilityInFlight, AMethodAboveTauAllTheTimeIsUnrecoveredButSettled) {
  const verdict::StabilitySummary all = fly([](const Camera&, int) { return 8; }, 1e-6);
  EXPECT_EQ(all.unrecovered, 1U);
  EXPECT_EQ(all.lag_frames, 0);
  EXPECT_EQ(all.unsettled, 0U);
}

TEST(StabilityInFlight, AMethodOnTheEdgeTremblesUnderAHundredthOfAPixel) {
  // Decided by bits of the place, or of the direction, that any move, or any turn, changes.
  const Camera first = make_camera({0, -60, 70}, {40, 40, 0}, 60, 64, 48);
  const auto by_direction = [&](const Camera& camera, int) {
    return camera.position.x < 0.25 && camera.forward.x > first.forward.x ? 2 : 1;
  };
  const auto by_place = [](const Camera& camera, int) {
    return camera.position.x > 0 && camera.position.x < 0.25 ? 2 : 1;
  };
  for (const Scripted::Step& nervous : {Scripted::Step(by_direction), Scripted::Step(by_place)}) {
    const verdict::StabilitySummary all = fly(nervous);
    EXPECT_EQ(all.jitter_vertices, 56U);
    EXPECT_GT(all.jitter_px, 0);
    EXPECT_EQ(all.path_share, 0);
    EXPECT_EQ(all.toggles, 0U);
  }
}

}  // namespace
}  // namespace plumbline
