// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/convex_hull_2.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "oracle/conformity.h"
#include "properties/faults/sound_meshes.h"
#include "scenarios/mesh.h"
#include "scenarios/random.h"

/// Sound meshes to plant faults in, and words for what was found.
namespace plumbline::test {

using faults::random_bintree;
using faults::random_grid;
using faults::Surface;

inline double rough_height_m(Random& random) { return random.between(0, 30); }

/// Delaunay triangulation of random points; the domain is their convex hull. `lattice`: points have small
/// integer coordinates, so that collinear and cocircular ones are frequent.
inline Surface random_delaunay(int count, bool lattice, Random& random) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
  CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>> triangulation;
  Surface s;
  for (int i = 0; i < count; ++i) {
    const double x = lattice ? static_cast<double>(random.below(7)) : random.between(-50, 50);
    const double y = lattice ? static_cast<double>(random.below(7)) : random.between(-50, 50);
    const auto before = triangulation.number_of_vertices();
    const auto vertex = triangulation.insert({x, y});
    if (triangulation.number_of_vertices() == before) continue;
    vertex->info() = static_cast<std::uint32_t>(s.mesh.positions.size());
    s.mesh.positions.push_back({x, y, rough_height_m(random)});
  }
  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
    s.mesh.triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  }
  std::vector<Kernel::Point_2> points, hull;
  for (const Vec3& p : s.mesh.positions) points.emplace_back(p.x, p.y);
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  s.domain.loops.emplace_back();
  for (const auto& p : hull) s.domain.loops[0].push_back({p.x(), p.y()});
  if (s.mesh.triangles.empty()) s = {};  // all points on one line
  return s;
}

inline std::string text(const oracle::ConformityReport& report) {
  std::string all;
  for (const oracle::Finding& f : report.findings) {
    all += fmt::format("{} {} at ({}, {}, {}) gap {} area {} distance {} vertices [{}] triangles [{}]\n",
                       finding_name(f.code), f.kind, f.at.x, f.at.y, f.at.z, f.gap_m, f.area_m2, f.distance_m,
                       fmt::join(f.vertices, " "), fmt::join(f.triangles, " "));
  }
  return all;
}

}  // namespace plumbline::test
