// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/suite.h"

namespace plumbline {

/// Whether `run_id` is `pattern`, in which every '*' stands for any text.
bool run_matches(std::string_view pattern, std::string_view run_id);

/// The ids that runs of the suite may have, as results name them; only of `methods`, unless there are none. A
/// method may yet turn out not to take a mesh or a terrain.
std::vector<std::string> possible_run_ids(const Suite& suite, const std::vector<std::string>& methods = {});

/// Reads an expectation file (TOML, docs/suites.md "Expected failures"): `expected`, an array of tables with
/// the keys `run`, `figure`, `value` (a limit as in `[gate]`) and `why`. Throws InputError naming file and
/// line for anything else: an unknown key or figure, a run that the suite does not have, an entry given
/// twice.
std::vector<Expectation> read_expected(const std::filesystem::path& path, const Suite& suite);
/// The same from memory; `name` stands for the file in complaints.
std::vector<Expectation> parse_expected(std::string_view text, const std::string& name, const Suite& suite);

}  // namespace plumbline
