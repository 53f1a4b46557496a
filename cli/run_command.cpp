// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/shipped.h"
#include "properties/harness/run_suite.h"
#include "properties/selftest/selftest.h"
#include "reports/escape.h"
#include "reports/report.h"
#include "scenarios/error.h"
#include "scenarios/expected_file.h"
#include "scenarios/whole_file.h"

namespace plumbline::cli {
namespace {

struct RunArguments {
  std::string suite;
  std::string out = "out";
  int jobs = 0;
  std::string methods;
  std::string isa;
  std::string expected, write_expected;
  bool dump_meshes = false;
  bool no_pictures = false;
  bool quiet = false;
};

/// "a, b" as {"a", "b"}.
std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> items;
  std::string item;
  for (const char c : text + ",") {
    if (c == ',') {
      if (!item.empty()) items.push_back(item);
      item.clear();
    } else if (c != ' ') {
      item += c;
    }
  }
  return items;
}

/// The line that repeats the run; threads and folders change no figure, so they are left out.
std::string repeat_line(const RunArguments& arguments) {
  std::string line = "plumbline run " + reports::shell_word(arguments.suite);
  if (!arguments.methods.empty()) {
    line +=
        " --methods " + reports::shell_word(fmt::format("{}", fmt::join(split_list(arguments.methods), ",")));
  }
  if (!arguments.expected.empty()) line += " --expected " + reports::shell_word(arguments.expected);
  return line;
}

/// A file, or the bare name of a shipped one ("smoke.toml").
std::filesystem::path suite_file(const std::filesystem::path& named) {
  std::error_code error;
  if (named.has_parent_path() || std::filesystem::exists(named, error)) return named;
  const std::filesystem::path one_shipped = shipped("suites" / named);
  return std::filesystem::exists(one_shipped, error) ? one_shipped : named;
}

int run(const RunArguments& arguments) {
  Suite suite = load_suite(suite_file(arguments.suite));
  if (!arguments.expected.empty()) suite.expected = read_expected(arguments.expected, suite);
  if (!arguments.write_expected.empty() && !arguments.methods.empty()) {
    throw InputError(
        "--write-expected writes what is expected of the whole suite, --methods flies a part of it; leave "
        "one "
        "out");
  }
  const std::filesystem::path out = arguments.out;
  require_writable(out);  // known before the flights, not after
  if (!arguments.write_expected.empty())
    require_writable(std::filesystem::absolute(arguments.write_expected).parent_path());

  RunOptions options;
  options.jobs = arguments.jobs;
  options.methods = split_list(arguments.methods);
  options.isa = arguments.isa;
  options.pictures = !arguments.no_pictures;
  options.cancelled = &interrupted();
  if (arguments.dump_meshes) options.mesh_folder = out / "meshes";
  SuiteOutcome outcome;
  {
    ProgressLine line(suite.name, "frames", arguments.quiet);
    options.progress = [&line](std::size_t done, std::size_t total) { line.show(done, total); };
    outcome = run_suite(suite, options);
  }
  selftest::Request brief = selftest::brief_request();
  brief.jobs = arguments.jobs;
  outcome.verdict.selftest = selftest::run_selftest(brief);
  reports::write_reports(outcome.verdict, outcome.timing, outcome.pictures, out, repeat_line(arguments));
  const bool pass = outcome.verdict.pass();
  if (!arguments.write_expected.empty() && !outcome.verdict.interrupted)
    write_whole_file(arguments.write_expected, reports::expected_toml(outcome.verdict));
  if (!arguments.quiet) {
    fmt::print("{}", reports::summary_md(outcome.verdict, outcome.timing));
    fmt::print("report: {}\n", (out / "report.html").string());
  }
  if (outcome.verdict.interrupted) return kInterrupted;
  return pass ? kPass : kFinding;
}

}  // namespace

void add_run(CLI::App& program, int& status) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = program.add_subcommand(
      "run", "Fly a suite's methods over its terrains and trajectories, judge every frame, write a report");
  command
      ->add_option("suite", arguments->suite,
                   "suite file (TOML), or the name of a shipped one: default.toml, smoke.toml, …")
      ->required();
  command->add_option("--out", arguments->out, "folder for the report")->capture_default_str();
  command->add_option("--jobs", arguments->jobs, "threads; 0: one a core")->check(CLI::Range(0, 1024));
  command->add_option("--methods", arguments->methods,
                      "only these methods of the suite, separated by commas");
  command->add_option("--expected", arguments->expected,
                      "file of what is known to fail: red when it changes, in either direction; replaces the "
                      "suite's own");
  command->add_option("--write-expected", arguments->write_expected,
                      "write such a file of what fails now, to review as a diff");
  command->add_option(
      "--isa", arguments->isa,
      "limit Embree's instruction set: sse2, avx, avx2, avx512 (the figures do not depend on it)");
  command->add_flag("--dump-meshes", arguments->dump_meshes, "write every frame's mesh as PLY");
  command->add_flag("--no-pictures", arguments->no_pictures, "leave out the images");
  command->add_flag("--quiet", arguments->quiet, "print nothing but errors");
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace plumbline::cli
