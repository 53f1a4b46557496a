// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline::oracle {

inline Vec2 plan(const Vec3& p) { return {p.x, p.y}; }

/// Twice the signed area of (a, b, p), exactly antisymmetric in a and b.
inline double edge_value(Vec2 a, Vec2 b, Vec2 p) {
  return (a.x - p.x) * (b.y - p.y) - (a.y - p.y) * (b.x - p.x);
}

struct WeightedCorner {
  double weight;
  const Vec3* corner;
};

/// Height over a point inside a triangle, from its barycentric weights. Begins with the lowest corner and
/// goes on to the other two by height (by weight where heights are equal), so that the bits depend neither on
/// how the triangle is listed nor on which way the plan's axes run.
inline double height_inside(WeightedCorner first, WeightedCorner second, WeightedCorner third) {
  const auto before = [](const WeightedCorner& p, const WeightedCorner& q) {
    return p.corner->z != q.corner->z ? p.corner->z < q.corner->z : std::fabs(p.weight) < std::fabs(q.weight);
  };
  if (before(second, first)) std::swap(first, second);
  if (before(third, second)) std::swap(second, third);
  if (before(second, first)) std::swap(first, second);
  const double area = (first.weight + second.weight) + third.weight;
  const double rise = second.weight * (second.corner->z - first.corner->z) +
                      third.weight * (third.corner->z - first.corner->z);
  return first.corner->z + rise / area;
}

/// Height over a point on an edge or corner of the triangle; ea, eb: its edge values opposite to a and b.
std::optional<double> height_on_rim(const Vec3& a, const Vec3& b, const Vec3& c, Vec2 p, double ea,
                                    double eb);

/// Height of triangle (a, b, c) over plan point p, metres; nothing where the closed triangle does not lie
/// over p or has no plan area. Decided in double by edge functions that are equal and opposite on the two
/// sides of an edge; on an edge and on a corner the height is a function of that edge or corner alone. So in
/// a mesh without cracks all triangles over p give the same bits.
inline std::optional<double> height_over(const Vec3& a, const Vec3& b, const Vec3& c, Vec2 p) {
  const double ea = edge_value(plan(b), plan(c), p);
  const double eb = edge_value(plan(c), plan(a), p);
  const double ec = edge_value(plan(a), plan(b), p);
  if (!((ea >= 0 && eb >= 0 && ec >= 0) || (ea <= 0 && eb <= 0 && ec <= 0))) return std::nullopt;
  const double area = (ea + eb) + ec;
  if (area == 0 || !std::isfinite(area)) return std::nullopt;
  if (ea != 0 && eb != 0 && ec != 0) return height_inside({ea, &a}, {eb, &b}, {ec, &c});
  return height_on_rim(a, b, c, p, ea, eb);
}

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

  /// Of each triangle: bit k is set if the edge from corner k to the next has no twin, that is, if not
  /// exactly one edge of the mesh runs so and exactly one the other way between the same two vertices;
  /// kNotPositive if the triangle is not counter-clockwise.
  using Sides = std::vector<std::uint8_t>;
  static constexpr std::uint8_t kNotPositive = 8;
  static Sides find_sides(const Mesh& mesh, std::span<const std::uint32_t> members);
  /// Whether every point of the rectangle lies in exactly one triangle (on an edge: in the two that share
  /// it). `run` are all triangles that may reach into it. May say no without need, never yes wrongly (up to
  /// slivers that double cannot tell from nothing).
  ///
  /// Proof: if all triangles are positively oriented, the number of triangles over a point changes only where
  /// an edge is crossed, by −1 and +1; if each edge that meets the rectangle has its twin, it does not change
  /// at all; so it is what it is at the centre.
  static bool covered_once(const Mesh& mesh, const Sides& sides, std::span<const std::uint32_t> run, Vec2 low,
                           Vec2 high);

  void add_grid(const Mesh& mesh, const Sides& sides, std::span<const std::uint32_t> members, Vec2 low,
                Vec2 high, int depth, std::uint32_t side);
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
