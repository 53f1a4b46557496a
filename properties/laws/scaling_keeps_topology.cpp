// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, the scene made twice as large (spacing, heights, cameras)
// gives the same topology, and coordinates doubled exactly. Perspective knows no unit of length, and a factor
// of two moves no bit of a mantissa. Source: ORACLES, "Invariance"; holds for methods whose constants are all
// dimensionless, or lengths that are doubled too (the rings of M2).

#include <fmt/format.h>

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

LawInput doubled(const LawInput& input) {
  LawInput twice = input;
  scale_lengths(twice, 2);
  twice.terrain.spacing_m *= 2;
  for (double& z : twice.terrain.heights_m) z *= 2;
  for (CameraPose& pose : twice.poses) pose = {pose.position * 2, pose.look_at * 2};
  return twice;
}

LodFrame doubled(LodFrame frame) {
  for (Vec3& p : frame.mesh.positions) p = p * 2;
  for (auto& loop : frame.domain.loops) {
    for (Vec2& p : loop) p = p * 2;
  }
  return frame;
}

LawOutcome check(const LawInput& input) {
  const LawInput twice = doubled(input);
  const LodFrame once = fly(*prepared_method(input), cameras(input));
  const LodFrame big = fly(*prepared_method(twice), cameras(twice));
  if (const std::string difference = first_difference(doubled(once), big); !difference.empty()) {
    return violated("the mesh doubled against the mesh of the doubled scene: " + difference,
                    law_finding("scale_shows", input.poses.back().position));
  }
  if (once.mesh.triangles.empty()) return vacuous("nothing was drawn");
  return held();
}

}  // namespace

Law law_scaling_keeps_topology() {
  return {
      .id = "scaling_keeps_topology",
      .statement =
          "for every terrain, flight and threshold, the scene scaled by 2 gives the identical topology and "
          "exactly "
          "doubled coordinates",
      .source = "ORACLES, Invariance",
      .applies = [](const MethodChoice&) { return true; },
      // No method states it; it is held against all of them.
      .promised = [](const MethodChoice&) { return true; },
      .check = check};
}

}  // namespace plumbline::properties
