// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/predicates.h"

#include <algorithm>
#include <limits>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

namespace plumbline::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Where the rounded gap is below this share of the heights it is computed from, cancellation may have eaten
/// it, and it is computed in rationals.
constexpr double kGapCancellation = 0x1p-40;

double exact_gap_m(Vec3 a, Vec3 b, Vec3 p, bool along_x) {
  using Rational = CGAL::Exact_rational;
  const Rational from = along_x ? a.x : a.y;
  const Rational to = along_x ? b.x : b.y;
  const Rational at = along_x ? p.x : p.y;
  const Rational az = a.z;
  const Rational gap = Rational(p.z) - (az + (Rational(b.z) - az) * (at - from) / (to - from));
  return CGAL::to_double(gap);
}

}  // namespace

int exact_orientation(Vec2 a, Vec2 b, Vec2 c) {
  return static_cast<int>(
      CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y), Kernel::Point_2(c.x, c.y)));
}

HeightGap height_gap(Vec3 a, Vec3 b, Vec3 p) {
  // The three are collinear in plan, so one plan axis along which the edge is not degenerate tells all.
  const bool along_x = a.x != b.x;
  if (along_x ? b.x < a.x : b.y < a.y) std::swap(a, b);
  const auto profile = [along_x](Vec3 v) { return Vec2{along_x ? v.x : v.y, v.z}; };
  HeightGap gap;
  gap.sign = orientation(profile(a), profile(b), profile(p)).value;
  if (gap.sign == 0) return gap;
  const double share = along_x ? (p.x - a.x) / (b.x - a.x) : (p.y - a.y) / (b.y - a.y);
  gap.metres = p.z - (a.z + share * (b.z - a.z));
  const double scale = std::max({std::fabs(a.z), std::fabs(b.z), std::fabs(p.z)});
  const bool doubtful = !std::isfinite(gap.metres) || !(std::fabs(gap.metres) > kGapCancellation * scale);
  if (doubtful) {
    constexpr double least = std::numeric_limits<double>::denorm_min();
    constexpr double most = std::numeric_limits<double>::max();
    gap.metres = gap.sign * std::clamp(std::fabs(exact_gap_m(a, b, p, along_x)), least, most);
  }
  return gap;
}

}  // namespace plumbline::oracle
