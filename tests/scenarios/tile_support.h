// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Terrain tiles as a good tiler would make them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <zlib.h>

#include "scenarios/tiles/ecef.h"
#include "scenarios/tiles/quantized_mesh.h"
#include "scenarios/tiles/tile_grid.h"
#include "scenarios/vec.h"

namespace plumbline::test {

/// Metres above the ellipsoid at longitude and latitude, degrees.
using HeightFunction = std::function<double(double longitude_deg, double latitude_deg)>;

/// Lists the vertices on each side, ascending.
inline void list_edges(QuantizedMesh& tile) {
  for (auto& edge : tile.edges) edge.clear();
  for (std::uint32_t i = 0; i < tile.vertices(); ++i) {
    if (tile.u[i] == 0) tile.edges[0].push_back(i);
    if (tile.v[i] == 0) tile.edges[1].push_back(i);
    if (tile.u[i] == kTileSteps) tile.edges[2].push_back(i);
    if (tile.v[i] == kTileSteps) tile.edges[3].push_back(i);
  }
}

/// Center, ball and horizon occlusion point from the vertices: the middle of their box; the farthest of them;
/// and the point on the line to the middle from where the ellipsoid hides the last of them (Cozzi and Ring,
/// "3D Engine Design for Virtual Globes", in the space where the ellipsoid is the unit sphere).
inline void set_header(QuantizedMesh& tile, const TileGrid& grid, const TileAddress& address) {
  const TileEcef earth(grid.bounds_deg(address));
  std::vector<Vec3> places;
  Vec3 low, high;
  for (std::size_t i = 0; i < tile.vertices(); ++i) {
    const Vec2 p = grid.position_deg(address, tile.u[i], tile.v[i]);
    places.push_back(earth.at(p.x, p.y, tile.height_m(i)));
    if (i == 0) low = high = places[0];
    low = {std::min(low.x, places[i].x), std::min(low.y, places[i].y), std::min(low.z, places[i].z)};
    high = {std::max(high.x, places[i].x), std::max(high.y, places[i].y), std::max(high.z, places[i].z)};
  }
  tile.sphere_center = tile.center = (low + high) * 0.5;
  tile.sphere_radius_m = 0;
  const double polar_m = kWgs84SemiMajorM * (1 - 1 / kWgs84InverseFlattening);
  const auto scaled = [&](Vec3 p) {
    return Vec3{p.x / kWgs84SemiMajorM, p.y / kWgs84SemiMajorM, p.z / polar_m};
  };
  const Vec3 direction = normalized(scaled(tile.center));
  double farthest = 0;
  for (const Vec3& place : places) {
    tile.sphere_radius_m = std::max(tile.sphere_radius_m, length(place - tile.sphere_center));
    const Vec3 p = scaled(place);
    const double size = std::max(1.0, length(p)), cosine = dot(normalized(p), direction);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), beyond = std::sqrt(size * size - 1);
    farthest = std::max(farthest, size / (cosine - sine * beyond));
  }
  tile.horizon_occlusion = direction * farthest;
}

/// n × n cells, two triangles each, all cut from south-west to north-east; vertices in high-water order. With
/// `normals`, those of the ellipsoid.
inline QuantizedMesh regular_tile(const TileGrid& grid, const TileAddress& address, int n,
                                  const HeightFunction& height_m, bool normals = false) {
  QuantizedMesh tile;
  std::vector<double> heights;
  const TileEcef earth(grid.bounds_deg(address));
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column <= n; ++column) {
      tile.u.push_back((2 * column * kTileSteps + n) / (2 * n));
      tile.v.push_back((2 * row * kTileSteps + n) / (2 * n));
      const Vec2 p = grid.position_deg(address, tile.u.back(), tile.v.back());
      heights.push_back(height_m(p.x, p.y));
      if (normals) tile.normals.push_back(earth.up(p.x, p.y));
    }
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  tile.min_height_m = static_cast<float>(*low);
  tile.max_height_m = static_cast<float>(*high);
  const double step = tile.height_step_m(), bottom = static_cast<double>(tile.min_height_m);
  for (const double h : heights) {
    const double steps = step > 0 ? std::floor((h - bottom) / step + 0.5) : 0;
    tile.height.push_back(static_cast<std::int32_t>(std::clamp(steps, 0.0, kTileSteps * 1.0)));
  }
  const auto id = [&](int column, int row) { return static_cast<std::uint32_t>(row * (n + 1) + column); };
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      tile.triangles.push_back({id(column, row), id(column + 1, row), id(column + 1, row + 1)});
      tile.triangles.push_back({id(column, row), id(column + 1, row + 1), id(column, row + 1)});
    }
  }
  tile = in_high_water_order(tile);
  list_edges(tile);
  set_header(tile, grid, address);
  return tile;
}

/// Hills of some hundred metres on a slope, which no lattice hides. Polynomials: the same bits everywhere.
inline double hills_m(double longitude_deg, double latitude_deg) {
  const auto wave = [](double x) {
    const double t = x - std::floor(x);
    return 4 * t * (1 - t);
  };
  return 200 * wave(longitude_deg * 7.3) + 120 * wave(latitude_deg * 11.9) +
         60 * wave((longitude_deg + latitude_deg) * 31.7) + longitude_deg + 2 * latitude_deg;
}

/// As servers and tilers leave tiles on a disk.
inline std::string gzipped(std::string_view bytes) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()) + 32, '\0');
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace plumbline::test
