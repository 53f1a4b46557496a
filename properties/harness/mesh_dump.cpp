// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/harness/mesh_dump.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "scenarios/whole_file.h"

namespace plumbline {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY bytes are written as they lie in memory");

template <class Value>
void append(std::string& bytes, Value value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

std::string to_ply(const Mesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + mesh.positions.size() * 24 + mesh.triangles.size() * 13);
  for (const Vec3& p : mesh.positions) {
    append(bytes, p.x);
    append(bytes, p.y);
    append(bytes, p.z);
  }
  for (const auto& triangle : mesh.triangles) {
    append(bytes, static_cast<std::uint8_t>(3));
    for (const std::uint32_t corner : triangle) append(bytes, static_cast<std::int32_t>(corner));
  }
  return bytes;
}

void dump_mesh(const std::filesystem::path& folder, const std::string& run, int frame, const Mesh& mesh) {
  write_whole_file(folder / run / fmt::format("{:05}.ply", frame), to_ply(mesh));
}

}  // namespace plumbline
