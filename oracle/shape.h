// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "scenarios/mesh.h"

namespace plumbline::oracle {

/// Below this quality in plan a triangle is a sliver (ORACLES O6); quality is 1 for an equilateral triangle.
inline constexpr double kSliverQuality = 0.05;

/// O6's figures. Quality is 4·√3·area / Σl², in plan, of the area without its sign (O1 reports fold-overs); 0
/// for a triangle without area.
struct ShapeReport {
  double min_quality = 0;  ///< 0 if there is no triangle
  double mean_quality = 0;
  double least_angle_deg = 0;  ///< in plan, over all corners; 0 if there is no triangle
  std::size_t slivers = 0;
  std::size_t max_valence =
      0;                    ///< valence: triangles that meet at a vertex (an inner vertex has as many edges)
  double mean_valence = 0;  ///< over the vertices that a triangle uses
  std::uint32_t worst_triangle = 0;  ///< of the least quality, the first among equals
  double mean_fan_length = 0;  ///< triangles per fan when fans are taken greedily in mesh order: triangles in
                               ///< a row belong to one fan as long as one vertex is common to all of them
};

/// O6, in one pass: time linear in triangles, memory four bytes a vertex. Triangles with a bad index or a
/// non-finite corner are skipped. Figures are rounded to double: each triangle's quality and angle err by a
/// few 2⁻⁵³ of (coordinates / shortest edge); sums are taken in mesh order. The least angle is found by
/// comparing tangents, which take no more than a division, and only that one is turned into degrees
/// (exact_atan2): the same bits on every machine.
ShapeReport shape(const Mesh& mesh);

/// Lengths of edges; rounded. Each edge counts once for every triangle that has it.
struct EdgeLengths {
  double shortest = 0;  ///< 0 if there is no edge of two different points
  double median = 0;    ///< nearest rank from below
  std::array<std::uint32_t, 2> shortest_vertices{};
};
/// Of edges whose ends differ in plan, in plan; `in_space`: that differ, in space. Triangles with a bad
/// index, and edges with a coordinate (in plan: x or y) that is not finite, are skipped. Of equally short
/// ones the first in order of triangle.
EdgeLengths edge_lengths(const Mesh& mesh, bool in_space);

}  // namespace plumbline::oracle
