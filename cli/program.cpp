// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/shipped.h"
#include "scenarios/error.h"
#include "scenarios/nearest.h"

namespace plumbline::cli {
namespace {

std::atomic<bool> g_interrupted{false};

extern "C" void on_interrupt(int) {
  // A second Ctrl-C ends the program at once.
  g_interrupted.store(true);
  std::signal(SIGINT, SIG_DFL);
}

/// Complaints are one line, whatever a library or a path put into them.
int complain(int status, std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  while (!message.empty() && message.back() == ' ') message.pop_back();
  fmt::print(stderr, "plumbline: {}\n", message);
  return status;
}

int obey(int argc, char** argv) {
  CLI::App program{
      "plumbline: checks view-dependent level of detail: cracks, T-junctions and fold-overs exactly, "
      "errors in metres and pixels"};
  program.name("plumbline");
  program.set_version_flag("--version", "plumbline " PLUMBLINE_VERSION);
  program.require_subcommand(1);
  int status = kPass;
  add_run(program, status);
  add_check(program, status);
  add_compare(program, status);
  add_fuzz(program, status);
  add_replay(program, status);
  add_list(program, status);
  add_tables(program, status);
  add_selftest(program, status);

  std::vector<std::string> commands;
  for (const CLI::App* command : program.get_subcommands({})) commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    throw InputError(unknown_name("command", argv[1], commands));
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& wish) {  // --help, --version
    return program.exit(wish);
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{} (plumbline --help tells the usage)", error.what()));
  }
  return status;
}

}  // namespace

const std::atomic<bool>& interrupted() { return g_interrupted; }

void end_at_interrupt() { std::signal(SIGINT, SIG_DFL); }

}  // namespace plumbline::cli

int plumbline::run_program(int argc, char** argv, std::vector<MethodDescription> own_methods,
                           const std::filesystem::path& share) {
  std::signal(SIGINT, cli::on_interrupt);
  try {
    cli::set_share(share);
    register_methods(std::move(own_methods));
    return cli::obey(argc, argv);
  } catch (const InputError& error) {
    return cli::complain(cli::kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return cli::complain(cli::kBadInput, "not enough memory for this input; make it smaller");
  } catch (const std::exception& error) {
    return cli::complain(cli::kOwnFault, fmt::format("internal fault: {}", error.what()));
  }
}
