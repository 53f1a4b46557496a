// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The registry entry of block_bintree: variants, options, claims.
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "algorithms/block_bintree/block_bintree.h"
#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using block_bintree::Settings;

Settings read_settings(std::string_view variant, const Options& options) {
  Settings s;
  s.repair = variant == "repaired";
  s.cull_triangles = variant == "tri_cull";
  s.levels_by_distance = variant == "by_distance";
  s.depth_ratio = option_number(options, "depth_ratio", s.depth_ratio);
  s.cluster_samples = option_number(options, "cluster_size", s.cluster_samples);
  s.block_samples = option_number(options, "block_size", s.block_samples);
  s.cull = option_flag(options, "cull", s.cull);
  s.distance_factor = option_number(options, "distance_factor", s.distance_factor);
  if (!(s.depth_ratio > 0 && s.depth_ratio <= 1)) {
    throw InputError(fmt::format(
        "block_bintree: option depth_ratio = {} is not inside (0, 1]; the paper's is 0.1", s.depth_ratio));
  }
  const double cells = s.block_samples - 1;
  if (!(cells >= 2 && cells <= (1 << 20)) || cells != std::floor(cells) ||
      !std::has_single_bit(static_cast<unsigned>(cells))) {
    throw InputError(
        fmt::format("block_bintree: option block_size = {} is not 2^k+1 with k >= 1; give 3, 5, 9, 17, …",
                    s.block_samples));
  }
  if (!(s.distance_factor > 0 && std::isfinite(s.distance_factor))) {
    throw InputError(fmt::format("block_bintree: option distance_factor = {} is not positive and finite",
                                 s.distance_factor));
  }
  return s;
}

}  // namespace

MethodDescription describe_block_bintree() {
  using enum Promise;
  return {
      .id = "block_bintree",
      .title = "Block quadtree and right-triangle bintree with a saturated split function",
      .citation =
          "\"Real-time navigation over unlimited terrain\" (in Russian; the text at hand names no authors)",
      .section = "M4",
      .variants =
          {
              {"",
               "as published: q = 1 + ε_d/2; blocks outside the view cone are left out",
               {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero}},
              {"tri_cull",
               "also leaves out triangles whose ball lies outside the view cone",
               {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero}},
              {"by_distance",
               "block levels follow distance alone; cracks between blocks are hunted",
               {covers_domain, monotone_in_tau, idempotent, path_independent}},
              {"repaired",
               "q and ε_d from the terrain's steepest slope, so that M4.C3 holds for every camera",
               {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero}},
          },
      .options =
          {
              {"depth_ratio", "ε_d: a hypotenuse longer than this share of its depth splits", 0.1},
              {"cluster_size", "samples along a cluster's side, 2^n+1; 0: the largest that fits the terrain",
               0.0},
              {"block_size", "samples along a block's side, 2^k+1; smaller clusters are one block each",
               65.0},
              {"cull", "leave out blocks outside the view cone", true},
              {"distance_factor", "by_distance: a block nearer than this many of its sides is replaced", 2.0},
          },
      .claims =
          {
              {"M4.C1", "conforming with no correction pass, inside a block and across blocks of any levels"},
              {"M4.C2", "e is monotone: e(parent) >= q e(child)"},
              {"M4.C3", "the split test is monotone: a node is split only if both its parents are"},
              {"M4.C4", "only visible, active blocks are held"},
          },
      .make =
          [](std::string_view variant, const Options& options) {
            return std::make_unique<block_bintree::BlockBintree>(read_settings(variant, options));
          },
  };
}

}  // namespace plumbline
