// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "algorithms/vertex_tree/vertex_tree.h"

namespace plumbline::vertex_tree {

/// A mesh between the full one and the coarsest: the nodes of a tree that are present now. Moves by collapse
/// and split, each allowed by one comparison of integers (paper, definition 2). A copy is independent.
class Cut {
 public:
  /// The full mesh. `tree` is not null.
  explicit Cut(std::shared_ptr<const VertexTree> tree);

  [[nodiscard]] const VertexTree& tree() const { return *tree_; }
  [[nodiscard]] std::size_t triangle_count() const { return live_count_; }
  [[nodiscard]] bool present(std::uint32_t v) const { return present_[v] != 0; }
  /// CAT: the non-degenerate triangles at present node v, in no order.
  [[nodiscard]] const std::vector<std::uint32_t>& star(std::uint32_t v) const { return stars_[v]; }
  /// The present corners of triangle t. Requires: live(t).
  [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t t) const { return now_[t]; }
  [[nodiscard]] bool live(std::uint32_t t) const { return live_[t] != 0; }
  /// M: the greatest identifier among v's neighbours. Requires: present(v).
  [[nodiscard]] std::uint32_t greatest_neighbour(std::uint32_t v) const { return greatest_[v]; }
  /// m: the least parent among v's neighbours, its partner left out; kNone: +∞. Requires: present(v).
  [[nodiscard]] std::uint32_t least_parent(std::uint32_t v) const { return least_[v]; }

  /// Whether p's children are present and may become p. Requires: p is a made node.
  [[nodiscard]] bool may_collapse(std::uint32_t p) const {
    const auto& [a, b] = tree_->children[p - tree_->originals];
    return present_[a] && present_[b] && p < std::min(least_[a], least_[b]);
  }
  /// Whether p is present and may become its children. Requires: p is a made node.
  [[nodiscard]] bool may_split(std::uint32_t p) const { return present_[p] && p > greatest_[p]; }
  /// Requires: may_collapse(p).
  void collapse(std::uint32_t p);
  /// Requires: may_split(p).
  void split(std::uint32_t p);
  /// Splits p, and before it every neighbour that is in the way. Returns the number of splits. Requires:
  /// present(p), p is a made node.
  std::size_t force_split(std::uint32_t p);

  /// Collapses the least legal identifier first, until `triangles` or fewer are left or nothing more is
  /// legal; nodes for which `held` answers true are not made. Returns the number of collapses.
  std::size_t coarsen(std::size_t triangles, const std::function<bool(std::uint32_t)>& held = {});
  /// Splits the greatest identifier first, as long as no more than `triangles` result. Returns the number.
  std::size_t refine(std::size_t triangles);

  /// Present nodes in order of identifier, live triangles in order of index; `keys` are identifiers.
  void extract(Mesh& mesh, std::vector<std::uint64_t>& keys) const;

 private:
  void look_around(std::uint32_t v);

  std::shared_ptr<const VertexTree> tree_;
  std::vector<std::array<std::uint32_t, 3>> now_;
  std::vector<std::uint8_t> live_, present_;
  std::vector<std::vector<std::uint32_t>> stars_;
  std::vector<std::uint32_t> greatest_, least_;
  std::size_t live_count_;
};

}  // namespace plumbline::vertex_tree
