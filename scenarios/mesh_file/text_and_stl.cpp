// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OBJ, OFF and STL.
#include <algorithm>
#include <charconv>

#include "scenarios/little_endian.h"
#include "scenarios/mesh_file/scanner.h"
#include "scenarios/point_table.h"

namespace plumbline::mesh_file {
namespace {

/// The normal of every vertex, if the polygons give each of theirs exactly one.
class VertexNormals {
 public:
  void add(Vec3 normal) { normals_.push_back(normal); }
  /// A corner's normal as the file numbers it; 0: it has none.
  void corner(std::uint32_t vertex, std::int64_t number) {
    if (!agree_) return;
    const auto count = static_cast<std::int64_t>(normals_.size());
    const std::int64_t index = number < 0 ? count + number : number - 1;
    agree_ = number != 0 && index >= 0 && index < count;
    if (!agree_) return;
    if (vertex >= of_vertex_.size())
      of_vertex_.resize(std::max<std::size_t>(vertex + 1, 2 * of_vertex_.size()), kNone);
    auto& known = of_vertex_[vertex];
    if (known == kNone) {
      known = index;
    } else if (known != index) {
      agree_ = normals_[static_cast<std::size_t>(known)] == normals_[static_cast<std::size_t>(index)];
    }
  }
  /// Zero for vertices that no polygon uses.
  [[nodiscard]] std::vector<Vec3> take(std::size_t vertices) const {
    if (!agree_ || of_vertex_.empty()) return {};
    std::vector<Vec3> out(vertices);
    for (std::size_t v = 0; v < std::min(vertices, of_vertex_.size()); ++v) {
      if (of_vertex_[v] != kNone) out[v] = normals_[static_cast<std::size_t>(of_vertex_[v])];
    }
    return out;
  }

 private:
  static constexpr std::int64_t kNone = -1;
  std::vector<Vec3> normals_;
  std::vector<std::int64_t> of_vertex_;
  bool agree_ = true;
};

/// What stands behind the second slash of a corner, 0 if nothing that is a number.
std::int64_t normal_number(std::string_view corner) {
  const auto first = corner.find('/'),
             second = first == std::string_view::npos ? first : corner.find('/', first + 1);
  if (second == std::string_view::npos) return 0;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(corner.data() + second + 1, corner.data() + corner.size(), value);
  return error == std::errc{} && end == corner.data() + corner.size() ? value : 0;
}

Vec3 point(Scanner& in) {
  Vec3 p;
  p.x = in.number(in.word_on_line());
  p.y = in.number(in.word_on_line());
  p.z = in.number(in.word_on_line());
  return p;
}

}  // namespace

MeshFile parse_obj(std::string_view bytes, std::string_view name) {
  Scanner in(bytes, name, '#');
  MeshFile mesh;
  VertexNormals normals;
  for (auto key = in.word(); !key.empty(); key = in.word()) {
    if (key == "v") {
      mesh.positions.push_back(point(in));
    } else if (key == "vn") {
      normals.add(point(in));
    } else if (key == "f") {
      // Corner: vertex[/texture][/normal], from 1; negative ones count back from the last vertex so far.
      for (auto w = in.word_on_line(); !w.empty(); w = in.word_on_line()) {
        const auto number = in.integer(w.substr(0, w.find('/')));
        const auto count = static_cast<std::int64_t>(mesh.positions.size());
        mesh.corners.push_back(in.index(number < 0 ? count + number : number - 1, mesh.positions.size()));
        normals.corner(mesh.corners.back(), normal_number(w));
      }
      mesh.ends.push_back(mesh.corners.size());
    }
    in.skip_line();
  }
  mesh.normals = normals.take(mesh.positions.size());
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
  PointTable weld;
  for (auto key = in.word(); !key.empty(); key = in.word()) {
    if (key == "vertex") {
      mesh.corners.push_back(weld.number(point(in)));
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
  mesh.positions = weld.take();
  return mesh;
}

MeshFile parse_stl_binary(std::string_view bytes, std::string_view name) {
  // 80 bytes of title, the number of facets, 50 bytes a facet: normal, three corners (float), two bytes more.
  const std::uint64_t facets = value_at<std::uint32_t>(bytes, 80);
  if (84 + 50 * facets != bytes.size())
    throw InputError(
        fmt::format("{}: a binary STL of {} facets has {} bytes, this file has {}; it was cut short or is "
                    "another format",
                    one_line(name), facets, 84 + 50 * facets, bytes.size()));
  MeshFile mesh;
  mesh.corners.reserve(3 * facets);
  mesh.ends.reserve(facets);
  PointTable weld(facets / 2);  // a closed mesh has half as many vertices
  for (std::uint64_t f = 0; f < facets; ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t offset = 84 + 50 * f + 12 + 12 * c;
      mesh.corners.push_back(weld.number({value_at<float>(bytes, offset), value_at<float>(bytes, offset + 4),
                                          value_at<float>(bytes, offset + 8)}));
    }
    mesh.ends.push_back(mesh.corners.size());
  }
  mesh.positions = weld.take();
  return mesh;
}

}  // namespace plumbline::mesh_file
