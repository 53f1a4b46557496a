// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oracle/finding.h"
#include "scenarios/tiles/quantized_mesh.h"
#include "scenarios/tiles/tile_grid.h"

namespace plumbline::oracle {

/// A finding of code tile_encoding; `at` is (u, v, height in m), `vertices` and `triangles` are those of the
/// tile.
struct TileFinding {
  Finding finding;
  std::string text;  ///< one sentence: what, how much
};

/// What a vertex may stand out of the header's ball besides half a lattice cell's diagonal: balls are made
/// from the vertices before these are rounded onto the lattice, and in another order of operations.
inline constexpr double kSphereSlackM = 1e-3;

/// Holds one tile to its format (quantized-mesh-1.0). One finding for a kind and a place, with all its
/// witnesses; faults first, then by kind and place. Kinds:
///   corner_missing  no triangle has a vertex at a corner of the lattice
///   off_border      edges of one triangle each, joined to a chain, that do not lie on the tile's border: a
///   gap
///                   inside, or a border that is not at 0 and 32767. A chain that cuts a missing corner off
///                   is that corner's
///   edge_list       per side: listed vertices that are not on it, used vertices on it that are not listed,
///                   bad indices, repeated ones
///   index           triangles that name a vertex which the tile does not have
///   range           vertices with u, v or height outside [0, 32767]
///   height_range    a header that is not finite, or min > max; hazard: vertices leave part of [0, 32767]
///                   unused (the format allows it; heights are rounded more coarsely than they need be)
///   sphere          vertices outside the header's ball; gap_m says how far the farthest is
///   center          hazard: the header's center is farther from the tile's middle than any vertex
///   (distance_m) normal          not one a vertex, or zero; hazard: it points into the ground trailing
///   hazard: bytes that belong to nothing
/// All but sphere, center and normals into the ground are decided on whole numbers, exactly. Those need
/// `bounds_deg`, are decided in double (places err by nanometres) and are not judged without it. A bad index
/// leaves no hole behind it: then off_border is not judged; nor are vertices of `range` for sphere, edge_list
/// and off_border; nor sphere and center where min > max. Vertices equal in u, v and height are one for
/// off_border.
std::vector<TileFinding> check_tile(const QuantizedMesh& tile, const std::optional<TileBounds>& bounds_deg);

}  // namespace plumbline::oracle
