// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/vec.h"

namespace plumbline {

/// Longitude and latitude, radians.
struct Geographic {
  double longitude = 0, latitude = 0;
};

/// A transverse Mercator frame on an ellipsoid, scale 1 on the central meridian, x east and y north of its
/// origin in metres: Snyder, Map Projections: a Working Manual (USGS Professional Paper 1395, 1987),
/// equations 8-9 to 8-25. The truncated series agree with the projection to millimetres within 3° of the
/// central meridian. Evaluated on correctly rounded sines and cosines: the same bits on every machine.
class LocalFrame {
 public:
  LocalFrame(Geographic origin, double semi_major_m, double inverse_flattening);

  [[nodiscard]] Vec2 to_plan(Geographic point) const;

  /// The points of one parallel to the x axis, for which all that is slow is done once.
  class Row {
   public:
    [[nodiscard]] Geographic at(double x) const;

   private:
    friend class LocalFrame;
    double central_longitude_, footpoint_latitude_;
    double n1_, n1_tan_over_r1_, inverse_cos_;
    double latitude_4_, latitude_6_, longitude_3_, longitude_5_;
  };
  [[nodiscard]] Row row(double y) const;

  /// Metres per radian at the origin: of latitude, along the meridian; of longitude, along the parallel.
  [[nodiscard]] double meridian_radius_m() const;
  [[nodiscard]] double parallel_radius_m() const;

 private:
  [[nodiscard]] double meridian_arc_m(double latitude) const;

  Geographic origin_;
  double a_;   // semi-major axis, m
  double e2_;  // first eccentricity squared
  double arc_at_origin_m_;
};

}  // namespace plumbline
