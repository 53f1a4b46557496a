// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/ring_tin/collapse_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "algorithms/mutant.h"

namespace plumbline::ring_tin {
namespace {

constexpr double kInvalid = std::numeric_limits<double>::infinity();

/// Height of the plane through a, b, c over p's plan position. Requires: not collinear in plan.
double plane_height_m(Vec3 a, Vec3 b, Vec3 c, Vec3 p) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const double area = u.x * v.y - u.y * v.x;
  const double s = ((p.x - a.x) * v.y - (p.y - a.y) * v.x) / area;
  const double t = (u.x * (p.y - a.y) - u.y * (p.x - a.x)) / area;
  return a.z + s * u.z + t * v.z;
}

/// Whether p lies in the closed triangle in plan, whichever way it turns; exact.
bool contains(Vec3 a, Vec3 b, Vec3 c, Vec3 p) {
  const int turn = tin::plan_orientation(a, b, c);
  if (turn == 0) return false;
  return tin::plan_orientation(a, b, p) * turn >= 0 && tin::plan_orientation(b, c, p) * turn >= 0 &&
         tin::plan_orientation(c, a, p) * turn >= 0;
}

}  // namespace

CollapseMap::CollapseMap(const tin::Tin& tin, const tin::Adjacency& adjacency, const Prices& prices,
                         int depth_cap)
    : tin_(tin), adjacency_(adjacency), depth_cap_(depth_cap) {
  const std::size_t vertices = tin.mesh.positions.size();
  rep_.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) rep_[v] = static_cast<std::uint32_t>(v);
  next_member_ = rep_;
  depth_.assign(vertices, 1);
  const std::size_t edges = adjacency.edges().size();
  active_.assign(edges, 1);
  error_m_ = prices.error_m;
  turned_ = prices.start;
  removed_by_.assign(vertices, kNone);
  priced_at_.assign(edges, 0);
  changed_at_.assign(vertices, 0);

  std::vector<std::uint8_t> roads_at(vertices, 0);
  for (const tin::Edge& e : tin.roads) {
    for (const std::uint32_t v : e) roads_at[v] = static_cast<std::uint8_t>(std::min(roads_at[v] + 1, 3));
  }
  on_road_.resize(vertices);
  road_fixed_.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    on_road_[v] = roads_at[v] > 0 ? 1 : 0;
    road_fixed_[v] = roads_at[v] == 1 || roads_at[v] == 3 ? 1 : 0;
  }
}

std::uint32_t CollapseMap::start(std::uint32_t edge) const {
  return rep_[adjacency_.edges()[edge][turned_[edge]]];
}
std::uint32_t CollapseMap::end(std::uint32_t edge) const {
  return rep_[adjacency_.edges()[edge][1u - turned_[edge]]];
}

template <class Visit>
void CollapseMap::for_each_member(std::uint32_t v, Visit visit) const {
  std::uint32_t member = v;
  do {
    visit(member);
    member = next_member_[member];
  } while (member != v);
}

void CollapseMap::members(std::uint32_t v, std::vector<std::uint32_t>& out) const {
  for_each_member(v, [&](std::uint32_t member) { out.push_back(member); });
}

void CollapseMap::star(std::uint32_t live, std::vector<Corner>& out) const {
  out.clear();
  // A live triangle has exactly one corner in this tree, so it is met once.
  for_each_member(live, [&](std::uint32_t member) {
    for (const std::uint32_t t : adjacency_.triangles_at(member)) {
      const auto& full = tin_.mesh.triangles[t];
      const std::size_t k = full[0] == member ? 0 : full[1] == member ? 1 : 2;
      const std::uint32_t next = rep_[full[(k + 1) % 3]];
      const std::uint32_t after = rep_[full[(k + 2) % 3]];
      if (next != live && after != live && next != after) out.push_back({next, after, t});
    }
  });
}

