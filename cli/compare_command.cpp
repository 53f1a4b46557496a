// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "cli/commands.h"
#include "properties/compare/compare.h"
#include "reports/compare_report.h"
#include "scenarios/error.h"
#include "scenarios/whole_file.h"

namespace plumbline::cli {
namespace {

struct CompareArguments {
  std::string before, after;
  double tolerance = 0;
  bool any_change = false;
  bool findings = false;
  bool markdown = false;
  bool quiet = false;
  std::string json;
};

int compare(const CompareArguments& arguments) {
  if (!(arguments.tolerance >= 0 && arguments.tolerance < 1))
    throw InputError(fmt::format("--tolerance is {}; give a share from 0 to below 1", arguments.tolerance));
  verdict::Comparison comparison =
      compare::compare_results(compare::read_result_file(arguments.before),
                               compare::read_result_file(arguments.after), arguments.tolerance);
  if (arguments.findings) comparison = verdict::findings_only(std::move(comparison));
  if (!arguments.json.empty()) write_whole_file(arguments.json, reports::compare_json(comparison));
  if (!arguments.quiet)
    fmt::print("{}",
               arguments.markdown ? reports::compare_md(comparison) : reports::compare_text(comparison));
  const bool red = comparison.count(verdict::Change::worse) > 0 ||
                   (arguments.any_change && !comparison.differences.empty());
  return red ? kFinding : kPass;
}

}  // namespace

void add_compare(CLI::App& program, int& status) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = program.add_subcommand(
      "compare", "What became better or worse between two results; exit status 1 if anything is worse");
  command->add_option("old", arguments->before, "results.json, or what check --json wrote")->required();
  command->add_option("new", arguments->after, "another of the same kind")->required();
  command->add_option("--tolerance", arguments->tolerance,
                      "relative, for figures that count nothing; default: to the last bit");
  command->add_flag("--any-change", arguments->any_change, "exit status 1 for whatever changed, better too");
  command->add_flag("--findings", arguments->findings,
                    "findings and their counts only: no new violations, though other figures move");
  command->add_flag("--markdown", arguments->markdown, "a comment for a pull request");
  command->add_option("--json", arguments->json, "file for all differences");
  command->add_flag("--quiet", arguments->quiet, "print nothing but errors");
  command->callback([arguments, &status] { status = compare(*arguments); });
}

}  // namespace plumbline::cli
