// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "algorithms/bintree/cluster_grid.h"
#include "scenarios/camera.h"

namespace plumbline::block_bintree {

/// A square of the block quadtree: level 0 is a whole cluster, a larger level is finer; column from the west,
/// row from the south, counted over the whole terrain.
struct BlockId {
  int level = 0, column = 0, row = 0;
  friend bool operator==(const BlockId&, const BlockId&) = default;
};

/// The quadtree of blocks over every cluster (METHODS M4, Blocks). A block of level q covers a square of 2ⁿ⁻ᑫ
/// cells with (2ᵏ+1)² samples: it stores the split nodes of bintree levels 2q … 2q+2k−1. The finest block
/// level is n−k.
class BlockTree {
 public:
  BlockTree() = default;
  /// `exponent` is k, 1 ≤ k ≤ n.
  BlockTree(const Terrain& terrain, const bintree::ClusterGrid& grid, int exponent);

  [[nodiscard]] int exponent() const { return exponent_; }                         ///< k
  [[nodiscard]] int finest_level() const { return grid_.exponent() - exponent_; }  ///< n−k
  [[nodiscard]] int columns(int level) const { return grid_.cluster_columns() << level; }
  [[nodiscard]] int rows(int level) const { return grid_.cluster_rows() << level; }
  [[nodiscard]] std::size_t count() const { return offsets_.back(); }
  /// The block's place in arrays over all blocks, level by level from the coarsest.
  [[nodiscard]] std::size_t index(BlockId id) const {
    return offsets_[static_cast<std::size_t>(id.level)] +
           static_cast<std::size_t>(id.row) * static_cast<std::size_t>(columns(id.level)) +
           static_cast<std::size_t>(id.column);
  }
  /// The block of that level around a point in the interior of a cell of its square.
  [[nodiscard]] BlockId containing(bintree::GridPoint p, int level) const {
    const int shift = grid_.exponent() - level;
    return {level, p.i >> shift, p.j >> shift};
  }
  [[nodiscard]] bintree::GridPoint centre(BlockId id) const {
    const int side = grid_.side() >> id.level;
    return {id.column * side + side / 2, id.row * side + side / 2};
  }
  [[nodiscard]] std::array<BlockId, 4> children(BlockId id) const;
  [[nodiscard]] double side_m(int level) const { return (grid_.side() >> level) * grid_.spacing_m(); }

  /// Whether the ball around the box of all the square's samples lies wholly outside the view cone.
  [[nodiscard]] bool outside_view_cone(BlockId id, const Camera& camera) const;
  /// Distance from a point to that box, metres; 0 inside.
  [[nodiscard]] double distance_m(BlockId id, Vec3 point) const;

 private:
  struct HeightRange {
    double low_m = 0, high_m = 0;
  };
  bintree::ClusterGrid grid_;
  int exponent_ = 0;
  std::vector<std::size_t> offsets_;  ///< by level, and the total
  std::vector<HeightRange> heights_;  ///< by index(): over all samples of the square at full resolution
};

}  // namespace plumbline::block_bintree
