// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/haar_quadtree/forest.h"

namespace plumbline::haar_quadtree {

/// A cut of the forest, and nothing of what lies below it: R roots take (4R − patches)/3 words, whatever the
/// terrain. Any cut is allowed: neighbours may differ by any number of levels.
///
/// Each node on or above the cut has a slot. Slot p < patches is patch p's root; a split node (`NotNull`)
/// names in its slot the slot of its south-west child, and the other three children follow. A node that is
/// not split (`NullSubTreeRoot`) holds the number of its mesh vertex instead.
class Cut {
 public:
  using Slot = std::uint32_t;

  /// Every patch is a root.
  explicit Cut(std::size_t patches = 0) { start(patches); }
  /// Every patch is a root again. Memory is kept.
  void start(std::size_t patches) {
    used_ = 0;
    add(patches);
  }

  [[nodiscard]] std::size_t size() const { return used_; }
  /// Each split makes three roots more. Requires: `patches` as at the start.
  [[nodiscard]] std::size_t roots(std::size_t patches) const { return patches + (used_ - patches) / 4 * 3; }
  [[nodiscard]] bool is_root(Slot slot) const { return (slots_[slot] & kRoot) != 0; }
  /// The south-west child. Requires: the slot is split.
  [[nodiscard]] Slot children(Slot slot) const { return slots_[slot]; }
  [[nodiscard]] bool children_are_roots(Slot slot) const {
    const Slot* c = &slots_[children(slot)];
    return (c[0] & c[1] & c[2] & c[3] & kRoot) != 0;
  }
  /// Splits a root; its children become roots. Returns the first of them. Requires: the node is no leaf.
  Slot split(Slot slot) {
    const auto first = static_cast<Slot>(used_);
    slots_[slot] = first;
    add(4);
    return first;
  }
  /// Takes the latest split back. Requires: it was `slot`'s.
  void take_back(Slot slot) {
    used_ -= 4;
    slots_[slot] = kRoot;
  }
  /// Requires: the slot is a root.
  void set_vertex(Slot slot, std::uint32_t vertex) { slots_[slot] = kRoot | vertex; }
  [[nodiscard]] std::uint32_t vertex(Slot slot) const { return slots_[slot] & ~kRoot; }

 private:
  static constexpr Slot kRoot = Slot{1} << 31;

  void add(std::size_t count) {
    if (used_ + count > slots_.size()) slots_.resize(2 * slots_.size() + count);
    std::fill_n(slots_.begin() + static_cast<std::ptrdiff_t>(used_), count, kRoot);
    used_ += count;
  }

  std::vector<Slot> slots_;  ///< the first `used_` count; the others are memory for later
  std::size_t used_ = 0;
};

/// Calls `action(node, slot)` for every root of the cut, patch by patch along the Z curve.
template <class Action>
void for_each_root(const Forest& forest, const Cut& cut, Action&& action) {
  const auto go = [&](const auto& self, const Node& node, Cut::Slot slot) -> void {
    if (cut.is_root(slot)) {
      action(node, slot);
      return;
    }
    for (int k = 0; k < 4; ++k) self(self, child(node, k), cut.children(slot) + static_cast<Cut::Slot>(k));
  };
  for (std::size_t p = 0; p < forest.patches(); ++p) go(go, forest.patch(p), static_cast<Cut::Slot>(p));
}

}  // namespace plumbline::haar_quadtree
