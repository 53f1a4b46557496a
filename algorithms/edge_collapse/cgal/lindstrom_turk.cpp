// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/edge_collapse/lindstrom_turk.h"

#include <array>
#include <cstdint>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::edge_collapse {
namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using EdgeFlags = Surface::Property_map<Surface::Edge_index, bool>;

Surface to_surface(const Mesh& mesh) {
  Surface surface;
  surface.reserve(static_cast<Surface::size_type>(mesh.positions.size()),
                  static_cast<Surface::size_type>(3 * mesh.triangles.size()),
                  static_cast<Surface::size_type>(mesh.triangles.size()));
  for (const Vec3 p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c)) ==
        Surface::null_face()) {
      throw InputError(fmt::format(
          "edge_collapse: triangle {} ({}, {}, {}) makes an edge or a vertex that is no manifold; "
          "mend the mesh first",
          t, a, b, c));
    }
  }
  return surface;
}

}  // namespace

Mesh lindstrom_turk(const Mesh& full, std::size_t triangles) {
  Surface surface = to_surface(full);
  EdgeFlags border = surface.add_property_map<Surface::Edge_index, bool>("e:border", false).first;
  std::size_t border_edges = 0;
  for (const Surface::Edge_index e : surface.edges()) {
    border[e] = surface.is_border(e);
    border_edges += border[e] ? 1 : 0;
  }
  // A collapse that keeps the border takes two triangles and three edges: 3F = 2E − B throughout. CGAL stops
  // when fewer edges are left than asked.
  const std::size_t edges = (3 * triangles + border_edges) / 2 + 1;
  using Placement =
      simplification::Constrained_placement<simplification::LindstromTurk_placement<Surface>, EdgeFlags>;
  simplification::edge_collapse(surface, simplification::Count_stop_predicate<Surface>(edges),
                                CGAL::parameters::edge_is_constrained_map(border)
                                    .get_cost(simplification::LindstromTurk_cost<Surface>())
                                    .get_placement(Placement(border)));
  Mesh out;
  out.positions = full.positions;
  for (const Surface::Vertex_index v : surface.vertices()) {  // those that are left, by index
    const Kernel::Point_3& p = surface.point(v);
    out.positions[v] = {p.x(), p.y(), p.z()};
  }
  for (const Surface::Face_index f : surface.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t k = 0;
    for (const Surface::Vertex_index v : surface.vertices_around_face(surface.halfedge(f))) {
      corners.at(k++) = static_cast<std::uint32_t>(v);
    }
    out.triangles.push_back(corners);
  }
  return out;
}

}  // namespace plumbline::edge_collapse
