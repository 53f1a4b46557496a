// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to O2 (vertical.h): integrals of linear functions over the overlay's pieces, and the running
// maxima.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace plumbline::oracle::detail {

/// Two doubles side by side: one SSE2 register, which every x86-64 has. Lane by lane the operations are those
/// of IEEE 754, so the bits do not depend on the compiler or on the machine.
using Pair = double __attribute__((vector_size(16)));

inline Pair load(const double* two) {
  Pair pair;
  std::memcpy(&pair, two, sizeof pair);
  return pair;
}

inline Pair lesser(Pair a, Pair b) { return a < b ? a : b; }
inline Pair greater(Pair a, Pair b) { return a > b ? a : b; }
/// The sign bit where `value` is negative, 0 elsewhere; flips signs by exclusive or.
using PairBits = decltype(Pair{} < Pair{});
inline PairBits flip_where_negative(Pair value) {
  return (value < 0) &
         PairBits{std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::min()};
}
inline Pair flipped(Pair value, PairBits flip) {
  return reinterpret_cast<Pair>(reinterpret_cast<PairBits>(value) ^ flip);
}

/// 12/(2A) · ∫e² over a triangle of area A on which e is linear with corner values a, b, c; `sum` = a + b +
/// c.
inline Pair square_term(Pair a, Pair b, Pair c, Pair sum) {
  return 0.5 * (sum * sum + (a * a + b * b + c * c));
}

/// 6/(2A) · ∫|e| over the same triangle, from its corner values in order. Flip signs so that the middle value
/// is not negative. If the lowest, m, then is, the line e = 0 cuts off a similar cap at that corner with area
/// share m/(m−p) · m/(m−q), whose integral changes sign: sum − 2m · m²/((m−p)(m−q)). Without branches: signs
/// change in a third of all cells, at random.
inline Pair absolute_term(Pair low, Pair middle, Pair high, Pair sum) {
  constexpr double kNeverZero = 0x1p-1000;  // for m = 0; m² does not exceed the divisor otherwise
  const PairBits flip = flip_where_negative(middle);
  const Pair cap = lesser(flipped(middle < 0 ? high : low, flip), Pair{});
  const Pair divisor = greater((flipped(middle, flip) - cap) * (high - low), Pair{} + kNeverZero);
  return flipped(sum, flip) - (cap + cap) * (cap * cap / divisor);
}

/// Neumaier's compensated sum: the order of the terms matters only beyond the last bit or so.
class CompensatedSum {
 public:
  void add(double term) {
    const double next = sum_ + term;
    carry_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  [[nodiscard]] double value() const { return sum_ + carry_; }

 private:
  double sum_ = 0, carry_ = 0;
};

/// A mesh triangle's plane: its height over `base_m` is by_x · x + by_y · y + constant, at columns and rows
/// from an origin. Errors are differences of heights over base_m, so that they keep their digits far above
/// sea level.
struct Plane {
  double base_m = 0, by_x = 0, by_y = 0, constant = 0;
};

/// The plane over one row of samples.
struct RowErrors {
  const double* heights = nullptr;
  double row_height = 0;  ///< of the plane at column 0

  [[nodiscard]] double at(const Plane& plane, int x) const {
    return (plane.by_x * x + row_height) - (heights[x] - plane.base_m);
  }
};

/// Sums of ∫e² and ∫|e|, and the area. Lengths in plan are in cells. The order of summation is written out
/// here: two lanes, and into compensated sums every few thousand terms.
class PieceSums {
 public:
  /// Whole cells x … x + count − 1 between two rows of one plane. Returns the greatest |e| among their
  /// samples.
  double add_cells(const Plane& plane, const RowErrors& south, const RowErrors& north, int x, int count);
  /// A triangle with errors a, b, c at its corners.
  void add_triangle(double a, double b, double c, double twice_area) {
    a_[waiting_] = a;
    b_[waiting_] = b;
    c_[waiting_] = c;
    twice_area_[waiting_] = twice_area;
    if (++waiting_ == kBatch) flush_triangles();
  }
  /// Sums what is still waiting. To be called once, before the figures are read.
  void finish();

  [[nodiscard]] double area() const {
    return 0.5 * twice_area_sum_.value() + static_cast<double>(whole_cells_);
  }
  [[nodiscard]] double square_integral() const { return square_.value() / 12; }
  [[nodiscard]] double absolute_integral() const { return absolute_.value() / 6; }

 private:
  static constexpr std::size_t kBatch = 256;  ///< even, so that pairs fill it
  static constexpr int kCellsPerLane = 4096;  ///< plain sums of this length lose at most 2⁻⁴¹ of themselves

  void flush_cells();
  void flush_triangles();

  alignas(16) std::array<double, kBatch> a_, b_, c_, twice_area_;
  std::size_t waiting_ = 0;
  std::size_t whole_cells_ = 0;
  Pair cell_squares_{};  ///< twice the sum
  Pair cell_absolutes_{};
  int cells_in_lanes_ = 0;
  CompensatedSum square_, absolute_, twice_area_sum_;
};

/// A running maximum with its place in cells; among equals the lowest y, then x.
struct Peak {
  double value = -1;  ///< -1: nothing visited
  double x = 0, y = 0;

  void visit(double candidate, double at_x, double at_y) {
    if (candidate < value) return;
    if (candidate > value || at_y < y || (at_y == y && at_x < x)) *this = {candidate, at_x, at_y};
  }
  /// Whether a candidate in row y no further west than x could enter.
  [[nodiscard]] bool admits(double candidate, double at_x, double at_y) const {
    return candidate > value || (candidate == value && (at_y < y || (at_y == y && at_x < x)));
  }
};

}  // namespace plumbline::oracle::detail
