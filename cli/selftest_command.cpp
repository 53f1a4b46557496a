// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/progress.h"
#include "properties/selftest/selftest.h"
#include "reports/report.h"
#include "scenarios/whole_file.h"

namespace plumbline::cli {
namespace {

/// Of --thorough, unless told otherwise.
constexpr std::size_t kThoroughFaults = 100'000, kThoroughClean = 1'000'000;
constexpr std::size_t kMostMeshes = 1'000'000'000;

struct SelftestArguments {
  std::size_t faults = 0, clean = 0;
  std::uint64_t seed = 1;
  int jobs = 0;
  std::string json;
  bool thorough = false;
  bool quiet = false;
};

int put_to_the_test(const SelftestArguments& arguments, bool faults_given, bool clean_given) {
  selftest::Request request;
  if (arguments.thorough) {
    request.faults = kThoroughFaults;
    request.clean = kThoroughClean;
  }
  if (faults_given) request.faults = arguments.faults;
  if (clean_given) request.clean = arguments.clean;
  request.seed = arguments.seed;
  request.jobs = arguments.jobs;
  request.cancelled = &interrupted();
  verdict::SelftestScore score;
  {
    ProgressLine line("selftest", "meshes", arguments.quiet);
    request.progress = [&line](std::size_t done, std::size_t total) { line.show(done, total); };
    score = selftest::run_selftest(request);
  }
  if (!arguments.json.empty()) write_whole_file(arguments.json, reports::selftest_json(score));
  if (!arguments.quiet) fmt::print("{}", reports::selftest_md(score));
  if (score.interrupted) return kInterrupted;
  return score.perfect() ? kPass : kFinding;
}

}  // namespace

void add_selftest(CLI::App& program, int& status) {
  auto arguments = std::make_shared<SelftestArguments>();
  CLI::App* command = program.add_subcommand(
      "selftest",
      "Plant faults in sound meshes and scenes: does every oracle find them, there, and no more?");
  const CLI::App* const self = command;
  command->add_option("--faults", arguments->faults, "at least so many; default: 10000")
      ->check(CLI::Range(std::size_t{1}, kMostMeshes));
  command->add_option("--clean", arguments->clean, "random sound meshes without a fault; default: 2000")
      ->check(CLI::Range(std::size_t{1}, kMostMeshes));
  command->add_flag("--thorough", arguments->thorough, "100000 faults and a million sound meshes");
  command->add_option("--seed", arguments->seed, "of everything that is drawn")->capture_default_str();
  command->add_option("--jobs", arguments->jobs, "threads; 0: one a core")->check(CLI::Range(0, 1024));
  command->add_option("--json", arguments->json, "file for the score");
  command->add_flag("--quiet", arguments->quiet, "print nothing but errors");
  command->callback([arguments, self, &status] {
    status = put_to_the_test(*arguments, self->count("--faults") > 0, self->count("--clean") > 0);
  });
}

}  // namespace plumbline::cli
