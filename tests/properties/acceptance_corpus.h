// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// tests/data/check: for each complaint of users that `plumbline check` is held to, the smallest files that
// have the defect, and a near twin ("…_twin") that does not. tests/data/check/README.md says who complained,
// and what is answered.
#pragma once

#include <utility>
#include <vector>

#include "tests/properties/corpus_parts.h"

namespace plumbline::test {

using Tiles = std::vector<std::pair<TileAddress, QuantizedMesh>>;

/// 1. One broken promise of the format a tile, none of them beside another.
inline void tile_corners_and_edges(Files& files) {
  const TileGrid grid;
  Tiles sound;
  for (std::uint32_t k = 0; k < 7; ++k) {
    const TileAddress address{10, 1060 + 2 * k, 780};
    sound.emplace_back(address, exact_tile(grid, address, 3, 400, [k](int column, int row) {
                         return 400.0 + 8 * column + row * (column + k);
                       }));
  }
  Tiles broken = sound;
  QuantizedMesh& cut = broken[0].second;
  for (std::size_t v = 0; v < cut.vertices(); ++v) {
    if (cut.u[v] == kTileSteps && cut.v[v] == kTileSteps) cut.u[v] = cut.v[v] = kTileSteps - 60;
  }
  list_edges(cut);
  for (std::int32_t& u : broken[1].second.u) u = std::min(u, kTileSteps - 1);
  list_edges(broken[1].second);
  broken[2].second.edges[2].pop_back();
  broken[3].second.sphere_radius_m *= 0.5;
  std::swap(broken[4].second.min_height_m, broken[4].second.max_height_m);
  broken[5].second.triangles.back()[2] = static_cast<std::uint32_t>(broken[5].second.vertices());
  add_tiles(files, "01_tile_corners_and_edges/tiles", broken);
  files.erase("01_tile_corners_and_edges/tiles/" + tile_file(broken[6].first));
  add_tiles(files, "01_tile_corners_and_edges/tiles_twin", sound);
}

/// 2. The eastern mesh has border vertices of its own, two of them a breath apart.
inline void unshared_border_vertices(Files& files) {
  const auto on_plane = [](std::vector<double> ys) {
    Side side;
    for (const double y : ys) side.push_back({y, y});
    return side;
  };
  const Side outer = on_plane({0, 9}), shared = on_plane({0, 3, 6, 9});
  const Side own = on_plane({0, 3, 3.0004, 7, 9});
  files["02_unshared_border_vertices/obj/west.obj"] = obj_bytes(sheet_between(0, outer, 10, shared, 5));
  files["02_unshared_border_vertices/obj/east.obj"] = obj_bytes(sheet_between(10, own, 20, outer, 5));
  files["02_unshared_border_vertices/obj_twin/west.obj"] = files["02_unshared_border_vertices/obj/west.obj"];
  files["02_unshared_border_vertices/obj_twin/east.obj"] = obj_bytes(sheet_between(10, shared, 20, outer, 5));
}

/// 3. Below the sea, the eastern tile was resampled half a cell off: a wall along the joint, the higher the
/// farther north. Resampled half a cell the other way, it stands the other way round.
inline void walls_at_joints(Files& files) {
  const TileGrid grid;
  const auto make = [&](const std::string& name, double shift) {
    const auto ground = [](double column, int row) { return -100 + 4 * column + column * row; };
    const TileAddress west{12, 4266, 3115}, east{12, 4267, 3115};
    add_tiles(
        files, "03_walls_at_joints/" + name,
        {{west, exact_tile(grid, west, 4, -128, [&](int c, int r) { return ground(c, r); })},
         {east, exact_tile(grid, east, 4, -128, [&](int c, int r) { return ground(c + 4 + shift, r); })}});
  };
  make("tiles", 0.5);
  make("tiles_reversed", -0.5);
  make("tiles_twin", 0);
}

/// 4. A ridge along the joint; each tile's normals know its own slope alone.
inline void edge_normals(Files& files) {
  const TileGrid grid;
  const TileAddress west{12, 4266, 3115}, east{12, 4267, 3115};
  Tiles tiles{{west, exact_tile(grid, west, 3, 0, [](int c, int) { return 40.0 * c; })},
              {east, exact_tile(grid, east, 3, 0, [](int c, int) { return 120 - 40.0 * c; })}};
  // Steep enough to see: a cell is a kilometre wide.
  for (auto& [address, tile] : tiles) tile.max_height_m = static_cast<float>(16 * kTileRangeM);
  for (auto& [address, tile] : tiles) set_header(tile, grid, address);
  compute_normals(grid, tiles, false);
  add_tiles(files, "04_edge_normals/tiles", tiles);
  compute_normals(grid, tiles, true);
  add_tiles(files, "04_edge_normals/tiles_twin", tiles);
}

/// 5. Beside a tile lie tiles two levels deeper, whose relief the skirt does not reach over; and two meshes
/// whose own skirts are too short.
inline void gap_exceeds_skirt(Files& files) {
  const TileGrid grid;
  const TileAddress coarse{9, 533, 383};
  const auto beside = [&](const std::string& name, int deeper, double bump, double dip) {
    Tiles tiles{{coarse, exact_tile(grid, coarse, 4, 100, [](int, int) { return 200.0; })}};
    for (std::uint32_t j = 0; j < 1U << deeper; ++j) {
      const TileAddress fine{9 + deeper, 534U << deeper, (383U << deeper) + j};
      tiles.emplace_back(fine, exact_tile(grid, fine, 4, 100, [&](int c, int r) {
                           const bool middle = c == 0 && r == 2;
                           return 200 + (middle && j == 1 ? bump : middle && j == 0 ? -dip : 0);
                         }));
    }
    add_tiles(files, "05_gap_exceeds_skirt/" + name, tiles);
  };
  beside("tiles", 2, 30, 12);
  beside("tiles_twin", 1, 4, 3);
  const auto skirted = [&](const std::string& name, double depth) {
    Mesh west = sheet_between(0, {{0, 10}, {8, 10}}, 10, {{0, 10}, {4, 10}, {8, 10}}, 10);
    Mesh east = sheet_between(10, {{0, 10}, {4, 5}, {8, 10}}, 20, {{0, 10}, {8, 10}}, 10);
    hang_skirt(west, {0, 1, 2}, depth);
    files["05_gap_exceeds_skirt/" + name + "/west.ply"] = ply_bytes<double>(west, PlyEncoding::ascii);
    files["05_gap_exceeds_skirt/" + name + "/east.ply"] = ply_bytes<double>(east, PlyEncoding::ascii);
  };
  skirted("skirts", 2);
  skirted("skirts_twin", 6);
}

/// 6. A step between two meshes, its mending by a wall that shows, and what was wanted.
inline void cliff_or_crack(Files& files) {
  const auto make = [&](const std::string& name, double western_m, double wall_m) {
    Mesh west = sheet_between(0, {{0, 10}, {8, 10}}, 10, {{0, western_m}, {8, western_m}}, 10);
    if (wall_m > 0) hang_skirt(west, {0, 1}, wall_m);
    files["06_cliff_or_crack/" + name + "/west.off"] = off_bytes(west);
    files["06_cliff_or_crack/" + name + "/east.off"] =
        off_bytes(sheet_between(10, {{0, 4}, {8, 4}}, 20, {{0, 4}, {8, 4}}, 4));
  };
  make("crack", 10, 0);
  make("cliff", 10, 6);
  make("twin", 4, 0);
}

/// 7. Neighbours of a right-triangulated network, each simplified by itself.
inline void independent_edges(Files& files) {
  const Side outer{{0, 0}, {8, 0}}, few{{0, 0}, {4, 4}, {8, 0}}, more{{0, 0}, {2, 3}, {4, 4}, {6, 3}, {8, 0}};
  const Mesh east = sheet_between(8, more, 16, outer, 2);
  files["07_independent_edges/ply/west.ply"] =
      ply_bytes<double>(sheet_between(0, outer, 8, few, 2), PlyEncoding::ascii);
  files["07_independent_edges/ply_twin/west.ply"] =
      ply_bytes<double>(sheet_between(0, outer, 8, more, 2), PlyEncoding::ascii);
  for (const char* name : {"ply", "ply_twin"})
    files[fmt::format("07_independent_edges/{}/east.ply", name)] =
        ply_bytes<double>(east, PlyEncoding::ascii);
}

/// Ground that no symmetry of the grid maps onto itself.
inline double lopsided_m(int column, int row) {
  return 300 + 6.0 * column + 11.0 * row + 0.5 * column * column - 0.75 * row * column +
         (column == 6 && row == 2 ? 25 : 0);
}

/// A coarse grid over 9 × 9 samples in which one cell has a vertex in its middle.
inline Mesh refined_at(int cell_column, int cell_row, double step,
                       const std::function<double(int, int)>& height) {
  Mesh mesh = grid(5, 5, 2 * step, [&](int c, int r) { return height(2 * c, 2 * r); });
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  const int column = 2 * cell_column + 1, row = 2 * cell_row + 1;
  mesh.positions.push_back({step * column, step * row, height(column, row)});
  const auto first = static_cast<std::size_t>(2 * (4 * cell_row + cell_column));
  const auto [a, b, c] = mesh.triangles[first];  // south-west, south-east, north-east
  const std::uint32_t d = mesh.triangles[first + 1][2];
  mesh.triangles[first] = {a, b, middle};
  mesh.triangles[first + 1] = {b, c, middle};
  mesh.triangles.push_back({c, d, middle});
  mesh.triangles.push_back({d, a, middle});
  return mesh;
}

/// 8. Heights taken from the transposed matrix; from rows that run the other way; and a mesh that was refined
/// where the transposed errors asked for it.
inline void transposed_matrix(Files& files) {
  const std::string folder = "08_transposed_matrix/";
  files[folder + "dem.asc"] = asc(9, 9, 10, lopsided_m);
  const auto ply = [](const Mesh& mesh) { return ply_bytes<double>(mesh, PlyEncoding::ascii); };
  // A matrix' first row is the northmost.
  files[folder + "transposed/mesh.ply"] =
      ply(grid(9, 9, 10, [](int c, int r) { return lopsided_m(8 - r, 8 - c); }));
  files[folder + "rows_flipped/mesh.ply"] =
      ply(grid(9, 9, 10, [](int c, int r) { return lopsided_m(c, 8 - r); }));
  files[folder + "twin/mesh.ply"] = ply(grid(9, 9, 10, lopsided_m));
  const auto peak = [](int c, int r) { return 100 + 2.0 * c + 3.0 * r + (c == 3 && r == 7 ? 40 : 0); };
  files[folder + "peak.asc"] = asc(9, 9, 10, peak);
  files[folder + "refined_elsewhere/mesh.ply"] = ply(refined_at(3, 1, 10, peak));
  files[folder + "refined_elsewhere_twin/mesh.ply"] = ply(refined_at(1, 3, 10, peak));
}

/// 9. A simplifier moved a vertex across an edge, laid a triangle over others, and left a needle.
inline void flipped_triangles(Files& files) {
  const auto make = [&](const std::string& name, Vec3 moved, double needle) {
    Mesh mesh = grid(4, 4, 10, [](int c, int r) { return 2.0 * c + r; });
    mesh.positions[5] = moved;
    // The cell in the north-east corner, cut from a vertex near its southern side.
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({25, 20 + needle, 7});
    mesh.triangles.erase(mesh.triangles.end() - 2, mesh.triangles.end());
    for (const auto& side :
         {std::array{10U, 11U}, std::array{11U, 15U}, std::array{15U, 14U}, std::array{14U, 10U}})
      mesh.triangles.push_back({side[0], side[1], middle});
    if (needle < 1) mesh.triangles.push_back({2, 3, 6});
    files["09_flipped_triangles/" + name + "/mesh.obj"] = obj_bytes(mesh);
  };
  make("obj", {23, 12, 3}, 0.05);
  make("obj_twin", {10, 10, 3}, 5);
}

/// 10. From a regular grid: triangles on a line, a triangle twice, one that is not the grid's.
inline void degenerate_triangles(Files& files) {
  Mesh mesh = grid(4, 4, 10, [](int c, int r) { return 1.0 * c * r; });
  files["10_degenerate_triangles/off_twin/mesh.off"] = off_bytes(mesh);
  mesh.triangles.push_back({0, 1, 2});  // on the southern side
  mesh.triangles.push_back({5, 5, 6});  // a vertex twice
  mesh.triangles.push_back(mesh.triangles[8]);
  mesh.triangles.push_back({10, 11, 14});  // beside the two of its cell
  files["10_degenerate_triangles/off/mesh.off"] = off_bytes(mesh);
}

/// 11. A bound of 5 m was declared. A sample of the DEM that no vertex took; a vertex between the samples;
/// and of an object, against the object that it stands for.
inline void declared_error(Files& files) {
  const std::string folder = "11_declared_error/";
  const auto dem = [](double bump) {
    return asc(9, 9, 10,
               [=](int c, int r) { return 50 + 1.0 * c + 2.0 * r + (c == 3 && r == 5 ? bump : 0); });
  };
  const Mesh coarse = grid(5, 5, 20, [](int c, int r) { return 50 + 2.0 * c + 4.0 * r; });
  files[folder + "dem.asc"] = dem(7.25);
  files[folder + "dem_twin.asc"] = dem(4.5);
  files[folder + "mesh.ply"] = ply_bytes<double>(coarse, PlyEncoding::ascii);
  Mesh between =
      grid(9, 9, 10, [](int c, int r) { return 50 + 1.0 * c + 2.0 * r + (c == 3 && r == 5 ? 4.5 : 0); });
  const auto middle = static_cast<std::uint32_t>(between.positions.size());
  between.positions.push_back({65, 15, 50 + 6.5 + 3 + 6.5});
  const std::size_t cell = 2 * (8 * 1 + 6);
  const auto [a, b, c] = between.triangles[cell];
  const std::uint32_t d = between.triangles[cell + 1][2];
  between.triangles[cell] = {a, b, middle};
  between.triangles[cell + 1] = {b, c, middle};
  between.triangles.push_back({c, d, middle});
  between.triangles.push_back({d, a, middle});
  files[folder + "between.ply"] = ply_bytes<double>(between, PlyEncoding::ascii);
}

/// A closed box of 8 × 8 × 3 whose lid is a fan around a vertex at that height.
inline Mesh box_with_lid(double middle_z) {
  Mesh mesh;
  for (const double z : {0.0, 3.0})
    for (const Vec2& p : {Vec2{0, 0}, Vec2{8, 0}, Vec2{8, 8}, Vec2{0, 8}})
      mesh.positions.push_back({p.x, p.y, z});
  mesh.positions.push_back({4, 3, middle_z});
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    mesh.triangles.push_back({k, next, next + 4});
    mesh.triangles.push_back({k, next + 4, k + 4});
    mesh.triangles.push_back({k + 4, next + 4, 8});
  }
  return mesh;
}

