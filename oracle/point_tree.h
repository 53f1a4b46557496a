// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "oracle/predicates.h"

namespace plumbline::oracle::detail {

/// Which of a set of points lie in the open interior of a segment? A k-d tree with tight boxes, split at
/// medians, so that neither clustered nor collinear points make it deep. Boxes only reject with certainty;
/// the answer is exact.
class PointTree {
 public:
  /// `points` must outlive the tree; `members` are the points to look among.
  PointTree(std::span<const Vec2> points, std::vector<std::uint32_t> members)
      : points_(points), members_(std::move(members)) {
    if (!members_.empty()) build(0, members_.size());
  }

  /// Appends the members inside segment ab, ordered from a to b.
  void inside(Vec2 a, Vec2 b, std::vector<std::uint32_t>& found) const {
    const std::size_t before = found.size();
    if (!nodes_.empty()) descend(0, a, b, found);
    const bool forwards = before_in_plan(a, b);
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
              [&](std::uint32_t p, std::uint32_t q) {
                return forwards ? before_in_plan(points_[p], points_[q])
                                : before_in_plan(points_[q], points_[p]);
              });
  }

 private:
  static constexpr std::size_t kLeafSize = 8;
  struct Node {
    Vec2 low, high;
    std::uint32_t first = 0, last = 0;  // members
    std::uint32_t second_child = 0;     // 0: a leaf; the first child follows its parent
  };

  std::uint32_t build(std::size_t first, std::size_t last) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Vec2 low = points_[members_[first]], high = low;
    for (std::size_t i = first; i < last; ++i) {
      const Vec2 p = points_[members_[i]];
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    nodes_[index] = {low, high, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last), 0};
    if (last - first > kLeafSize) {
      const std::size_t middle = first + (last - first) / 2;
      const bool by_x = high.x * 0.5 - low.x * 0.5 >= high.y * 0.5 - low.y * 0.5;
      const auto at = [this](std::size_t i) { return members_.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t p, std::uint32_t q) {
        const Vec2 u = points_[p], v = points_[q];
        return by_x ? before_in_plan(u, v) : (u.y != v.y ? u.y < v.y : u.x < v.x);
      });
      build(first, middle);
      nodes_[index].second_child = build(middle, last);
    }
    return index;
  }

  /// Certainly no point of the box on the segment?
  static bool misses(const Node& box, Vec2 a, Vec2 b) {
    if (std::max(a.x, b.x) < box.low.x || std::min(a.x, b.x) > box.high.x || std::max(a.y, b.y) < box.low.y ||
        std::min(a.y, b.y) > box.high.y) {
      return true;
    }
    // All four corners on one side of the line; a side that double cannot tell does not reject.
    int left = 0, right = 0;
    for (const Vec2 corner : {box.low, box.high, Vec2{box.low.x, box.high.y}, Vec2{box.high.x, box.low.y}}) {
      const double one = (a.x - corner.x) * (b.y - corner.y);
      const double two = (a.y - corner.y) * (b.x - corner.x);
      const double bound =
          kOrientationRelativeBound * (std::fabs(one) + std::fabs(two)) + kOrientationUnderflowBound;
      left += one - two > bound;
      right += two - one > bound;
    }
    return left == 4 || right == 4;
  }

  void descend(std::uint32_t index, Vec2 a, Vec2 b, std::vector<std::uint32_t>& found) const {
    const Node& node = nodes_[index];
    if (misses(node, a, b)) return;
    if (node.second_child != 0) {
      descend(index + 1, a, b, found);
      descend(node.second_child, a, b, found);
      return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      if (inside_segment(a, b, points_[members_[i]])) found.push_back(members_[i]);
    }
  }

  std::span<const Vec2> points_;
  std::vector<std::uint32_t> members_;
  std::vector<Node> nodes_;
};

}  // namespace plumbline::oracle::detail
