// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law of the restricted quadtree: whatever is worth a vertex by itself is one. Its search leaves out
// triangles in which it takes nothing to be worth it, and no law on the mesh alone tells that from a coarser
// choice.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "algorithms/bintree/cluster_grid.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

/// Distances are rounded otherwise here; relative.
constexpr double kRounding = 1e-9;

LawOutcome check(const LawInput& input) {
  if (option_flag(input.options, "cull", false)) return vacuous("what is out of sight is left out");
  LodFrame frame;
  const Camera camera = judged_camera(input);
  prepared_method(input)->update(camera, frame);
  std::vector<std::uint64_t> keys = frame.vertex_keys;
  std::sort(keys.begin(), keys.end());
  const Terrain& terrain = input.terrain;
  const bintree::ClusterGrid grid(terrain, option_number(input.options, "cluster_size", 0),
                                  "restricted_quadtree");
  bool some = false, some_not = false;
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      if (!grid.is_split_node({i, j})) continue;
      const bintree::Diamond diamond = grid.diamond({i, j});
      const double middle_m =
          (terrain.z(diamond.left.i, diamond.left.j) + terrain.z(diamond.right.i, diamond.right.j)) / 2;
      const double error_px = camera.kappa_px * std::fabs(terrain.z(i, j) - middle_m) /
                              length(terrain.point(i, j) - camera.position);
      const bool drawn = std::binary_search(keys.begin(), keys.end(), terrain.index(i, j));
      some = some || drawn;
      some_not = some_not || !drawn;
      if (drawn || !(error_px > input.threshold_px * (1 + kRounding))) continue;
      oracle::Finding finding = law_finding("vertex_left_out", terrain.point(i, j));
      finding.gap_px = error_px;
      return violated(
          fmt::format("sample ({}, {}) stands {:.6g} px = {:.4g} tau off its hypotenuse and is no vertex", i,
                      j, error_px, error_px / input.threshold_px),
          std::move(finding));
    }
  }
  return some && some_not ? held() : vacuous("all samples are vertices, or none but corners");
}

bool is_restricted(const MethodChoice& choice) { return choice.method->id == "restricted_quadtree"; }

}  // namespace

Law law_restricted_selects() {
  return {.id = "RQ_worthy_samples_are_drawn",
          .statement =
              "for every terrain, camera and threshold, each sample whose own deviation exceeds the "
              "threshold is a vertex",
          .source = "METHODS, reference methods (Pajarola 1998)",
          .applies = is_restricted,
          .promised = is_restricted,
          .check = check};
}

}  // namespace plumbline::properties
