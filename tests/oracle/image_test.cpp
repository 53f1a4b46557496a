// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figures of O3 against closed forms, planted faults, symmetries and slow routes.
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

struct Compared {
  ImageError error;
  ImageMaps maps;
  PixelHits reference_hits, mesh_hits;
};

Compared compare(const Camera& camera, const Mesh& reference, const Mesh& mesh, double threshold_px = 1) {
  const RayDevice device;
  const RaySurface a(device, reference);
  const RaySurface b(device, mesh);
  Compared result;
  result.reference_hits = a.look(camera);
  result.mesh_hits = b.look(camera);
  result.error =
      image_error(camera, a, result.reference_hits, b, result.mesh_hits, threshold_px, &result.maps);
  return result;
}

void expect_all_zero(const PixelFigure& figure) {
  EXPECT_EQ(figure.max, 0);
  EXPECT_EQ(figure.p999, 0);
  EXPECT_EQ(figure.p99, 0);
  EXPECT_EQ(figure.rms, 0);
  EXPECT_EQ(figure.mean, 0);
}

bool same_figure(const PixelFigure& a, const PixelFigure& b) {
  return a.max == b.max && a.p999 == b.p999 && a.p99 == b.p99 && a.rms == b.rms && a.mean == b.mean &&
         a.count == b.count;
}

Mesh lifted(Mesh mesh, double height_m) {
  for (Vec3& p : mesh.positions) p.z += height_m;
  return mesh;
}

Terrain plane(int side, double spacing_m) {
  return terrain_of(side, side, spacing_m, [](int, int) { return 0.0; });
}

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

TEST(ImageError, SilhouetteDistanceEqualsPlainSearch) {
  const Terrain terrain = rugged(33, 30, 900, 13);
  const Mesh reference = reference_mesh(terrain);
  const Mesh mesh = coarse_mesh(terrain, 8);
  std::size_t differing = 0;
  for (const Camera& camera : many_cameras(terrain, 96, 54)) {
    const Compared c = compare(camera, reference, mesh);
    const auto terrain_at = [](const PixelHits& hits, int x, int y) {
      return hits.triangle[static_cast<std::size_t>(y * hits.width + x)] != PixelHits::kNoHit;
    };
    std::size_t count = 0;
    double largest = 0;
    for (int y = 0; y < 54; ++y) {
      for (int x = 0; x < 96; ++x) {
        const bool a = terrain_at(c.reference_hits, x, y);
        if (a == terrain_at(c.mesh_hits, x, y)) continue;
        ++count;
        const PixelHits& sky = a ? c.mesh_hits : c.reference_hits;
        double nearest = std::sqrt(96.0 * 96 + 54 * 54);
        for (int v = 0; v < 54; ++v) {
          for (int u = 0; u < 96; ++u) {
            if (terrain_at(sky, u, v)) {
              nearest =
                  std::min(nearest, std::sqrt(static_cast<double>((u - x) * (u - x) + (v - y) * (v - y))));
            }
          }
        }
        largest = std::max(largest, nearest);
      }
    }
    EXPECT_EQ(c.error.silhouette_pixels, count);
    EXPECT_EQ(c.error.silhouette_max_px, largest);
    differing += count;
  }
  EXPECT_GT(differing, 100U);
}

