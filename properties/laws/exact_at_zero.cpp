// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain and flight, as τ → 0 the mesh meets every sample it covers. Judged by oracle O2's
// error outside the envelope of both cell diagonals, which is zero exactly when the samples are met and the
// edges run along the grid; the error against the declared diagonal would blame a method for its own
// diagonals.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "oracle/vertical.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

/// "Vanishing", pixels: an error of one ulp of a metre is then still 10³ pixels at 10⁵ m, so that every error
/// which a double can hold asks for a split; yet κ/τ stays far from overflow.
constexpr double kVanishingThresholdPx = 0x1p-60;

/// Interpolated heights are rounded a few times each; relative to the largest height on the terrain. 2⁻⁴⁶ is
/// 64 ulps.
constexpr double kInterpolationRounding = 0x1p-46;

LawOutcome check(const LawInput& input) {
  LawInput vanishing = input;
  vanishing.threshold_px = kVanishingThresholdPx;
  const std::unique_ptr<LodMethod> method = prepared_method(vanishing);
  const LodFrame frame = fly(*method, cameras(vanishing));
  const oracle::VerticalError error = oracle::vertical_error(frame.mesh, vanishing.terrain);
  if (error.area_m2 == 0) return vacuous("no area was drawn");
  const double largest = std::max(std::fabs(input.terrain.lowest_m()), std::fabs(input.terrain.highest_m()));
  if (error.certain_max > largest * kInterpolationRounding) {
    oracle::Finding finding = law_finding(
        "sample_missed", {error.certain_at.x, error.certain_at.y,
                          input.terrain.surface_height_m(error.certain_at.x, error.certain_at.y)});
    finding.gap_m = error.certain_max;
    return violated(fmt::format("an error of {:.6g} m remains at ({}, {}) at {:.3g} px", error.certain_max,
                                error.certain_at.x, error.certain_at.y, kVanishingThresholdPx),
                    std::move(finding));
  }
  if (input.terrain.lowest_m() == input.terrain.highest_m())
    return vacuous("the terrain is level: any mesh meets it");
  return held();
}

}  // namespace

Law law_exact_at_zero() {
  return {.id = "exact_at_zero",
          .statement =
              "for every terrain and flight, a vanishing threshold meets every sample that the mesh covers",
          .source = "METHODS, notation (threshold); ORACLES O2 (certain_max)",
          .applies = [](const MethodChoice&) { return true; },
          .promised = [](const MethodChoice& choice) { return choice.promises(Promise::exact_at_zero); },
          .check = check};
}

}  // namespace plumbline::properties
