// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include "scenarios/mesh.h"

/// The slow obvious twin of check_conformity, for small meshes with good indices and finite coordinates. It
/// shares no code with it: every question is asked of every pair, in rationals, by the definition.
///  - coverage: the arrangement of all edges of all triangles and of the domain; one exact point inside each
///    face; count the triangles around it and ask whether the domain holds it. Faces of one class that share
///    an edge are one region.
///  - T-vertices and height mismatches: all pairs of an edge and a vertex, all pairs of edges.
///  - duplicates: all pairs of triangles.
namespace plumbline::test {

struct SlowVerdict {
  /// Plan areas of the regions of each class, ascending. `missing` is split by whether the region touches the
  /// promised outline.
  std::vector<double> holes_m2, missing_m2, overlaps_m2, extras_m2;
  double covered_once_m2 = 0;  ///< inside the domain
  double promised_m2 = 0;
  std::set<std::array<double, 6>>
      t_places;  ///< T-vertex x, y; its edge's ends x, y, in the triangle's direction
  std::map<std::array<double, 6>, double>
      gaps;                ///< those that are off their edge, with the widest gap, metres
  std::size_t cracks = 0;  ///< coincident opposite edges at different heights
  std::size_t degenerate = 0, clockwise = 0, duplicates = 0;
  [[nodiscard]] bool clean() const {
    return holes_m2.empty() && missing_m2.empty() && overlaps_m2.empty() && extras_m2.empty() &&
           t_places.empty() && cracks == 0 && degenerate == 0 && clockwise == 0 && duplicates == 0;
  }
};

namespace slow {

using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Number = Kernel::FT;
using Point = Kernel::Point_2;
using Segment = Kernel::Segment_2;
using Arrangement = CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>>;

inline Point plan(const Vec3& p) { return {p.x, p.y}; }

/// Crossing number of a ray to the right: is p inside the loops (even-odd)? p is on no edge.
inline bool promised(const PlanDomain& domain, const Point& p) {
  bool inside = false;
  for (const auto& loop : domain.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point a(loop[i].x, loop[i].y), b(loop[(i + 1) % loop.size()].x, loop[(i + 1) % loop.size()].y);
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      const Number x = a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y());
      if (x > p.x()) inside = !inside;
    }
  }
  return inside;
}

template <class Visit>
void each_edge(Arrangement::Face_const_handle face, Visit visit) {
  const auto walk = [&visit](Arrangement::Ccb_halfedge_const_circulator start) {
    auto edge = start;
    do {
      visit(Arrangement::Halfedge_const_handle(edge));
    } while (++edge != start);
  };
  if (!face->is_unbounded()) walk(face->outer_ccb());
  for (auto hole = face->inner_ccbs_begin(); hole != face->inner_ccbs_end(); ++hole) walk(*hole);
}

/// A point strictly inside a bounded face. Its leftmost corner v is convex; of the face's corners inside the
/// triangle of v and its neighbours a, b the one farthest from ab sees v, so the middle between them is
/// inside; if there is none, the triangle's centroid is.
inline Point inside(Arrangement::Face_const_handle face) {
  auto leftmost = face->outer_ccb();
  auto edge = leftmost;
  do {
    if (edge->target()->point() < leftmost->target()->point()) leftmost = edge;
  } while (++edge != face->outer_ccb());
  const Point v = leftmost->target()->point(), a = leftmost->source()->point(),
              b = leftmost->next()->target()->point();
  Point best = CGAL::centroid(a, v, b);
  Number farthest = 0;
  each_edge(face, [&](Arrangement::Halfedge_const_handle e) {
    const Point& p = e->target()->point();
    if (p == v || p == a || p == b) return;
    if (CGAL::orientation(a, v, p) == CGAL::RIGHT_TURN || CGAL::orientation(v, b, p) == CGAL::RIGHT_TURN)
      return;
    const Number far = (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    if (-far <= farthest) return;  // v lies to the right of a → b
    farthest = -far;
    best = CGAL::midpoint(v, p);
  });
  return best;
}

inline Number area(Arrangement::Face_const_handle face) {
  Number twice = 0;
  each_edge(face, [&twice](Arrangement::Halfedge_const_handle edge) {
    const Point &a = edge->source()->point(), &b = edge->target()->point();
    twice += a.x() * b.y() - a.y() * b.x();
  });
  return twice / 2;
}

/// What stands wrong at a point.
enum class Class { right, missing, overlap, extra };

inline Class judge(bool wanted, int coverage) {
  if (!wanted) return coverage > 0 ? Class::extra : Class::right;
  if (coverage < 1) return Class::missing;
  return coverage > 1 ? Class::overlap : Class::right;
}

}  // namespace slow

