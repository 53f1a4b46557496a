// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, camera and thresholds τ < τ′ at which a method promises to cover the same domain,
// the mesh at τ′ has no more triangles than the mesh at τ, each made by a flyer without memory of the other.
// Source: the meaning of a threshold (METHODS, notation). Domains may differ where culling is by blocks,
// whose sizes follow τ.

#include <array>

#include <fmt/format.h>

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

/// What two descriptions of one region share, however they are cut into loops: area and first moments, times
/// constants. Exact for whole coordinates.
std::array<double, 3> moments(const PlanDomain& domain) {
  std::array<double, 3> sums{};
  for (const auto& loop : domain.loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = loop[k], b = loop[(k + 1) % loop.size()];
      const double doubled_area = a.x * b.y - b.x * a.y;
      sums[0] += doubled_area;
      sums[1] += doubled_area * (a.x + b.x);
      sums[2] += doubled_area * (a.y + b.y);
    }
  }
  return sums;
}

LawOutcome check(const LawInput& input) {
  constexpr std::array<double, 7> kFactors{0.25, 0.5, 0.875, 1, 1.125, 2, 4};
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const Camera camera = judged_camera(input);
  std::array<std::size_t, kFactors.size()> triangles{};
  std::array<std::array<double, 3>, kFactors.size()> domains{};
  bool fell = false, any = false;
  for (std::size_t k = 0; k < kFactors.size(); ++k) {
    LodFrame frame;
    flyer(*method, input.threshold_px * kFactors[k])->update(camera, frame);
    triangles[k] = frame.mesh.triangles.size();
    domains[k] = moments(frame.domain);
    any = any || triangles[k] > 0;
    for (std::size_t finer = 0; finer < k; ++finer) {
      if (domains[finer] != domains[k]) continue;
      fell = fell || triangles[k] < triangles[finer];
      if (triangles[k] <= triangles[finer]) continue;
      return violated(
          fmt::format("{} triangles at {} px, but {} at {} px", triangles[finer],
                      input.threshold_px * kFactors[finer], triangles[k], input.threshold_px * kFactors[k]),
          law_finding("more_triangles_at_larger_tau", camera.position));
    }
  }
  // A method that ignores the threshold keeps the law by drawing the same; the others were not asked
  // anything.
  if (fell || (any && is_threshold_blind(input))) return held();
  return vacuous("the same number of triangles at every threshold tried");
}

}  // namespace

Law law_triangles_fall_with_tau() {
  return {.id = "triangles_fall_with_tau",
          .statement =
              "for every terrain and camera, a larger threshold never gives more triangles on the same "
              "promised domain",
          .source = "METHODS, notation (threshold)",
          .applies = [](const MethodChoice&) { return true; },
          .promised =
              [](const MethodChoice& choice) {
                return choice.promises(Promise::monotone_in_tau) || choice.promises(Promise::threshold_blind);
              },
          .check = check};
}

}  // namespace plumbline::properties
