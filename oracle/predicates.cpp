// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/predicates.h"

#include <algorithm>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

namespace plumbline::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Rational = CGAL::Exact_rational;

double finite(double figure) {
  constexpr double most = std::numeric_limits<double>::max();
  return std::clamp(figure, -most, most);
}

double exact_gap_m(Vec3 a, Vec3 b, Vec3 p, bool along_x) {
  ++precision_tally().exact_figures;
  const Rational from = along_x ? a.x : a.y;
  const Rational to = along_x ? b.x : b.y;
  const Rational at = along_x ? p.x : p.y;
  const Rational az = a.z;
  const Rational gap = Rational(p.z) - (az + (Rational(b.z) - az) * (at - from) / (to - from));
  return CGAL::to_double(gap);
}

Rational twice_area(std::span<const Vec2> loop) {
  Rational twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 p = loop[i], q = loop[i + 1 < loop.size() ? i + 1 : 0];
    twice += Rational(p.x) * Rational(q.y) - Rational(p.y) * Rational(q.x);
  }
  return twice;
}

}  // namespace

PrecisionTally& precision_tally() {
  thread_local PrecisionTally tally;
  return tally;
}

Sign careful_orientation(Vec2 a, Vec2 b, Vec2 c) {
  {
    using Interval = CGAL::Interval_nt<false>;
    const Interval::Protector round_upwards;
    const Interval cx = c.x, cy = c.y;
    const Interval determinant =
        (Interval(a.x) - cx) * (Interval(b.y) - cy) - (Interval(a.y) - cy) * (Interval(b.x) - cx);
    // An overflow makes a bound infinite or NaN: then neither comparison below holds.
    const bool positive = determinant.inf() > 0, negative = determinant.sup() < 0;
    const bool zero = determinant.inf() == 0 && determinant.sup() == 0;
    if (positive || negative || zero) {
      ++precision_tally().interval_signs;
      return {positive ? 1 : negative ? -1 : 0, DecidedBy::interval};
    }
  }
  ++precision_tally().exact_signs;
  const int sign = static_cast<int>(
      CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y), Kernel::Point_2(c.x, c.y)));
  return {sign, DecidedBy::exact};
}

HeightGap height_gap(Vec3 a, Vec3 b, Vec3 p) {
  // The three are collinear in plan, so one plan axis along which the edge is not degenerate tells all.
  const bool along_x = a.x != b.x;
  if (along_x ? b.x < a.x : b.y < a.y) std::swap(a, b);
  const auto profile = [along_x](Vec3 v) { return Vec2{along_x ? v.x : v.y, v.z}; };
  const Sign side = orientation(profile(a), profile(b), profile(p));
  if (side.value == 0) return {0, 0, side.by};
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const double size = std::max(least, std::fabs(finite(exact_gap_m(a, b, p, along_x))));
  return {side.value, side.value * size, side.by};
}

double plan_area_m2(std::span<const Vec2> loop) {
  ++precision_tally().exact_figures;
  return finite(CGAL::to_double(Rational(twice_area(loop) / 2)));
}

double plan_area_m2(std::span<const std::vector<Vec2>> loops) {
  ++precision_tally().exact_figures;
  Rational twice = 0;
  for (const auto& loop : loops) twice += twice_area(loop);
  return finite(CGAL::to_double(Rational(twice / 2)));
}

}  // namespace plumbline::oracle
