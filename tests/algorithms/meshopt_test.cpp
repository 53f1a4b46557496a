// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/meshopt/meshopt.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "decimation_support.h"

namespace plumbline {
namespace {

using namespace decimation_support;
using ::testing::HasSubstr;

TEST(Meshopt, ReachesTheCountThatTheThresholdAsksFor) {
  const Terrain terrain = lattice::rough(65, 65, 3, 4);
  const auto method = prepared("meshopt", terrain, {{"triangles_at_1px", 4000.0}});
  for (const double tau : {1.0, 1.5, 2.0, 3.0, 4.0}) {
    const auto wanted = static_cast<std::size_t>(std::floor(4000 / tau));
    const std::size_t got = update(*method, tau).mesh.triangles.size();
    EXPECT_LE(got, wanted) << tau;
    EXPECT_GE(static_cast<double>(got), 0.98 * static_cast<double>(wanted)) << tau;
  }
  EXPECT_EQ(update(*method, 1e-300).mesh.triangles.size(), 8192U);
  EXPECT_LT(update(*method, 1e300).mesh.triangles.size(), 600U);
}

TEST(Meshopt, TheFullMeshIsTheReference) {
  const Terrain terrain = lattice::rough(17, 9, 3, 4);
  EXPECT_TRUE(lattice::same_mesh(update(*prepared("meshopt", terrain), 1e-9), full_frame(terrain)));
}

TEST(Meshopt, KeepsTheBorderAndMovesNoVertex) {
  for (const double relief_m : {0.0, 1.0, 500.0}) {
    const Terrain terrain = lattice::rough(21, 13, 9, relief_m);
    const auto border = border_of(full_frame(terrain));
    const auto method = prepared("meshopt", terrain);
    for (const double tau : {100.0, 1e6}) {
      const LodFrame frame = update(*method, tau);
      EXPECT_LT(frame.mesh.triangles.size(), 480U);
      EXPECT_EQ(border_of(frame), border);
      for (std::size_t k = 0; k < frame.vertex_keys.size(); ++k) {
        EXPECT_EQ(frame.mesh.positions[k], terrain.point(static_cast<int>(frame.vertex_keys[k] % 21),
                                                         static_cast<int>(frame.vertex_keys[k] / 21)));
      }
    }
  }
}

TEST(Meshopt, AFreeBorderGoesBelowTheBordersEdges) {
  const Terrain terrain = lattice::rough(33, 33, 3, 1);  // 128 border edges
  const std::size_t locked = update(*prepared("meshopt", terrain), 400).mesh.triangles.size();
  const LodFrame free = update(*prepared("meshopt:free_border", terrain), 400);
  EXPECT_GT(locked, 100U);
  EXPECT_LE(free.mesh.triangles.size(), 50U);
  EXPECT_FALSE(free.mesh.triangles.empty());
  EXPECT_FALSE(find_method("meshopt:free_border").promises(Promise::covers_domain));
}

TEST(Meshopt, ClonesOnTwoThreadsShowTheSame) {
  const Terrain terrain = lattice::rough(33, 33, 3, 4);
  const auto first = prepared("meshopt", terrain, {{"triangles_at_1px", 2000.0}});
  const auto second = prepared("meshopt", terrain, {{"triangles_at_1px", 2000.0}});
  const auto [up, down] = two_flyers(*first);
  const auto [again, unused] = two_flyers(*second);
  for (std::size_t k = 0; k < up.size(); ++k) {
    EXPECT_TRUE(lattice::same_mesh(up[k], down[k]));
    EXPECT_TRUE(lattice::same_mesh(up[k], again[k]));
  }
}

TEST(MeshoptObjects, FarFromTheOriginNothingIsLost) {
  // The box's detail is below a float's resolution there.
  Mesh far = box(8, 1);
  for (Vec3& p : far.positions) p = p + Vec3{1e8, -1e8, 1e8};
  const auto near_method = make_method("meshopt", {{"triangles_at_1px", 100.0}});
  const auto far_method = make_method("meshopt", {{"triangles_at_1px", 100.0}});
  near_method->prepare_objects({box(8, 1)});
  far_method->prepare_objects({far});
  const LodFrame a = update(*near_method, 1), b = update(*far_method, 1);
  EXPECT_LE(a.mesh.triangles.size(), 100U);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.vertex_keys, b.vertex_keys);
}

TEST(MeshoptObjects, TakeNonManifoldsAndRefuseUnsoundOnes) {
  const auto prepare = [](const Mesh& mesh) {
    return error_of([&] {
      const auto method = make_method("meshopt", {{"triangles_at_1px", 20.0}});
      method->prepare_objects({mesh});
      EXPECT_GT(update(*method, 1).mesh.triangles.size(), 0U);
    });
  };
  Mesh mesh = box(2, 1);
  mesh.triangles.push_back(mesh.triangles[7]);
  EXPECT_EQ(prepare(mesh), "");
  mesh.triangles[3][0] = 99;
  EXPECT_THAT(prepare(mesh), HasSubstr("meshopt: object 0: triangle 3 names vertex 99"));
  mesh = box(2, 1);
  mesh.positions[5].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(prepare(mesh), HasSubstr("vertex 5 is not finite"));
}

TEST(MeshoptErrors, RefusesBadCounts) {
  for (const double bad : {0.0, 1.0, -5.0, 2e9, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(error_of([&] {
                  (void)make_method("meshopt", {{"triangles_at_1px", bad}});
                }),
                HasSubstr("triangles_at_1px"));
}

}  // namespace
}  // namespace plumbline
