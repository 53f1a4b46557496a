// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, threshold, flight and camera X, the mesh at X after the flight is the mesh of a
// fresh method at X; and after the flight, both a clone and the method itself once reset are fresh. Source:
// METHODS, interface; M2.S4 is its failure elsewhere.

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

LawOutcome check(const LawInput& input) {
  const std::vector<Camera> flight = cameras(input);
  if (flight.size() < 2) return vacuous("a flight of one pose has no path");
  const Camera& last = flight.back();

  LodFrame fresh;
  prepared_method(input)->update(last, fresh);

  const std::unique_ptr<LodMethod> method = prepared_method(input);
  LodFrame frame;
  bool path_mattered = false;  // some frame on the way differs, so there was something to forget
  for (const Camera& camera : flight) {
    method->update(camera, frame);
    if (&camera != &last) path_mattered = path_mattered || !first_difference(frame, fresh).empty();
  }
  const auto differs = [&](const char* how, const char* kind) -> std::optional<LawOutcome> {
    const std::string difference = first_difference(frame, fresh);
    if (difference.empty()) return std::nullopt;
    return violated(std::string(how) + ", against a fresh method: " + difference,
                    law_finding(kind, last.position));
  };
  if (auto outcome = differs("after the flight", "path_shows")) return *outcome;
  flyer(*method, input.threshold_px)->update(last, frame);
  if (auto outcome = differs("a clone made after the flight", "clone_remembers")) return *outcome;
  // Away and reset: the last update before it must leave nothing behind.
  method->update(flight.front(), frame);
  method->reset();
  method->update(last, frame);
  if (auto outcome = differs("after the flight and reset()", "reset_forgets_not")) return *outcome;

  if (!path_mattered && !is_threshold_blind(input) && !is_camera_blind(input))
    return vacuous("every frame of the flight has the same mesh");
  return held();
}

}  // namespace

Law law_path_independent() {
  return {.id = "path_independent",
          .statement =
              "for every terrain, threshold, flight and camera X: the mesh at X after the flight, from a "
              "clone made "
              "after it, and after reset() equals a fresh method's at X",
          .source = "METHODS, interface; M2.S4",
          .applies = [](const MethodChoice&) { return true; },
          .promised = [](const MethodChoice& choice) { return choice.promises(Promise::path_independent); },
          .check = check};
}

}  // namespace plumbline::properties
