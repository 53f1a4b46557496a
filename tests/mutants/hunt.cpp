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

const std::set<std::pair<std::string, std::string>>& all_known_to_fail() {
  static const std::set<std::pair<std::string, std::string>> known{
      {"haar_quadtree", "screen_error_within_tau"},
      {"haar_quadtree:morph", "continuous_in_camera"},
      {"ring_tin", "conforming"},
      {"ring_tin:fixpoint", "conforming"},
      {"isolated_quadtree", "conforming"},
      {"isolated_quadtree", "screen_error_within_tau"},
      {"isolated_quadtree:no_cos", "conforming"},
      {"isolated_quadtree:no_cos", "screen_error_within_tau"},
      {"block_bintree", "conforming"},
      {"block_bintree", "M4_C3_split_test_is_monotone"},
      {"block_bintree:tri_cull", "conforming"},
      {"block_bintree:tri_cull", "M4_C3_split_test_is_monotone"},
      {"block_bintree:by_distance", "M4_C3_split_test_is_monotone"},
      {"vertex_tree:no_contour", "conforming"},
  };
  return known;
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
    if (law.applies(choice))
      laws.push_back(
          {&law, law.promised(choice) && !all_known_to_fail().contains({std::string(method), law.id})});
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

namespace {

/// A mutant under trial.
class Trial {
 public:
  explicit Trial(const Mutant& mutant)
      : mutant_(mutant), method_(mutant.method), laws_(laws_of(method_)), judged_(laws_.size(), 0) {}

  /// Goes on to this many cases.
  std::optional<Kill> by_laws(std::uint64_t cases) {
    for (; next_ < cases; ++next_) {
      const LawInput input = properties::draw_case(method_, kSeed, next_).input;
      for (std::size_t l = 0; l < laws_.size(); ++l) {
        if (!laws_[l].promised && judged_[l] > 0) continue;
        std::optional<LawOutcome> outcome;
        {
          const Switched on(mutant_.name);
          outcome = try_law(*laws_[l].law, input);
        }
        if (!outcome || outcome->kind == Kind::vacuous) continue;
        ++judged_[l];
        if (outcome->kind == Kind::held || !laws_[l].promised) continue;
        const std::optional<LawOutcome> without = try_law(*laws_[l].law, input);
        if (without && without->kind == Kind::violated) continue;
        return Kill{"law " + laws_[l].law->id, next_ + 1, outcome->what};
      }
    }
    return std::nullopt;
  }

  /// judge_unmutated finds something to judge for each law.
  [[nodiscard]] std::optional<Kill> by_silence() const {
    for (std::size_t l = 0; l < laws_.size(); ++l) {
      if (judged_[l] > 0) continue;
      return Kill{"nothing_judged (110)", next_,
                  fmt::format("law {} had nothing to judge", laws_[l].law->id)};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Kill> by_oracles() const {
    const auto without = fly(method_);
    const Switched on(mutant_.name);
    for (const auto& [gate, what] : fly(method_)) {
      const std::string& name = gate;  // clang 14 lets no lambda see a structured binding
      if (std::none_of(without.begin(), without.end(),
                       [&](const auto& other) { return other.first == name; })) {
        return Kill{gate, 0, what};
      }
    }
    return std::nullopt;
  }

 private:
  const Mutant& mutant_;
  std::string method_;
  std::vector<Asked> laws_;
  std::vector<std::uint64_t> judged_;
  std::uint64_t next_ = 0;
};

}  // namespace

std::optional<Kill> hunt(const Mutant& mutant) {
  Trial trial(mutant);
  if (auto kill = trial.by_laws(kCases)) return kill;
  if (auto kill = trial.by_silence()) return kill;
  if (auto kill = trial.by_oracles()) return kill;
  return trial.by_laws(kMostCases);
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
