// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// block_bintree's meshes, domains and blocks.
#include "algorithms/block_bintree/block_bintree.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "lattice.h"
#include "oracle/conformity.h"
#include "scenarios/error.h"

namespace plumbline::block_bintree {
namespace {

using lattice::any_camera;
using lattice::look_at;

/// Below slope 0.9 the published method is promised to conform.
Terrain gentle(int columns, int rows, std::uint64_t seed) {
  return lattice::rough(columns, rows, seed, 0.25 * columns);
}

LodFrame update(LodMethod& method, const Camera& camera, double threshold_px) {
  LodFrame frame;
  method.set_threshold_px(threshold_px);
  method.update(camera, frame);
  return frame;
}

std::unique_ptr<LodMethod> prepared(const std::string& id, const Terrain& terrain,
                                    const Options& options = {}) {
  auto method = make_method(id, options);
  method->prepare(terrain);
  return method;
}

void expect_conforming(const Terrain& terrain, const LodFrame& frame) {
  const lattice::Faults faults = look_at(terrain, frame);
  EXPECT_EQ(faults.t_junctions, 0);
  EXPECT_EQ(faults.turned, 0);
  EXPECT_EQ(faults.doubled, 0);
  EXPECT_NEAR(lattice::double_area(frame.domain, terrain.spacing_m), static_cast<double>(faults.double_area),
              lattice::kAreaRoundingCells);
  EXPECT_TRUE(oracle::check_conformity(frame.mesh, frame.domain).clean());
}

TEST(BlockBintree, M4_C1_ConformingOnGentleTerrainWithoutCorrection) {
  Random random(1);
  std::set<std::size_t> sizes;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Terrain terrain = gentle(33, 33, seed);
    ASSERT_LT(steepest_slope(terrain, ClusterGrid(terrain, 0, "test")), 0.9);
    const auto method = prepared("block_bintree", terrain, {{"cull", false}});
    for (int k = 0; k < 40; ++k) {
      const LodFrame frame = update(*method, any_camera(random, terrain), random.between(0.5, 100));
      expect_conforming(terrain, frame);
      const lattice::Faults faults = look_at(terrain, frame);
      EXPECT_EQ(faults.inner_border, 0);
      EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
      sizes.insert(frame.mesh.triangles.size());
    }
  }
  EXPECT_GT(sizes.size(), 50U) << "the meshes hardly differ";
}

// Equal and different block levels, blocks culled, several clusters: the promised domain is met, edge to
// edge.
TEST(BlockBintree, M4_C1_ConformingAcrossBlocksAndClusters) {
  Random random(2);
  std::set<int> levels_in_one_frame;
  int partly_culled = 0;
  for (const char* id : {"block_bintree", "block_bintree:tri_cull", "block_bintree:repaired"}) {
    for (const double block : {3.0, 5.0, 9.0}) {
      const Terrain terrain = gentle(33, 17, 7);
      const auto method = prepared(id, terrain, {{"block_size", block}});
      const auto& bintree = dynamic_cast<const BlockBintree&>(*method);
      for (int k = 0; k < 60; ++k) {
        const LodFrame frame = update(*method, any_camera(random, terrain), random.between(0.5, 100));
        expect_conforming(terrain, frame);
        std::set<int> levels;
        for (const BlockId id_of : bintree.active_blocks()) levels.insert(id_of.level);
        levels_in_one_frame.insert(static_cast<int>(levels.size()));
        partly_culled += frame.domain.loops.size() > 1;
      }
    }
  }
  EXPECT_GT(*levels_in_one_frame.rbegin(), 2) << "block levels never differed";
  EXPECT_GT(partly_culled, 20);
}

TEST(BlockBintree, M4_C1_RepairedConformsOnSteepTerrainWherePublishedCracks) {
  Random random(3);
  int published_cracks = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const double relief_m : {60.0, 400.0, 5000.0}) {
      const Terrain terrain = lattice::rough(33, 33, seed, relief_m);
      const auto published = prepared("block_bintree", terrain, {{"cull", false}});
      const auto repaired = prepared("block_bintree:repaired", terrain, {{"cull", false}});
      for (int k = 0; k < 60; ++k) {
        const Camera camera = any_camera(random, terrain);
        const double threshold_px = random.between(1, 300);
        published_cracks += look_at(terrain, update(*published, camera, threshold_px)).t_junctions;
        expect_conforming(terrain, update(*repaired, camera, threshold_px));
      }
    }
  }
  EXPECT_GT(published_cracks, 0);
}

