// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/bintree/frame_builder.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <tuple>

#include "algorithms/mutant.h"

namespace plumbline::bintree {

FrameBuilder::FrameBuilder(const Terrain& terrain, const LevelOrder& order)
    : terrain_(&terrain), order_(order), slots_(order.size(), 0) {}

void FrameBuilder::begin(LodFrame& frame) {
  frame.clear();
  frame_ = &frame;
  dropped_.clear();
  if (stamp_ == std::numeric_limits<std::uint32_t>::max()) {
    std::fill(slots_.begin(), slots_.end(), 0);
    stamp_ = 0;
  }
  if (!PLUMBLINE_MUTANT(m4_stale_vertices) || stamp_ == 0) ++stamp_;
}

std::uint32_t FrameBuilder::vertex(GridPoint p) {
  std::uint64_t& slot = slots_[order_.index(p)];
  if (slot >> 32 == stamp_) return static_cast<std::uint32_t>(slot);
  const auto index = static_cast<std::uint32_t>(frame_->mesh.positions.size());
  slot = std::uint64_t{stamp_} << 32 | index;
  frame_->mesh.positions.push_back(terrain_->point(p.i, p.j));
  frame_->vertex_keys.push_back(terrain_->index(p.i, p.j));
  return index;
}

void FrameBuilder::emit(const RightTriangle& triangle) {
  const std::uint32_t apex = vertex(triangle.apex);
  const std::uint32_t left = vertex(triangle.left);
  const std::uint32_t right = vertex(triangle.right);
  if (PLUMBLINE_MUTANT(m4_wrong_winding) && triangle.left.i == triangle.right.i) {
    frame_->mesh.triangles.push_back({apex, right, left});
    return;
  }
  frame_->mesh.triangles.push_back({apex, left, right});
}

bool FrameBuilder::is_corner(GridPoint p) const {
  const std::size_t k = order_.index(p);
  return slots_[k] >> 32 == stamp_ || std::binary_search(dropped_corners_.begin(), dropped_corners_.end(), k);
}

// What borders on a dropped triangle, drawn or dropped, may be finer than it. Along a diagonal its corners
// need not lie exactly on one line, since i·spacing is rounded; so the domain's border goes through them.
// Along rows and columns they do.
void FrameBuilder::append_edge(GridPoint from, GridPoint to, std::vector<Vec2>& loop) const {
  const bool diagonal = from.i != to.i && from.j != to.j;
  if (diagonal && std::abs(to.i - from.i) > 1 && is_corner(midpoint(from, to))) {
    append_edge(from, midpoint(from, to), loop);
    append_edge(midpoint(from, to), to, loop);
  } else {
    loop.push_back(plan(from));
  }
}

void FrameBuilder::finish() {
  if (frame_->mesh.triangles.empty()) return;
  frame_->domain = full_domain(*terrain_);
  // Both triangles of a diamond become one loop. Sorted by split node, since the loops' order is part of the
  // result.
  const auto key = [](const RightTriangle& t) {
    const GridPoint node = t.split_node();
    return std::tuple(node.j, node.i, t.apex.j, t.apex.i);
  };
  std::sort(dropped_.begin(), dropped_.end(),
            [&](const RightTriangle& a, const RightTriangle& b) { return key(a) < key(b); });
  dropped_corners_.clear();
  for (const RightTriangle& t : dropped_) {
    for (const GridPoint p : {t.apex, t.left, t.right}) dropped_corners_.push_back(order_.index(p));
  }
  std::sort(dropped_corners_.begin(), dropped_corners_.end());
  for (std::size_t k = 0; k < dropped_.size(); ++k) {
    const RightTriangle& t = dropped_[k];
    const bool whole = k + 1 < dropped_.size() && dropped_[k + 1].split_node() == t.split_node();
    std::vector<Vec2> hole;  // clockwise
    append_edge(t.apex, t.right, hole);
    if (whole) {
      const GridPoint other_apex = dropped_[++k].apex;
      append_edge(t.right, other_apex, hole);
      append_edge(other_apex, t.left, hole);
    } else {
      append_edge(t.right, t.left, hole);
    }
    append_edge(t.left, t.apex, hole);
    frame_->domain.loops.push_back(std::move(hole));
  }
}

}  // namespace plumbline::bintree
