// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// vertex_tree on a CAD model: the two-cylinder engine of Debian's assimp-testmodels, 67 parts.
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/vertex_tree/cut.h"
#include "scenarios/error.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline {
namespace {

using ::testing::HasSubstr;

std::vector<Mesh> engine_parts() {
  std::vector<Mesh> parts = triangulate_parts(
      read_mesh_file("/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"));
  for (Mesh& part : parts) part = welded(part);
  return parts;
}

// Welded as they are, 39 parts touch themselves in a vertex: refused, with the place and the way out.
TEST(VertexTreeEngine, PartsThatTouchThemselvesAreRefusedByName) {
  std::size_t refused = 0;
  for (const Mesh& part : engine_parts()) {
    try {
      vertex_tree::build_tree(part, {});
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr("joins two fans of triangles"));
      EXPECT_THAT(error.what(), HasSubstr("give each fan a vertex of its own"));
    }
  }
  EXPECT_EQ(refused, 39U);
}

// With a vertex for each fan all 67 build, come down, and come back bit for bit (M5.C4).
TEST(VertexTreeEngine, M5_C4_EveryPartGoesDownAndComesBack) {
  std::size_t full = 0, least = 0;
  for (const Mesh& part : engine_parts()) {
    const Mesh mesh = cut_to_manifold(part);
    ASSERT_EQ(mesh.triangles.size(), part.triangles.size());
    vertex_tree::Cut cut(std::make_shared<const vertex_tree::VertexTree>(vertex_tree::build_tree(mesh, {})));
    Mesh before, after;
    std::vector<std::uint64_t> keys;
    cut.extract(before, keys);
    cut.coarsen(0);
    full += mesh.triangles.size();
    least += cut.triangle_count();
    cut.refine(mesh.triangles.size());
    cut.extract(after, keys);
    EXPECT_EQ(after.positions, before.positions);
    EXPECT_EQ(after.triangles, before.triangles);
  }
  EXPECT_GT(full, 110000U);
  EXPECT_LT(least, full * 6 / 10);
  RecordProperty("full", static_cast<int>(full));
  RecordProperty("least", static_cast<int>(least));
}

}  // namespace
}  // namespace plumbline
