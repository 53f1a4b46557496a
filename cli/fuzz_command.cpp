// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <memory>
#include <string>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/progress.h"
#include "properties/atlas/case_file.h"
#include "properties/fuzz/fuzz.h"
#include "scenarios/error.h"
#include "scenarios/whole_file.h"

namespace plumbline::cli {
namespace {

struct FuzzArguments {
  properties::FuzzOptions options;
  std::string out;
  bool quiet = false;
};

void print_report(const properties::FuzzReport& report) {
  fmt::print("{:<28} {:<34} {:>9} {:>9} {:>9}  {}\n", "method", "law", "held", "vacuous", "violated",
             "verdict");
  for (const properties::LawTally& tally : report.tallies) {
    std::string verdict = tally.promised ? "promised: held" : "not promised: held";
    if (tally.judged() == 0) verdict = "nothing judged";
    if (tally.violated > 0) verdict = tally.promised ? "PROMISED, VIOLATED" : "not promised: violated";
    fmt::print("{:<28} {:<34} {:>9} {:>9} {:>9}  {}\n", tally.method, tally.law, tally.held, tally.vacuous,
               tally.violated, verdict);
  }
  for (const properties::LawTally& tally : report.tallies) {
    if (!tally.smallest) continue;
    const properties::LawInput& input = *tally.smallest;
    fmt::print("\n{}, {}: smallest counterexample {} × {} samples, {} poses\n  {}\n", tally.method, tally.law,
               input.terrain.columns, input.terrain.rows, input.poses.size(), tally.smallest_outcome.what);
    if (!tally.case_file.empty()) {
      fmt::print("  {}\n  plumbline replay {}\n", tally.case_file.string(), tally.case_file.string());
    }
  }
  std::uint64_t cases = 0;
  for (const auto& [method, tried] : report.cases) cases += tried;
  fmt::print("\n{} cases, seed {}{}\n", cases, report.seed, report.interrupted ? " (interrupted)" : "");
}

int run_fuzz(FuzzArguments& arguments) {
  properties::FuzzOptions& options = arguments.options;
  if (options.seconds == 0 && options.cases == 0) options.seconds = 60;
  options.out = arguments.out;
  options.cancelled = &interrupted();
  if (!options.out.empty()) require_writable(options.out);  // a hunt must not lose what it finds
  properties::FuzzReport report;
  {
    ProgressTicker ticker("fuzz", arguments.quiet);
    options.progress = [&ticker](const properties::FuzzProgress& p) {
      ticker.say(fmt::format("{}: {} cases, {:.0f} a second, {} violations", p.method, p.cases,
                             p.seconds > 0 ? static_cast<double>(p.cases) / p.seconds : 0.0, p.violations));
    };
    report = properties::fuzz(options);
  }
  if (!arguments.quiet) print_report(report);
  if (report.interrupted) return kInterrupted;
  return report.pass() ? kPass : kFinding;
}

int run_replay(const std::string& path) {
  const properties::Case stored = properties::load_case(path);
  const properties::ReplayResult result = properties::replay(stored);
  fmt::print("{}, law {}: {}\n", stored.input.method, stored.law,
             properties::outcome_name(result.outcome.kind));
  if (!result.outcome.what.empty()) fmt::print("  {}\n", result.outcome.what);
  if (result.confirmed) {
    fmt::print("  as the case says, bit for bit\n");
  } else {
    fmt::print("  NOT as the case says: {}\n", result.difference);
  }
  // A law that is seen to be violated is a finding, whether or not the case expected it.
  const bool violated = result.outcome.kind == properties::LawOutcome::Kind::violated;
  return violated || !result.confirmed ? kFinding : kPass;
}

}  // namespace

void add_fuzz(CLI::App& program, int& status) {
  auto arguments = std::make_shared<FuzzArguments>();
  properties::FuzzOptions& options = arguments->options;
  CLI::App* command = program.add_subcommand(
      "fuzz", "Hunt for inputs that break a method's promises, shrink them, write each as a case file");
  command->add_option("--method", options.method, "full id; default: all");
  command->add_option("--law", options.law, "default: all that apply");
  auto* seconds = command->add_option("--seconds", options.seconds, "how long; default 60")
                      ->check(CLI::Range(0.001, 1e7));
  command->add_option("--cases", options.cases, "how many cases a method, instead of a time")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
      ->excludes(seconds);
  command->add_option("--seed", options.seed, "case k of a seed is the same everywhere")
      ->capture_default_str();
  command->add_option("--out", arguments->out, "folder for the case files; default: none are written");
  command->add_flag("--quiet", arguments->quiet, "print nothing but errors");
  command->callback([arguments, &status] { status = run_fuzz(*arguments); });
}

void add_replay(CLI::App& program, int& status) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("replay", "Run one case file again; same verdict, bit for bit");
  command->add_option("case", *path, "case file (TOML)")->required();
  command->callback([path, &status] { status = run_replay(*path); });
}

}  // namespace plumbline::cli
