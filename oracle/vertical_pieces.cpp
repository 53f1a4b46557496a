// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/vertical_pieces.h"

#include <algorithm>

namespace plumbline::oracle::detail {
namespace {

/// Sum in kLanes interleaved lanes, then lane by lane.
template <std::size_t kLanes>
double lane_sum(const double* terms, std::size_t count) {
  std::array<double, kLanes> lanes{};
  std::size_t k = 0;
  for (; k + kLanes <= count; k += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += terms[k + lane];
  }
  for (std::size_t lane = 0; k < count; ++k, ++lane) lanes[lane] += terms[k];
  double sum = 0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

}  // namespace

void PieceSums::add_cells(const double* south, const double* north, int count) {
  whole_cells_ += static_cast<std::size_t>(count);
  while (count > 0) {
    const int room = static_cast<int>(kBatch - cell_count_);
    const int part = std::min(count, room);
    double* const southwest = cells_.southwest.data() + cell_count_;
    double* const southeast = cells_.southeast.data() + cell_count_;
    double* const northeast = cells_.northeast.data() + cell_count_;
    double* const northwest = cells_.northwest.data() + cell_count_;
    for (int k = 0; k < part; ++k) {
      southwest[k] = south[k];
      southeast[k] = south[k + 1];
      northeast[k] = north[k + 1];
      northwest[k] = north[k];
    }
    cell_count_ += static_cast<std::size_t>(part);
    south += part;
    north += part;
    count -= part;
    if (cell_count_ == kBatch) flush_cells();
  }
}

void PieceSums::flush_cells() {
  Column square, absolute;
  for (std::size_t k = 0; k < cell_count_; ++k) {
    const double a = cells_.southwest[k];
    const double b = cells_.southeast[k];
    const double c = cells_.northeast[k];
    const double d = cells_.northwest[k];
    square[k] = square_term(a, b, c) + square_term(a, c, d);
    absolute[k] = absolute_term(a, b, c) + absolute_term(a, c, d);
  }
  square_.add(lane_sum<kLanes>(square.data(), cell_count_));
  absolute_.add(lane_sum<kLanes>(absolute.data(), cell_count_));
  cell_count_ = 0;
}

void PieceSums::flush_triangles() {
  Column square, absolute;
  for (std::size_t k = 0; k < triangle_count_; ++k) {
    const double a = triangles_.a[k];
    const double b = triangles_.b[k];
    const double c = triangles_.c[k];
    const double weight = triangles_.twice_area[k];
    square[k] = weight * square_term(a, b, c);
    absolute[k] = weight * absolute_term(a, b, c);
  }
  square_.add(lane_sum<kLanes>(square.data(), triangle_count_));
  absolute_.add(lane_sum<kLanes>(absolute.data(), triangle_count_));
  twice_area_.add(lane_sum<kLanes>(triangles_.twice_area.data(), triangle_count_));
  triangle_count_ = 0;
}

void PieceSums::finish() {
  flush_cells();
  flush_triangles();
}

}  // namespace plumbline::oracle::detail
