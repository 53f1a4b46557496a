// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
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
///  face; count
///    the triangles around it and ask whether the domain holds it.
///  - T-vertices and height mismatches: all pairs of an edge and a vertex, all pairs of edges.
namespace plumbline::test {

struct SlowVerdict {
  double missing_m2 = 0, overlap_m2 = 0, extra_m2 = 0;  ///< plan areas
  std::set<std::array<double, 6>>
      t_places;                          ///< T-vertex x, y; its edge's ends x, y, in the triangle's direction
  std::set<std::array<double, 6>> gaps;  ///< those that are off their edge
  std::size_t cracks = 0;                ///< coincident opposite edges at different heights
  std::size_t degenerate = 0, clockwise = 0;
  [[nodiscard]] bool clean() const {
    return missing_m2 == 0 && overlap_m2 == 0 && extra_m2 == 0 && t_places.empty() && cracks == 0 &&
           degenerate == 0 && clockwise == 0;
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

/// A point strictly inside a bounded face: on the vertical line through an edge's middle, half way to the
/// nearest other edge above (or left of, for a vertical edge).
inline Point inside(const Arrangement& arrangement, Arrangement::Face_const_handle face) {
  auto edge = face->outer_ccb();
  const Point a = edge->source()->point(), b = edge->target()->point();
  const Point middle = CGAL::midpoint(a, b);
  const Kernel::Vector_2 inwards(a.y() - b.y(), b.x() - a.x());  // the face lies to the left
  Number nearest = 1;
  for (auto other = arrangement.edges_begin(); other != arrangement.edges_end(); ++other) {
    // middle + s·inwards = c + u·(d − c)
    const Point c = other->source()->point(), d = other->target()->point();
    const Kernel::Vector_2 along = d - c, to = c - middle;
    const Number cross = inwards.x() * along.y() - inwards.y() * along.x();
    if (cross == 0) {
      for (const Point& end : {c, d}) {
        const Kernel::Vector_2 e = end - middle;
        if (e.x() * inwards.y() != e.y() * inwards.x()) continue;
        const Number s = (e * inwards) / (inwards * inwards);
        if (s > 0 && s < nearest) nearest = s;
      }
      continue;
    }
    const Number s = (to.x() * along.y() - to.y() * along.x()) / cross;
    const Number u = (to.x() * inwards.y() - to.y() * inwards.x()) / cross;
    if (s > 0 && u >= 0 && u <= 1 && s < nearest) nearest = s;
  }
  return middle + inwards * (nearest / 2);
}

inline Number area(Arrangement::Face_const_handle face) {
  Number twice = 0;
  const auto walk = [&twice](Arrangement::Ccb_halfedge_const_circulator start) {
    auto edge = start;
    do {
      const Point a = edge->source()->point(), b = edge->target()->point();
      twice += a.x() * b.y() - a.y() * b.x();
    } while (++edge != start);
  };
  walk(face->outer_ccb());
  for (auto hole = face->inner_ccbs_begin(); hole != face->inner_ccbs_end(); ++hole) walk(*hole);
  return twice / 2;
}

}  // namespace slow

inline SlowVerdict slow_conformity(const Mesh& mesh, const PlanDomain& domain) {
  using namespace slow;
  SlowVerdict verdict;
  Arrangement arrangement;
  std::vector<Segment> segments;
  struct Edge {
    Vec3 a, b;
  };
  std::vector<Edge> edges;
  std::vector<std::array<Point, 3>> triangles;
  for (const auto& corners : mesh.triangles) {
    std::array<Vec3, 3> p{mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]};
    const auto turn = CGAL::orientation(plan(p[0]), plan(p[1]), plan(p[2]));
    verdict.degenerate += turn == CGAL::COLLINEAR;
    verdict.clockwise += turn == CGAL::CLOCKWISE;
    if (turn != CGAL::COUNTERCLOCKWISE) continue;
    triangles.push_back({plan(p[0]), plan(p[1]), plan(p[2])});
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
  CGAL::insert(arrangement, segments.begin(), segments.end());

  Number missing = 0, overlap = 0, extra = 0;
  for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) {
    if (face->is_unbounded()) continue;
    const Point p = inside(arrangement, face);
    int coverage = 0;
    for (const auto& [a, b, c] : triangles) {
      coverage += CGAL::orientation(a, b, p) == CGAL::LEFT_TURN &&
                  CGAL::orientation(b, c, p) == CGAL::LEFT_TURN &&
                  CGAL::orientation(c, a, p) == CGAL::LEFT_TURN;
    }
    const bool wanted = promised(domain, p);
    if (wanted && coverage == 0) missing += area(face);
    if (wanted && coverage > 1) overlap += area(face);
    if (!wanted && coverage > 0) extra += area(face);
  }
  verdict.missing_m2 = CGAL::to_double(missing);
  verdict.overlap_m2 = CGAL::to_double(overlap);
  verdict.extra_m2 = CGAL::to_double(extra);

  for (const Edge& e : edges) {
    const Segment segment(plan(e.a), plan(e.b));
    for (const Edge& other : edges) {
      const Vec3& v = other.a;  // every corner of a sound triangle starts an edge
      if (plan(v) != plan(e.a) && plan(v) != plan(e.b) && segment.has_on(plan(v))) {
        const std::array place{v.x, v.y, e.a.x, e.a.y, e.b.x, e.b.y};
        verdict.t_places.insert(place);
        const Number share = e.a.x != e.b.x ? (Number(v.x) - e.a.x) / (Number(e.b.x) - e.a.x)
                                            : (Number(v.y) - e.a.y) / (Number(e.b.y) - e.a.y);
        if (Number(v.z) != e.a.z + share * (Number(e.b.z) - e.a.z)) verdict.gaps.insert(place);
      }
      const bool opposite = plan(e.a) == plan(other.b) && plan(e.b) == plan(other.a);
      if (opposite && &e < &other) verdict.cracks += e.a.z != other.b.z || e.b.z != other.a.z;
    }
  }
  return verdict;
}

}  // namespace plumbline::test
