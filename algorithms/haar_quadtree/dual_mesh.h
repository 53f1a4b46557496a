// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/haar_quadtree/forest.h"

namespace plumbline::haar_quadtree {

/// A cut of the forest: which nodes are `NotNull` (split). A node that is not split, under one that is (or a
/// patch's root), is a `NullSubTreeRoot`; nodes below it are never split. Any cut is allowed: neighbours may
/// differ by any number of levels.
class Cut {
 public:
  explicit Cut(const Forest& forest) : forest_(&forest), split_(forest.node_count(), 0) {}

  [[nodiscard]] const Forest& forest() const { return *forest_; }
  [[nodiscard]] bool is_split(Node node) const { return split_[forest_->index(node)] != 0; }
  /// Requires for `true`: the node is a root of the cut and no leaf; for `false`: its children are all roots.
  void set_split(Node node, bool split) { split_[forest_->index(node)] = split ? 1 : 0; }
  void clear() { split_.assign(split_.size(), 0); }

 private:
  const Forest* forest_;
  std::vector<std::uint8_t> split_;
};

/// The children in the order south-west, south-east, north-west, north-east.
inline std::array<Node, 4> children(Node node) {
  const int level = node.level + 1;
  return {Node{level, 2 * node.a, 2 * node.b}, Node{level, 2 * node.a + 1, 2 * node.b},
          Node{level, 2 * node.a, 2 * node.b + 1}, Node{level, 2 * node.a + 1, 2 * node.b + 1}};
}

/// The adaptive triangulation of a cut (§4): as if in the full triangulation every vertex were moved onto its
/// root and all degenerate triangles dropped. Equivalently the dual of the partition into cells: one triangle
/// where three cells meet in a point, two where four meet, with the diagonal from the south-west cell to the
/// north-east one. Walks the tree's cells, common edges and corners; cost proportional to the output.
/// `vertex_of[forest.index(root)]` is the mesh vertex of each root of the cut; entries of other nodes are not
/// read.
void triangulate(const Cut& cut, const std::vector<std::uint32_t>& vertex_of,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The specification, taken literally: every triangle of the full triangulation with its corners moved onto
/// their roots. Linear in the samples; the oracle of the tests. Triangles in no particular order.
void collapse_full_triangulation(const Cut& cut, const std::vector<std::uint32_t>& vertex_of,
                                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace plumbline::haar_quadtree
