// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/random.h"
#include "scenarios/tiles/quantized_mesh.h"
#include "scenarios/tiles/tile_grid.h"

namespace plumbline::faults {

/// A sound terrain tile with normals, and its rectangle on the Earth.
struct SoundTile {
  QuantizedMesh tile;
  TileBounds bounds;
  std::uint32_t farthest = 0;  ///< the vertex on the header's ball
  int columns = 0, rows = 0;   ///< of vertices; vertex (i, j) is number j · columns + i, from the south-west
};

/// Columns and rows at random places of the lattice, heights at random over all of the range, each cell cut
/// from its south-west corner to its north-east one. At least three vertices a side.
SoundTile random_tile(Random& random);

/// Lists the vertices on each side anew.
void list_edges(QuantizedMesh& tile);

}  // namespace plumbline::faults
