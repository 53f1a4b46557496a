// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Where CGAL enters the methods: Delaunay triangulation, and the exact sign of an orientation.
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include "algorithms/tin/tin.h"
#include "scenarios/error.h"

namespace plumbline::tin {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// Crossing roads would need a new point with a height nobody gave: refused instead.
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Point = Kernel::Point_2;

Point in_plan(Vec3 p) { return {p.x, p.y}; }

/// Turns every edge between two triangles on one circle so that it leaves the least of the four points. Each
/// turn lowers the least end of that edge, so it comes to an end: a fan from the least point of each circle.
void settle_ties(Triangulation& triangulation) {
  using FaceEdge = Triangulation::Edge;
  std::deque<FaceEdge> waiting;
  for (auto e = triangulation.finite_edges_begin(); e != triangulation.finite_edges_end(); ++e) {
    waiting.push_back(*e);
  }
  while (!waiting.empty()) {
    const auto [face, k] = waiting.front();
    waiting.pop_front();
    const auto other = face->neighbor(k);
    if (triangulation.is_infinite(face) || triangulation.is_infinite(other)) continue;
    if (triangulation.is_constrained({face, k})) continue;
    const auto a = face->vertex(k);
    const auto b = face->vertex(Triangulation::ccw(k));
    const auto c = other->vertex(other->index(face));
    const auto d = face->vertex(Triangulation::cw(k));
    // a opposite c across the edge b–d.
    if (CGAL::side_of_oriented_circle(a->point(), b->point(), d->point(), c->point()) !=
        CGAL::ON_ORIENTED_BOUNDARY) {
      continue;
    }
    const Point least = std::min({a->point(), b->point(), c->point(), d->point()});
    if (b->point() == least || d->point() == least) continue;
    auto turning = face;
    triangulation.flip(turning, k);  // keeps the marks of constrained edges
    for (const auto& turned : {face, other}) {
      for (int side = 0; side < 3; ++side) waiting.emplace_back(turned, side);
    }
  }
}

}  // namespace

int exact_plan_orientation(Vec3 a, Vec3 b, Vec3 c) {
  return static_cast<int>(CGAL::orientation(in_plan(a), in_plan(b), in_plan(c)));
}

Tin delaunay_tin(std::span<const Vec3> points, std::span<const std::vector<Vec3>> roads) {
  Tin out;
  std::map<std::pair<double, double>, std::uint32_t> number;  // by plan position
  const auto add = [&](Vec3 p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InputError("TIN: a point's coordinate is not finite; give finite metres");
    }
    const auto [place, fresh] =
        number.try_emplace({p.x, p.y}, static_cast<std::uint32_t>(out.mesh.positions.size()));
    if (fresh) out.mesh.positions.push_back(p);
    return place->second;
  };
  for (const Vec3& p : points) add(p);
  std::vector<Edge> wanted;
  for (const std::vector<Vec3>& road : roads) {
    for (std::size_t k = 0; k + 1 < road.size(); ++k) {
      const std::uint32_t u = add(road[k]);
      const std::uint32_t v = add(road[k + 1]);
      if (u != v) wanted.push_back({u, v});
    }
  }
  if (out.mesh.positions.size() < 3) {
    throw InputError(
        fmt::format("TIN: {} points make no triangle; give at least three", out.mesh.positions.size()));
  }

  std::vector<std::pair<Point, std::uint32_t>> numbered;
  for (std::size_t v = 0; v < out.mesh.positions.size(); ++v) {
    numbered.emplace_back(in_plan(out.mesh.positions[v]), static_cast<std::uint32_t>(v));
  }
  Triangulation triangulation;
  triangulation.insert(numbered.begin(), numbered.end());
  std::vector<Triangulation::Vertex_handle> handle(numbered.size());
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
    handle[v->info()] = v;
  }
  try {
    for (const Edge& e : wanted) triangulation.insert_constraint(handle[e[0]], handle[e[1]]);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw InputError("TIN: two roads cross where they have no common corner; add the crossing to both");
  }
  if (triangulation.dimension() < 2) {
    throw InputError("TIN: all points stand on one line; give at least one beside it");
  }
  settle_ties(triangulation);

  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
    std::array<std::uint32_t, 3> t{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    out.mesh.triangles.push_back(t);
  }
  std::sort(out.mesh.triangles.begin(), out.mesh.triangles.end());
  for (auto e = triangulation.constrained_edges_begin(); e != triangulation.constrained_edges_end(); ++e) {
    const std::uint32_t u = e->first->vertex(Triangulation::ccw(e->second))->info();
    const std::uint32_t v = e->first->vertex(Triangulation::cw(e->second))->info();
    out.roads.push_back({std::min(u, v), std::max(u, v)});
  }
  std::sort(out.roads.begin(), out.roads.end());
  return out;
}

}  // namespace plumbline::tin
