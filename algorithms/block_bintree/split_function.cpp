// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The split function of block_bintree. Paper: section 3, equations 1–10 (METHODS M4). Heights and lengths in
// metres.
#include "algorithms/block_bintree/split_function.h"

#include <algorithm>
#include <cmath>

#include "algorithms/bintree/sweep.h"
#include "algorithms/mutant.h"

namespace plumbline::block_bintree {
namespace {

// g may reach 1 − 1/√2: beyond it a node could split by distance (d/ε_d ≥ depth) and its parent not; see
// README.md.
const double kLargestG = 1 - 1 / std::sqrt(2.0);
// Relative room for rounding in `repaired`: depths are sums of rounded products, the derivation is in real
// numbers. It covers cameras up to 10⁻⁶/2⁻⁵¹ ≈ 2·10⁹ times as far away as the depth that is compared.
constexpr double kRoundingRoom = 1e-6;

/// ε_d·sqrt(1+s²)/(2√2): the greatest |depth(parent) − depth(child)| in units of d(parent)/ε_d.
double depth_change_ratio(double depth_ratio, double slope) {
  return depth_ratio * std::sqrt(1 + slope * slope) / (2 * std::sqrt(2.0));
}

}  // namespace

SplitConstants published_constants(double depth_ratio) {
  return {depth_ratio, 1 + depth_ratio / (PLUMBLINE_MUTANT(m4_saturation_too_small) ? 4 : 2)};
}

SplitConstants repaired_constants(double depth_ratio, double steepest_slope) {
  SplitConstants out = published_constants(depth_ratio);
  const double g = depth_change_ratio(depth_ratio, steepest_slope);
  if (g * (1 + kRoundingRoom) > kLargestG) {
    out.depth_ratio = depth_ratio * (kLargestG / g) * (1 - kRoundingRoom);
  }
  const double g_used = depth_change_ratio(out.depth_ratio, steepest_slope);
  out.saturation = std::max(1 + out.depth_ratio / 2, (1 + kRoundingRoom) / (1 - g_used));
  return out;
}

double steepest_slope(const Terrain& terrain, const ClusterGrid& grid) {
  const std::vector<double>& z = terrain.heights_m;
  double steepest = 0;
  bintree::sweep_bottom_up(grid, [&](const bintree::SweepNode& s) {
    // A node stands half a hypotenuse of its own from both its parents, which are its apexes.
    const double distance_m = grid.hypotenuse_m(s.level) / 2;
    if (s.level == 0) return;
    for (int a = 0; a < s.apex_count; ++a) {
      steepest =
          std::max(steepest, std::fabs(z[s.apexes[static_cast<std::size_t>(a)]] - z[s.node]) / distance_m);
    }
  });
  return steepest;
}

SplitFunction::SplitFunction(const Terrain& terrain, const ClusterGrid& grid, SplitConstants constants)
    : terrain_(&terrain),
      spacing_m_(terrain.spacing_m),
      grid_(grid),
      order_(grid),
      constants_(constants),
      nodes_(order_.size()) {
  const double q = constants.saturation;
  std::vector<double> e_by_sample(grid.samples(), 0.0);
  const double* z = terrain.heights_m.data();
  double* e = e_by_sample.data();
  bintree::sweep_bottom_up(grid_, [&, z, e, q](const bintree::SweepNode& s) {
    double value = std::fabs(z[s.node] - (z[s.left] + z[s.right]) / 2);
    if (s.apex_count == 2 && !PLUMBLINE_MUTANT(m4_apex_pair_forgotten)) {
      value = std::max(value, std::fabs(z[s.node] - (z[s.apexes[0]] + z[s.apexes[1]]) / 2));
    }
    for (int c = 0; c < s.child_count; ++c) {
      if (PLUMBLINE_MUTANT(m4_last_child_forgotten) && c == 3) break;
      value = std::max(value, (PLUMBLINE_MUTANT(m4_saturation_forgotten) ? 1 : q) *
                                  e[s.children[static_cast<std::size_t>(c)]]);
    }
    e[s.node] = value;
    nodes_[order_.index(s.at, s.level)] = {z[s.node], value};
  });
}

double SplitFunction::deviation_m(GridPoint node) const {
  const bintree::Diamond diamond = grid_.diamond(node);
  const auto z = [&](GridPoint p) { return terrain_->z(p.i, p.j); };
  double value = std::fabs(z(node) - (z(diamond.left) + z(diamond.right)) / 2);
  if (diamond.apexes.count == 2) {
    value =
        std::max(value, std::fabs(z(node) - (z(diamond.apexes.points[0]) + z(diamond.apexes.points[1])) / 2));
  }
  return value;
}

SplitFunction::Frame SplitFunction::frame(const Camera& camera, double threshold_px) const {
  Frame out{camera, camera.kappa_px / threshold_px, {}};
  if (PLUMBLINE_MUTANT(m4_threshold_squared)) out.px_ratio = camera.kappa_px / (threshold_px * threshold_px);
  if (PLUMBLINE_MUTANT(m4_single_level)) out.px_ratio = 0;
  for (int level = 0; level < grid_.levels(); ++level) {
    const int of = PLUMBLINE_MUTANT(m4_length_of_wrong_level) ? std::max(level - 1, 0) : level;
    out.depth_limit_m.push_back(
        PLUMBLINE_MUTANT(m4_length_term_forgotten) ? 0 : grid_.hypotenuse_m(of) / constants_.depth_ratio);
  }
  return out;
}

}  // namespace plumbline::block_bintree
