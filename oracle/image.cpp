// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures of O3 from two pictures. Everything is a plain double computation on hits that were decided
// before; definitions stand with ImageError. What is not verified here: whether the mesh covers each point
// once (O1), and how far it lies from the terrain where no pixel looks (O2).
#include "oracle/image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "oracle/image_figure.h"
#include "oracle/image_seen.h"
#include "oracle/image_surface.h"

namespace plumbline::oracle {
namespace {

/// The moved camera of parallax_px stands aside by this share of the mean depth.
constexpr double kParallaxShare = 0.01;

/// Calls judged(pixel, displacement px) or uncovered(pixel) for each pixel that sees the surface, end_row()
/// after a row.
template <typename Judged, typename Uncovered, typename EndRow>
void for_each_displacement(const SeenSurface& seen, const RaySurface& other, Judged&& judged,
                           Uncovered&& uncovered, EndRow&& end_row) {
  const auto width = static_cast<std::size_t>(seen.hits().width);
  const auto height = static_cast<std::size_t>(seen.hits().height);
  const PlanIndex& index = other.state().plan_index();
  PlanIndex::Cursor cursor;
  const Mesh& mesh = other.mesh();
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = y * width + x;
      seen.fetch_ahead(pixel);
      if (seen.hits().triangle[pixel] == PixelHits::kNoHit) continue;
      const Vec3 point = seen.point(x, y, pixel);
      if (!(seen.view().local(point).z > 0)) continue;
      if (const auto top = index.top(mesh, {point.x, point.y}, cursor)) {
        judged(pixel, vertical_length_px(seen.view(), point, *top));
      } else {
        uncovered(pixel);
      }
    }
    end_row();
  }
}

/// Figures along the same ray, where both surfaces are seen.
void compare_depths(const Camera& camera, const PixelHits& reference, const PixelHits& mesh,
                    ImageError& result, Raster* map = nullptr) {
  const auto width = static_cast<std::size_t>(camera.width_px);
  const auto height = static_cast<std::size_t>(camera.height_px);
  FigureBuilder depth_rel(width * height);
  double depth_sum = 0;
  for (std::size_t y = 0; y < height; ++y) {
    double row_sum = 0;
    for (std::size_t pixel = y * width; pixel < (y + 1) * width; ++pixel) {
      if (reference.triangle[pixel] == PixelHits::kNoHit || mesh.triangle[pixel] == PixelHits::kNoHit)
        continue;
      row_sum += reference.depth_m[pixel];
      depth_rel.add(std::fabs(mesh.depth_m[pixel] - reference.depth_m[pixel]) / reference.depth_m[pixel]);
    }
    depth_sum += row_sum;
    depth_rel.end_row();
  }
  // A camera moved by s to the right sees the point of ray (x, y, 1) at depth t in column κ·(x·t − s)/t: the
  // two hits, which share x, lie κ·s·|1/t − 1/t′| apart; written so that nothing cancels but the depths.
  const double moved_m =
      depth_rel.count() == 0 ? 0 : kParallaxShare * depth_sum / static_cast<double>(depth_rel.count());
  FigureBuilder parallax(depth_rel.count());
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t pixel = y * width; pixel < (y + 1) * width; ++pixel) {
      if (reference.triangle[pixel] == PixelHits::kNoHit || mesh.triangle[pixel] == PixelHits::kNoHit)
        continue;
      const double share = std::fabs(mesh.depth_m[pixel] - reference.depth_m[pixel]) / mesh.depth_m[pixel];
      const double px = camera.kappa_px * (moved_m / reference.depth_m[pixel]) * share;
      parallax.add(px);
      if (map != nullptr) map->values[pixel] = static_cast<float>(px);
    }
    parallax.end_row();
  }
  result.depth_rel = depth_rel.finish();
  result.parallax_px = parallax.finish();
}

}  // namespace

ImageError image_error(const Camera& camera, const RaySurface& reference, const PixelHits& reference_hits,
                       const RaySurface& mesh, const PixelHits& mesh_hits, double threshold_px,
                       ImageMaps* maps) {
  check_size(camera, mesh_hits);
  ImageError result;
  if (maps != nullptr) {
    maps->displacement_px =
        Raster(camera.width_px, camera.height_px, std::numeric_limits<float>::quiet_NaN());
  }
  const SeenSurface seen(camera, reference, reference_hits);
  FigureBuilder displacement(reference_hits.triangle.size());
  std::size_t over = 0;
  for_each_displacement(
      seen, mesh,
      [&](std::size_t pixel, double px) {
        displacement.add(px);
        over += px > threshold_px ? 1 : 0;
        if (maps != nullptr) maps->displacement_px.values[pixel] = static_cast<float>(px);
      },
      [&](std::size_t) { ++result.uncovered_px; }, [&] { displacement.end_row(); });
  if (displacement.count() > 0) {
    result.over_threshold = static_cast<double>(over) / static_cast<double>(displacement.count());
  }
  result.displacement_px = displacement.finish();
  compare_depths(camera, reference_hits, mesh_hits, result);
  const SilhouetteDifference silhouettes = compare_silhouettes(reference_hits, mesh_hits);
  result.silhouette_pixels = silhouettes.pixels;
  result.silhouette_max_px = silhouettes.max_px;
  return result;
}

ImageError ray_error(const Camera& camera, const PixelHits& reference_hits, const PixelHits& mesh_hits,
                     Raster* parallax_px) {
  check_size(camera, reference_hits);
  check_size(camera, mesh_hits);
  ImageError result;
  if (parallax_px != nullptr) {
    *parallax_px = Raster(camera.width_px, camera.height_px, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t pixel = 0; pixel < mesh_hits.triangle.size(); ++pixel) {
      if ((reference_hits.triangle[pixel] == PixelHits::kNoHit) !=
          (mesh_hits.triangle[pixel] == PixelHits::kNoHit))
        parallax_px->values[pixel] = std::numeric_limits<float>::infinity();
    }
  }
  compare_depths(camera, reference_hits, mesh_hits, result, parallax_px);
  const SilhouetteDifference silhouettes = compare_silhouettes(reference_hits, mesh_hits);
  result.silhouette_pixels = silhouettes.pixels;
  result.silhouette_max_px = silhouettes.max_px;
  return result;
}

PixelFigure pop(const Camera& camera, const RaySurface& now, const PixelHits& now_hits,
                const RaySurface& before) {
  const SeenSurface seen(camera, now, now_hits);
  FigureBuilder displacement(now_hits.triangle.size());
  for_each_displacement(
      seen, before, [&](std::size_t, double px) { displacement.add(px); }, [](std::size_t) {},
      [&] { displacement.end_row(); });
  return displacement.finish();
}

}  // namespace plumbline::oracle
