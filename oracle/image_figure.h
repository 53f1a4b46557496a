// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "oracle/image.h"

namespace plumbline::oracle {

/// Collects a figure pixel by pixel, row by row: each row is summed from the left, the rows' sums from the
/// top. Values are counted by their upper bits on the way, so that exact quantiles take one more pass and no
/// sorting.
class FigureBuilder {
 public:
  explicit FigureBuilder(std::size_t most) : buckets_(kBuckets, 0) { values_.reserve(most); }
  /// Requires: value >= +0. What overflowed on its way (a NaN too) counts as infinite: no finite figure hides
  /// it.
  void add(double value) {
    if (!(value < std::numeric_limits<double>::infinity())) value = std::numeric_limits<double>::infinity();
    values_.push_back(value);
    ++buckets_[bucket_of(value)];
    row_sum_ += value;
    row_squares_ += value * value;
    if (value > max_) max_ = value;
  }
  void end_row() {
    sum_ += std::exchange(row_sum_, 0.0);
    squares_ += std::exchange(row_squares_, 0.0);
  }
  [[nodiscard]] std::size_t count() const { return values_.size(); }
  [[nodiscard]] PixelFigure finish() const;

 private:
  /// Bits of a non-negative double order as the double does; the upper 15 are exponent and 4 bits of the
  /// mantissa.
  static constexpr std::size_t kBuckets = std::size_t{1} << 15;
  static std::size_t bucket_of(double v) {
    return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(v) >> 48);
  }

  std::vector<double> values_;
  std::vector<std::uint32_t> buckets_;
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
