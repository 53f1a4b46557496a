// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/terrain.h"
#include "scenarios/vec.h"

namespace plumbline {

/// What to do with samples of a DEM that hold no data.
enum class DemHoles {
  leave_out,  ///< the (up to) four cells around each are not judged; everything else is
  crop,       ///< cut to the largest rectangle without a hole
  fill,       ///< interpolate from the rims, and judge that as if it were data
  refuse,     ///< a hole is an error
};

/// Which DEM to read, and what to make of its holes.
struct DemRequest {
  std::filesystem::path file;  ///< anything that GDAL opens
  DemHoles holes = DemHoles::leave_out;
};

/// A DEM as it is, to hold somebody else's mesh against: its own samples, nothing reprojected or resampled.
/// (load_terrain would: a method needs square metres.) That is enough, since an affine map of the plan
/// changes no vertical distance: everything vertical may be judged in units of samples.
struct Dem {
  /// In sample units: spacing_m = 1, x = column from the west, y = row from the south, the south-west sample
  /// is (0, 0); heights in metres. Samples without data hold a height interpolated from around them.
  Terrain samples;
  /// For oracle::vertical_error_where_data: one byte a sample, in the order of samples.heights_m. Empty: all
  /// of them hold data, or are to be taken as if.
  std::vector<std::uint8_t> has_data;
  std::size_t holes = 0;  ///< samples of the file without data
  bool georeferenced = false;
  bool geographic = false;  ///< the CRS's coordinates are longitude and latitude
  bool resampled = false;   ///< by load_terrain after all: see resampled_dem
  /// Sample (0, 0) in the CRS's coordinates, and one sample's step: metres, or degrees if geographic.
  Vec2 origin;
  double step_x = 1, step_y = 1;
  double crs_unit_m = 1;  ///< the CRS's own unit, of which origin and step are free; geographic: 1
  /// A sample's step in metres: exact if not geographic, otherwise in the middle of the DEM. For areas,
  /// pictures and words, not for judging.
  double metres_x = 1, metres_y = 1;
  /// The file's whole rectangle of samples in sample units; larger than `samples` if it was cropped.
  Vec2 file_low, file_high;
  /// How it was read, in words: size, spacing, CRS, row order, what a sample is, units, holes.
  std::string description;

  /// Where (column, row), in samples, stands in the CRS.
  [[nodiscard]] Vec2 to_crs(Vec2 sample) const {
    return {origin.x + sample.x * step_x, origin.y + sample.y * step_y};
  }
};

/// Reads band 1 as RasterReader does (no-data, mask, scale, offset, feet), rows turned so that row 0 is
/// southmost. Samples stand at the centres of the file's cells. Spacings may differ and may be degrees.
/// Memory: 9 bytes a sample.
///
/// Throws InputError for what cannot be opened; rotated rasters; more than kMostSamplesASide a side; holes
/// against the policy; no 2 × 2 samples with data; heights beyond ±kHighestM.
Dem read_dem(const DemRequest& request);

/// The terrain that load_terrain makes of the file, as a DEM: what a mesh in plumbline's local frame of a
/// geographic raster was made on. `leave_out` crops, since holes are settled before resampling.
Dem resampled_dem(const DemRequest& request);

/// The description, and how the DEM is interpolated: `diagonal_ambiguity_m` is the largest gap between the
/// two ways to split a cell (oracle::diagonal_ambiguity_m).
std::string reading_in_words(const Dem& dem, double diagonal_ambiguity_m);

/// Height of the reference surface at `at` (in units of the spacing); none outside the grid and in cells with
/// a sample without data. `has_data`: as Dem::has_data.
std::optional<double> height_where_data_m(const Terrain& terrain, std::span<const std::uint8_t> has_data,
                                          Vec2 at);

}  // namespace plumbline
