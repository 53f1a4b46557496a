// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/laws/law.h"

#include <cmath>

#include <fmt/format.h>

#include "properties/laws/trial.h"
#include "scenarios/error.h"
#include "scenarios/nearest.h"

namespace plumbline::properties {

const std::vector<Law>& all_laws() {
  static const std::vector<Law> laws{
      law_conforming(),
      law_covers_domain(),
      law_error_is_monotone(),
      law_split_test_is_monotone(),
      law_triangles_fall_with_tau(),
      law_idempotent(),
      law_path_independent(),
      law_exact_at_zero(),
      law_scaling_keeps_topology(),
      law_symmetric(),
      law_screen_error_within_tau(),
      law_continuous_in_camera(),
      law_covers_picture(),
      law_starts_afresh(),
      law_lifting_keeps_topology(),
      law_threshold_is_in_pixels(),
      law_vertices_are_samples(),
      law_haar_nodes_are_means(),
      law_haar_morphs_by_error(),
      law_restricted_selects(),
      law_haar_walk_is_collapsed_grid(),
      law_haar_cut_settles_within_tau(),
      law_ring_prices_are_distances(),
      law_ring_collapses_within_tolerance(),
      law_isolated_error_is_conservative(),
      law_vertex_tree_is_as_built(),
      law_vertex_tree_keeps_neighbourhoods(),
      law_vertex_tree_holds_contour(),
      law_vertex_tree_meets_ladder(),
  };
  return laws;
}

const Law& find_law(std::string_view id) {
  std::vector<std::string> known;
  for (const Law& law : all_laws()) {
    if (law.id == id) return law;
    known.push_back(law.id);
  }
  throw InputError(unknown_name("law", id, known));
}

LawOutcome judge(const Law& law, const LawInput& input) {
  const Terrain& terrain = input.terrain;
  if (terrain.columns < 2 || terrain.rows < 2 ||
      terrain.heights_m.size() !=
          static_cast<std::size_t>(terrain.columns) * static_cast<std::size_t>(terrain.rows)) {
    throw InputError(fmt::format("law input: {} samples do not fill a grid of {} x {}; give at least 2 x 2",
                                 terrain.heights_m.size(), terrain.columns, terrain.rows));
  }
  for (const double z : terrain.heights_m) {
    if (!std::isfinite(z)) throw InputError("law input: a sample is not finite; give finite metres");
  }
  if (!(terrain.spacing_m > 0) || !std::isfinite(terrain.spacing_m)) {
    throw InputError(fmt::format("law input: spacing {} m is not positive and finite", terrain.spacing_m));
  }
  if (!(input.threshold_px > 0) || !std::isfinite(input.threshold_px)) {
    throw InputError(
        fmt::format("law input: threshold {} px is not positive and finite", input.threshold_px));
  }
  if (input.poses.empty()) throw InputError("law input: the flight has no pose; give at least one");
  return law.check(input);
}

}  // namespace plumbline::properties
