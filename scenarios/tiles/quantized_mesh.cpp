// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/tiles/quantized_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/gzip.h"
#include "scenarios/little_endian.h"
#include "scenarios/whole_file.h"

namespace plumbline {
namespace {

constexpr std::size_t kMostShortVertices = 65536;  // indices take four bytes from one more on
enum Extension : std::uint8_t { kNormals = 1, kWaterMask = 2, kMetadata = 4 };
constexpr std::size_t kExtensionHeader = 5;  // number, length

/// The tile's bytes from front to back.
class Bytes {
 public:
  Bytes(std::string_view all, std::string_view name) : all_(all), name_(name) {}

  template <class T>
  T take(std::string_view part) {
    return value_at<T>(run(1, sizeof(T), part), 0);
  }
  /// `count` elements of `size` bytes.
  std::string_view run(std::uint64_t count, std::size_t size, std::string_view part) {
    if (count > left() / size)
      fail(fmt::format("{} takes {} × {} bytes, {} are left", part, count, size, left()));
    const auto found = all_.substr(at_, static_cast<std::size_t>(count) * size);
    at_ += found.size();
    return found;
  }
  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}: byte {}: {}; the tile was cut short, or it is no quantized-mesh tile",
                                 one_line(name_), at_, what));
  }
  /// Requires: so many have been taken.
  void back(std::size_t bytes) { at_ -= bytes; }
  void align(std::size_t size) {
    if (at_ % size != 0) run(size - at_ % size, 1, "the padding before the indices");
  }
  [[nodiscard]] std::size_t left() const { return all_.size() - at_; }
  [[nodiscard]] std::string_view rest() const { return all_.substr(at_); }

 private:
  std::string_view all_, name_;
  std::size_t at_ = 0;
};

Vec3 take_point(Bytes& in, std::string_view part) {
  Vec3 p;
  p.x = in.take<double>(part);
  p.y = in.take<double>(part);
  p.z = in.take<double>(part);
  return p;
}

std::vector<std::int32_t> take_deltas(Bytes& in, std::uint64_t count, std::string_view part) {
  const std::string_view codes = in.run(count, 2, part);
  std::vector<std::int32_t> out(static_cast<std::size_t>(count));
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::int32_t code = value_at<std::uint16_t>(codes, 2 * k);
    sum += code % 2 == 0 ? code / 2 : -(code / 2) - 1;  // zig-zag: 0, −1, 1, −2, …
    out[k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(sum, std::numeric_limits<std::int32_t>::min(),
                                                                std::numeric_limits<std::int32_t>::max()));
  }
  return out;
}

struct Indices {
  std::string_view bytes;
  std::size_t width;
  [[nodiscard]] std::uint32_t operator[](std::size_t k) const {
    return width == 2 ? value_at<std::uint16_t>(bytes, 2 * k) : value_at<std::uint32_t>(bytes, 4 * k);
  }
};

void take_triangles(Bytes& in, std::size_t width, QuantizedMesh& tile) {
  const auto count = in.take<std::uint32_t>("the number of triangles");
  const Indices codes{in.run(count, 3 * width, "the list of triangles"), width};
  tile.triangles.resize(count);
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < 3 * tile.triangles.size(); ++k) {
    const std::uint32_t code = codes[k];
    tile.triangles[k / 3][k % 3] = highest - code;
    if (code == 0) ++highest;
  }
}

/// Cigolle et al., "A survey of efficient representations for independent unit vectors" (JCGT 3, 2014), on
/// two bytes.
Vec3 oct_decoded(std::uint8_t a, std::uint8_t b) {
  const double x = a / 255.0 * 2 - 1, y = b / 255.0 * 2 - 1;
  const double z = 1 - std::fabs(x) - std::fabs(y);
  if (z >= 0) return normalized({x, y, z});
  return normalized({std::copysign(1 - std::fabs(y), x), std::copysign(1 - std::fabs(x), y), z});
}

std::array<std::uint8_t, 2> oct_encoded(Vec3 n) {
  const double sum = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
  double x = n.x / sum, y = n.y / sum;
  if (n.z < 0) {
    const double was_x = x;
    x = std::copysign(1 - std::fabs(y), was_x);
    y = std::copysign(1 - std::fabs(was_x), y);
  }
  const auto byte = [](double c) {
    return static_cast<std::uint8_t>(std::floor((std::clamp(c, -1.0, 1.0) * 0.5 + 0.5) * 255 + 0.5));
  };
  return {byte(x), byte(y)};
}

