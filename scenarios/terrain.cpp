// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/terrain.h"

#include <algorithm>
#include <cmath>

namespace plumbline {

double Terrain::surface_height_m(double x, double y) const {
  const double u = std::clamp(x / spacing_m, 0.0, static_cast<double>(columns - 1));
  const double v = std::clamp(y / spacing_m, 0.0, static_cast<double>(rows - 1));
  const int i = std::min(static_cast<int>(u), columns - 2);
  const int j = std::min(static_cast<int>(v), rows - 2);
  const double s = u - i;
  const double t = v - j;
  const double z00 = z(i, j);
  const double z11 = z(i + 1, j + 1);
  if (s >= t) {  // south-east triangle
    const double z10 = z(i + 1, j);
    return z00 + s * (z10 - z00) + t * (z11 - z10);
  }
  const double z01 = z(i, j + 1);
  return z00 + t * (z01 - z00) + s * (z11 - z01);
}

double Terrain::lowest_m() const { return *std::min_element(heights_m.begin(), heights_m.end()); }
double Terrain::highest_m() const { return *std::max_element(heights_m.begin(), heights_m.end()); }

Mesh reference_mesh(const Terrain& terrain) {
  Mesh mesh;
  mesh.positions.reserve(terrain.heights_m.size());
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) mesh.positions.push_back(terrain.point(i, j));
  }
  mesh.triangles.reserve(2 * static_cast<std::size_t>(terrain.columns - 1) *
                         static_cast<std::size_t>(terrain.rows - 1));
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    for (int i = 0; i + 1 < terrain.columns; ++i) {
      const auto a = static_cast<std::uint32_t>(terrain.index(i, j));
      const auto b = a + 1;
      const auto d = static_cast<std::uint32_t>(terrain.index(i, j + 1));
      const auto c = d + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

Terrain cropped(const Terrain& terrain, int columns, int rows) {
  Terrain out{terrain.id, columns, rows, terrain.spacing_m, {}, {}, {}};
  out.heights_m.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) out.heights_m.push_back(terrain.z(i, j));
  }
  return out;
}

PlanDomain full_domain(const Terrain& terrain) {
  PlanDomain domain;
  domain.add_rectangle({0, 0}, {terrain.width_m(), terrain.depth_m()});
  return domain;
}

}  // namespace plumbline
