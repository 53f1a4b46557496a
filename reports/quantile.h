// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace plumbline::reports {

/// The least value such that at least `share` of all are not above it (nearest rank); 0 if there is none.
double quantile(std::vector<double> values, double share);

}  // namespace plumbline::reports
