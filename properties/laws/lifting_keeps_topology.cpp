// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, the scene lifted by 1024 m gives the identical topology, and
// vertices lifted by as much: no decision depends on where heights are counted from. Source: ORACLES,
// Invariance (shift). A power of two: heights of whole metres and their halves stay exact, so methods that
// decide by differences of heights decide on the same bits.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

constexpr double kLiftM = 1024;

/// Vertices between samples are interpolated on larger numbers: a few ulps of these.
constexpr double kInterpolationRounding = 0x1p-46;

LawOutcome check(const LawInput& input) {
  LawInput lifted = input;
  for (double& z : lifted.terrain.heights_m) z += kLiftM;
  for (CameraPose& pose : lifted.poses) {
    pose.position.z += kLiftM;
    pose.look_at.z += kLiftM;
  }
  const LodFrame low = fly(*prepared_method(input), cameras(input));
  LodFrame high = fly(*prepared_method(lifted), cameras(lifted));
  const double largest =
      std::max(std::fabs(input.terrain.lowest_m()), std::fabs(input.terrain.highest_m())) + kLiftM;
  // Heights are compared to within rounding, all else bit by bit.
  if (high.mesh.positions.size() == low.mesh.positions.size()) {
    for (std::size_t v = 0; v < high.mesh.positions.size(); ++v) {
      double& z = high.mesh.positions[v].z;
      if (std::fabs(z - kLiftM - low.mesh.positions[v].z) <= largest * kInterpolationRounding) {
        z = low.mesh.positions[v].z;
      }
    }
  }
  if (const std::string difference = first_difference(low, high); !difference.empty()) {
    return violated(fmt::format("the scene lifted by {} m: {}", kLiftM, difference),
                    law_finding("datum_shows", input.poses.back().position));
  }
  return low.mesh.triangles.empty() ? vacuous("nothing was drawn") : held();
}

}  // namespace

Law law_lifting_keeps_topology() {
  return {
      .id = "lifting_keeps_topology",
      .statement =
          "for every terrain, flight and threshold, the scene lifted by 1024 m gives the identical topology, "
          "lifted by as much",
      .source = "ORACLES, Invariance",
      .applies = [](const MethodChoice&) { return true; },
      // Of methods that decide by differences of heights. The others interpolate first and subtract then, so
      // that rounding may settle a near tie otherwise; there it is a measurement.
      .promised =
          [](const MethodChoice& choice) {
            constexpr std::array<std::string_view, 6> kByDifferences{"full",          "restricted_quadtree",
                                                                     "haar_quadtree", "isolated_quadtree",
                                                                     "block_bintree", "vertex_tree"};
            return std::find(kByDifferences.begin(), kByDifferences.end(), choice.method->id) !=
                   kByDifferences.end();
          },
      .check = check};
}

}  // namespace plumbline::properties
