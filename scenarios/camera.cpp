// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/camera.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/portable_math.h"

namespace plumbline {

Vec2 Camera::project(Vec3 p) const {
  const Vec3 v = p - position;
  const double depth_m = dot(v, forward);
  return {width_px * 0.5 + kappa_px * dot(v, right()) / depth_m,
          height_px * 0.5 - kappa_px * dot(v, up) / depth_m};
}

Vec3 Camera::ray_direction(double x_px, double y_px) const {
  return forward + right() * ((x_px - width_px * 0.5) / kappa_px) -
         up * ((y_px - height_px * 0.5) / kappa_px);
}

bool Camera::sees(Vec3 p) const {
  if (depth(p) <= 0) return false;
  const Vec2 q = project(p);
  return q.x >= 0 && q.y >= 0 && q.x < width_px && q.y < height_px;
}

bool Camera::outside_view_cone(Vec3 center, double radius_m) const {
  // Tangent of the half angle to the picture's corner; the cone's apex is the camera.
  const double corner_px = std::sqrt(0.25 * width_px * width_px + 0.25 * height_px * height_px);
  const double tangent = corner_px / kappa_px;
  const double cosine = 1 / std::sqrt(1 + tangent * tangent);
  const double sine = tangent * cosine;
  const Vec3 v = center - position;
  const double along = dot(v, forward);
  const double aside = std::sqrt(std::max(0.0, dot(v, v) - along * along));
  // Signed distance to the cone's surface, positive outside; behind the apex it underestimates, which keeps
  // more.
  const double distance = aside * cosine - along * sine;
  return distance > radius_m;
}

Camera make_camera(Vec3 position, Vec3 look_at, double fov_y_deg, int width_px, int height_px) {
  for (const double v : {position.x, position.y, position.z, look_at.x, look_at.y, look_at.z}) {
    if (!std::isfinite(v)) throw InputError("camera: a coordinate is not finite; give finite metres");
  }
  if (!(fov_y_deg > 0 && fov_y_deg < 180)) {
    throw InputError(fmt::format("camera: field of view {} is not inside (0, 180) degrees", fov_y_deg));
  }
  for (const int side : {width_px, height_px}) {
    if (side < 1 || side > 16384) {
      throw InputError(fmt::format("camera: viewport side {} is not inside [1, 16384] pixels", side));
    }
  }
  Vec3 way = look_at - position;
  const double longest = std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)});
  if (!(longest > 0)) throw InputError("camera: position and look_at coincide; move one of them");
  if (!std::isfinite(longest)) throw InputError("camera: look_at is too far from position; move it nearer");
  // Squares must neither overflow nor underflow; a power of two changes no digit.
  if (longest > 0x1p+500) way = way * 0x1p-600;
  if (longest < 0x1p-450) way = way * 0x1p+600;
  Camera camera;
  camera.position = position;
  camera.forward = way * (1 / length(way));
  const bool vertical = camera.forward.x == 0 && camera.forward.y == 0;
  const Vec3 hint = vertical ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  Vec3 across = cross(camera.forward, hint);
  if (dot(across, across) < 0x1p-900) across = across * 0x1p+900;
  const Vec3 right = normalized(across);
  camera.up = normalized(cross(right, camera.forward));
  camera.fov_y_deg = fov_y_deg;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.kappa_px = height_px / (2 * exact_tan(fov_y_deg * kRadiansPerDegree / 2));
  if (!std::isfinite(camera.kappa_px))
    throw InputError(fmt::format("camera: field of view {} is too narrow; give more degrees", fov_y_deg));
  return camera;
}

}  // namespace plumbline
