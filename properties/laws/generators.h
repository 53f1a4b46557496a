// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "properties/laws/law.h"

/// Random inputs for the laws, and simpler ones from a given one. RapidCheck draws and walks the shrink tree;
/// it does not show here.
namespace plumbline::properties {

/// An input and what was drawn on purpose, for counting.
struct DrawnCase {
  LawInput input;
  std::string terrain_shape;
  std::string camera_class;  ///< of the judged pose
  std::string threshold_class;
};

/// The classes that a long enough campaign must have hit.
const std::vector<std::string>& terrain_shapes();
const std::vector<std::string>& camera_classes();
const std::vector<std::string>& threshold_classes();

/// Case `index` of `seed` for a method: the same on every machine, whatever was drawn before. Heights and
/// camera coordinates are whole numbers, so that shrinking arrives at small ones.
DrawnCase draw_case(const std::string& method, std::uint64_t seed, std::uint64_t index);

/// How much there is to a case; less is simpler, compared from the front: poses, samples, options, samples
/// that are not 0, sum of |height|, characters to write the camera down, its largest coordinate.
std::vector<double> complexity(const LawInput& input);

/// Simpler inputs to try next, boldest first. Each has a smaller `complexity`.
std::vector<LawInput> simpler_inputs(const LawInput& input);

struct Shrunk {
  LawInput input;
  LawOutcome outcome;
  std::uint64_t trials = 0;
};
/// Goes down the shrink tree while the law is still violated with the same finding code, to a local minimum
/// or until `trials_max` trials were made. Requires: the law is violated on `input`.
/// Candidates that `accept` (if given) turns down are not tried, so a search for gentle terrain stays on it.
Shrunk shrink(const Law& law, const LawInput& input, const LawOutcome& outcome,
              std::uint64_t trials_max = 200000, const std::function<bool(const LawInput&)>& accept = {});

}  // namespace plumbline::properties