void take_extensions(Bytes& in, QuantizedMesh& tile) {
  // Zero is no extension's number, but what fills a file up.
  while (in.left() >= kExtensionHeader && in.rest().front() != '\0') {
    const auto number = in.take<std::uint8_t>("an extension's number");
    const auto length = in.take<std::uint32_t>("an extension's length");
    const std::string_view data = in.run(length, 1, fmt::format("extension {}", number));
    tile.extensions.push_back(number);
    if (number == kNormals) {
      tile.normals.clear();
      for (std::size_t k = 0; k + 1 < data.size(); k += 2)
        tile.normals.push_back(
            oct_decoded(value_at<std::uint8_t>(data, k), value_at<std::uint8_t>(data, k + 1)));
      tile.trailing_bytes += data.size() % 2;
    } else if (number == kWaterMask) {
      tile.water_mask = data;
    } else if (number == kMetadata) {
      in.back(length);
      const auto json = in.take<std::uint32_t>("the metadata's length");
      if (length < 4 || json > length - 4)
        in.fail(fmt::format("metadata of {} bytes in an extension of {}", json, length));
      tile.metadata = in.run(json, 1, "the metadata");
      tile.trailing_bytes += in.run(length - 4 - json, 1, "extension 4").size();
    }
  }
  tile.trailing_bytes += in.left();
}

QuantizedMesh decode_mesh(std::string_view bytes, std::string_view name) {
  Bytes in(bytes, name);
  QuantizedMesh tile;
  tile.center = take_point(in, "the header's center");
  tile.min_height_m = in.take<float>("the header's least height");
  tile.max_height_m = in.take<float>("the header's greatest height");
  tile.sphere_center = take_point(in, "the header's bounding sphere");
  tile.sphere_radius_m = in.take<double>("the header's bounding sphere");
  tile.horizon_occlusion = take_point(in, "the header's horizon occlusion point");
  const auto vertices = in.take<std::uint32_t>("the number of vertices");
  tile.u = take_deltas(in, vertices, "the list of u");
  tile.v = take_deltas(in, vertices, "the list of v");
  tile.height = take_deltas(in, vertices, "the list of heights");
  const std::size_t width = vertices > kMostShortVertices ? 4 : 2;
  in.align(width);
  take_triangles(in, width, tile);
  for (const TileSide side : kTileSides) {
    const auto count =
        in.take<std::uint32_t>(fmt::format("the number of vertices of the {} edge", tile_side_name(side)));
    const Indices list{
        in.run(count, width, fmt::format("the list of vertices of the {} edge", tile_side_name(side))),
        width};
    auto& edge = tile.edges[static_cast<std::size_t>(side)];
    edge.resize(count);
    for (std::size_t k = 0; k < edge.size(); ++k) edge[k] = list[k];
  }
  take_extensions(in, tile);
  return tile;
}

/// As a tile of heightmap-1.0 has: heights, a byte that says which children there are, the water mask.
bool has_size_of_heightmap(std::size_t bytes) {
  constexpr std::size_t kHeights = 65 * 65 * 2, kOneByteMask = 1, kWholeMask = 256 * 256;
  return bytes == kHeights + 1 + kOneByteMask || bytes == kHeights + 1 + kWholeMask;
}

/// A sound tile may have that size, too: only what is none is called by the other format's name.
QuantizedMesh decode(std::string_view bytes, std::string_view name) {
  const auto name_the_other_format = [&] {
    throw InputError(fmt::format("{}: {} bytes are a tile of heightmap-1.0; quantized-mesh-1.0 is read here",
                                 one_line(name), bytes.size()));
  };
  try {
    QuantizedMesh tile = decode_mesh(bytes, name);
    if (tile.triangles.empty() && has_size_of_heightmap(bytes.size())) name_the_other_format();
    return tile;
  } catch (const InputError&) {
    if (has_size_of_heightmap(bytes.size())) name_the_other_format();
    throw;
  }
}

std::uint16_t zig_zag(std::int64_t delta) {
  if (delta < -32768 || delta > 32767)
    throw std::invalid_argument(fmt::format("a step of {} does not fit into 16 bits", delta));
  return static_cast<std::uint16_t>(delta >= 0 ? 2 * delta : -2 * delta - 1);
}

void append_deltas(std::string& out, const std::vector<std::int32_t>& values) {
  std::int64_t last = 0;
  for (const std::int32_t value : values) {
    append_little_endian(out, zig_zag(value - last));
    last = value;
  }
}

