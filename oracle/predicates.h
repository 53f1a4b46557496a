// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "scenarios/vec.h"

/// The geometric questions of O1, each answered exactly for the doubles as given, and each saying which
/// precision decided. Coordinates may be anything finite: huge, subnormal, equal.
namespace plumbline::oracle {

enum class DecidedBy {
  double_filter,  ///< the sign of the rounded determinant is certain
  exact,          ///< CGAL's filtered exact predicate was asked
};

struct Sign {
  int value = 0;  ///< -1, 0 or +1
  DecidedBy by = DecidedBy::exact;
};

/// Sign of the plan orientation of a, b, c: +1 counter-clockwise. CGAL's
/// Exact_predicates_inexact_constructions_kernel.
int exact_orientation(Vec2 a, Vec2 b, Vec2 c);

/// Relative bound on the rounding error of the determinant below: (3 + 16u)u with u = 2⁻⁵³ (Shewchuk,
/// Adaptive Precision Floating-Point Arithmetic, 1997, §4.3, stage A).
inline constexpr double kOrientationRelativeBound = (3.0 + 16.0 * 0x1p-53) * 0x1p-53;
/// Shewchuk's bound assumes that no product underflows. One that does is off by at most 2⁻¹⁰⁷⁵; two of them,
/// and the underflow of the bound itself, stay far below this absolute allowance (square metres).
inline constexpr double kOrientationUnderflowBound = 0x1p-1060;

/// The same sign, by plain doubles where they are certain. An overflow makes the comparison fail, so it goes
/// on to the exact predicate as well.
inline Sign orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound =
      kOrientationRelativeBound * (std::fabs(left) + std::fabs(right)) + kOrientationUnderflowBound;
  if (determinant > bound) return {1, DecidedBy::double_filter};
  if (-determinant > bound) return {-1, DecidedBy::double_filter};
  return {exact_orientation(a, b, c), DecidedBy::exact};
}

/// Order along x, then y: a strict order of plan points, exact by itself.
inline bool before_in_plan(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// Is p in the open interior of segment ab?
inline bool inside_segment(Vec2 a, Vec2 b, Vec2 p) {
  if (before_in_plan(b, a)) {
    const Vec2 swap = a;
    a = b;
    b = swap;
  }
  return before_in_plan(a, p) && before_in_plan(p, b) && orientation(a, b, p).value == 0;
}

/// Height of p over the edge ab, which p meets in plan. The sign is exact; metres is rounded, and never zero
/// when the sign is not.
struct HeightGap {
  int sign = 0;
  double metres = 0;
};
/// Requires: p in the open interior of ab in plan.
HeightGap height_gap(Vec3 a, Vec3 b, Vec3 p);

}  // namespace plumbline::oracle
