// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/suite.h"
#include "scenarios/toml_reader.h"

namespace plumbline {

/// The key of `[gate]` that is no limit: the name of an expectation file (expected_file.h).
inline constexpr std::string_view kExpectedKey = "expected";

/// Reads `[gate]`, but for kExpectedKey. A limit is a number (`crack = 0` means "== 0") or a comparison in a
/// string: one of <= < ==
/// >= >, a finite number, and optionally `tau` ("<= 1.5 tau": so many times the run's threshold). A table
/// named after one of `methods` (`[gate.block_bintree]`, `[gate."block_bintree:tri_cull"]`) holds that
/// method's own limits. Figures are those of gate_figures.h, dotted or quoted. Throws InputError for anything
/// else, and for a figure limited twice.
std::vector<GateSpec> read_gates(const TomlTable& gate, const std::set<std::string>& methods);

/// One such limit on `figure`, of every method. Throws InputError if `value` is none.
GateSpec read_limit(const TomlValue& value, const std::string& figure);

}  // namespace plumbline
