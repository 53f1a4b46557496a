// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/tiles/ecef.h"

#include <cmath>

#include "scenarios/portable_math.h"

namespace plumbline {
namespace {

constexpr double kFlattening = 1 / kWgs84InverseFlattening;
constexpr double kE2 = kFlattening * (2 - kFlattening);  // first eccentricity squared

/// The ellipsoid's normal from cosines (x) and sines (y).
Vec3 normal(Vec2 longitude, Vec2 latitude) {
  return {latitude.x * longitude.x, latitude.x * longitude.y, latitude.y};
}

Vec3 placed(Vec3 up, double height_m) {
  const double n = kWgs84SemiMajorM / std::sqrt(1 - kE2 * up.z * up.z);  // radius of the prime vertical
  return {(n + height_m) * up.x, (n + height_m) * up.y, (n * (1 - kE2) + height_m) * up.z};
}

/// Cosine and sine by their series. Requires: |d| ≤ π, where what is left out is below 1e-16.
Vec2 turn(double d) {
  const double square = d * d;
  double cosine = 1, sine = 1;
  for (int n = 30; n >= 2; n -= 2) {
    cosine = 1 - cosine * square / (n * (n - 1));
    sine = 1 - sine * square / (n * (n + 1));
  }
  return {cosine, sine * d};
}

Vec2 sum_of_angles(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.y * b.x + a.x * b.y}; }

Vec2 exact_turn(double degrees) {
  const double radians = degrees * kRadiansPerDegree;
  return {exact_cos(radians), exact_sin(radians)};
}

}  // namespace

Vec3 geodetic_to_ecef(double longitude_deg, double latitude_deg, double height_m) {
  return placed(normal(exact_turn(longitude_deg), exact_turn(latitude_deg)), height_m);
}

TileEcef::TileEcef(const TileBounds& b)
    : middle_longitude_deg_((b.west + b.east) / 2),
      middle_latitude_deg_((b.south + b.north) / 2),
      longitude_(exact_turn(middle_longitude_deg_)),
      latitude_(exact_turn(middle_latitude_deg_)) {}

Vec3 TileEcef::up(double longitude_deg, double latitude_deg) const {
  return normal(sum_of_angles(longitude_, turn((longitude_deg - middle_longitude_deg_) * kRadiansPerDegree)),
                sum_of_angles(latitude_, turn((latitude_deg - middle_latitude_deg_) * kRadiansPerDegree)));
}

Vec3 TileEcef::at(double longitude_deg, double latitude_deg, double height_m) const {
  return placed(up(longitude_deg, latitude_deg), height_m);
}

}  // namespace plumbline
