// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the corpora of tests/data are made of: meshes whose borders are given vertex by vertex, tiles whose
// heights are given to the lattice step, small DEMs. Integer steps and polynomials: the same bytes
// everywhere.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scenarios/mesh.h"
#include "scenarios/tiles/ecef.h"
#include "scenarios/tiles/quantized_mesh.h"
#include "tests/scenarios/mesh_writers.h"
#include "tests/scenarios/tile_support.h"

namespace plumbline::test {

/// Paths below the corpus' folder, and the bytes there.
using Files = std::map<std::string, std::string>;

/// A convex outline, counter-clockwise from above, and one vertex inside that every triangle shares: each
/// border is exactly what is given.
inline Mesh fan(std::vector<Vec3> outline, Vec3 middle) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  mesh.positions = std::move(outline);
  mesh.positions.push_back(middle);
  for (std::uint32_t k = 0; k < n; ++k) mesh.triangles.push_back({k, (k + 1) % n, n});
  return mesh;
}

/// The heights of a side, southmost first: (y, z).
using Side = std::vector<Vec2>;

/// The rectangle from `west` to `east` whose western and eastern sides have the vertices given, which begin
/// and end at the same y.
inline Mesh sheet_between(double west, const Side& western, double east, const Side& eastern,
                          double middle_z) {
  std::vector<Vec3> outline;
  for (const Vec2& p : eastern) outline.push_back({east, p.x, p.y});
  for (auto p = western.rbegin(); p != western.rend(); ++p) outline.push_back({west, p->x, p->y});
  const double y = 0.5 * (western.front().x + western.back().x);
  return fan(std::move(outline), {0.5 * (west + east), y, middle_z});
}

/// columns × rows samples, `step` apart, split from south-west to north-east.
inline Mesh grid(int columns, int rows, double step, const std::function<double(int column, int row)>& height,
                 Vec2 corner = {}) {
  Mesh mesh;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      mesh.positions.push_back({corner.x + step * column, corner.y + step * row, height(column, row)});
  const auto id = [&](int column, int row) { return static_cast<std::uint32_t>(row * columns + column); };
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      mesh.triangles.push_back({id(column, row), id(column + 1, row), id(column + 1, row + 1)});
      mesh.triangles.push_back({id(column, row), id(column + 1, row + 1), id(column, row + 1)});
    }
  return mesh;
}

/// Hangs a wall of `depth` below the mesh's edges between consecutive vertices of `path` (surface to the
/// left).
inline void hang_skirt(Mesh& mesh, const std::vector<std::uint32_t>& path, double depth) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const std::uint32_t v : path) mesh.positions.push_back(mesh.positions[v] - Vec3{0, 0, depth});
  for (std::uint32_t k = 0; k + 1 < path.size(); ++k) {
    mesh.triangles.push_back({path[k + 1], path[k], first + k});
    mesh.triangles.push_back({path[k + 1], first + k, first + k + 1});
  }
}

/// ESRI ASCII grid: rows from the south here, from the north in the file; samples `step` apart, the
/// south-west one at the origin.
inline std::string asc(int columns, int rows, double step,
                       const std::function<double(int column, int row)>& height) {
  std::string out = fmt::format(
      "ncols {}\nnrows {}\nxllcenter 0\nyllcenter 0\ncellsize {}\nNODATA_value -9999\n", columns, rows, step);
  for (int row = rows - 1; row >= 0; --row) {
    for (int column = 0; column < columns; ++column)
      out += fmt::format("{}{}", height(column, row), column + 1 < columns ? ' ' : '\n');
  }
  return out;
}

/// A height of 1/128 m for each lattice step: heights that are multiples of it are kept exactly.
inline constexpr double kTileRangeM = kTileSteps / 128.0;

/// A tile of n × n cells over [low_m, low_m + kTileRangeM]; heights by column and row of its lattice of
/// vertices, multiples of 1/128 m. Two inner vertices take the range's ends, so that tiles side by side share
/// it: then the border heights that two tiles were given are equal if and only if the files say so. Requires:
/// n ≥ 3.
inline QuantizedMesh exact_tile(const TileGrid& grid, const TileAddress& address, int n, double low_m,
                                const std::function<double(int column, int row)>& height_m) {
  QuantizedMesh tile = regular_tile(grid, address, n, [](double, double) { return 0.0; });
  // regular_tile numbers vertices in the order of their use: columns and rows by place.
  tile.min_height_m = static_cast<float>(low_m);
  tile.max_height_m = static_cast<float>(low_m + kTileRangeM);
  const auto index = [n](std::int32_t steps) { return (2 * steps * n + kTileSteps) / (2 * kTileSteps); };
  for (std::size_t k = 0; k < tile.vertices(); ++k) {
    const int column = index(tile.u[k]), row = index(tile.v[k]);
    const bool lowest = column == 1 && row == 1, highest = column == n - 1 && row == n - 1;
    tile.height[k] = lowest    ? 0
                     : highest ? kTileSteps
                               : static_cast<std::int32_t>((height_m(column, row) - low_m) * 128);
  }
  set_header(tile, grid, address);
  return tile;
}

