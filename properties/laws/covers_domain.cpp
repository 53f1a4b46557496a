// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, the mesh reaches the outline of the domain that the frame
// promises, and does not go beyond it. Source: ORACLES O1 (`outline`); METHODS M1.S2 expects a method whose
// border recedes. Decided exactly by oracle O1.

#include <algorithm>

#include <fmt/format.h>

#include "oracle/conformity.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

LawOutcome check(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const LodFrame frame = fly(*method, cameras(input));
  if (frame.mesh.triangles.empty() && frame.domain.loops.empty()) {
    return vacuous("the frame promises no domain and draws nothing");
  }
  const oracle::ConformityReport report = oracle::check_conformity(frame.mesh, frame.domain);
  const oracle::Finding* worst = nullptr;
  double area_m2 = 0;
  for (const oracle::Finding& finding : report.findings) {
    if (finding.code != oracle::FindingCode::outline) continue;
    area_m2 += finding.area_m2;
    if (worst == nullptr || finding.area_m2 > worst->area_m2) worst = &finding;
  }
  if (worst == nullptr) return held();
  return violated(
      fmt::format("outline differs from the promised domain by {:.6g} m2, most at ({}, {}), {:.6g} m "
                  "away; {} triangles",
                  area_m2, worst->at.x, worst->at.y, worst->distance_m, frame.mesh.triangles.size()),
      *worst);
}

}  // namespace

Law law_covers_domain() {
  return {.id = "covers_domain",
          .statement = "for every terrain, flight and threshold the mesh ends where the promised domain ends",
          .source = "METHODS M1.S2; ORACLES O1",
          .applies = [](const MethodChoice&) { return true; },
          .promised = [](const MethodChoice& choice) { return choice.promises(Promise::covers_domain); },
          .check = check};
}

}  // namespace plumbline::properties
