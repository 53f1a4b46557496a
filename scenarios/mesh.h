// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenarios/vec.h"

namespace plumbline {

/// An indexed triangle mesh in the terrain's local frame, metres. A terrain mesh is sound when its triangles
/// run counter-clockwise seen from above (positive orientation in plan).
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `positions`

  /// Empty, with the memory kept.
  void clear() {
    positions.clear();
    triangles.clear();
  }
};

/// The plan region that a method promises to cover, as closed loops of corners. Interiors lie to the left of
/// a loop's edges; the region is where the loops' winding numbers sum to 1. Loops may share edges (opposite
/// ones cancel), so a set of adjacent counter-clockwise polygons, or an outline with clockwise holes, are
/// both well formed.
struct PlanDomain {
  std::vector<std::vector<Vec2>> loops;

  void clear() { loops.clear(); }
  void add_rectangle(Vec2 low, Vec2 high) { loops.push_back({low, {high.x, low.y}, high, {low.x, high.y}}); }
};

}  // namespace plumbline
