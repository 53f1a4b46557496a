// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline::oracle {

/// Height of triangle (a, b, c) over plan point p, metres; nothing where the closed triangle does not lie
/// over p or has no plan area. Decided in double by edge functions that are equal and opposite on the two
/// sides of an edge; on an edge and on a corner the height is a function of that edge or corner alone. So in
/// a mesh without cracks all triangles over p give the same bits.
std::optional<double> height_over(Vec3 a, Vec3 b, Vec3 c, Vec2 p);

/// A mesh's triangles by their place in plan: a grid whose crowded cells are grids in turn, so that a mesh
/// that is fine near the camera and coarse elsewhere needs few tests a look-up. Makes no assumption on the
/// mesh: triangles may overlap, be turned over, or leave gaps.
///
/// A point's cell and a triangle's cells come from the same monotone function, so no rounding can lose a
/// triangle.
class PlanIndex {
 public:
  /// `usable[t]` = 0 leaves triangle t out; empty: all are used. Copies no geometry: pass the same mesh to
  /// look-ups.
  PlanIndex(const Mesh& mesh, std::span<const std::uint8_t> usable);

  /// Where the last look-up ended; one for each run of look-ups, so that neighbouring points are quick.
  struct Cursor {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    std::uint32_t triangle = kNone;
  };
  /// Greatest height of the mesh over p, metres; nothing where no triangle lies over p. A terrain is read
  /// from above: where a mesh folds or overlaps, its top counts. The answer does not depend on the cursor.
  [[nodiscard]] std::optional<double> top(const Mesh& mesh, Vec2 p, Cursor& cursor) const;
  /// The mesh's height over p that is nearest to `height_m`; the upper one of two as near.
  [[nodiscard]] std::optional<double> nearest(const Mesh& mesh, Vec2 p, double height_m) const;

 private:
  struct Grid {
    Vec2 low;
    double cells_per_m_x = 0, cells_per_m_y = 0;
    std::uint32_t columns = 0, rows = 0;
    std::size_t first_cell = 0;
    /// Cell number along an axis, clamped to the grid. Monotone in `v`.
    [[nodiscard]] std::uint32_t column(double v) const { return cell(v, low.x, cells_per_m_x, columns); }
    [[nodiscard]] std::uint32_t row(double v) const { return cell(v, low.y, cells_per_m_y, rows); }
    static std::uint32_t cell(double v, double low, double per_m, std::uint32_t count) {
      const double c = (v - low) * per_m;
      if (!(c > 0)) return 0;
      return c < count ? static_cast<std::uint32_t>(c) : count - 1;
    }
  };
  /// A run of `triangles_`, or a finer grid.
  struct Cell {
    std::uint32_t first = 0;  ///< into triangles_, or the number of the finer grid
    std::uint32_t count = 0;  ///< kFiner: a finer grid
  };
  static constexpr std::uint32_t kFiner = 0xffffffffu;

  void add_grid(const Mesh& mesh, std::span<const std::uint32_t> members, Vec2 low, Vec2 high, int depth,
                std::uint32_t side);
  /// `side`, or a power of two less: the finest at which the members' boxes take at most `entries` cells
  /// each.
  static std::uint32_t fitting_side(const Mesh& mesh, std::span<const std::uint32_t> members, Vec2 low,
                                    Vec2 high, std::uint32_t side, double entries);
  [[nodiscard]] std::span<const std::uint32_t> candidates(Vec2 p) const;

  Vec2 low_, high_;
  std::size_t used_ = 0;
  std::vector<Grid> grids_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> triangles_;
  /// 1: every cell that the triangle reaches into is proved to be covered once, so what it covers nothing
  /// else does.
  std::vector<std::uint8_t> alone_;
};

}  // namespace plumbline::oracle
