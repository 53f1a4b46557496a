// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh in every format that `plumbline check` reads, as its bytes. Numbers as text have the fewest digits
// that read back as the same double.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "scenarios/mesh.h"

namespace plumbline::test {

template <class T>
void append_raw(std::string& out, T value, bool big_endian = false) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

inline std::string off_bytes(const Mesh& mesh) {
  std::string out = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.positions) out += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

inline std::string obj_bytes(const Mesh& mesh) {
  std::string out;
  for (const Vec3& p : mesh.positions) out += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& t : mesh.triangles) out += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return out;
}

enum class PlyEncoding { ascii, little, big };

template <class Real>
std::string ply_bytes(const Mesh& mesh, PlyEncoding encoding, std::span<const Vec3> normals = {}) {
  static_assert(std::is_floating_point_v<Real>);
  const std::string_view real = sizeof(Real) == sizeof(float) ? "float" : "double";
  const std::string_view name = encoding == PlyEncoding::ascii    ? "ascii"
                                : encoding == PlyEncoding::little ? "binary_little_endian"
                                                                  : "binary_big_endian";
  std::string out = fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", name, mesh.positions.size());
  for (const char axis : {'x', 'y', 'z'}) out += fmt::format("property {} {}\n", real, axis);
  if (!normals.empty())
    for (const char axis : {'x', 'y', 'z'}) out += fmt::format("property {} n{}\n", real, axis);
  out += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                     mesh.triangles.size());
  const bool big = encoding == PlyEncoding::big;
  const auto reals = [&](Vec3 p, char last) {
    if (encoding == PlyEncoding::ascii) {
      out += fmt::format("{} {} {}{}", static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z),
                         last);
      return;
    }
    for (const double value : {p.x, p.y, p.z}) append_raw(out, static_cast<Real>(value), big);
  };
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    reals(mesh.positions[k], normals.empty() ? '\n' : ' ');
    if (!normals.empty()) reals(normals[k], '\n');
  }
  for (const auto& t : mesh.triangles) {
    if (encoding == PlyEncoding::ascii) {
      out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
      continue;
    }
    out += '\3';
    for (const std::uint32_t v : t) append_raw(out, v, big);
  }
  return out;
}

inline std::string stl_text(const Mesh& mesh) {
  std::string out = "solid s\n";
  for (const auto& t : mesh.triangles) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : t) {
      const Vec3& p = mesh.positions[v];
      out += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid s\n";
}

inline std::string stl_binary(const Mesh& mesh) {
  std::string out(80, ' ');
  append_raw(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    out.append(12, '\0');
    for (const std::uint32_t v : t) {
      const Vec3& p = mesh.positions[v];
      for (const double value : {p.x, p.y, p.z}) append_raw(out, static_cast<float>(value));
    }
    out.append(2, '\0');
  }
  return out;
}

/// glTF's up is y: what was north runs to −z.
inline Vec3 as_gltf(Vec3 p) { return {p.x, p.z, -p.y}; }

/// Buffer and JSON of a glTF of one node. `quantized`: positions as signed 16-bit steps of `step` from
/// `origin` (KHR_mesh_quantization), whole numbers of them.
struct Gltf {
  std::string binary, json;  ///< json: with "BUFFER" where the buffer is described

  Gltf(const Mesh& mesh, bool quantized, Vec3 origin = {}, double step = 1) {
    const Vec3 base = as_gltf(origin);
    Vec3 low, high;
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
      Vec3 p = as_gltf(mesh.positions[k]);
      if (quantized) p = (p - base) * (1 / step);
      low = k == 0 ? p : Vec3{std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = k == 0 ? p : Vec3{std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      for (const double value : {p.x, p.y, p.z}) {
        if (quantized) {
          append_raw(binary, static_cast<std::int16_t>(value));
        } else {
          append_raw(binary, static_cast<float>(value));
        }
      }
      if (quantized) binary.append(2, '\0');  // vertices stand on four bytes
    }
    const std::size_t vertex_bytes = binary.size();
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t) append_raw(binary, v);
    const std::string node =
        quantized ? fmt::format(R"({{"mesh":0,"scale":[{0},{0},{0}],"translation":[{1},{2},{3}]}})", step,
                                base.x, base.y, base.z)
                  : R"({"mesh":0})";
    json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},{}"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":{},"count":{},"type":"VEC3",)"
        R"("min":[{},{},{}],"max":[{},{},{}]}},{{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
        R"("bufferViews":[{{"buffer":0,"byteLength":{}{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
        R"("buffers":[BUFFER]}})",
        quantized
            ? R"("extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"],)"
            : "",
        node, quantized ? 5122 : 5126, mesh.positions.size(), low.x, low.y, low.z, high.x, high.y, high.z,
        3 * mesh.triangles.size(), vertex_bytes, quantized ? R"(,"byteStride":8)" : "", vertex_bytes,
        binary.size() - vertex_bytes);
  }

  [[nodiscard]] std::string with_buffer(std::string_view buffer) const {
    std::string out = json;
    out.replace(out.find("BUFFER"), 6, buffer);
    return out;
  }

  [[nodiscard]] std::string glb() const {
    const auto chunk = [](std::uint32_t type, std::string bytes, char padding) {
      while (bytes.size() % 4 != 0) bytes += padding;
      std::string out;
      append_raw(out, static_cast<std::uint32_t>(bytes.size()));
      append_raw(out, type);
      return out + bytes;
    };
    const std::string text = with_buffer(fmt::format(R"({{"byteLength":{}}})", binary.size()));
    const std::string chunks = chunk(0x4E4F534A, text, ' ') + chunk(0x004E4942, binary, '\0');
    std::string out = "glTF";
    append_raw(out, std::uint32_t{2});
    append_raw(out, static_cast<std::uint32_t>(12 + chunks.size()));
    return out + chunks;
  }

  [[nodiscard]] std::string gltf() const {
    return with_buffer(fmt::format(R"({{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}})",
                                   binary.size(), base64(binary)));
  }

  static std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
      std::uint32_t word = 0;
      for (std::size_t i = 0; i < 3; ++i)
        word = word << 8 | (k + i < bytes.size() ? static_cast<std::uint8_t>(bytes[k + i]) : 0U);
      for (std::size_t i = 0; i < 4; ++i)
        out += k + i > bytes.size() ? '=' : kDigits[word >> (18 - 6 * i) & 63];
    }
    return out;
  }
};

}  // namespace plumbline::test