// METHODS M4.S2: leaving triangles out at the view cone's edge opens no crack, since what is left out is a
// whole triangle with all below it, and a drawn triangle splits by its own node alone.
TEST(BlockBintree, M4_S2_TriCullDrawsASubsetOfTheUnculledMesh) {
  Random random(4);
  int dropped = 0;
  const Terrain terrain = gentle(33, 33, 9);
  const auto whole = prepared("block_bintree", terrain, {{"cull", false}});
  const auto culled = prepared("block_bintree:tri_cull", terrain);
  for (int k = 0; k < 60; ++k) {
    const Camera camera = any_camera(random, terrain);
    const LodFrame all = update(*whole, camera, 8);
    const LodFrame part = update(*culled, camera, 8);
    expect_conforming(terrain, part);
    const auto all_triangles = lattice::canonical(all);
    const auto part_triangles = lattice::canonical(part);
    EXPECT_TRUE(std::includes(all_triangles.begin(), all_triangles.end(), part_triangles.begin(),
                              part_triangles.end()));
    // Nothing that projects into the picture may be missing: every vertex in it is there.
    const std::set<std::uint64_t> there(part.vertex_keys.begin(), part.vertex_keys.end());
    for (std::size_t v = 0; v < all.vertex_keys.size(); ++v) {
      if (camera.sees(all.mesh.positions[v])) {
        EXPECT_TRUE(there.contains(all.vertex_keys[v]));
      }
    }
    dropped += static_cast<int>(all_triangles.size() - part_triangles.size());
  }
  EXPECT_GT(dropped, 1000);
}

// At a spacing whose multiples are rounded, a diagonal's samples are not exactly on one line: the promised
// domain must still be the mesh's, edge by edge.
TEST(BlockBintree, DomainAndMeshAgreeAtAnySpacing) {
  Random random(10);
  int culled = 0;
  for (const char* id : {"block_bintree", "block_bintree:tri_cull"}) {
    Terrain terrain = lattice::rough(33, 33, 17, 200, 23.7);
    const auto method = prepared(id, terrain, {{"block_size", 5.0}});
    for (int k = 0; k < 40; ++k) {
      const LodFrame frame = update(*method, any_camera(random, terrain), random.between(0.5, 20));
      EXPECT_TRUE(oracle::check_conformity(frame.mesh, frame.domain).clean()) << id << " " << k;
      culled += frame.domain.loops.size() > 1;
    }
  }
  EXPECT_GT(culled, 20);
}

TEST(BlockBintree, BlocksAndClustersDoNotChangeTheMesh) {
  Random random(5);
  const Terrain terrain = lattice::rough(33, 33, 11, 40);
  const auto one = prepared("block_bintree", terrain, {{"block_size", 33.0}, {"cull", false}});
  const auto many = prepared("block_bintree", terrain, {{"block_size", 5.0}, {"cull", false}});
  const auto many_culling = prepared("block_bintree", terrain, {{"block_size", 5.0}});
  for (int k = 0; k < 30; ++k) {
    const Camera camera = any_camera(random, terrain);
    const LodFrame expected = update(*one, camera, 10);
    EXPECT_TRUE(lattice::same_mesh(expected, update(*many, camera, 10)));
    EXPECT_EQ(dynamic_cast<const BlockBintree&>(*one).active_blocks().size(), 1U);
  }
  // A camera that sees everything culls nothing.
  const Camera high = make_camera({16, 16, 500}, {16, 16, 0}, 60, 640, 480);
  EXPECT_TRUE(lattice::same_mesh(update(*one, high, 0.5), update(*many_culling, high, 0.5)));
}

TEST(BlockBintree, ClustersShareTheirBorder) {
  const Terrain terrain = gentle(65, 33, 12);
  const auto method = prepared("block_bintree", terrain, {{"cull", false}});
  EXPECT_EQ(dynamic_cast<const BlockBintree&>(*method).split_function().grid().cluster_columns(), 2);
  Random random(6);
  int on_border = 0;
  for (int k = 0; k < 40; ++k) {
    const LodFrame frame = update(*method, any_camera(random, terrain), random.between(1, 60));
    expect_conforming(terrain, frame);
    EXPECT_EQ(look_at(terrain, frame).inner_border, 0);
    for (const std::uint64_t key : frame.vertex_keys) on_border += key % 65 == 32;
  }
  EXPECT_GT(on_border, 200);
}

TEST(BlockBintree, FarAwayEachClusterIsTwoTriangles) {
  const Terrain terrain = lattice::flat(33, 17);
  const auto method = prepared("block_bintree", terrain);
  const LodFrame frame = update(*method, make_camera({16, 8, 1e5}, {16, 8, 0}, 60, 640, 480), 1);
  EXPECT_EQ(frame.mesh.triangles.size(), 4U);
  EXPECT_EQ(frame.mesh.positions.size(), 6U);
  EXPECT_EQ(frame.counters.visited, 4U);
  EXPECT_EQ(frame.counters.evaluated, 4U);
  EXPECT_EQ(frame.counters.split, 0U);
}

