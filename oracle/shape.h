// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "scenarios/mesh.h"

namespace plumbline::oracle {

/// Below this quality in plan a triangle is a sliver (ORACLES O6); quality is 1 for an equilateral triangle.
inline constexpr double kSliverQuality = 0.05;

/// O6's figures. Quality is 4·√3·area / Σl², in plan.
struct ShapeReport {
  double min_quality = 0;       ///< 0 if there is no triangle
  double mean_quality = 0;
  double least_angle_deg = 0;
  std::size_t slivers = 0;
  std::size_t max_valence = 0;
  double mean_valence = 0;
  double mean_fan_length = 0;   ///< triangles per fan when fans are taken greedily in mesh order
};

ShapeReport shape(const Mesh& mesh);

}  // namespace plumbline::oracle
