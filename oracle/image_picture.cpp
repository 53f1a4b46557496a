// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What people look at: pictures of a surface, and where findings stand in them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/image.h"
#include "oracle/image_surface.h"

namespace plumbline::oracle {
namespace {

/// Light from the north-west, 45° above the horizon; a unit vector towards it: (−½, ½, √½).
const Vec3 kLight{-0.5, 0.5, std::sqrt(0.5)};
constexpr double kAmbient = 0.15;  ///< shade of a slope turned away from the light

constexpr double kLineHalfWidthPx = 0.75;
constexpr double kLineDarkness = 0.7;
/// Triangles whose heights in the picture come below this get fainter lines, else a crowd of them would be
/// black.
constexpr double kFullLineFromPx = 8;

/// How much the wireframe darkens a pixel, in [0, 1]: by its distance to the nearest edge of its triangle.
double line_weight(const View& view, const EdgeFunctions& edges, double x, double y) {
  double nearest = std::numeric_limits<double>::infinity();
  double furthest = 0;
  for (const Vec3& edge : {edges.a, edges.b, edges.c}) {
    const double slope = std::sqrt(edge.x * edge.x + edge.y * edge.y);
    const double value = std::fabs(EdgeFunctions::value(edge, x, EdgeFunctions::row_part(edge, y)));
    const double distance_px = slope > 0 ? value * view.kappa_px / slope : nearest;
    nearest = std::min(nearest, distance_px);
    furthest = std::max(furthest, distance_px);
  }
  const double cover = std::clamp(kLineHalfWidthPx + 0.5 - nearest, 0.0, 1.0);
  return cover * kLineDarkness * std::min(1.0, furthest / kFullLineFromPx);
}

/// A finding lies on the surface, and its own neighbourhood must not hide it: only what is nearer by more
/// than this share of its depth (far above the rounding of its coordinates) and by more than its own gap
/// does.
constexpr double kOcclusionShare = 0x1p-16;

}  // namespace

void locate_in_picture(const Camera& camera, const RaySurface& mesh, std::span<Finding> findings) {
  const View view(camera);
  for (Finding& finding : findings) {
    finding.gap_px = 0;
    if (!camera.sees(finding.at)) {
      finding.visibility = Visibility::outside;
      continue;
    }
    finding.gap_px = vertical_length_px(view, finding.at, finding.at.z - finding.gap_m);
    const double depth_m = camera.depth(finding.at);
    const Vec2 at = camera.project(finding.at);
    const RayHit hit = mesh.first_hit(camera, at.x, at.y);
    const bool hidden = hit.depth_m < depth_m * (1 - kOcclusionShare) - std::fabs(finding.gap_m);
    finding.visibility = hidden ? Visibility::occluded : Visibility::visible;
  }
}

Raster shade(const Camera& camera, const RaySurface& surface, const PixelHits& hits, bool wireframe) {
  const View view(camera);
  const Mesh& mesh = surface.mesh();
  Raster picture(hits.width, hits.height, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < hits.height; ++y) {
    for (int x = 0; x < hits.width; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(hits.width) + static_cast<std::size_t>(x);
      if (hits.triangle[pixel] == PixelHits::kNoHit) continue;
      const auto& v = mesh.triangles[hits.triangle[pixel]];
      const Vec3& a = mesh.positions[v[0]];
      const Vec3& b = mesh.positions[v[1]];
      const Vec3& c = mesh.positions[v[2]];
      Vec3 normal = cross(b - a, c - a);
      if (normal.z < 0) normal = -normal;
      const double size = length(normal);
      const double facing = size > 0 ? std::max(0.0, dot(normal, kLight) / size) : 0;
      double value = kAmbient + (1 - kAmbient) * facing;
      if (wireframe) {
        const EdgeFunctions edges(view.local(a), view.local(b), view.local(c));
        value *= 1 - line_weight(view, edges, view.ray_x(x + 0.5), view.ray_y(y + 0.5));
      }
      picture.values[pixel] = static_cast<float>(std::clamp(value, 0.0, 1.0));
    }
  }
  return picture;
}

}  // namespace plumbline::oracle
