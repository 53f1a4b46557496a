// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// glTF 2.0 (.gltf, .glb): the scene's nodes one after the other, each with its meshes in place.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "scenarios/mesh_file/gltf_document.h"
#include "scenarios/mesh_file/scanner.h"

namespace plumbline::mesh_file {
namespace {

using Json = GltfDocument::Json;

/// Three rows of four: x ↦ A·x + t.
struct Affine {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  [[nodiscard]] Vec3 operator()(Vec3 p) const {
    const auto row = [&](const std::array<double, 4>& r) {
      return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
    };
    return {row(rows[0]), row(rows[1]), row(rows[2])};
  }
  [[nodiscard]] Affine after(const Affine& first) const {
    Affine out;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        double sum = j == 3 ? rows[i][3] : 0;
        for (std::size_t k = 0; k < 3; ++k) sum += rows[i][k] * first.rows[k][j];
        out.rows[i][j] = sum;
      }
    }
    return out;
  }
  [[nodiscard]] Vec3 row(std::size_t i) const { return {rows[i][0], rows[i][1], rows[i][2]}; }
  [[nodiscard]] bool mirrors() const { return dot(row(0), cross(row(1), row(2))) < 0; }
  /// A normal's direction: by the cofactors, which are the inverse's transpose up to a factor; zero if it has
  /// none then.
  [[nodiscard]] Vec3 normal(Vec3 n) const {
    const Vec3 turned{dot(cross(row(1), row(2)), n), dot(cross(row(2), row(0)), n),
                      dot(cross(row(0), row(1)), n)};
    const double size = mirrors() ? -length(turned) : length(turned);
    return size != 0 && std::isfinite(size) ? turned * (1 / size) : Vec3{};
  }
};

class Reader {
 public:
  explicit Reader(GltfDocument& document) : doc_(document) {}

  MeshFile read() {
    if (doc_.count("nodes") == 0) {
      for (std::size_t m = 0; m < doc_.count("meshes"); ++m) mesh(m, {}, "the file");
    } else {
      seen_.assign(doc_.count("nodes"), 0);
      // Last in, first out: pushed backwards, nodes come in the file's order.
      std::vector<std::pair<std::uint64_t, Affine>> open;
      push(roots(), {}, open);
      while (!open.empty()) {
        const auto [index, transform] = open.back();
        open.pop_back();
        node(index, transform, open);
      }
    }
    if (out_.polygons() == 0) doc_.fail("the scene", "shows no triangle");
    if (!all_normals_) out_.normals.clear();
    return std::move(out_);
  }

 private:
  using Numbers = std::vector<std::uint64_t>;
  using Open = std::vector<std::pair<std::uint64_t, Affine>>;

  Numbers list(const Json& object, const char* key, std::string_view place) const {
    Numbers out;
    const Json* values = doc_.find(object, key, place);
    if (values == nullptr) return out;
    const std::string named = fmt::format("{}.{}", place, key);
    if (!values->is_array()) doc_.fail(named, "is no list");
    for (const Json& value : *values) out.push_back(doc_.whole(value, named));
    return out;
  }

  /// The shown scene's nodes; without scenes, those that are nobody's child.
  Numbers roots() const {
    if (doc_.count("scenes") > 0) {
      const std::uint64_t scene = doc_.whole_or(doc_.root(), "scene", 0, "the file");
      return list(doc_.element("scenes", scene, "scene"), "nodes", fmt::format("scenes[{}]", scene));
    }
    std::vector<std::uint8_t> is_child(doc_.count("nodes"), 0);
    for (std::size_t n = 0; n < is_child.size(); ++n) {
      for (const std::uint64_t child :
           list(doc_.element("nodes", n, "the file"), "children", fmt::format("nodes[{}]", n))) {
        if (child < is_child.size()) is_child[static_cast<std::size_t>(child)] = 1;
      }
    }
    Numbers out;
    for (std::size_t n = 0; n < is_child.size(); ++n) {
      if (is_child[n] == 0) out.push_back(n);
    }
    return out;
  }

  static void push(const Numbers& nodes, const Affine& transform, Open& open) {
    for (std::size_t k = nodes.size(); k-- > 0;) open.emplace_back(nodes[k], transform);
  }

  void node(std::uint64_t index, const Affine& parent, Open& open) {
    const std::string place = fmt::format("nodes[{}]", index);
    const Json& entry = doc_.element("nodes", index, "a scene or node");
    if (std::exchange(seen_[static_cast<std::size_t>(index)], 1) != 0)
      doc_.fail(place, "has two parents or is its own ancestor; nodes must form trees");
    const Affine transform = parent.after(local(entry, place));
    if (const Json* named = doc_.find(entry, "mesh", place))
      mesh(doc_.whole(*named, place + ".mesh"), transform, place);
    push(list(entry, "children", place), transform, open);
  }

