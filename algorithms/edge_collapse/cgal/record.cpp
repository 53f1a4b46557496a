// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/edge_collapse/cgal/record.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::edge_collapse {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = SurfaceMesh::Vertex_index;

/// Edges that stay, by index: a property map as CGAL wants one.
struct Constrained {
  using key_type = SurfaceMesh::Edge_index;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;
  const std::vector<std::uint8_t>* kept = nullptr;
  friend bool get(const Constrained& map, key_type edge) {
    return (*map.kept)[static_cast<std::size_t>(edge)] != 0;
  }
};

/// CGAL copies visitor and stop predicate; both point here.
struct Progress {
  Recording recording;
  std::size_t triangles = 0, least = 0;
};

struct Visitor : sms::Edge_collapse_visitor_base<SurfaceMesh> {
  Progress* progress = nullptr;

  template <class Profile>
  void OnCollapsed(const Profile& profile, Vertex kept) {
    progress->triangles -= (profile.left_face_exists() ? 1U : 0U) + (profile.right_face_exists() ? 1U : 0U);
    const Vertex removed = kept == profile.v0() ? profile.v1() : profile.v0();
    const auto& p = profile.surface_mesh().point(kept);
    progress->recording.collapses.push_back(
        {removed.idx(), kept.idx(), {p.x(), p.y(), p.z()}, progress->triangles});
  }
};

struct Stop {
  const Progress* progress = nullptr;
  template <class Cost, class Profile, class Count>
  bool operator()(const Cost&, const Profile&, Count, Count) const {
    return progress->triangles <= progress->least;
  }
};

SurfaceMesh as_cgal(const Mesh& mesh) {
  SurfaceMesh out;
  out.reserve(static_cast<SurfaceMesh::size_type>(mesh.positions.size()),
              static_cast<SurfaceMesh::size_type>(3 * mesh.triangles.size() / 2),
              static_cast<SurfaceMesh::size_type>(mesh.triangles.size()));
  std::vector<std::uint32_t> triangles_at(mesh.positions.size(), 0);
  for (const Vec3& p : mesh.positions) out.add_vertex(Kernel::Point_3(p.x, p.y, p.z));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const bool degenerate = a == b || b == c || c == a;
    if (degenerate || out.add_face(Vertex(a), Vertex(b), Vertex(c)) == SurfaceMesh::null_face())
      throw InputError(
          fmt::format("triangle {} (vertices {}, {}, {}) makes the mesh no oriented manifold: {}", t, a, b, c,
                      degenerate ? "it names a vertex twice"
                                 : "an edge has more than two triangles or two that run the same way, or a "
                                   "vertex joins two fans"));
    for (const std::uint32_t v : {a, b, c}) ++triangles_at[v];
  }
  // add_face lets two closed fans share a vertex; going around it then meets one of them only.
  for (const Vertex v : out.vertices()) {
    std::uint32_t met = 0;
    if (!out.is_isolated(v)) {
      for (const auto h : CGAL::halfedges_around_target(out.halfedge(v), out))
        met += out.is_border(h) ? 0U : 1U;
    }
    if (met != triangles_at[v.idx()])
      throw InputError(fmt::format("vertex {} joins two fans of triangles: no manifold", v.idx()));
  }
  return out;
}

template <class Cost, class Placement>
void collapse(SurfaceMesh& surface, const std::vector<std::uint8_t>& kept, const Cost& cost,
              const Placement& placement, Progress& progress) {
  const Constrained constrained{&kept};
  Visitor visitor;
  visitor.progress = &progress;
  sms::edge_collapse(
      surface, Stop{&progress},
      CGAL::parameters::edge_is_constrained_map(constrained)
          .get_cost(cost)
          .get_placement(sms::Constrained_placement<Placement, Constrained>(constrained, placement))
          .visitor(visitor));
}

}  // namespace

Recording record_collapses(const Mesh& mesh, Policy policy, bool keep_border, std::size_t least_triangles) {
  SurfaceMesh surface = as_cgal(mesh);
  std::vector<std::uint8_t> kept(surface.number_of_edges(), 0);
  if (keep_border) {
    for (const auto edge : surface.edges())
      kept[static_cast<std::size_t>(edge)] = surface.is_border(edge) ? 1 : 0;
  }
  Progress progress;
  progress.triangles = mesh.triangles.size();
  progress.least = least_triangles;
  if (policy == Policy::lindstrom_turk) {
    collapse(surface, kept, sms::LindstromTurk_cost<SurfaceMesh>(),
             sms::LindstromTurk_placement<SurfaceMesh>(), progress);
  } else {
    const sms::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel> policies(surface);
    collapse(surface, kept, policies.get_cost(), policies.get_placement(), progress);
  }
  std::vector<std::uint32_t> index(mesh.positions.size(), 0);
  Recording& recording = progress.recording;
  for (const Vertex v : surface.vertices()) {
    index[v.idx()] = static_cast<std::uint32_t>(recording.last.positions.size());
    const auto& p = surface.point(v);
    recording.last.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto face : surface.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    std::size_t k = 0;
    for (const Vertex v : CGAL::vertices_around_face(surface.halfedge(face), surface))
      triangle[k++] = index[v.idx()];
    recording.last.triangles.push_back(triangle);
  }
  return std::move(progress.recording);
}

}  // namespace plumbline::edge_collapse
