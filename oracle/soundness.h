// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/conformity.h"

namespace plumbline::oracle {

/// What can be asked of a mesh that is no height field (ORACLES O7), decided exactly; no plan region, so
/// none of O1's plan findings. Filled are:
///   bad_index, non_finite  triangles and vertices as named; such triangles take no part in what follows
///   degenerate             a triangle names a vertex twice or has no area
///   duplicate              a triangle of the same three vertices as an earlier one
///   non_manifold           kind "edge": more than two triangles; kind "orientation": two that run along the
///                          edge the same way; kind "vertex": the triangles at a vertex form several fans
///   unused_vertex          no triangle names it (a hazard)
/// Border edges are none of these: objects may be open. Triangles without three different vertices are left
/// out of the questions about edges. n log n in triangles.
ConformityReport check_soundness(const Mesh& mesh);

}  // namespace plumbline::oracle
