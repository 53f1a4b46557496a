// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/fuzz/fuzz.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "properties/atlas/case_file.h"
#include "properties/laws/generators.h"
#include "scenarios/error.h"

namespace plumbline::properties {
namespace {

using Clock = std::chrono::steady_clock;  // decides when to stop, never what is found

/// Violations of one law that are shrunk; the least complex result is kept.
constexpr std::uint64_t kShrunkEach = 8;
/// Trials one shrink may take: enough to go from 33 × 33 to a minimum, and some seconds at the most.
constexpr std::uint64_t kShrinkTrials = 50000;

std::vector<std::string> methods_of(const FuzzOptions& options) {
  if (!options.method.empty()) {
    find_method(options.method);
    return {options.method};
  }
  std::vector<std::string> methods;
  for (const MethodDescription& method : registered_methods()) {
    for (const VariantDescription& variant : method.variants) {
      methods.push_back(variant.name.empty() ? method.id : method.id + ":" + variant.name);
    }
  }
  return methods;
}

/// "block_bintree-tri_cull.conforming.seed1.toml": nothing of it comes from a clock.
std::string case_name(const LawTally& tally, std::uint64_t seed) {
  std::string method = tally.method;
  for (char& c : method) {
    if (c == ':') c = '-';
  }
  return fmt::format("{}.{}.seed{}.toml", method, tally.law, seed);
}

/// One method's campaign.
class Campaign {
 public:
  Campaign(const FuzzOptions& options, std::string method, Clock::time_point start, double seconds)
      : options_(options), method_(std::move(method)), start_(start), seconds_(seconds) {
    const MethodChoice choice = find_method(method_);
    for (const Law& law : all_laws()) {
      if (!options.law.empty() && law.id != options.law) continue;
      if (!law.applies(choice)) continue;
      laws_.push_back(&law);
      tallies_.emplace_back();
      tallies_.back().method = method_;
      tallies_.back().law = law.id;
      tallies_.back().promised = law.promised(choice);
    }
  }

  void share_time_with(std::ptrdiff_t campaigns) {
    seconds_ /= static_cast<double>(std::max<std::ptrdiff_t>(campaigns, 1));
  }
  [[nodiscard]] bool has_laws() const { return !laws_.empty(); }
  std::vector<LawTally>& tallies() { return tallies_; }
  [[nodiscard]] std::uint64_t cases() const { return cases_; }
  [[nodiscard]] bool interrupted() const { return interrupted_; }

  void run() {
    const Clock::time_point began = Clock::now();
    const auto elapsed = [](Clock::time_point since) {
      return std::chrono::duration<double>(Clock::now() - since).count();
    };
    double last_progress_s = 0;
    for (cases_ = 0; options_.cases == 0 || cases_ < options_.cases; ++cases_) {
      if (options_.cancelled != nullptr && options_.cancelled->load()) {
        interrupted_ = true;
        break;
      }
      if (seconds_ > 0 && elapsed(began) >= seconds_) break;
      const DrawnCase drawn = draw_case(method_, options_.seed, cases_);
      for (std::size_t k = 0; accepted(drawn.input) && k < laws_.size(); ++k)
        try_law(*laws_[k], drawn.input, tallies_[k]);
      constexpr double kProgressEachS = 0.2;
      if (options_.progress && elapsed(start_) - last_progress_s >= kProgressEachS) {
        last_progress_s = elapsed(start_);
        options_.progress({method_, cases_ + 1, violations_, last_progress_s});
      }
    }
    if (!options_.out.empty()) write_cases();
  }

 private:
  [[nodiscard]] bool accepted(const LawInput& input) const {
    try {
      return !options_.accept || options_.accept(input);
    } catch (const InputError&) {
      return false;  // the filter looked at what the method does not take
    }
  }

