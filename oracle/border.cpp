// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/border.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/conformity_parts.h"
#include "oracle/plan_weld.h"
#include "oracle/predicates.h"

namespace plumbline::oracle {
namespace {

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool sound(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return std::all_of(t.begin(), t.end(),
                     [&](std::uint32_t v) { return v < mesh.positions.size() && finite(mesh.positions[v]); });
}

Vec2 plan_of(const Vec3& p) { return {p.x, p.y}; }

/// Two corners over one plan point, the third elsewhere: a vertical side.
bool is_wall(const Vec3& a, const Vec3& b, const Vec3& c) {
  const bool ab = plan_of(a) == plan_of(b), bc = plan_of(b) == plan_of(c), ca = plan_of(c) == plan_of(a);
  if (ab && bc) return false;  // over one plan point: no area
  return (ab && a.z != b.z) || (bc && b.z != c.z) || (ca && c.z != a.z);
}

/// Walls by the plan points that they stand on.
class Walls {
 public:
  Walls(const Mesh& mesh, std::span<const std::uint32_t> walls) : points_(walls.size() * 2 + 16) {
    for (const std::uint32_t t : walls) {
      std::array<std::uint32_t, 3> corner{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = mesh.positions[mesh.triangles[t][k]];
        corner[k] = plan_.number({p.x, p.y, 0});
        if (corner[k] == lowest_.size()) lowest_.push_back(std::numeric_limits<double>::infinity());
        lowest_[corner[k]] = std::min(lowest_[corner[k]], p.z);
        points_.number(p);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = points_.number(mesh.positions[mesh.triangles[t][k]]);
        const std::uint32_t b = points_.number(mesh.positions[mesh.triangles[t][(k + 1) % 3]]);
        edges_.push_back({std::min(a, b), std::max(a, b)});
      }
    }
    std::sort(edges_.begin(), edges_.end());
  }

  /// Whether a wall has the edge; then `foot` holds the lowest heights below its two ends.
  bool hang_from(const Vec3& a, const Vec3& b, std::array<double, 2>& foot) {
    if (edges_.empty()) return false;
    const std::uint32_t i = points_.number(a), j = points_.number(b);
    if (!std::binary_search(edges_.begin(), edges_.end(), detail::VertexPair{std::min(i, j), std::max(i, j)}))
      return false;
    std::size_t k = 0;
    for (const Vec3* p : {&a, &b}) {
      const std::uint32_t point = plan_.number({p->x, p->y, 0});
      if (point >= lowest_.size()) return false;
      foot[k++] = lowest_[point];
    }
    return foot[0] < a.z && foot[1] < b.z;
  }

 private:
  detail::PointTable points_;
  detail::PointTable plan_{16};
  std::vector<double> lowest_;  // per plan point
  std::vector<detail::VertexPair> edges_;
};

/// A mesh of more border edges than this share of its edges is looked at again by position.
constexpr std::size_t kMostBorderShare = 16;

/// A vertex number that was turned back already.
constexpr std::uint32_t kNamed = 1u << 31u;

/// As match_by_index, with vertices at one place taken for one. Uses name the given vertices.
detail::IndexMatch match_by_place(const Mesh& mesh, std::span<const std::uint8_t> treatment) {
  const std::vector<std::uint32_t> number = detail::weld_all(mesh, true);
  Mesh welded;
  std::vector<std::uint32_t> first;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == detail::kNone || number[v] < first.size()) continue;
    first.push_back(v);
  }
  welded.positions.resize(first.size());
  for (std::size_t k = 0; k < first.size(); ++k) welded.positions[k] = mesh.positions[first[k]];
  std::vector<std::uint8_t> treated(treatment.begin(), treatment.end());
  treated.resize(mesh.triangles.size(), detail::kNormal);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto corners = mesh.triangles[t];
    if ((treated[t] & detail::kLeftOut) != 0) {
      corners = {0, 0, 0};
    } else {
      for (std::uint32_t& v : corners) v = number[v];
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        treated[t] = detail::kLeftOut;
    }
    welded.triangles.push_back(corners);
  }
  detail::IndexMatch match = detail::match_by_index(welded, treated);
  // Back to the vertices that the triangle itself names.
  for (detail::EdgeUse& use : match.left_over) {
    for (const std::uint32_t v : mesh.triangles[use.triangle]) {
      if (number[v] == use.from) use.from = v | kNamed;
      if (number[v] == use.to) use.to = v | kNamed;
    }
    use.from &= ~kNamed;
    use.to &= ~kNamed;
  }
  return match;
}

ExactHeight plain(double z) { return {z, z, 0, 0}; }

}  // namespace

Sheet take_walls_off(const Mesh& mesh) {
  Sheet sheet;
  sheet.surface.positions = mesh.positions;
  sheet.surface.triangles.reserve(mesh.triangles.size());
  sheet.triangle_of.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    if (sound(mesh, c) && is_wall(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]])) {
      sheet.walls.push_back(t);
    } else {
      sheet.surface.triangles.push_back(c);
      sheet.triangle_of.push_back(t);
    }
  }
  return sheet;
}

Border border_of(const Mesh& mesh, const Sheet& sheet, std::span<const Vec3> normals) {
  Border border;
  // Triangles that the input layer faults have no border worth comparing.
  std::vector<std::uint8_t> treatment;
  for (std::size_t t = 0; t < sheet.surface.triangles.size(); ++t) {
    if (sound(mesh, sheet.surface.triangles[t])) continue;
    treatment.resize(sheet.surface.triangles.size(), detail::kNormal);
    treatment[t] = detail::kLeftOut;
  }
  detail::IndexMatch match = detail::match_by_index(sheet.surface, treatment);
  // Formats that carry normals or colours double their vertices along creases: by index all of it is border.
  const std::size_t edges = 3 * sheet.surface.triangles.size();
  if (match.left_over.size() * kMostBorderShare > edges) match = match_by_place(sheet.surface, treatment);
  Walls walls(mesh, sheet.walls);
  constexpr double inf = std::numeric_limits<double>::infinity();
  border.low = {inf, inf};
  border.high = {-inf, -inf};
  for (const detail::EdgeUse& use : match.left_over) {
    BorderEdge edge;
    edge.vertices = {use.from, use.to};
    edge.triangle = sheet.triangle_of[use.triangle];
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3& p = mesh.positions[edge.vertices[k]];
      edge.plan[k] = plan_of(p);
      edge.height[k] = plain(p.z);
      if (!normals.empty()) edge.normal[k] = normals[edge.vertices[k]];
      border.low = {std::min(border.low.x, p.x), std::min(border.low.y, p.y)};
      border.high = {std::max(border.high.x, p.x), std::max(border.high.y, p.y)};
    }
    if (edge.plan[0] == edge.plan[1]) continue;  // no length in plan: nothing to meet
    std::array<double, 2> foot{};
    edge.has_skirt = walls.hang_from(mesh.positions[use.from], mesh.positions[use.to], foot);
    if (edge.has_skirt) edge.foot = {plain(foot[0]), plain(foot[1])};
    border.edges.push_back(edge);
  }
  return border;
}

}  // namespace plumbline::oracle
