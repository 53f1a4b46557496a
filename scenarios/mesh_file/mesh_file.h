// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline {

/// A polygon mesh as its file has it: coordinates in the file's own unit, doubles kept.
struct MeshFile {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> corners;  ///< of all polygons, one after the other
  std::vector<std::size_t> ends{};     ///< per polygon: where its corners end
  /// Per part (glTF: a node that shows a mesh): where its polygons end. Empty: the file names no parts.
  std::vector<std::size_t> part_ends{};
  /// Per vertex; empty if the file does not give every vertex that is used exactly one that can be read. PLY
  /// and OBJ: as they stand there; glTF: unit, turned by the node, or zero where there is none.
  std::vector<Vec3> normals{};
  std::string format{};  ///< "PLY", "OBJ", "OFF", "STL", "glTF"

  [[nodiscard]] std::size_t polygons() const { return ends.size(); }
};

/// Reads PLY (ASCII, both byte orders, float or double), OBJ, OFF, STL (ASCII, binary) or glTF 2.0 (.glb,
/// .gltf with its buffers inside or in files beside it), told apart by content (OBJ and .gltf, which have no
/// mark, by the name's ending). Corners of STL with equal coordinates become one vertex. Of glTF the shown
/// scene's triangles (lists, strips, fans) come with their nodes' transforms, at rest: no skin, no morph, no
/// animation; compressed and sparse data are refused. y is up there, unit metres. Memory is bounded by the
/// file's size, whatever its header says. Throws InputError: one line with the file, the place in it, what is
/// wrong.
MeshFile read_mesh_file(const std::filesystem::path& path);
/// The same from bytes; `name` is for messages and for the ending. A glTF's buffers must then be inside.
MeshFile parse_mesh(std::string_view bytes, std::string_view name);

/// Cuts every n-gon into n − 2 triangles: convex ones as fans, others by clipping ears in the plane of their
/// normal (paper 004, step 1). Polygons of fewer than three corners are left out.
Mesh triangulate(const MeshFile& file);
/// The same, each part a mesh of its own with the vertices that it uses; a file without parts is one.
std::vector<Mesh> triangulate_parts(const MeshFile& file);

/// Vertices of equal coordinates (to the bit; −0 and 0 are equal) become one, the first; triangles that lose
/// a corner so, and vertices that no triangle uses, are left out. Formats that carry normals or textures
/// (glTF) double their vertices along every crease: welded, they are closed again.
Mesh welded(const Mesh& mesh);

/// The same triangles on an oriented manifold: edges of other than two triangles, or of two that run the same
/// way, become borders, and each fan of triangles gets a vertex of its own. CAD models touch themselves at
/// such places. No triangle moves; a sound mesh is returned with its vertices in order of use. Requires: no
/// triangle names a vertex twice. Source: Guéziec, Taubin, Lazarus, Horn, "Cutting and stitching" (2001),
/// cutting.
Mesh cut_to_manifold(const Mesh& mesh);

}  // namespace plumbline
