// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/terrain.h"

namespace plumbline {

/// Bound on the corners of all roads of a terrain.
inline constexpr std::size_t kMostRoadCorners = 1000000;

/// Road polylines for Terrain::roads, from any vector file that GDAL opens (GeoJSON, CSV with WKT, …): all
/// its lines, in the file's order. Coordinates are taken as they stand: metres in the terrain's local frame,
/// east and north of its south-west sample; a third one is dropped, as roads lie on the ground. Throws
/// InputError, one line, for a file that cannot be read, holds something else than lines, or no line at all,
/// for a line of fewer than two corners or off the terrain, and beyond kMostRoadCorners. `terrain_id` is for
/// complaints.
std::vector<std::vector<Vec2>> load_roads(const std::filesystem::path& file, const Terrain& terrain,
                                          const std::string& terrain_id);

/// A generated network: 4 × 4 junctions, each moved from its place, joined to their neighbours by roads with
/// one bend. No two roads meet but at junctions. The same on every machine.
std::vector<std::vector<Vec2>> generate_roads(const Terrain& terrain, std::uint64_t seed);

}  // namespace plumbline