double CollapseMap::directed_error_m(std::uint32_t from, std::uint32_t to) {
  ++evaluated_;
  const std::vector<Vec3>& at = tin_.mesh.positions;
  const Vec3 gone = at[from];
  star(from, star_);
  std::uint32_t chosen = kNone;
  double error = kInvalid;
  for (const Corner& corner : star_) {
    if (corner.next == to || corner.after == to) continue;  // dropped by the collapse
    const Vec3& p = at[corner.next];
    const Vec3& q = at[corner.after];
    // Where several triangles hold the place (it lies on their edge, or they are folded), the least full
    // triangle decides: no order of lists may show.
    if (corner.triangle >= chosen || !contains(at[to], p, q, gone)) continue;
    chosen = corner.triangle;
    error = std::abs(plane_height_m(at[to], p, q, gone) - gone.z);
    if (PLUMBLINE_MUTANT(m2_error_halved)) error /= 2;
  }
  return error;
}

double CollapseMap::price(std::uint32_t edge) {
  const auto& ends = adjacency_.edges()[edge];
  const std::uint32_t u = rep_[ends[0]];
  const std::uint32_t v = rep_[ends[1]];
  if (PLUMBLINE_MUTANT(m2_stale_price) && clock_ > 1) return error_m_[edge];
  if (priced_at_[edge] < std::max(changed_at_[u], changed_at_[v])) {
    const double forth = directed_error_m(u, v);
    const double back = directed_error_m(v, u);
    turned_[edge] = (back < forth) != PLUMBLINE_MUTANT(m2_wrong_end_collapses) ? 1 : 0;
    error_m_[edge] = std::min(forth, back);
    priced_at_[edge] = clock_;
  }
  return error_m_[edge];
}

/// Sets which edges at a live vertex are active.
void CollapseMap::refresh(std::uint32_t live) {
  images_.clear();
  for_each_member(live, [&](std::uint32_t member) {
    for (const std::uint32_t e : adjacency_.edges_at(member)) {
      const auto& ends = adjacency_.edges()[e];
      const std::uint32_t other = rep_[ends[0] == member ? ends[1] : ends[0]];
      if (other == live) {
        active_[e] = 0;
      } else {
        images_.push_back({other, e});
      }
    }
  });
  std::sort(images_.begin(), images_.end());
  for (std::size_t k = 0; k < images_.size(); ++k) {
    active_[images_[k].edge] = k == 0 || images_[k].other != images_[k - 1].other ? 1 : 0;
  }
}

void CollapseMap::mark_changed(std::uint32_t live) {
  changed_at_[live] = clock_;
  changed_.push_back(live);
}

std::vector<std::uint32_t> CollapseMap::take_changed() { return std::exchange(changed_, {}); }

void CollapseMap::edges_at(std::uint32_t live, std::vector<std::uint32_t>& out) const {
  for_each_member(live, [&](std::uint32_t member) {
    for (const std::uint32_t e : adjacency_.edges_at(member)) {
      if (active_[e] != 0) out.push_back(e);
    }
  });
}

bool CollapseMap::on_road(std::uint32_t from, std::uint32_t to) const {
  bool found = false;
  for_each_member(from, [&](std::uint32_t member) {
    for (const std::uint32_t e : adjacency_.edges_at(member)) {
      const auto& ends = adjacency_.edges()[e];
      found = found || (adjacency_.is_road(e) && rep_[ends[0] == member ? ends[1] : ends[0]] == to);
    }
  });
  return found;
}

