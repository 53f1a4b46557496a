// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/vertical.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "oracle/predicates.h"
#include "oracle/vertical_overlay.h"
#include "scenarios/error.h"

namespace plumbline::oracle {
namespace {

/// A coordinate in cells. One that is exactly a sample's (Terrain::point) becomes its integer, however the
/// quotient rounds.
double in_cells(double metres, double spacing_m) {
  // Adding and taking away 1.5 · 2⁵² rounds to the nearest integer.
  constexpr double kRounder = 0x1.8p52;
  const double quotient = metres / spacing_m;
  const double nearest = (quotient + kRounder) - kRounder;
  return nearest * spacing_m == metres ? nearest : quotient;
}

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void require_grid(const Terrain& terrain) {
  const bool sized = terrain.columns >= 2 && terrain.rows >= 2 &&
                     terrain.heights_m.size() ==
                         static_cast<std::size_t>(terrain.columns) * static_cast<std::size_t>(terrain.rows);
  if (!sized) {
    throw InputError(
        fmt::format("terrain '{}': {} x {} with {} samples cannot be judged; give at least 2 x 2, one each",
                    terrain.id, terrain.columns, terrain.rows, terrain.heights_m.size()));
  }
  if (!(terrain.spacing_m > 0) || !std::isfinite(terrain.spacing_m)) {
    throw InputError(
        fmt::format("terrain '{}': spacing {} m; give a positive number", terrain.id, terrain.spacing_m));
  }
}

/// One byte a cell: whether all four samples hold data. Empty: they all do.
std::vector<std::uint8_t> cells_with_data(const Terrain& terrain, std::span<const std::uint8_t> has_data) {
  std::vector<std::uint8_t> cells;
  if (has_data.empty()) return cells;
  if (has_data.size() != terrain.heights_m.size()) {
    throw InputError(fmt::format("terrain '{}': {} marks of data for {} samples; give one each", terrain.id,
                                 has_data.size(), terrain.heights_m.size()));
  }
  cells.reserve(static_cast<std::size_t>(terrain.columns - 1) * static_cast<std::size_t>(terrain.rows - 1));
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    const std::uint8_t* const south = has_data.data() + terrain.index(0, j);
    const std::uint8_t* const north = south + terrain.columns;
    for (int i = 0; i + 1 < terrain.columns; ++i) {
      cells.push_back(south[i] != 0 && south[i + 1] != 0 && north[i] != 0 && north[i + 1] != 0 ? 1 : 0);
    }
  }
  return cells;
}

}  // namespace

VerticalError vertical_error(const Mesh& mesh, const Terrain& terrain) {
  return vertical_error_where_data(mesh, terrain, {});
}

VerticalError vertical_error_where_data(const Mesh& mesh, const Terrain& terrain,
                                        std::span<const std::uint8_t> has_data) {
  require_grid(terrain);
  const double spacing_m = terrain.spacing_m;
  const std::vector<std::uint8_t> cells = cells_with_data(terrain, has_data);
  detail::Overlay overlay(terrain, cells.empty() ? nullptr : cells.data());
  // One triangle is held back, so that the next one's samples can be asked for before they are needed.
  std::optional<detail::GridTriangle> held;
  const auto judge = [&](const detail::GridTriangle& next) {
    overlay.expect(next);
    if (held) overlay.judge(*held);
    held = next;
  };
  for (const auto& corners : mesh.triangles) {
    const std::size_t count = mesh.positions.size();
    if (corners[0] >= count || corners[1] >= count || corners[2] >= count) continue;
    const Vec3& a = mesh.positions[corners[0]];
    const Vec3& b = mesh.positions[corners[1]];
    const Vec3& c = mesh.positions[corners[2]];
    if (!finite(a) || !finite(b) || !finite(c)) continue;
    if (orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}).value <= 0) continue;
    const double reach_m = std::max(
        {std::fabs(a.x), std::fabs(a.y), std::fabs(b.x), std::fabs(b.y), std::fabs(c.x), std::fabs(c.y)});
    if (reach_m > detail::kFarCells * spacing_m) {
      for (const auto& part : detail::cut_to_grid({a, b, c}, terrain)) judge(part);
      continue;
    }
    const auto in_grid = [&](const Vec3& p) {
      return detail::GridPoint{in_cells(p.x, spacing_m), in_cells(p.y, spacing_m), p.z};
    };
    judge({in_grid(a), in_grid(b), in_grid(c)});
  }
  if (held) overlay.judge(*held);
  overlay.finish();

  VerticalError result;
  const double area = overlay.sums().area();
  if (!(area > 0)) return result;
  const detail::Peak& peak = overlay.peak();
  const detail::Peak& certain = overlay.certain_peak();
  result.max = peak.value;
  result.at = {peak.x * spacing_m, peak.y * spacing_m};
  result.certain_max = certain.value;
  result.certain_at = {certain.x * spacing_m, certain.y * spacing_m};
  result.rms = std::sqrt(overlay.sums().square_integral() / area);
  result.mean = overlay.sums().absolute_integral() / area;
  result.area_m2 = area * spacing_m * spacing_m;
  const detail::Peak& sample = overlay.sample_peak();
  if (sample.value >= 0) {
    // Evaluated otherwise in thin pieces: within the rounding bound, but a part must not exceed the whole.
    result.samples_max = std::min(sample.value, certain.value);
    result.samples_at = {sample.x * spacing_m, sample.y * spacing_m};
  }
  return result;
}

double diagonal_ambiguity_m(const Terrain& terrain) { return diagonal_ambiguity_m(terrain, {}); }

double diagonal_ambiguity_m(const Terrain& terrain, std::span<const std::uint8_t> has_data) {
  require_grid(terrain);
  const std::vector<std::uint8_t> cells = cells_with_data(terrain, has_data);
  std::size_t cell = 0;
  double widest = 0;
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    const double* const south = terrain.heights_m.data() + terrain.index(0, j);
    const double* const north = terrain.heights_m.data() + terrain.index(0, j + 1);
    for (int i = 0; i + 1 < terrain.columns; ++i, ++cell) {
      if (!cells.empty() && cells[cell] == 0) continue;
      // As differences along the cell's sides: exact where neighbouring heights are close.
      const double twist = (south[i] - south[i + 1]) + (north[i + 1] - north[i]);
      widest = std::max(widest, 0.5 * std::fabs(twist));
    }
  }
  return widest;
}

}  // namespace plumbline::oracle
