// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// haar_quadtree as a method: which terrains and options it takes, its budget, its first and its later frames.

#include "algorithms/haar_quadtree/haar_quadtree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/haar_quadtree/dual_mesh.h"
#include "algorithms/registry.h"
#include "lattice.h"
#include "oracle/conformity.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using testing::HasSubstr;

std::unique_ptr<LodMethod> prepared(const Terrain& terrain, double threshold_px, const Options& options = {},
                                    const std::string& id = "haar_quadtree") {
  auto method = make_method(id, options);
  method->prepare(terrain);
  method->set_threshold_px(threshold_px);
  return method;
}

/// Findings of O1 but the outline, which M1 does not promise.
std::size_t faults(const LodFrame& frame) {
  const oracle::ConformityReport report = oracle::check_conformity(frame.mesh, frame.domain);
  return report.counts.total() - report.counts.outline;
}

TEST(HaarQuadtree, RepresentsWholePatches) {
  const auto block = [](int columns, int rows, const Options& options = {}) {
    const Terrain terrain = lattice::flat(columns, rows);
    return prepared(terrain, 1, options)->reference(terrain);
  };
  EXPECT_EQ(block(257, 257), (SampleBlock{256, 256}));
  EXPECT_EQ(block(97, 33), (SampleBlock{96, 32}));      // three patches of 32
  EXPECT_EQ(block(403, 344), (SampleBlock{400, 336}));  // no common power of two: patches of 16
  EXPECT_EQ(block(4, 3), (SampleBlock{2, 2}));
  EXPECT_EQ(block(257, 257, {{"patch_size", 64.0}}), (SampleBlock{256, 256}));
  EXPECT_EQ(block(403, 344, {{"patch_size", 128.0}}), (SampleBlock{384, 256}));
}

TEST(HaarQuadtree, RefusesWhatItCannotTake) {
  const auto complaint = [](int side, const Options& options) -> std::string {
    try {
      prepared(lattice::flat(side, side), 1, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint(2, {}), HasSubstr("at least 3 a side"));
  EXPECT_THAT(complaint(33, {{"patch_size", 24.0}}), HasSubstr("patch_size = 24"));
  EXPECT_THAT(complaint(33, {{"patch_size", 64.0}}), HasSubstr("up to 32"));
  EXPECT_THAT(complaint(33, {{"patch_size", -1.0}}), HasSubstr("patch_size = -1"));
  EXPECT_THAT(complaint(33, {{"lambda", 1.0}}), HasSubstr("lambda = 1"));
  EXPECT_THAT(complaint(33, {{"max_nodes", 2.5}}), HasSubstr("max_nodes = 2.5"));
}

/// Every sample of the block is a vertex, in its place, when nothing may be merged.
TEST(HaarQuadtree, LeavesAreSamples) {
  Terrain terrain = lattice::flat(17, 9, 3);
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 17; ++i) terrain.heights_m[terrain.index(i, j)] = (i * 7 + j * 5) % 11;
  }
  LodFrame frame;
  prepared(terrain, 1e-9, {{"cull", false}})
      ->update(make_camera({20, -30, 40}, {20, 10, 0}, 60, 640, 480), frame);
  ASSERT_EQ(frame.mesh.positions.size(), 16u * 8u);
  EXPECT_EQ(frame.mesh.triangles.size(), 2u * 15u * 7u);
  for (const Vec3& p : frame.mesh.positions) {
    EXPECT_EQ(p, terrain.point(static_cast<int>(p.x / 3), static_cast<int>(p.y / 3)));
  }
}

TEST(HaarQuadtree, NodesAreMeansAndTheirErrorIsTheLargestCoefficient) {
  Terrain terrain = lattice::flat(3, 3);
  terrain.heights_m = {1, 2, 0, 3, 8, 0, 0, 0, 0};
  const haar_quadtree::Forest forest(terrain, 1);
  EXPECT_EQ(forest.position(forest.patch(0)), (Vec3{0.5, 0.5, 3.5}));
  EXPECT_EQ(forest.error_m(forest.patch(0)), 2);  // (1+2−3−8)/4 = −2; the others are −1.5 and 1
  EXPECT_EQ(forest.node_count(), 5u);
}

