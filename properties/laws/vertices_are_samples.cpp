// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, every vertex is a sample: over one of the grid's points, at
// its height, bit for bit. Source: METHODS, the methods that choose among samples and make none of their own.
// It sees what a bound on errors does not: a stale or shifted height among vertices that a later split would
// bring.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

LawOutcome check(const LawInput& input) {
  const Terrain& terrain = input.terrain;
  const LodFrame frame = fly(*prepared_method(input), cameras(input));
  for (const Vec3& p : frame.mesh.positions) {
    const double i = std::nearbyint(p.x / terrain.spacing_m), j = std::nearbyint(p.y / terrain.spacing_m);
    const bool on_grid = i >= 0 && i < terrain.columns && j >= 0 && j < terrain.rows;
    if (on_grid && terrain.point(static_cast<int>(i), static_cast<int>(j)) == p) continue;
    oracle::Finding finding = law_finding("no_sample", p);
    if (on_grid) finding.gap_m = p.z - terrain.z(static_cast<int>(i), static_cast<int>(j));
    const std::string text = fmt::format(
        "vertex ({}, {}, {}) is no sample; {} m off the nearest one's height", p.x, p.y, p.z, finding.gap_m);
    return violated(text, std::move(finding));
  }
  return frame.mesh.positions.empty() ? vacuous("nothing was drawn") : held();
}

bool draws_samples(const MethodChoice& choice) {
  // ring_tin: its points are samples, unless a terrain has surveyed ones or roads. isolated_quadtree averages
  // heights between tiles, but for `repaired`.
  constexpr std::array<std::string_view, 5> kAll{"full", "restricted_quadtree", "greedy_tin", "ring_tin",
                                                 "block_bintree"};
  return std::find(kAll.begin(), kAll.end(), choice.method->id) != kAll.end() ||
         (choice.method->id == "isolated_quadtree" && choice.variant->name == "repaired");
}

}  // namespace

Law law_vertices_are_samples() {
  return {
      .id = "vertices_are_samples",
      .statement = "for every terrain, flight and threshold, every vertex is one of the terrain's samples",
      .source = "METHODS M2, M3, M4, reference methods",
      .applies = draws_samples,
      .promised = draws_samples,
      .check = check};
}

}  // namespace plumbline::properties
