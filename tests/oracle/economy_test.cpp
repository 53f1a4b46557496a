// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// O4's slack against scenes with a known answer, and against really taking each vertex out and measuring with
// O3.
#include "oracle/economy.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scenarios/random.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle {
namespace {

Terrain flat(int side) {
  Terrain terrain;
  terrain.columns = terrain.rows = side;
  terrain.spacing_m = 10;
  terrain.heights_m.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0);
  return terrain;
}

Terrain rough(int side, std::uint64_t seed) {
  Terrain terrain = flat(side);
  Random random(seed);
  for (double& z : terrain.heights_m) z = random.between(0, 6);
  return terrain;
}

/// Everything of a terrain of that side in the picture, from aside, so that heights show.
Camera above(int side) {
  const double middle = 5.0 * (side - 1);
  return make_camera({middle - 3.0 * side, middle - 12.0 * side, 11.0 * side}, {middle, middle, 0}, 60, 160,
                     160);
}

Slack slack_of(const Terrain& terrain, const Mesh& mesh, const Camera& camera, double threshold_px,
               std::vector<std::uint8_t>* removable = nullptr) {
  const RayDevice device;
  const Mesh full = reference_mesh(terrain);
  const RaySurface reference(device, full), surface(device, mesh);
  return measure_slack(camera, reference, reference.look(camera), surface, threshold_px, removable);
}

TEST(Slack, OnAPlaneOnlyCornersAreNeeded) {
  const Terrain terrain = flat(9);
  std::vector<std::uint8_t> removable;
  const Slack slack = slack_of(terrain, reference_mesh(terrain), above(9), 0.1, &removable);
  EXPECT_EQ(slack.vertices, 81U);
  EXPECT_EQ(slack.removable, 77U);
  EXPECT_EQ(slack.not_judged, 0U);
  for (const std::size_t corner : {0U, 8U, 72U, 80U}) EXPECT_EQ(removable[corner], 0);
}

TEST(Slack, APeakIsNeededAndWhatLiesFlatIsNot) {
  Terrain terrain = flat(9);
  const std::size_t peak = terrain.index(4, 4);
  terrain.heights_m[peak] = 20;
  std::vector<std::uint8_t> removable;
  slack_of(terrain, reference_mesh(terrain), above(9), 0.5, &removable);
  EXPECT_EQ(removable[peak], 0);
  EXPECT_EQ(removable[terrain.index(1, 1)], 1);
}

TEST(Slack, OutOfThePictureNothingIsNeeded) {
  const Terrain terrain = rough(9, 3);
  const Camera away = make_camera({40, 40, 100}, {4000, 40, 100}, 30, 160, 160);
  const Slack slack = slack_of(terrain, reference_mesh(terrain), away, 1);
  EXPECT_EQ(slack.in_view, 0U);
  EXPECT_EQ(slack.share_in_view(), 0);
  EXPECT_GT(slack.removable, 49U);  // all inside, and what stands on straight sides
}

TEST(Slack, MoreToleranceNeverNeedsMore) {
  const Terrain terrain = rough(17, 4);
  std::size_t before = 0;
  for (const double threshold_px : {0.01, 0.5, 1.0, 2.0, 4.0, 8.0, 1000.0}) {
    const Slack slack = slack_of(terrain, reference_mesh(terrain), above(17), threshold_px);
    EXPECT_GE(slack.removable, before);
    before = slack.removable;
  }
  EXPECT_EQ(before, 17U * 17U - 4U);
}

TEST(Slack, TurnedAndDoubledTrianglesAreNotJudged) {
  const Terrain terrain = flat(5);
  Mesh mesh = reference_mesh(terrain);
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  EXPECT_EQ(slack_of(terrain, mesh, above(5), 1).not_judged, 3U);
  mesh = reference_mesh(terrain);
  mesh.triangles.push_back(mesh.triangles[10]);
  EXPECT_EQ(slack_of(terrain, mesh, above(5), 1).not_judged, 3U);
}

