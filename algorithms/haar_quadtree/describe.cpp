// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The registry entry of haar_quadtree: variants, options, claims.
#include <cmath>

#include <fmt/format.h>

#include "algorithms/haar_quadtree/haar_quadtree.h"
#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using haar_quadtree::HaarQuadtree;
using haar_quadtree::Settings;

Settings read_settings(std::string_view variant, const Options& options) {
  Settings s;
  s.morph = variant == "morph";
  s.cull = option_flag(options, "cull", s.cull);
  s.lambda = option_number(options, "lambda", s.lambda);
  const double nodes = option_number(options, "max_nodes", 0);
  const double patch = option_number(options, "patch_size", 0);
  if (!(s.lambda > 1 && std::isfinite(s.lambda))) {
    throw InputError(fmt::format("haar_quadtree: option lambda = {} is not above 1", s.lambda));
  }
  if (!(nodes >= 0 && nodes <= 1e9) || nodes != std::floor(nodes)) {
    throw InputError(
        fmt::format("haar_quadtree: option max_nodes = {} is no whole number from 0 (no budget) "
                    "to 10^9",
                    nodes));
  }
  if (!(patch >= 0 && patch <= (1 << 20)) || patch != std::floor(patch)) {
    throw InputError(
        fmt::format("haar_quadtree: option patch_size = {} is no power of two; give 128, 256, "
                    "…, or 0 for the largest that divides the terrain",
                    patch));
  }
  s.max_nodes = static_cast<std::size_t>(nodes);
  s.patch_size = static_cast<int>(patch);
  return s;
}

}  // namespace

MethodDescription describe_haar_quadtree() {
  using enum Promise;
  return {
      .id = "haar_quadtree",
      .title = "Haar transform and quadtree of vertices",
      .citation =
          "E. Yusov, V. Turlapov: \"Dynamic terrain simplification based on Haar transform and vertices "
          "quadtree\" (in Russian), GraphiCon 2006",
      .section = "M1",
      .variants =
          {
              {"",
               "as published: bottom-up at the first frame, then one level of change a frame",
               {conforming, screen_error_within_tau}},
              {"morph",
               "children move to their parent while its error is between tau and lambda tau",
               {conforming, continuous_in_camera}},
          },
      .options =
          {
              {"patch_size", "samples along a patch's side, 2^n; 0: the largest that divides the terrain",
               0.0},
              {"lambda", "morph: geomorphing runs over errors from tau to lambda tau", 2.0},
              {"max_nodes", "budget: no more roots than this, largest screen errors first; 0: none", 0.0},
              {"cull", "nodes outside the view cone stand for their whole subtree", true},
          },
      .claims =
          {
              {"M1.C1", "no cracks and no T-junctions, inside patches and across, for any levels"},
              {"M1.C2", "nothing is added for stitching: one or two triangles a partition corner"},
              {"M1.C3", "update cost follows the model, not the terrain"},
              {"M1.C4", "merging at alpha = 0 changes nothing visible"},
              {"M1.C5", "tau bounds the error in the image"},
              {"M1.C6", "the triangulation exists for any set of roots, free of fold-overs"},
              {"M1.C7", "averaged nodes give a smaller vertical error than sampled ones at the same cut"},
              {"M1.C8", "the screen error takes the camera's orientation into account"},
          },
      .make = [](std::string_view variant, const Options& options) -> std::unique_ptr<LodMethod> {
        return std::make_unique<HaarQuadtree>(read_settings(variant, options));
      },
  };
}

}  // namespace plumbline