  template <std::size_t n>
  bool numbers(const Json& object, const char* key, std::string_view place,
               std::array<double, n>& out) const {
    const Json* values = doc_.find(object, key, place);
    if (values == nullptr) return false;
    const std::string named = fmt::format("{}.{}", place, key);
    if (!values->is_array() || values->size() != n)
      doc_.fail(named, fmt::format("is not a list of {} numbers", n));
    for (std::size_t k = 0; k < n; ++k) out[k] = doc_.number((*values)[k], named);
    return true;
  }

  Affine local(const Json& entry, const std::string& place) const {
    Affine out;
    if (std::array<double, 16> m{}; numbers(entry, "matrix", place, m)) {  // column after column
      if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) doc_.fail(place + ".matrix", "is not affine");
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j) out.rows[i][j] = m[4 * j + i];
      }
      return out;
    }
    std::array<double, 3> move{0, 0, 0}, scale{1, 1, 1};
    std::array<double, 4> q{0, 0, 0, 1};  // x, y, z, w: a unit quaternion
    numbers(entry, "translation", place, move);
    numbers(entry, "rotation", place, q);
    numbers(entry, "scale", place, scale);
    const auto [x, y, z, w] = q;
    const std::array<std::array<double, 3>, 3> turn{
        {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
         {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
         {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) out.rows[i][j] = turn[i][j] * scale[j];
      out.rows[i][3] = move[i];
    }
    return out;
  }

  /// The vertices that an accessor of positions has become.
  struct Placed {
    std::size_t first = 0, vertices = 0;
    std::optional<std::uint64_t> normal;
  };

  void mesh(std::uint64_t index, const Affine& transform, std::string_view named_by) {
    const std::string place = fmt::format("meshes[{}]", index);
    const Json* primitives = doc_.find(doc_.element("meshes", index, named_by), "primitives", place);
    if (primitives == nullptr || !primitives->is_array()) doc_.fail(place, "has no list of primitives");
    const std::size_t polygons = out_.polygons();
    std::map<std::uint64_t, Placed> placed;
    for (std::size_t p = 0; p < primitives->size(); ++p)
      primitive((*primitives)[p], transform, fmt::format("{}.primitives[{}]", place, p), placed);
    if (out_.polygons() > polygons) out_.part_ends.push_back(out_.polygons());
  }

  void primitive(const Json& entry, const Affine& transform, const std::string& place,
                 std::map<std::uint64_t, Placed>& placed) {
    constexpr std::uint64_t kTriangles = 4, kStrip = 5, kFan = 6;
    const std::uint64_t mode = doc_.whole_or(entry, "mode", kTriangles, place);
    if (mode > kFan) doc_.fail(place, fmt::format("has unknown mode {}", mode));
    const Json* attributes = doc_.find(entry, "attributes", place);
    if (attributes == nullptr) doc_.fail(place, "has no attributes");
    const Json* position = doc_.find(*attributes, "POSITION", place + ".attributes");
    if (mode < kTriangles || position == nullptr) return;  // points, lines, nothing: no surface
    const std::uint64_t accessor = doc_.whole(*position, place + ".attributes.POSITION");
    auto known = placed.find(accessor);
    const std::optional<std::uint64_t> normal = normal_accessor(*attributes);
    if (known == placed.end()) {
      known = placed.emplace(accessor, positions(accessor, transform, place)).first;
      known->second.normal = normal;
      if (all_normals_) all_normals_ = normal && normals(*normal, known->second.vertices, transform);
    }
    const auto [base, vertices, its_normal] = known->second;
    // Two normals for one vertex.
    if (its_normal != normal) all_normals_ = false;

    const std::size_t made = mode == kTriangles ? 1 : 3;  // corners from one of a strip or fan
    std::vector<std::uint32_t> corners;
    if (const Json* indices = doc_.find(entry, "indices", place)) {
      const auto a = doc_.accessor(doc_.whole(*indices, place + ".indices"), place + ".indices");
      if (a.components != 1 || a.normalized ||
          (a.component != 5121 && a.component != 5123 && a.component != 5125))
        doc_.fail(a.place, "cannot hold indices: these are unsigned scalars");
      spend(made * a.count);
      corners.reserve(a.count);
      for (std::size_t k = 0; k < a.count; ++k) {
        const double index = a.value(k, 0);
        if (!(index < static_cast<double>(vertices)))
          doc_.fail(a.place, fmt::format("element {} names vertex {}, of {}", k, index, vertices));
        corners.push_back(static_cast<std::uint32_t>(base + static_cast<std::size_t>(index)));
      }
    } else {
      spend(made * vertices);
      for (std::size_t k = 0; k < vertices; ++k) corners.push_back(static_cast<std::uint32_t>(base + k));
    }
    if (mode == kTriangles && corners.size() % 3 != 0)
      doc_.fail(place, fmt::format("has {} corners: no whole number of triangles", corners.size()));
    const bool mirrors = transform.mirrors();  // specification 3.7.4: then the corners run the other way
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (mode != kTriangles && (a == b || b == c || c == a)) return;  // the seams of strips
      if (mirrors) std::swap(b, c);
      out_.corners.insert(out_.corners.end(), {a, b, c});
      out_.ends.push_back(out_.corners.size());
    };
    const std::size_t step = mode == kTriangles ? 3 : 1;
    make_room(out_.ends, corners.size() / step);
    make_room(out_.corners, corners.size() / step * 3);
    for (std::size_t k = 0; k + 2 < corners.size(); k += step) {
      if (mode == kFan) {
        add(corners[k + 1], corners[k + 2], corners[0]);
      } else if (mode == kStrip && k % 2 == 1) {
        add(corners[k], corners[k + 2], corners[k + 1]);
      } else {
        add(corners[k], corners[k + 1], corners[k + 2]);
      }
    }
  }

  Placed positions(std::uint64_t accessor, const Affine& transform, const std::string& place) {
    const auto a = doc_.accessor(accessor, place + ".attributes.POSITION");
    if (a.components != 3 || a.component == 5125)
      doc_.fail(a.place,
                "cannot hold positions: these are VEC3 of floats, or of small integers if quantized");
    spend(a.count);
    const std::size_t base = out_.positions.size();
    make_room(out_.positions, a.count);
    for (std::size_t k = 0; k < a.count; ++k) {
      const Vec3 p = transform({a.value(k, 0), a.value(k, 1), a.value(k, 2)});
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        doc_.fail(a.place, fmt::format("element {} is a position that is not finite", k));
      out_.positions.push_back(p);
    }
    return {base, a.count, {}};
  }

  static std::optional<std::uint64_t> normal_accessor(const Json& attributes) {
    const auto found = attributes.find("NORMAL");
    if (found == attributes.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::uint64_t>();
  }

  /// Appends the normals of the vertices placed last. False, and no line, for what cannot be read: the
  /// surface does not depend on it.
  bool normals(std::uint64_t accessor, std::size_t vertices, const Affine& transform) {
    try {
      const auto a = doc_.accessor(accessor, "NORMAL");
      if (a.components != 3 || a.count != vertices) return false;
      spend(a.count);
      make_room(out_.normals, a.count);
      for (std::size_t k = 0; k < a.count; ++k)
        out_.normals.push_back(transform.normal({a.value(k, 0), a.value(k, 1), a.value(k, 2)}));
      return true;
    } catch (const InputError&) {
      return false;
    }
  }

  /// Room for so many more, without giving up growth by doubling.
  template <class T>
  static void make_room(std::vector<T>& values, std::size_t more) {
    if (values.size() + more > values.capacity())
      values.reserve(std::max(values.size() + more, 2 * values.capacity()));
  }

  /// A mesh may be shown by many nodes, data by many meshes: that must not make little of a file into any
  /// amount of memory.
  void spend(std::size_t elements) {
    // Vertices and corners per byte read: less than a kilobyte of memory. An instrument's screws take < 1.
    constexpr std::size_t kMostReuse = 16;
    spent_ += elements;
    if (spent_ / kMostReuse > doc_.bytes_read())
      doc_.fail("the scene",
                fmt::format("shows its data too often: more than {} vertices and corners per byte "
                            "of the file; split it",
                            kMostReuse));
    if (spent_ > 0xffffffff) doc_.fail("the scene", "has more than 2^32 vertices and corners; split it");
  }

  GltfDocument& doc_;
  MeshFile out_;
  std::vector<std::uint8_t> seen_;
  std::size_t spent_ = 0;
  bool all_normals_ = true;  // so far
};

}  // namespace

MeshFile parse_gltf(std::string_view bytes, std::string_view name,
                    const std::optional<std::filesystem::path>& folder) {
  GltfDocument document(bytes, name, folder);
  return Reader(document).read();
}

}  // namespace plumbline::mesh_file
