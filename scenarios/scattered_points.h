// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/height_grid.h"
#include "scenarios/vec.h"

namespace plumbline {

/// Bound on the points of one file.
inline constexpr std::size_t kMostPoints = 20000000;

/// Surveyed points of a terrain, from any vector file that GDAL opens (CSV, GeoJSON, shapefile, …): every
/// point and multipoint, in the file's order; (easting, northing, height) in metres as the file has them. In
/// a CSV the columns x, y, z (any case; or easting, northing, elevation) are the coordinates. Throws
/// InputError, one line beginning with `label`, for a file that cannot be read, holds something else than
/// points or fewer than three, for a point without a height, a coordinate that is not finite, longitudes and
/// latitudes, and beyond kMostPoints.
std::vector<Vec3> load_points(const std::filesystem::path& file, const std::string& label);

/// Heights on columns × rows samples from `south_west` on, `spacing_m` apart: interpolated linearly in the
/// Delaunay triangles of the points (GDAL's grid algorithm "linear"); NaN outside their hull. Throws
/// InputError, one line beginning with `label`, for points on one line.
HeightGrid grid_points(const std::vector<Vec3>& points, Vec2 south_west, int columns, int rows,
                       double spacing_m, const std::string& label);

}  // namespace plumbline
