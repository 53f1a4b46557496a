// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include <gtest/gtest.h>

#include "algorithms/bintree/cluster_grid.h"
#include "algorithms/registry.h"
#include "lattice.h"
#include "oracle/conformity.h"

namespace plumbline {
namespace {

using lattice::any_camera;
using lattice::look_at;

LodFrame update(LodMethod& method, const Camera& camera, double threshold_px) {
  LodFrame frame;
  method.set_threshold_px(threshold_px);
  method.update(camera, frame);
  return frame;
}

std::unique_ptr<LodMethod> prepared(const Terrain& terrain, const Options& options = {}) {
  auto method = make_method("restricted_quadtree", options);
  method->prepare(terrain);
  return method;
}

TEST(RestrictedQuadtree, AlwaysConformingOnAnyTerrain) {
  Random random(1);
  std::set<std::size_t> sizes;
  for (const double relief_m : {0.0, 3.0, 100.0, 10000.0}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Terrain terrain = lattice::rough(33, seed % 2 == 0 ? 33 : 17, seed, relief_m);
      const auto method = prepared(terrain);
      for (int k = 0; k < 40; ++k) {
        const LodFrame frame = update(*method, any_camera(random, terrain), random.between(0.2, 300));
        const lattice::Faults faults = look_at(terrain, frame);
        EXPECT_EQ(faults.t_junctions, 0);
        EXPECT_EQ(faults.turned, 0);
        EXPECT_EQ(faults.doubled, 0);
        EXPECT_EQ(faults.inner_border, 0);
        EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
        EXPECT_EQ(frame.domain.loops.size(), 1U);
        EXPECT_TRUE(oracle::check_conformity(frame.mesh, frame.domain).clean());
        sizes.insert(frame.mesh.triangles.size());
      }
    }
  }
  EXPECT_GT(sizes.size(), 100U) << "the meshes hardly differ";
}

// The definition itself, without any tree search: select over all vertices, close under the parents, compare.
TEST(RestrictedQuadtree, EnablesTheSelectedVerticesAndTheirDependenciesOnly) {
  Random random(2);
  const Terrain terrain = lattice::rough(33, 17, 5, 20);
  const bintree::ClusterGrid grid(terrain, 0, "test");
  // ε by recursion over the children, the definition word by word; known values are kept.
  std::vector<double> errors_m(grid.samples(), -1.0);
  const auto error = [&](auto&& self, bintree::GridPoint node) -> double {
    double& out = errors_m[grid.index(node)];
    if (out >= 0) return out;
    const bintree::Diamond d = grid.diamond(node);
    const double ends_m = terrain.z(d.left.i, d.left.j) + terrain.z(d.right.i, d.right.j);
    out = std::fabs(terrain.z(node.i, node.j) - ends_m / 2);
    for (const bintree::GridPoint child : grid.children(node)) out = std::max(out, self(self, child));
    return out;
  };
  const auto method = prepared(terrain);
  for (int k = 0; k < 40; ++k) {
    const Camera camera = any_camera(random, terrain);
    const double threshold_px = random.between(1, 60);
    std::set<std::uint64_t> expected;
    const auto enable = [&](auto&& self, bintree::GridPoint p) -> void {
      if (!expected.insert(terrain.index(p.i, p.j)).second) return;
      for (const bintree::GridPoint parent : grid.parents(p)) self(self, parent);
    };
    for (int a = 0; a < 2; ++a) enable(enable, grid.root(a, 0));
    for (int j = 0; j < terrain.rows; ++j) {
      for (int i = 0; i < terrain.columns; ++i) {
        if (!grid.is_split_node({i, j})) {
          expected.insert(terrain.index(i, j));
        } else if (error(error, {i, j}) * (camera.kappa_px / threshold_px) >
                   length(terrain.point(i, j) - camera.position)) {
          enable(enable, {i, j});
        }
      }
    }
    const LodFrame frame = update(*method, camera, threshold_px);
    EXPECT_EQ(std::set<std::uint64_t>(frame.vertex_keys.begin(), frame.vertex_keys.end()), expected);
  }
}

TEST(RestrictedQuadtree, CommutesWithTheEightSymmetries) {
  Random random(3);
  const int n = 33;
  const Terrain terrain = lattice::rough(n, n, 6, 30);
  const auto method = prepared(terrain);
  // Cameras on a grid of 2⁻⁸ m, so that mirroring them is exact.
  const auto exact = [](double v) { return std::floor(v * 256) / 256; };
  for (int k = 0; k < 12; ++k) {
    Camera camera = any_camera(random, terrain);
    camera.position = {exact(camera.position.x), exact(camera.position.y), exact(camera.position.z)};
    const auto original = lattice::canonical(update(*method, camera, 10));
    for (int symmetry = 0; symmetry < 8; ++symmetry) {
      const auto move = [&](int& i, int& j) {
        if (symmetry & 1) i = n - 1 - i;
        if (symmetry & 2) j = n - 1 - j;
        if (symmetry & 4) std::swap(i, j);
      };
      Terrain moved = terrain;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          int a = i, b = j;
          move(a, b);
          moved.heights_m[moved.index(a, b)] = terrain.z(i, j);
        }
      }
      Camera moved_camera = camera;
      if (symmetry & 1) moved_camera.position.x = n - 1 - moved_camera.position.x;
      if (symmetry & 2) moved_camera.position.y = n - 1 - moved_camera.position.y;
      if (symmetry & 4) std::swap(moved_camera.position.x, moved_camera.position.y);
      const auto other = prepared(moved);
      const auto got = lattice::canonical(update(*other, moved_camera, 10));
      // Compare triangles as sets of samples, moved along.
      std::set<std::set<std::uint64_t>> expected, actual;
      for (const auto& t : original) {
        std::set<std::uint64_t> corners;
        for (const std::uint64_t key : t) {
          int i = static_cast<int>(key) % n, j = static_cast<int>(key) / n;
          move(i, j);
          corners.insert(moved.index(i, j));
        }
        expected.insert(corners);
      }
      for (const auto& t : got) actual.insert({t.begin(), t.end()});
      EXPECT_EQ(actual, expected) << "symmetry " << symmetry;
    }
  }
}

