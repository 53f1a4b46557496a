// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law of M3, isolated division (METHODS M3.C2): what every split test reads, recomputed from the samples.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "algorithms/isolated_quadtree/tile_grid.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

using isolated_quadtree::Node;
using isolated_quadtree::TileGrid;

/// Means of two heights are exact for whole metres; relative to the largest height otherwise.
constexpr double kRounding = 0x1p-50;

/// The largest distance of a node's 5 × 5 samples from the fan over nine of them, metres, as far as there is
/// data.
double own_deviation_m(const Terrain& terrain, const TileGrid& grid, Node node) {
  const int q = node.side / 4;
  const auto sample = [&](int a, int b) -> std::array<int, 2> { return {node.i + a * q, node.j + b * q}; };
  double most = 0;
  for (int b = 0; b <= 4; ++b) {
    for (int a = 0; a <= 4; ++a) {
      if (a % 2 == 0 && b % 2 == 0) continue;  // a corner of the fan
      // On the rim between two corners; inside, half way from the centre to the corner beyond.
      std::array<int, 2> from{2, 2}, to{2 * a - 2, 2 * b - 2};
      if (a == 0 || a == 4) {
        from = {a, b - 1};
        to = {a, b + 1};
      } else if (b == 0 || b == 4) {
        from = {a - 1, b};
        to = {a + 1, b};
      }
      const auto [fi, fj] = sample(from[0], from[1]);
      const auto [ti, tj] = sample(to[0], to[1]);
      const auto [i, j] = sample(a, b);
      if (!grid.has_data(fi, fj) || !grid.has_data(ti, tj)) continue;
      most = std::max(most, std::fabs(terrain.z(i, j) - (terrain.z(fi, fj) + terrain.z(ti, tj)) / 2));
    }
  }
  return most;
}

LawOutcome check(const LawInput& input) {
  const double tile_samples = option_number(input.options, "tile_size", 257);
  prepared_method(input);  // refuses what the method does not take
  const Terrain& terrain = input.terrain;
  int side = static_cast<int>(tile_samples) - 1;
  while (side / 2 >= std::max(terrain.columns, terrain.rows) && side > 2)
    side /= 2;  // larger ones add nothing
  const TileGrid grid(terrain, side);
  const double doubt_m = std::max(std::fabs(terrain.lowest_m()), std::fabs(terrain.highest_m())) * kRounding;
  LawOutcome outcome = vacuous("no node has an error");
  const auto judge_node = [&](const auto& self, Node node) -> void {
    if (outcome.kind == LawOutcome::Kind::violated) return;
    const int h = node.half();
    const TileGrid::Record& record = grid.record(node);
    const bool centred = grid.has_data(node.i + h, node.j + h);
    const Vec3 center{(node.i + h) * terrain.spacing_m, (node.j + h) * terrain.spacing_m,
                      centred ? terrain.z(node.i + h, node.j + h) : 0};
    double least_m = 0;
    if (node.side > 2) {
      least_m = own_deviation_m(terrain, grid, node);
      for (const int j : {node.j, node.j + h}) {
        for (const int i : {node.i, node.i + h}) {
          self(self, {i, j, h});
          least_m = std::max(least_m, grid.error_m({i, j, h}));
        }
      }
    }
    if (outcome.kind == LawOutcome::Kind::violated) return;
    if (record.error_m > 0) outcome = held();
    if (record.error_m >= least_m - doubt_m && record.center_m == center.z) return;
    oracle::Finding finding = law_finding("error_not_conservative", center);
    finding.gap_m = least_m - record.error_m;
    outcome = violated(
        fmt::format("the node of {} cells at ({}, {}) has error {} m with its centre at {} m; its samples "
                    "and children ask for {} m, and the centre sample is at {} m",
                    node.side, node.i, node.j, record.error_m, record.center_m, least_m, center.z),
        std::move(finding));
  };
  for (int b = 0; b < grid.tiles_y(); ++b) {
    for (int a = 0; a < grid.tiles_x(); ++a) judge_node(judge_node, grid.tile(a, b));
  }
  return outcome;
}

bool is_isolated(const MethodChoice& choice) { return choice.method->id == "isolated_quadtree"; }

}  // namespace

Law law_isolated_error_is_conservative() {
  return {.id = "M3_C2_error_is_conservative",
          .statement =
              "for every terrain and node, the error is no less than its children's, and no less than its "
              "samples' "
              "distance from its fan",
          .source = "METHODS M3.C2",
          .applies = is_isolated,
          .promised = is_isolated,
          .check = check};
}

}  // namespace plumbline::properties
