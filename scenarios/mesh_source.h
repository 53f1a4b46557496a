// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline {

/// House limits on a scene of objects: what lies beyond would only bring overflow or exhaust memory.
inline constexpr double kFarthestM = 1e9;                   ///< bound on |coordinate|, metres
inline constexpr double kLeastScale = 1e-9;                 ///< metres per unit of the file
inline constexpr double kLargestScale = 1e9;                ///< likewise
inline constexpr std::size_t kMostCopies = 1024;            ///< of one mesh in a scene
inline constexpr std::size_t kMostTriangles = 1ull << 25u;  ///< of a scene: 33 million

/// Where the objects of a scene come from: exactly one of `file`, `generator`.
struct MeshSource {
  std::string id;
  std::filesystem::path file;    ///< anything that read_mesh_file takes
  std::string generator;         ///< one of mesh_generators()
  std::vector<Vec3> at;          ///< where copies of it stand, metres; each is an object of its own
  double scale = 1;              ///< metres per unit of the file, applied before `at`
  bool cut_to_manifold = false;  ///< files: weld, and open what is no manifold (mesh_file.h)
  friend bool operator==(const MeshSource&, const MeshSource&) = default;
};

/// Objects that stand together in one scene.
struct ObjectScene {
  std::string id;
  std::vector<Mesh> objects;   ///< one a copy, metres
  Mesh whole;                  ///< all of them as one mesh, in their order
  std::vector<Vec3> centers;   ///< of each object's box
  Vec3 center;                 ///< of the scene's box
  double radius_m = 0;         ///< of the ball around `center` that holds the scene
  double object_radius_m = 0;  ///< of the ball around the middle of one object's box: all copies are alike
};

/// Reads or generates the mesh and places its copies; the same bits on every machine. Throws InputError, one
/// line naming mesh and file, for a file that cannot be read, a mesh without triangles or extent, a
/// coordinate that is not finite or beyond kFarthestM, too many triangles. Whether it is manifold is for the
/// methods to ask.
ObjectScene load_objects(const MeshSource& source);

/// Names of the generators with one line each.
struct MeshGenerator {
  std::string name;
  std::string summary;
  Mesh (*make)();
};
/// In the order in which they are listed.
const std::vector<MeshGenerator>& mesh_generators();

}  // namespace plumbline
