// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scenarios/mesh.h"
#include "scenarios/terrain.h"

/// Triangulated irregular networks: what the mesh methods (ring_tin, vertex_tree, greedy_tin) start from.
namespace plumbline::tin {

/// The sign below by CGAL's exact predicate.
int exact_plan_orientation(Vec3 a, Vec3 b, Vec3 c);

/// Sign of the plan orientation of a, b, c, exact: +1 counter-clockwise. Not the oracle's: a method and its
/// judge share no predicate.
inline int plan_orientation(Vec3 a, Vec3 b, Vec3 c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  // Certain when the difference exceeds what rounding (relative, 4 units in the last place) and underflow
  // (absolute) can have done to it.
  const double doubt = 0x1p-51 * (std::fabs(left) + std::fabs(right)) + 0x1p-1000;
  if (left - right > doubt) return 1;
  if (right - left > doubt) return -1;
  return exact_plan_orientation(a, b, c);
}

/// An edge of a TIN: ends ascending.
using Edge = std::array<std::uint32_t, 2>;

struct Tin {
  Mesh mesh;                ///< counter-clockwise in plan; covers the convex hull, or the grid
  std::vector<Edge> roads;  ///< edges that carry a road, sorted

  friend bool operator==(const Tin& a, const Tin& b) {
    return a.mesh.positions == b.mesh.positions && a.mesh.triangles == b.mesh.triangles && a.roads == b.roads;
  }
};

/// Every sample of a terrain, on its reference triangulation: cells split from (i, j) to (i+1, j+1). It is
/// the Delaunay triangulation of the samples with ties as below.
Tin grid_tin(const Terrain& terrain);

/// Delaunay triangulation of points in plan (CGAL), constrained to the road polylines, whose corners become
/// points too (heights interpolated by the caller). Four cocircular points are split by the diagonal at the
/// least of them (by x, then y): on a square cell the one from (i, j) to (i+1, j+1). So the result depends on
/// the points alone, not on their order of insertion. Points with equal plan position count once, the first.
/// Throws InputError if fewer than three points, all on one line, or a coordinate is not finite; or if
/// roads cross where they have no common corner.
Tin delaunay_tin(std::span<const Vec3> points, std::span<const std::vector<Vec3>> roads);

/// Who is next to whom in a TIN that does not change: compressed rows.
class Adjacency {
 public:
  explicit Adjacency(const Tin& tin);

  [[nodiscard]] std::size_t vertex_count() const { return first_triangle_.size() - 1; }
  /// Triangles at a vertex, ascending.
  [[nodiscard]] std::span<const std::uint32_t> triangles_at(std::uint32_t v) const {
    return {triangles_.data() + first_triangle_[v], triangles_.data() + first_triangle_[v + 1]};
  }
  /// Edges at a vertex, ascending.
  [[nodiscard]] std::span<const std::uint32_t> edges_at(std::uint32_t v) const {
    return {edges_at_.data() + first_edge_[v], edges_at_.data() + first_edge_[v + 1]};
  }
  /// All edges, sorted by their ends.
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  [[nodiscard]] bool is_road(std::uint32_t edge) const { return road_[edge] != 0; }
  /// Whether the edge belongs to one triangle only.
  [[nodiscard]] bool is_border(std::uint32_t edge) const { return border_[edge] != 0; }
  [[nodiscard]] bool is_border_vertex(std::uint32_t v) const { return border_vertex_[v] != 0; }
  /// Whether an edge of the TIN's border joins u and v.
  [[nodiscard]] bool joined_on_border(std::uint32_t u, std::uint32_t v) const;

 private:
  std::vector<std::uint32_t> first_triangle_, triangles_, first_edge_, edges_at_;
  std::vector<Edge> edges_;
  std::vector<std::uint8_t> road_, border_, border_vertex_;
};

}  // namespace plumbline::tin
