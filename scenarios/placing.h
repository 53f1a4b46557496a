// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/dem.h"
#include "scenarios/mesh.h"
#include "scenarios/vec.h"

/// How somebody's mesh lies over somebody's DEM.
namespace plumbline {

/// An affine map of the mesh's plan to sample units (Dem::samples), axis by axis; heights stay.
struct Placing {
  std::string name;   ///< one of placing_names()
  std::string words;  ///< what x and y of the mesh are
  /// The mesh's coordinates `anchor` stand at `sample`; a sample's step is `step`: negative where the mesh's
  /// axis runs the other way.
  Vec2 anchor, sample;
  Vec2 step{1, 1};

  /// A coordinate that is a sample's up to the rounding of the doubles it was computed from (a few units in
  /// the last place of it and of the anchor) becomes the integer, so that samples lie exactly on samples.
  [[nodiscard]] Vec3 to_samples(Vec3 point) const;
  [[nodiscard]] Vec2 from_samples(Vec2 point) const;
  /// The map reverses orientation in plan: y runs south.
  [[nodiscard]] bool mirrors() const { return (step.x < 0) != (step.y < 0); }
};

/// The placings, in the order in which one that explains a mesh is preferred to the next:
///
/// crs             the DEM's own coordinates: easting and northing in metres, or longitude and latitude in
///                 degrees (taken 360 apart, too); georeferenced DEMs
/// crs_units       easting and northing in the CRS's own unit, if that is not the metre
/// local           plumbline's local frame: metres east and north of the south-west sample (of the cropped
///                 part, if holes were cropped). Of a geographic DEM this is the frame of load_terrain: the
///                 mesh is then held against resampled_dem
/// samples         column, and row counted from the file's north-west sample downwards (y runs south): as
///                 martini and delatin write
/// samples_up      column, and row counted from the south-west sample upwards
/// samples_scaled  as `samples`, times the spacing in metres
/// centred         metres east and north of the middle of the DEM
/// fit             the mesh's box in plan, stretched over the DEM's samples
struct PlacingName {
  std::string_view name, summary;
};
/// In the order in which they are told.
std::span<const PlacingName> placing_names();

/// The placings that a DEM has, for a mesh with this box in plan, in the documented order. `fit` is last, and
/// left out if the box has no area. `unit_m`: metres of one unit of the mesh's plan, for the placings in
/// metres.
std::vector<Placing> placings(const Dem& dem, Vec2 low, Vec2 high, double unit_m = 1);

/// A DEM with meshes laid over it.
struct LaidDem {
  Dem dem;
  Placing placing;
  bool guessed = false;
  /// Most of the meshes' plan area runs clockwise once laid: laid_over() turns the triangles over, so that
  /// they can be judged at all.
  bool turned = false;
  std::size_t vertices = 0;  ///< that were compared for `rms_m`
  double rms_m = 0;          ///< of mesh height less DEM height at vertices over data; 0 if there are none
  /// What was taken, whether that was guessed and from what, and how to say otherwise: one sentence or two.
  std::string words;
};

/// Reads the DEM and lays meshes over it as `name` says: one of placing_names(), or "guess".
///
/// Guessing looks at boxes first: placings under which the meshes' box is the DEM's rectangle of samples (to
/// kBoxMarginSamples), before those under which it lies inside, before the one with the largest share in
/// common, before `fit` (which still competes by heights with all but the first). Among those left the
/// heights at (at most kPlacingVertices) vertices decide: a placing is preferred to an earlier one if it at
/// least halves the RMS; and one that runs south only if, besides, the triangles run clockwise in the mesh's
/// own x and y, as they do when seen from above y runs south. Otherwise a mesh with its rows flipped would
/// pass for one that counts them downwards; as it is, it is laid north-up, and oracle::recognise_misplacement
/// says so. Deterministic.
///
/// Leave skirts out of the meshes: their vertices are not on the terrain.
///
/// Throws InputError as read_dem, for an unknown name, for a placing that the DEM does not have, and for
/// meshes without a finite vertex.
LaidDem lay_over_dem(const DemRequest& request, std::string_view name, std::span<const Mesh* const> meshes,
                     double unit_m = 1);

/// Sides of a mesh may exceed the samples' rectangle by this much and still be its own: a cell's half on each
/// side where cells were taken for samples, or one cell on one side, and a rounding.
inline constexpr double kBoxMarginSamples = 1.25;
/// Vertices that are compared. An RMS over so many is good to about 1/√(2n), one percent.
inline constexpr std::size_t kPlacingVertices = 4096;

/// The mesh in sample units; `turned` swaps two corners of each triangle.
Mesh laid_over(const Mesh& mesh, const Placing& placing, bool turned);

/// Up to `most` of the indices 0 … count − 1, ascending: all, or one drawn from each of `most` equal
/// stretches (a constant stride would see one column of a grid). Always the same.
std::vector<std::size_t> spread_indices(std::size_t count, std::size_t most);

}  // namespace plumbline
