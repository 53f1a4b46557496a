// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenarios/camera.h"

// The one place where it is decided, in double, whether a ray of a camera meets a triangle, and how far away.
// Every route to a hit (scan conversion, Embree's candidates, the brute force of the tests) calls these few
// lines, so all of them see the same bits.

namespace plumbline::oracle {

/// A camera's frame, its axes worked out once.
struct View {
  Vec3 position, right, up, forward;
  double kappa_px, middle_x_px, middle_y_px;

  explicit View(const Camera& camera)
      : position(camera.position),
        right(camera.right()),
        up(camera.up),
        forward(camera.forward),
        kappa_px(camera.kappa_px),
        middle_x_px(camera.width_px * 0.5),
        middle_y_px(camera.height_px * 0.5) {}

  /// World to camera frame: x right, y up, z along `forward`; metres.
  [[nodiscard]] Vec3 local(Vec3 p) const {
    const Vec3 v = p - position;
    return {dot(v, right), dot(v, up), dot(v, forward)};
  }
  /// The ray through picture coordinates (x, y) is t · (ray_x(x), ray_y(y), 1) in the camera frame; t is the
  /// depth.
  [[nodiscard]] double ray_x(double x_px) const { return (x_px - middle_x_px) / kappa_px; }
  [[nodiscard]] double ray_y(double y_px) const { return -((y_px - middle_y_px) / kappa_px); }
  /// π of a point of the camera frame. Requires: p.z > 0.
  [[nodiscard]] Vec2 project_local(Vec3 p) const {
    return {middle_x_px + kappa_px * p.x / p.z, middle_y_px - kappa_px * p.y / p.z};
  }
  /// The world point at `depth_m` on the ray (x, y, 1).
  [[nodiscard]] Vec3 world(double x, double y, double depth_m) const {
    return position + (forward + right * x + up * y) * depth_m;
  }
};

/// A vertical segment that reaches nearer to the camera's plane than this share of its start's depth is cut
/// there: what lies at or behind the plane has no place in the picture, and a figure must stay finite.
inline constexpr double kNearestShare = 0x1p-10;

/// Length in the picture of the vertical segment from `from` to height `to_z_m`, pixels; exactly 0 if the
/// heights are equal. Requires: depth of `from` > 0.
inline double vertical_length_px(const View& view, Vec3 from, double to_z_m) {
  const Vec3 start = view.local(from);
  Vec3 end = view.local({from.x, from.y, to_z_m});
  const double nearest = start.z * kNearestShare;
  if (end.z < nearest) {
    const double share = (start.z - nearest) / (start.z - end.z);
    end = view.local({from.x, from.y, from.z + (to_z_m - from.z) * share});
    end.z = std::max(end.z, nearest);
  }
  // Without the picture's middle, which would round differently left and right of it.
  const double dx = view.kappa_px * end.x / end.z - view.kappa_px * start.x / start.z;
  const double dy = view.kappa_px * end.y / end.z - view.kappa_px * start.y / start.z;
  return std::sqrt(dx * dx + dy * dy);
}

/// A triangle in a camera's frame, as three edge functions of the ray (x, y, 1): e_a = ray · (b × c) and so
/// on round the corners a, b, c.
///
/// In IEEE arithmetic without contraction b × c is exactly −(c × b), component by component, and so are the
/// inner products with a ray. Hence two triangles that share an edge (the same two positions, whatever their
/// indices) get edge values of equal size and opposite sign: a ray cannot slip between them, and the surface
/// is watertight in double, not within a tolerance.
struct EdgeFunctions {
  Vec3 a, b, c;       ///< b × c, c × a, a × b: the function of the edge opposite to the corner
  double az, bz, cz;  ///< the corners' depths, metres

  /// The corners in the camera's frame. Their order does not matter: they are sorted, so that a triangle's
  /// depth has the same bits whichever corner it begins with and whichever way it turns.
  EdgeFunctions(Vec3 corner_a, Vec3 corner_b, Vec3 corner_c) {
    if (before(corner_b, corner_a)) std::swap(corner_a, corner_b);
    if (before(corner_c, corner_b)) std::swap(corner_b, corner_c);
    if (before(corner_b, corner_a)) std::swap(corner_a, corner_b);
    a = cross(corner_b, corner_c);
    b = cross(corner_c, corner_a);
    c = cross(corner_a, corner_b);
    az = corner_a.z;
    bz = corner_b.z;
    cz = corner_c.z;
  }
  /// By depth, then up the picture; only then across it, so that a mirrored picture mostly keeps the order.
  static bool before(Vec3 p, Vec3 q) {
    if (p.z != q.z) return p.z < q.z;
    return p.y != q.y ? p.y < q.y : p.x < q.x;
  }

  /// An edge function's part that is the same along a row of pixels, and the whole of it.
  static double row_part(Vec3 edge, double y) { return edge.z + edge.y * y; }
  static double value(Vec3 edge, double x, double row) { return edge.x * x + row; }

  /// Depth at which the ray meets the closed triangle, metres, seen from either side; 0 or less, or NaN,
  /// where it does not. By Cramer's rule the edge functions are proportional to the hit's barycentric
  /// coordinates, so the depth is a weighted mean of the corners' and stays among them however grazing the
  /// ray. A triangle seen exactly edge-on (all functions zero) is not hit (0/0); its neighbours are.
  [[nodiscard]] double depth(double ea, double eb, double ec) const {
    const double least = std::min(ea, std::min(eb, ec));
    const double greatest = std::max(ea, std::max(eb, ec));
    if (!(least >= 0 || greatest <= 0)) return 0;
    return ((ea * az + eb * bz) + ec * cz) / ((ea + eb) + ec);
  }
  [[nodiscard]] double depth_at(double x, double y) const {
    return depth(value(a, x, row_part(a, y)), value(b, x, row_part(b, y)), value(c, x, row_part(c, y)));
  }
};

}  // namespace plumbline::oracle
