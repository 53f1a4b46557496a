// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pop, where findings stand in a picture, and pictures for people.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "image_scenes.h"
#include "oracle/image.h"

namespace plumbline::oracle {
namespace {

using namespace test;

/// Relative rounding allowed where a closed form is computed in another order: some thousand roundings.
constexpr double kRounding = 0x1p-40;

TEST(Pop, IsTheDisplacementToTheFrameBefore) {
  const Mesh now = reference_mesh(plane(65, 64));
  const Camera camera = make_camera({2048, 2048, 1000}, {2048, 2048, 0}, 60, 64, 48);
  const RayDevice device;
  const RaySurface a(device, now);
  const PixelHits hits = a.look(camera);
  expect_all_zero(pop(camera, a, hits, a));
  EXPECT_EQ(pop(camera, a, hits, a).count, 64U * 48U);
  const Mesh before = lifted(now, -20);
  const RaySurface b(device, before);
  const double corner_px = std::sqrt(31.5 * 31.5 + 23.5 * 23.5);
  EXPECT_NEAR(pop(camera, a, hits, b).max, corner_px * 20 / 1020, corner_px * kRounding);
}

TEST(LocateInPicture, SaysOutsideOccludedVisibleAndTheGap) {
  // A hill between the camera and the second finding.
  Terrain terrain = plane(33, 10);
  for (int j = 15; j < 18; ++j) {
    for (int i = 0; i < 33; ++i) terrain.heights_m[terrain.index(i, j)] = 40;
  }
  const Mesh mesh = reference_mesh(terrain);
  const RayDevice device;
  const RaySurface surface(device, mesh);
  const Camera camera = make_camera({160, -20, 30}, {160, 200, 0}, 60, 320, 240);
  std::vector<Finding> findings(5);
  findings[0].at = {160, 60, 0};  // on the plane before the hill
  findings[0].gap_m = 0.5;
  findings[1].at = {160, 260, 0};  // behind the hill
  findings[1].gap_m = -2;
  findings[2].at = {160, -60, 0};  // behind the camera
  findings[2].gap_m = 3;
  findings[3].at = {100, 150, 40};  // on the hill's near edge, a ridge against the sky
  findings[4].at = {2000, 60, 0};   // beside the picture
  locate_in_picture(camera, surface, findings);
  EXPECT_EQ(findings[0].visibility, Visibility::visible);
  EXPECT_EQ(findings[1].visibility, Visibility::occluded);
  EXPECT_EQ(findings[2].visibility, Visibility::outside);
  EXPECT_EQ(findings[3].visibility, Visibility::visible);
  EXPECT_EQ(findings[4].visibility, Visibility::outside);
  const auto gap_px = [&](const Finding& f) {
    const Vec2 p = camera.project(f.at);
    const Vec2 q = camera.project({f.at.x, f.at.y, f.at.z - f.gap_m});
    return std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y));
  };
  EXPECT_NEAR(findings[0].gap_px, gap_px(findings[0]), 1e-9);
  EXPECT_NEAR(findings[1].gap_px, gap_px(findings[1]), 1e-9);
  EXPECT_EQ(findings[2].gap_px, 0);
  EXPECT_GT(findings[0].gap_px, 0.5);
}

TEST(LocateInPicture, EveryVertexThatAPictureShowsIsVisible) {
  // A vertex of a triangle that a pixel sees close to the vertex's own place is not hidden.
  const Terrain terrain = rugged(65, 30, 900, 18);
  const Mesh mesh = reference_mesh(terrain);
  for (const char* isa : {"", "sse2"}) {
    const RayDevice device(isa);
    const RaySurface surface(device, mesh);
    const Camera camera = many_cameras(terrain, 200, 150)[1];
    std::vector<Finding> findings;
    for (const Vec3 p : mesh.positions) findings.emplace_back().at = p;
    locate_in_picture(camera, surface, findings);
    std::size_t visible = 0;
    std::size_t occluded = 0;
    for (const Finding& finding : findings) {
      if (finding.visibility == Visibility::outside) continue;
      const Vec2 at = camera.project(finding.at);
      double nearest = std::numeric_limits<double>::infinity();
      const View view(camera);
      for (const auto& t : mesh.triangles) {  // brute force
        const EdgeFunctions edges(view.local(mesh.positions[t[0]]), view.local(mesh.positions[t[1]]),
                                  view.local(mesh.positions[t[2]]));
        const double depth = edges.depth_at(view.ray_x(at.x), view.ray_y(at.y));
        if (depth > 0) nearest = std::min(nearest, depth);
      }
      const bool hidden = nearest < camera.depth(finding.at) * (1 - 0x1p-16);
      EXPECT_EQ(finding.visibility, hidden ? Visibility::occluded : Visibility::visible);
      (hidden ? occluded : visible) += 1;
    }
    EXPECT_GT(visible, 500U);
    EXPECT_GT(occluded, 100U);
  }
}

TEST(Shade, LightFromTheNorthWestAndDarkLines) {
  Mesh mesh;  // a roof with ridge along the north-east, and no sky but a border
  mesh.positions = {{0, 0, 0}, {100, 100, 0}, {0, 100, -50}, {100, 0, -50}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  const RayDevice device;
  const RaySurface surface(device, mesh);
  const Camera camera = make_camera({50, 50, 120}, {50, 50, 0}, 60, 160, 120);
  const PixelHits hits = surface.look(camera);
  const Raster plain = shade(camera, surface, hits, false);
  const Raster wire = shade(camera, surface, hits, true);
  EXPECT_TRUE(std::isnan(plain.at(0, 0)));
  EXPECT_GT(plain.at(60, 40), plain.at(100, 80) + 0.3F);  // north-west slope against south-east slope
  std::size_t darker = 0;
  for (std::size_t i = 0; i < plain.values.size(); ++i) {
    if (std::isnan(plain.values[i])) continue;
    EXPECT_GE(plain.values[i], 0);
    EXPECT_LE(plain.values[i], 1);
    EXPECT_LE(wire.values[i], plain.values[i]);
    darker += wire.values[i] < plain.values[i] * 0.6F ? 1U : 0U;
  }
  // Five edges of some 90 to 130 px, lines about 1½ px wide.
  EXPECT_GT(darker, 250U);
  EXPECT_LT(darker, 2000U);
  EXPECT_EQ(wire.at(60, 40), plain.at(60, 40));
}

}  // namespace
}  // namespace plumbline::oracle