CollapseMap::Refusal CollapseMap::refusal(std::uint32_t edge, bool guard) {
  const std::uint32_t from = start(edge);
  const std::uint32_t to = end(edge);
  star(from, star_);
  for (const Corner& corner : star_) {
    if (PLUMBLINE_MUTANT(m2_border_collapses)) break;
    if (adjacency_.is_border_vertex(from) || adjacency_.joined_on_border(corner.next, corner.after)) {
      return Refusal::border;
    }
  }
  if (std::max(depth_[from], depth_[to]) + (PLUMBLINE_MUTANT(m2_depth_cap_off_by_one) ? 0 : 1) > depth_cap_) {
    return Refusal::depth;
  }
  if (on_road_[from] != 0 && (road_fixed_[from] != 0 || !on_road(from, to))) return Refusal::road;
  if (guard) {
    const std::vector<Vec3>& at = tin_.mesh.positions;
    for (const Corner& corner : star_) {
      if (corner.next == to || corner.after == to) continue;
      if (tin::plan_orientation(at[to], at[corner.next], at[corner.after]) <=
          (PLUMBLINE_MUTANT(m2_guard_lets_flat_through) ? -1 : 0)) {
        return Refusal::fold;
      }
    }
  }
  return Refusal::none;
}

void CollapseMap::collapse(std::uint32_t edge) {
  const std::uint32_t from = start(edge);
  const std::uint32_t to = end(edge);
  ++clock_;
  star(from, star_);
  for (const Corner& corner : star_) {
    mark_changed(corner.next);
    mark_changed(corner.after);
  }
  mark_changed(to);
  depth_[to] = static_cast<std::uint8_t>(1 + std::max(depth_[from], depth_[to]));
  for_each_member(from, [&](std::uint32_t member) {
    if (!PLUMBLINE_MUTANT(m2_members_left_behind) || member == from) rep_[member] = to;
  });
  std::swap(next_member_[from], next_member_[to]);  // joins two ring lists
  removed_by_[from] = edge;
  refresh(to);
}

void CollapseMap::reset_tree(std::uint32_t v, std::vector<std::uint32_t>& restored) {
  const std::size_t first = restored.size();
  ++clock_;
  ++trees_reset_;  // a lone vertex is never asked for
  members(v, restored);
  for (std::size_t k = first; k < restored.size(); ++k) {
    const std::uint32_t member = restored[k];
    rep_[member] = member;
    next_member_[member] = member;
    if (!PLUMBLINE_MUTANT(m2_depth_stale)) depth_[member] = 1;
    removed_by_[member] = kNone;
  }
  for (std::size_t k = first; k < restored.size(); ++k) {
    refresh(restored[k]);
    mark_changed(restored[k]);
    star(restored[k], star_);
    for (const Corner& corner : star_) {
      mark_changed(corner.next);
      mark_changed(corner.after);
    }
  }
}

void CollapseMap::mend_folds(std::vector<std::uint32_t>& restored) {
  const std::vector<Vec3>& at = tin_.mesh.positions;
  std::vector<Corner> around;
  for (std::size_t k = 0; k < restored.size(); ++k) {  // grows while it runs
    const std::uint32_t v = restored[k];
    bool folded = true;
    while (folded) {
      star(v, around);
      const auto bad = std::find_if(around.begin(), around.end(), [&](const Corner& corner) {
        return tin::plan_orientation(at[v], at[corner.next], at[corner.after]) <= 0;
      });
      folded = bad != around.end();
      if (!folded) break;
      for (const std::uint32_t other : {bad->next, bad->after}) {
        if (depth_[rep_[other]] > 1) reset_tree(other, restored);
      }
    }
  }
}

Prices price_all(const tin::Tin& tin, const tin::Adjacency& adjacency) {
  const std::size_t edges = adjacency.edges().size();
  const Prices blank{std::vector<double>(edges, kInvalid), std::vector<std::uint8_t>(edges, 0)};
  CollapseMap map(tin, adjacency, blank, 1);
  map.clock_ = 1;
  std::fill(map.changed_at_.begin(), map.changed_at_.end(), 1);
  for (std::size_t e = 0; e < edges; ++e) map.price(static_cast<std::uint32_t>(e));
  return {std::move(map.error_m_), std::move(map.turned_)};
}

}  // namespace plumbline::ring_tin