/// A tile of one fan: (u, v, height) of its outline, counter-clockwise, and the height of its middle. The
/// outline's least height is the range's low end, the middle its high end.
inline QuantizedMesh fan_tile(const TileGrid& grid, const TileAddress& address,
                              const std::vector<Vec3>& outline) {
  double low_m = outline.front().z;
  for (const Vec3& p : outline) low_m = std::min(low_m, p.z);
  QuantizedMesh tile;
  tile.min_height_m = static_cast<float>(low_m);
  tile.max_height_m = static_cast<float>(low_m + kTileRangeM);
  const Mesh mesh = fan(outline, {11000, 13000, low_m + kTileRangeM});
  for (const Vec3& p : mesh.positions) {
    tile.u.push_back(static_cast<std::int32_t>(p.x));
    tile.v.push_back(static_cast<std::int32_t>(p.y));
    tile.height.push_back(static_cast<std::int32_t>((p.z - low_m) * 128));
  }
  tile.triangles = mesh.triangles;
  tile = in_high_water_order(tile);
  list_edges(tile);
  set_header(tile, grid, address);
  return tile;
}

/// The tile's file in a set: "9/533/383.terrain".
inline std::string tile_file(const TileAddress& address) { return tile_name(address) + ".terrain"; }

/// A layer.json that advertises these tiles, and no others.
inline std::string layer_json(const std::vector<TileAddress>& tiles) {
  std::map<int, std::string> levels;
  int deepest = 0;
  for (const TileAddress& t : tiles) {
    std::string& ranges = levels[t.level];
    ranges += fmt::format(R"({}{{"startX":{},"startY":{},"endX":{},"endY":{}}})", ranges.empty() ? "" : ",",
                          t.x, t.y, t.x, t.y);
    deepest = std::max(deepest, t.level);
  }
  std::string available;
  for (int level = 0; level <= deepest; ++level)
    available += fmt::format("{}[{}]", level == 0 ? "" : ",", levels[level]);
  return fmt::format(
      "{{\"tilejson\":\"2.1.0\",\"format\":\"quantized-mesh-1.0\",\"version\":\"1.0.0\",\"scheme\":\"tms\","
      "\"projection\":\"EPSG:4326\",\"bounds\":[-180,-90,180,90],\n\"tiles\":[\"{{z}}/{{x}}/{{y}}.terrain\"],"
      "\"minzoom\":0,\"maxzoom\":{},\n\"available\":[{}]}}\n",
      deepest, available);
}

/// Adds a folder of tiles with its layer.json.
inline void add_tiles(Files& files, const std::string& folder,
                      const std::vector<std::pair<TileAddress, QuantizedMesh>>& tiles) {
  std::vector<TileAddress> addresses;
  for (const auto& [address, tile] : tiles) {
    files[folder + "/" + tile_file(address)] = encode_quantized_mesh(tile);
    addresses.push_back(address);
  }
  files[folder + "/layer.json"] = layer_json(addresses);
}

/// Normals from the triangles around each vertex, weighted by area, Earth-centred; `joined`: triangles of the
/// other tiles at the same place of the ground count, too.
inline void compute_normals(const TileGrid& grid, std::vector<std::pair<TileAddress, QuantizedMesh>>& tiles,
                            bool joined) {
  std::map<std::array<double, 3>, Vec3> sums;
  const auto key = [&](std::size_t tile, const TileAddress& address, const QuantizedMesh& mesh,
                       std::uint32_t v) {
    const Vec2 deg = grid.position_deg(address, mesh.u[v], mesh.v[v]);
    return std::array{joined ? 0.0 : static_cast<double>(tile), deg.x, deg.y};
  };
  for (const bool taking : {false, true}) {
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      auto& [address, mesh] = tiles[k];
      const TileEcef earth(grid.bounds_deg(address));
      const auto place = [&, &a = address, &m = mesh](std::uint32_t v) {
        const Vec2 deg = grid.position_deg(a, m.u[v], m.v[v]);
        return earth.at(deg.x, deg.y, m.height_m(v));
      };
      if (taking) {
        mesh.normals.clear();
        for (std::uint32_t v = 0; v < mesh.vertices(); ++v)
          mesh.normals.push_back(normalized(sums[key(k, address, mesh, v)]));
        continue;
      }
      for (const auto& t : mesh.triangles) {
        const Vec3 a = place(t[0]);
        const Vec3 n = cross(place(t[1]) - a, place(t[2]) - a);
        for (const std::uint32_t v : t) {
          Vec3& sum = sums[key(k, address, mesh, v)];
          sum = sum + n;
        }
      }
    }
  }
}

}  // namespace plumbline::test
