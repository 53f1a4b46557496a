// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/laws/law.h"

/// The hunt for counterexamples: random cases, every law, and the smallest that breaks it.
namespace plumbline::properties {

/// How far a hunt has come.
struct FuzzProgress {
  std::string method;
  std::uint64_t cases = 0;       ///< of this method
  std::uint64_t violations = 0;  ///< trials, over all laws
  double seconds = 0;            ///< since the start
};

/// What to hunt for, and for how long.
struct FuzzOptions {
  std::string method;       ///< full id; empty: every registered method and variant
  std::string law;          ///< empty: all that apply
  double seconds = 0;       ///< stop after this long (each method has an equal share); 0: no limit
  std::uint64_t cases = 0;  ///< stop after so many cases a method; 0: no limit. One of the two must be given.
  std::uint64_t seed = 1;
  std::filesystem::path out;  ///< folder for case files; empty: none are written
  /// Judge only inputs that this accepts, and shrink among them (terrain below a slope, one kind of camera).
  /// Empty: all.
  std::function<bool(const LawInput&)> accept;
  std::function<void(const FuzzProgress&)> progress;  ///< now and then
  const std::atomic<bool>* cancelled = nullptr;
};

/// One law on one method.
struct LawTally {
  std::string method;
  std::string law;
  bool promised = false;
  std::uint64_t held = 0, vacuous = 0, violated = 0;
  std::uint64_t refused = 0;  ///< cases that the method does not take (an InputError): not judged
  /// For laws judged in parts: judged and violated, by part.
  struct PartTally {
    std::uint64_t judged = 0, violated = 0;
  };
  std::map<std::string, PartTally> parts;
  std::optional<std::uint64_t> first_violation;  ///< case number
  /// The smallest counterexample: of the first few violations, each shrunk, the least complex.
  std::optional<LawInput> smallest;
  LawOutcome smallest_outcome;
  std::filesystem::path case_file;  ///< where it was written; empty if it was not
  [[nodiscard]] std::uint64_t judged() const { return held + violated; }
};

/// What a hunt found.
struct FuzzReport {
  std::uint64_t seed = 0;
  std::map<std::string, std::uint64_t> cases;  ///< tried, by method
  std::vector<LawTally> tallies;               ///< methods in registry order, laws in theirs
  /// A law that was tried and had nothing to judge: each is a finding 110, never a pass.
  std::vector<oracle::Finding> nothing_judged;
  bool interrupted = false;
  /// No promised law was violated, and none had nothing to judge.
  [[nodiscard]] bool pass() const;
};

/// With `cases` and `seed` the report is the same everywhere; with `seconds` the number of cases is the
/// clock's, but case k of a seed is always the same. Throws InputError for an unknown method or law, a law
/// that does not speak of the method, or neither seconds nor cases.
FuzzReport fuzz(const FuzzOptions& options);

}  // namespace plumbline::properties
