// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "scenarios/vec.h"

/// The geometric questions of O1, each answered exactly for the doubles as given, and each saying which
/// precision decided. Coordinates may be anything finite: huge, subnormal, equal.
namespace plumbline::oracle {

enum class DecidedBy {
  double_filter,  ///< the sign of the rounded determinant is certain
  interval,       ///< it is not, but that of its interval is (directed roundings)
  exact,          ///< the interval holds zero and more: CGAL's exact predicate was asked
};

struct Sign {
  int value = 0;  ///< -1, 0 or +1
  DecidedBy by = DecidedBy::exact;
};

/// What this thread had to decide beyond plain double so far. Counted off the hot path only, so that tests
/// can tell which precision an oracle's verdict rests on: take it before and after, and subtract.
struct PrecisionTally {
  std::size_t interval_signs = 0;  ///< signs that intervals told
  std::size_t exact_signs = 0;     ///< signs that only exact arithmetic told
  std::size_t exact_figures = 0;   ///< figures (gaps, areas) and cuts that were computed in rationals
  friend bool operator==(const PrecisionTally&, const PrecisionTally&) = default;
  friend PrecisionTally operator-(PrecisionTally a, PrecisionTally b) {
    return {a.interval_signs - b.interval_signs, a.exact_signs - b.exact_signs,
            a.exact_figures - b.exact_figures};
  }
};
PrecisionTally& precision_tally();

/// Sign of the plan orientation of a, b, c: +1 counter-clockwise. CGAL's intervals first, its exact predicate
/// (Exact_predicates_inexact_constructions_kernel) where they cannot tell.
Sign careful_orientation(Vec2 a, Vec2 b, Vec2 c);

/// Relative bound on the rounding error of the determinant below: (3 + 16u)u with u = 2⁻⁵³ (Shewchuk,
/// Adaptive Precision Floating-Point Arithmetic, 1997, §4.3, stage A).
inline constexpr double kOrientationRelativeBound = (3.0 + 16.0 * 0x1p-53) * 0x1p-53;
/// Shewchuk's bound assumes that no product underflows. One that does is off by at most 2⁻¹⁰⁷⁵; two of them,
/// and the underflow of the bound itself, stay far below this absolute allowance (square metres).
inline constexpr double kOrientationUnderflowBound = 0x1p-1060;

/// The same sign, by plain doubles where they are certain. An overflow makes the comparison fail, so it goes
/// on to the careful ones as well.
inline Sign orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound =
      kOrientationRelativeBound * (std::fabs(left) + std::fabs(right)) + kOrientationUnderflowBound;
  if (determinant > bound) return {1, DecidedBy::double_filter};
  if (-determinant > bound) return {-1, DecidedBy::double_filter};
  return careful_orientation(a, b, c);
}

/// Order along x, then y: a strict order of plan points, exact by itself.
inline bool before_in_plan(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

struct Answer {
  bool value = false;
  DecidedBy by = DecidedBy::exact;
};

/// Is p in the open interior of segment ab? Comparisons of doubles are exact, so a point before or after the
/// segment is told in double.
inline Answer in_segment(Vec2 a, Vec2 b, Vec2 p) {
  if (before_in_plan(b, a)) {
    const Vec2 swap = a;
    a = b;
    b = swap;
  }
  if (!before_in_plan(a, p) || !before_in_plan(p, b)) return {false, DecidedBy::double_filter};
  const Sign side = orientation(a, b, p);
  return {side.value == 0, side.by};
}
inline bool inside_segment(Vec2 a, Vec2 b, Vec2 p) { return in_segment(a, b, p).value; }

/// Height of p over the edge ab, which p meets in plan. The sign is exact; metres is the exact gap, rounded
/// once (towards zero), and never zero when the sign is not: the same bits whichever way the edge runs and
/// whichever axis it runs along.
struct HeightGap {
  int sign = 0;
  double metres = 0;
  DecidedBy by = DecidedBy::exact;  ///< the sign
};
/// Requires: p in the open interior of ab in plan.
HeightGap height_gap(Vec3 a, Vec3 b, Vec3 p);

/// Signed area of a closed plan loop (positive: counter-clockwise), computed in rationals and rounded once
/// (towards zero), so that the same bits come out whichever corner the loop begins with; mirrored, its
/// negative. At most the largest double in size. Square metres.
double plan_area_m2(std::span<const Vec2> loop);
/// The sum of several loops' areas, rounded once.
double plan_area_m2(std::span<const std::vector<Vec2>> loops);

}  // namespace plumbline::oracle
