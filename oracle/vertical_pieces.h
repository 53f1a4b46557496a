// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to O2 (vertical.h): integrals of linear functions over the overlay's pieces, and the running
// maxima.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace plumbline::oracle::detail {

/// 12/(2A) · ∫e² over a triangle of area A on which e is linear with corner values a, b, c.
inline double square_term(double a, double b, double c) {
  const double sum = a + b + c;
  return 0.5 * (sum * sum + (a * a + b * b + c * c));
}

/// 6/(2A) · ∫|e| over the same triangle. If one corner's sign differs from the other two, the line e = 0 cuts
/// off a similar cap at that corner m with area share m/(m−p) · m/(m−q), whose integral changes sign: |a + b
/// + c − 2m · m/(m−p) · m/(m−q)|. Without branches, so that a loop over it can use vector registers; written
/// with ratios in [0, 1], so that nothing over- or underflows.
inline double absolute_term(double a, double b, double c) {
  const double ab_low = a < b ? a : b;
  const double ab_high = a < b ? b : a;
  const double low = ab_low < c ? ab_low : c;
  const double high = ab_high < c ? c : ab_high;
  const double rest = ab_high < c ? ab_high : c;
  const double middle = ab_low < rest ? rest : ab_low;
  const double low_cap = low < 0 ? low : 0.0;
  const double high_cap = high > 0 ? high : 0.0;
  const double cap = middle < 0 ? high_cap : low_cap;  // 0: no change of sign
  const double other = middle < 0 ? low : high;
  const double to_middle = cap == 0 ? 1.0 : cap - middle;
  const double to_other = cap == 0 ? 1.0 : cap - other;
  return std::fabs((a + b + c) - 2 * cap * (cap / to_middle) * (cap / to_other));
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

/// Sums of ∫e² and ∫|e|, and the area. Lengths in plan are in cells. Pieces are gathered in batches and
/// summed in four lanes written out in the source, so that every compiler makes the same bits of it, with
/// vector registers or without.
class PieceSums {
 public:
  /// A row of `count` whole cells; `south` and `north` hold count + 1 errors at the samples.
  void add_cells(const double* south, const double* north, int count);
  /// A triangle with errors a, b, c at its corners.
  void add_triangle(double a, double b, double c, double twice_area) {
    triangles_.a[triangle_count_] = a;
    triangles_.b[triangle_count_] = b;
    triangles_.c[triangle_count_] = c;
    triangles_.twice_area[triangle_count_] = twice_area;
    if (++triangle_count_ == kBatch) flush_triangles();
  }
  /// Sums what is still in the batches. To be called once, before the figures are read.
  void finish();

  [[nodiscard]] double area() const { return 0.5 * twice_area_.value() + static_cast<double>(whole_cells_); }
  [[nodiscard]] double square_integral() const { return square_.value() / 12; }
  [[nodiscard]] double absolute_integral() const { return absolute_.value() / 6; }

 private:
  static constexpr std::size_t kBatch = 256;
  static constexpr std::size_t kLanes = 4;
  using Column = std::array<double, kBatch>;

  void flush_cells();
  void flush_triangles();

  struct {
    Column southwest, southeast, northeast, northwest;
  } cells_;
  struct {
    Column a, b, c, twice_area;
  } triangles_;
  std::size_t cell_count_ = 0;
  std::size_t triangle_count_ = 0;
  std::size_t whole_cells_ = 0;
  CompensatedSum square_, absolute_, twice_area_;
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
