// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "oracle/image.h"

namespace plumbline::oracle {

/// Collects a figure pixel by pixel, row by row: each row is summed from the left, the rows' sums from the
/// top.
class FigureBuilder {
 public:
  explicit FigureBuilder(std::size_t most) { values_.reserve(most); }
  /// Requires: value >= 0 and not NaN.
  void add(double value) {
    values_.push_back(value);
    row_sum_ += value;
    row_squares_ += value * value;
    if (value > max_) max_ = value;
  }
  void end_row() {
    sum_ += std::exchange(row_sum_, 0.0);
    squares_ += std::exchange(row_squares_, 0.0);
  }
  [[nodiscard]] std::size_t count() const { return values_.size(); }
  /// Ends the collection; reorders what was collected.
  [[nodiscard]] PixelFigure finish();

 private:
  std::vector<double> values_;
  double max_ = 0, sum_ = 0, squares_ = 0, row_sum_ = 0, row_squares_ = 0;
};

/// Pixels that see terrain in one picture and sky in the other, and the largest distance of such a pixel to
/// the nearest terrain pixel of the picture in which it is sky (that picture's diagonal if it is all sky).
struct SilhouetteDifference {
  std::size_t pixels = 0;
  double max_px = 0;
};
SilhouetteDifference compare_silhouettes(const PixelHits& one, const PixelHits& other);

}  // namespace plumbline::oracle
