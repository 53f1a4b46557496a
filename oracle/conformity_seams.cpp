// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Station 4 of check_conformity: the edges that found no twin by index.
//
// First by position: opposite edges between the same two plan points cancel; where their heights differ they
// are a crack. Then by geometry: every edge is cut at the points in its open interior (a mesh vertex there is
// a T-vertex), and opposite pieces cancel, whatever edges they came from; so do pieces that run along the
// promised outline. What is left bounds the regions that are covered wrongly.
#include <algorithm>
#include <cmath>
#include <string>

#include "oracle/conformity_parts.h"
#include "oracle/plan_weld.h"
#include "oracle/point_tree.h"
#include "oracle/predicates.h"
#include "scenarios/error.h"

namespace plumbline::oracle::detail {
namespace {

/// More pieces than this (each edge cut at each point in its interior) are no surface but a tangle: the check
/// stops with a clear line instead of filling the memory.
constexpr std::size_t kMostPieces = std::size_t{1} << 27;

/// A plan edge: of the mesh, of the domain, or of a triangle that was left out (that one only marks its
/// place).
struct Carrier {
  std::uint32_t u = 0, v = 0;              // points, in the direction in which it counts
  std::uint32_t from = kNone, to = kNone;  // mesh vertices at u and v
  std::uint32_t triangle = kNone;
  bool domain = false, silent = false;

  [[nodiscard]] bool of_mesh() const { return triangle != kNone; }
  [[nodiscard]] std::uint64_t key() const { return std::uint64_t{std::min(u, v)} << 32 | std::max(u, v); }
};

struct Piece {
  std::uint64_t key = 0;  // smaller point, larger point
  std::uint32_t carrier = 0;
  bool upwards = false;  // from the smaller point to the larger
  auto operator<=>(const Piece&) const = default;
};

class SeamCloser {
 public:
  SeamCloser(const Mesh& mesh, std::vector<Finding>& findings, bool duplicates_settled)
      : mesh_(mesh), findings_(findings), table_(64), duplicates_settled_(duplicates_settled) {}

  Seams close(const PlanDomain& domain, std::span<const EdgeUse> left_over,
              std::span<const VertexPair> excused_edges, std::span<const std::uint32_t> excused_vertices) {
    const std::size_t findings_before = findings_.size();
    gather(domain, left_over, excused_edges);
    for (const std::uint32_t v : excused_vertices) excused_points_.push_back(point_of(v));
    cancel_by_position();
    if (seams_.suspects_duplicates) {
      findings_.resize(findings_before);
      return std::move(seams_);
    }
    if (!carriers_.empty()) cancel_by_geometry();
    return std::move(seams_);
  }

 private:
  std::uint32_t point_of(std::uint32_t mesh_vertex) {
    const Vec3& p = mesh_.positions[mesh_vertex];
    return table_.number({p.x, p.y, 0});
  }
  Vec2 plan(std::uint32_t point) const { return {table_[point].x, table_[point].y}; }
  double z(std::uint32_t mesh_vertex) const { return mesh_.positions[mesh_vertex].z; }

  void gather(const PlanDomain& domain, std::span<const EdgeUse> left_over,
              std::span<const VertexPair> excused_edges) {
    for (const EdgeUse& use : left_over) {
      carriers_.push_back(
          {point_of(use.from), point_of(use.to), use.from, use.to, use.triangle, false, use.silent});
    }
    for (const auto& loop : domain.loops) {
      if (loop.size() < 3) continue;  // bounds nothing
      std::vector<std::uint32_t> corners;
      for (const Vec2 corner : loop) {
        if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) {
          throw InputError(
              "the promised domain has a corner that is not finite; give finite plan coordinates");
        }
        corners.push_back(table_.number({corner.x, corner.y, 0}));
      }
      for (std::size_t i = 0; i < corners.size(); ++i) {
        Carrier side;
        side.u = corners[i];
        side.v = corners[(i + 1) % corners.size()];
        side.domain = true;
        carriers_.push_back(side);
      }
    }
    for (const VertexPair& edge : excused_edges) {
      Carrier mark;
      mark.u = point_of(edge.from);
      mark.v = point_of(edge.to);
      carriers_.push_back(mark);
    }
    std::erase_if(carriers_, [](const Carrier& c) { return c.u == c.v; });
  }

