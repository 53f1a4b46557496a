// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "scenarios/toml_reader.h"

namespace plumbline {

/// Reads `[gate]`. A limit is a number (`crack = 0` means "== 0") or a comparison in a string: one of <= < ==
/// >= >, a finite number, and optionally `tau` ("<= 1.5 tau": so many times the run's threshold). A table
/// named after one of `methods` (`[gate.block_bintree]`, `[gate."block_bintree:tri_cull"]`) holds that
/// method's own limits. Figures are those of gate_figures.h, dotted or quoted. Throws InputError for anything
/// else, and for a figure limited twice.
std::vector<GateSpec> read_gates(const TomlTable& gate, const std::vector<std::string>& methods);

}  // namespace plumbline
