// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "algorithms/lod_method.h"

namespace plumbline {
namespace isolated_quadtree {

struct Settings {
  int tile_samples = 257;         ///< along a tile's side, 2ⁿ+1
  bool with_cosine = true;        ///< the screen error holds cos β
  bool split_both_sides = false;  ///< variant repaired: split points between tiles instead of averaging
};

}  // namespace isolated_quadtree

/// METHODS M3; roles, formulas and departures at the head of isolated_quadtree.cpp.
std::unique_ptr<LodMethod> make_isolated_quadtree(const isolated_quadtree::Settings& settings);

}  // namespace plumbline
