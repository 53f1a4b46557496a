// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, a picture of twice the pixels at twice the threshold gives
// the identical mesh: a threshold is so many pixels of the picture. Source: METHODS, notation (threshold);
// ORACLES, Invariance.

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

LawOutcome check(const LawInput& input) {
  LawInput larger = input;
  larger.width_px *= 2;
  larger.height_px *= 2;
  larger.threshold_px *= 2;
  const LodFrame once = fly(*prepared_method(input), cameras(input));
  const LodFrame twice = fly(*prepared_method(larger), cameras(larger));
  if (const std::string difference = first_difference(once, twice); !difference.empty()) {
    return violated("twice the pixels at twice the threshold: " + difference,
                    law_finding("threshold_is_no_pixels", input.poses.back().position));
  }
  return once.mesh.triangles.empty() ? vacuous("nothing was drawn") : held();
}

}  // namespace

Law law_threshold_is_in_pixels() {
  return {.id = "threshold_is_in_pixels",
          .statement =
              "for every terrain, flight and threshold, twice the pixels at twice the threshold give the "
              "identical "
              "mesh",
          .source = "METHODS, notation (threshold); ORACLES, Invariance",
          .applies = [](const MethodChoice& choice) { return !choice.promises(Promise::camera_blind); },
          .promised = [](const MethodChoice& choice) { return !choice.promises(Promise::camera_blind); },
          .check = check};
}

}  // namespace plumbline::properties
