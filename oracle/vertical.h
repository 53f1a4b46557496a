// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/mesh.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle {

/// O2's figures, metres.
struct VerticalError {
  double max = 0;          ///< sup |z_mesh − z_ref| against the declared diagonal
  double certain_max = 0;  ///< sup of the distance to the envelope of both diagonals: a fault either way
  double rms = 0;          ///< integrated exactly over the overlay, not sampled
  double mean = 0;         ///< of the absolute error, likewise
  Vec2 at;                 ///< where `max` is attained (lowest y, then x, among equals)
  Vec2 certain_at;
  double area_m2 = 0;      ///< plan area that was judged; 0 means nothing was
};

/// O2: the exact difference of two piecewise linear surfaces over their common plan domain. All vertices of the overlay
/// (samples, mesh vertices, crossings of mesh edges with grid lines and diagonals) are visited. Triangles that are not
/// positively oriented in plan are skipped (O1 reports them).
VerticalError vertical_error(const Mesh& mesh, const Terrain& terrain);

/// The terrain's own ambiguity: the largest gap between the two ways to split a cell, metres.
double diagonal_ambiguity_m(const Terrain& terrain);

}  // namespace plumbline::oracle
