// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/ring_tin/vertex_levels.h"

#include <algorithm>
#include <cmath>

#include "algorithms/mutant.h"

namespace plumbline::ring_tin {
namespace {

constexpr double kVerticesACell = 64;

/// Least and greatest Chebyshev distance from p to the points of a box. Rounding is monotone, so no vertex of
/// the box lies outside these bounds, as Rings::level computes its distance.
struct Span {
  double nearest, farthest;
};
Span distances(Vec2 p, Vec2 low, Vec2 high) {
  const double beside_x = std::max({low.x - p.x, p.x - high.x, 0.0});
  const double beside_y = std::max({low.y - p.y, p.y - high.y, 0.0});
  const double far_x = std::max(std::abs(low.x - p.x), std::abs(high.x - p.x));
  const double far_y = std::max(std::abs(low.y - p.y), std::abs(high.y - p.y));
  return {std::max(beside_x, beside_y), std::max(far_x, far_y)};
}

}  // namespace

PlanCells::PlanCells(const std::vector<Vec3>& positions) {
  if (positions.empty()) return;
  Vec2 low{positions[0].x, positions[0].y};
  Vec2 high = low;
  for (const Vec3& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double wanted = std::max(1.0, static_cast<double>(positions.size()) / kVerticesACell);
  const double width = high.x - low.x;
  const double depth = high.y - low.y;
  // As many columns as rows: cells keep the terrain's proportions.
  const auto side = static_cast<std::uint32_t>(std::clamp(std::sqrt(wanted), 1.0, 4096.0));
  const auto slot = [&](double offset, double extent) {
    const double share = extent > 0 ? offset / extent * side : 0;
    return std::min(static_cast<std::uint32_t>(std::clamp(share, 0.0, static_cast<double>(side))), side - 1);
  };
  std::vector<std::uint32_t> cell_of(positions.size());
  std::vector<std::uint32_t> first(static_cast<std::size_t>(side) * side + 1, 0);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    cell_of[v] = slot(positions[v].y - low.y, depth) * side + slot(positions[v].x - low.x, width);
    ++first[cell_of[v] + 1];
  }
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  vertices.resize(positions.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    vertices[next[cell_of[v]]++] = static_cast<std::uint32_t>(v);
  }
  for (std::size_t c = 0; c + 1 < first.size(); ++c) {
    if (first[c] == first[c + 1]) continue;
    const Vec3& corner = positions[vertices[first[c]]];
    Cell cell{first[c], first[c + 1], {corner.x, corner.y}, {corner.x, corner.y}};
    for (std::uint32_t k = cell.first; k < cell.end; ++k) {
      const Vec3& p = positions[vertices[k]];
      cell.low = {std::min(cell.low.x, p.x), std::min(cell.low.y, p.y)};
      cell.high = {std::max(cell.high.x, p.x), std::max(cell.high.y, p.y)};
    }
    cells.push_back(cell);
  }
}

VertexLevels::VertexLevels(const PlanCells& cells, const std::vector<Vec3>& positions)
    : cells_(cells), positions_(positions), level_(positions.size(), 0), uniform_(cells.cells.size(), 0) {}

std::uint64_t VertexLevels::move(Vec2 viewpoint, const Rings& rings, std::vector<std::uint32_t>& changed) {
  changed.clear();
  std::uint64_t visited = 0;
  for (std::size_t c = 0; c < cells_.cells.size(); ++c) {
    const PlanCells::Cell& cell = cells_.cells[c];
    const Span span = distances(viewpoint, cell.low, cell.high);
    const int level = rings.level_at(span.nearest);
    const auto uniform = level == rings.level_at(span.farthest) ? static_cast<std::int16_t>(level) : kMixed;
    if ((uniform != kMixed || PLUMBLINE_MUTANT(m2_mixed_cells_stale)) && uniform == uniform_[c]) continue;
    uniform_[c] = uniform;
    for (std::uint32_t k = cell.first; k < cell.end; ++k) {
      const std::uint32_t v = cells_.vertices[k];
      const auto now = static_cast<std::uint8_t>(rings.level(viewpoint, {positions_[v].x, positions_[v].y}));
      ++visited;
      if (now == level_[v]) continue;
      level_[v] = now;
      changed.push_back(v);
    }
  }
  // Nothing may depend on the cells.
  std::sort(changed.begin(), changed.end());
  return visited;
}

}  // namespace plumbline::ring_tin
