// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scenarios/mesh_file/mesh_file.h"
#include "tests/fuzz/fuzz.h"

/// What holds for every mesh format.
namespace plumbline::fuzz {

inline bool same_bits(Vec3 a, Vec3 b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

inline bool same(const MeshFile& a, const MeshFile& b) {
  return a.corners == b.corners && a.ends == b.ends && a.part_ends == b.part_ends &&
         std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end(),
                    same_bits);
}

/// Polygons follow one another and name vertices that there are; parts likewise.
inline void require_consistent(const MeshFile& mesh) {
  require(std::is_sorted(mesh.ends.begin(), mesh.ends.end()), "polygons end in order");
  require((mesh.ends.empty() ? 0 : mesh.ends.back()) == mesh.corners.size(), "polygons hold all corners");
  require(std::all_of(mesh.corners.begin(), mesh.corners.end(),
                      [&](std::uint32_t v) { return v < mesh.positions.size(); }),
          "every corner names a vertex");
  require(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size(), "a vertex has one normal");
  require(std::is_sorted(mesh.part_ends.begin(), mesh.part_ends.end()), "parts end in order");
  require(mesh.part_ends.empty() || mesh.part_ends.back() == mesh.ends.size(), "parts hold all polygons");
}

inline void require_triangulates(const MeshFile& file) {
  const auto mesh = accepted([&] { return triangulate(file); });
  if (!mesh) return;  // a long concave polygon
  std::size_t triangles = 0, begin = 0;
  for (const std::size_t end : file.ends) {
    if (end - begin >= 3) triangles += end - begin - 2;
    begin = end;
  }
  require(mesh->triangles.size() == triangles, "an n-gon becomes n - 2 triangles");
  const auto named = [](const Mesh& m) {
    return std::all_of(m.triangles.begin(), m.triangles.end(), [&](const auto& t) {
      return std::max({t[0], t[1], t[2]}) < m.positions.size();
    });
  };
  require(named(*mesh), "every triangle names vertices");
  const auto parts = accepted([&] { return triangulate_parts(file); });
  require(parts.has_value(), "what triangulates as one does in parts");
  std::size_t in_parts = 0;
  for (const Mesh& part : *parts) {
    require(named(part), "every part's triangle names vertices");
    in_parts += part.triangles.size();
  }
  require(in_parts == triangles, "parts lose no triangle");
  const Mesh one = welded(*mesh);
  require(named(one) && one.positions.size() <= mesh->positions.size() &&
              one.triangles.size() <= mesh->triangles.size(),
          "welding makes nothing new");
  const Mesh cut = cut_to_manifold(one);
  require(named(cut) && cut.triangles.size() == one.triangles.size(), "cutting moves no triangle");
}

/// Reads `bytes` as a file of that name, twice. `per_byte`: the most vertices, normals, corners and polygons
/// together that a byte of the file may make.
inline void fuzz_mesh(const std::uint8_t* data, std::size_t size, std::string_view name, std::size_t per_byte,
                      std::size_t allowance = 0) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto mesh = accepted([&] { return parse_mesh(bytes, name); });
  const auto again = accepted([&] { return parse_mesh(bytes, name); });
  require(mesh.has_value() == again.has_value(), "a second reading comes to the same verdict");
  if (!mesh) return;
  require(same(*mesh, *again), "a second reading gives the same bits");
  require_consistent(*mesh);
  require(mesh->positions.size() + mesh->normals.size() + mesh->corners.size() + mesh->ends.size() <=
              per_byte * size + allowance,
          "memory is bounded by the file's size");
  require_triangulates(*mesh);
}

}  // namespace plumbline::fuzz
