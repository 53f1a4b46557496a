// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Folders of tests/data/findings: for each finding that `plumbline check` alone makes, the smallest files
// that have it and no other, and a near twin ("…_twin") without any.
#pragma once

#include <vector>

#include "tests/properties/corpus_parts.h"

namespace plumbline::test {

inline Files finding_corpus() {
  Files files;
  const TileGrid geographic;
  const auto ply = [](const Mesh& mesh, const std::vector<Vec3>& normals = {}) {
    return ply_bytes<double>(mesh, PlyEncoding::ascii, normals);
  };
  for (const bool twin : {false, true}) {
    const auto put = [&](const std::string& folder, const std::string& name, const std::string& bytes) {
      files[folder + (twin ? "_twin/" : "/") + name] = bytes;
    };
    const std::string end = twin ? "_twin" : "";

    // The eastern edge list lacks a vertex.
    const TileAddress address{10, 1066, 766};
    QuantizedMesh tile =
        exact_tile(geographic, address, 3, 0, [](int c, int r) { return 50.0 + 16 * c + 8 * r; });
    if (!twin) tile.edges[2].pop_back();
    add_tiles(files, "103_tile_encoding" + end, {{address, tile}});

    put("206_sliver", "mesh.off",
        off_bytes(fan({{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}}, {3, twin ? 2.5 : 0.1, 0})));

    // A box whose lid hangs through its bottom.
    Mesh box = grid(2, 2, 6, [](int, int) { return 0.0; });
    box.triangles = {{0, 3, 1}, {0, 2, 3}};
    for (const Vec3& p :
         {Vec3{0, 0, 3}, Vec3{6, 0, 3}, Vec3{0, 6, 3}, Vec3{6, 6, 3}, Vec3{3, 2, twin ? 1.0 : -1.0}})
      box.positions.push_back(p);
    constexpr std::array<std::uint32_t, 4> kRound{0, 1, 3, 2};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t a = kRound[k], b = kRound[(k + 1) % 4];
      box.triangles.push_back({a, b, b + 4});
      box.triangles.push_back({a, b + 4, a + 4});
      box.triangles.push_back({a + 4, b + 4, 8});
    }
    put("207_self_intersection", "box.off", off_bytes(box));

    const Side flat{{0, 0}, {3, 0}, {6, 0}};
    const Mesh west = sheet_between(0, flat, 3, flat, 0);
    put("306_slit", "west.off", off_bytes(west));
    put("306_slit", "east.off", off_bytes(sheet_between(twin ? 3 : 3.125, flat, 6, flat, 0)));

    // A ridge whose two sides have normals of their own, or one in common.
    const Side ridge{{0, 1}, {6, 1}};
    const Mesh up = sheet_between(0, {{0, 0}, {6, 0}}, 3, ridge, 0.5);
    const Mesh down = sheet_between(3, ridge, 6, {{0, 0}, {6, 0}}, 0.5);
    const auto leaning = [&](const Mesh& mesh, double lean) {
      std::vector<Vec3> normals;
      for (const Vec3& p : mesh.positions)
        normals.push_back(p.x == 3 && twin ? Vec3{0, 0, 1} : Vec3{lean, 0, 1});
      return normals;
    };
    put("307_border_normal", "west.ply", ply(up, leaning(up, -0.25)));
    put("307_border_normal", "east.ply", ply(down, leaning(down, 0.25)));

    const auto ground = [](int c, int r) { return 1 + 0.25 * c + 0.5 * r + 0.125 * c * c - 0.0625 * c * r; };
    put("308_misplaced", "dem.asc", asc(7, 7, 1, ground));
    put("308_misplaced", "mesh.ply",
        ply(grid(7, 7, 1, [&](int c, int r) { return ground(c, twin ? r : 6 - r); })));

    put("309_declared_error", "dem.asc",
        asc(7, 7, 1, [&](int c, int r) { return c == 3 && r == 3 ? (twin ? 0.5 : 2) : 0; }));
    put("309_declared_error", "mesh.off", off_bytes(grid(4, 4, 2, [](int, int) { return 0.0; })));
    put("309_declared_error", "declared_m.txt", "1\n");

    // Beside one tile lie tiles two levels deeper; or one.
    std::vector<std::pair<TileAddress, QuantizedMesh>> levels;
    const auto flat_tile = [&](const TileAddress& at) {
      constexpr double kEnd = kTileSteps;
      levels.emplace_back(
          at, fan_tile(geographic, at, {{0, 0, 10}, {kEnd, 0, 10}, {kEnd, kEnd, 10}, {0, kEnd, 10}}));
    };
    const std::uint32_t deeper = twin ? 1 : 2;
    flat_tile({9, 533, 383});
    for (std::uint32_t j = 0; j < 1U << deeper; ++j)
      flat_tile({9 + static_cast<int>(deeper), 534U << deeper, (383U << deeper) + j});
    add_tiles(files, "402_level_gap" + end, levels);

    Mesh hung = sheet_between(0, flat, 6, flat, 1);
    hang_skirt(hung, {0, 1, 2}, 1.5);
    put("503_skirt_visible", "mesh.off", off_bytes(hung));
    put("503_skirt_visible", "camera.txt", twin ? "-8,3,4:3,3,0:60:160x120\n" : "14,3,1:3,3,0:60:160x120\n");
  }
  return files;
}

}  // namespace plumbline::test
