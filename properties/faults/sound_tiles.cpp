// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/faults/sound_tiles.h"

#include <algorithm>
#include <vector>

#include "scenarios/tiles/ecef.h"

namespace plumbline::faults {
namespace {

/// 0, kTileSteps, and one to five places between, ascending.
std::vector<std::int32_t> stops(Random& random) {
  std::vector<std::int32_t> out{0, kTileSteps};
  for (std::uint64_t n = 1 + random.below(5); n > 0; --n)
    out.push_back(2 + static_cast<std::int32_t>(random.below(kTileSteps - 3)));
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// The middle of the vertices' box, and the ball about it.
void set_header(SoundTile& sound, const std::vector<Vec3>& places) {
  QuantizedMesh& tile = sound.tile;
  Vec3 low = places[0], high = places[0];
  for (const Vec3& p : places) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  tile.center = tile.sphere_center = (low + high) * 0.5;
  for (std::uint32_t k = 0; k < places.size(); ++k) {
    const double reach_m = length(places[k] - tile.sphere_center);
    if (reach_m <= tile.sphere_radius_m) continue;
    tile.sphere_radius_m = reach_m;
    sound.farthest = k;
  }
}

}  // namespace

void list_edges(QuantizedMesh& tile) {
  for (auto& edge : tile.edges) edge.clear();
  for (std::uint32_t k = 0; k < tile.vertices(); ++k) {
    if (tile.u[k] == 0) tile.edges[0].push_back(k);
    if (tile.v[k] == 0) tile.edges[1].push_back(k);
    if (tile.u[k] == kTileSteps) tile.edges[2].push_back(k);
    if (tile.v[k] == kTileSteps) tile.edges[3].push_back(k);
  }
}

SoundTile random_tile(Random& random) {
  SoundTile out;
  const TileGrid grid;
  TileAddress address;
  address.level = 5 + static_cast<int>(random.below(10));
  address.x = static_cast<std::uint32_t>(random.below(grid.columns(address.level)));
  address.y = static_cast<std::uint32_t>(random.below(TileGrid::rows(address.level)));
  out.bounds = grid.bounds_deg(address);
  const TileEcef earth(out.bounds);
  const std::vector<std::int32_t> u = stops(random), v = stops(random);
  out.columns = static_cast<int>(u.size());
  out.rows = static_cast<int>(v.size());
  QuantizedMesh& tile = out.tile;
  tile.min_height_m = static_cast<float>(random.below(800)) * 0.25F;
  tile.max_height_m = tile.min_height_m + 100 + static_cast<float>(random.below(4000)) * 0.125F;
  for (const std::int32_t row : v) {
    for (const std::int32_t column : u) {
      tile.u.push_back(column);
      tile.v.push_back(row);
      tile.height.push_back(static_cast<std::int32_t>(random.below(kTileSteps + 1)));
    }
  }
  // The range is used up to its ends, at corners that no fault takes away.
  tile.height.front() = 0;
  tile.height.back() = kTileSteps;
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < tile.vertices(); ++k) {
    const Vec2 p = grid.position_deg(address, tile.u[k], tile.v[k]);
    places.push_back(earth.at(p.x, p.y, tile.height_m(k)));
    tile.normals.push_back(earth.up(p.x, p.y));
  }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(j * out.columns + i); };
  for (int j = 0; j + 1 < out.rows; ++j) {
    for (int i = 0; i + 1 < out.columns; ++i) {
      tile.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      tile.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  list_edges(tile);
  set_header(out, places);
  return out;
}

}  // namespace plumbline::faults