/// Whatever the cap: never more roots than it allows, never a fault, through merges and splits.
TEST(HaarQuadtree, M1_TheBudgetHoldsAtAnyCapAndConforms) {
  const Terrain terrain = lattice::rough(97, 65, 3, 60);
  std::uint64_t splits = 0, merges = 0;
  for (const int cap : {1, 2, 5, 6, 7, 16, 17, 100, 1000, 100000}) {
    const Options options{{"max_nodes", double{1} * cap}};
    const auto method = prepared(terrain, 0.5, options);
    Random random(11);
    LodFrame frame;
    for (int k = 0; k < 24; ++k) {
      // Towards the terrain, then far away, where all merges, and back.
      const Camera camera = k % 8 < 5 ? lattice::any_camera(random, terrain)
                                      : make_camera({-9000, 0, 3000}, {0, 0, 0}, 60, 640, 480);
      method->update(camera, frame);
      splits += frame.counters.split;
      merges += frame.counters.merged;
      // Patches of 32 samples: 3 × 2 roots at least.
      EXPECT_LE(frame.mesh.positions.size(), static_cast<std::size_t>(std::max(cap, 6)));
      ASSERT_EQ(faults(frame), 0u) << "cap " << cap << ", frame " << k;
    }
  }
  EXPECT_GT(splits, 0u);
  EXPECT_GT(merges, 0u);
}

TEST(HaarQuadtree, M1_C1_FlightsConformWithAnyPatches) {
  for (const std::string id : {"haar_quadtree", "haar_quadtree:morph"}) {
    for (const double patch : {0.0, 2.0, 8.0, 16.0}) {
      const Terrain terrain = lattice::rough(81, 49, 5, 80);
      const auto method = prepared(terrain, 2, {{"patch_size", patch}}, id);
      Random random(7);
      LodFrame frame;
      for (int k = 0; k < 20; ++k) {
        method->update(lattice::any_camera(random, terrain), frame);
        ASSERT_EQ(faults(frame), 0u) << id << ", patches of " << patch << ", frame " << k;
      }
    }
  }
}

/// The triangles of a flight are those of the specification, taken literally.
TEST(HaarQuadtree, M1_C6_FlightsDrawTheCollapsedFullTriangulation) {
  const Terrain terrain = lattice::rough(65, 33, 9, 50);
  haar_quadtree::HaarQuadtree method(haar_quadtree::Settings{});
  method.prepare(terrain);
  method.set_threshold_px(3);
  Random random(2);
  LodFrame frame;
  for (int k = 0; k < 30; ++k) {
    method.update(lattice::any_camera(random, terrain), frame);
    if (frame.mesh.triangles.empty()) continue;
    LodFrame naive = frame;
    collapse_full_triangulation(method.forest(), method.cut(), naive.mesh.triangles);
    ASSERT_EQ(lattice::canonical(frame), lattice::canonical(naive)) << "frame " << k;
  }
}

TEST(HaarQuadtree, ResetAndCloneStartAnew) {
  const Terrain terrain = lattice::rough(65, 65, 4, 50);
  const auto method = prepared(terrain, 2);
  Random random(3);
  const Camera first = lattice::any_camera(random, terrain), second = lattice::any_camera(random, terrain);
  LodFrame fresh, later, again, cloned;
  method->update(second, fresh);
  method->update(first, later);
  const auto clone = method->clone();
  method->reset();
  method->update(second, again);
  clone->update(second, cloned);
  EXPECT_TRUE(lattice::same_mesh(fresh, again));
  EXPECT_TRUE(lattice::same_mesh(fresh, cloned));
}

}  // namespace
}  // namespace plumbline
