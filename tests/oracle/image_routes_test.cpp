// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figures of O3 against slow routes on small scenes, and what must not change them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "image_scenes.h"
#include "oracle/image.h"
#include "oracle/image_plan_index.h"

namespace plumbline::oracle {
namespace {

using namespace test;

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

TEST(HeightAt, EqualsTheTopOfAllTriangles) {
  // Random triangles of all sizes, overlapping, turned both ways, some without area: nothing to rely on.
  const RayDevice device;
  Random random(20);
  for (const std::size_t count : {1U, 7U, 60U, 1000U}) {
    Mesh mesh;
    for (std::size_t t = 0; t < count; ++t) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      const double size = std::ldexp(100.0, -static_cast<int>(random.below(8)));
      const Vec3 at{random.between(0, 100), random.between(0, 100), random.between(0, 50)};
      for (int k = 0; k < 3; ++k) {
        const double quarter = 0.25;  // corners on a lattice, so that points fall on edges and corners
        mesh.positions.push_back({std::floor(at.x + random.between(-size, size)) * quarter,
                                  std::floor(at.y + random.between(-size, size)) * quarter, at.z + k});
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const RaySurface surface(device, mesh);
    std::size_t covered = 0;
    for (int i = 0; i < 3000; ++i) {
      Vec2 p{random.between(-5, 30), random.between(-5, 30)};
      if (i % 2 == 0) p = {std::floor(p.x) * 0.5, std::floor(p.y) * 0.5};
      std::optional<double> top;
      for (const auto& t : mesh.triangles) {
        const auto height = height_over(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], p);
        if (height && (!top || *height > *top)) top = height;
      }
      EXPECT_EQ(surface.height_at(p), top);
      covered += top ? 1U : 0U;
    }
    if (count >= 60) {
      EXPECT_GT(covered, 500U);
    }
  }
}

TEST(HeightAt, ManyOverlappingTrianglesNeedLittleMemory) {
  // 20 000 triangles, each over most of the plan: an index that listed them in fine cells would hold
  // billions.
  const RayDevice device;
  Random random(21);
  Mesh mesh;
  for (std::uint32_t t = 0; t < 20000; ++t) {
    const double z = t;
    mesh.positions.insert(mesh.positions.end(), {{random.unit(), random.unit(), z},
                                                 {1000 - random.unit(), random.unit(), z},
                                                 {random.unit(), 1000 - random.unit(), z}});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const RaySurface surface(device, mesh);
  EXPECT_EQ(surface.height_at({300, 300}), 19999.0);
  EXPECT_FALSE(surface.height_at({900, 900}).has_value());
}

}  // namespace
}  // namespace plumbline::oracle
