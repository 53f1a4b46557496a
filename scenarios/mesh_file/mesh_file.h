// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline {

/// A polygon mesh as its file has it: coordinates in the file's own unit, doubles kept.
struct MeshFile {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> corners;  ///< of all polygons, one after the other
  std::vector<std::size_t> ends{};     ///< per polygon: where its corners end

  [[nodiscard]] std::size_t polygons() const { return ends.size(); }
};

/// Reads PLY (ASCII, both byte orders, float or double), OBJ, OFF or STL (ASCII, binary), told apart by
/// content (OBJ, which has no mark, by its name's ending). Corners of STL with equal coordinates become one
/// vertex. Memory is bounded by the file's size, whatever its header says. Throws InputError: one line with
/// the file, the place in it, what is wrong.
MeshFile read_mesh_file(const std::filesystem::path& path);
/// The same from bytes; `name` is for messages and for the ending.
MeshFile parse_mesh(std::string_view bytes, std::string_view name);

/// Cuts every n-gon into n − 2 triangles: convex ones as fans, others by clipping ears in the plane of their
/// normal (paper 004, step 1). Polygons of fewer than three corners are left out.
Mesh triangulate(const MeshFile& file);

}  // namespace plumbline
