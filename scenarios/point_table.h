// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "scenarios/vec.h"

namespace plumbline {

/// Numbers points in order of first appearance; those with equal bits share a number, and so do −0 and 0.
/// Open addressing: the numbers do not depend on the hash. Points that a file's maker chose to meet in one
/// slot are parted by another hash, so that n of them take n steps, not n².
class PointTable {
 public:
  /// `expected`: about how many different points will come.
  explicit PointTable(std::size_t expected = 0) {
    rehash(std::bit_ceil(expected * 2 + 16));
    points_.reserve(expected);
  }

  std::uint32_t number(Vec3 p) {
    if (points_.size() * 2 >= slots_.size()) rehash(slots_.size() * 2);
    const Bits wanted = bits(p);
    std::size_t steps = 0;
    for (std::size_t at = slot(wanted);; at = (at + 1) & (slots_.size() - 1)) {
      if (slots_[at] == kEmpty) {
        slots_[at] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(p);
        return slots_[at];
      }
      if (bits(points_[slots_[at]]) == wanted) return slots_[at];
      if (++steps == kLongWay && salt_ < kMostSalts) {
        ++salt_;
        rehash(slots_.size());
        return number(p);
      }
    }
  }
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  /// How often the hash was changed.
  [[nodiscard]] std::size_t salts() const { return salt_; }
  /// The points by their numbers, each as it came first. The table is empty then.
  std::vector<Vec3> take() {
    std::fill(slots_.begin(), slots_.end(), kEmpty);
    return std::exchange(points_, {});
  }

 private:
  using Bits = std::array<std::uint64_t, 3>;
  static constexpr std::uint32_t kEmpty = 0xffffffffU;
  // Half full, chance makes no way of a hundred steps; each change of the hash costs as much as growing.
  static constexpr std::size_t kLongWay = 512, kMostSalts = 64;

  static Bits bits(Vec3 p) {
    const auto of = [](double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); };
    return {of(p.x), of(p.y), of(p.z)};
  }
  [[nodiscard]] std::size_t slot(const Bits& p) const {
    std::uint64_t h = salt_ * 0xd1342543de82ef95;
    for (const std::uint64_t c : p) {
      h = (h ^ c) * 0x9e3779b97f4a7c15;
      h ^= h >> 29U;
    }
    h *= 0xbf58476d1ce4e5b9;
    return static_cast<std::size_t>(h ^ h >> 32U) & (slots_.size() - 1);
  }
  void rehash(std::size_t slots) {
    slots_.assign(slots, kEmpty);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      std::size_t at = slot(bits(points_[i]));
      while (slots_[at] != kEmpty) at = (at + 1) & (slots - 1);
      slots_[at] = i;
    }
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Vec3> points_;
  std::uint64_t salt_ = 0;
};

}  // namespace plumbline
