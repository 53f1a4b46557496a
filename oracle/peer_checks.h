// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "scenarios/mesh.h"

/// What a general geometry library says of a mesh, for the table beside plumbline's own findings. None of
/// plumbline's verdicts rests on it.
namespace plumbline::oracle {

/// CGAL's usual way from a soup to a mesh (orient_polygon_soup, polygon_soup_to_polygon_mesh), then its
/// self-intersection test (Polygon_mesh_processing, does_self_intersect). Nothing if the soup is no polygon
/// mesh even then. Requires: finite corners, indices in range.
std::optional<bool> cgal_self_intersects(const Mesh& mesh);

/// The same way, then is_valid_polygon_mesh; false too if there is no polygon mesh.
bool cgal_valid_after_repair(const Mesh& mesh);

/// CGAL's version, as "5.5.1".
const char* cgal_version();

}  // namespace plumbline::oracle
