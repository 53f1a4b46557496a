// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/tiles/tile_grid.h"
#include "scenarios/vec.h"

namespace plumbline {

/// The ellipsoid of WGS84, which tiles of both projections stand on.
inline constexpr double kWgs84SemiMajorM = 6378137;
inline constexpr double kWgs84InverseFlattening = 298.257223563;

/// Longitude, latitude (degrees) and height above the WGS84 ellipsoid as a place Earth-centred, Earth-fixed,
/// metres. Correctly rounded sines: the same bits on every machine, and slow (portable_math.h).
Vec3 geodetic_to_ecef(double longitude_deg, double latitude_deg, double height_m);

/// The same for many places of one tile, by the addition theorems from its middle and series of fixed length:
/// the same bits on every machine, within 10 nm of geodetic_to_ecef, tens of times faster.
class TileEcef {
 public:
  /// Requires: no wider than 180°.
  explicit TileEcef(const TileBounds& bounds_deg);

  /// Requires: within half a tile of the bounds.
  [[nodiscard]] Vec3 at(double longitude_deg, double latitude_deg, double height_m) const;
  /// The ellipsoid's normal there: unit, upwards.
  [[nodiscard]] Vec3 up(double longitude_deg, double latitude_deg) const;

 private:
  double middle_longitude_deg_, middle_latitude_deg_;
  Vec2 longitude_, latitude_;  // cosine and sine of the middle
};

}  // namespace plumbline