/// `turned`: the clockwise triangles that are to be read the other way round (their winding is their only
/// fault); other clockwise ones cover −1 times. Of triangles with the same three corners in space one
/// counter-clockwise one stays.
inline SlowVerdict slow_conformity(const Mesh& mesh, const PlanDomain& domain,
                                   const std::set<std::size_t>& turned = {}) {
  using namespace slow;
  SlowVerdict verdict;
  struct Edge {
    Vec3 a, b;
  };
  struct Solid {
    std::array<Vec3, 3> corner;
    int sign;
  };
  std::vector<Solid> triangles;
  const auto set_of = [](const std::array<Vec3, 3>& c) {
    return std::multiset<std::array<double, 3>>{
        {c[0].x, c[0].y, c[0].z}, {c[1].x, c[1].y, c[1].z}, {c[2].x, c[2].y, c[2].z}};
  };
  std::vector<std::size_t> number;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    std::array<Vec3, 3> p{mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]};
    const int turn = static_cast<int>(CGAL::orientation(plan(p[0]), plan(p[1]), plan(p[2])));
    const auto twin = std::find_if(triangles.begin(), triangles.end(),
                                   [&](const Solid& other) { return set_of(other.corner) == set_of(p); });
    if (twin != triangles.end()) {
      ++verdict.duplicates;
      if (turn <= twin->sign) continue;
      number[static_cast<std::size_t>(twin - triangles.begin())] = t;
      *twin = {p, turn};
      continue;
    }
    triangles.push_back({p, turn});
    number.push_back(t);
  }
  std::vector<Edge> edges;
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    auto& [p, sign] = triangles[i];
    verdict.degenerate += sign == 0;
    verdict.clockwise += sign < 0;
    if (turned.contains(number[i])) {
      std::swap(p[1], p[2]);
      sign = 1;
    }
    if (sign == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back({p[k], p[(k + 1) % 3]});
      segments.emplace_back(plan(p[k]), plan(p[(k + 1) % 3]));
    }
  }
  for (const auto& loop : domain.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
      segments.emplace_back(Point(a.x, a.y), Point(b.x, b.y));
    }
  }
  Arrangement arrangement;
  CGAL::insert(arrangement, segments.begin(), segments.end());

  struct Judged {
    Class state = Class::right;
    bool wanted = false;
    Number area = 0;
  };
  std::map<const void*, std::size_t> index;  // looked up, never walked
  std::vector<Arrangement::Face_const_handle> faces;
  std::vector<Judged> judged;
  Number once = 0, promise = 0;
  for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) {
    index[&*face] = faces.size();
    faces.emplace_back(face);
    judged.emplace_back();
    if (face->is_unbounded()) continue;
    const Point p = inside(face);
    int coverage = 0;
    for (const auto& [c, sign] : triangles) {
      if (sign == 0) continue;
      const Point a = plan(c[0]), b = plan(sign > 0 ? c[1] : c[2]), d = plan(sign > 0 ? c[2] : c[1]);
      if (CGAL::orientation(a, b, p) == CGAL::LEFT_TURN && CGAL::orientation(b, d, p) == CGAL::LEFT_TURN &&
          CGAL::orientation(d, a, p) == CGAL::LEFT_TURN)
        coverage += sign;
    }
    const bool wanted = promised(domain, p);
    judged.back() = {judge(wanted, coverage), wanted, area(face)};
    if (wanted) promise += judged.back().area;
    if (wanted && coverage == 1) once += judged.back().area;
  }
  verdict.covered_once_m2 = CGAL::to_double(once);
  verdict.promised_m2 = CGAL::to_double(promise);
  std::vector<bool> reached(faces.size());
  for (std::size_t first = 0; first < faces.size(); ++first) {
    if (reached[first] || judged[first].state == Class::right) continue;
    const Class state = judged[first].state;
    std::vector<std::size_t> members{first};
    reached[first] = true;
    Number total = 0;
    bool on_outline = false;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const bool wanted = judged[members[k]].wanted;
      total += judged[members[k]].area;
      each_edge(faces[members[k]], [&](Arrangement::Halfedge_const_handle edge) {
        const std::size_t next = index.at(&*edge->twin()->face());
        on_outline |= judged[next].wanted != wanted;
        if (reached[next] || judged[next].state != state) return;
        reached[next] = true;
        members.push_back(next);
      });
    }
    auto& list = state == Class::overlap ? verdict.overlaps_m2
                 : state == Class::extra ? verdict.extras_m2
                 : on_outline            ? verdict.missing_m2
                                         : verdict.holes_m2;
    list.push_back(CGAL::to_double(total));
  }
  for (auto* list : {&verdict.holes_m2, &verdict.missing_m2, &verdict.overlaps_m2, &verdict.extras_m2})
    std::sort(list->begin(), list->end());

  for (const Edge& e : edges) {
    const Segment segment(plan(e.a), plan(e.b));
    const double low_x = std::min(e.a.x, e.b.x), high_x = std::max(e.a.x, e.b.x);
    for (const Edge& other : edges) {
      const Vec3& v = other.a;  // every corner of a sound triangle starts an edge
      const bool end = (v.x == e.a.x && v.y == e.a.y) || (v.x == e.b.x && v.y == e.b.y);
      if (!end && v.x >= low_x && v.x <= high_x && segment.has_on(plan(v))) {
        const std::array place{v.x, v.y, e.a.x, e.a.y, e.b.x, e.b.y};
        verdict.t_places.insert(place);
        const Number share = e.a.x != e.b.x ? (Number(v.x) - e.a.x) / (Number(e.b.x) - e.a.x)
                                            : (Number(v.y) - e.a.y) / (Number(e.b.y) - e.a.y);
        const double gap = CGAL::to_double(Number(v.z - (e.a.z + share * (Number(e.b.z) - e.a.z))));
        if (Number(v.z) != e.a.z + share * (Number(e.b.z) - e.a.z)) {
          double& widest = verdict.gaps[place];
          widest = std::max(widest, std::fabs(gap));
        }
      }
      const bool opposite =
          e.a.x == other.b.x && e.a.y == other.b.y && e.b.x == other.a.x && e.b.y == other.a.y;
      if (opposite && &e < &other) verdict.cracks += e.a.z != other.b.z || e.b.z != other.a.z;
    }
  }
  return verdict;
}

}  // namespace plumbline::test