// M4.S4: e = 0 everywhere, yet d/ε_d ≥ depth splits: every drawn hypotenuse is at most ε_d times its depth,
// or finest.
TEST(BlockBintree, M4_S4_ThePlaneIsFineNearTheCamera) {
  const Terrain terrain = lattice::flat(65, 65);
  const auto method = prepared("block_bintree", terrain, {{"cull", false}});
  const Camera camera = make_camera({32, 32, 40}, {32, 32, 0}, 60, 640, 480);
  const LodFrame frame = update(*method, camera, 1000);
  // Every node has depth 40, so hypotenuses longer than 4 split: those of √2·4 and more; 4 itself (d/ε = 40 ≥
  // 40) does.
  EXPECT_EQ(frame.mesh.triangles.size(), 64U * 64 / 2);
  for (const auto& t : frame.mesh.triangles) {
    const Vec3 left = frame.mesh.positions[t[1]], right = frame.mesh.positions[t[2]];
    EXPECT_LT(length(left - right), 4);
  }
}

TEST(BlockBintree, CountersAddUp) {
  Random random(7);
  const Terrain terrain = gentle(33, 17, 13);
  const auto method = prepared("block_bintree", terrain, {{"cull", false}});
  const std::uint64_t roots = 4;
  for (int k = 0; k < 30; ++k) {
    const LodFrame frame = update(*method, any_camera(random, terrain), random.between(1, 60));
    EXPECT_EQ(frame.mesh.triangles.size(), roots + frame.counters.split);
    EXPECT_EQ(frame.counters.visited, roots + 2 * frame.counters.split);
    EXPECT_LE(frame.counters.evaluated, frame.counters.visited);
    EXPECT_EQ(frame.counters.merged, 0U);
  }
}

TEST(BlockBintree, AThresholdNearZeroDrawsEverySample) {
  Terrain terrain = lattice::flat(17, 17);
  for (std::size_t k = 0; k < terrain.heights_m.size(); ++k) {
    terrain.heights_m[k] =
        static_cast<double>(lattice_hash(1, static_cast<std::int64_t>(k), 0) >> 40) * 0x1p-24;
  }
  const auto method = prepared("block_bintree", terrain, {{"cull", false}});
  const LodFrame frame = update(*method, make_camera({8, 8, 1e4}, {8, 8, 0}, 60, 640, 480), 1e-9);
  EXPECT_EQ(frame.mesh.positions.size(), terrain.heights_m.size());
  EXPECT_EQ(frame.mesh.triangles.size(), 2U * 16 * 16);
}

TEST(BlockBintree, LookingAwayIsEmptyWithAnEmptyDomain) {
  const Terrain terrain = lattice::flat(33, 33);
  const Camera away = make_camera({16, -200, 10}, {16, -400, 10}, 40, 640, 480);
  for (const char* id : {"block_bintree", "block_bintree:tri_cull", "block_bintree:by_distance"}) {
    const auto method = prepared(id, terrain, {{"block_size", 9.0}});
    const LodFrame frame = update(*method, away, 1);
    EXPECT_TRUE(frame.mesh.triangles.empty()) << id;
    EXPECT_TRUE(frame.mesh.positions.empty()) << id;
    EXPECT_TRUE(frame.domain.loops.empty()) << id;
    EXPECT_TRUE(dynamic_cast<const BlockBintree&>(*method).active_blocks().empty()) << id;
  }
}

TEST(BlockBintree, CulledSquaresAreWholeLoopsOutOfTheDomain) {
  const Terrain terrain = lattice::flat(33, 33);
  const auto method = prepared("block_bintree", terrain, {{"block_size", 9.0}});
  const LodFrame frame = update(*method, make_camera({2, 2, 3}, {2, 2, 0}, 30, 400, 400), 1);
  ASSERT_GT(frame.domain.loops.size(), 1U);
  for (std::size_t k = 1; k < frame.domain.loops.size(); ++k) EXPECT_EQ(frame.domain.loops[k].size(), 4U);
  expect_conforming(terrain, frame);
}

