// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Processor seconds to read a mesh of two million triangles in each format, from memory, as a ratio to one
// memcpy of the file's bytes in the same run. --brief: twenty thousand triangles.
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "scenarios/little_endian.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline::bench {
namespace {

/// Of the processor: reading is one thread's work, and others may be busy.
double seconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// n × n cells over a wavy surface, coordinates that floats hold.
Mesh lattice(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i)
      mesh.positions.push_back({i * 0.25, j * 0.25, static_cast<double>((i * i + 3 * j * j) % 4093) / 64});
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

template <class T>
std::string points(const Mesh& mesh) {
  std::string out;
  for (const Vec3& p : mesh.positions) {
    for (const double c : {p.x, p.y, p.z}) append_little_endian(out, static_cast<T>(c));
  }
  return out;
}

template <class T>
std::string ply(const Mesh& mesh, std::string_view type) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), type, type, type, mesh.triangles.size());
  out += points<T>(mesh);
  for (const auto& t : mesh.triangles) {
    out.push_back('\3');
    for (const std::uint32_t i : t) append_little_endian(out, i);
  }
  return out;
}

std::string ply_text(const Mesh& mesh) {
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.positions) out += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) out += fmt::format("3 {} {} {}\n", a, b, c);
  return out;
}

std::string obj(const Mesh& mesh) {
  std::string out;
  for (const Vec3& p : mesh.positions) out += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec3& p : mesh.positions) out += fmt::format("vn 0 {} 1\n", p.x);
  for (const auto& [a, b, c] : mesh.triangles)
    out += fmt::format("f {}//{} {}//{} {}//{}\n", a + 1, a + 1, b + 1, b + 1, c + 1, c + 1);
  return out;
}

std::string off(const Mesh& mesh) {
  std::string out = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.positions) out += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) out += fmt::format("3 {} {} {}\n", a, b, c);
  return out;
}

std::string stl(const Mesh& mesh) {
  std::string out(80, ' ');
  append_little_endian(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (const float c : {0.F, 0.F, 1.F}) append_little_endian(out, c);
    for (const std::uint32_t i : t) {
      const Vec3 p = mesh.positions[i];
      for (const double c : {p.x, p.y, p.z}) append_little_endian(out, static_cast<float>(c));
    }
    out.append(2, '\0');
  }
  return out;
}

std::string stl_text(const Mesh& mesh) {
  std::string out = "solid lattice\n";
  for (const auto& t : mesh.triangles) {
    out += "facet normal 0 0 1\n outer loop\n";
    for (const std::uint32_t i : t) {
      const Vec3 p = mesh.positions[i];
      out += fmt::format("  vertex {} {} {}\n", p.x, p.y, p.z);
    }
    out += " endloop\nendfacet\n";
  }
  return out + "endsolid lattice\n";
}

std::string glb(const Mesh& mesh) {
  std::string binary = points<float>(mesh);
  const std::size_t positions = binary.size();
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t i : t) append_little_endian(binary, i);
  }
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
      R"("nodes":[{{"mesh":0}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},)"
      R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],"bufferViews":[{{"buffer":0,)"
      R"("byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],"buffers":[{{"byteLength":{}}}]}})",
      mesh.positions.size(), 3 * mesh.triangles.size(), positions, positions, binary.size() - positions,
      binary.size());
  while (json.size() % 4 != 0) json += ' ';
  std::string out = "glTF";
  for (const std::size_t n : {std::size_t{2}, 28 + json.size() + binary.size(), json.size()})
    append_little_endian(out, static_cast<std::uint32_t>(n));
  out += "JSON" + json;
  append_little_endian(out, static_cast<std::uint32_t>(binary.size()));
  return out + std::string("BIN\0", 4) + binary;
}

}  // namespace
}  // namespace plumbline::bench

int main(int count, char** arguments) {
  using namespace plumbline;
  using namespace plumbline::bench;
  const bool brief = count > 1 && std::string(arguments[1]) == "--brief";
  const Mesh mesh = lattice(brief ? 100 : 1000);
  const std::vector<std::pair<std::string, std::function<std::string()>>> files{
      {"float.ply", [&] { return ply<float>(mesh, "float"); }},
      {"double.ply", [&] { return ply<double>(mesh, "double"); }},
      {"text.ply", [&] { return ply_text(mesh); }},
      {"normals.obj", [&] { return obj(mesh); }},
      {"text.off", [&] { return off(mesh); }},
      {"binary.stl", [&] { return stl(mesh); }},
      {"text.stl", [&] { return stl_text(mesh); }},
      {"indexed.glb", [&] { return glb(mesh); }}};
  fmt::print("{:<14}{:>12}{:>10}{:>10}{:>10}{:>9}\n", "file", "triangles", "MB", "read s", "copy s", "ratio");
  for (const auto& [name, make] : files) {
    const std::string bytes = make();
    std::string copy(bytes.size(), ' ');
    double copy_s = 1e9, read_s = 1e9;
    std::size_t polygons = 0;
    for (int k = 0; k < 3; ++k) {
      copy_s = std::min(copy_s, seconds([&] {
                          std::memcpy(copy.data(), bytes.data(), bytes.size());
                          benchmark::DoNotOptimize(copy.data());
                          benchmark::ClobberMemory();
                        }));
      read_s =
          std::min(read_s, seconds([&, &file = name] { polygons = parse_mesh(bytes, file).polygons(); }));
    }
    if (polygons != mesh.triangles.size()) {
      fmt::print(stderr, "{}: {} polygons\n", name, polygons);
      return 1;
    }
    fmt::print("{:<14}{:>12}{:>10.1f}{:>10.3f}{:>10.3f}{:>9.1f}\n", name, polygons,
               static_cast<double>(bytes.size()) * 1e-6, read_s, copy_s, read_s / copy_s);
  }
  return 0;
}
