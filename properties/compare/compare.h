// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "properties/compare/result_file.h"
#include "properties/verdict/comparison.h"

namespace plumbline::compare {

/// What became better or worse from `before` to `after`: verdicts, runs (meshes, seams) by id, gates by run
/// and name, findings by code, kind, mesh and place, every figure of the summaries, and what was flown.
///
/// `tolerance` is relative to the larger size and applies to figures that count nothing; at 0 results are
/// held to the last bit, as they are written by machines that agree to the last bit, and a run whose frames
/// differ under an equal summary is a change. What is gone is worse (it is judged no longer), what is new a
/// change, but a new gate that fails, a new finding and something new that judged nothing are worse. Where a
/// file lists its worst findings only, findings that appear or vanish are changes, and the counts decide.
/// Throws InputError if the schemas differ. Requires: 0 ≤ tolerance < 1.
verdict::Comparison compare_results(ResultFile before, ResultFile after, double tolerance = 0);

}  // namespace plumbline::compare
