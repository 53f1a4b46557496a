// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figures of O3 against closed forms and planted faults.
#include "oracle/image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "image_scenes.h"

namespace plumbline::oracle {
namespace {

using namespace test;

/// Relative rounding allowed where a closed form is computed in another order: some thousand roundings.
constexpr double kRounding = 0x1p-40;

TEST(ImageError, EqualMeshesGiveExactlyZero) {
  for (const Terrain& terrain : {rugged(65, 30, 1500, 11), stepped(33, 10, 25), plane(17, 8)}) {
    const Mesh reference = reference_mesh(terrain);
    Mesh same = reference;  // listed otherwise: backwards, each triangle from another corner
    std::reverse(same.triangles.begin(), same.triangles.end());
    for (std::size_t t = 0; t < same.triangles.size(); ++t) {
      std::rotate(same.triangles[t].begin(), same.triangles[t].begin() + static_cast<int>(t % 3),
                  same.triangles[t].end());
    }
    std::size_t judged = 0;
    for (const Camera& camera : many_cameras(terrain, 160, 90)) {
      const Compared c = compare(camera, reference, same);
      expect_all_zero(c.error.displacement_px);
      expect_all_zero(c.error.parallax_px);
      expect_all_zero(c.error.depth_rel);
      EXPECT_EQ(c.error.over_threshold, 0);
      EXPECT_EQ(c.error.uncovered_px, 0U);
      EXPECT_EQ(c.error.silhouette_pixels, 0U);
      EXPECT_EQ(c.error.silhouette_max_px, 0);
      judged += c.error.displacement_px.count;
    }
    EXPECT_GT(judged, 10000U);
  }
}

TEST(ImageError, LiftedPlaneSeenFromStraightAbove) {
  // Height H over the plane, the mesh h above it: a pixel at distance r px from the picture's middle sees S
  // at lateral offset r·H/κ; S′ at depth H − h shows at r·H/(H − h): displacement r·h/(H − h).
  const double kHeight = 1000;
  const double kLift = 10;
  const Mesh reference = reference_mesh(plane(65, 64));
  const Mesh mesh = lifted(reference, kLift);
  for (const int width : {64, 321}) {
    const Camera camera =
        make_camera({2048.3, 2047.1, kHeight}, {2048.3, 2047.1, 0}, 60, width, width * 3 / 4);
    const Compared c = compare(camera, reference, mesh, 0.5);
    double greatest = 0;
    double sum = 0;
    std::size_t over = 0;
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const double dx = x + 0.5 - camera.width_px * 0.5;
        const double dy = y + 0.5 - camera.height_px * 0.5;
        const double expected = std::sqrt(dx * dx + dy * dy) * kLift / (kHeight - kLift);
        EXPECT_NEAR(c.maps.displacement_px.at(x, y), expected, expected * 0x1p-23);  // the map is of floats
        greatest = std::max(greatest, expected);
        sum += expected;
        over += expected > 0.5 ? 1U : 0U;
      }
    }
    const auto pixels = static_cast<double>(c.error.displacement_px.count);
    EXPECT_EQ(c.error.displacement_px.count, c.maps.displacement_px.values.size());
    EXPECT_NEAR(c.error.displacement_px.max, greatest, greatest * kRounding * 100);
    EXPECT_NEAR(c.error.displacement_px.mean, sum / pixels, sum / pixels * kRounding * 100);
    EXPECT_EQ(c.error.over_threshold, static_cast<double>(over) / pixels);
    // The same ray meets the mesh at depth H − h.
    EXPECT_NEAR(c.error.depth_rel.max, kLift / kHeight, kRounding);
    EXPECT_NEAR(c.error.depth_rel.mean, kLift / kHeight, kRounding);
    // Moved aside by 1 % of H: κ · 0.01·H · |1/H − 1/(H − h)|.
    const double parallax = camera.kappa_px * 0.01 * kLift / (kHeight - kLift);
    EXPECT_NEAR(c.error.parallax_px.max, parallax, parallax * kRounding * 100);
    EXPECT_NEAR(c.error.parallax_px.rms, parallax, parallax * kRounding * 100);
  }
}

