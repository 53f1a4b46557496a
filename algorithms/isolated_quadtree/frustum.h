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
  explicit Frustum(const Camera& camera) : eye_(camera.position) {
    const Vec3 aside = camera.forward * (camera.width_px * 0.5 / camera.kappa_px);
    const Vec3 above = camera.forward * (camera.height_px * 0.5 / camera.kappa_px);
    outward_ = {camera.right() - aside, camera.right() * -1.0 - aside, camera.up - above,
                camera.up * -1.0 - above, camera.forward * -1.0};
  }

  /// Whether the box lies wholly on the outer side of one plane: whether its innermost corner does.
  [[nodiscard]] bool excludes(Vec3 low, Vec3 high) const {
    return std::any_of(outward_.begin(), outward_.end(), [&](Vec3 n) {
      const Vec3 corner{n.x > 0 ? low.x : high.x, n.y > 0 ? low.y : high.y, n.z > 0 ? low.z : high.z};
      return dot(n, corner - eye_) > 0;
    });
  }

 private:
  Vec3 eye_;
  std::array<Vec3, 5> outward_;  ///< normals of the planes, of any length
};

}  // namespace plumbline::isolated_quadtree
