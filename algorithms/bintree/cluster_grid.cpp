// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/bintree/cluster_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::bintree {
namespace {

int trailing_zeros(int value) { return std::countr_zero(static_cast<unsigned>(value)); }

}  // namespace

ClusterGrid::ClusterGrid(const Terrain& terrain, double cluster_samples, std::string_view method)
    : columns_(terrain.columns), rows_(terrain.rows), spacing_m_(terrain.spacing_m) {
  if (columns_ < 2 || rows_ < 2) {
    throw InputError(fmt::format("{}: terrain of {} x {} samples has no cell; give at least 3 x 3 samples",
                                 method, columns_, rows_));
  }
  const int largest = std::min(trailing_zeros(columns_ - 1), trailing_zeros(rows_ - 1));
  if (largest < 1) {
    throw InputError(
        fmt::format("{}: terrain of {} x {} samples cannot be cut into clusters of 2^n+1 samples a side; "
                    "resample it, for example to size = {}",
                    method, columns_, rows_,
                    (1 << std::bit_width(static_cast<unsigned>(std::max({columns_, rows_, 3}) - 2))) + 1));
  }
  exponent_ = largest;
  if (cluster_samples == 0) return;
  const double cells = cluster_samples - 1;
  if (!(cells >= 2 && cells <= (1 << 20)) || cells != std::floor(cells) ||
      !std::has_single_bit(static_cast<unsigned>(cells))) {
    throw InputError(
        fmt::format("{}: option cluster_size = {} is not 2^n+1 with n >= 1; give 3, 5, 9, 17, … or 0 for "
                    "the largest that fits",
                    method, cluster_samples));
  }
  exponent_ = trailing_zeros(static_cast<int>(cells));
  if (exponent_ > largest) {
    throw InputError(
        fmt::format("{}: clusters of {} samples a side do not divide a terrain of {} x {}; the largest "
                    "that does has {}",
                    method, cluster_samples, columns_, rows_, (1 << largest) + 1));
  }
}

std::array<RightTriangle, 2> ClusterGrid::halves(GridPoint centre) const {
  // diamond() gives the hypotenuse from south to north and the southern apex first; counter-clockwise order
  // follows.
  const auto [left, right, apexes] = diamond(centre);
  const bool rising = left.i < right.i;
  if (rising)
    return {RightTriangle{apexes.points[0], right, left}, RightTriangle{apexes.points[1], left, right}};
  return {RightTriangle{apexes.points[0], left, right}, RightTriangle{apexes.points[1], right, left}};
}

int ClusterGrid::half_step(GridPoint node) const { return 1 << trailing_zeros(node.i | node.j); }

int ClusterGrid::level(GridPoint node) const {
  const int zeros = trailing_zeros(node.i | node.j);
  const bool centre = ((node.i & node.j) >> zeros & 1) != 0;
  return 2 * (exponent_ - 1 - zeros) + (centre ? 0 : 1);
}

Diamond ClusterGrid::diamond(GridPoint node) const {
  const int h = half_step(node);
  const auto [i, j] = node;
  const bool i_odd = (i & h) != 0;
  const bool j_odd = (j & h) != 0;
  Diamond out;
  GridPoint apexes[2];
  if (i_odd && j_odd) {
    // Towards the parent's centre: the corner whose coordinates are both odd multiples of 2h. That corner
    // lies on the rising diagonal iff i and j are equal modulo 4h. The root's diagonal rises by definition.
    const bool rising = 2 * h == side() || ((i ^ j) & (2 * h)) == 0;
    const GridPoint sw{i - h, j - h}, se{i + h, j - h}, ne{i + h, j + h}, nw{i - h, j + h};
    out.left = rising ? sw : se;
    out.right = rising ? ne : nw;
    apexes[0] = rising ? se : sw;
    apexes[1] = rising ? nw : ne;
  } else if (i_odd) {
    out.left = {i - h, j};
    out.right = {i + h, j};
    apexes[0] = {i, j - h};
    apexes[1] = {i, j + h};
  } else {
    out.left = {i, j - h};
    out.right = {i, j + h};
    apexes[0] = {i - h, j};
    apexes[1] = {i + h, j};
  }
  for (const GridPoint apex : apexes) {
    if (inside(apex)) out.apexes.add(apex);
  }
  return out;
}

PointList ClusterGrid::parents(GridPoint node) const {
  return level(node) == 0 ? PointList{} : diamond(node).apexes;
}

PointList ClusterGrid::children(GridPoint node) const {
  PointList out;
  const int h = half_step(node);
  const bool centre = (node.i & h) != 0 && (node.j & h) != 0;
  if (!centre && h == 1) return out;
  const int step = centre ? h : h / 2;
  const GridPoint around[4] = {
      centre ? GridPoint{node.i, node.j - step} : GridPoint{node.i - step, node.j - step},
      centre ? GridPoint{node.i - step, node.j} : GridPoint{node.i + step, node.j - step},
      centre ? GridPoint{node.i + step, node.j} : GridPoint{node.i - step, node.j + step},
      centre ? GridPoint{node.i, node.j + step} : GridPoint{node.i + step, node.j + step}};
  for (const GridPoint child : around) {
    if (inside(child)) out.add(child);
  }
  return out;
}

double ClusterGrid::hypotenuse_m(int level) const {
  const double square_side_m = (side() >> (level / 2)) * spacing_m_;
  return level % 2 == 0 ? square_side_m * std::sqrt(2.0) : square_side_m;
}

}  // namespace plumbline::bintree
