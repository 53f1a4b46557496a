// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/bintree/level_order.h"
#include "algorithms/lod_method.h"

namespace plumbline::bintree {

/// Writes a frame from right triangles: finds each sample's vertex again without hashing, and keeps the plan
/// domain. An array over all samples says in which frame a sample last became a vertex, so a frame costs what
/// it emits.
class FrameBuilder {
 public:
  FrameBuilder() = default;
  FrameBuilder(const Terrain& terrain, const LevelOrder& order);

  /// Starts a frame: clears it and remembers it until finish().
  void begin(LodFrame& frame);
  /// Adds a triangle to the mesh.
  void emit(const RightTriangle& triangle);
  /// Leaves a triangle out of the mesh and out of the promised domain.
  void drop(const RightTriangle& triangle) { dropped_.push_back(triangle); }
  /// Writes the domain: the terrain's rectangle without what was dropped; nothing if no triangle was emitted.
  void finish();

 private:
  std::uint32_t vertex(GridPoint p);
  /// Whether a sample is a corner of a drawn or of a dropped triangle.
  [[nodiscard]] bool is_corner(GridPoint p) const;
  /// Appends `from` and the corners inside the edge from there to `to`.
  void append_edge(GridPoint from, GridPoint to, std::vector<Vec2>& loop) const;
  [[nodiscard]] Vec2 plan(GridPoint p) const {
    return {p.i * terrain_->spacing_m, p.j * terrain_->spacing_m};
  }

  const Terrain* terrain_ = nullptr;
  LodFrame* frame_ = nullptr;
  std::uint32_t stamp_ = 0;  ///< number of the frame, from 1
  LevelOrder order_;
  std::vector<std::uint64_t> slots_;  ///< in level order: stamp of its last use << 32 | vertex index
  std::vector<RightTriangle> dropped_;
  std::vector<std::size_t> dropped_corners_;  ///< sorted, in level order
};

}  // namespace plumbline::bintree
