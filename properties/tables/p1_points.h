// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/ring_tin/ring_tin.h"
#include "scenarios/terrain.h"

/// The point sets of paper 001 (M2), for its table and for whoever tests or times M2 on them.
namespace plumbline::tables {

inline constexpr double kP1SpacingM = 10;  ///< section 4 of the paper
inline constexpr double kP1FocalPx = 512;  ///< what Table 1 is computed with
/// Samples a side of the terrain whose middles the sets take.
inline constexpr int kP1Size = 261;

/// One row of the paper's Table 2.
struct PointSet {
  int columns, rows;      ///< of regular points, before trimming
  std::size_t triangles;  ///< full TIN, as published
  std::size_t remain;     ///< after simplification, as published
  int levels;
};
inline const std::vector<PointSet> kP1Sets{{101, 101, 19705, 9523, 4},
                                           {119, 119, 27848, 12704, 5},
                                           {164, 165, 53161, 26307, 5},
                                           {259, 259, 132849, 60231, 5}};

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

/// The paper's settings for a set: Table 1's rings by pixel, f = 512.
inline ring_tin::Settings p1_settings(ring_tin::Variant variant, int levels = 5) {
  ring_tin::Settings s;
  s.variant = variant;
  s.focal_px = kP1FocalPx;
  s.rings.half_size_m.resize(static_cast<std::size_t>(levels));
  s.rings.delta_px.resize(static_cast<std::size_t>(levels));
  return s;
}

}  // namespace plumbline::tables
