// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/mutants/hunt.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "algorithms/mutant.h"
#include "properties/harness/run_suite.h"
#include "properties/laws/generators.h"
#include "properties/laws/law.h"
#include "scenarios/error.h"
#include "scenarios/suite.h"

namespace plumbline::mutants {

std::uint64_t switched_on = 0;

Switched::Switched(std::string_view name) { switched_on = number_of(name); }
Switched::~Switched() { switched_on = 0; }

bool known_to_fail(std::string_view method, std::string_view law) {
  static const std::set<std::pair<std::string_view, std::string_view>> known{
      {"haar_quadtree", "screen_error_within_tau"},
      {"haar_quadtree:morph", "continuous_in_camera"},
      {"ring_tin", "conforming"},
      {"ring_tin", "covers_domain"},
      {"ring_tin:fixpoint", "conforming"},
      {"ring_tin:fixpoint", "covers_domain"},
      {"isolated_quadtree", "conforming"},
      {"isolated_quadtree", "covers_domain"},
      {"isolated_quadtree", "screen_error_within_tau"},
      {"isolated_quadtree:no_cos", "conforming"},
      {"isolated_quadtree:no_cos", "covers_domain"},
      {"isolated_quadtree:no_cos", "exact_at_zero"},
      {"isolated_quadtree:no_cos", "screen_error_within_tau"},
      {"block_bintree", "conforming"},
      {"block_bintree", "M4_C3_split_test_is_monotone"},
      {"block_bintree:tri_cull", "conforming"},
      {"block_bintree:tri_cull", "M4_C3_split_test_is_monotone"},
      {"block_bintree:by_distance", "M4_C3_split_test_is_monotone"},
      {"vertex_tree", "conforming"},
      {"vertex_tree:no_contour", "conforming"},
      {"vertex_tree:view_dependent", "conforming"},
  };
  return known.contains({method, law});
}

namespace {

using properties::Law;
using properties::LawInput;
using properties::LawOutcome;
using Kind = LawOutcome::Kind;

struct Asked {
  const Law* law = nullptr;
  bool promised = false;  ///< and not known to fail; the others are watched for having something to judge
};
std::vector<Asked> laws_of(std::string_view method) {
  const MethodChoice choice = find_method(method);
  std::vector<Asked> laws;
  for (const Law& law : properties::all_laws()) {
    if (law.applies(choice)) laws.push_back({&law, law.promised(choice) && !known_to_fail(method, law.id)});
  }
  return laws;
}

/// Nothing if the method does not take the case.
std::optional<LawOutcome> try_law(const Law& law, const LawInput& input) {
  try {
    return properties::judge(law, input);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The flights, and the gates that hold for the methods as they are.
const Suite& suite() {
  static const Suite loaded = load_suite(PLUMBLINE_SOURCE_DIR "/tests/mutants/flights.toml");
  return loaded;
}

/// What fails on the method's flights: gates, and what had nothing to judge.
std::vector<std::pair<std::string, std::string>> fly(std::string_view method) {
  RunOptions options;
  options.methods = {std::string(method)};
  options.pictures = false;
  options.jobs = 1;
  const verdict::SuiteVerdict verdict = run_suite(suite(), options).verdict;
  std::vector<std::pair<std::string, std::string>> failed;
  for (const verdict::GateVerdict& gate : verdict.gates) {
    if (!gate.pass) failed.emplace_back("gate " + gate.name, fmt::format("{}: {:.6g}", gate.run, gate.value));
  }
  for (const std::string& why : verdict.vacuous) failed.emplace_back("nothing_judged (110)", why);
  return failed;
}

}  // namespace

std::optional<Kill> hunt(const Mutant& mutant, std::uint64_t cases) {
  const std::string method(mutant.method);
  const std::vector<Asked> laws = laws_of(method);
  std::vector<std::uint64_t> judged(laws.size(), 0);
  for (std::uint64_t k = 0; k < cases; ++k) {
    const LawInput input = properties::draw_case(method, kSeed, k).input;
    for (std::size_t l = 0; l < laws.size(); ++l) {
      if (!laws[l].promised && judged[l] > 0) continue;
      std::optional<LawOutcome> outcome;
      {
        const Switched on(mutant.name);
        outcome = try_law(*laws[l].law, input);
      }
      if (!outcome || outcome->kind == Kind::vacuous) continue;
      ++judged[l];
      if (outcome->kind == Kind::held || !laws[l].promised) continue;
      const std::optional<LawOutcome> without = try_law(*laws[l].law, input);
      if (without && without->kind == Kind::violated) continue;
      return Kill{"law " + laws[l].law->id, k + 1, outcome->what};
    }
  }
  // judge_unmutated finds something to judge for each of them.
  for (std::size_t l = 0; l < laws.size(); ++l) {
    if (judged[l] == 0) {
      return Kill{"nothing_judged (110)", cases, fmt::format("law {} had nothing to judge", laws[l].law->id)};
    }
  }
  const auto without = fly(method);
  const Switched on(mutant.name);
  for (const auto& [gate, what] : fly(method)) {
    if (std::none_of(without.begin(), without.end(),
                     [&g = gate](const auto& other) { return other.first == g; })) {
      return Kill{gate, 0, what};
    }
  }
  return std::nullopt;
}

std::vector<std::string> judge_unmutated(std::string_view method, std::uint64_t cases) {
  std::vector<std::string> bad;
  for (const Asked& asked : laws_of(method)) {
    std::uint64_t judged = 0;
    for (std::uint64_t k = 0; k < cases; ++k) {
      const auto outcome = try_law(*asked.law, properties::draw_case(std::string(method), kSeed, k).input);
      if (!outcome || outcome->kind == Kind::vacuous) continue;
      ++judged;
      if (!asked.promised) break;
      if (outcome->kind != Kind::violated) continue;
      bad.push_back(fmt::format("law {}, case {}: {}", asked.law->id, k, outcome->what));
      break;
    }
    if (judged == 0) bad.push_back(fmt::format("law {}: nothing judged in {} cases", asked.law->id, cases));
  }
  for (const auto& [gate, what] : fly(method)) bad.push_back(fmt::format("{}: {}", gate, what));
  return bad;
}

std::string mutant_table() {
  std::string out =
      "| mutant | method | slip | killed by | after cases |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const Mutant& mutant : mutant_list()) {
    const std::optional<Kill> kill = hunt(mutant);
    out += fmt::format("| {} | {} | {} | {} | {} |\n", mutant.name, mutant.method, mutant.slip,
                       kill ? kill->by : "**survived**",
                       kill ? (kill->cases > 0 ? fmt::format("{}", kill->cases) : "flights") : "");
  }
  return out;
}

}  // namespace plumbline::mutants
