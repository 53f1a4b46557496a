// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "scenarios/mesh.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle {

/// O2's figures, metres.
struct VerticalError {
  double max = 0;          ///< sup |z_mesh − z_ref| against the declared diagonal
  double certain_max = 0;  ///< sup of the distance to the envelope of both diagonals: a fault either way
  double rms = 0;          ///< integrated exactly over the overlay, not sampled
  double mean = 0;         ///< of the absolute error, likewise
  Vec2 at;                 ///< where `max` is attained (lowest y, then x, among equals)
  Vec2 certain_at;         ///< the same for `certain_max`
  double area_m2 = 0;      ///< plan area that was judged; 0 means nothing was
  /// The largest error at the samples under the mesh, edges included: what a mesh's maker mostly bounds.
  /// Never above `certain_max`; 0 if no sample lies there.
  double samples_max = 0;
  Vec2 samples_at{};  ///< the same for `samples_max`
  friend bool operator==(const VerticalError&, const VerticalError&) = default;
};

/// O2: the difference of two piecewise linear surfaces over their common plan domain, from every piece of the
/// overlay (mesh triangles ∩ halves of grid cells); nothing is sampled.
///
/// What is exact. On a piece the error is linear, so `max` is attained at a vertex of the overlay: a sample,
/// a mesh vertex, or a crossing of a mesh edge with a grid line or a diagonal. All are visited. The two ways
/// to split a cell are the upper and the lower hull of its four samples: one concave, one convex. So the
/// distance to their envelope is convex over the *whole* cell, and `certain_max` is attained at a sample, a
/// mesh vertex, or a crossing with a grid line, where both ways agree. RMS and mean come from the closed
/// forms for a linear function over a triangle, split at the change of sign.
///
/// What is rounded. Positions are taken in units of the spacing; a coordinate that is the double i·spacing_m
/// becomes the integer i, so a mesh on grid samples is located exactly. Heights are evaluated in double,
/// relative to a corner of the triangle: each visited value errs by at most kVerticalRoundingFactor · 2⁻⁵³ ·
/// (range of the heights of the triangle and of the samples of the cells that it touches). Corners between
/// samples add what the rounding of their coordinates (2⁻⁵³ of each) moves the triangle's plane by: more, the
/// thinner it is. A triangle that is one half of one cell, by either diagonal, is judged by differences of
/// its corners' heights: the reference mesh gives exactly 0, any choice of diagonals a `certain_max` of
/// exactly 0. Multiplying all plan lengths, or all heights, by a power of two multiplies the figures exactly.
///
/// `max`, `certain_max`, `samples_max` and their places do not depend on the order of triangles nor on the
/// corner that each starts with. Which samples lie under a thin triangle is decided exactly; under others
/// with a margin that admits what rounding cannot tell from an edge. `rms`, `mean` and `area_m2` are summed
/// in mesh order (compensated); another order may change their last bits.
///
/// Skipped: triangles with a bad index or a non-finite corner, and those that are not positively oriented in
/// plan (decided exactly; O1 reports them). What lies outside the grid is not judged. Overlapping triangles
/// are judged each. Time: linear in samples covered + triangles + crossings; memory: constant. Thread-safe.
/// Requires: at least 2 × 2 samples, one height each, spacing_m > 0 and finite; throws InputError otherwise.
VerticalError vertical_error(const Mesh& mesh, const Terrain& terrain);

/// The same where the terrain has data alone. `has_data`: one byte a sample, in the order of heights_m; 0:
/// its height is a placeholder, and the (up to) four cells around it are not judged, nor counted in
/// `area_m2`. Exact as above over the closed cells that are left; a triangle's corner on their rim counts.
/// Empty: all samples hold data. Throws InputError for any other number of marks. Memory: one byte a cell.
VerticalError vertical_error_where_data(const Mesh& mesh, const Terrain& terrain,
                                        std::span<const std::uint8_t> has_data);

/// The factor of the rounding bound above. A value is made of at most a dozen operations on numbers inside
/// the height range; slopes of a triangle at least an eighth of a cell high (thinner ones are evaluated
/// between their corners only) reach a cell beyond it, which multiplies the range by up to 16.
inline constexpr double kVerticalRoundingFactor = 256;

/// The terrain's own ambiguity: the largest gap between the two ways to split a cell, metres.
double diagonal_ambiguity_m(const Terrain& terrain);
/// Over the cells with four samples of data; marks as above.
double diagonal_ambiguity_m(const Terrain& terrain, std::span<const std::uint8_t> has_data);

}  // namespace plumbline::oracle
