// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "oracle/conformity.h"

/// The stations that check_conformity passes, in order. Each sees what the one before it left over:
///
///   survey      every vertex and triangle once: indices, finiteness, orientation in plan
///   match       directed edges against their twins, by index
///   setting aside   (only if something looked wrong) duplicates, and triangles wound the wrong way
///   seams       left-over edges by position: equal, coincident at other heights, T-vertices; then the domain
///   regions     what still does not cancel bounds the regions that are covered wrongly
namespace plumbline::oracle::detail {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// What later stations do with a triangle.
enum Treatment : std::uint8_t {
  kNormal = 0,
  kLeftOut = 1,  ///< bad index, non-finite, repeated index, duplicate: not part of the surface
  kTurned = 2,   ///< wound clockwise among counter-clockwise neighbours: read the other way round
  kSilent = 4,   ///< degenerate with three distinct corners: joins its neighbours, witnesses nothing
};

/// Triangles' corners in the order in which they count.
inline std::array<std::uint32_t, 3> corners_of(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                                               std::size_t t) {
  const auto& c = mesh.triangles[t];
  if (!treatment.empty() && (treatment[t] & kTurned) != 0) return {c[0], c[2], c[1]};
  return c;
}

/// Station 1. Lists are in order of index.
struct Survey {
  std::vector<std::uint32_t> bad_index;            ///< triangles
  std::vector<std::uint32_t> non_finite;           ///< vertices
  std::vector<std::uint32_t> touching_non_finite;  ///< triangles left out for that reason
  std::vector<std::uint32_t> repeated;             ///< triangles that name a vertex twice
  std::vector<std::uint32_t> collinear;            ///< triangles of zero plan area, three distinct indices
  std::vector<std::uint32_t> negative;             ///< triangles that run clockwise in plan
  std::vector<std::uint32_t> unused;               ///< finite vertices that no triangle names
  std::size_t exact_orientations = 0;              ///< decided beyond double
  [[nodiscard]] bool plain() const {
    return bad_index.empty() && non_finite.empty() && repeated.empty() && collinear.empty() &&
           negative.empty();
  }
};
Survey survey(const Mesh& mesh);

/// One triangle's use of an edge, in the direction in which it counts.
struct EdgeUse {
  std::uint32_t from = 0, to = 0;  ///< mesh vertices
  std::uint32_t triangle = 0;
  bool silent = false;
};

struct VertexPair {
  std::uint32_t from = 0, to = 0;
  friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};

/// Station 2. `treatment` is empty (all normal) or has one entry a triangle.
struct IndexMatch {
  std::vector<EdgeUse> left_over;   ///< in order of triangle
  std::vector<VertexPair> crowded;  ///< edges (from < to) with more than one use in a direction
};
IndexMatch match_by_index(const Mesh& mesh, std::span<const std::uint8_t> treatment);

/// Every use of the given edges, in either direction, in order of triangle. `edges` is sorted, from < to.
std::vector<EdgeUse> uses_of(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                             std::span<const VertexPair> edges);

/// Gives equal points equal numbers; -0 equals 0. `use_height`: compare z as well as x and y.
std::vector<std::uint32_t> weld_all(const Mesh& mesh, bool use_height);

struct Duplicate {
  std::uint32_t extra = 0, kept = 0;  ///< triangles
};
/// Triangles with the same three corners (by position) as another, `treatment` left-outs not counted. A
/// counter-clockwise one is kept if there is one, then the one of least index.
std::vector<Duplicate> find_duplicates(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                                       std::span<const std::uint32_t> negative);

/// Which of the negative triangles are wound the wrong way round, rather than folded over: those whose
/// connected group runs along its counter-clockwise neighbours in the same direction more often than in the
/// opposite one. A group without such neighbours counts as wound the wrong way.
std::vector<bool> find_turned(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                              std::span<const std::uint32_t> negative);

/// A piece of plan line that did not cancel, from the smaller to the larger end (before_in_plan), or one that
/// belongs to the promised outline.
struct ResidualSegment {
  std::uint32_t from = 0, to = 0;  ///< into Residual::points
  int excess = 0;                  ///< uses by triangles minus promised uses, in this direction
  int promised = 0;                ///< uses by the domain
  bool excused = false;  ///< borders a triangle that was left out: its region has its finding already
  std::uint32_t triangle = kNone;  ///< a triangle along it, least index
};

struct Residual {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> vertex;  ///< a mesh vertex at the point (the least index), or kNone
  std::vector<bool> excused;          ///< points: as for segments
  std::vector<ResidualSegment> segments;
  bool needs_regions = false;  ///< some excess is not zero
};

/// Station 4. Appends cracks and T-junctions. `suspects_duplicates` is set, and nothing else done, if two
/// left-over edges belong to triangles at the same place and `duplicates_settled` is false.
struct Seams {
  Residual residual;
  bool suspects_duplicates = false;
  std::size_t t_junctions = 0, cracks = 0;  ///< a T-vertex with a gap is in both
};
Seams close_seams(const Mesh& mesh, const PlanDomain& domain, std::span<const EdgeUse> left_over,
                  std::span<const VertexPair> excused_edges, std::span<const std::uint32_t> excused_vertices,
                  bool duplicates_settled, std::vector<Finding>& findings);

/// Station 5. Appends holes, overlaps and outline faults; with a free outline, holes that cover encloses and
/// overlaps (or, where the borders are too many to arrange, finding 110 of kind "outline").
void find_regions(const Mesh& mesh, const Residual& residual, bool outline_is_free,
                  std::vector<Finding>& findings);

}  // namespace plumbline::oracle::detail
