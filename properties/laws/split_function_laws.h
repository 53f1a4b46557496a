// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "algorithms/block_bintree/split_function.h"
#include "properties/laws/law.h"

/// The claims about M4's split function, on the function itself.
namespace plumbline::properties {

/// The split function that `block_bintree` with the input's variant and options builds on the input's
/// terrain.
block_bintree::SplitFunction split_function_of(const LawInput& input);

/// M4.C2 on one function, against a factor q: e(parent) ≥ q·e(child), compared as doubles, no tolerance: e
/// was made by this very product.
LawOutcome check_error_is_monotone(const block_bintree::SplitFunction& function, double q);

/// M4.C3 on one function and camera: whoever passes the split test has parents that pass it.
LawOutcome check_split_test_is_monotone(const block_bintree::SplitFunction& function, const Camera& camera,
                                        double threshold_px);

}  // namespace plumbline::properties
