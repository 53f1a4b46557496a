// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/mutants/mutant_list.h"

/// The hunt: laws over random cases, then oracles over short flights, until one finds the mutant.
///
/// A difference of output is no find. A law finds a mutant if the method promises the law, the law is
/// violated with the mutant and not without it on the very same input, and the law is none that the method is
/// known to break (known_to_fail). Laws and oracles that have nothing left to judge find it too (ORACLES,
/// "Never vacuous"). An oracle finds it if a gate fails that holds for the method without it on the same
/// flights.
namespace plumbline::mutants {

/// Switches a mutant on while it lives.
class Switched {
 public:
  explicit Switched(std::string_view name);
  ~Switched();
  Switched(const Switched&) = delete;
  Switched& operator=(const Switched&) = delete;
};

inline constexpr std::uint64_t kSeed = 1;

struct Kill {
  std::string by;           ///< "law conforming", "gate displacement_px.uncovered_px == 0", …
  std::uint64_t cases = 0;  ///< tried until then; 0: an oracle's flights
  std::string what;         ///< one line
};

/// Cases that are tried with each law before the oracles fly; most mutants fall within ten.
inline constexpr std::uint64_t kCases = 300;
/// And after that, for those that neither found.
inline constexpr std::uint64_t kMostCases = 1500;
/// Cases of judge_unmutated. (A hunt looks at its own input without the mutant, too.)
inline constexpr std::uint64_t kCleanCases = 150;

std::optional<Kill> hunt(const Mutant& mutant);

/// What the battery says of a method without a mutant: one line for each promised law that is violated though
/// not known to fail, or that judged nothing, and each gate that fails. Empty: clean.
std::vector<std::string> judge_unmutated(std::string_view method, std::uint64_t cases = kCleanCases);

/// Promises that methods break as published (docs/claims.md): method and law. Nothing is found by them.
const std::set<std::pair<std::string, std::string>>& all_known_to_fail();

/// The whole table in Markdown, as docs/mutants.md has it.
std::string mutant_table();

}  // namespace plumbline::mutants
