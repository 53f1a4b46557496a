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
#include "scenarios/mesh.h"
#include "scenarios/random.h"

/// Sound meshes to plant faults in, and words for what was found.
namespace plumbline::test {

struct Surface {
  Mesh mesh;
  PlanDomain domain;
};

inline double rough_height_m(Random& random) { return random.between(0, 30); }

/// n × n vertices, both diagonals in random turns.
inline Surface random_grid(int n, Random& random) {
  Surface s;
  const double spacing_m = random.below(2) == 0 ? 1 : random.between(0.5, 40);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i)
      s.mesh.positions.push_back({i * spacing_m, j * spacing_m, rough_height_m(random)});
  }
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * n + i), d = a + static_cast<std::uint32_t>(n);
      const std::uint32_t b = a + 1, c = d + 1;
      if (random.below(2) == 0) {
        s.mesh.triangles.insert(s.mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        s.mesh.triangles.insert(s.mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  s.domain.add_rectangle({0, 0}, {(n - 1) * spacing_m, (n - 1) * spacing_m});
  return s;
}

/// Right isosceles triangles of different sizes that meet edge to edge: random newest-vertex bisection on a
/// grid of (2^levels + 1)², closed so that no vertex stands on an edge.
inline Surface random_bintree(int levels, Random& random) {
  using Lattice = std::pair<int, int>;
  struct Half {
    Lattice apex, left, right;  // counter-clockwise; left–right is the hypotenuse
  };
  const int size = 1 << levels;
  std::vector<Half> leaves{{{size, 0}, {size, size}, {0, 0}}, {{0, size}, {0, 0}, {size, size}}};
  const auto middle = [](Lattice a, Lattice b) {
    return Lattice{(a.first + b.first) / 2, (a.second + b.second) / 2};
  };
  const auto can_split = [](const Half& h) {
    return (h.left.first + h.right.first) % 2 == 0 && (h.left.second + h.right.second) % 2 == 0;
  };
  const auto split = [&](std::size_t i) {
    const Half h = leaves[i];
    const Lattice m = middle(h.left, h.right);
    leaves[i] = {m, h.apex, h.left};
    leaves.push_back({m, h.right, h.apex});
  };
  for (int step = 0; step < 6 * size; ++step) {
    const std::size_t i = random.below(leaves.size());
    if (can_split(leaves[i])) split(i);
  }
  for (bool changed = true; changed;) {
    changed = false;
    std::set<Lattice> used;
    for (const Half& h : leaves) used.insert({h.apex, h.left, h.right});
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Half h = leaves[i];
      for (const auto& [a, b] : {std::pair{h.apex, h.left}, {h.left, h.right}, {h.right, h.apex}}) {
        if ((a.first + b.first) % 2 != 0 || (a.second + b.second) % 2 != 0 || !used.contains(middle(a, b)))
          continue;
        split(i);
        changed = true;
        break;
      }
    }
  }
  Surface s;
  std::map<Lattice, std::uint32_t> index;
  for (const Half& h : leaves) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Lattice p = std::array{h.apex, h.left, h.right}[k];
      const auto [it, is_new] = index.try_emplace(p, static_cast<std::uint32_t>(index.size()));
      if (is_new) {
        s.mesh.positions.push_back(
            {static_cast<double>(p.first), static_cast<double>(p.second), rough_height_m(random)});
      }
      corners[k] = it->second;
    }
    s.mesh.triangles.push_back(corners);
  }
  s.domain.add_rectangle({0, 0}, {static_cast<double>(size), static_cast<double>(size)});
  return s;
}

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
