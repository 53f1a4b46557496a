// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/ring_tin/rings.h"
#include "scenarios/vec.h"

namespace plumbline::ring_tin {

/// Vertices by place: square cells of plan with some 64 of them each. Immutable.
struct PlanCells {
  struct Cell {
    std::uint32_t first = 0, end = 0;  ///< into `vertices`
    Vec2 low, high;                    ///< box of its vertices
  };
  std::vector<Cell> cells;  ///< none is empty
  std::vector<std::uint32_t> vertices;

  explicit PlanCells(const std::vector<Vec3>& positions);
};

/// Which ring each vertex is in, from frame to frame. A frame looks at the cells' boxes, and into those cells
/// that a ring's border cuts or has crossed: the cost follows the length of the borders.
class VertexLevels {
 public:
  VertexLevels(const PlanCells& cells, const std::vector<Vec3>& positions);

  /// Sets the levels for a viewpoint, metres in plan; the vertices whose level changed, ascending. Returns
  /// how many vertices were looked at.
  std::uint64_t move(Vec2 viewpoint, const Rings& rings, std::vector<std::uint32_t>& changed);
  [[nodiscard]] int level(std::uint32_t v) const { return level_[v]; }

 private:
  const PlanCells& cells_;
  const std::vector<Vec3>& positions_;
  std::vector<std::uint8_t> level_;    ///< by vertex; all 0 before the first frame
  std::vector<std::int16_t> uniform_;  ///< by cell: the level of all its vertices, or kMixed
  static constexpr std::int16_t kMixed = -1;
};

}  // namespace plumbline::ring_tin