void append_index(std::string& out, std::uint32_t index, std::size_t width) {
  if (width == 4) return append_little_endian(out, index);
  if (index > 0xffff)
    throw std::invalid_argument(fmt::format("index code {} does not fit into 16 bits", index));
  append_little_endian(out, static_cast<std::uint16_t>(index));
}

void append_extension(std::string& out, Extension number, std::string_view data) {
  out.push_back(static_cast<char>(number));
  append_little_endian(out, static_cast<std::uint32_t>(data.size()));
  out += data;
}

}  // namespace

std::string_view tile_side_name(TileSide side) {
  constexpr std::array<std::string_view, 4> kNames{"west", "south", "east", "north"};
  return kNames[static_cast<std::size_t>(side)];
}

QuantizedMesh parse_quantized_mesh(std::string_view bytes, std::string_view name) {
  if (!is_gzip(bytes)) return decode(bytes, name);
  const Inflated inflated = gunzip(bytes, name);
  QuantizedMesh tile = decode(inflated.bytes, name);
  tile.trailing_bytes += inflated.rest;
  return tile;
}

QuantizedMesh read_quantized_mesh(const std::filesystem::path& path) {
  return parse_quantized_mesh(read_whole_file(path, "a terrain tile"), path.string());
}

std::string encode_quantized_mesh(const QuantizedMesh& tile) {
  if (tile.v.size() != tile.vertices() || tile.height.size() != tile.vertices())
    throw std::invalid_argument("u, v and height have different lengths");
  std::string out;
  const auto append_point = [&](Vec3 p) {
    for (const double c : {p.x, p.y, p.z}) append_little_endian(out, c);
  };
  append_point(tile.center);
  append_little_endian(out, tile.min_height_m);
  append_little_endian(out, tile.max_height_m);
  append_point(tile.sphere_center);
  append_little_endian(out, tile.sphere_radius_m);
  append_point(tile.horizon_occlusion);
  append_little_endian(out, static_cast<std::uint32_t>(tile.vertices()));
  append_deltas(out, tile.u);
  append_deltas(out, tile.v);
  append_deltas(out, tile.height);
  const std::size_t width = tile.vertices() > kMostShortVertices ? 4 : 2;
  while (out.size() % width != 0) out.push_back('\0');
  append_little_endian(out, static_cast<std::uint32_t>(tile.triangles.size()));
  std::uint32_t highest = 0;
  for (const auto& triangle : tile.triangles) {
    for (const std::uint32_t index : triangle) {
      const std::uint32_t code = highest - index;
      append_index(out, code, width);
      if (code == 0) ++highest;
    }
  }
  for (const auto& edge : tile.edges) {
    append_little_endian(out, static_cast<std::uint32_t>(edge.size()));
    for (const std::uint32_t index : edge) append_index(out, index, width);
  }
  if (!tile.normals.empty()) {
    std::string data;
    for (const Vec3& normal : tile.normals) {
      for (const std::uint8_t byte : oct_encoded(normal)) data.push_back(static_cast<char>(byte));
    }
    append_extension(out, kNormals, data);
  }
  if (!tile.water_mask.empty()) append_extension(out, kWaterMask, tile.water_mask);
  if (!tile.metadata.empty()) {
    std::string data;
    append_little_endian(data, static_cast<std::uint32_t>(tile.metadata.size()));
    append_extension(out, kMetadata, data + tile.metadata);
  }
  return out;
}

QuantizedMesh in_high_water_order(const QuantizedMesh& tile) {
  constexpr std::uint32_t kNew = 0xffffffff;
  std::vector<std::uint32_t> now(tile.vertices(), kNew);
  std::uint32_t next = 0;
  QuantizedMesh out = tile;
  for (auto& triangle : out.triangles) {
    for (std::uint32_t& index : triangle) {
      if (index >= now.size()) continue;
      if (now[index] == kNew) now[index] = next++;
      index = now[index];
    }
  }
  for (std::uint32_t& index : now) {
    if (index == kNew) index = next++;
  }
  for (std::size_t k = 0; k < now.size(); ++k) {
    out.u[now[k]] = tile.u[k];
    out.v[now[k]] = tile.v[k];
    out.height[now[k]] = tile.height[k];
    if (tile.normals.size() == now.size()) out.normals[now[k]] = tile.normals[k];
  }
  for (auto& edge : out.edges) {
    for (std::uint32_t& index : edge) {
      if (index < now.size()) index = now[index];
    }
  }
  return out;
}

}  // namespace plumbline
