// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/terrain.h"

namespace plumbline {

/// What to do with samples that hold no data (the raster's no-data value, NaN, infinite).
enum class HolePolicy {
  refuse,  ///< a hole is an error (the default: never silent)
  crop,    ///< cut to the largest rectangle of samples without a hole
  fill,    ///< interpolate from the hole's rim (GDALFillNodata)
};

/// How the raster comes to the size that is asked for.
enum class FitRule {
  resample,  ///< bilinear resampling of the whole extent to size × size samples
  crop,      ///< cut size × size samples around the middle, at the raster's own spacing
};

/// Where a terrain comes from: exactly one of `file`, `generator`, `samples`.
struct TerrainSource {
  std::string id;
  std::filesystem::path file;       ///< anything that GDAL opens
  std::string generator;            ///< plane, tilted_plane, cliff, sine, fbm, ridged, canyon, spike, checkerboard, island
  std::vector<double> samples;      ///< rows from the south; needs columns and rows
  int columns = 0, rows = 0;        ///< of `samples`
  std::uint64_t seed = 1;           ///< of the generator
  std::optional<int> size;          ///< samples a side; absent: native
  std::optional<double> spacing_m;  ///< absent: the raster's own; generators: 30 m
  std::optional<double> relief_m;   ///< generators: height range, metres
  double z_scale = 1;               ///< heights are multiplied by this after loading
  HolePolicy holes = HolePolicy::refuse;
  FitRule fit = FitRule::resample;
};

/// Reads or generates a terrain. Geographic rasters are reprojected to a local metric frame (transverse Mercator at the
/// raster's middle); band scale and offset are applied. Throws InputError for a file that cannot be read, fewer than
/// 2 × 2 samples, holes against the policy, or a size outside [2, 16385] samples a side.
Terrain load_terrain(const TerrainSource& source);

/// Names of the generators with one line each, for `plumbline list terrains`.
struct GeneratorDescription {
  std::string name;
  std::string summary;
};
const std::vector<GeneratorDescription>& terrain_generators();

}  // namespace plumbline
