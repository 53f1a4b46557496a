// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// O7 by CGAL: self-intersections (exact predicates), Hausdorff distances (bounded error), nearest triangles.
// What is not verified here: manifoldness (soundness.cpp), and anything about a picture but its area.
#include "oracle/likeness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <boost/iterator/function_output_iterator.hpp>

#include "oracle/predicates.h"
#include "scenarios/portable_math.h"

namespace plumbline::oracle {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Surface::Face_index;

bool has_area(Vec3 a, Vec3 b, Vec3 c) {
  return orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}).value != 0 ||
         orientation({a.y, a.z}, {b.y, b.z}, {c.y, c.z}).value != 0 ||
         orientation({a.z, a.x}, {b.z, b.x}, {c.z, c.x}).value != 0;
}

/// A mesh in CGAL's structure; face k is triangle `triangle[k]`.
struct Converted {
  Surface surface;
  std::vector<std::uint32_t> triangle;
};

bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

std::optional<Converted> convert(const Mesh& mesh) {
  Converted out;
  for (const Vec3 p : mesh.positions)
    out.surface.add_vertex(is_finite(p) ? Kernel::Point_3(p.x, p.y, p.z) : Kernel::Point_3(CGAL::ORIGIN));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (!is_finite(mesh.positions[a]) || !is_finite(mesh.positions[b]) || !is_finite(mesh.positions[c]) ||
        !has_area(mesh.positions[a], mesh.positions[b], mesh.positions[c]))
      continue;
    const Face face =
        out.surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c));
    if (face == Surface::null_face()) return std::nullopt;
    out.triangle.push_back(t);
  }
  // CGAL asks a mesh's faces only; vertices without any would enter its boxes.
  for (const Surface::Vertex_index v : out.surface.vertices()) {
    if (out.surface.is_isolated(v)) out.surface.remove_vertex(v);
  }
  return out;
}

CertifiedDistance farthest(const Surface& from, const Surface& to, double within_m) {
  const double estimate_m =
      processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(from, to, within_m);
  return {std::max(0.0, estimate_m - within_m), estimate_m + within_m};
}

Vec3 normal_of(const Mesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
}

void compare_normals(const Converted& reference, const Mesh& reference_mesh, const Converted& mesh,
                     const Mesh& simplified, Likeness& out) {
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  Tree tree(mesh.surface.faces().begin(), mesh.surface.faces().end(), mesh.surface);
  tree.accelerate_distance_queries();
  double area = 0, weighted = 0, turned = 0;
  for (const std::uint32_t t : reference.triangle) {
    const auto& [a, b, c] = reference_mesh.triangles[t];
    const Vec3 centroid =
        (reference_mesh.positions[a] + reference_mesh.positions[b] + reference_mesh.positions[c]) *
        (1.0 / 3.0);
    const Face nearest = tree.closest_point_and_primitive({centroid.x, centroid.y, centroid.z}).second;
    const Vec3 n = normal_of(reference_mesh, t);
    const Vec3 m = normal_of(simplified, mesh.triangle[nearest]);
    const double angle_deg = exact_atan2(length(cross(n, m)), dot(n, m)) / kRadiansPerDegree;
    const double weight = length(n);
    out.normal_max_deg = std::max(out.normal_max_deg, angle_deg);
    area += weight;
    weighted += weight * angle_deg;
    if (dot(n, m) < 0) turned += weight;
  }
  if (area > 0) {
    out.normal_mean_deg = weighted / area;
    out.turned_share = turned / area;
  }
}

}  // namespace

std::optional<std::vector<TrianglePair>> self_intersections(const Mesh& mesh) {
  auto some = some_self_intersections(mesh, std::numeric_limits<std::size_t>::max());
  if (!some) return std::nullopt;
  return std::move(some->pairs);
}

std::optional<SomeIntersections> some_self_intersections(const Mesh& mesh, std::size_t most) {
  const std::optional<Converted> converted = convert(mesh);
  if (!converted) return std::nullopt;
  SomeIntersections out;
  // CGAL tells each pair once, in an order that depends on the mesh alone.
  const auto take = [&](const std::pair<Face, Face>& pair) {
    if (out.total++ >= most) return;
    const std::uint32_t s = converted->triangle[pair.first], t = converted->triangle[pair.second];
    out.pairs.push_back({std::min(s, t), std::max(s, t)});
  };
  processing::self_intersections<CGAL::Sequential_tag>(converted->surface,
                                                       boost::make_function_output_iterator(take));
  std::sort(out.pairs.begin(), out.pairs.end());
  return out;
}

std::optional<Likeness> compare_in_space(const Mesh& mesh, const Mesh& reference, double within_m) {
  const std::optional<Converted> a = convert(mesh), b = convert(reference);
  if (!a || !b || a->triangle.empty() || b->triangle.empty()) return std::nullopt;
  Likeness out;
  out.to_mesh = farthest(b->surface, a->surface, within_m);
  out.from_mesh = farthest(a->surface, b->surface, within_m);
  compare_normals(*b, reference, *a, mesh, out);
  return out;
}

Vec3 farthest_vertex(const Mesh& mesh, const Mesh& reference) {
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  const std::optional<Converted> a = convert(mesh), b = convert(reference);
  Vec3 out;
  if (!a || !b || a->triangle.empty() || b->triangle.empty()) return out;
  double most = -1;
  for (const auto& [from, to] : {std::pair(&*a, &*b), std::pair(&*b, &*a)}) {
    const Tree tree(faces(to->surface).first, faces(to->surface).second, to->surface);
    for (const Surface::Vertex_index v : from->surface.vertices()) {
      const Kernel::Point_3& p = from->surface.point(v);
      const double squared = CGAL::to_double(tree.squared_distance(p));
      if (!(squared > most)) continue;
      most = squared;
      out = {p.x(), p.y(), p.z()};
    }
  }
  return out;
}

double projected_area_error(const PixelHits& reference_hits, const PixelHits& mesh_hits) {
  const auto seen = [](const PixelHits& hits) {
    return static_cast<double>(hits.triangle.size()) -
           static_cast<double>(std::count(hits.triangle.begin(), hits.triangle.end(), PixelHits::kNoHit));
  };
  const double reference = seen(reference_hits), mesh = seen(mesh_hits);
  if (reference == mesh) return 0;
  return (mesh - reference) / reference;
}

}  // namespace plumbline::oracle