TEST(ImageError, EveryFigureEqualsASlowRoute) {
  const Terrain terrain = rugged(33, 30, 700, 14);
  const Mesh reference = reference_mesh(terrain);
  Mesh mesh = coarse_mesh(terrain, 4);
  mesh.triangles.erase(mesh.triangles.begin() + 40, mesh.triangles.begin() + 47);  // and holes
  std::size_t judged = 0;
  for (const Camera& camera : many_cameras(terrain, 80, 45)) {
    const Compared c = compare(camera, reference, mesh, 2.0);
    std::vector<double> displacements;
    std::size_t uncovered = 0;
    for (int y = 0; y < 45; ++y) {
      for (int x = 0; x < 80; ++x) {
        const auto pixel = static_cast<std::size_t>(y * 80 + x);
        if (c.reference_hits.triangle[pixel] == PixelHits::kNoHit) continue;
        const Vec3 s =
            camera.position + camera.ray_direction(x + 0.5, y + 0.5) * c.reference_hits.depth_m[pixel];
        // The mesh's height over s by barycentric coordinates of whichever triangle holds it.
        double top = -std::numeric_limits<double>::infinity();
        for (const auto& t : mesh.triangles) {
          const Vec3 a = mesh.positions[t[0]];
          const Vec3 n = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
          bool inside = n.z > 0;
          for (std::size_t k = 0; k < 3 && inside; ++k) {
            const Vec3 p = mesh.positions[t[k]];
            const Vec3 q = mesh.positions[t[(k + 1) % 3]];
            inside = (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x) >= 0;
          }
          if (inside) top = std::max(top, a.z - (n.x * (s.x - a.x) + n.y * (s.y - a.y)) / n.z);
        }
        if (!std::isfinite(top)) {
          ++uncovered;
          EXPECT_TRUE(std::isnan(c.maps.displacement_px.values[pixel]));
          continue;
        }
        const Vec3 moved{s.x, s.y, top};
        if (camera.depth(moved) < camera.depth(s) * 0.01) continue;  // past the camera: another test
        const Vec2 p = camera.project(s);
        const Vec2 q = camera.project(moved);
        const double px = std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y));
        EXPECT_NEAR(c.maps.displacement_px.values[pixel], px, 1e-6 + 1e-6 * px);
        displacements.push_back(px);
      }
    }
    EXPECT_EQ(c.error.uncovered_px, uncovered);
    if (displacements.size() != c.error.displacement_px.count || displacements.empty()) continue;
    judged += displacements.size();
    std::sort(displacements.begin(), displacements.end());
    const auto rank = [&](double q) {
      return displacements[static_cast<std::size_t>(
                               std::ceil(q * static_cast<double>(displacements.size()))) -
                           1];
    };
    EXPECT_NEAR(c.error.displacement_px.max, displacements.back(), 1e-6 * displacements.back());
    EXPECT_NEAR(c.error.displacement_px.p999, rank(0.999), 1e-6 * displacements.back());
    EXPECT_NEAR(c.error.displacement_px.p99, rank(0.99), 1e-6 * displacements.back());
  }
  EXPECT_GT(judged, 5000U);
}

TEST(ImageError, ParallaxEqualsTheMovedCameras) {
  const Terrain terrain = rugged(33, 30, 700, 15);
  const Mesh reference = reference_mesh(terrain);
  const Mesh mesh = coarse_mesh(terrain, 4);
  const Camera camera = many_cameras(terrain, 80, 45)[1];
  const Compared c = compare(camera, reference, mesh);
  double depth_sum = 0;
  std::size_t both = 0;
  for (std::size_t i = 0; i < 80 * 45; ++i) {
    if (c.reference_hits.triangle[i] == PixelHits::kNoHit || c.mesh_hits.triangle[i] == PixelHits::kNoHit)
      continue;
    depth_sum += c.reference_hits.depth_m[i];
    ++both;
  }
  ASSERT_GT(both, 500U);
  Camera moved = camera;
  moved.position = camera.position + camera.right() * (0.01 * depth_sum / static_cast<double>(both));
  double greatest = 0;
  for (int y = 0; y < 45; ++y) {
    for (int x = 0; x < 80; ++x) {
      const auto i = static_cast<std::size_t>(y * 80 + x);
      if (c.reference_hits.triangle[i] == PixelHits::kNoHit || c.mesh_hits.triangle[i] == PixelHits::kNoHit)
        continue;
      const Vec3 way = camera.ray_direction(x + 0.5, y + 0.5);
      const Vec2 p = moved.project(camera.position + way * c.reference_hits.depth_m[i]);
      const Vec2 q = moved.project(camera.position + way * c.mesh_hits.depth_m[i]);
      greatest = std::max(greatest, std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y)));
    }
  }
  EXPECT_EQ(c.error.parallax_px.count, both);
  EXPECT_NEAR(c.error.parallax_px.max, greatest, 1e-9 * greatest);
}

TEST(ImageError, MeshThatPassesTheCameraStaysFinite) {
  const Mesh reference = reference_mesh(plane(9, 16));
  const Camera camera = make_camera({64, 64, 50}, {64, 64, 0}, 60, 31, 21);
  for (const double lift : {49.0, 50.0, 51.0, 1e9}) {
    const Compared c = compare(camera, reference, lifted(reference, lift));
    EXPECT_EQ(c.error.displacement_px.count, 31U * 21U);
    EXPECT_TRUE(std::isfinite(c.error.displacement_px.rms));
    EXPECT_GT(c.error.displacement_px.max, 500);
  }
}

