// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

#include "scenarios/camera.h"
#include "scenarios/vec.h"

namespace plumbline::isolated_quadtree {

/// The view frustum's four sides and the plane through the eye.
class Frustum {
 public:
  explicit Frustum(const Camera& camera)
      : eye_(camera.position),
        forward_(camera.forward),
        right_(camera.right()),
        up_(camera.up),
        tan_x_(camera.width_px * 0.5 / camera.kappa_px),
        tan_y_(camera.height_px * 0.5 / camera.kappa_px) {}

  /// Whether the box lies wholly on the outer side of one plane.
  [[nodiscard]] bool excludes(Vec3 low, Vec3 high) const {
    std::array<int, 5> outside{};
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 v =
          Vec3{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z} - eye_;
      const double depth = dot(v, forward_);
      const double x = dot(v, right_);
      const double y = dot(v, up_);
      outside[0] += x > depth * tan_x_ ? 1 : 0;
      outside[1] += -x > depth * tan_x_ ? 1 : 0;
      outside[2] += y > depth * tan_y_ ? 1 : 0;
      outside[3] += -y > depth * tan_y_ ? 1 : 0;
      outside[4] += depth <= 0 ? 1 : 0;
    }
    return std::find(outside.begin(), outside.end(), 8) != outside.end();
  }

 private:
  Vec3 eye_, forward_, right_, up_;
  double tan_x_, tan_y_;
};

}  // namespace plumbline::isolated_quadtree
