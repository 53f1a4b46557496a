// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "algorithms/bintree/level_order.h"

namespace plumbline::bintree {

/// A split node as a bottom-up sweep meets it, in sample indices: corners and children as ClusterGrid has
/// them.
struct SweepNode {
  std::size_t node = 0;
  GridPoint at;  ///< of `node`
  int level = 0;
  std::size_t left = 0, right = 0;  ///< ends of the hypotenuse
  std::array<std::size_t, 2> apexes{};
  int apex_count = 0;  ///< 2; 1 on the terrain's border
  std::array<std::size_t, 4> children{};
  int child_count = 0;
};

/// Calls visit(SweepNode) for every split node, each after all its children: finest level first. For each
/// distance h between nodes the grid is walked once from south to north, the centres of a row of squares one
/// row behind the side midpoints they wait for, so that a row is still in the cache when it is needed again.
template <class Visit>
void sweep_bottom_up(const ClusterGrid& grid, Visit&& visit) {
  const auto columns = static_cast<std::size_t>(grid.columns());
  const auto rows = static_cast<std::size_t>(grid.rows());
  const auto side = static_cast<std::size_t>(grid.side());
  int level = grid.levels() - 1;
  for (std::size_t h = 1; 2 * h <= side; h *= 2, level -= 2) {
    const std::size_t up = h * columns;  // index step of h rows
    const std::size_t half = h / 2;
    const std::size_t half_up = half * columns;
    // Children of a side midpoint lie at (±h/2, ±h/2): those to the south, those to the north.
    const auto midpoint_children = [&](SweepNode& s, bool west, bool east, bool south, bool north) {
      if (h == 1) return;
      const std::size_t k = s.node;
      if (south && west) s.children[static_cast<std::size_t>(s.child_count++)] = k - half_up - half;
      if (south && east) s.children[static_cast<std::size_t>(s.child_count++)] = k - half_up + half;
      if (north && west) s.children[static_cast<std::size_t>(s.child_count++)] = k + half_up - half;
      if (north && east) s.children[static_cast<std::size_t>(s.child_count++)] = k + half_up + half;
    };
    const auto add_apex = [](SweepNode& s, std::size_t k) {
      s.apexes[static_cast<std::size_t>(s.apex_count++)] = k;
    };
    for (std::size_t j = 0; j < rows; j += h) {
      const bool south = j > 0;
      const bool north = j + 1 < rows;
      const std::size_t row = j * columns;
      if ((j / h) % 2 == 0) {  // midpoints of horizontal sides
        for (std::size_t i = h; i < columns; i += 2 * h) {
          SweepNode s;
          s.node = row + i;
          s.at = {static_cast<int>(i), static_cast<int>(j)};
          s.level = level;
          s.left = s.node - h;
          s.right = s.node + h;
          if (south) add_apex(s, s.node - up);
          if (north) add_apex(s, s.node + up);
          midpoint_children(s, true, true, south, north);
          visit(s);
        }
      } else {  // midpoints of vertical sides
        for (std::size_t i = 0; i < columns; i += 2 * h) {
          SweepNode s;
          s.node = row + i;
          s.at = {static_cast<int>(i), static_cast<int>(j)};
          s.level = level;
          s.left = s.node - up;
          s.right = s.node + up;
          const bool west = i > 0;
          const bool east = i + 1 < columns;
          if (west) add_apex(s, s.node - h);
          if (east) add_apex(s, s.node + h);
          midpoint_children(s, west, east, true, true);
          visit(s);
        }
        continue;
      }
      if (j == 0) continue;
      const std::size_t centre_j = j - h;  // centres of the squares just completed
      for (std::size_t i = h; i < columns; i += 2 * h) {
        SweepNode s;
        s.node = centre_j * columns + i;
        s.at = {static_cast<int>(i), static_cast<int>(centre_j)};
        s.level = level - 1;
        const bool rising = 2 * h == side || ((i ^ centre_j) & (2 * h)) == 0;
        const std::size_t sw = s.node - up - h, se = s.node - up + h, nw = s.node + up - h,
                          ne = s.node + up + h;
        s.left = rising ? sw : se;
        s.right = rising ? ne : nw;
        s.apexes = rising ? std::array{se, nw} : std::array{sw, ne};
        s.apex_count = 2;
        s.children = {s.node - up, s.node - h, s.node + h, s.node + up};
        s.child_count = 4;
        visit(s);
      }
    }
  }
}

/// In level order: the radius, metres, of a ball around each split node that holds every sample of its
/// diamond (its one or two triangles, to the finest level). 0 at cluster corners.
std::vector<double> diamond_radii_m(const Terrain& terrain, const ClusterGrid& grid, const LevelOrder& order);

}  // namespace plumbline::bintree