  /// The corner of the carrier's triangle that is not on the carrier.
  Vec3 apex(const Carrier& c) const {
    for (const std::uint32_t v : mesh_.triangles[c.triangle]) {
      if (v != c.from && v != c.to) return mesh_.positions[v];
    }
    return {};
  }
  /// Heights at the carrier's smaller and larger point.
  std::array<double, 2> heights(const Carrier& c) const {
    std::array<double, 2> h{z(c.from), z(c.to)};
    if (c.u > c.v) std::swap(h[0], h[1]);
    return h;
  }
  bool lower(const Carrier& a, const Carrier& b) const {
    const auto ha = heights(a), hb = heights(b);
    if (ha != hb) return ha < hb;
    return a.triangle < b.triangle;
  }

  void cancel_by_position() {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(carriers_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {carriers_[i].key(), i};
    std::sort(order.begin(), order.end());
    std::vector<Carrier> rest;
    std::array<std::vector<Carrier>, 2> of_mesh, of_domain;  // by direction
    for (std::size_t i = 0; i < order.size();) {
      for (int d = 0; d < 2; ++d) {
        of_mesh[static_cast<std::size_t>(d)].clear();
        of_domain[static_cast<std::size_t>(d)].clear();
      }
      std::size_t end = i;
      for (; end < order.size() && order[end].first == order[i].first; ++end) {
        const Carrier& c = carriers_[order[end].second];
        const std::size_t direction = c.u > c.v;
        if (c.of_mesh()) {
          of_mesh[direction].push_back(c);
        } else if (c.domain) {
          of_domain[direction].push_back(c);
        } else {
          rest.push_back(c);
        }
      }
      i = end;
      cancel_mesh_edges(of_mesh[0], of_mesh[1], rest);
      const std::size_t both = std::min(of_domain[0].size(), of_domain[1].size());
      for (auto& sides : of_domain)
        rest.insert(rest.end(), sides.begin() + static_cast<std::ptrdiff_t>(both), sides.end());
    }
    carriers_ = std::move(rest);
  }

  /// Cancels edges that run from the smaller point to the larger (`up`) against those that run back (`down`):
  /// first at equal heights (a sound seam), then in order of height (cracks).
  void cancel_mesh_edges(std::vector<Carrier>& up, std::vector<Carrier>& down, std::vector<Carrier>& rest) {
    for (auto* edges : {&up, &down}) {
      if (edges->size() < 2) continue;
      std::sort(edges->begin(), edges->end(), [this](const auto& a, const auto& b) { return lower(a, b); });
      if (!duplicates_settled_) look_for_duplicates(*edges);
    }
    if (up.empty() || down.empty()) {
      for (const auto* edges : {&up, &down}) rest.insert(rest.end(), edges->begin(), edges->end());
      return;
    }
    std::array<std::vector<Carrier>, 2> uneven;
    std::size_t i = 0, j = 0;
    while (i < up.size() || j < down.size()) {
      if (j == down.size() || (i < up.size() && heights(up[i]) < heights(down[j]))) {
        uneven[0].push_back(up[i++]);
      } else if (i == up.size() || heights(down[j]) < heights(up[i])) {
        uneven[1].push_back(down[j++]);
      } else {
        ++i, ++j;
      }
    }
    const std::size_t both = std::min(uneven[0].size(), uneven[1].size());
    for (std::size_t k = 0; k < both; ++k) report_crack(uneven[0][k], uneven[1][k]);
    for (auto& edges : uneven)
      rest.insert(rest.end(), edges.begin() + static_cast<std::ptrdiff_t>(both), edges.end());
  }

  void look_for_duplicates(const std::vector<Carrier>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t j = i + 1; j < edges.size() && heights(edges[i]) == heights(edges[j]); ++j) {
        if (apex(edges[i]) == apex(edges[j])) {
          seams_.suspects_duplicates = true;
          return;
        }
        if (j - i > 64) break;  // a heap of triangles on one edge: its neighbours in the order are enough
      }
    }
  }

