// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "algorithms/ring_tin/ring_tin.h"
#include "properties/tables/p1_points.h"
#include "scenarios/camera.h"
#include "scenarios/generators.h"

/// What the tests and benchmarks of M2 share: the paper's point sets (TABLES P1) on stand-in terrain, and the
/// figures they are judged by.
namespace plumbline::m2 {

/// Gentle relief: one generated terrain for all four sets, of which each takes the middle.
inline Terrain relief(double relief_m, int size = 261) {
  TerrainSource source;
  source.id = "p1";
  source.generator = "fbm";
  source.seed = 5;
  source.size = size;
  source.spacing_m = tables::kP1SpacingM;
  source.relief_m = relief_m;
  return generate_terrain(source);
}

using tables::p1_settings;
using tables::PointSet;
using tables::trimmed_tin;
using tables::TrimmedTin;
inline const std::vector<PointSet>& kTable2 = tables::kP1Sets;
inline constexpr double kSpacingM = tables::kP1SpacingM;

inline ring_tin::Settings settings(ring_tin::Variant variant, int levels = 5) {
  return p1_settings(variant, levels);
}

inline Camera camera_at(Vec2 p, double height_m = 100) {
  return make_camera({p.x, p.y, height_m}, {p.x, p.y + 100, height_m - 10}, 60, 1280, 720);
}

}  // namespace plumbline::m2
