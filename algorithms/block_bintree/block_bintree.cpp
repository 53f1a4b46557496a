// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/registry.h"

namespace plumbline {
MethodDescription describe_block_bintree() { return {}; }
}  // namespace plumbline
