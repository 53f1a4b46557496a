// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/mesh_file/mesh_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "scenarios/mesh_file/scanner.h"
#include "scenarios/whole_file.h"

namespace plumbline {
namespace {

double turn(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The polygon in plan along the greatest axis of its normal (Newell's sum), counter-clockwise.
std::vector<Vec2> flattened(const std::vector<Vec3>& p) {
  Vec3 normal;
  for (std::size_t k = 0; k < p.size(); ++k)
    normal = normal + cross(p[k] - p[0], p[(k + 1) % p.size()] - p[0]);
  std::vector<Vec2> flat;
  const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
  for (const Vec3& q : p) {
    if (z >= x && z >= y) {
      flat.push_back(normal.z >= 0 ? Vec2{q.x, q.y} : Vec2{q.y, q.x});
    } else if (x >= y) {
      flat.push_back(normal.x >= 0 ? Vec2{q.y, q.z} : Vec2{q.z, q.y});
    } else {
      flat.push_back(normal.y >= 0 ? Vec2{q.z, q.x} : Vec2{q.x, q.z});
    }
  }
  return flat;
}

/// Always the first ear that there is. A triangle of neighbours is searched once for a corner inside, and
/// from there on when that one is gone: quadratic in corners, however the polygon winds.
void clip_ears(const std::vector<Vec2>& flat, std::vector<std::array<std::size_t, 3>>& out) {
  std::vector<std::size_t> left(flat.size());
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
  constexpr std::size_t kNever = static_cast<std::size_t>(-1);
  std::vector<std::uint8_t> gone(flat.size(), 0);
  std::vector<std::size_t> inside(flat.size(),
                                  0);  // by tip: no corner before this one is; kNever: no left turn
  const auto is_ear = [&](std::size_t k) {
    const std::size_t j = left[k];
    std::size_t& m = inside[j];
    if (m == kNever || (m > 0 && gone[m] == 0)) return false;  // as found before: most of all questions
    const std::size_t n = left.size(), i = left[k == 0 ? n - 1 : k - 1], l = left[k + 1 == n ? 0 : k + 1];
    const Vec2 a = flat[i], b = flat[j], c = flat[l];
    if (m == 0 && !(turn(a, b, c) > 0)) {
      m = kNever;
      return false;
    }
    // Most corners lie outside of the triangle's box.
    const double west = std::min({a.x, b.x, c.x}), east = std::max({a.x, b.x, c.x});
    const double south = std::min({a.y, b.y, c.y}), north = std::max({a.y, b.y, c.y});
    for (; m < flat.size(); ++m) {
      const Vec2 p = flat[m];
      if (p.x < west || p.x > east || p.y < south || p.y > north) continue;
      if (gone[m] == 0 && m != i && m != j && m != l && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
          turn(c, a, p) >= 0)
        return false;
    }
    return true;
  };
  while (left.size() > 3) {
    std::size_t k = 0;
    while (k < left.size() && !is_ear(k)) ++k;
    if (k == left.size()) k = 1;  // it crosses itself or is flat: any corner goes, and the search ends
    const std::size_t n = left.size(), before = left[(k + n - 1) % n], after = left[(k + 1) % n];
    out.push_back({before, left[k], after});
    gone[left[k]] = 1;
    inside[before] = inside[after] = 0;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
  }
  out.push_back({left[0], left[1], left[2]});
}

// Ears cost the square of the polygon; this many are still quick.
constexpr std::size_t kLongestConcave = 4096;

}  // namespace

namespace {

MeshFile parse(std::string_view bytes, std::string_view name,
               const std::optional<std::filesystem::path>& folder) {
  using namespace mesh_file;
  const auto ends_in = [&](std::string_view lower) {
    return name.size() >= lower.size() &&
           std::equal(
               lower.begin(), lower.end(), name.end() - static_cast<std::ptrdiff_t>(lower.size()),
               [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b + 32) : b); });
  };
  const auto of = [](const char* format, MeshFile mesh) {
    mesh.format = format;
    return mesh;
  };
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty", one_line(name)));
  if (bytes.starts_with("glTF") || ends_in(".glb") || ends_in(".gltf"))
    return of("glTF", parse_gltf(bytes, name, folder));
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return of("PLY", parse_ply(bytes, name));
  if (ends_in(".obj")) return of("OBJ", parse_obj(bytes, name));
  if (ends_in(".off") || bytes.starts_with("OFF")) return of("OFF", parse_off(bytes, name));
  if (ends_in(".stl") || bytes.starts_with("solid")) {
    // Some binary files begin with "solid" too; their size gives them away.
    const bool text =
        bytes.starts_with("solid") && bytes.substr(0, 1024).find("facet") != std::string_view::npos;
    if (text || (bytes.starts_with("solid") && bytes.find("endsolid") != std::string_view::npos))
      return of("STL", parse_stl_text(bytes, name));
    if (bytes.size() >= 84) return of("STL", parse_stl_binary(bytes, name));
  }
  throw InputError(fmt::format(
      "{}: no mesh format that is read here; PLY, OBJ, OFF, STL, glTF and .terrain are", one_line(name)));
}

}  // namespace

MeshFile parse_mesh(std::string_view bytes, std::string_view name) { return parse(bytes, name, {}); }

MeshFile read_mesh_file(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, "a mesh");
  return parse(bytes, path.string(), path.parent_path());
}

