// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PLY: a header names elements and the types of their properties; values follow as text or bytes.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "scenarios/little_endian.h"
#include "scenarios/mesh_file/scanner.h"

namespace plumbline::mesh_file {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Coding { text, little, big };

std::optional<Type> type_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Type>, 16> kTypes{{
      {"char", Type::i8},
      {"int8", Type::i8},
      {"uchar", Type::u8},
      {"uint8", Type::u8},
      {"short", Type::i16},
      {"int16", Type::i16},
      {"ushort", Type::u16},
      {"uint16", Type::u16},
      {"int", Type::i32},
      {"int32", Type::i32},
      {"uint", Type::u32},
      {"uint32", Type::u32},
      {"float", Type::f32},
      {"float32", Type::f32},
      {"double", Type::f64},
      {"float64", Type::f64},
  }};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  return std::nullopt;
}

// What a property is to a mesh: coordinates and normals by their place, the list of a polygon's corners.
enum Role : std::size_t { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kCorners, kNothing };

struct Property {
  std::string name;
  Type type = Type::f32;
  std::optional<Type> list;  // the type of its length
  Role role = kNothing;
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

/// Values one after the other, whatever the coding.
template <Coding coding>
class Values {
 public:
  explicit Values(const Scanner& scanner) : scanner_(scanner), bytes_(scanner.rest()) {}

  double next(Type type) {
    if constexpr (coding == Coding::text) return scanner_.number(scanner_.word());
    switch (type) {
      case Type::i8:
        return raw<std::int8_t>();
      case Type::u8:
        return raw<std::uint8_t>();
      case Type::i16:
        return raw<std::int16_t>();
      case Type::u16:
        return raw<std::uint16_t>();
      case Type::i32:
        return raw<std::int32_t>();
      case Type::u32:
        return raw<std::uint32_t>();
      case Type::f32:
        return raw<float>();
      case Type::f64:
        return raw<double>();
    }
    return 0;
  }
  std::int64_t whole(Type type) {
    const double value = next(type);
    if (!(value >= -9e15 && value <= 9e15)) scanner_.fail("a length or index is not a whole number");
    const auto integer = static_cast<std::int64_t>(value);
    if (static_cast<double>(integer) != value) scanner_.fail(fmt::format("{} is not a whole number", value));
    return integer;
  }
  [[nodiscard]] const Scanner& scanner() const { return scanner_; }
  [[nodiscard]] std::size_t left() const {
    return coding == Coding::text ? scanner_.rest().size() : bytes_.size();
  }

 private:
  template <class T>
  double raw() {
    if (bytes_.size() < sizeof(T))
      scanner_.fail("the file ends inside its data; it was cut short, or a count is wrong");
    const T value = value_at<T>(bytes_, 0, coding == Coding::big);
    bytes_.remove_prefix(sizeof(T));
    return static_cast<double>(value);
  }

