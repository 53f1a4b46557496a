// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// O5 on plain data: each figure with a planted instability, and beside it a steady twin.

#include "oracle/stability.h"

#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "scenarios/portable_math.h"

namespace plumbline::oracle {
namespace {

using Keys = std::vector<std::uint64_t>;

TEST(Toggles, InOutInCounts) {
  ToggleWatch watch;
  EXPECT_EQ(watch.next(0, Keys{}, Keys{}), 0U);
  EXPECT_EQ(watch.next(1, Keys{}, Keys{7}), 0U);  // the first change is none yet
  EXPECT_EQ(watch.next(2, Keys{}, Keys{}), 0U);
  EXPECT_EQ(watch.next(3, Keys{7}, Keys{}), 1U);
}

TEST(Toggles, OutInOutCounts) {
  ToggleWatch watch;
  EXPECT_EQ(watch.next(1, Keys{7}, Keys{}), 0U);
  EXPECT_EQ(watch.next(2, Keys{}, Keys{7}), 1U);
}

TEST(Toggles, AFlickeringVertexCountsEveryFrame) {
  ToggleWatch watch;
  std::size_t toggles = 0;
  for (int f = 1; f <= 20; ++f) {
    toggles += f % 2 == 1 ? watch.next(f, Keys{}, Keys{3}) : watch.next(f, Keys{3}, Keys{});
  }
  EXPECT_EQ(toggles, 19U);
}

TEST(Toggles, AfterMoreThanTenFramesItIsNone) {
  for (const auto& [second, expected] : {std::pair{11, 1U}, std::pair{12, 0U}}) {
    ToggleWatch watch;
    watch.next(1, Keys{}, Keys{7});
    for (int f = 2; f < second; ++f) watch.next(f, Keys{}, Keys{});
    EXPECT_EQ(watch.next(second, Keys{7}, Keys{}), expected) << second;
  }
}

TEST(Toggles, SteadyChangeIsNone) {
  ToggleWatch watch;
  for (std::uint64_t f = 1; f < 50; ++f) {
    EXPECT_EQ(watch.next(static_cast<int>(f), Keys{100 + f}, Keys{f}), 0U);
  }
}

TEST(Toggles, ManyAtOnceAreAllCounted) {
  ToggleWatch watch;
  watch.next(1, Keys{2, 4, 6}, Keys{1, 3, 5});
  EXPECT_EQ(watch.next(2, Keys{1, 5, 9}, Keys{4}), 3U);  // 1, 5 and 4 change back; 9 is new
  EXPECT_EQ(watch.next(3, Keys{3}, Keys{2, 6, 9}), 4U);
}

TEST(KeySets, CompareBySymmetricDifference) {
  const KeyDifference difference = compare_keys(Keys{1, 2, 3}, Keys{2, 3, 4, 5});
  EXPECT_EQ(difference.differing, 3U);
  EXPECT_EQ(difference.all, 5U);
  EXPECT_EQ(difference.share(), 0.6);
  EXPECT_EQ(compare_keys(Keys{1, 2}, Keys{1, 2}).share(), 0);
  EXPECT_EQ(compare_keys(Keys{1}, Keys{2}).share(), 1);
  EXPECT_EQ(compare_keys(Keys{}, Keys{}).share(), 0);
}

TEST(Jitter, MovesThePicturesMiddleByAHundredthOfAPixel) {
  for (const double fov_y_deg : {20.0, 60.0, 120.0}) {
    const Camera camera = make_camera({100, 200, 300}, {400, 900, 50}, fov_y_deg, 640, 360);
    const Camera turned = jittered(camera, std::numeric_limits<double>::infinity());
    EXPECT_EQ(turned.position, camera.position);
    const Camera moved = jittered(camera, 500);
    EXPECT_NE(moved.position, camera.position);
    EXPECT_NE(moved.forward, camera.forward);
    const Vec3 ahead = camera.position + 500 * camera.forward;
    const Vec2 before = camera.project(ahead), after = moved.project(ahead);
    // The projection of a point 500 m ahead rounds far below a millionth of a pixel.
    EXPECT_NEAR(before.x - after.x, kJitterPx, 1e-6);
    EXPECT_NEAR(before.x - turned.project(ahead).x, kJitterPx, 1e-6);
    EXPECT_NEAR(before.y, after.y, 1e-6);
    EXPECT_NEAR(length(moved.forward), 1, 1e-15);
    EXPECT_NEAR(dot(moved.forward, moved.up), 0, 1e-15);
  }
}

TEST(Cuts, AStepBeyondHalfTheDepthInViewIsOne) {
  const Camera camera = make_camera({0, 0, 100}, {0, 1000, 0}, 60, 640, 360);
  const Camera step = make_camera({0, 300, 100}, {0, 1300, 0}, 60, 640, 360);
  EXPECT_TRUE(is_cut(camera, step, 500, 70));
  EXPECT_FALSE(is_cut(camera, step, 700, 70)) << "less than half the depth in view";
  EXPECT_FALSE(is_cut(camera, step, 500, 80)) << "the flight's own pace";
  EXPECT_FALSE(is_cut(camera, step, std::numeric_limits<double>::infinity(), 0));
}

TEST(Cuts, MedianStepIsTheNearestRank) {
  std::vector<Camera> flight;
  for (const double y : {0.0, 1.0, 3.0, 103.0, 107.0})
    flight.push_back(make_camera({0, y, 0}, {0, 1e4, 0}, 60, 64, 48));
  EXPECT_EQ(median_step_m(flight), 2);  // of 1, 2, 4, 100
  EXPECT_EQ(median_step_m(std::span(flight).first(1)), 0);
}

TEST(Cuts, ATurnBeyondThePicturesWidthIsOne) {
  // 60 degrees high at 16:9 is 91.5 degrees wide.
  const auto turned = [](double degrees) {
    const double angle = degrees * kPi / 180;
    return make_camera({0, 0, 0}, {exact_sin(angle), exact_cos(angle), 0}, 60, 640, 360);
  };
  EXPECT_FALSE(is_cut(turned(0), turned(91), 1e9, 0));
  EXPECT_TRUE(is_cut(turned(0), turned(92), 1e9, 0));
  EXPECT_FALSE(is_cut(turned(0), turned(0), 1e9, 0));
}

TEST(Recovery, CountsTheFramesUntilGood) {
  RecoveryWatch watch;
  for (const auto& [cut, good] : {std::pair{false, false}, std::pair{true, false}, std::pair{false, false},
                                  std::pair{false, true}, std::pair{false, false}}) {
    watch.next(cut, good);
  }
  EXPECT_EQ(watch.cuts(), 1U);
  EXPECT_EQ(watch.most_frames(), 2);
  EXPECT_EQ(watch.unrecovered(), 0U);
}

TEST(Recovery, GoodAtOnceIsNoFrame) {
  RecoveryWatch watch;
  watch.next(true, true);
  watch.next(false, true);
  EXPECT_EQ(watch.most_frames(), 0);
  EXPECT_EQ(watch.unrecovered(), 0U);
}

TEST(Recovery, NeverGoodIsSaidAndItsFramesAreCounted) {
  RecoveryWatch watch;
  for (int f = 0; f < 5; ++f) watch.next(f == 0, false);
  watch.next(true, false);  // the next cut comes before it was good
  watch.next(false, true);
  EXPECT_EQ(watch.cuts(), 2U);
  EXPECT_EQ(watch.unrecovered(), 1U);
  EXPECT_EQ(watch.most_frames(), 5);
  watch.next(true, false);  // and the flight ends
  EXPECT_EQ(watch.unrecovered(), 2U);
}

TEST(Recovery, WithoutACutThereIsNothingToRecoverFrom) {
  RecoveryWatch watch;
  for (int f = 0; f < 5; ++f) watch.next(false, false);
  EXPECT_EQ(watch.cuts(), 0U);
  EXPECT_EQ(watch.most_frames(), 0);
  EXPECT_EQ(watch.unrecovered(), 0U);
}

}  // namespace
}  // namespace plumbline::oracle
