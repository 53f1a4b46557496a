// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
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
/// conservative geometric error of every quadtree node (§2.2), bottom-up. As on a map, the paper's
/// first row is the northernmost: tiles count from the north-west corner, and those at the right (east) and
/// bottom (south) border may reach beyond the terrain. Samples there are no-data; those south of the terrain
/// have negative rows.
class TileGrid {
 public:
  /// One linear pass, tiles in parallel; the same bits on any number of threads. Requires: tile_side is a
  /// power of two, at least 2. `terrain` outlives the grid.
  TileGrid(const Terrain& terrain, int tile_side);

  [[nodiscard]] int tile_side() const { return tile_side_; }
  [[nodiscard]] int tiles_x() const { return tiles_x_; }
  [[nodiscard]] int tiles_y() const { return tiles_y_; }
  [[nodiscard]] std::size_t tile_count() const {
    return static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_);
  }
  /// Nodes of all tiles' quadtrees, those without data among them.
  [[nodiscard]] std::uint64_t node_count() const;
  [[nodiscard]] const Terrain& terrain() const { return terrain_; }
  [[nodiscard]] Node tile(int a, int b) const {
    return {a * tile_side_, first_row_ + b * tile_side_, tile_side_};
  }
  /// Tile (a, b) stands a-th from the west, b-th from the south; the index is row-major from the south-west.
  [[nodiscard]] std::size_t tile_index(int a, int b) const {
    return static_cast<std::size_t>(b) * static_cast<std::size_t>(tiles_x_) + static_cast<std::size_t>(a);
  }
  [[nodiscard]] bool has_data(int i, int j) const { return i < terrain_.columns && j >= 0; }
  /// Whether all samples of the node's square are data.
  [[nodiscard]] bool whole(Node node) const { return node.i + node.side < terrain_.columns && node.j >= 0; }
  /// Whether the square holds any cell of the terrain.
  [[nodiscard]] bool holds_ground(Node node) const {
    return node.i + 1 < terrain_.columns && node.j + node.side >= 1;
  }
  /// What the split test reads of a node, side by side in memory.
  struct Record {
    double error_m = 0;   ///< e_n: never below a child's
    double center_m = 0;  ///< height of the centre sample; 0 where that is no-data
  };
  [[nodiscard]] const Record& record(Node node) const { return records_[level(node.side)][slot(node)]; }
  [[nodiscard]] double error_m(Node node) const { return record(node).error_m; }
  /// Height of a sample whose distances from the tile's south-west corner are multiples of `grain`, a power
  /// of two up to the tile's side; metres. Requires: has_data(i, j).
  [[nodiscard]] double height_m(int i, int j, int grain) const {
    if (grain < kCoarse) return terrain_.z(i, j);
    const auto shift = static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(grain)));
    const Coarse& coarse = coarse_[shift - kCoarseShift];
    return coarse.heights_m[(static_cast<std::size_t>(j - first_row_) >> shift) * coarse.columns +
                            (static_cast<std::size_t>(i) >> shift)];
  }
  /// Least and greatest height of a tile's data, metres.
  [[nodiscard]] double lowest_m(int a, int b) const { return lowest_[tile_index(a, b)]; }
  [[nodiscard]] double highest_m(int a, int b) const { return highest_[tile_index(a, b)]; }

 private:
  /// Level 0 is the smallest nodes, of side 2.
  [[nodiscard]] static std::size_t level(int side) {
    return static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(side))) - 1;
  }
  [[nodiscard]] std::size_t slot(Node node) const {
    const std::size_t shift = level(node.side) + 1;
    return (static_cast<std::size_t>(node.j - first_row_) >> shift) * across_[shift - 1] +
           (static_cast<std::size_t>(node.i) >> shift);
  }
  void fill_tile(int a, int b);
  [[nodiscard]] double own_error_m(Node node) const;

  /// Every 2ᵏ-th sample once more, for one k. A frame draws few samples of a large terrain, each on a memory
  /// page of its own; here those of a coarse node's neighbourhood stand together, so that a frame's cost does
  /// not grow with the terrain. Together they take a twelfth of the terrain's memory.
  struct Coarse {
    std::size_t columns = 0;
    std::vector<double> heights_m;  ///< row-major from the south-west tile's corner; 0 where no-data
  };
  static constexpr unsigned kCoarseShift = 2;  ///< finer samples stand close enough in the terrain
  static constexpr int kCoarse = 1 << kCoarseShift;
  void copy_coarse(int grain);

  const Terrain& terrain_;
  int tile_side_, tiles_x_, tiles_y_;
  int first_row_;                             ///< of the southernmost tiles; at most 0
  std::vector<std::size_t> across_;           ///< nodes in a row of each level
  std::vector<std::vector<Record>> records_;  ///< by level, row-major over the whole terrain
  std::vector<Coarse> coarse_;                ///< by k − kCoarseShift
  std::vector<double> lowest_, highest_;
};

}  // namespace plumbline::isolated_quadtree