TEST(RestrictedQuadtree, FlatTerrainIsFourTrianglesACluster) {
  const Terrain terrain = lattice::flat(33, 17);
  const LodFrame frame = update(*prepared(terrain), make_camera({3, 3, 2}, {16, 8, 0}, 60, 640, 480), 0.01);
  EXPECT_EQ(frame.mesh.triangles.size(), 8U);
}

TEST(RestrictedQuadtree, AThresholdNearZeroDrawsEverySample) {
  Terrain terrain = lattice::flat(17, 17);
  for (std::size_t k = 0; k < terrain.heights_m.size(); ++k) {
    terrain.heights_m[k] =
        static_cast<double>(lattice_hash(1, static_cast<std::int64_t>(k), 0) >> 40) * 0x1p-24;
  }
  const LodFrame frame = update(*prepared(terrain), make_camera({8, 8, 1e4}, {8, 8, 0}, 60, 640, 480), 1e-9);
  EXPECT_EQ(frame.mesh.positions.size(), terrain.heights_m.size());
  EXPECT_EQ(frame.mesh.triangles.size(), 2U * 16 * 16);
}

TEST(RestrictedQuadtree, TheThresholdIsMonotone) {
  Random random(4);
  const Terrain terrain = lattice::rough(33, 33, 8, 60);
  const auto method = prepared(terrain);
  for (int k = 0; k < 20; ++k) {
    const Camera camera = any_camera(random, terrain);
    std::size_t last = 2 * 32 * 32;
    for (const double threshold_px : {0.25, 1.0, 4.0, 16.0, 64.0}) {
      const std::size_t count = update(*method, camera, threshold_px).mesh.triangles.size();
      EXPECT_LE(count, last);
      last = count;
    }
  }
}

TEST(RestrictedQuadtree, CullingLeavesAConformingPart) {
  Random random(5);
  const Terrain terrain = lattice::rough(33, 33, 9, 300, 23.7);
  const auto whole = prepared(terrain);
  const auto culling = prepared(terrain, {{"cull", true}});
  int smaller = 0;
  for (int k = 0; k < 60; ++k) {
    const Camera camera = any_camera(random, terrain);
    const LodFrame all = update(*whole, camera, 10);
    const LodFrame part = update(*culling, camera, 10);
    const lattice::Faults faults = look_at(terrain, part);
    EXPECT_EQ(faults.t_junctions, 0);
    EXPECT_EQ(faults.doubled, 0);
    EXPECT_NEAR(lattice::double_area(part.domain, 23.7), static_cast<double>(faults.double_area),
                lattice::kAreaRoundingCells);
    EXPECT_TRUE(oracle::check_conformity(part.mesh, part.domain).clean());
    smaller += part.mesh.triangles.size() < all.mesh.triangles.size();
  }
  EXPECT_GT(smaller, 20);
  const LodFrame none = update(*culling, make_camera({16, -200, 10}, {16, -400, 10}, 40, 640, 480), 1);
  EXPECT_TRUE(none.mesh.triangles.empty());
  EXPECT_TRUE(none.domain.loops.empty());
}

}  // namespace
}  // namespace plumbline
