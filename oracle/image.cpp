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
#include "oracle/image_surface.h"

namespace plumbline::oracle {
namespace {

/// The moved camera of parallax_px stands aside by this share of the mean depth.
constexpr double kParallaxShare = 0.01;

void check_size(const Camera& camera, const PixelHits& hits) {
  const std::size_t pixels =
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  if (hits.width != camera.width_px || hits.height != camera.height_px || hits.triangle.size() != pixels ||
      hits.depth_m.size() != pixels) {
    throw std::invalid_argument("image oracle: the hits are not those of a picture of the camera's size");
  }
}

/// A surface's points as the pixels of one picture see them.
class SeenSurface {
 public:
  SeenSurface(const Camera& camera, const RaySurface& surface, const PixelHits& hits)
      : view_(camera), state_(surface.state()), hits_(hits) {
    check_size(camera, hits);
    for (int x = 0; x < camera.width_px; ++x) ray_x_.push_back(view_.ray_x(x + 0.5));
    for (int y = 0; y < camera.height_px; ++y) ray_y_.push_back(view_.ray_y(y + 0.5));
  }

  /// S of a pixel that is not sky. Its height is the one that a vertical look-up of the same surface gives,
  /// so that equal surfaces differ by exactly 0; the ray's own height would differ by its rounding.
  [[nodiscard]] Vec3 point(std::size_t x, std::size_t y, std::size_t pixel) const {
    Vec3 p = view_.world(ray_x_[x], ray_y_[y], hits_.depth_m[pixel]);
    const auto& corners = state_.mesh->triangles[hits_.triangle[pixel]];
    const Vec3& a = state_.mesh->positions[corners[0]];
    const Vec3& b = state_.mesh->positions[corners[1]];
    const Vec3& c = state_.mesh->positions[corners[2]];
    if (const auto height = height_over(a, b, c, {p.x, p.y})) {
      p.z = *height;
      return p;
    }
    // Rounding put the point beside its triangle: back into the triangle's box (at a border it would else
    // miss the whole mesh), then whatever lies there.
    p.x = std::clamp(p.x, std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}));
    p.y = std::clamp(p.y, std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}));
    p.z = state_.plan_index().nearest(*state_.mesh, {p.x, p.y}, p.z).value_or(p.z);
    return p;
  }
  /// Asks for the memory that the points some pixels further on will need: a reference of millions of
  /// triangles does not fit a cache, and neighbouring pixels see triangles of different rows.
  /// Inlined by order: as a call it has no effect that gcc knows of, and gcc 12 leaves it out.
  [[gnu::always_inline]] void fetch_ahead(std::size_t pixel) const {
    constexpr std::size_t kTriangle = 32, kCorners = 16;  // pixels ahead
    const std::vector<std::uint32_t>& seen = hits_.triangle;
    if (pixel + kTriangle >= seen.size()) return;
    if (seen[pixel + kTriangle] != PixelHits::kNoHit) {
      __builtin_prefetch(&state_.mesh->triangles[seen[pixel + kTriangle]]);
    }
    if (seen[pixel + kCorners] != PixelHits::kNoHit) {
      for (const std::uint32_t v : state_.mesh->triangles[seen[pixel + kCorners]]) {
        __builtin_prefetch(&state_.mesh->positions[v]);
      }
    }
  }
  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] const PixelHits& hits() const { return hits_; }

 private:
  View view_;
  const RaySurface::State& state_;
  const PixelHits& hits_;
  std::vector<double> ray_x_, ray_y_;
};

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
  // two hits, which share x, lie κ·s·|1/t − 1/t′| apart.
  const double moved_m =
      depth_rel.count() == 0 ? 0 : kParallaxShare * depth_sum / static_cast<double>(depth_rel.count());
  FigureBuilder parallax(depth_rel.count());
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t pixel = y * width; pixel < (y + 1) * width; ++pixel) {
      if (reference.triangle[pixel] == PixelHits::kNoHit || mesh.triangle[pixel] == PixelHits::kNoHit)
        continue;
      const double px =
          camera.kappa_px * std::fabs(moved_m / reference.depth_m[pixel] - moved_m / mesh.depth_m[pixel]);
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
