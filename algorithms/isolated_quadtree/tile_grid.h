// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "scenarios/terrain.h"
#include "scenarios/vec.h"

namespace plumbline::isolated_quadtree {

/// A node of a tile's quadtree: the square of `side` cells with its south-west sample at (i, j) of the
/// terrain. `side` is a power of two from 2 (nine neighbouring samples) to the tile's.
struct Node {
  int i = 0;
  int j = 0;
  int side = 2;
  [[nodiscard]] int half() const { return side / 2; }
};

/// The terrain cut into tiles of (2ⁿ+1)² samples that share their border rows and columns, with the
/// conservative geometric error of every quadtree node (§2.2), bottom-up. Tiles at the east and north border
/// may reach beyond the terrain: samples there are no-data.
class TileGrid {
 public:
  /// Requires: tile_side is a power of two, at least 2.
  TileGrid(const Terrain& terrain, int tile_side);

  [[nodiscard]] int tile_side() const { return tile_side_; }
  [[nodiscard]] int tiles_x() const { return tiles_x_; }
  [[nodiscard]] int tiles_y() const { return tiles_y_; }
  [[nodiscard]] const Terrain& terrain() const { return terrain_; }
  [[nodiscard]] Node tile(int a, int b) const { return {a * tile_side_, b * tile_side_, tile_side_}; }
  [[nodiscard]] bool has_data(int i, int j) const { return i < terrain_.columns && j < terrain_.rows; }
  /// Whether all samples of the node's square are data.
  [[nodiscard]] bool whole(Node node) const {
    return node.i + node.side < terrain_.columns && node.j + node.side < terrain_.rows;
  }
  /// e_n, metres: never below a child's.
  [[nodiscard]] double error_m(Node node) const { return errors_[level(node.side)][slot(node)]; }
  /// Least and greatest height of a tile's data, metres.
  [[nodiscard]] double lowest_m(int a, int b) const { return lowest_[tile_slot(a, b)]; }
  [[nodiscard]] double highest_m(int a, int b) const { return highest_[tile_slot(a, b)]; }

 private:
  [[nodiscard]] static std::size_t level(int side);
  [[nodiscard]] std::size_t slot(Node node) const {
    const auto across = static_cast<std::size_t>(tiles_x_ * (tile_side_ / node.side));
    return static_cast<std::size_t>(node.j / node.side) * across +
           static_cast<std::size_t>(node.i / node.side);
  }
  [[nodiscard]] std::size_t tile_slot(int a, int b) const {
    return static_cast<std::size_t>(b) * static_cast<std::size_t>(tiles_x_) + static_cast<std::size_t>(a);
  }
  [[nodiscard]] double own_error_m(Node node) const;

  const Terrain& terrain_;
  int tile_side_, tiles_x_, tiles_y_;
  std::vector<std::vector<double>> errors_;  ///< by level (side 2, 4, …), row-major over the whole terrain
  std::vector<double> lowest_, highest_;
};

}  // namespace plumbline::isolated_quadtree
