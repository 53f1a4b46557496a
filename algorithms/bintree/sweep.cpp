// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/bintree/sweep.h"

#include <algorithm>
#include <cmath>

namespace plumbline::bintree {

std::vector<double> diamond_radii_m(const Terrain& terrain, const ClusterGrid& grid,
                                    const LevelOrder& order) {
  // In plan the diamond's farthest points are its corners, at half a hypotenuse; in height its samples' range
  // counts.
  const std::vector<double>& z = terrain.heights_m;
  std::vector<double> radius_m(order.size(), 0.0);
  std::vector<double> lowest(z), highest(z);  // over the diamond of each node
  std::vector<double> half_hypotenuse_squared(static_cast<std::size_t>(grid.levels()));
  for (int level = 0; level < grid.levels(); ++level) {
    const double half = grid.hypotenuse_m(level) / 2;
    half_hypotenuse_squared[static_cast<std::size_t>(level)] = half * half;
  }
  sweep_bottom_up(grid, [&](const SweepNode& s) {
    double low = std::min({z[s.node], z[s.left], z[s.right]});
    double high = std::max({z[s.node], z[s.left], z[s.right]});
    for (int a = 0; a < s.apex_count; ++a) {
      low = std::min(low, z[s.apexes[static_cast<std::size_t>(a)]]);
      high = std::max(high, z[s.apexes[static_cast<std::size_t>(a)]]);
    }
    for (int c = 0; c < s.child_count; ++c) {
      const std::size_t child = s.children[static_cast<std::size_t>(c)];
      low = std::min(low, lowest[child]);
      high = std::max(high, highest[child]);
    }
    lowest[s.node] = low;
    highest[s.node] = high;
    const double rise = std::max(high - z[s.node], z[s.node] - low);
    radius_m[order.index(s.at, s.level)] =
        std::sqrt(half_hypotenuse_squared[static_cast<std::size_t>(s.level)] + rise * rise);
  });
  return radius_m;
}

}  // namespace plumbline::bintree