Mesh triangulate(const MeshFile& file) {
  Mesh mesh;
  mesh.positions = file.positions;
  std::vector<Vec3> points;
  std::vector<std::array<std::size_t, 3>> pieces;
  std::size_t begin = 0;
  for (const std::size_t end : file.ends) {
    const std::size_t n = end - begin;
    const std::uint32_t* corner = file.corners.data() + begin;
    begin = end;
    if (n < 3) continue;
    pieces.clear();
    points.clear();
    for (std::size_t k = 0; k < n; ++k) points.push_back(file.positions[corner[k]]);
    bool convex = n == 3;
    if (!convex) {
      const auto flat = flattened(points);
      convex = true;
      for (std::size_t k = 0; k < n; ++k)
        convex = convex && turn(flat[k], flat[(k + 1) % n], flat[(k + 2) % n]) > 0;
      if (!convex) {
        if (n > kLongestConcave)
          throw InputError(
              fmt::format("a polygon that is not convex has {} corners, more than {}; triangulate it", n,
                          kLongestConcave));
        clip_ears(flat, pieces);
      }
    }
    if (convex) {
      for (std::size_t k = 1; k + 1 < n; ++k) pieces.push_back({0, k, k + 1});
    }
    for (const auto& [a, b, c] : pieces) mesh.triangles.push_back({corner[a], corner[b], corner[c]});
  }
  return mesh;
}

std::vector<Mesh> triangulate_parts(const MeshFile& file) {
  if (file.part_ends.empty()) return {triangulate(file)};
  std::vector<Mesh> out;
  constexpr std::uint32_t kNew = 0xffffffff;
  std::vector<std::uint32_t> index(file.positions.size(), kNew);
  std::size_t polygon = 0;
  for (const std::size_t part_end : file.part_ends) {
    MeshFile part;
    std::vector<std::uint32_t> used;
    for (; polygon < part_end; ++polygon) {
      for (std::size_t k = polygon == 0 ? 0 : file.ends[polygon - 1]; k < file.ends[polygon]; ++k) {
        std::uint32_t& here = index[file.corners[k]];
        if (here == kNew) {
          here = static_cast<std::uint32_t>(part.positions.size());
          part.positions.push_back(file.positions[file.corners[k]]);
          used.push_back(file.corners[k]);
        }
        part.corners.push_back(here);
      }
      part.ends.push_back(part.corners.size());
    }
    for (const std::uint32_t v : used) index[v] = kNew;
    out.push_back(triangulate(part));
  }
  return out;
}

}  // namespace plumbline
