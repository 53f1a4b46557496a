// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "scenarios/vec.h"

namespace plumbline::oracle::detail {

struct PlanSegment {
  Vec2 a, b;
};

/// Distance from a point to the nearest of many segments. Figures only: rounded, no decision rests on it.
class SegmentTree {
 public:
  explicit SegmentTree(std::vector<PlanSegment> segments) : segments_(std::move(segments)) {
    if (!segments_.empty()) build(0, segments_.size());
  }

  /// 0 if there are no segments.
  [[nodiscard]] double distance(Vec2 p) const {
    if (segments_.empty()) return 0;
    double best2 = std::numeric_limits<double>::infinity();
    descend(0, p, best2);
    return std::sqrt(best2);
  }

  /// Calls visit(segment) for each segment no farther from p than `distance`.
  template <class Visit>
  void visit_within(Vec2 p, double distance, Visit visit) const {
    std::vector<std::uint32_t> todo;
    if (!segments_.empty()) todo.push_back(0);
    while (!todo.empty()) {
      const std::uint32_t index = todo.back();
      todo.pop_back();
      const Node& node = nodes_[index];
      if (off2(node, p) > distance * distance * kSafety) continue;
      if (node.second_child != 0) {
        todo.insert(todo.end(), {node.second_child, index + 1});
        continue;
      }
      for (std::uint32_t i = node.first; i < node.last; ++i) {
        if (distance2(segments_[i], p) <= distance * distance) visit(segments_[i]);
      }
    }
  }

  /// From the nearest point of the segment to p, rounded.
  static Vec2 offset(const PlanSegment& s, Vec2 p) {
    const Vec2 d = s.b - s.a, e = p - s.a;
    const double length2 = d.x * d.x + d.y * d.y;
    const double share = length2 > 0 ? std::clamp((d.x * e.x + d.y * e.y) / length2, 0.0, 1.0) : 0.0;
    return e - d * share;
  }

 private:
  static constexpr std::size_t kLeafSize = 4;
  /// A box is passed over only if it is farther by more than rounding can explain.
  static constexpr double kSafety = 1 + 0x1p-40;
  struct Node {
    Vec2 low, high;
    std::uint32_t first = 0, last = 0;
    std::uint32_t second_child = 0;
  };

  std::uint32_t build(std::size_t first, std::size_t last) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    constexpr double inf = std::numeric_limits<double>::infinity();
    Node node{
        {inf, inf}, {-inf, -inf}, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last), 0};
    for (std::size_t i = first; i < last; ++i) {
      for (const Vec2 p : {segments_[i].a, segments_[i].b}) {
        node.low = {std::min(node.low.x, p.x), std::min(node.low.y, p.y)};
        node.high = {std::max(node.high.x, p.x), std::max(node.high.y, p.y)};
      }
    }
    nodes_.push_back(node);
    if (last - first > kLeafSize) {
      const std::size_t middle = first + (last - first) / 2;
      const bool by_x = node.high.x * 0.5 - node.low.x * 0.5 >= node.high.y * 0.5 - node.low.y * 0.5;
      const auto at = [this](std::size_t i) { return segments_.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(at(first), at(middle), at(last), [by_x](const PlanSegment& s, const PlanSegment& t) {
        return by_x ? s.a.x * 0.5 + s.b.x * 0.5 < t.a.x * 0.5 + t.b.x * 0.5
                    : s.a.y * 0.5 + s.b.y * 0.5 < t.a.y * 0.5 + t.b.y * 0.5;
      });
      build(first, middle);
      const std::uint32_t second = build(middle, last);
      nodes_[index].second_child = second;
    }
    return index;
  }

  static double distance2(const PlanSegment& s, Vec2 p) {
    const Vec2 off = offset(s, p);
    return off.x * off.x + off.y * off.y;
  }

  static double off2(const Node& node, Vec2 p) {
    const double dx = std::max({node.low.x - p.x, p.x - node.high.x, 0.0});
    const double dy = std::max({node.low.y - p.y, p.y - node.high.y, 0.0});
    return dx * dx + dy * dy;
  }

  void descend(std::uint32_t index, Vec2 p, double& best2) const {
    const Node& node = nodes_[index];
    if (off2(node, p) > best2 * kSafety) return;
    if (node.second_child != 0) {
      descend(index + 1, p, best2);
      descend(node.second_child, p, best2);
      return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i)
      best2 = std::min(best2, distance2(segments_[i], p));
  }

  std::vector<PlanSegment> segments_;
  std::vector<Node> nodes_;
};

}  // namespace plumbline::oracle::detail
