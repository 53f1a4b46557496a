// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, a second update with the camera of the first changes nothing:
// mesh, vertex keys and domain stay bit for bit. Source: METHODS, interface (`update` may keep state; it must
// settle).

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

LawOutcome check(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const std::vector<Camera> flight = cameras(input);
  const LodFrame first = fly(*method, flight);
  LodFrame second = first;  // the frame is overwritten whole: leftovers must not show either
  method->update(flight.back(), second);
  if (const std::string difference = first_difference(first, second); !difference.empty()) {
    return violated("a second update with the same camera: " + difference,
                    law_finding("second_update_differs", flight.back().position));
  }
  return first.mesh.triangles.empty() ? vacuous("nothing was drawn") : held();
}

}  // namespace

Law law_idempotent() {
  return {.id = "idempotent",
          .statement =
              "for every terrain, flight and threshold, a second update with the same camera changes nothing",
          .source = "METHODS, interface",
          .applies = [](const MethodChoice&) { return true; },
          .promised = [](const MethodChoice& choice) { return choice.promises(Promise::idempotent); },
          .check = check};
}

}  // namespace plumbline::properties
