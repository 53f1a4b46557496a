// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include <CLI/CLI.hpp>

/// The command line: parsing and wiring, no logic. Each command adds its options to the program and a
/// callback that does the work and sets the exit status.
namespace plumbline::cli {

/// CONTRACT "Exit status".
inline constexpr int kPass = 0;
inline constexpr int kFinding = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kOwnFault = 3;
inline constexpr int kInterrupted = 130;

/// Set by Ctrl-C; long work polls it.
const std::atomic<bool>& interrupted();
/// For work that keeps nothing unfinished: Ctrl-C ends the program at once, as the shell's 130.
void end_at_interrupt();

void add_run(CLI::App& program, int& status);
void add_check(CLI::App& program, int& status);
void add_fuzz(CLI::App& program, int& status);
void add_replay(CLI::App& program, int& status);
void add_list(CLI::App& program, int& status);
void add_tables(CLI::App& program, int& status);
void add_selftest(CLI::App& program, int& status);
void add_compare(CLI::App& program, int& status);

}  // namespace plumbline::cli