  /// Two edges (or parts of edges) that coincide in plan. Heights are compared at ends that both have; at
  /// other points one of them has a T-vertex, whose finding tells the gap.
  void report_crack(const Carrier& a, const Carrier& b) {
    if (a.silent || b.silent) return;  // a degenerate triangle has its finding
    double gap = 0;
    std::uint32_t at = kNone;
    for (const auto& [point, vertex] : {std::pair{a.u, a.from}, std::pair{a.v, a.to}}) {
      const std::uint32_t other = point == b.u ? b.from : point == b.v ? b.to : kNone;
      if (other == kNone || z(other) == z(vertex)) continue;
      const double difference = std::fabs(z(other) - z(vertex));
      const bool farther = at == kNone || difference > gap ||
                           (difference == gap && before_in_plan(plan(point), plan(at == a.from ? a.u : a.v)));
      if (farther) {
        gap = difference;
        at = vertex;
      }
    }
    if (at == kNone) return;
    Finding crack;
    crack.code = FindingCode::crack;
    crack.kind = "height_mismatch";
    crack.gap_m = gap;
    crack.at = mesh_.positions[at];
    crack.vertices = {a.from, a.to, b.from, b.to};
    std::sort(crack.vertices.begin(), crack.vertices.end());
    crack.vertices.erase(std::unique(crack.vertices.begin(), crack.vertices.end()), crack.vertices.end());
    crack.triangles = {std::min(a.triangle, b.triangle), std::max(a.triangle, b.triangle)};
    // The higher of the two ends is the place, so that it does not depend on which edge came first.
    for (const std::uint32_t v : crack.vertices) {
      const Vec3& p = mesh_.positions[v];
      if (p.x == crack.at.x && p.y == crack.at.y && p.z > crack.at.z) crack.at = p;
    }
    findings_.push_back(std::move(crack));
    ++seams_.cracks;
  }

