// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "algorithms/registry.h"
#include "properties/verdict/verdict.h"
#include "scenarios/suite.h"

namespace plumbline {

/// Holds every run to the suite's limits. A gate that names a method replaces the general gate on the same
/// figure for that method; what is expected of a run replaces every gate on that figure for it, and each
/// expectation is judged for itself. A suite without gates is held to a clean conformity. A limit on a figure
/// that nothing was measured for does not hold, nor does an expectation of no run; its value is NaN.
std::vector<verdict::GateVerdict> judge_gates(const std::vector<GateSpec>& asked,
                                              const std::vector<verdict::RunVerdict>& runs,
                                              const std::vector<Expectation>& expected = {});

/// What passed without having been judged (ORACLES, "Never vacuous"), one line each: no run at all, a run
/// without frames or triangles, no pixel or area to measure, a method that draws one level of detail whatever
/// the threshold.
std::vector<std::string> find_vacuous(const std::vector<verdict::RunVerdict>& runs);

}  // namespace plumbline
