// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/edge_collapse/edge_collapse.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "decimation_support.h"

namespace plumbline {
namespace {

using namespace decimation_support;
using ::testing::HasSubstr;

class EdgeCollapse : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, EdgeCollapse,
                         ::testing::Values("edge_collapse", "edge_collapse:garland_heckbert"),
                         [](const auto& param) {
                           return std::string(param.param).find(':') == std::string::npos
                                      ? "lindstrom_turk"
                                      : "garland_heckbert";
                         });

TEST_P(EdgeCollapse, ReachesTheCountThatTheThresholdAsksFor) {
  const Terrain terrain = lattice::rough(33, 33, 3, 4);
  const auto method = prepared(GetParam(), terrain, {{"triangles_at_1px", 1000.0}});
  for (const double tau : {1.0, 1.5, 2.0, 3.0, 4.0}) {
    const auto wanted = static_cast<std::size_t>(std::floor(1000 / tau));
    const std::size_t got = update(*method, tau).mesh.triangles.size();
    EXPECT_LE(got, wanted) << tau;
    EXPECT_GE(got + 1, wanted) << tau << ": a collapse takes two triangles at most";
  }
  EXPECT_EQ(update(*method, 1e-300).mesh.triangles.size(), 2048U);
  EXPECT_LT(update(*method, 1e300).mesh.triangles.size(), 300U);
}

TEST_P(EdgeCollapse, TheFullMeshIsTheReference) {
  const Terrain terrain = lattice::rough(17, 9, 3, 4);
  EXPECT_TRUE(lattice::same_mesh(update(*prepared(GetParam(), terrain), 1e-9), full_frame(terrain)));
}

TEST_P(EdgeCollapse, KeepsTheBorder) {
  for (const double relief_m : {0.0, 1.0, 500.0}) {
    const Terrain terrain = lattice::rough(21, 13, 9, relief_m);
    const auto border = border_of(full_frame(terrain));
    EXPECT_EQ(border.size(), 2U * (20 + 12));
    const auto method = prepared(GetParam(), terrain);
    for (const double tau : {100.0, 1e6}) {
      const LodFrame frame = update(*method, tau);
      EXPECT_LT(frame.mesh.triangles.size(), 480U);
      EXPECT_EQ(border_of(frame), border);
      for (std::size_t k = 0; k < frame.vertex_keys.size(); ++k) {
        const auto i = static_cast<int>(frame.vertex_keys[k] % 21),
                   j = static_cast<int>(frame.vertex_keys[k] / 21);
        if (i == 0 || i == 20 || j == 0 || j == 12) {
          EXPECT_EQ(frame.mesh.positions[k], terrain.point(i, j));
        }
      }
    }
  }
}

TEST_P(EdgeCollapse, ClonesOnTwoThreadsShowTheSame) {
  const Terrain terrain = lattice::rough(33, 33, 3, 4);
  const auto first = prepared(GetParam(), terrain, {{"triangles_at_1px", 2000.0}});
  const auto second = prepared(GetParam(), terrain, {{"triangles_at_1px", 2000.0}});
  const auto [up, down] = two_flyers(*first);
  const auto [again, unused] = two_flyers(*second);
  for (std::size_t k = 0; k < up.size(); ++k) {
    EXPECT_TRUE(lattice::same_mesh(up[k], down[k]));
    EXPECT_TRUE(lattice::same_mesh(up[k], again[k]));
  }
}

TEST(EdgeCollapseFreeBorder, GoesBelowTheBordersEdges) {
  const Terrain terrain = lattice::rough(33, 33, 3, 1);  // 128 border edges
  const std::size_t locked = update(*prepared("edge_collapse", terrain), 400).mesh.triangles.size();
  const LodFrame free = update(*prepared("edge_collapse:free_border", terrain), 400);
  EXPECT_GT(locked, 100U);
  EXPECT_LE(free.mesh.triangles.size(), 50U);
  EXPECT_FALSE(free.mesh.triangles.empty());
  EXPECT_FALSE(find_method("edge_collapse:free_border").promises(Promise::covers_domain));
}

// The recorded collapses are CGAL's own run: replayed to the end they give the mesh that CGAL ends with.
TEST(EdgeCollapseRecording, ReplayEndsWhereCgalEnds) {
  const Mesh mesh = reference_mesh(lattice::rough(33, 33, 5, 8));
  for (const auto policy : {edge_collapse::Policy::lindstrom_turk, edge_collapse::Policy::garland_heckbert}) {
    for (const std::size_t least : {std::size_t{0}, std::size_t{700}}) {
      const auto recording = edge_collapse::record_collapses(mesh, policy, least == 0, least);
      const auto replayed = edge_collapse::replay(mesh, recording.collapses, recording.collapses.size());
      EXPECT_EQ(replayed.mesh.positions, recording.last.positions);
      const auto sorted = [](std::vector<std::array<std::uint32_t, 3>> triangles) {
        for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        std::sort(triangles.begin(), triangles.end());
        return triangles;
      };
      EXPECT_EQ(sorted(replayed.mesh.triangles), sorted(recording.last.triangles));
      EXPECT_EQ(recording.collapses.back().triangles_left, recording.last.triangles.size());
    }
  }
}

TEST(EdgeCollapseObjects, ShareTheCountAndKeepTheirKeys) {
  const auto method = make_method("edge_collapse", {{"triangles_at_1px", 600.0}});
  method->prepare_objects({box(8, 1), box(4, 1)});  // 768 and 192 triangles
  const LodFrame frame = update(*method, 1);
  EXPECT_LE(frame.mesh.triangles.size(), 600U);
  EXPECT_GE(frame.mesh.triangles.size(), 596U);
  EXPECT_TRUE(frame.domain.loops.empty());
  const auto second = static_cast<std::size_t>(std::count_if(
      frame.vertex_keys.begin(), frame.vertex_keys.end(), [](auto key) { return key >> 32 == 1; }));
  EXPECT_GT(second, 50U);
  EXPECT_GT(frame.vertex_keys.size() - second, 200U);
  // A box keeps its volume: its planes need no more than twelve triangles.
  const LodFrame coarse = update(*method, 20);
  double volume_m3 = 0;
  for (const auto& [a, b, c] : coarse.mesh.triangles) {
    const auto& p = coarse.mesh.positions;
    volume_m3 += dot(p[a], cross(p[b], p[c])) / 6;
  }
  EXPECT_LE(coarse.mesh.triangles.size(), 30U);
  EXPECT_NEAR(volume_m3, 2, 1e-9);
}

TEST(EdgeCollapseErrors, NameObjectAndPlace) {
  const auto refused = [](Mesh mesh) {
    return error_of([&] { make_method("edge_collapse")->prepare_objects({box(1, 1), std::move(mesh)}); });
  };
  Mesh mesh = box(2, 1);
  mesh.triangles.push_back(mesh.triangles[7]);
  EXPECT_THAT(refused(mesh), HasSubstr("object 1: triangle 48"));
  mesh = box(2, 1);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_THAT(refused(mesh), HasSubstr("no oriented manifold"));
  mesh = box(2, 1);
  mesh.triangles[3] = {1, 1, 2};
  EXPECT_THAT(refused(mesh), HasSubstr("triangle 3 (vertices 1, 1, 2)"));
  mesh = box(2, 1);
  mesh.triangles[3][0] = 99;
  EXPECT_THAT(refused(mesh), HasSubstr("triangle 3 names vertex 99"));
  mesh = box(2, 1);
  mesh.positions[5].z = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refused(mesh), HasSubstr("vertex 5 is not finite"));
  // Two closed boxes that share a corner only.
  mesh = box(1, 1);
  const Mesh other = box(1, -1);
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles) {
    const auto renamed = [&](std::uint32_t v) { return other.positions[v] == Vec3{} ? 0 : base + v; };
    mesh.triangles.push_back({renamed(a), renamed(c), renamed(b)});
  }
  EXPECT_EQ(mesh.positions[0], Vec3{});
  EXPECT_THAT(refused(mesh), HasSubstr("two fans"));
}

TEST(EdgeCollapseErrors, RefusesBadCounts) {
  for (const double bad : {0.0, 1.0, -5.0, 2e9, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(error_of([&] {
                  (void)make_method("edge_collapse", {{"triangles_at_1px", bad}});
                }),
                HasSubstr("triangles_at_1px"));
}

TEST(CountRule, DividesAndClamps) {
  using decimation::triangles_for;
  EXPECT_EQ(triangles_for(20000, 1, 1000000), 20000U);
  EXPECT_EQ(triangles_for(20000, 3, 1000000), 6666U);
  EXPECT_EQ(triangles_for(20000, 0.5, 1000000), 40000U);
  EXPECT_EQ(triangles_for(20000, 1, 500), 500U);
  EXPECT_EQ(triangles_for(20000, 1e300, 500), 2U);
  EXPECT_EQ(triangles_for(20000, 1e-320, 500), 500U);
  EXPECT_EQ(triangles_for(20000, 1e300, 1), 1U);
}

}  // namespace
}  // namespace plumbline
