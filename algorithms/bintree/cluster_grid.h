// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scenarios/terrain.h"

// The right-triangle bintree over a height grid: geometry shared by `block_bintree` and
// `restricted_quadtree`.
//
// A terrain of (m1·2ⁿ+1) × (m2·2ⁿ+1) samples is m1 × m2 square *clusters*; neighbours share a row or column
// of samples. Each cluster is two right triangles, split by the diagonal from its (0,0) to its (2ⁿ,2ⁿ)
// corner: bintree level 0. A triangle of level l splits at the midpoint of its hypotenuse, its *split node*,
// into two of level l+1; levels count up to 2n (half a grid cell), which does not split. Larger level =
// finer. Every sample but the cluster corners is the split node of exactly one hypotenuse, hence has one
// level.
//
// Even levels 2q: split nodes are centres of squares of side 2ⁿ⁻ᑫ ("quadtree level q"), the hypotenuse is the
// square's diagonal: for q = 0 as above, from q = 1 on it runs to the parent square's centre. Odd levels
// 2q+1: split nodes are midpoints of those squares' sides. All clusters have the same root diagonal, so a
// cluster's sides are hypotenuses shared with its neighbour.
namespace plumbline::bintree {

/// A sample's column i (east) and row j (north).
struct GridPoint {
  int i = 0, j = 0;
  friend bool operator==(GridPoint, GridPoint) = default;
};

/// Midpoint of two samples. Requires: it is a sample.
constexpr GridPoint midpoint(GridPoint a, GridPoint b) { return {(a.i + b.i) >> 1, (a.j + b.j) >> 1}; }

/// A right triangle; apex → left → right runs counter-clockwise in plan, left–right is the hypotenuse.
struct RightTriangle {
  GridPoint apex, left, right;
  [[nodiscard]] GridPoint split_node() const { return midpoint(left, right); }
  /// The halves; their apex is the split node.
  [[nodiscard]] RightTriangle left_half(GridPoint node) const { return {node, apex, left}; }
  [[nodiscard]] RightTriangle right_half(GridPoint node) const { return {node, right, apex}; }
};

/// Up to four grid points, without allocation.
struct PointList {
  std::array<GridPoint, 4> points{};
  int count = 0;
  void add(GridPoint p) { points[static_cast<std::size_t>(count++)] = p; }
  [[nodiscard]] const GridPoint* begin() const { return points.data(); }
  [[nodiscard]] const GridPoint* end() const { return points.data() + count; }
};

/// The one or two triangles on a hypotenuse: the quadrilateral around a split node.
struct Diamond {
  GridPoint left, right;  ///< ends of the hypotenuse (the paper's A and C)
  PointList apexes;       ///< the paper's B and D; one on the terrain's border
};

/// How the grid is cut into clusters, and who is whose neighbour in the bintree.
class ClusterGrid {
 public:
  ClusterGrid() = default;
  /// `cluster_samples`: 2ⁿ+1, samples along a cluster's side; 0 takes the largest 2ⁿ that divides both sides
  /// of the grid. Throws InputError (beginning with `method`) if no n ≥ 1 fits: such a terrain has no
  /// bintree.
  ClusterGrid(const Terrain& terrain, double cluster_samples, std::string_view method);

  [[nodiscard]] int columns() const { return columns_; }  ///< samples
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] std::size_t samples() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  [[nodiscard]] int exponent() const { return exponent_; }   ///< n
  [[nodiscard]] int side() const { return 1 << exponent_; }  ///< 2ⁿ, cells along a cluster's side
  [[nodiscard]] int cluster_columns() const { return (columns_ - 1) >> exponent_; }  ///< m1
  [[nodiscard]] int cluster_rows() const { return (rows_ - 1) >> exponent_; }        ///< m2
  [[nodiscard]] int levels() const { return 2 * exponent_; }  ///< split nodes have levels 0 … levels()−1
  [[nodiscard]] double spacing_m() const { return spacing_m_; }

  [[nodiscard]] std::size_t index(GridPoint p) const {
    return static_cast<std::size_t>(p.j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(p.i);
  }
  /// The two triangles of the square around a split node of even level, the southern one first.
  [[nodiscard]] std::array<RightTriangle, 2> halves(GridPoint centre) const;
  /// The root split node of cluster (a, b), column a from the west, row b from the south.
  [[nodiscard]] GridPoint root(int a, int b) const {
    return {(a << exponent_) + side() / 2, (b << exponent_) + side() / 2};
  }

  /// Whether p is a split node: any sample but a cluster's corner. The functions below require it.
  [[nodiscard]] bool is_split_node(GridPoint p) const { return ((p.i | p.j) & (side() - 1)) != 0; }
  [[nodiscard]] int level(GridPoint node) const;
  [[nodiscard]] Diamond diamond(GridPoint node) const;
  /// The split nodes one level up whose splitting makes this node's triangles: the diamond's apexes. None at
  /// level 0, one at the terrain's border.
  [[nodiscard]] PointList parents(GridPoint node) const;
  /// The split nodes one level down: midpoints of the diamond's sides, two or four; none at the last level.
  [[nodiscard]] PointList children(GridPoint node) const;
  /// d: the length in plan of a hypotenuse of that level, metres.
  [[nodiscard]] double hypotenuse_m(int level) const;

 private:
  [[nodiscard]] bool inside(GridPoint p) const {
    return p.i >= 0 && p.j >= 0 && p.i < columns_ && p.j < rows_;
  }
  [[nodiscard]] int half_step(GridPoint node) const;

  int columns_ = 0, rows_ = 0, exponent_ = 0;
  double spacing_m_ = 0;
};

}  // namespace plumbline::bintree
