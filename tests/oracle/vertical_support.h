// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Terrains and meshes for the tests of vertical error.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenarios/mesh.h"
#include "scenarios/random.h"
#include "scenarios/terrain.h"

namespace plumbline::test {

template <class Height>
Terrain make_terrain(int columns, int rows, double spacing_m, Height height) {
  Terrain terrain{"test", columns, rows, spacing_m, {}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) terrain.heights_m.push_back(height(i, j));
  }
  return terrain;
}

inline Terrain random_terrain(int columns, int rows, double spacing_m, std::uint64_t seed) {
  Random random(seed, "terrain");
  return make_terrain(columns, rows, spacing_m, [&](int, int) { return random.between(100, 120); });
}

/// Two triangles over the whole grid, split from the south-west to the north-east corner.
template <class Height>
Mesh two_triangles(const Terrain& terrain, Height height) {
  const double x = terrain.width_m(), y = terrain.depth_m();
  Mesh mesh;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{x, 0}, Vec2{x, y}, Vec2{0, y}}) {
    mesh.positions.push_back({p.x, p.y, height(p.x, p.y)});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Every cell split, by the declared diagonal where `declared(i, j)`, by the other one elsewhere.
template <class Declared>
Mesh grid_mesh(const Terrain& terrain, Declared declared) {
  Mesh mesh = reference_mesh(terrain);
  std::size_t k = 0;
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    for (int i = 0; i + 1 < terrain.columns; ++i, k += 2) {
      if (declared(i, j)) continue;
      const auto [a, b, c] = mesh.triangles[k];
      const std::uint32_t d = mesh.triangles[k + 1][2];
      mesh.triangles[k] = {a, b, d};
      mesh.triangles[k + 1] = {b, c, d};
    }
  }
  return mesh;
}

/// A triangle with corners drawn around the grid: on samples or anywhere, often partly outside; every fifth
/// off the samples is a sliver. Counter-clockwise, of positive area.
inline Mesh random_triangle(const Terrain& terrain, Random& random, bool on_samples, bool sliver) {
  for (;;) {
    Mesh mesh;
    for (int k = 0; k < 3; ++k) {
      double x = random.between(-2, terrain.columns + 1);
      double y = random.between(-2, terrain.rows + 1);
      if (on_samples) {
        x = std::floor(x);
        y = std::floor(y);
      }
      mesh.positions.push_back({x * terrain.spacing_m, y * terrain.spacing_m, random.between(95, 125)});
    }
    auto& p = mesh.positions;
    if (sliver) {
      const Vec3 along = p[1] - p[0];
      const double share = random.unit();
      p[2].x = p[0].x + share * along.x - 1e-3 * along.y;
      p[2].y = p[0].y + share * along.y + 1e-3 * along.x;
    }
    mesh.triangles = {{0, 1, 2}};
    const double twice_area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (twice_area > 1e-9) return mesh;
  }
}

/// Heights that the terrain's and the mesh's surfaces lie between, metres: the scale of rounding bounds.
inline double height_range_m(const Mesh& mesh, const Terrain& terrain) {
  double low = terrain.lowest_m(), high = terrain.highest_m();
  for (const Vec3& p : mesh.positions) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  return high - low;
}

}  // namespace plumbline::test