  Scanner scanner_;
  std::string_view bytes_;
};

struct Header {
  Coding coding = Coding::text;
  std::vector<Element> elements;
};

Header read_header(Scanner& in) {
  Header header;
  bool has_format = false;
  in.skip_line();  // "ply"
  for (;;) {
    const auto key = in.word();
    if (key.empty()) in.fail("the header has no end_header");
    if (key == "end_header") break;
    if (key == "format") {
      const auto coding = in.word_on_line();
      if (coding != "ascii" && coding != "binary_little_endian" && coding != "binary_big_endian")
        in.fail(fmt::format("format '{}' is not ascii, binary_little_endian or binary_big_endian", coding));
      header.coding = coding == "ascii"               ? Coding::text
                      : coding == "binary_big_endian" ? Coding::big
                                                      : Coding::little;
      has_format = true;
    } else if (key == "element") {
      Element element;
      element.name = in.word_on_line();
      const auto count = in.integer(in.word_on_line());
      if (count < 0) in.fail(fmt::format("element {} has a negative count", element.name));
      element.count = static_cast<std::uint64_t>(count);
      header.elements.push_back(element);
    } else if (key == "property") {
      if (header.elements.empty()) in.fail("a property stands before the first element");
      Property property;
      auto type = in.word_on_line();
      if (type == "list") {
        property.list = type_named(in.word_on_line());
        if (!property.list) in.fail("a list's length has no known type");
        type = in.word_on_line();
      }
      const auto known = type_named(type);
      if (!known) in.fail(fmt::format("'{}' is no type of PLY", type));
      property.type = *known;
      property.name = in.word_on_line();
      header.elements.back().properties.push_back(property);
    } else if (key != "comment" && key != "obj_info") {
      in.fail(fmt::format("'{}' is no word of a PLY header", key));
    }
    in.skip_line();
  }
  if (!has_format) in.fail("the header has no format line");
  in.skip_line();
  return header;
}

/// Gives the properties of vertices and faces their roles.
void assign_roles(Element& element, const Scanner& scanner) {
  static constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
  if (element.name == "vertex") {
    std::array<int, 6> seen{};
    for (Property& p : element.properties) {
      const auto found = std::find(kNames.begin(), kNames.end(), p.name);
      if (p.list || found == kNames.end()) continue;
      p.role = static_cast<Role>(found - kNames.begin());
      ++seen[p.role];
    }
    if (seen[kX] + seen[kY] + seen[kZ] != 3) scanner.fail("element vertex has no x, y and z");
    const bool with_normals = seen[kNormalX] > 0 && seen[kNormalY] > 0 && seen[kNormalZ] > 0;
    for (Property& p : element.properties) {
      if (!with_normals && p.role >= kNormalX && p.role <= kNormalZ) p.role = kNothing;
    }
  } else if (element.name == "face") {
    for (Property& p : element.properties) {
      if (p.list && (p.name == "vertex_indices" || p.name == "vertex_index")) p.role = kCorners;
    }
  }
}

template <Coding coding>
MeshFile read_elements(const Scanner& in, std::vector<Element> elements) {
  Values<coding> values(in);
  MeshFile mesh;
  bool has_vertices = false;
  for (Element& element : elements) {
    // Without properties an element has no bytes, and its count would be bounded by nothing.
    if (element.properties.empty()) continue;
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    if (faces && !has_vertices) values.scanner().fail("faces stand before the vertices");
    assign_roles(element, values.scanner());
    has_vertices = has_vertices || vertices;
    const bool normals = std::any_of(element.properties.begin(), element.properties.end(),
                                     [](const Property& p) { return p.role == kNormalX; });
    // A value takes a byte at least: more will not come, whatever the count says.
    const std::size_t likely = static_cast<std::size_t>(
        std::min<std::uint64_t>(element.count, values.left() / element.properties.size()));
    // Once: made room for anew by each of many elements, all would be copied each time.
    if (vertices && mesh.positions.empty()) mesh.positions.reserve(likely);
    if (vertices && normals && mesh.normals.empty()) mesh.normals.reserve(likely);
    if (faces && mesh.ends.empty()) {
      mesh.ends.reserve(likely);
      mesh.corners.reserve(std::min(3 * likely, values.left()));
    }
    for (std::uint64_t k = 0; k < element.count; ++k) {
      std::array<double, kNothing + 1> value{};
      for (const Property& property : element.properties) {
        if (!property.list) {
          value[property.role] = values.next(property.type);
          continue;
        }
        const auto length = values.whole(*property.list);
        if (length < 0) values.scanner().fail("a list has a negative length");
        if (property.role == kCorners) {
          for (std::int64_t c = 0; c < length; ++c)
            mesh.corners.push_back(
                values.scanner().index(values.whole(property.type), mesh.positions.size()));
          mesh.ends.push_back(mesh.corners.size());
        } else {
          for (std::int64_t c = 0; c < length; ++c) values.next(property.type);
        }
      }
      if (vertices) mesh.positions.push_back({value[kX], value[kY], value[kZ]});
      if (vertices && normals) mesh.normals.push_back({value[kNormalX], value[kNormalY], value[kNormalZ]});
    }
  }
  if (mesh.normals.size() != mesh.positions.size()) mesh.normals.clear();
  return mesh;
}

}  // namespace

MeshFile parse_ply(std::string_view bytes, std::string_view name) {
  Scanner in(bytes, name);
  Header header = read_header(in);
  switch (header.coding) {
    case Coding::little:
      return read_elements<Coding::little>(in, std::move(header.elements));
    case Coding::big:
      return read_elements<Coding::big>(in, std::move(header.elements));
    default:
      return read_elements<Coding::text>(in, std::move(header.elements));
  }
}

}  // namespace plumbline::mesh_file
