// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenarios/mesh.h"
#include "scenarios/vec.h"

namespace plumbline {

/// A height grid: `columns` × `rows` samples, square spacing. Sample (i, j) stands at (i·spacing, j·spacing)
/// metres east and north of the south-west sample, which is the origin of the local frame. Every sample is
/// finite: holes were settled by the loader's policy (see terrain_source.h).
///
/// The reference surface is piecewise linear: each cell is split by the diagonal from its (i, j) to its (i+1,
/// j+1) corner (METHODS, notation).
struct Terrain {
  std::string id;
  int columns = 0;
  int rows = 0;
  double spacing_m = 1;
  std::vector<double> heights_m;  ///< row-major, row j = 0 southmost: heights_m[j * columns + i]
  /// The surveyed points inside the rectangle, if it was read from such, in the file's order; metres. Only
  /// methods on TINs look at them: the samples were interpolated between them.
  std::vector<Vec3> points{};
  /// Road polylines: corners in plan, metres; on the ground. Only methods on TINs look at them.
  std::vector<std::vector<Vec2>> roads{};

  /// Where sample (i, j) stands in heights_m; its height, and its place, metres.
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
  }
  [[nodiscard]] double z(int i, int j) const { return heights_m[index(i, j)]; }
  [[nodiscard]] Vec3 point(int i, int j) const { return {i * spacing_m, j * spacing_m, z(i, j)}; }
  [[nodiscard]] double width_m() const { return (columns - 1) * spacing_m; }
  [[nodiscard]] double depth_m() const { return (rows - 1) * spacing_m; }

  /// Height of the reference surface at (x, y), metres. Points outside the grid take the nearest border
  /// point's height.
  [[nodiscard]] double surface_height_m(double x, double y) const;
  /// Least and greatest sample, metres.
  [[nodiscard]] double lowest_m() const;
  [[nodiscard]] double highest_m() const;
};

/// The reference surface as an indexed mesh: vertex (i, j) has index j·columns + i; two counter-clockwise
/// triangles a cell, south-east one first, cells in row-major order.
Mesh reference_mesh(const Terrain& terrain);

/// The south-west `columns` × `rows` samples, without points and roads. Requires: 2 ≤ columns, rows ≤ the
/// terrain's.
Terrain cropped(const Terrain& terrain, int columns, int rows);

/// The rectangle of all samples.
PlanDomain full_domain(const Terrain& terrain);

}  // namespace plumbline