TEST(ImageError, ScalingByPowersOfTwoChangesNoPixelFigure) {
  const Terrain terrain = rugged(33, 30, 700, 16);
  const Mesh reference = reference_mesh(terrain);
  const Mesh mesh = coarse_mesh(terrain, 4);
  for (const Camera& camera : many_cameras(terrain, 64, 36)) {
    const ImageError error = compare(camera, reference, mesh).error;
    for (const int power : {-20, 1, 30}) {
      const double scale = std::ldexp(1.0, power);
      Mesh a = reference;
      Mesh b = mesh;
      for (Vec3& p : a.positions) p = p * scale;
      for (Vec3& p : b.positions) p = p * scale;
      Camera scaled = camera;
      scaled.position = camera.position * scale;
      const ImageError other = compare(scaled, a, b).error;
      EXPECT_TRUE(same_figure(error.displacement_px, other.displacement_px));
      EXPECT_TRUE(same_figure(error.depth_rel, other.depth_rel));
      EXPECT_TRUE(same_figure(error.parallax_px, other.parallax_px));
      EXPECT_EQ(error.uncovered_px, other.uncovered_px);
      EXPECT_EQ(error.silhouette_pixels, other.silhouette_pixels);
      EXPECT_EQ(error.silhouette_max_px, other.silhouette_max_px);
    }
  }
}

TEST(ImageError, OrderOfTrianglesAndVerticesChangesNoFigure) {
  const Terrain terrain = rugged(33, 30, 700, 17);
  const Mesh reference = reference_mesh(terrain);
  const Mesh mesh = coarse_mesh(terrain, 2);
  Mesh shuffled;
  const std::size_t n = mesh.positions.size();
  for (std::size_t v = 0; v < n; ++v) shuffled.positions.push_back(mesh.positions[(v * 101 + 7) % n]);
  std::vector<std::uint32_t> place(n);
  for (std::size_t v = 0; v < n; ++v) place[(v * 101 + 7) % n] = static_cast<std::uint32_t>(v);
  ASSERT_NE(n % 101, 0U);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    const auto& v = mesh.triangles[t];
    shuffled.triangles.push_back({place[v[1]], place[v[2]], place[v[0]]});
  }
  for (const Camera& camera : many_cameras(terrain, 96, 54)) {
    const ImageError a = compare(camera, reference, mesh).error;
    const ImageError b = compare(camera, reference, shuffled).error;
    EXPECT_TRUE(same_figure(a.displacement_px, b.displacement_px));
    EXPECT_TRUE(same_figure(a.depth_rel, b.depth_rel));
    EXPECT_EQ(a.uncovered_px, b.uncovered_px);
    EXPECT_EQ(a.silhouette_pixels, b.silhouette_pixels);
  }
}

TEST(ImageError, FoldsAndOverlapsCountByTheirTop) {
  const Mesh reference = reference_mesh(plane(9, 16));
  Mesh mesh = reference;  // a second sheet 4 m above a part, turned over; a third below; a wall
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const double z : {4.0, -4.0}) {
    mesh.positions.insert(mesh.positions.end(), {{20, 20, z}, {90, 20, z}, {20, 90, z}});
  }
  mesh.triangles.push_back({first, first + 2, first + 1});
  mesh.triangles.push_back({first + 3, first + 4, first + 5});
  mesh.triangles.push_back({first + 1, first + 4, first + 2});
  const Camera camera = make_camera({64, 64, 80}, {64, 64, 0}, 60, 64, 48);
  const Compared c = compare(camera, reference, mesh);
  EXPECT_EQ(c.error.uncovered_px, 0U);
  std::size_t raised = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Vec3 s = camera.position + camera.ray_direction(x + 0.5, y + 0.5) * 80;
      const bool under = s.x >= 20 && s.y >= 20 && s.x + s.y <= 110;
      const double dx = x + 0.5 - 32;
      const double dy = y + 0.5 - 24;
      const double expected = under ? std::sqrt(dx * dx + dy * dy) * 4 / 76 : 0;
      EXPECT_NEAR(c.maps.displacement_px.at(x, y), expected, 1e-6);
      raised += under ? 1U : 0U;
    }
  }
  EXPECT_GT(raised, 200U);
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
