// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "algorithms/registry.h"

#ifndef PLUMBLINE_SHARE
/// Where the suites and assets that plumbline ships were installed; plumbline::plumbline defines it. Without
/// it they are looked for beside the program alone.
#define PLUMBLINE_SHARE ""
#endif

namespace plumbline {

/// The program `plumbline` with methods of your own: every command, law, oracle and report takes them as it
/// takes the built-in ones, behind which they are listed, in the order given (register_methods says what it
/// refuses). To be called once, from main, with its arguments.
///
/// Returns the exit status: 0 all gates hold, 1 a finding, 2 bad usage or unreadable input, 3 a fault of
/// plumbline's own, 130 interrupted. Throws nothing; complaints are one line on standard error. Takes over
/// Ctrl-C: the first ends long work in order, the second at once.
///
/// `share` holds what is shipped (suites/, assets/); ../share/plumbline beside the program, if there is one,
/// is preferred.
int run_program(int argc, char** argv, std::vector<MethodDescription> own_methods = {},
                const std::filesystem::path& share = PLUMBLINE_SHARE);

}  // namespace plumbline
