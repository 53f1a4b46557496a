// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "algorithms/bintree/cluster_grid.h"

namespace plumbline::bintree {

/// Numbers the samples level by level, coarse first, each level row by row. A frame visits the coarse levels
/// whole and patches of the fine ones: in this order what it reads lies together, where in the grid's own
/// order every node of a coarse level has a cache line to itself. Each level's numbering has a closed form; a
/// few numbers stay unused.
class LevelOrder {
 public:
  LevelOrder() = default;
  explicit LevelOrder(const ClusterGrid& grid) : exponent_(grid.exponent()) {
    for (int level = 0; level < grid.levels(); ++level) {
      const int q = level / 2;
      const bool odd = level % 2 != 0;  // nodes on every row of half squares, and on the last column too
      const int columns = (grid.cluster_columns() << q) + (odd ? 1 : 0);
      const int rows = odd ? (grid.cluster_rows() << (q + 1)) + 1 : grid.cluster_rows() << q;
      add(columns, rows, exponent_ - q, exponent_ - q - (odd ? 1 : 0));
    }
    add(grid.cluster_columns() + 1, grid.cluster_rows() + 1, exponent_, exponent_);  // the clusters' corners
  }

  /// One more than the largest index.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Of a split node. Requires: `level` is its level.
  [[nodiscard]] std::size_t index(GridPoint node, int level) const {
    const Level& l = levels_[static_cast<std::size_t>(level)];
    return l.offset + static_cast<std::size_t>(node.j >> l.row_shift) * l.columns +
           static_cast<std::size_t>(node.i >> l.column_shift);
  }
  /// Of any sample.
  [[nodiscard]] std::size_t index(GridPoint p) const {
    const int zeros = std::countr_zero(static_cast<unsigned>(p.i | p.j) | 1U << exponent_);
    if (zeros >= exponent_) return index(p, 2 * exponent_);
    const bool centre = ((p.i & p.j) >> zeros & 1) != 0;
    return index(p, 2 * (exponent_ - 1 - zeros) + (centre ? 0 : 1));
  }

 private:
  struct Level {
    std::size_t offset, columns;
    int column_shift, row_shift;
  };
  void add(int columns, int rows, int column_shift, int row_shift) {
    levels_.push_back({size_, static_cast<std::size_t>(columns), column_shift, row_shift});
    size_ += static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }

  int exponent_ = 0;
  std::size_t size_ = 0;
  std::vector<Level> levels_;  ///< by level; last: the clusters' corners
};

}  // namespace plumbline::bintree
