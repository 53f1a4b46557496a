// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/mesh.h"
#include "scenarios/random.h"
#include "scenarios/terrain.h"

/// Sound meshes to plant faults in, made by nobody's method.
namespace plumbline::faults {

struct Surface {
  Mesh mesh;
  PlanDomain domain;
};

/// n × n vertices of random height, both diagonals in random turns. Requires: n ≥ 2.
Surface random_grid(int n, Random& random);

/// Right isosceles triangles of different sizes that meet edge to edge: random newest-vertex bisection on a
/// grid of (2^levels + 1)², closed so that no vertex stands on an edge. Requires: levels ≥ 1.
Surface random_bintree(int levels, Random& random);

/// The same surface with its vertices and triangles in random order, each triangle from a random corner.
Surface shuffled(const Surface& surface, Random& random);

/// side × side samples of eighths of a metre in [0, relief_m): sums and differences of heights are exact.
Terrain random_terrain(int side, double spacing_m, double relief_m, Random& random);

/// A closed, outward oriented box of n × n × n cells, `size_m` a side, centred at the origin: 12·n²
/// triangles.
Mesh box(int n, double size_m);

/// That box blown up to a ball, its radius roughened by up to a tenth.
Mesh pebble(int n, double radius_m, Random& random);

}  // namespace plumbline::faults
