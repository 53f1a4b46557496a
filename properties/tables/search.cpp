// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/tables/search.h"

#include <cmath>

namespace plumbline::tables {
namespace {

constexpr int kMostDoublings = 40;  // each way: 10¹² below to 10¹² above the start
constexpr int kMostHalvings = 48;
constexpr double kNarrow = 0x1p-40;  // a relative width below which no count is expected to change

}  // namespace

Found search(const Search& asked, const std::function<double(double)>& measure) {
  Found best;
  bool any = false;
  const auto done = [&] {
    return any && std::fabs(best.value - asked.goal) <= asked.tolerance * std::fabs(asked.goal);
  };
  /// Whether x lies on the side of the goal where a greater x is needed.
  const auto too_small = [&](double x) {
    const double value = measure(x);
    if (!any || std::fabs(value - asked.goal) < std::fabs(best.value - asked.goal)) {
      best.x = x;
      best.value = value;
      any = true;
    }
    return asked.falling ? value > asked.goal : value < asked.goal;
  };

  const bool upwards = too_small(asked.start);
  const double step = upwards ? 2 : 0.5;
  double inner = asked.start, outer = asked.start;
  for (int k = 0; k < kMostDoublings && !best.bracketed && !done(); ++k) {
    inner = outer;
    outer *= step;
    best.bracketed = too_small(outer) != upwards;
  }
  double low = upwards ? inner : outer;
  double high = upwards ? outer : inner;
  for (int k = 0; k < kMostHalvings && best.bracketed && !done() && high - low > kNarrow * high; ++k) {
    const double middle = std::sqrt(low * high);
    (too_small(middle) ? low : high) = middle;
  }
  return best;
}

}  // namespace plumbline::tables
