// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/ring_tin/prepared_tin.h"

#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/random.h"

namespace plumbline::ring_tin {

PreparedTin::PreparedTin(tin::Tin network, PlanDomain covered)
    : tin(std::move(network)),
      adjacency(tin),
      prices(price_all(tin, adjacency)),
      cells(tin.mesh.positions),
      domain(std::move(covered)) {}

PreparedTin::PreparedTin(tin::Tin network, PlanDomain covered, Prices known)
    : tin(std::move(network)),
      adjacency(tin),
      prices(std::move(known)),
      cells(tin.mesh.positions),
      domain(std::move(covered)) {}

tin::Tin terrain_tin(const Terrain& terrain, const PointChoice& points) {
  const bool surveyed = !terrain.points.empty();
  if (!surveyed && points.share >= 1 && terrain.roads.empty()) return tin::grid_tin(terrain);
  const auto drawn = [&](int i, int j) {
    return static_cast<double>(lattice_hash(points.seed, i, j) >> 11) * 0x1p-53 < points.share;
  };
  std::vector<Vec3> kept;
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const bool side = i == 0 || i + 1 == terrain.columns;
      const bool end = j == 0 || j + 1 == terrain.rows;
      const bool candidate = !surveyed || side || end;
      if (candidate && ((side && end) || drawn(i, j))) kept.push_back(terrain.point(i, j));
    }
  }
  for (std::size_t k = 0; k < terrain.points.size(); ++k) {
    // A row of its own beside the samples', so that no sample shares a point's draw.
    if (drawn(static_cast<int>(k), -1)) kept.push_back(terrain.points[k]);
  }
  std::vector<std::vector<Vec3>> roads;
  for (std::size_t r = 0; r < terrain.roads.size(); ++r) {
    roads.emplace_back();
    for (const Vec2 p : terrain.roads[r]) {
      if (!(p.x >= 0 && p.x <= terrain.width_m() && p.y >= 0 && p.y <= terrain.depth_m())) {
        throw InputError(
            fmt::format("road {} of terrain '{}': corner ({}, {}) lies off the terrain, which is {} x {} m",
                        r + 1, terrain.id, p.x, p.y, terrain.width_m(), terrain.depth_m()));
      }
      roads.back().push_back({p.x, p.y, terrain.surface_height_m(p.x, p.y)});
    }
  }
  return tin::delaunay_tin(kept, roads);
}

std::uint64_t fingerprint(const Terrain& terrain, const PointChoice& points) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, eight bytes at a time
  const auto take = [&](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3; };
  const auto take_number = [&](double x) { take(std::bit_cast<std::uint64_t>(x)); };
  take(static_cast<std::uint64_t>(terrain.columns));
  take(static_cast<std::uint64_t>(terrain.rows));
  take_number(terrain.spacing_m);
  for (const double z : terrain.heights_m) take_number(z);
  for (const Vec3 p : terrain.points) {
    take_number(p.x);
    take_number(p.y);
    take_number(p.z);
  }
  for (const auto& road : terrain.roads) {
    take(road.size());
    for (const Vec2 p : road) {
      take_number(p.x);
      take_number(p.y);
    }
  }
  take_number(points.share);
  take(points.share < 1 ? points.seed : 0);
  return hash;
}

}  // namespace plumbline::ring_tin
