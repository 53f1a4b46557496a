// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/block_bintree/block_tree.h"

#include <algorithm>
#include <cmath>

#include "algorithms/mutant.h"

namespace plumbline::block_bintree {

BlockTree::BlockTree(const Terrain& terrain, const bintree::ClusterGrid& grid, int exponent)
    : grid_(grid), exponent_(exponent), offsets_{0} {
  for (int level = 0; level <= finest_level(); ++level) {
    offsets_.push_back(offsets_.back() +
                       static_cast<std::size_t>(columns(level)) * static_cast<std::size_t>(rows(level)));
  }
  heights_.resize(count());
  const int finest = finest_level();
  const int side = 1 << exponent;
  for (int row = 0; row < rows(finest); ++row) {
    for (int column = 0; column < columns(finest); ++column) {
      HeightRange range{terrain.z(column * side, row * side), terrain.z(column * side, row * side)};
      for (int j = row * side; j <= (row + 1) * side; ++j) {
        for (int i = column * side; i <= (column + 1) * side; ++i) {
          range.low_m = std::min(range.low_m, terrain.z(i, j));
          range.high_m = std::max(range.high_m, terrain.z(i, j));
        }
      }
      heights_[index({finest, column, row})] = range;
    }
  }
  for (int level = finest - 1; level >= 0; --level) {
    for (int row = 0; row < rows(level); ++row) {
      for (int column = 0; column < columns(level); ++column) {
        const BlockId id{level, column, row};
        HeightRange range = heights_[index(children(id)[0])];
        for (const BlockId child : children(id)) {
          if (PLUMBLINE_MUTANT(m4_heights_of_first_child)) break;
          range.low_m = std::min(range.low_m, heights_[index(child)].low_m);
          range.high_m = std::max(range.high_m, heights_[index(child)].high_m);
        }
        heights_[index(id)] = range;
      }
    }
  }
}

std::array<BlockId, 4> BlockTree::children(BlockId id) const {
  const int level = id.level + 1;
  const int column = 2 * id.column;
  const int row = 2 * id.row;
  return {BlockId{level, column, row}, BlockId{level, column + 1, row}, BlockId{level, column, row + 1},
          BlockId{level, column + 1, row + 1}};
}

bool BlockTree::outside_view_cone(BlockId id, const Camera& camera) const {
  const HeightRange range = heights_[index(id)];
  const bintree::GridPoint middle = centre(id);
  const double half_side_m = side_m(id.level) / 2;
  const double half_rise_m = (range.high_m - range.low_m) / 2;
  const Vec3 centre_m{middle.i * grid_.spacing_m(), middle.j * grid_.spacing_m(), range.low_m + half_rise_m};
  return camera.outside_view_cone(centre_m,
                                  (PLUMBLINE_MUTANT(m4_cull_radius_halved) ? 0.5 : 1) *
                                      std::sqrt(2 * half_side_m * half_side_m + half_rise_m * half_rise_m));
}

double BlockTree::distance_m(BlockId id, Vec3 point) const {
  const HeightRange range = heights_[index(id)];
  const double side = side_m(id.level);
  const auto outside = [](double v, double low, double high) { return std::max({low - v, 0.0, v - high}); };
  const Vec3 away{outside(point.x, id.column * side, (id.column + 1) * side),
                  outside(point.y, id.row * side, (id.row + 1) * side),
                  outside(point.z, range.low_m, range.high_m)};
  return length(away);
}

}  // namespace plumbline::block_bintree
