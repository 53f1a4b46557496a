// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline::edge_collapse {

enum class Policy { lindstrom_turk, garland_heckbert };

/// One collapse of CGAL's: `removed` goes into `kept`, which moves to `position`.
struct Collapse {
  std::uint32_t removed = 0, kept = 0;
  Vec3 position;
  std::size_t triangles_left = 0;
};

struct Recording {
  std::vector<Collapse> collapses;
  Mesh last;  ///< CGAL's own mesh after the last collapse
};

/// Runs CGAL's edge collapse on the mesh until `least_triangles` or fewer are left or no edge may go. With
/// `keep_border` border edges are constrained: neither they nor their vertices move. Throws InputError unless
/// the mesh is an oriented manifold, naming the first bad triangle or vertex. Requires: sound indices.
/// Source: CGAL 5.5 manual, package Triangulated Surface Mesh Simplification, policies with default
/// parameters.
Recording record_collapses(const Mesh& mesh, Policy policy, bool keep_border, std::size_t least_triangles);

}  // namespace plumbline::edge_collapse