// The decided rule, evaluated the slow way: a block of level q is replaced iff a triangle of level ≥ 2(q+k)
// in it splits, that is iff a drawn triangle in its square is finer than level 2(q+k).
TEST(BlockBintree, ActiveBlocksFollowTheDecidedRule) {
  Random random(8);
  const Terrain terrain = lattice::rough(33, 33, 14, 12);
  const auto method = prepared("block_bintree", terrain, {{"block_size", 5.0}, {"cull", false}});
  const auto& bintree = dynamic_cast<const BlockBintree&>(*method);
  const BlockTree& blocks = bintree.blocks();
  for (int k = 0; k < 30; ++k) {
    const LodFrame frame = update(*method, any_camera(random, terrain), random.between(1, 60));
    std::vector<BlockId> expected;
    const auto walk = [&](auto&& self, BlockId id) -> void {
      const int side = 32 >> id.level;
      const double finest_area =
          0.5 * (32 >> (id.level + 2)) * (32 >> (id.level + 2));  // a triangle of level 2(q+k)
      bool finer = false;
      for (const auto& t : frame.mesh.triangles) {
        const Vec3 a = frame.mesh.positions[t[0]], b = frame.mesh.positions[t[1]],
                   c = frame.mesh.positions[t[2]];
        const double x = (a.x + b.x + c.x) / 3, y = (a.y + b.y + c.y) / 3;
        const bool in_square = x > id.column * side && x < (id.column + 1) * side && y > id.row * side &&
                               y < (id.row + 1) * side;
        finer |= in_square && cross(b - a, c - a).z / 2 < finest_area;
      }
      if (!finer || id.level == blocks.finest_level()) return expected.push_back(id);
      for (const BlockId child : blocks.children(id)) self(self, child);
    };
    walk(walk, {0, 0, 0});
    EXPECT_EQ(bintree.active_blocks(), expected);
  }
}

TEST(BlockBintree, ByDistanceReplacesBlocksByDistanceAlone) {
  const Terrain terrain = lattice::rough(65, 65, 15, 10);
  const auto method = prepared("block_bintree:by_distance", terrain,
                               {{"block_size", 9.0}, {"cull", false}, {"distance_factor", 1.0}});
  const auto& bintree = dynamic_cast<const BlockBintree&>(*method);
  const Camera camera = make_camera({5, 5, 20}, {40, 40, 0}, 60, 640, 480);
  for (const double threshold_px : {0.01, 1000.0}) {
    const LodFrame frame = update(*method, camera, threshold_px);
    long cells = 0;
    for (const BlockId id : bintree.active_blocks()) {
      const double distance_m = bintree.blocks().distance_m(id, camera.position);
      EXPECT_TRUE(id.level == bintree.blocks().finest_level() ||
                  distance_m >= bintree.blocks().side_m(id.level));
      const double parent_m = bintree.blocks().side_m(id.level) * 2;
      EXPECT_TRUE(id.level == 0 || distance_m < parent_m * 3);
      cells += static_cast<long>(64 >> id.level) * (64 >> id.level);
    }
    EXPECT_EQ(cells, 64 * 64);
    EXPECT_EQ(look_at(terrain, frame).double_area, lattice::double_area(terrain));
  }
  // With a vanishing threshold every block is at its finest, so blocks of different levels meet in
  // T-junctions.
  EXPECT_GT(look_at(terrain, update(*method, camera, 1e-6)).t_junctions, 0);
}

TEST(BlockBintree, TheThresholdIsMonotoneOnTheWholeDomain) {
  Random random(9);
  const Terrain terrain = lattice::rough(33, 33, 16, 60);
  for (const char* id : {"block_bintree", "block_bintree:repaired", "block_bintree:by_distance"}) {
    const auto method = prepared(id, terrain, {{"cull", false}, {"block_size", 9.0}});
    for (int k = 0; k < 15; ++k) {
      const Camera camera = any_camera(random, terrain);
      std::size_t last = 2 * 32 * 32;
      for (const double threshold_px : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 64.0}) {
        const std::size_t count = update(*method, camera, threshold_px).mesh.triangles.size();
        EXPECT_LE(count, last);
        last = count;
      }
    }
  }
}

TEST(BlockBintree, OptionsAreChecked) {
  const auto message = [](const Options& options) -> std::string {
    try {
      (void)make_method("block_bintree", options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message({{"block_size", 64.0}}), ::testing::HasSubstr("block_size = 64"));
  EXPECT_THAT(message({{"block_size", 2.0}}), ::testing::HasSubstr("block_size = 2"));
  EXPECT_THAT(message({{"block_size", 1e300}}), ::testing::HasSubstr("block_size"));
  EXPECT_THAT(message({{"depth_ratio", 0.0}}), ::testing::HasSubstr("depth_ratio = 0"));
  EXPECT_THAT(message({{"distance_factor", -1.0}}), ::testing::HasSubstr("distance_factor = -1"));
  EXPECT_THAT(message({{"block_sise", 65.0}}), ::testing::HasSubstr("block_size"));
  EXPECT_EQ(message({{"block_size", 17.0}}), "");
}

}  // namespace
}  // namespace plumbline::block_bintree
