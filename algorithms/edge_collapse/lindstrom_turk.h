// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "scenarios/mesh.h"

namespace plumbline::edge_collapse {

/// CGAL's edge collapse with Lindstrom and Turk's cost and placement, borders constrained, down to
/// `triangles` or to where no edge may collapse. Indices of the vertices that remain are kept. Throws
/// InputError for a mesh that is no oriented manifold, naming the first triangle that makes it none.
Mesh lindstrom_turk(const Mesh& full, std::size_t triangles);

}  // namespace plumbline::edge_collapse
