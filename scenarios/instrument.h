// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "scenarios/mesh.h"

namespace plumbline {

/// Triangles of the measuring instrument in the vertex tree's paper (figure 10), and of ours.
inline constexpr std::size_t kInstrumentTriangles = 86802;

/// A measuring instrument: a rounded casing with dials (bezel, face, scale, needle), knurled knobs, screws, a
/// grille, feet, a carrying ring and a rod. Exactly kInstrumentTriangles triangles; every part is a closed,
/// outward oriented manifold; 2 m wide, its front panel towards −y, z up. The same bits everywhere.
Mesh instrument_mesh();

}  // namespace plumbline