  void cancel_by_geometry() {
    Residual& residual = seams_.residual;
    residual.points.resize(table_.size());
    residual.vertex.assign(table_.size(), kNone);
    residual.excused.assign(table_.size(), false);
    for (std::uint32_t p = 0; p < table_.size(); ++p) residual.points[p] = plan(p);
    for (const std::uint32_t p : excused_points_) residual.excused[p] = true;

    std::vector<std::uint32_t> ends;
    for (const Carrier& c : carriers_) {
      ends.insert(ends.end(), {c.u, c.v});
      if (!c.of_mesh()) continue;
      residual.vertex[c.u] = std::min(residual.vertex[c.u], c.from);
      residual.vertex[c.v] = std::min(residual.vertex[c.v], c.to);
      if (!c.silent) corners_.insert(corners_.end(), {{c.u, c.from}, {c.v, c.to}});
    }
    sort_unique(ends);
    sort_unique(corners_);
    const PointTree tree(residual.points, std::move(ends));

    std::vector<Piece> pieces;
    std::vector<std::uint32_t> stops;
    for (std::uint32_t i = 0; i < carriers_.size(); ++i) {
      const Carrier& c = carriers_[i];
      stops.assign(1, c.u);
      tree.inside(residual.points[c.u], residual.points[c.v], stops);
      // tree.inside sorted only what it appended
      stops.push_back(c.v);
      if (c.of_mesh() && !c.silent) {
        for (std::size_t k = 1; k + 1 < stops.size(); ++k) report_t_vertex(c, stops[k]);
      }
      for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        const std::uint32_t p = stops[k], q = stops[k + 1];
        pieces.push_back({std::uint64_t{std::min(p, q)} << 32 | std::max(p, q), i, p < q});
      }
      if (pieces.size() > kMostPieces) {
        throw InputError(
            "the mesh's edges overlap so often that it is no surface (over 2^27 pieces); mend the mesh");
      }
    }
    std::sort(pieces.begin(), pieces.end());
    for (std::size_t i = 0; i < pieces.size();) {
      std::size_t end = i;
      while (end < pieces.size() && pieces[end].key == pieces[i].key) ++end;
      cancel_pieces({pieces.data() + i, end - i});
      i = end;
    }
  }

  void report_t_vertex(const Carrier& host, std::uint32_t point) {
    const Vec3 a = mesh_.positions[host.from], b = mesh_.positions[host.to];
    std::uint32_t vertex = kNone;
    HeightGap gap;
    auto it = std::lower_bound(corners_.begin(), corners_.end(), std::pair{point, 0u});
    for (; it != corners_.end() && it->first == point; ++it) {
      const HeightGap next = height_gap(a, b, mesh_.positions[it->second]);
      const bool wider = std::fabs(next.metres) > std::fabs(gap.metres) ||
                         (std::fabs(next.metres) == std::fabs(gap.metres) && next.metres > gap.metres);
      if (vertex == kNone || wider) {
        vertex = it->second;
        gap = next;
      }
    }
    if (vertex == kNone) return;  // a corner of the domain, or of a triangle that was set aside
    Finding finding;
    finding.code = gap.sign == 0 ? FindingCode::t_junction : FindingCode::crack;
    finding.severity = gap.sign == 0 ? Severity::hazard : Severity::fault;
    finding.kind = "t_vertex";
    finding.at = mesh_.positions[vertex];
    finding.gap_m = gap.metres;
    finding.vertices = {vertex, std::min(host.from, host.to), std::max(host.from, host.to)};
    finding.triangles = {host.triangle};
    findings_.push_back(std::move(finding));
    ++seams_.t_junctions;
    if (gap.sign != 0) ++seams_.cracks;
  }

  /// All pieces between the same two points.
  void cancel_pieces(std::span<const Piece> group) {
    int mesh_uses = 0, domain_uses = 0;
    bool excused = false;
    std::uint32_t triangle = kNone;
    std::vector<const Carrier*> up, down;
    for (const Piece& piece : group) {
      const Carrier& c = carriers_[piece.carrier];
      const int sign = piece.upwards ? 1 : -1;
      if (c.of_mesh()) {
        mesh_uses += sign;
        triangle = std::min(triangle, c.triangle);
        (piece.upwards ? up : down).push_back(&c);
      } else if (c.domain) {
        domain_uses += sign;
      } else {
        excused = true;
      }
    }
    if (!up.empty() && !down.empty()) {
      for (auto* edges : {&up, &down}) {
        std::sort(edges->begin(), edges->end(),
                  [this](const auto* a, const auto* b) { return lower(*a, *b); });
      }
      for (std::size_t k = 0; k < std::min(up.size(), down.size()); ++k) report_crack(*up[k], *down[k]);
    }
    int excess = mesh_uses - domain_uses;
    if (excess == 0 && domain_uses == 0) return;
    Residual& residual = seams_.residual;
    auto from = static_cast<std::uint32_t>(group[0].key >> 32);
    auto to = static_cast<std::uint32_t>(group[0].key);
    if (before_in_plan(residual.points[to], residual.points[from])) {
      std::swap(from, to);
      excess = -excess;
      domain_uses = -domain_uses;
    }
    residual.segments.push_back({from, to, excess, domain_uses, excused, triangle});
    residual.needs_regions |= excess != 0;
  }

  template <typename T>
  static void sort_unique(std::vector<T>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
  }

  const Mesh& mesh_;
  std::vector<Finding>& findings_;
  PointTable table_;
  bool duplicates_settled_;
  std::vector<Carrier> carriers_;
  std::vector<std::uint32_t> excused_points_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corners_;  // (point, mesh vertex), sorted
  Seams seams_;
};

}  // namespace

Seams close_seams(const Mesh& mesh, const PlanDomain& domain, std::span<const EdgeUse> left_over,
                  std::span<const VertexPair> excused_edges, std::span<const std::uint32_t> excused_vertices,
                  bool duplicates_settled, std::vector<Finding>& findings) {
  return SeamCloser(mesh, findings, duplicates_settled)
      .close(domain, left_over, excused_edges, excused_vertices);
}

}  // namespace plumbline::oracle::detail
