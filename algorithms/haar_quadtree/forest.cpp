// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/haar_quadtree/forest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::haar_quadtree {

Forest::Forest(const Terrain& terrain, int leaf_level)
    : leaf_level_(leaf_level),
      patches_x_((terrain.columns - 1) >> leaf_level),
      patches_y_((terrain.rows - 1) >> leaf_level),
      spacing_m_(terrain.spacing_m) {
  std::size_t total = 0;
  for (int level = 0; level <= leaf_level_; ++level) {
    first_.push_back(total);
    total += static_cast<std::size_t>(columns(level)) * static_cast<std::size_t>(rows(level));
  }
  first_.push_back(total);
  mean_m_.resize(total);
  error_m_.resize(total);
  low_m_.resize(total);
  high_m_.resize(total);

  for (int b = 0; b < rows(leaf_level_); ++b) {
    const std::size_t row = index({leaf_level_, 0, b});
    for (int a = 0; a < columns(leaf_level_); ++a) {
      const double z = terrain.z(a, b);
      const std::size_t k = row + static_cast<std::size_t>(a);
      mean_m_[k] = low_m_[k] = high_m_[k] = z;
      error_m_[k] = 0;
    }
  }
  for (int level = leaf_level_ - 1; level >= 0; --level) {
    for (int b = 0; b < rows(level); ++b) {
      std::size_t south = index({level + 1, 0, 2 * b});
      std::size_t north = index({level + 1, 0, 2 * b + 1});
      std::size_t k = index({level, 0, b});
      for (int a = 0; a < columns(level); ++a, ++k, south += 2, north += 2) {
        const double s00 = mean_m_[south];
        const double s01 = mean_m_[south + 1];
        const double s10 = mean_m_[north];
        const double s11 = mean_m_[north + 1];
        mean_m_[k] = (s00 + s01 + s10 + s11) / 4;
        // One Haar step, mean-normalised, so that coefficients are metres.
        const double horizontal = (s00 - s01 + s10 - s11) / 4;
        const double vertical = (s00 + s01 - s10 - s11) / 4;
        const double diagonal = (s00 - s01 - s10 + s11) / 4;
        error_m_[k] = std::max({std::abs(horizontal), std::abs(vertical), std::abs(diagonal)});
        low_m_[k] =
            std::min(std::min(low_m_[south], low_m_[south + 1]), std::min(low_m_[north], low_m_[north + 1]));
        high_m_[k] = std::max(std::max(high_m_[south], high_m_[south + 1]),
                              std::max(high_m_[north], high_m_[north + 1]));
      }
    }
  }
}

Vec3 Forest::position(Node node) const {
  const double size = std::ldexp(1.0, leaf_level_ - node.level);
  return {((node.a + 0.5) * size - 0.5) * spacing_m_, ((node.b + 0.5) * size - 0.5) * spacing_m_,
          mean_m_[index(node)]};
}

Forest::Box Forest::box(Node node) const {
  const int size = 1 << (leaf_level_ - node.level);
  const std::size_t k = index(node);
  return {{node.a * size * spacing_m_, node.b * size * spacing_m_, low_m_[k]},
          {(node.a * size + size - 1) * spacing_m_, (node.b * size + size - 1) * spacing_m_, high_m_[k]}};
}

double Forest::screen_error_px(Node node, const Camera& camera) const {
  const Box bounds = box(node);
  const Vec3& c = camera.position;
  const Vec3 nearest{std::clamp(c.x, bounds.low.x, bounds.high.x),
                     std::clamp(c.y, bounds.low.y, bounds.high.y),
                     std::clamp(c.z, bounds.low.z, bounds.high.z)};
  const double distance_m = length(nearest - c);
  if (distance_m == 0) return std::numeric_limits<double>::infinity();
  const Vec3 way = position(node) - c;
  const double squared = dot(way, way);
  // sqrt(1 − (ê_P·ê_z)²) is the horizontal share of the direction to the node.
  const double horizontal = squared > 0 ? std::sqrt((way.x * way.x + way.y * way.y) / squared) : 0;
  return camera.kappa_px * error_m(node) / distance_m * horizontal;
}

bool Forest::culled(Node node, const Camera& camera) const {
  const Box bounds = box(node);
  return camera.outside_view_cone((bounds.low + bounds.high) * 0.5, length(bounds.high - bounds.low) * 0.5);
}

Vec2 Forest::extent_m() const {
  return {(columns(leaf_level_) - 1) * spacing_m_, (rows(leaf_level_) - 1) * spacing_m_};
}

}  // namespace plumbline::haar_quadtree
