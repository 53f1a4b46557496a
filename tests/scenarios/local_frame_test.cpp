// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/local_frame.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "scenarios/portable_math.h"

namespace plumbline {
namespace {

constexpr double kSemiMajorM = 6378137;
constexpr double kInverseFlattening = 298.257223563;
// Snyder: the truncated series hold to a millimetre near the meridian; at 3° we allow a centimetre.
constexpr double kNearToleranceM = 1e-3;
constexpr double kFarToleranceM = 1e-2;

Geographic degrees(double longitude, double latitude) {
  return {longitude * kRadiansPerDegree, latitude * kRadiansPerDegree};
}

TEST(LocalFrame, OriginIsZeroAndNorthIsUp) {
  const LocalFrame frame(degrees(-84, 36), kSemiMajorM, kInverseFlattening);
  EXPECT_EQ(frame.to_plan(degrees(-84, 36)), (Vec2{0, 0}));
  EXPECT_GT(frame.to_plan(degrees(-84, 36.1)).y, 0);
  EXPECT_GT(frame.to_plan(degrees(-83.9, 36)).x, 0);
}

TEST(LocalFrame, InverseUndoesForward) {
  for (const double latitude : {-80.0, -36.0, 0.0, 0.5, 45.0, 85.0}) {
    const LocalFrame frame(degrees(10, latitude), kSemiMajorM, kInverseFlattening);
    for (const double aside : {-3.0, -0.5, 0.0, 0.2, 3.0}) {
      for (const double up : {-1.0, 0.0, 0.7}) {
        const Vec2 p = frame.to_plan(degrees(10 + aside, latitude + up));
        const Geographic back = frame.row(p.y).at(p.x);
        EXPECT_NEAR(back.longitude * std::cos(latitude * kRadiansPerDegree),
                    (10 + aside) * kRadiansPerDegree * std::cos(latitude * kRadiansPerDegree),
                    kFarToleranceM / kSemiMajorM);
        EXPECT_NEAR(back.latitude, (latitude + up) * kRadiansPerDegree, kFarToleranceM / kSemiMajorM);
      }
    }
  }
}

// The second route: PROJ's own transverse Mercator, through GDAL.
TEST(LocalFrame, AgreesWithProj) {
  for (const double latitude : {-52.0, 0.0, 36.6, 70.0}) {
    OGRSpatialReference geographic;
    OGRSpatialReference plan;
    ASSERT_EQ(geographic.importFromProj4("+proj=longlat +ellps=WGS84"), OGRERR_NONE);
    const std::string text = fmt::format("+proj=tmerc +lat_0={} +lon_0=-84 +k=1 +ellps=WGS84", latitude);
    ASSERT_EQ(plan.importFromProj4(text.c_str()), OGRERR_NONE);
    geographic.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> proj(
        OGRCreateCoordinateTransformation(&geographic, &plan));
    ASSERT_NE(proj, nullptr);
    const LocalFrame frame(degrees(-84, latitude), kSemiMajorM, kInverseFlattening);
    for (const double aside : {-3.0, -0.2, 0.01, 1.0}) {
      for (const double up : {-0.3, 0.0, 2.0}) {
        double x = -84 + aside;
        double y = latitude + up;
        const Vec2 ours = frame.to_plan(degrees(x, y));
        ASSERT_TRUE(proj->Transform(1, &x, &y));
        const double tolerance_m = std::fabs(aside) <= 1 ? kNearToleranceM : kFarToleranceM;
        EXPECT_NEAR(ours.x, x, tolerance_m) << latitude << " " << aside << " " << up;
        EXPECT_NEAR(ours.y, y, tolerance_m) << latitude << " " << aside << " " << up;
      }
    }
  }
}

TEST(LocalFrame, RadiiAreDerivatives) {
  const LocalFrame frame(degrees(0, 36.6), kSemiMajorM, kInverseFlattening);
  constexpr double kStep =
      1e-4;  // degrees; the central difference errs by about (step)², far below a centimetre
  const double north =
      (frame.to_plan(degrees(0, 36.6 + kStep)).y - frame.to_plan(degrees(0, 36.6 - kStep)).y) /
      (2 * kStep * kRadiansPerDegree);
  const double east = frame.to_plan(degrees(kStep, 36.6)).x / (kStep * kRadiansPerDegree);
  EXPECT_NEAR(frame.meridian_radius_m(), north, 0.01);
  EXPECT_NEAR(frame.parallel_radius_m(), east, 0.01);
}

TEST(LocalFrame, SphereHasNoFlattening) {
  const LocalFrame frame(degrees(0, 60), 1000, 0);
  EXPECT_NEAR(frame.meridian_radius_m(), 1000, 1e-9);
  EXPECT_NEAR(frame.parallel_radius_m(), 500, 1e-9);
}

}  // namespace
}  // namespace plumbline
