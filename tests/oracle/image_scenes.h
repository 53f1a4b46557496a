// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "oracle/image.h"
#include "oracle/image_view.h"
#include "scenarios/camera.h"
#include "scenarios/mesh.h"
#include "scenarios/random.h"
#include "scenarios/terrain.h"

// Scenes and slow obvious routes for the tests of the image oracle.

namespace plumbline::oracle::test {

inline Terrain terrain_of(int columns, int rows, double spacing_m,
                          const std::function<double(int, int)>& height) {
  Terrain terrain;
  terrain.columns = columns;
  terrain.rows = rows;
  terrain.spacing_m = spacing_m;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) terrain.heights_m.push_back(height(i, j));
  }
  return terrain;
}

/// Several octaves of lattice noise, coarse ones higher: rugged ground with ridges behind ridges.
inline Terrain rugged(int side, double spacing_m, double relief_m, std::uint64_t seed) {
  return terrain_of(side, side, spacing_m, [&](int i, int j) {
    double z = 0;
    double amplitude = relief_m;
    for (int cell = side / 2; cell >= 1; cell /= 2, amplitude /= 2) {
      const auto corner = [&](int a, int b) {
        return static_cast<double>(lattice_hash(seed + static_cast<std::uint64_t>(cell), a, b) >> 11) *
               0x1p-53;
      };
      const int a = i / cell;
      const int b = j / cell;
      const double s = static_cast<double>(i % cell) / cell;
      const double t = static_cast<double>(j % cell) / cell;
      z += amplitude * ((1 - s) * ((1 - t) * corner(a, b) + t * corner(a, b + 1)) +
                        s * ((1 - t) * corner(a + 1, b) + t * corner(a + 1, b + 1)));
    }
    return z;
  });
}

/// Terraces with walls one cell wide: long silhouettes, and faces that a ray along the ground grazes.
inline Terrain stepped(int side, double spacing_m, double step_m) {
  return terrain_of(side, side, spacing_m,
                    [&](int i, int j) { return step_m * (((i / 4) * 7 + (j / 5) * 3) % 6); });
}

/// Every `stride`-th sample of a terrain as a mesh.
inline Mesh coarse_mesh(const Terrain& terrain, int stride) {
  Terrain coarse =
      terrain_of((terrain.columns - 1) / stride + 1, (terrain.rows - 1) / stride + 1,
                 terrain.spacing_m * stride, [&](int i, int j) { return terrain.z(i * stride, j * stride); });
  return reference_mesh(coarse);
}

/// All triangles on all pixels, in one plain loop.
inline PixelHits look_by_brute_force(const Mesh& mesh, const Camera& camera) {
  const View view(camera);
  PixelHits hits;
  hits.width = camera.width_px;
  hits.height = camera.height_px;
  const std::size_t pixels =
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  hits.triangle.assign(pixels, PixelHits::kNoHit);
  hits.depth_m.assign(pixels, std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const EdgeFunctions edges(view.local(mesh.positions[v[0]]), view.local(mesh.positions[v[1]]),
                              view.local(mesh.positions[v[2]]));
    std::size_t pixel = 0;
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x, ++pixel) {
        const double depth = edges.depth_at(view.ray_x(x + 0.5), view.ray_y(y + 0.5));
        if (depth > 0 && depth < hits.depth_m[pixel]) {
          hits.depth_m[pixel] = depth;
          hits.triangle[pixel] = static_cast<std::uint32_t>(t);
        }
      }
    }
  }
  return hits;
}

/// Cameras over a terrain: from above, oblique, along the ground to the horizon, from within a valley, from
/// afar.
inline std::vector<Camera> many_cameras(const Terrain& terrain, int width_px, int height_px) {
  const double w = terrain.width_m();
  const double d = terrain.depth_m();
  const double top = terrain.highest_m();
  const double relief = top - terrain.lowest_m() + terrain.spacing_m;
  const Vec3 middle{w / 2, d / 2, terrain.surface_height_m(w / 2, d / 2)};
  std::vector<Camera> cameras;
  const auto add = [&](Vec3 from, Vec3 to, double fov) {
    cameras.push_back(make_camera(from, to, fov, width_px, height_px));
  };
  add({w / 2, d / 2, top + w}, middle, 60);                 // straight down
  add({w / 4, -d / 3, top + relief}, middle, 60);           // oblique
  add({-w, -d / 2, top + 0.05 * relief}, {w, d, top}, 20);  // horizon
  add({0.31 * w, 0.27 * d, terrain.surface_height_m(0.31 * w, 0.27 * d) + 0.02 * relief}, {w, 0.9 * d, top},
      75);  // skim
  add({0.5 * w, 0.5 * d, middle.z + 0.01 * terrain.spacing_m}, {0.1 * w, 0.2 * d, middle.z},
      110);                                                                   // a mouse's view
  add({-400 * w, 30 * d, top + 200 * w}, middle, 0.2);                        // from afar
  add({w / 2, d / 2, terrain.lowest_m() - relief}, {w / 2 + 1, d, top}, 90);  // from below
  add({1.5 * w, d / 2, top}, {0, d / 2, top}, 5);                             // exactly level
  return cameras;
}

inline bool same_hits(const PixelHits& a, const PixelHits& b) {
  return a.width == b.width && a.height == b.height && a.triangle == b.triangle && a.depth_m == b.depth_m;
}

struct Compared {
  ImageError error;
  ImageMaps maps;
  PixelHits reference_hits, mesh_hits;
};

inline Compared compare(const Camera& camera, const Mesh& reference, const Mesh& mesh,
                        double threshold_px = 1) {
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

inline void expect_all_zero(const PixelFigure& figure) {
  EXPECT_EQ(figure.max, 0);
  EXPECT_EQ(figure.p999, 0);
  EXPECT_EQ(figure.p99, 0);
  EXPECT_EQ(figure.rms, 0);
  EXPECT_EQ(figure.mean, 0);
}

inline bool same_figure(const PixelFigure& a, const PixelFigure& b) {
  return a.max == b.max && a.p999 == b.p999 && a.p99 == b.p99 && a.rms == b.rms && a.mean == b.mean &&
         a.count == b.count;
}

inline Mesh lifted(Mesh mesh, double height_m) {
  for (Vec3& p : mesh.positions) p.z += height_m;
  return mesh;
}

inline Terrain plane(int side, double spacing_m) {
  return terrain_of(side, side, spacing_m, [](int, int) { return 0.0; });
}

}  // namespace plumbline::oracle::test
