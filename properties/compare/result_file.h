// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "properties/verdict/comparison.h"

/// Result files read back: `results.json` of a suite and what `plumbline check --json` writes, as the one
/// shape that can be compared. Keys that are not known are passed over, or compared as what they look like.
namespace plumbline::compare {

inline constexpr std::string_view kResultsSchema = "plumbline.results/1";
inline constexpr std::string_view kCheckSchema = "plumbline.check/1";

/// One figure or statement of a run, a mesh or a whole result.
struct Reading {
  enum class Kind { number, not_judged, text };
  std::string path;  ///< "displacement_px.p99", "conformity.crack", "state"
  Kind kind = Kind::not_judged;
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string text;
  verdict::Direction direction = verdict::Direction::neither;
  bool counted = false;  ///< a whole number of things: no tolerance applies
  int rank = -1;         ///< of a text that is better or worse: larger is worse; -1: neither
};

/// What figures are about: a run of a suite; of a check the whole ("all meshes"), a mesh, a seam.
struct Subject {
  std::string id;
  std::vector<Reading> readings;  ///< in the file's order
  std::uint64_t frames = 0;       ///< a hash of all frames' bytes as values; 0: there are none
};

struct GateReading {
  std::string run, name, limit;
  bool pass = false;
};

/// A finding is known by its code, kind, severity, mesh and place to the last bit.
struct FindingReading {
  int code = 0;
  std::string name, kind, mesh;
  std::array<double, 3> at{};
  bool hazard = false;  ///< what was one and is a fault now is another finding
  auto operator<=>(const FindingReading&) const = default;
};

struct ResultFile {
  std::string name;  ///< the path as given
  std::string schema;
  std::vector<Reading> verdicts;  ///< of the whole: "pass", "verdict", "interrupted", "selftest"
  std::vector<Reading> settings;  ///< what was flown: suite, viewport, terrains, …
  std::vector<Subject> subjects;
  std::vector<GateReading> gates;
  std::vector<std::string> vacuous;
  std::vector<FindingReading> findings;
  bool counts_by_code = false;    ///< a code that is not in "findings_by_code" was found no time
  bool findings_complete = true;  ///< false: the file lists the worst only, though its counts are complete
};

/// Reads a file of at most 512 MiB. Memory is bounded by its size; frames are hashed as they pass by. Throws
/// InputError, one line, for a file that cannot be read, that is not JSON or ends early, that nests deeper
/// than 64 levels, that has another schema, or a value of another type where a known key stands.
ResultFile read_result_file(const std::filesystem::path& path);

/// The same of a text; `name` is used in complaints.
ResultFile parse_result(std::string_view text, const std::string& name);

}  // namespace plumbline::compare