TEST(ImageError, LiftedPlaneSeenLevelInTheMiddleColumn) {
  // A level camera at height H: the pixel v px below the middle sees S at depth H·κ/v; S′ lifted by h shows
  // h·κ/depth = h·v/H higher, without any change of depth.
  const Mesh reference = reference_mesh(plane(257, 64));
  const double kHeight = 100;
  const double kLift = 2;
  const Camera camera = make_camera({8192, 10, kHeight}, {8192, 1000, kHeight}, 60, 200, 150);
  const Compared c = compare(camera, reference, lifted(reference, kLift));
  int judged = 0;
  for (int y = 80; y < 150; ++y) {
    for (const int x : {0, 60, 199}) {
      const double below_px = y + 0.5 - 75;
      const float px = c.maps.displacement_px.at(x, y);
      if (std::isnan(px)) continue;
      ++judged;
      EXPECT_NEAR(px, kLift * below_px / kHeight, 0x1p-22);
    }
  }
  EXPECT_GT(judged, 150);
  EXPECT_EQ(c.error.uncovered_px, 0U);
}

TEST(ImageError, FinerPicturesConvergeOnTheMeanDisplacement) {
  const Terrain terrain = rugged(65, 30, 600, 12);
  const Mesh reference = reference_mesh(terrain);
  const Mesh mesh = coarse_mesh(terrain, 4);
  const auto mean_by_height = [&](int height) {  // in units of the picture's height
    const Camera camera = make_camera({960, -400, 1800}, {960, 960, 300}, 50, height * 4 / 3, height);
    return compare(camera, reference, mesh).error.displacement_px.mean / height;
  };
  const double finest = mean_by_height(480);
  EXPECT_GT(finest, 0);
  // Errors of sampling shrink with the pixel's size; at 120 rows they are below 2 %, at 240 below 1 % of the
  // mean.
  EXPECT_NEAR(mean_by_height(120), finest, 0.02 * finest);
  EXPECT_NEAR(mean_by_height(240), finest, 0.01 * finest);
}

TEST(ImageError, PlantedHeightFaultIsFoundAtItsPixel) {
  // From height 1000, one vertex raised so that it shows 5 px outwards from where it was.
  const Terrain terrain = plane(65, 32);
  const Mesh reference = reference_mesh(terrain);
  const Camera camera = make_camera({1024, 1024, 1000}, {1024, 1024, 0}, 60, 640, 480);
  const std::size_t vertex = terrain.index(36, 32);
  const Vec2 at = camera.project(reference.positions[vertex]);
  const double offset_px = at.x - 320;  // r: the displacement is r·h/(H − h) = 5
  Mesh mesh = reference;
  mesh.positions[vertex].z = 5.0 * 1000 / (offset_px + 5.0);
  const Compared c = compare(camera, reference, mesh, 1);
  // The nearest pixel centre is at most √½ px away; across the 32 m cells (27 px) the fault falls off
  // linearly.
  EXPECT_GT(c.error.displacement_px.max, 4.6);
  EXPECT_LE(c.error.displacement_px.max, 5.0 * (1 + kRounding));
  const auto& values = c.maps.displacement_px.values;
  const auto place =
      static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  EXPECT_NEAR(static_cast<double>(place % 640) + 0.5, at.x, 1);
  EXPECT_NEAR(static_cast<double>(place / 640) + 0.5, at.y, 1);
  // Nothing beside the vertex's six triangles.
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      if (std::fabs(x + 0.5 - at.x) > 28.5 || std::fabs(y + 0.5 - at.y) > 28.5) {
        ASSERT_EQ(c.maps.displacement_px.at(x, y), 0) << x << " " << y;
      }
    }
  }
}

