// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/haar_quadtree/forest.h"

#include <algorithm>
#include <cmath>

#include "algorithms/mutant.h"

namespace plumbline::haar_quadtree {

Forest::Forest(const Terrain& terrain, int leaf_level)
    : leaf_level_(leaf_level),
      patches_x_((terrain.columns - 1) >> leaf_level),
      patches_y_((terrain.rows - 1) >> leaf_level),
      spacing_m_(terrain.spacing_m),
      terrain_(&terrain) {
  std::size_t total = 0;
  for (int level = 0; level <= leaf_level_; ++level) {
    first_.push_back(total);
    total += static_cast<std::size_t>(columns(level)) * static_cast<std::size_t>(rows(level));
  }
  first_.push_back(total);
  inner_.resize(first_[static_cast<std::size_t>(leaf_level_)]);
  for (std::size_t p = 0; p < patches(); ++p) build(patch(p));
}

Forest::Inner Forest::build(const Node& node) {
  std::array<Inner, 4> c;
  if (node.level + 1 == leaf_level_) {
    const double* south = &terrain_->heights_m[terrain_->index(2 * node.a, 2 * node.b)];
    const double* north = south + terrain_->columns;
    c = {Inner{south[0], 0, south[0], south[0]}, Inner{south[1], 0, south[1], south[1]},
         Inner{north[0], 0, north[0], north[0]}, Inner{north[1], 0, north[1], north[1]}};
  } else {
    for (int k = 0; k < 4; ++k) c[static_cast<std::size_t>(k)] = build(child(node, k));
  }
  const double s00 = c[0].mean_m, s01 = c[1].mean_m, s10 = c[2].mean_m, s11 = c[3].mean_m;
  // One Haar step, mean-normalised, so that coefficients are metres.
  const double horizontal = (s00 - s01 + s10 - s11) / 4;
  const double vertical =
      PLUMBLINE_MUTANT(m1_haar_sign) ? (s00 + s01 - s10 + s11) / 4 : (s00 + s01 - s10 - s11) / 4;
  const double diagonal = (s00 - s01 - s10 + s11) / 4;
  const Inner made{
      PLUMBLINE_MUTANT(m1_mean_of_three) ? (s00 + s01 + s10 + s10) / 4 : (s00 + s01 + s10 + s11) / 4,
      std::max(std::max(std::abs(horizontal), std::abs(vertical)),
               PLUMBLINE_MUTANT(m1_diagonal_detail_forgotten) ? 0 : std::abs(diagonal)),
      std::min(std::min(c[0].low_m, c[1].low_m), std::min(c[2].low_m, c[3].low_m)),
      std::max(std::max(c[0].high_m, c[1].high_m), std::max(c[2].high_m, c[3].high_m)),
  };
  inner_[index(node)] = made;
  return made;
}

Forest::Box Forest::box(const Node& node) const {
  const int size = 1 << (leaf_level_ - node.level);
  const Inner& inner = inner_[index(node)];
  return {{node.a * size * spacing_m_, node.b * size * spacing_m_, inner.low_m},
          {(node.a * size + size - 1) * spacing_m_, (node.b * size + size - 1) * spacing_m_, inner.high_m}};
}

bool Forest::culled(const Node& node, const Camera& camera) const {
  const Box bounds = box(node);
  return camera.outside_view_cone(
      (bounds.low + bounds.high) * 0.5,
      length(bounds.high - bounds.low) * (PLUMBLINE_MUTANT(m1_cull_radius_halved) ? 0.25 : 0.5));
}

Vec2 Forest::extent_m() const {
  return {(columns(leaf_level_) - 1) * spacing_m_, (rows(leaf_level_) - 1) * spacing_m_};
}

}  // namespace plumbline::haar_quadtree
