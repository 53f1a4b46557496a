// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "algorithms/decimation/decimation.h"

namespace plumbline::meshopt {

/// meshoptimizer's simplify, run anew for each count. Throws InputError (without the method's name) if an
/// index is out of range or a position is not finite.
std::shared_ptr<const decimation::Simplifier> make_simplifier(const Mesh& mesh, bool keep_border);

}  // namespace plumbline::meshopt
