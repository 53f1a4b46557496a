// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/border.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/conformity_parts.h"
#include "oracle/plan_weld.h"

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

/// Walls by the two plan points that they stand on.
class Walls {
 public:
  Walls(const Mesh& mesh, std::span<const std::uint32_t> walls) : points_(walls.size() * 2 + 16) {
    for (const std::uint32_t t : walls) {
      std::array<const Vec3*, 3> corner{};
      for (std::size_t k = 0; k < 3; ++k) corner[k] = &mesh.positions[mesh.triangles[t][k]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = points_.number(*corner[k]), b = points_.number(*corner[(k + 1) % 3]);
        edges_.push_back({std::min(a, b), std::max(a, b)});
      }
      // Two plan points: one under two of the corners, one under the third.
      std::array<std::uint32_t, 3> at{};
      for (std::size_t k = 0; k < 3; ++k) at[k] = plan_.number({corner[k]->x, corner[k]->y, 0});
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t to = at[k] != at[(k + 1) % 3] ? at[(k + 1) % 3] : at[(k + 2) % 3];
        reaches_.push_back({at[k], to, corner[k]->z});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    std::sort(reaches_.begin(), reaches_.end(), before);
  }

  /// Whether a wall has the edge; then `foot` holds the lowest heights below its two ends, of the walls that
  /// stand along it.
  bool hang_from(const Vec3& a, const Vec3& b, std::array<double, 2>& foot) {
    if (edges_.empty()) return false;
    const std::uint32_t i = points_.number(a), j = points_.number(b);
    if (!std::binary_search(edges_.begin(), edges_.end(), detail::VertexPair{std::min(i, j), std::max(i, j)}))
      return false;
    return lowest(a, b, foot[0]) && lowest(b, a, foot[1]) && foot[0] < a.z && foot[1] < b.z;
  }

 private:
  /// A wall that stands over plan points `at` and `to`, and has a corner at height z over the first.
  struct Reach {
    std::uint32_t at = 0, to = 0;
    double z = 0;
  };
  static bool before(const Reach& a, const Reach& b) {
    if (a.at != b.at) return a.at < b.at;
    return a.to != b.to ? a.to < b.to : a.z < b.z;
  }

  /// The lowest height below `end` of walls that run from there to `other`. Another border edge's walls,
  /// which meet these at the corner, may reach deeper.
  bool lowest(const Vec3& end, const Vec3& other, double& z) {
    const Reach wanted{plan_.number({end.x, end.y, 0}), plan_.number({other.x, other.y, 0}),
                       -std::numeric_limits<double>::infinity()};
    const auto reach = std::lower_bound(reaches_.begin(), reaches_.end(), wanted, before);
    if (reach == reaches_.end() || reach->at != wanted.at || reach->to != wanted.to) return false;
    z = reach->z;
    return true;
  }

  detail::PointTable points_;
  detail::PointTable plan_{16};
  std::vector<Reach> reaches_;  // sorted
  std::vector<detail::VertexPair> edges_;
};

/// Formats that carry normals or colours double their vertices along creases: by index these are border, too.
/// Cancels opposite edges between equal places.
void cancel_by_place(const Mesh& mesh, std::vector<LooseEdge>& left_over) {
  detail::PointTable table(left_over.size());
  struct Placed {
    std::uint64_t key = 0;  // smaller place, larger place
    std::uint32_t use = 0;
    bool upwards = false;
  };
  std::vector<Placed> order;
  order.reserve(left_over.size());
  for (std::uint32_t k = 0; k < left_over.size(); ++k) {
    const std::uint32_t u = table.number(mesh.positions[left_over[k].from]),
                        v = table.number(mesh.positions[left_over[k].to]);
    order.push_back({std::uint64_t{std::min(u, v)} << 32 | std::max(u, v), k, u < v});
  }
  std::sort(order.begin(), order.end(), [](const Placed& a, const Placed& b) {
    return a.key < b.key || (a.key == b.key && a.use < b.use);
  });
  std::vector<bool> kept(left_over.size(), false);
  for (std::size_t i = 0; i < order.size();) {
    std::array<std::size_t, 2> uses{};
    std::size_t end = i;
    for (; end < order.size() && order[end].key == order[i].key; ++end) ++uses[order[end].upwards ? 1 : 0];
    for (; i < end; ++i) {
      const std::size_t way = order[i].upwards ? 1 : 0;
      if (uses[way] <= uses[1 - way]) continue;
      kept[order[i].use] = true;
      --uses[way];
    }
  }
  std::size_t next = 0;
  std::erase_if(left_over, [&](const LooseEdge&) { return !kept[next++]; });
}

/// Edges without a twin, by index. Triangles that the input layer faults have no border worth comparing.
std::vector<LooseEdge> loose_edges(const Mesh& surface) {
  std::vector<std::uint8_t> treatment;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (sound(surface, surface.triangles[t])) continue;
    treatment.resize(surface.triangles.size(), detail::kNormal);
    treatment[t] = detail::kLeftOut;
  }
  std::vector<LooseEdge> out;
  for (const detail::EdgeUse& use : detail::match_by_index(surface, treatment).left_over)
    out.push_back({use.from, use.to, use.triangle});
  return out;
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

Border border_of(const Mesh& mesh, const Sheet& sheet, std::span<const Vec3> normals,
                 const ConformityReport* judged) {
  Border border;
  std::vector<LooseEdge> loose;
  if (judged != nullptr && judged->loose_edges) {
    loose = *judged->loose_edges;
  } else {
    loose = loose_edges(sheet.surface);
  }
  cancel_by_place(mesh, loose);
  Walls walls(mesh, sheet.walls);
  constexpr double inf = std::numeric_limits<double>::infinity();
  border.low = {inf, inf};
  border.high = {-inf, -inf};
  for (const LooseEdge& use : loose) {
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
