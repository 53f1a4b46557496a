// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/vec.h"

namespace plumbline {

/// A pin-hole camera. Pixel (px, py) counts from the picture's top-left corner, y down; a pixel's ray goes
/// through its centre (px + ½, py + ½).
struct Camera {
  Vec3 position;          ///< metres
  Vec3 forward{0, 1, 0};  ///< unit
  Vec3 up{0, 0, 1};       ///< unit, orthogonal to forward
  double fov_y_deg = 60;  ///< vertical field of view, 0 < fov < 180
  int width_px = 1280;
  int height_px = 720;
  double kappa_px = 0;  ///< κ, pixels per unit tangent: height / (2 tan(fov_y/2)); set by make_camera

  [[nodiscard]] Vec3 right() const { return cross(forward, up); }
  /// depth(p) = (p − c)·f̂, metres; negative behind the camera.
  [[nodiscard]] double depth(Vec3 p) const { return dot(p - position, forward); }
  /// π(p): picture coordinates in pixels. Requires: depth(p) > 0.
  [[nodiscard]] Vec2 project(Vec3 p) const;
  /// Direction (not unit: its forward component is 1) of the ray through picture coordinates (x, y).
  [[nodiscard]] Vec3 ray_direction(double x_px, double y_px) const;
  /// Whether p projects into the picture: depth > 0 and 0 ≤ π(p) < viewport.
  [[nodiscard]] bool sees(Vec3 p) const;
  /// Whether the ball lies wholly outside the view cone: the circular cone around `forward` through the
  /// picture's corners. False when it may reach inside.
  [[nodiscard]] bool outside_view_cone(Vec3 center, double radius_m) const;
};

/// A camera at `position` looking at `look_at`, the picture's up direction nearest to +z (looking straight up
/// or down: to +y). Throws InputError if the two points coincide, a number is not finite, the field of view
/// is not inside (0, 180) degrees, or a side of the viewport is not inside [1, 16384] pixels.
Camera make_camera(Vec3 position, Vec3 look_at, double fov_y_deg, int width_px, int height_px);

}  // namespace plumbline