/// The mesh without vertex v, its star filled by any convex order that keeps all triangles positive: tried
/// here by rotating a fan around each neighbour, which shares no code with the cutting of ears.
std::vector<Mesh> without(const Mesh& mesh, std::uint32_t v) {
  std::vector<std::array<std::uint32_t, 2>> spokes;
  Mesh rest;
  rest.positions = mesh.positions;
  for (const auto& t : mesh.triangles) {
    const auto at = std::find(t.begin(), t.end(), v);
    if (at == t.end()) {
      rest.triangles.push_back(t);
      continue;
    }
    const auto k = static_cast<std::size_t>(at - t.begin());
    spokes.push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  std::vector<std::uint32_t> ring{spokes.front()[0]};
  while (ring.size() < spokes.size()) {
    for (const auto& spoke : spokes) {
      if (spoke[0] == ring.back()) {
        ring.push_back(spoke[1]);
        break;
      }
    }
  }
  std::vector<Mesh> out;
  for (std::size_t start = 0; start < ring.size(); ++start) {
    Mesh filled = rest;
    bool sound = true;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      const std::uint32_t a = ring[start], b = ring[(start + k) % ring.size()],
                          c = ring[(start + k + 1) % ring.size()];
      const Vec3 pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
      sound = sound && (pb.x - pa.x) * (pc.y - pa.y) - (pb.y - pa.y) * (pc.x - pa.x) > 0;
      filled.triangles.push_back({a, b, c});
    }
    if (sound) out.push_back(std::move(filled));
  }
  return out;
}

/// Largest displacement by O3, over the whole picture.
double largest_px(const Terrain& terrain, const Mesh& mesh, const Camera& camera) {
  const RayDevice device;
  const Mesh full = reference_mesh(terrain);
  const RaySurface reference(device, full), surface(device, mesh);
  return image_error(camera, reference, reference.look(camera), surface, surface.look(camera), 1)
      .displacement_px.max;
}

TEST(Slack, AgreesWithReallyTakingOut) {
  const int side = 7;
  int needed = 0, not_needed = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Terrain terrain = rough(side, seed);
    const Mesh mesh = reference_mesh(terrain);
    const Camera camera = above(side);
    const double threshold_px = 2;
    std::vector<std::uint8_t> removable;
    slack_of(terrain, mesh, camera, threshold_px, &removable);
    for (int j = 1; j + 1 < side; ++j) {
      for (int i = 1; i + 1 < side; ++i) {
        const auto v = static_cast<std::uint32_t>(terrain.index(i, j));
        // The full mesh displaces nothing, so the threshold alone decides. Some filling keeps to it or none.
        double least_px = std::numeric_limits<double>::infinity();
        for (const Mesh& filled : without(mesh, v))
          least_px = std::min(least_px, largest_px(terrain, filled, camera));
        if (removable[v] != 0) {
          ++not_needed;
        } else {
          ++needed;
        }
        // A fan from one neighbour need not be the filling that was tried: but where even the best fan is far
        // over, or every fan is under, the two must say the same.
        double most_px = 0;
        for (const Mesh& filled : without(mesh, v))
          most_px = std::max(most_px, largest_px(terrain, filled, camera));
        if (most_px <= threshold_px) {
          EXPECT_EQ(removable[v], 1) << i << ", " << j << ", seed " << seed;
        }
        if (least_px > 2 * threshold_px) {
          EXPECT_EQ(removable[v], 0) << i << ", " << j << ", seed " << seed;
        }
      }
    }
  }
  EXPECT_GT(needed, 10);
  EXPECT_GT(not_needed, 10);
}

TEST(Slack, DoesNotDependOnTheOrderOfTriangles) {
  const Terrain terrain = rough(17, 9);
  Mesh mesh = reference_mesh(terrain);
  std::vector<std::uint8_t> before, after;
  slack_of(terrain, mesh, above(17), 1, &before);
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  for (auto& t : mesh.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  slack_of(terrain, mesh, above(17), 1, &after);
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace plumbline::oracle
