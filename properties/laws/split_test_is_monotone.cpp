// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law M4.C3: for every terrain, camera and threshold, a split node that passes the split test has parents
// that pass it. Source: METHODS M4.C3; docs/proofs/m4_threshold.md proves up to which slope it holds.

#include <fmt/format.h>

#include "properties/laws/split_function_laws.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {

using bintree::GridPoint;

LawOutcome check_split_test_is_monotone(const block_bintree::SplitFunction& function, const Camera& camera,
                                        double threshold_px) {
  const bintree::ClusterGrid& grid = function.grid();
  const auto frame = function.frame(camera, threshold_px);
  bool some_split = false, some_not = false;
  for (int j = 0; j < grid.rows(); ++j) {
    for (int i = 0; i < grid.columns(); ++i) {
      const GridPoint child{i, j};
      if (!grid.is_split_node(child)) continue;
      if (!function.splits(frame, child, grid.level(child))) {
        some_not = true;
        continue;
      }
      for (const GridPoint parent : grid.parents(child)) {
        some_split = true;
        if (function.splits(frame, parent, grid.level(parent))) continue;
        const Vec3 at = function.point(child);
        return violated(fmt::format("node ({}, {}) splits (e {:.6g} m, depth {:.6g} m), its parent ({}, {}) "
                                    "does not (e {:.6g} m, depth "
                                    "{:.6g} m)",
                                    i, j, function.e_m(child), camera.depth(at), parent.i, parent.j,
                                    function.e_m(parent), camera.depth(function.point(parent))),
                        law_finding("child_splits_parent_does_not", at));
      }
    }
  }
  // Only between nodes on either side of the test could the law have failed.
  return some_split && some_not ? held() : vacuous("all nodes split, or none with a parent does");
}

Law law_split_test_is_monotone() {
  return {.id = "M4_C3_split_test_is_monotone",
          .statement =
              "for every terrain, camera and threshold: a split node passes the split test => both its "
              "parents do",
          .source = "METHODS M4.C3",
          .applies = [](const MethodChoice& choice) { return choice.method->id == "block_bintree"; },
          .promised = [](const MethodChoice&) { return true; },
          .check =
              [](const LawInput& input) {
                return check_split_test_is_monotone(split_function_of(input), judged_camera(input),
                                                    input.threshold_px);
              }};
}

}  // namespace plumbline::properties
