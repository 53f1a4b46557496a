// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/registry.h"

namespace plumbline {
MethodDescription describe_restricted_quadtree() { return {}; }
}  // namespace plumbline
