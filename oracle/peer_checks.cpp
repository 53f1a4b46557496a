// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/peer_checks.h"

#include <optional>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/version.h>

namespace plumbline::oracle {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// Nothing if the soup is no polygon mesh even after orient_polygon_soup.
std::optional<Surface> repaired(const Mesh& mesh) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  for (const auto& t : mesh.triangles) polygons.push_back({t[0], t[1], t[2]});
  pmp::orient_polygon_soup(points, polygons);
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) return {};
  Surface surface;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
  return surface;
}

}  // namespace

std::optional<bool> cgal_self_intersects(const Mesh& mesh) {
  const std::optional<Surface> surface = repaired(mesh);
  if (!surface) return {};
  return pmp::does_self_intersect(*surface);
}

bool cgal_valid_after_repair(const Mesh& mesh) {
  const std::optional<Surface> surface = repaired(mesh);
  return surface && CGAL::is_valid_polygon_mesh(*surface);
}

const char* cgal_version() { return CGAL_VERSION_STR; }

}  // namespace plumbline::oracle
