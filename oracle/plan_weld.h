// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "scenarios/vec.h"

namespace plumbline::oracle::detail {

/// Numbers points in order of first appearance; equal ones (by ==, so -0 is 0) share a number. Open
/// addressing: the numbers do not depend on the hash.
class PointTable {
 public:
  /// `expected`: about how many points will come.
  explicit PointTable(std::size_t expected) { rehash(std::bit_ceil(expected * 2 + 16)); }

  /// Requires: p is finite.
  std::uint32_t number(Vec3 p) {
    if (points_.size() * 2 >= slots_.size()) rehash(slots_.size() * 2);
    for (std::size_t at = slot(p);; at = (at + 1) & (slots_.size() - 1)) {
      if (slots_[at] == kEmpty) {
        slots_[at] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(p);
        return slots_[at];
      }
      if (points_[slots_[at]] == p) return slots_[at];
    }
  }
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const Vec3& operator[](std::uint32_t i) const { return points_[i]; }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;

  [[nodiscard]] std::size_t slot(const Vec3& p) const {
    std::uint64_t h = 0;
    for (const double c : {p.x, p.y, p.z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15;  // + 0.0 makes -0 into 0
      h ^= h >> 29;
    }
    h *= 0xbf58476d1ce4e5b9;
    return static_cast<std::size_t>(h ^ h >> 32) & (slots_.size() - 1);
  }
  void rehash(std::size_t slots) {
    slots_.assign(slots, kEmpty);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      std::size_t at = slot(points_[i]);
      while (slots_[at] != kEmpty) at = (at + 1) & (slots - 1);
      slots_[at] = i;
    }
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Vec3> points_;
};

}  // namespace plumbline::oracle::detail
