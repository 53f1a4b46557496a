// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/isolated_quadtree/tile_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::isolated_quadtree {

TileGrid::TileGrid(const Terrain& terrain, int tile_side)
    : terrain_(terrain),
      tile_side_(tile_side),
      tiles_x_((terrain.columns - 2) / tile_side + 1),
      tiles_y_((terrain.rows - 2) / tile_side + 1) {
  for (int side = 2; side <= tile_side_; side *= 2) {
    const int across = tiles_x_ * (tile_side_ / side);
    const int along = tiles_y_ * (tile_side_ / side);
    errors_.emplace_back(static_cast<std::size_t>(across) * static_cast<std::size_t>(along), 0.0);
    if (side == 2) continue;  // the smallest nodes draw every sample they have: no error
    for (int b = 0; b < along; ++b) {
      for (int a = 0; a < across; ++a) {
        const Node node{a * side, b * side, side};
        const int h = node.half();
        const double below =
            std::max({error_m({node.i, node.j, h}), error_m({node.i + h, node.j, h}),
                      error_m({node.i, node.j + h, h}), error_m({node.i + h, node.j + h, h})});
        errors_.back()[slot(node)] = std::max(own_error_m(node), below);
      }
    }
  }
  for (int b = 0; b < tiles_y_; ++b) {
    for (int a = 0; a < tiles_x_; ++a) {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      const Node square = tile(a, b);
      for (int j = square.j; j <= std::min(square.j + square.side, terrain.rows - 1); ++j) {
        for (int i = square.i; i <= std::min(square.i + square.side, terrain.columns - 1); ++i) {
          low = std::min(low, terrain.z(i, j));
          high = std::max(high, terrain.z(i, j));
        }
      }
      lowest_.push_back(low);
      highest_.push_back(high);
    }
  }
}

std::size_t TileGrid::level(int side) {
  std::size_t level = 0;
  while ((2 << level) < side) ++level;
  return level;
}

/// The largest distance of the 16 other samples of the node's 5 × 5 from the fan over its 9 samples. Each of
/// the 16 is the midpoint of one of the fan's edges: 8 on the rim, 8 on the spokes. No-data enters no error.
double TileGrid::own_error_m(Node node) const {
  const int q = node.side / 4;
  double error = 0;
  const auto edge = [&](int i0, int j0, int i1, int j1) {
    i0 = node.i + i0 * q;
    i1 = node.i + i1 * q;
    j0 = node.j + j0 * q;
    j1 = node.j + j1 * q;
    if (!has_data(std::max(i0, i1), std::max(j0, j1))) return;
    const double between = (terrain_.z(i0, j0) + terrain_.z(i1, j1)) / 2;
    error = std::max(error, std::abs(terrain_.z((i0 + i1) / 2, (j0 + j1) / 2) - between));
  };
  for (const int k : {0, 2}) {
    edge(k, 0, k + 2, 0);  // rim
    edge(k, 4, k + 2, 4);
    edge(0, k, 0, k + 2);
    edge(4, k, 4, k + 2);
    edge(k, 2, k + 2, 2);  // spokes to the edges' midpoints
    edge(2, k, 2, k + 2);
    edge(k, k, k + 2, k + 2);  // and to the corners
    edge(4 - k, k, 2 - k, k + 2);
  }
  return error;
}

}  // namespace plumbline::isolated_quadtree
