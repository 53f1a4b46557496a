// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/haar_quadtree/cut.h"
#include "algorithms/haar_quadtree/forest.h"

namespace plumbline::haar_quadtree {

/// The adaptive triangulation of a cut (§4): as if in the full triangulation every vertex were moved onto its
/// root and all degenerate triangles dropped. Equivalently the dual of the partition into cells: one triangle
/// where three cells meet in a point, two where four meet, with the diagonal from the south-west cell to the
/// north-east one. Walks the tree's cells, common edges and corners; cost proportional to the output.
/// Requires: every root of the cut has its vertex.
void triangulate(const Forest& forest, const Cut& cut, std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The specification, taken literally: every triangle of the full triangulation with its corners moved onto
/// their roots. Linear in the samples; the oracle of the tests. Triangles in no particular order.
void collapse_full_triangulation(const Forest& forest, const Cut& cut,
                                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace plumbline::haar_quadtree
