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

/// House limits on a terrain. What lies beyond is far from any relief and would only bring overflow.
inline constexpr int kMostSamplesASide = 16385;  ///< 2¹⁴ + 1
inline constexpr double kLeastSpacingM = 1e-6;
inline constexpr double kLargestSpacingM = 1e6;
/// Bound on |height|. No-data values that a raster forgot to declare mostly exceed it.
inline constexpr double kHighestM = 1e6;

/// What to do with samples that hold no data: the raster's no-data value, its mask, NaN, infinite. Settled
/// before any resampling, so that no hole bleeds into its neighbours.
enum class HolePolicy {
  refuse,  ///< a hole is an error (the default: never silent)
  crop,  ///< cut to the largest rectangle of samples without a hole (of equals: the southmost, then westmost)
  fill,  ///< interpolate smoothly from the hole's rim (pull-push pyramid, see height_grid.h)
};

/// How the raster comes to the size that is asked for, around the middle of its extent.
enum class FitRule {
  resample,  ///< the largest square of the extent, bilinearly resampled to size × size samples
  crop,      ///< size × size samples at the raster's own spacing
};

/// Where a terrain comes from: exactly one of `file`, `points`, `generator`, `samples`.
struct TerrainSource {
  std::string id;
  std::filesystem::path file;    ///< anything that GDAL opens
  std::filesystem::path points;  ///< surveyed points: a vector file (scattered_points.h)
  std::string generator;         ///< one of terrain_generators()
  std::vector<double> samples;   ///< rows from the south; needs columns and rows; not finite: a hole
  int columns = 0, rows = 0;     ///< of `samples`
  std::uint64_t seed = 1;        ///< of the generator
  std::optional<int> size;       ///< samples a side; absent: native; generators: 257
  /// Files: the terrain is resampled to this spacing (with `size`: the middle (size − 1)·spacing_m metres;
  /// without: the whole extent); absent: the raster's own. `samples`, generators, and files without
  /// georeference: the distance of neighbouring samples; absent: 30 m (files: 1 m).
  std::optional<double> spacing_m;
  std::optional<double> relief_m;  ///< generators: height range, metres; absent: see terrain_generators
  double z_scale = 1;              ///< heights are multiplied by this after loading
  HolePolicy holes = HolePolicy::refuse;
  FitRule fit = FitRule::resample;
  std::filesystem::path constraints;  ///< file of road polylines (roads.h); empty: none
  bool generated_roads = false;       ///< instead: a network of the terrain's seed
  friend bool operator==(const TerrainSource&, const TerrainSource&) = default;
};

/// Reads or generates a terrain; the same bytes on every machine.
///
/// Files: band 1; no-data value, mask, NaN and infinities are holes; band scale, offset and vertical unit
/// (feet) are applied. Rows are turned so that row 0 is southmost, whichever way the file stores them.
///
/// Projected rasters: the CRS's linear unit is converted to metres. Without a CRS the geotransform's units
/// are taken as metres. A raster whose two spacings differ is resampled bilinearly to their mean.
///
/// Geographic rasters are reprojected to a transverse Mercator frame on the CRS's ellipsoid: central meridian
/// and origin at the raster's middle, scale 1 there (local_frame.h), at the mean of the two ground spacings
/// in the middle, over the largest centred rectangle that the data covers. The scale grows as 1 + x²/2R²:
/// below 1.0014 over the 6° that are allowed. Evaluated here on correctly rounded sines, not by PROJ, whose
/// libm differs from machine to machine.
///
/// Surveyed points: sampled in the middle of their extent, linearly in their Delaunay triangles; without size
/// and spacing_m at their mean distance. Samples outside their hull are holes. Details between the samples
/// are in Terrain::points alone.
///
/// The spacing is rounded to 32 significant bits, so that every i·spacing_m is exact.
///
/// More than 16385 samples a side need `size` or `spacing_m`. What `crop` keeps is read alone; `resample`
/// reads every k-th sample, k the least that brings both sides to 16385. Refused: rotated rasters; geographic
/// ones of more than 6° or beyond 86° of latitude; more than 2³² samples or 2²⁰ a side.
///
/// Throws InputError for a file that cannot be read, fewer than 2 × 2 samples, holes against the policy,
/// heights beyond ±kHighestM, or a size outside [2, 16385] samples a side.
Terrain load_terrain(const TerrainSource& source);

/// Names of the generators with one line each, for `plumbline list terrains`. Unless said otherwise the
/// relief is 1000 m at 7680 m extent (257 samples at 30 m), growing with the square root of the extent, as
/// real relief does.
struct GeneratorDescription {
  std::string name;
  std::string summary;
};
/// In the order in which they are listed.
const std::vector<GeneratorDescription>& terrain_generators();

}  // namespace plumbline
