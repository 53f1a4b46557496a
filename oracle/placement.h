// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scenarios/terrain.h"
#include "scenarios/vec.h"

namespace plumbline::oracle {

/// What has to be done to a mesh that lies wrongly over a terrain. In the order in which one that explains
/// the heights is preferred to the next.
enum class MisplacementKind {
  rows_flipped,     ///< north and south swapped
  columns_flipped,  ///< east and west swapped
  rotated_180,
  /// Rows and columns swapped, as in a matrix whose first row is the northmost: mirrored along the diagonal
  /// from the north-west to the south-east corner.
  transposed,
  anti_transposed,  ///< mirrored along the other diagonal: transposed where the first row is the southmost
  rotated_90,       ///< counter-clockwise, seen from above
  rotated_270,
  height_offset,      ///< a constant is to be added to its heights
  height_factor,      ///< its heights are to be multiplied: feet for metres, an exaggeration
  cells_for_samples,  ///< n samples were spread over n cells, or the other way: one step in n too many
  shifted,            ///< moved in plan by whole or half samples
};
/// "rows_flipped", …
std::string_view misplacement_name(MisplacementKind kind);

/// An arrangement of a mesh over a terrain that fits decidedly better than the one given.
struct Misplacement {
  MisplacementKind kind = MisplacementKind::rows_flipped;
  std::string words{};       ///< "matches if rows are flipped: RMS 0.41 m instead of 118 m"
  double rms_m = 0;          ///< so arranged
  double given_rms_m = 0;    ///< as given
  std::size_t vertices = 0;  ///< compared as given
  Vec2 shift{};              ///< `shifted`: to be moved east and north by this many samples
  double offset_m = 0;       ///< `height_offset`: to be added
  double factor = 1;         ///< `height_factor`: to multiply by; `cells_for_samples`: of the plan
};

/// Compares a mesh's vertices with the terrain's surface as they lie, and as they would lie in other
/// arrangements: RMS of vertex height less surface height, over the vertices that lie over data.
///
/// Tried are: the other seven of the grid's symmetries (the rectangle of samples mapped onto itself, and the
/// mesh's own box; stretched where rows and columns swap and their numbers differ); shifts by half samples up
/// to kMisplacementWindow samples each way (half a sample is the centre of a pixel taken for its corner); a
/// constant offset of the heights, their mean error; a factor of the heights, 0.3048, its inverse, or the
/// least squares one; n samples spread over n cells from the south-west or the north-west corner or about the
/// middle, and the other way round. One at a time, not combined.
///
/// None is named unless (a) its RMS is at most kMisplacementShare of the given one's; (b) the given one's is
/// no less than an eighth of what the terrain changes by from one sample to the next (RMS): lying a quarter
/// of a sample wrong costs about that much; and no less than kMisplacementNoise of the heights, which is what
/// single precision rounds; (c) at least kMisplacementVertices vertices were compared, and half as many in
/// the other arrangement as in the given one. Of alternatives that pass, a later kind is named only if its
/// RMS is at least a tenth below that of the kinds before it: on a plane a shift is an offset, too.
///
/// Of more than kMisplacementSample vertices as many are drawn, always the same; shifts are searched with
/// kMisplacementScout of them first. Which triangles connect them does not matter. Leave skirts out.
///
/// `vertices`: in the terrain's local frame. `has_data`: as for vertical_error_where_data.
std::optional<Misplacement> recognise_misplacement(std::span<const Vec3> vertices, const Terrain& terrain,
                                                   std::span<const std::uint8_t> has_data = {});

/// A simplified mesh's errors do not know of a wrong arrangement: with one or two free parameters over tens
/// of vertices they are fitted a few percent better, and one of some thousand shifts of unrelated ground
/// halves them at best. The right arrangement of a displaced mesh leaves its own error, mostly a hundredth.
inline constexpr double kMisplacementShare = 0.25;
inline constexpr double kMisplacementNoise = 0x1p-20;
inline constexpr std::size_t kMisplacementVertices = 24;
inline constexpr int kMisplacementWindow = 8;
inline constexpr std::size_t kMisplacementSample = 4096;
inline constexpr std::size_t kMisplacementScout = 512;

}  // namespace plumbline::oracle
