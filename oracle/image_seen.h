// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "oracle/image.h"
#include "oracle/image_plan_index.h"
#include "oracle/image_surface.h"
#include "oracle/image_view.h"

namespace plumbline::oracle {

/// Throws std::invalid_argument if the hits are not of the camera's size.
inline void check_size(const Camera& camera, const PixelHits& hits) {
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

}  // namespace plumbline::oracle
