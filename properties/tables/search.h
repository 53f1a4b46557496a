// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace plumbline::tables {

/// What a search looks for: x > 0 with measure(x) = goal.
struct Search {
  double goal = 0;
  double start = 1;      ///< where the bracket begins
  bool falling = true;   ///< whether the measure falls as x grows
  double tolerance = 0;  ///< done when |measure − goal| ≤ tolerance · goal
};

struct Found {
  double x = 0;
  double value = 0;        ///< measure(x): the nearest to the goal of all that were tried
  bool bracketed = false;  ///< values on both sides of the goal were seen
};

/// Bisection in the exponent, the same steps on every machine: from `start` by factors of two until the goal
/// lies between two neighbours, then halved at their geometric mean until the tolerance is met or the bracket
/// is as narrow as doubles can tell. Of equally near values the first tried is kept. A measure with jumps
/// ends at the jump; one that is not monotone ends at some crossing. One that never comes to the goal gives
/// the nearest it had, `bracketed` false.
Found search(const Search& asked, const std::function<double(double)>& measure);

}  // namespace plumbline::tables
