// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace plumbline::reports {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
/// Column by column: x to x, y to −z, z to y.
constexpr int kYUp[] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};

/// Little-endian, as GLB is, on any machine.
void put(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xffU);
}
void put(std::string& out, float value) { put(out, std::bit_cast<std::uint32_t>(value)); }

bool drawable(const Mesh& mesh, std::uint32_t triangle) {
  return triangle < mesh.triangles.size() &&
         std::ranges::all_of(mesh.triangles[triangle], [&](std::uint32_t v) {
           if (v >= mesh.positions.size()) return false;
           const Vec3 p = mesh.positions[v];
           return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
         });
}

/// The middle of [low, high] on a grid of a power of two near its extent: a short number, whose difference
/// from a coordinate needs no more digits than the coordinate has.
double middle(double low, double high) {
  const double extent = high / 2 - low / 2;  // half of it: the whole may overflow
  if (!(extent > 0)) return low;
  int exponent = 0;
  std::frexp(extent, &exponent);
  const double grid = std::ldexp(1.0, exponent - 2);
  const double on_grid = std::round((low / 2 + high / 2) / grid) * grid;
  return std::isfinite(on_grid) ? on_grid : low / 2 + high / 2;
}

struct Bounds {
  Vec3 low, high;
};

Bounds bounds_of(const std::vector<Vec3>& points) {
  Bounds out{points.front(), points.front()};
  for (const Vec3 p : points) {
    out.low = {std::min(out.low.x, p.x), std::min(out.low.y, p.y), std::min(out.low.z, p.z)};
    out.high = {std::max(out.high.x, p.x), std::max(out.high.y, p.y), std::max(out.high.z, p.z)};
  }
  return out;
}

/// The binary chunk while it grows, with the views and accessors that describe it.
class Chunk {
 public:
  /// Index of the new accessor.
  std::size_t positions(const std::vector<Vec3>& points, Vec3 origin) {
    constexpr float kMost = std::numeric_limits<float>::max();
    std::array<float, 3> low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
    const std::size_t from = bytes_.size();
    for (const Vec3 p : points) {
      const Vec3 d = p - origin;
      const double from_origin[] = {d.x, d.y, d.z};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto value = static_cast<float>(std::clamp(from_origin[c], -double{kMost}, double{kMost}));
        low[c] = std::min(low[c], value);
        high[c] = std::max(high[c], value);
        put(bytes_, value);
      }
    }
    add_view(from, kArrayBuffer);
    Json accessor = accessor_of(kFloat, points.size(), "VEC3");
    for (const auto& [key, corner] : {std::pair{"min", low}, std::pair{"max", high}})
      accessor[key] = Json::array({double{corner[0]}, double{corner[1]}, double{corner[2]}});
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }
  std::size_t indices(const std::vector<std::uint32_t>& corners) {
    const std::size_t from = bytes_.size();
    for (const std::uint32_t corner : corners) put(bytes_, corner);
    add_view(from, kElementArrayBuffer);
    accessors.push_back(accessor_of(kUnsignedInt, corners.size(), "SCALAR"));
    return accessors.size() - 1;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  Json views = Json::array(), accessors = Json::array();

 private:
  void add_view(std::size_t from, int target) {
    views.push_back(
        {{"buffer", 0}, {"byteOffset", from}, {"byteLength", bytes_.size() - from}, {"target", target}});
  }
  [[nodiscard]] Json accessor_of(int component, std::size_t count, const char* type) const {
    return {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}};
  }

  std::string bytes_;
};

Json material_json(const GlbPart& part) {
  return {{"name", part.material},
          {"doubleSided", true},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", Json::array({part.colour[0], part.colour[1], part.colour[2], 1})},
            {"metallicFactor", 0},
            {"roughnessFactor", 1}}}};
}

std::string container(const Json& document, std::string binary) {
  std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.append((4 - text.size() % 4) % 4, ' ');
  binary.append((4 - binary.size() % 4) % 4, '\0');
  std::string out = "glTF";
  put(out, std::uint32_t{2});
  put(out, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  put(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON" + text;
  put(out, static_cast<std::uint32_t>(binary.size()));
  out += std::string("BIN\0", 4) + binary;
  return out;
}

}  // namespace

std::string glb_bytes(const std::string& name, const Mesh& mesh, const std::vector<GlbPart>& parts,
                      const Json& extras) {
  std::vector<Vec3> points;  // those that a part uses, in the mesh's order
  std::vector<std::uint32_t> number(mesh.positions.size(), kUnused);
  for (const GlbPart& part : parts)
    for (const std::uint32_t t : part.triangles)
      if (drawable(mesh, t))
        for (const std::uint32_t v : mesh.triangles[t]) number[v] = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(points.size());
    points.push_back(mesh.positions[v]);
  }
  if (points.empty()) return {};

  const Bounds bounds = bounds_of(points);
  const Vec3 origin{middle(bounds.low.x, bounds.high.x), middle(bounds.low.y, bounds.high.y),
                    middle(bounds.low.z, bounds.high.z)};
  Chunk chunk;
  const std::size_t position = chunk.positions(points, origin);
  Json primitives = Json::array(), materials = Json::array();
  for (const GlbPart& part : parts) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t t : part.triangles)
      if (drawable(mesh, t))
        for (const std::uint32_t v : mesh.triangles[t]) corners.push_back(number[v]);
    if (corners.empty()) continue;
    primitives.push_back({{"attributes", {{"POSITION", position}}},
                          {"indices", chunk.indices(corners)},
                          {"material", materials.size()},
                          {"mode", 4}});
    materials.push_back(material_json(part));
  }
  Json node = {{"name", name}, {"mesh", 0}, {"translation", Json::array({origin.x, origin.y, origin.z})}};
  if (!extras.empty()) node["extras"] = extras;
  const Json document = {
      {"asset", {{"version", "2.0"}, {"generator", "plumbline " PLUMBLINE_VERSION}}},
      {"scene", 0},
      {"scenes", Json::array({{{"name", name}, {"nodes", Json::array({0})}}})},
      {"nodes", Json::array({{{"name", "z up to y up"}, {"matrix", kYUp}, {"children", Json::array({1})}},
                             std::move(node)})},
      {"meshes", Json::array({{{"name", name}, {"primitives", std::move(primitives)}}})},
      {"materials", std::move(materials)},
      {"accessors", std::move(chunk.accessors)},
      {"bufferViews", std::move(chunk.views)},
      {"buffers", Json::array({{{"byteLength", chunk.bytes().size()}}})}};
  return container(document, chunk.bytes());
}

}  // namespace plumbline::reports
