// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The registry entry of isolated_quadtree: variants, options, claims.
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "algorithms/isolated_quadtree/isolated_quadtree.h"
#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

std::unique_ptr<LodMethod> make(std::string_view variant, const Options& options) {
  const double size = option_number(options, "tile_size", 257);
  const double cells = size - 1;
  if (!(cells >= 2 && cells <= (1 << 20)) || cells != std::floor(cells) ||
      !std::has_single_bit(static_cast<unsigned>(cells))) {
    throw InputError(fmt::format(
        "isolated_quadtree: option tile_size = {} is not 2^n+1 with n >= 1; give 3, 5, …, 257", size));
  }
  return make_isolated_quadtree({.tile_samples = static_cast<int>(size),
                                 .with_cosine = variant != "no_cos",
                                 .split_both_sides = variant == "repaired"});
}

}  // namespace

MethodDescription describe_isolated_quadtree() {
  using enum Promise;
  return {
      .id = "isolated_quadtree",
      .title = "Isolated division of a tiled quadtree with a conservative screen error",
      .citation =
          "Zhang Junfeng, Yao Zhihong: \"LOD algorithm of terrain based on conservative screen error and "
          "isolated division of quadtree\" (in Chinese), Journal of Southwest Jiaotong University 48(4), "
          "2013",
      .section = "M3",
      .variants =
          {
              {"",
               "as published: the screen error is multiplied by cos beta",
               {conforming, covers_domain, monotone_in_tau, idempotent, path_independent,
                screen_error_within_tau}},
              {"no_cos",
               "the screen error without its cosine, which the paper offers too",
               {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero,
                screen_error_within_tau}},
              {"repaired",
               "neighbouring tiles give each other split points, and no height is averaged",
               {conforming, covers_domain, monotone_in_tau, idempotent, path_independent}},
          },
      .options = {{"tile_size", "samples along a tile's side, 2^n+1", 257.0}},
      .claims =
          {
              {"M3.C1", "no cracks, inside tiles and between them"},
              {"M3.C2", "a parent's error is never below a child's"},
              {"M3.C3", "the screen error never exceeds tau"},
              {"M3.C4", "isolated division avoids the redundancy of dependent division"},
              {"M3.C5", "about 8.7 triangles a drawn node"},
          },
      .make = make,
  };
}

}  // namespace plumbline
