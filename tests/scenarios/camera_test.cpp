// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/camera.h"

#include <cmath>

#include "support.h"

namespace plumbline {
namespace {

using test::input_error;
using testing::HasSubstr;

TEST(Camera, AxesAndScale) {
  const Camera camera = make_camera({0, 0, 10}, {0, 100, 10}, 90, 800, 600);
  EXPECT_EQ(camera.forward, (Vec3{0, 1, 0}));
  EXPECT_EQ(camera.right(), (Vec3{1, 0, 0}));
  EXPECT_EQ(camera.up, (Vec3{0, 0, 1}));
  EXPECT_NEAR(camera.kappa_px, 300, 1e-12) << "half the height at 45 degrees";
}

TEST(Camera, ProjectionAndRayAgree) {
  const Camera camera = make_camera({3, -7, 50}, {40, 90, 5}, 60, 640, 360);
  const Vec3 p{10, 60, 20};
  const Vec2 q = camera.project(p);
  const Vec3 ray = camera.ray_direction(q.x, q.y);
  const Vec3 back = camera.position + ray * camera.depth(p);
  constexpr double kRoundingM = 1e-10;  // a few roundings of coordinates below 100 m
  EXPECT_NEAR(back.x, p.x, kRoundingM);
  EXPECT_NEAR(back.y, p.y, kRoundingM);
  EXPECT_NEAR(back.z, p.z, kRoundingM);
  EXPECT_NEAR(dot(ray, camera.forward), 1, 1e-12);
}

TEST(Camera, PictureRunsRightAndDown) {
  const Camera camera = make_camera({0, 0, 0}, {0, 1, 0}, 60, 640, 360);
  EXPECT_EQ(camera.project({0, 10, 0}), (Vec2{320, 180}));
  EXPECT_GT(camera.project({1, 10, 0}).x, 320);
  EXPECT_LT(camera.project({0, 10, 1}).y, 180);
  EXPECT_TRUE(camera.sees({0, 10, 0}));
  EXPECT_FALSE(camera.sees({0, -10, 0}));
  EXPECT_FALSE(camera.sees({100, 10, 0}));
}

TEST(Camera, StraightDownHasNorthUp) {
  const Camera camera = make_camera({5, 5, 100}, {5, 5, 0}, 60, 640, 360);
  EXPECT_EQ(camera.up, (Vec3{0, 1, 0}));
  EXPECT_LT(camera.project({5, 6, 0}).y, 180);
}

TEST(Camera, ViewConeHoldsWhateverIsSeen) {
  const Camera camera = make_camera({0, 0, 0}, {0, 1, 0}, 60, 640, 360);
  int inside = 0;
  int outside = 0;
  for (int x = -20; x <= 20; ++x) {
    for (int y = -20; y <= 20; ++y) {
      const Vec3 p{x * 1.0, y * 1.0, 3};
      if (camera.sees(p)) {
        ++inside;
        EXPECT_FALSE(camera.outside_view_cone(p, 0));
      }
      outside += camera.outside_view_cone(p, 0) ? 1 : 0;
      EXPECT_FALSE(camera.outside_view_cone(p, length(p))) << "the ball holds the apex";
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TEST(Camera, BadNumbersAreRefused) {
  EXPECT_THAT(input_error([] {
                (void)make_camera({0, 0, 0}, {0, 0, 0}, 60, 640, 360);
              }),
              HasSubstr("coincide"));
  EXPECT_THAT(input_error([] {
                (void)make_camera({0, NAN, 0}, {0, 0, 0}, 60, 640, 360);
              }),
              HasSubstr("not finite"));
  EXPECT_THAT(input_error([] {
                (void)make_camera({0, 0, 0}, {0, 1, 0}, 0, 640, 360);
              }),
              HasSubstr("field of view 0"));
  EXPECT_THAT(input_error([] {
                (void)make_camera({0, 0, 0}, {0, 1, 0}, NAN, 640, 360);
              }),
              HasSubstr("field of view"));
  EXPECT_THAT(input_error([] {
                (void)make_camera({0, 0, 0}, {0, 1, 0}, 60, 640, 16385);
              }),
              HasSubstr("16385"));
}

}  // namespace
}  // namespace plumbline
