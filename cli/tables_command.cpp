// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/shipped.h"
#include "properties/harness/machine.h"
#include "properties/tables/make_tables.h"
#include "reports/tables_report.h"
#include "scenarios/whole_file.h"

namespace plumbline::cli {
namespace {

struct TablesArguments {
  std::vector<std::string> names;
  std::string out;
  std::string terrain;
  std::vector<std::string> meshes;
  int jobs = 0;
  bool quiet = false;
};

int tables(const TablesArguments& arguments) {
  const std::vector<std::string> papers = tables::choose_tables(arguments.names);
  const std::filesystem::path out = arguments.out;
  if (!out.empty()) require_writable(out);  // known before the work, not after
  tables::TableSettings settings = tables::published_settings(
      arguments.terrain.empty() ? shipped("assets/jacksboro.vrt") : std::filesystem::path(arguments.terrain));

  for (const std::string& mesh : arguments.meshes)
    settings.p4.meshes.push_back(tables::load_mesh_stand_in(mesh));

  tables::MakeOptions options;
  options.jobs = arguments.jobs;
  options.cancelled = &interrupted();
  tables::TablesOutcome outcome;
  {
    ProgressLine line("tables", "steps", arguments.quiet);
    options.progress = [&line](std::size_t done, std::size_t total) { line.show(done, total); };
    outcome = tables::make_tables(papers, settings, options);
  }
  outcome.timings.machine = machine_name();
  outcome.timings.compiler = compiler_name();
  outcome.timings.build_type = build_type();
  if (!out.empty()) reports::write_tables(outcome.tables, outcome.timings, out);
  if (!arguments.quiet) {
    fmt::print("{}\n{}", reports::tables_md(outcome.tables), reports::tables_timing_md(outcome.timings));
  }
  return outcome.interrupted ? kInterrupted : kPass;
}

}  // namespace

void add_tables(CLI::App& program, int& status) {
  auto arguments = std::make_shared<TablesArguments>();
  std::string known;
  for (const tables::ReproducedPaper& paper : tables::reproduced_papers()) known += paper.id + ", ";
  CLI::App* command =
      program.add_subcommand("tables", "The papers' tables side by side with ours, on stand-in terrain");
  command->add_option("papers", arguments->names, fmt::format("which: {}default: all of them", known));
  command->add_option("--out", arguments->out,
                      "folder for tables.md, .json, .csv and the timings; default: none are written");
  command->add_option("--terrain", arguments->terrain,
                      "the real stand-in terrain, anything that GDAL opens; default: Jacksboro fault");
  command->add_option("--mesh", arguments->meshes,
                      "P4: a mesh besides the instrument (PLY, OBJ, OFF, STL, GLB); may be given again");
  command->add_option("--jobs", arguments->jobs, "threads; 0: one a core")->check(CLI::Range(0, 1024));
  command->add_flag("--quiet", arguments->quiet, "print nothing but errors");
  command->callback([arguments, &status] { status = tables(*arguments); });
}

}  // namespace plumbline::cli
