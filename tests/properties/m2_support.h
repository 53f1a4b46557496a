// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "algorithms/ring_tin/ring_tin.h"
#include "scenarios/camera.h"
#include "scenarios/generators.h"

/// What the tests and benchmarks of M2 share: the paper's point sets (TABLES P1) on stand-in terrain, and the
/// figures they are judged by.
namespace plumbline::m2 {

inline constexpr double kSpacingM = 10;  ///< §4 of the paper

/// One row of the paper's Table 2.
struct PointSet {
  int columns, rows;      ///< of regular points, before trimming
  std::size_t triangles;  ///< full TIN, as published
  std::size_t remain;     ///< after simplification, as published
  int levels;
  double screen_px;  ///< greatest screen error, as published
};
inline const std::vector<PointSet> kTable2{{101, 101, 19705, 9523, 4, 1.0},
                                           {119, 119, 27848, 12704, 5, 1.3},
                                           {164, 165, 53161, 26307, 5, 1.5},
                                           {259, 259, 132849, 60231, 5, 1.5}};

/// Gentle relief: one generated terrain for all four sets, of which each takes the middle.
inline Terrain relief(double relief_m, int size = 261) {
  TerrainSource source;
  source.id = "p1";
  source.generator = "fbm";
  source.seed = 5;
  source.size = size;
  source.spacing_m = kSpacingM;
  source.relief_m = relief_m;
  return generate_terrain(source);
}

struct TrimmedTin {
  tin::Tin tin;
  PlanDomain domain;
  Vec2 middle;
};

/// The Delaunay triangulation of the middle columns × rows samples without so many points of the outline,
/// evenly spread, that the count of triangles is the published one: a point on a side of the outline (not a
/// corner) is one triangle.
inline TrimmedTin trimmed_tin(const Terrain& terrain, const PointSet& set) {
  const int i0 = (terrain.columns - set.columns) / 2;
  const int j0 = (terrain.rows - set.rows) / 2;
  const std::size_t full =
      2 * static_cast<std::size_t>(set.columns - 1) * static_cast<std::size_t>(set.rows - 1);
  const std::size_t surplus = full - set.triangles;
  std::vector<Vec3> points, outline;
  for (int j = 0; j < set.rows; ++j) {
    for (int i = 0; i < set.columns; ++i) {
      const bool side_i = i == 0 || i + 1 == set.columns;
      const bool side_j = j == 0 || j + 1 == set.rows;
      (side_i != side_j ? outline : points).push_back(terrain.point(i0 + i, j0 + j));
    }
  }
  for (std::size_t k = 0; k < outline.size(); ++k) {
    // Left out: where the count of points left out so far takes a step.
    if (k * surplus / outline.size() != (k + 1) * surplus / outline.size()) continue;
    points.push_back(outline[k]);
  }
  const Vec3 low = terrain.point(i0, j0);
  const Vec3 high = terrain.point(i0 + set.columns - 1, j0 + set.rows - 1);
  TrimmedTin out{tin::delaunay_tin(points, {}), {}, {(low.x + high.x) / 2, (low.y + high.y) / 2}};
  out.domain.add_rectangle({low.x, low.y}, {high.x, high.y});
  return out;
}

/// The paper's settings for a row of Table 2: Table 1's rings by pixel, f = 512.
inline ring_tin::Settings settings(ring_tin::Variant variant, int levels = 5) {
  ring_tin::Settings s;
  s.variant = variant;
  s.focal_px = 512;
  s.rings.half_size_m.resize(static_cast<std::size_t>(levels));
  s.rings.delta_px.resize(static_cast<std::size_t>(levels));
  return s;
}

inline Camera camera_at(Vec2 p, double height_m = 100) {
  return make_camera({p.x, p.y, height_m}, {p.x, p.y + 100, height_m - 10}, 60, 1280, 720);
}

}  // namespace plumbline::m2
