// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OBJ, OFF and STL.
#include <array>
#include <bit>
#include <cstring>
#include <map>

#include "scenarios/mesh_file/scanner.h"

namespace plumbline::mesh_file {
namespace {

/// Corners given by coordinates: equal ones are one vertex (−0 and 0 are equal).
class Weld {
 public:
  explicit Weld(MeshFile& mesh) : mesh_(mesh) {}
  void corner(Vec3 p) {
    const auto key = [](double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); };
    const auto [slot, is_new] =
        seen_.try_emplace({key(p.x), key(p.y), key(p.z)}, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(p);
    mesh_.corners.push_back(slot->second);
  }

 private:
  MeshFile& mesh_;
  std::map<std::array<std::uint64_t, 3>, std::uint32_t> seen_;
};

}  // namespace

MeshFile parse_obj(std::string_view bytes, std::string_view name) {
  Scanner in(bytes, name, '#');
  MeshFile mesh;
  for (auto key = in.word(); !key.empty(); key = in.word()) {
    if (key == "v") {
      Vec3 p;
      p.x = in.number(in.word_on_line());
      p.y = in.number(in.word_on_line());
      p.z = in.number(in.word_on_line());
      mesh.positions.push_back(p);
    } else if (key == "f") {
      // Corner: vertex[/texture][/normal], from 1; negative ones count back from the last vertex so far.
      for (auto w = in.word_on_line(); !w.empty(); w = in.word_on_line()) {
        const auto number = in.integer(w.substr(0, w.find('/')));
        const auto count = static_cast<std::int64_t>(mesh.positions.size());
        mesh.corners.push_back(in.index(number < 0 ? count + number : number - 1, mesh.positions.size()));
      }
      mesh.ends.push_back(mesh.corners.size());
    }
    in.skip_line();
  }
  return mesh;
}

MeshFile parse_off(std::string_view bytes, std::string_view name) {
  Scanner in(bytes, name, '#');
  const auto mark = in.word();
  if (mark != "OFF")
    in.fail(fmt::format("'{}' is not OFF; variants with colours, normals or other dimensions are not read",
                        mark));
  const auto vertices = in.integer(in.word()), polygons = in.integer(in.word());
  in.integer(in.word());  // edges: written by everybody, used by nobody
  if (vertices < 0 || polygons < 0) in.fail("a count is negative");
  MeshFile mesh;
  for (std::int64_t k = 0; k < vertices; ++k) {
    Vec3 p;
    p.x = in.number(in.word());
    p.y = in.number(in.word());
    p.z = in.number(in.word());
    mesh.positions.push_back(p);
  }
  for (std::int64_t k = 0; k < polygons; ++k) {
    const auto corners = in.integer(in.word());
    if (corners < 0) in.fail("a polygon has a negative number of corners");
    for (std::int64_t c = 0; c < corners; ++c)
      mesh.corners.push_back(in.index(in.integer(in.word_on_line()), mesh.positions.size()));
    mesh.ends.push_back(mesh.corners.size());
    in.skip_line();  // a polygon's colour
  }
  return mesh;
}

MeshFile parse_stl_text(std::string_view bytes, std::string_view name) {
  Scanner in(bytes, name);
  in.skip_line();  // "solid" and its name
  MeshFile mesh;
  Weld weld(mesh);
  for (auto key = in.word(); !key.empty(); key = in.word()) {
    if (key == "vertex") {
      Vec3 p;
      p.x = in.number(in.word_on_line());
      p.y = in.number(in.word_on_line());
      p.z = in.number(in.word_on_line());
      weld.corner(p);
    } else if (key == "endfacet") {
      const std::size_t begin = mesh.ends.empty() ? 0 : mesh.ends.back();
      if (mesh.corners.size() - begin != 3)
        in.fail(fmt::format("a facet has {} vertices instead of 3", mesh.corners.size() - begin));
      mesh.ends.push_back(mesh.corners.size());
    } else if (key != "facet" && key != "outer" && key != "endloop" && key != "endsolid" && key != "solid") {
      in.fail(fmt::format("'{}' is no word of STL", key));
    }
    if (key != "vertex" && key != "endloop" && key != "endfacet") in.skip_line();  // a normal, a name
  }
  if (mesh.corners.size() != (mesh.ends.empty() ? 0 : mesh.ends.back())) in.fail("the last facet has no end");
  return mesh;
}

MeshFile parse_stl_binary(std::string_view bytes, std::string_view name) {
  // 80 bytes of title, the number of facets, 50 bytes a facet: normal, three corners (float), two bytes more.
  const auto at = [&]<class T>(std::size_t offset, T value) {
    std::array<char, sizeof(T)> copy{};
    for (std::size_t k = 0; k < sizeof(T); ++k)
      copy[std::endian::native == std::endian::big ? sizeof(T) - 1 - k : k] = bytes[offset + k];
    std::memcpy(&value, copy.data(), sizeof(T));
    return value;
  };
  const std::uint64_t facets = at(80, std::uint32_t{});
  if (84 + 50 * facets != bytes.size())
    throw InputError(
        fmt::format("{}: a binary STL of {} facets has {} bytes, this file has {}; it was cut short or is "
                    "another format",
                    one_line(name), facets, 84 + 50 * facets, bytes.size()));
  MeshFile mesh;
  Weld weld(mesh);
  for (std::uint64_t f = 0; f < facets; ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t offset = 84 + 50 * f + 12 + 12 * c;
      weld.corner({at(offset, float{}), at(offset + 4, float{}), at(offset + 8, float{})});
    }
    mesh.ends.push_back(mesh.corners.size());
  }
  return mesh;
}

}  // namespace plumbline::mesh_file
