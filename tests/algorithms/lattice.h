// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/lod_method.h"
#include "scenarios/random.h"

// Small terrains, cameras, and a slow direct look at meshes whose vertices are samples. It shares no code
// with the oracle: everything is decided on the integer grid, from `vertex_keys`.
namespace plumbline::lattice {

struct Point {
  int i = 0, j = 0;
  friend auto operator<=>(const Point&, const Point&) = default;
};

/// What is wrong with a frame's mesh on the grid; all zero for a conforming cover of its area.
struct Faults {
  int t_junctions = 0;       ///< samples that are vertices and lie inside another triangle's edge
  int turned = 0;            ///< triangles that are not counter-clockwise
  int doubled = 0;           ///< directed edges used twice
  int inner_border = 0;      ///< edges without a twin that do not lie on the border of the whole grid
  long double_area = 0;      ///< twice the covered area, in cells
  double largest_gap_m = 0;  ///< vertical, over T-junctions
};

inline Faults look_at(const Terrain& terrain, const LodFrame& frame) {
  Faults out;
  std::vector<Point> points;
  std::set<Point> used;
  for (const std::uint64_t key : frame.vertex_keys) {
    points.push_back({static_cast<int>(key % static_cast<std::uint64_t>(terrain.columns)),
                      static_cast<int>(key / static_cast<std::uint64_t>(terrain.columns))});
  }
  std::map<std::pair<Point, Point>, int> edges;
  for (const auto& t : frame.mesh.triangles) {
    const Point a = points[t[0]], b = points[t[1]], c = points[t[2]];
    const long area = static_cast<long>(b.i - a.i) * (c.j - a.j) - static_cast<long>(b.j - a.j) * (c.i - a.i);
    if (area <= 0) ++out.turned;
    out.double_area += area;
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      used.insert(p);
      ++edges[{p, q}];
    }
  }
  for (const auto& [edge, count] : edges) {
    const auto [p, q] = edge;
    if (count > 1) ++out.doubled;
    const bool border = (p.i == q.i && (p.i == 0 || p.i == terrain.columns - 1)) ||
                        (p.j == q.j && (p.j == 0 || p.j == terrain.rows - 1));
    if (!border && !edges.contains({q, p})) ++out.inner_border;
    const int steps = std::gcd(q.i - p.i, q.j - p.j);
    for (int s = 1; s < steps; ++s) {
      const Point between{p.i + (q.i - p.i) / steps * s, p.j + (q.j - p.j) / steps * s};
      if (!used.contains(between)) continue;
      ++out.t_junctions;
      const double along = static_cast<double>(s) / steps;
      const double edge_z = terrain.z(p.i, p.j) * (1 - along) + terrain.z(q.i, q.j) * along;
      out.largest_gap_m = std::max(out.largest_gap_m, std::fabs(terrain.z(between.i, between.j) - edge_z));
    }
  }
  return out;
}

/// Twice the grid's area, in cells.
inline long double_area(const Terrain& terrain) { return 2L * (terrain.columns - 1) * (terrain.rows - 1); }

/// Room for the rounding of i·spacing in sums of cross products over a few hundred corners, in cells.
inline constexpr double kAreaRoundingCells = 1e-9;

/// Twice the area of a frame's promised domain, in cells (loops are signed).
inline double double_area(const PlanDomain& domain, double spacing_m) {
  double sum = 0;
  for (const auto& loop : domain.loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = loop[k], b = loop[(k + 1) % loop.size()];
      sum += (a.x * b.y - a.y * b.x) / (spacing_m * spacing_m);
    }
  }
  return sum;
}

inline Terrain flat(int columns, int rows, double spacing_m = 1) {
  Terrain out;
  out.id = "flat";
  out.columns = columns;
  out.rows = rows;
  out.spacing_m = spacing_m;
  out.heights_m.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0);
  return out;
}

/// Noise on every scale: heights fall with the level at which a sample first counts, so all levels matter.
inline Terrain rough(int columns, int rows, std::uint64_t seed, double relief_m, double spacing_m = 1) {
  Terrain out = flat(columns, rows, spacing_m);
  out.id = "rough";
  for (int step = 1; step < columns; step *= 2) {
    const double amplitude_m = relief_m * step / columns;
    const auto at = [&](int i, int j) {
      return static_cast<double>(lattice_hash(seed + static_cast<std::uint64_t>(step), i, j) >> 40) * 0x1p-24;
    };
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const int a = i / step, b = j / step;
        const double s = static_cast<double>(i % step) / step, t = static_cast<double>(j % step) / step;
        const double south = at(a, b) * (1 - s) + at(a + 1, b) * s;
        const double north = at(a, b + 1) * (1 - s) + at(a + 1, b + 1) * s;
        out.heights_m[out.index(i, j)] += amplitude_m * (south * (1 - t) + north * t);
      }
    }
  }
  return out;
}

/// A camera somewhere around the terrain, looking at a random point of it.
inline Camera any_camera(Random& random, const Terrain& terrain) {
  const double w = terrain.width_m(), d = terrain.depth_m(), top = terrain.highest_m();
  const double rise = terrain.highest_m() - terrain.lowest_m() + w;
  const Vec3 eye{random.between(-0.3 * w, 1.3 * w), random.between(-0.3 * d, 1.3 * d),
                 top + rise * random.unit() * random.unit()};
  const Vec3 target{random.between(0, w), random.between(0, d), terrain.lowest_m() - 1};
  return make_camera(eye, target, random.between(20, 100), 640, 480);
}

inline bool same_mesh(const LodFrame& a, const LodFrame& b) {
  return a.mesh.positions == b.mesh.positions && a.mesh.triangles == b.mesh.triangles &&
         a.vertex_keys == b.vertex_keys && a.domain.loops == b.domain.loops;
}

/// The triangles as sets of sample indices, each starting at its least: meshes equal but for order compare
/// equal.
inline std::vector<std::array<std::uint64_t, 3>> canonical(const LodFrame& frame) {
  std::vector<std::array<std::uint64_t, 3>> out;
  for (const auto& t : frame.mesh.triangles) {
    std::array<std::uint64_t, 3> k{frame.vertex_keys[t[0]], frame.vertex_keys[t[1]], frame.vertex_keys[t[2]]};
    std::rotate(k.begin(), std::min_element(k.begin(), k.end()), k.end());
    out.push_back(k);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace plumbline::lattice
