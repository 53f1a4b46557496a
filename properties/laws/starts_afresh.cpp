// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, what flew before leaves no trace where a flight starts
// afresh: after reset(), and in a clone, the next update is a fresh method's first. Source: LodMethod's
// contract (METHODS, interface). path_independent asks more, and methods with memory do not promise it; this
// they all do.

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

LawOutcome check(const LawInput& input) {
  const std::vector<Camera> flight = cameras(input);
  const Camera& first = flight.front();
  LodFrame fresh;
  prepared_method(input)->update(first, fresh);

  const std::unique_ptr<LodMethod> method = prepared_method(input);
  LodFrame frame;
  bool something_to_forget = false;  // where all frames are the same, a trace could not be told from none
  for (const Camera& camera : flight) {
    method->update(camera, frame);
    something_to_forget = something_to_forget || !first_difference(frame, fresh).empty();
  }
  flyer(*method, input.threshold_px)->update(first, frame);
  if (const std::string difference = first_difference(frame, fresh); !difference.empty()) {
    return violated("a clone made after the flight, against a fresh method: " + difference,
                    law_finding("clone_remembers", first.position));
  }
  method->reset();
  method->update(first, frame);
  if (const std::string difference = first_difference(frame, fresh); !difference.empty()) {
    return violated("after the flight and reset(), against a fresh method: " + difference,
                    law_finding("reset_forgets_not", first.position));
  }
  if (!something_to_forget && !is_threshold_blind(input) && !is_camera_blind(input))
    return vacuous("every frame of the flight has the same mesh");
  return held();
}

}  // namespace

Law law_starts_afresh() {
  return {
      .id = "starts_afresh",
      .statement =
          "for every terrain, threshold and flight: after reset(), and in a clone made after the flight, the "
          "next update is a fresh method's first",
      .source = "METHODS, interface",
      .applies = [](const MethodChoice&) { return true; },
      // The contract of every method; no method states it.
      .promised = [](const MethodChoice&) { return true; },
      .check = check};
}

}  // namespace plumbline::properties
