// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, the frame's mesh covers no point twice, edge to edge and at
// equal heights, with no hole inside. Where it ends is another law's matter (covers_domain). Source: METHODS
// M1.C1, M3.C1, M4.C1; Pajarola's restricted quadtree promises it by construction. Decided exactly by oracle
// O1.

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "oracle/conformity.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

/// The finding that says most: the largest gap; without one, the first in the report's order.
const oracle::Finding& worst(const std::vector<oracle::Finding>& findings) {
  const oracle::Finding* chosen = &findings.front();
  for (const oracle::Finding& finding : findings) {
    if (std::fabs(finding.gap_m) > std::fabs(chosen->gap_m)) chosen = &finding;
  }
  return *chosen;
}

LawOutcome check(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const std::vector<Camera> flight = cameras(input);
  const LodFrame frame = fly(*method, flight);
  if (frame.mesh.triangles.empty() && frame.domain.loops.empty()) {
    return vacuous("the frame promises no domain and draws nothing");
  }
  std::vector<oracle::Finding> findings = oracle::check_conformity(frame.mesh, frame.domain).findings;
  std::erase_if(findings,
                [](const oracle::Finding& finding) { return finding.code == oracle::FindingCode::outline; });
  if (!findings.empty()) {
    oracle::Finding finding = worst(findings);
    std::string what = fmt::format("{} at ({}, {}, {})", oracle::finding_name(finding.code), finding.at.x,
                                   finding.at.y, finding.at.z);
    if (finding.gap_m != 0) {
      const Camera& camera = flight.back();
      const double depth_m = camera.depth(finding.at);
      what += fmt::format(", gap {:.6g} m", std::fabs(finding.gap_m));
      if (depth_m > 0) {
        // The gap held square to the view: METHODS states a crack's size so.
        finding.gap_px = std::fabs(finding.gap_m) * camera.kappa_px / depth_m;
        what += fmt::format(" = {:.6g} px = {:.4g} tau at depth {:.6g} m", finding.gap_px,
                            finding.gap_px / input.threshold_px, depth_m);
      }
    }
    what += fmt::format("; {} findings in {} triangles", findings.size(), frame.mesh.triangles.size());
    return violated(std::move(what), std::move(finding));
  }
  if (!has_several_levels(frame.mesh) && !is_threshold_blind(input)) {
    return vacuous("the mesh has one level of detail: no seam");
  }
  return held();
}

}  // namespace

Law law_conforming() {
  return {
      .id = "conforming",
      .statement =
          "for every terrain, flight and threshold the mesh covers no point twice, edge to edge, at equal "
          "heights, with no hole inside",
      .source = "METHODS M1.C1, M3.C1, M4.C1; ORACLES O1",
      .applies = [](const MethodChoice&) { return true; },
      .promised = [](const MethodChoice& choice) { return choice.promises(Promise::conforming); },
      .check = check};
}

}  // namespace plumbline::properties