TEST(ImageError, RemovedPatchCountsAsUncovered) {
  const Terrain terrain = plane(9, 16);
  const Mesh reference = reference_mesh(terrain);
  Mesh mesh = reference;
  // Cell (3, 4): two triangles. Seen from above at 8 px a metre·… a cell is κ·16/128 px wide.
  const std::size_t cell = 2 * (4 * 8 + 3);
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(cell),
                       mesh.triangles.begin() + static_cast<std::ptrdiff_t>(cell) + 2);
  Camera camera = make_camera({64, 64, 128}, {64, 64, 0}, 60, 160, 120);
  camera.kappa_px = 80;  // 16 m at depth 128 m: exactly 10 px, cell corners on pixel corners
  const Compared c = compare(camera, reference, mesh);
  EXPECT_EQ(c.error.uncovered_px, 100U);
  EXPECT_EQ(c.error.displacement_px.count + c.error.uncovered_px,
            static_cast<std::size_t>(std::count_if(c.reference_hits.triangle.begin(),
                                                   c.reference_hits.triangle.end(),
                                                   [](std::uint32_t t) { return t != PixelHits::kNoHit; })));
  expect_all_zero(c.error.displacement_px);
  // Through the hole there is sky: 100 pixels, the furthest 5 px from the rim, its centre: the nearest
  // terrain pixel's centre is 5 px away along the axis.
  EXPECT_EQ(c.error.silhouette_pixels, 100U);
  EXPECT_EQ(c.error.silhouette_max_px, 5);
}

TEST(ImageError, EmptyMeshLeavesEverythingUncovered) {
  const Mesh reference = reference_mesh(plane(9, 16));
  const Camera camera = make_camera({64, 64, 50}, {64, 64, 0}, 60, 30, 20);
  const Compared c = compare(camera, reference, Mesh{});
  EXPECT_EQ(c.error.uncovered_px, 600U);
  EXPECT_EQ(c.error.displacement_px.count, 0U);
  EXPECT_EQ(c.error.depth_rel.count, 0U);
  EXPECT_EQ(c.error.over_threshold, 0);
  EXPECT_EQ(c.error.silhouette_pixels, 600U);
  EXPECT_DOUBLE_EQ(c.error.silhouette_max_px, std::sqrt(30.0 * 30 + 20 * 20));
}

TEST(ImageError, AllSkyJudgesNothing) {
  const Mesh reference = reference_mesh(plane(9, 16));
  const Camera camera = make_camera({64, 64, 50}, {64, 64, 100}, 60, 30, 20);
  const Compared c = compare(camera, reference, reference);
  EXPECT_EQ(c.error.displacement_px.count, 0U);
  EXPECT_EQ(c.error.uncovered_px, 0U);
  EXPECT_EQ(c.error.silhouette_pixels, 0U);
  EXPECT_TRUE(std::all_of(c.maps.displacement_px.values.begin(), c.maps.displacement_px.values.end(),
                          [](float v) { return std::isnan(v); }));
}

TEST(ImageError, SkyLineLoweredByWholePixels) {
  // A wall whose top edge shows n px lower in the mesh: n rows of pixels, the furthest n px from the mesh's
  // terrain.
  const auto wall = [](double top) {
    Mesh mesh;
    mesh.positions = {{-500, 100, -500}, {500, 100, -500}, {500, 101, top}, {-500, 101, top}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
  };
  Camera camera = make_camera({0, 0, 0}, {0, 100, 0}, 60, 64, 48);
  camera.kappa_px = 101;  // 1 px a metre at the wall's top
  for (const int lowered : {1, 3, 10}) {
    const Compared c = compare(camera, wall(0), wall(-lowered));
    EXPECT_EQ(c.error.silhouette_pixels, 64U * static_cast<std::size_t>(lowered));
    EXPECT_EQ(c.error.silhouette_max_px, lowered);
    const Compared back = compare(camera, wall(-lowered), wall(0));
    EXPECT_EQ(back.error.silhouette_pixels, c.error.silhouette_pixels);
    EXPECT_EQ(back.error.silhouette_max_px, lowered);
  }
}

TEST(ImageError, HitsOfAnotherPictureAreRefused) {
  const Mesh mesh = reference_mesh(plane(9, 16));
  const RayDevice device;
  const RaySurface surface(device, mesh);
  const Camera camera = make_camera({64, 64, 50}, {64, 64, 0}, 60, 30, 20);
  Camera wider = camera;
  wider.width_px = 31;
  const PixelHits hits = surface.look(camera);
  EXPECT_THROW(static_cast<void>(image_error(wider, surface, hits, surface, hits, 1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(pop(wider, surface, hits, surface)), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::oracle