/// 12. An edge collapse pulled the lid of a box through its bottom. Also 11: of an object.
inline void self_intersections(Files& files) {
  files["12_self_intersections/off/box.off"] = off_bytes(box_with_lid(-1));
  files["12_self_intersections/off_twin/box.off"] = off_bytes(box_with_lid(1));
  files["11_declared_error/box.off"] = off_bytes(box_with_lid(2));
  files["11_declared_error/box_twin.off"] = off_bytes(box_with_lid(2.95));
  files["11_declared_error/box_reference.off"] = off_bytes(box_with_lid(3));
}

/// 19. Four tiles that stand on steps: each border needs another skirt.
inline void least_skirt(Files& files) {
  const TileGrid grid;
  const auto make = [&](const std::string& name, double share) {
    const std::vector<std::pair<TileAddress, double>> steps{
        {{12, 4266, 3114}, 18.25}, {{12, 4266, 3115}, 0}, {{12, 4267, 3114}, 5.75}, {{12, 4267, 3115}, 3}};
    Tiles tiles;
    for (const auto& [address, step] : steps)
      tiles.emplace_back(address, exact_tile(grid, address, 3, 0,
                                             [&, &rise = step](int, int) { return 100 + share * rise; }));
    add_tiles(files, "19_least_skirt/" + name, tiles);
  };
  make("tiles", 1);
  make("tiles_twin", 0);
}