  void try_law(const Law& law, const LawInput& input, LawTally& tally) {
    LawOutcome outcome;
    try {
      outcome = judge(law, input);
    } catch (const InputError&) {
      ++tally.refused;
      return;
    }
    for (const LawOutcome::Part& part : outcome.parts) {
      LawTally::PartTally& count = tally.parts[part.name];
      ++count.judged;
      if (!part.held) ++count.violated;
    }
    switch (outcome.kind) {
      case LawOutcome::Kind::held:
        ++tally.held;
        return;
      case LawOutcome::Kind::vacuous:
        ++tally.vacuous;
        return;
      case LawOutcome::Kind::violated:
        break;
    }
    ++tally.violated;
    ++violations_;
    if (!tally.first_violation) tally.first_violation = cases_;
    if (tally.violated > kShrunkEach) return;
    Shrunk shrunk = shrink(law, input, outcome, kShrinkTrials, options_.accept);
    if (!tally.smallest || complexity(shrunk.input) < complexity(*tally.smallest)) {
      tally.smallest = std::move(shrunk.input);
      tally.smallest_outcome = std::move(shrunk.outcome);
    }
  }

  void write_cases() {
    for (LawTally& tally : tallies_) {
      if (!tally.smallest) continue;
      Case found;
      found.note = fmt::format("found by fuzz: seed {}, first violated at case {}; shrunk", options_.seed,
                               *tally.first_violation);
      found.law = tally.law;
      found.input = *tally.smallest;
      found.expected = tally.smallest_outcome;
      tally.case_file = options_.out / case_name(tally, options_.seed);
      write_case(tally.case_file, found);
    }
  }

  const FuzzOptions& options_;
  std::string method_;
  Clock::time_point start_;
  double seconds_;
  std::vector<const Law*> laws_;
  std::vector<LawTally> tallies_;
  std::uint64_t cases_ = 0, violations_ = 0;
  bool interrupted_ = false;
};

}  // namespace

bool FuzzReport::pass() const {
  for (const LawTally& tally : tallies) {
    if (tally.promised && tally.violated > 0) return false;
  }
  return nothing_judged.empty() && !interrupted;
}

FuzzReport fuzz(const FuzzOptions& options) {
  if (options.cases == 0 && !(options.seconds > 0)) {
    throw InputError("fuzz: give a number of seconds or of cases, greater than 0");
  }
  if (!std::isfinite(options.seconds) || options.seconds < 0) {
    throw InputError(fmt::format("fuzz: {} seconds is not a finite time", options.seconds));
  }
  if (!options.law.empty()) find_law(options.law);

  const std::vector<std::string> methods = methods_of(options);
  const Clock::time_point start = Clock::now();
  FuzzReport report;
  report.seed = options.seed;
  std::vector<Campaign> campaigns;
  for (const std::string& method : methods) campaigns.emplace_back(options, method, start, options.seconds);
  // Each that has something to try gets an equal share of the time.
  const auto trying =
      std::count_if(campaigns.begin(), campaigns.end(), [](const Campaign& c) { return c.has_laws(); });
  for (Campaign& campaign : campaigns) campaign.share_time_with(trying);
  bool any = false;
  for (const Campaign& campaign : campaigns) any = any || campaign.has_laws();
  if (!any) {
    throw InputError(fmt::format("fuzz: law '{}' does not speak of method '{}'; see plumbline list laws",
                                 options.law, options.method));
  }
  for (Campaign& campaign : campaigns) {
    if (!campaign.has_laws()) continue;
    campaign.run();
    report.interrupted = report.interrupted || campaign.interrupted();
    report.cases[campaign.tallies().front().method] = campaign.cases();
    for (LawTally& tally : campaign.tallies()) {
      if (tally.judged() == 0) {
        oracle::Finding finding;
        finding.code = oracle::FindingCode::nothing_judged;
        finding.kind = tally.method + ": " + tally.law;
        report.nothing_judged.push_back(std::move(finding));
      }
      report.tallies.push_back(std::move(tally));
    }
    if (report.interrupted) break;
  }
  return report;
}

}  // namespace plumbline::properties
