// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "oracle/border.h"

namespace plumbline::oracle {

/// One place where two borders do not meet: a point of their common subdivision.
struct SeamGap {
  Vec3 at;           ///< on the higher of the two
  double gap_m = 0;  ///< height of the first mesh minus height of the second; rounded once its sign is known
  int sign = 0;      ///< of the gap, exact
  bool t_junction = false;           ///< only one of the two has a vertex here
  bool of_first = false;             ///< T-junction: the vertex is the first mesh's
  std::uint32_t vertex = 0;          ///< of the mesh that has one (both: the first's)
  std::uint32_t triangle = 0;        ///< beside the seam, of the first mesh
  std::uint32_t other_triangle = 0;  ///< of the second
  bool covered = false;              ///< a skirt of the higher mesh reaches down to the lower
};

/// Where the borders of two meshes run along the same plan line.
struct Seam {
  double length = 0;          ///< of the common stretch, in plan units times `metres_per_unit`
  std::vector<SeamGap> gaps;  ///< complete, in plan order: all T-junctions, and all places with a gap
  std::size_t t_junctions = 0, cracks = 0;  ///< places; a T-vertex with a gap is in both
  double largest_gap_m = 0;                 ///< signed, the largest size; of equals the first in plan order
  Vec3 largest_at;
  double mean_gap_m = 0, mean_abs_gap_m = 0;  ///< over the length: integrals of a piecewise linear function
  double first_over_second_m = 0;  ///< the highest that the first stands over the second; 0: nowhere
  double second_over_first_m = 0;
  std::size_t uncovered = 0;  ///< gaps (and T-junctions without one) that no skirt hides
  double normal_max_deg = 0;  ///< between the normals at vertices that both have
  Vec3 normal_at;
  std::size_t normals = 0;  ///< vertices that were compared; 0: none has normals
  /// No gap: watertight; gaps, none of them uncovered: covered by a skirt; else open.
  [[nodiscard]] bool watertight() const { return gaps.empty(); }
};

/// Compares two borders along every plan line that both run on in opposite directions, which is where the two
/// surfaces lie side by side. Plan points are compared exactly, heights in exact rational arithmetic (in
/// double where that leaves no doubt about the sign), so there is no tolerance; the figures are rounded.
/// `metres_per_unit`: size of a plan unit along x and y, for lengths only. Nothing if they share no stretch.
std::optional<Seam> compare_borders(const Border& first, const Border& second, Vec2 metres_per_unit = {1, 1});

/// A border that runs beside another without meeting it.
struct Slit {
  Vec3 at;                   ///< a vertex of the first border
  double width = 0;          ///< its distance from the second border, plan units
  std::size_t vertices = 0;  ///< of the first border that miss the second so
  std::uint32_t vertex = 0;
};
/// Vertices of the first border that lie beside the second border, nearer than `within` plan units, but not
/// on it (exactly). Beside means: an edge of the first border that ends there runs against the nearest edge
/// of the second, within some 26 degrees, and not beyond that edge's ends; so that a side which leaves a
/// corner that meshes share, or nearly share, is no slit. The widest is the place. Nothing if there is none.
/// This is a measurement with a tolerance, for borders that were meant to meet; what does meet was decided
/// above.
std::optional<Slit> find_slit(const Border& first, const Border& second, double within);

}  // namespace plumbline::oracle
