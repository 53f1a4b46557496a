// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/image_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace plumbline::oracle {
namespace {

bool sees_terrain(const PixelHits& hits, std::size_t pixel) {
  return hits.triangle[pixel] != PixelHits::kNoHit;
}

/// Distance in rows to the nearest terrain pixel of the same column; `height + width` where there is none.
std::vector<std::int32_t> column_distances(const PixelHits& hits) {
  const auto width = static_cast<std::size_t>(hits.width);
  const auto height = static_cast<std::size_t>(hits.height);
  const std::int32_t far = hits.width + hits.height;
  std::vector<std::int32_t> distance(width * height);
  const auto sweep = [&](std::size_t y, bool first_row, std::size_t from, bool fresh) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = y * width + x;
      const std::int32_t passed = first_row ? far : std::min(far, distance[from * width + x] + 1);
      const std::int32_t own = sees_terrain(hits, pixel) ? 0 : far;
      distance[pixel] = std::min(fresh ? own : distance[pixel], passed);
    }
  };
  for (std::size_t y = 0; y < height; ++y) sweep(y, y == 0, y - 1, true);
  for (std::size_t y = height; y-- > 0;) sweep(y, y + 1 == height, y + 1, false);
  return distance;
}

/// Largest distance, over pixels that are terrain in `terrain` and sky in `sky`, to the nearest terrain pixel
/// of `sky`. Exact (squares are integers). Only pixels that could raise the maximum are searched: a pixel is
/// at most one pixel further off than its neighbour.
double largest_distance(const PixelHits& terrain, const PixelHits& sky) {
  const bool all_sky = std::all_of(sky.triangle.begin(), sky.triangle.end(),
                                   [](std::uint32_t t) { return t == PixelHits::kNoHit; });
  if (all_sky) {
    const auto w = static_cast<double>(sky.width);
    const auto h = static_cast<double>(sky.height);
    return std::sqrt(w * w + h * h);
  }
  constexpr double kSlackPx =
      1e-6;  // roundings of the bound; square roots of different integers lie further apart
  const std::vector<std::int32_t> column = column_distances(sky);
  std::int64_t largest_square = 0;
  double largest = 0;
  for (int y = 0; y < sky.height; ++y) {
    const std::size_t start = static_cast<std::size_t>(y) * static_cast<std::size_t>(sky.width);
    double bound = static_cast<double>(sky.width) + sky.height;
    for (int x = 0; x < sky.width; ++x) {
      const std::size_t pixel = start + static_cast<std::size_t>(x);
      bound = std::min(bound + 1, static_cast<double>(column[pixel]));
      if (sees_terrain(sky, pixel) || !sees_terrain(terrain, pixel) || bound + kSlackPx < largest) continue;
      std::int64_t square = std::int64_t{column[pixel]} * column[pixel];
      for (int aside = 1; std::int64_t{aside} * aside < square && (x - aside >= 0 || x + aside < sky.width);
           ++aside) {
        for (const int other : {x - aside, x + aside}) {
          if (other < 0 || other >= sky.width) continue;
          const std::int64_t rows = column[start + static_cast<std::size_t>(other)];
          square = std::min(square, rows * rows + std::int64_t{aside} * aside);
        }
      }
      bound = std::min(bound, std::sqrt(static_cast<double>(square)));
      if (square > largest_square) {
        largest_square = square;
        largest = std::sqrt(static_cast<double>(square));
      }
    }
  }
  return largest;
}

}  // namespace

PixelFigure FigureBuilder::finish() const {
  PixelFigure figure;
  figure.count = values_.size();
  if (values_.empty()) return figure;
  const auto count = static_cast<double>(values_.size());
  figure.max = max_;
  figure.mean = sum_ / count;
  figure.rms = std::sqrt(squares_ / count);
  // Quantiles by nearest rank, from below and from 1. All values from the 99 % quantile's bucket on are few;
  // both quantiles are among them.
  const std::size_t rank_99 = (values_.size() * 99 + 99) / 100;
  const std::size_t rank_999 = (values_.size() * 999 + 999) / 1000;
  std::size_t bucket = 0;
  std::size_t below = 0;
  while (below + buckets_[bucket] < rank_99) below += buckets_[bucket++];
  std::vector<double> upper;
  upper.reserve(values_.size() - below);
  for (const double v : values_) {
    if (bucket_of(v) >= bucket) upper.push_back(v);
  }
  const auto quantile = [&](std::size_t rank) {
    const auto place = upper.begin() + static_cast<std::ptrdiff_t>(rank - below - 1);
    std::nth_element(upper.begin(), place, upper.end());
    return *place;
  };
  figure.p99 = quantile(rank_99);
  figure.p999 = quantile(rank_999);
  return figure;
}

SilhouetteDifference compare_silhouettes(const PixelHits& one, const PixelHits& other) {
  SilhouetteDifference difference;
  bool more = false;
  bool less = false;
  for (std::size_t i = 0; i < one.triangle.size(); ++i) {
    const bool a = sees_terrain(one, i);
    const bool b = sees_terrain(other, i);
    difference.pixels += a != b ? 1 : 0;
    more = more || (a && !b);
    less = less || (b && !a);
  }
  if (more) difference.max_px = largest_distance(one, other);
  if (less) difference.max_px = std::max(difference.max_px, largest_distance(other, one));
  return difference;
}

}  // namespace plumbline::oracle
