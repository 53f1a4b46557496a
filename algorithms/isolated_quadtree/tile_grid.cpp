// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/isolated_quadtree/tile_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "algorithms/mutant.h"

namespace plumbline::isolated_quadtree {

TileGrid::TileGrid(const Terrain& terrain, int tile_side)
    : terrain_(terrain),
      tile_side_(tile_side),
      tiles_x_((terrain.columns - 2) / tile_side + 1),
      tiles_y_((terrain.rows - 2) / tile_side + 1),
      first_row_(terrain.rows - 1 - tiles_y_ * tile_side),
      lowest_(tile_count()),
      highest_(tile_count()) {
  for (int side = 2; side <= tile_side_; side *= 2) {
    across_.push_back(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tile_side_ / side));
    records_.emplace_back(across_.back() * static_cast<std::size_t>(tiles_y_) *
                          static_cast<std::size_t>(tile_side_ / side));
  }
  for (int grain = kCoarse; grain <= tile_side_; grain *= 2) copy_coarse(grain);
  // Every tile writes its own nodes and reads samples only, so no order can show.
  tbb::parallel_for(std::size_t{0}, tile_count(), [this](std::size_t t) {
    const auto across = static_cast<std::size_t>(tiles_x_);
    fill_tile(static_cast<int>(t % across), static_cast<int>(t / across));
  });
}

void TileGrid::copy_coarse(int grain) {
  const auto along = [&](int tiles) { return static_cast<std::size_t>(tiles * (tile_side_ / grain) + 1); };
  Coarse& coarse = coarse_.emplace_back();
  coarse.columns = along(tiles_x_);
  coarse.heights_m.assign(coarse.columns * along(tiles_y_), 0.0);
  tbb::parallel_for(std::size_t{0}, along(tiles_y_), [&](std::size_t row) {
    const int j = first_row_ + static_cast<int>(row) * grain;
    for (std::size_t column = 0; column < coarse.columns; ++column) {
      const int i = static_cast<int>(column) * grain;
      if (has_data(i, j)) {
        coarse.heights_m[row * coarse.columns + column] =
            terrain_.z(PLUMBLINE_MUTANT(m3_coarse_heights_shifted) && i > 0 ? i - 1 : i, j);
      }
    }
  });
}

std::uint64_t TileGrid::node_count() const {
  std::uint64_t count = 0;
  for (const std::vector<Record>& level : records_) count += level.size();
  return count;
}

void TileGrid::fill_tile(int a, int b) {
  const Node square = tile(a, b);
  const int columns_end = std::min(square.i + square.side, terrain_.columns - 1);
  const int rows_end = square.j + square.side;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int j = std::max(square.j, 0); j <= rows_end; ++j) {
    for (int i = square.i; i <= columns_end; ++i) {
      low = std::min(low, terrain_.z(i, j));
      high = std::max(high, terrain_.z(i, j));
    }
  }
  lowest_[tile_index(a, b)] = low;
  highest_[tile_index(a, b)] = high;

  for (int side = 2; side <= tile_side_; side *= 2) {
    const int h = side / 2;
    for (int j = square.j; j < square.j + square.side; j += side) {
      for (int i = square.i; i < square.i + square.side; i += side) {
        const Node node{i, j, side};
        Record& record = records_[level(side)][slot(node)];
        if (has_data(i + h, j + h)) record.center_m = terrain_.z(i + h, j + h);
        if (PLUMBLINE_MUTANT(m3_centre_height_forgotten)) record.center_m = 0;
        if (side == 2) continue;  // the smallest nodes draw every sample they have: no error
        const double below = std::max(std::max(error_m({i, j, h}), error_m({i + h, j, h})),
                                      std::max(error_m({i, j + h, h}), error_m({i + h, j + h, h})));
        record.error_m =
            PLUMBLINE_MUTANT(m3_error_not_maxed) ? own_error_m(node) : std::max(own_error_m(node), below);
      }
    }
  }
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
    if (!has_data(std::max(i0, i1), std::min(j0, j1))) return;
    const double between = (terrain_.z(i0, j0) + terrain_.z(i1, j1)) / 2;
    error = std::max(error, std::abs(terrain_.z((i0 + i1) / 2, (j0 + j1) / 2) - between));
  };
  for (const int k : {0, 2}) {
    edge(k, 0, k + 2, 0);  // rim
    edge(k, 4, k + 2, 4);
    edge(0, k, 0, k + 2);
    edge(4, k, 4, k + 2);
    edge(k, 2, k + 2, 2);  // spokes to the edges' midpoints
    if (PLUMBLINE_MUTANT(m3_spoke_forgotten)) continue;
    edge(2, k, 2, k + 2);
    edge(k, k, k + 2, k + 2);  // and to the corners
    edge(4 - k, k, 2 - k, k + 2);
  }
  return error;
}

}  // namespace plumbline::isolated_quadtree
