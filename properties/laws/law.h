// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "oracle/finding.h"
#include "scenarios/camera.h"
#include "scenarios/terrain.h"
#include "scenarios/trajectory.h"

namespace plumbline::properties {

/// All that a law is judged on; a case file holds exactly this (and the finding expected).
struct LawInput {
  std::string method;  ///< full id with variant
  Options options;
  Terrain terrain;
  std::vector<CameraPose> poses;  ///< a flight; the last pose is the one judged
  double fov_y_deg = 60;
  int width_px = 1280, height_px = 720;
  double threshold_px = 1;
  /// Makes the method to judge, unprepared. Empty: the registry's `method` with `options`. For methods that
  /// are in no registry: a user's own before it is registered, a broken one that a law must catch. Not part
  /// of a case file.
  std::function<std::unique_ptr<LodMethod>()> make;
};

/// The outcome of one trial.
struct LawOutcome {
  enum class Kind {
    held,
    vacuous,  ///< the precondition did not hold, or nothing happened that the law speaks of
    violated,
  } kind = Kind::vacuous;
  std::string what;  ///< violated: one line with places and sizes; vacuous: why
  std::optional<oracle::Finding> finding;
  /// A law that is judged in several parts in one trial (each symmetry of the grid) reports each of them.
  struct Part {
    std::string name;
    bool held = true;
  };
  std::vector<Part> parts;
};
/// As the enumerator is spelled.
constexpr std::string_view outcome_name(LawOutcome::Kind kind) {
  switch (kind) {
    case LawOutcome::Kind::held:
      return "held";
    case LawOutcome::Kind::vacuous:
      return "vacuous";
    case LawOutcome::Kind::violated:
      return "violated";
  }
  return "unknown";
}

/// A law: what must hold for every terrain, camera and threshold, for the methods that promise it.
struct Law {
  std::string id;         ///< "conforming", "M4_C3_split_test_is_monotone", …
  std::string statement;  ///< with its quantifiers
  std::string source;     ///< paper, section, or METHODS id
  /// Whether the law speaks of this method at all; and whether the method promises it. A law that applies but
  /// is not promised is measured, not held against the method.
  std::function<bool(const MethodChoice&)> applies;
  std::function<bool(const MethodChoice&)> promised;
  /// One trial. Throws InputError where the method cannot take the terrain or its options.
  std::function<LawOutcome(const LawInput&)> check;
};

/// In the order in which reports list them.
const std::vector<Law>& all_laws();
/// Throws InputError naming the nearest known law.
const Law& find_law(std::string_view id);

/// `law.check` after the input itself was looked at: throws InputError for an empty flight, a terrain whose
/// samples do not fill its grid or are not finite, a spacing or threshold that is not positive and finite.
LawOutcome judge(const Law& law, const LawInput& input);

}  // namespace plumbline::properties
