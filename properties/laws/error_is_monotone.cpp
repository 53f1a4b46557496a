// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law M4.C2: for every terrain and every split node, e(parent) ≥ q·e(child), and e is no less than the node's
// own deviation. Source: METHODS M4, split function (the paper's equation 10).

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "algorithms/block_bintree/block_bintree.h"
#include "properties/laws/split_function_laws.h"
#include "properties/laws/trial.h"
#include "scenarios/error.h"

namespace plumbline::properties {

using bintree::GridPoint;

block_bintree::SplitFunction split_function_of(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const auto* bintree = dynamic_cast<const block_bintree::BlockBintree*>(method.get());
  if (bintree == nullptr) {
    throw InputError(fmt::format("method '{}' has no split function; M4.C2 and M4.C3 speak of block_bintree",
                                 input.method));
  }
  return bintree->split_function();  // a copy; the method goes, the terrain is the input's
}

namespace {

/// δ of equation 1, metres, from the heights: the larger distance of a node from the middles of its diamond's
/// diagonals.
double deviation_m(const block_bintree::SplitFunction& function, GridPoint node) {
  const bintree::Diamond diamond = function.grid().diamond(node);
  const double z = function.point(node).z;
  const auto off = [&](GridPoint a, GridPoint b) {
    return std::fabs(z - (function.point(a).z + function.point(b).z) / 2);
  };
  const double along = off(diamond.left, diamond.right);
  if (diamond.apexes.count < 2) return along;
  return std::max(along, off(diamond.apexes.points[0], diamond.apexes.points[1]));
}

}  // namespace

LawOutcome check_error_is_monotone(const block_bintree::SplitFunction& function, double q) {
  const bintree::ClusterGrid& grid = function.grid();
  bool exercised = false;
  for (int j = 0; j < grid.rows(); ++j) {
    for (int i = 0; i < grid.columns(); ++i) {
      const GridPoint child{i, j};
      if (!grid.is_split_node(child)) continue;
      if (function.e_m(child) < deviation_m(function, child)) {
        oracle::Finding finding = law_finding("error_below_deviation", function.point(child));
        finding.gap_m = deviation_m(function, child) - function.e_m(child);
        return violated(fmt::format("node ({}, {}) has e = {} m, but stands {} m off (equation 1)", i, j,
                                    function.e_m(child), deviation_m(function, child)),
                        std::move(finding));
      }
      const double needed_m = q * function.e_m(child);
      for (const GridPoint parent : grid.parents(child)) {
        exercised = exercised || needed_m > 0;
        if (function.e_m(parent) >= needed_m) continue;
        oracle::Finding finding = law_finding("parent_error_too_small", function.point(parent));
        finding.gap_m = needed_m - function.e_m(parent);
        return violated(
            fmt::format("parent ({}, {}) has e = {} m, its child ({}, {}) {} m: less than q = {} times that",
                        parent.i, parent.j, function.e_m(parent), i, j, function.e_m(child), q),
            std::move(finding));
      }
    }
  }
  return exercised ? held() : vacuous("no child has an error");
}

Law law_error_is_monotone() {
  return {.id = "M4_C2_error_is_monotone",
          .statement =
              "for every terrain and split node, e(parent) >= q * e(child), and e is no less than the node's "
              "deviation",
          .source = "METHODS M4.C2",
          .applies = [](const MethodChoice& choice) { return choice.method->id == "block_bintree"; },
          .promised = [](const MethodChoice&) { return true; },
          .check =
              [](const LawInput& input) {
                const block_bintree::SplitFunction function = split_function_of(input);
                // The paper's q (equation 10) at least, whatever the method took for it.
                const auto& [depth_ratio, saturation] = function.constants();
                return check_error_is_monotone(function, std::max(saturation, 1 + depth_ratio / 2));
              }};
}

}  // namespace plumbline::properties
