// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "algorithms/decimation/decimation.h"
#include "algorithms/edge_collapse/cgal/record.h"

namespace plumbline::edge_collapse {

/// The full mesh and all collapses, in order: any count is read off by replaying the first so many. Throws
/// InputError (without the method's name) unless the mesh is an oriented manifold of finite positions.
std::shared_ptr<const decimation::Simplifier> make_simplifier(const Mesh& mesh, Policy policy,
                                                              bool keep_border);

/// The mesh after the first `collapses` of `recorded`: vertices in order of index, triangles in order of
/// `full`'s.
decimation::Decimated replay(const Mesh& full, const std::vector<Collapse>& recorded, std::size_t collapses);

}  // namespace plumbline::edge_collapse