/// 20. The western child lacks the vertex where the eastern one was split. Both corners lie at 16383.5 of the
/// lattice of the tile south of them, whose writer rounded that up. And two tiles of which each has a height
/// range of its own.
inline void split_vertices(Files& files) {
  const TileGrid grid;
  constexpr double kEnd = kTileSteps, kHalf = 16384;
  const TileAddress west{10, 1066, 766}, east{10, 1067, 766}, south{9, 533, 382};
  const auto make = [&](const std::string& name, bool both, bool middle) {
    std::vector<Vec3> western{
        {0, 0, 100}, {kEnd, 0, 100}, {kEnd, kHalf, 100}, {kEnd, kEnd, 100}, {0, kEnd, 100}};
    if (!both) western.erase(western.begin() + 2);
    std::vector<Vec3> southern{
        {0, 0, 100}, {kEnd, 0, 100}, {kEnd, kEnd, 100}, {kHalf, kEnd, 100}, {0, kEnd, 100}};
    if (!middle) southern.erase(southern.begin() + 3);
    add_tiles(
        files, "20_split_vertices/" + name,
        {{south, fan_tile(grid, south, southern)},
         {west, fan_tile(grid, west, western)},
         {east,
          fan_tile(grid, east,
                   {{0, 0, 100}, {kEnd, 0, 100}, {kEnd, kEnd, 100}, {0, kEnd, 100}, {0, kHalf, 100}})}});
  };
  make("tiles", false, true);
  make("tiles_twin", true, false);
  add_tiles(files, "20_split_vertices/rounding",
            {{west, regular_tile(grid, west, 4, hills_m)}, {east, regular_tile(grid, east, 4, hills_m)}});
}

inline Files acceptance_corpus() {
  Files files;
  for (const auto make :
       {tile_corners_and_edges, unshared_border_vertices, walls_at_joints, edge_normals, gap_exceeds_skirt,
        cliff_or_crack, independent_edges, transposed_matrix, flipped_triangles, degenerate_triangles,
        declared_error, self_intersections, least_skirt, split_vertices})
    make(files);
  return files;
}

}  // namespace plumbline::test
