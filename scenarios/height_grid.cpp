// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/height_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace plumbline {

double HeightGrid::interpolated(double u, double v) const {
  u = std::clamp(u, 0.0, static_cast<double>(columns - 1));
  v = std::clamp(v, 0.0, static_cast<double>(rows - 1));
  const int i = std::min(static_cast<int>(u), columns - 2);
  const int j = std::min(static_cast<int>(v), rows - 2);
  const double s = u - i;
  const double t = v - j;
  // Weighted sums, not increments: weights 0 and 1 reproduce the sample itself.
  const double south = z(i, j) * (1 - s) + z(i + 1, j) * s;
  const double north = z(i, j + 1) * (1 - s) + z(i + 1, j + 1) * s;
  return south * (1 - t) + north * t;
}

std::size_t HeightGrid::count_holes() const {
  return static_cast<std::size_t>(
      std::count_if(heights_m.begin(), heights_m.end(), [](double z) { return std::isnan(z); }));
}

HeightGrid cut(const HeightGrid& grid, GridWindow window) {
  HeightGrid part;
  part.columns = window.columns;
  part.rows = window.rows;
  part.heights_m.reserve(static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows));
  for (int j = 0; j < window.rows; ++j) {
    const auto first =
        grid.heights_m.begin() + static_cast<std::ptrdiff_t>(grid.index(window.i, window.j + j));
    part.heights_m.insert(part.heights_m.end(), first, first + window.columns);
  }
  return part;
}

GridWindow largest_window_without_holes(const HeightGrid& grid) {
  GridWindow best;
  std::int64_t best_area = 0;
  const auto better = [&](const GridWindow& w, std::int64_t area) {
    if (area != best_area) return area > best_area;
    return w.j != best.j ? w.j < best.j : w.i < best.i;
  };
  // run[i]: samples with data from the current row down, without a hole between.
  std::vector<int> run(static_cast<std::size_t>(grid.columns) + 1, 0);
  struct Step {
    int from, height;
  };
  std::vector<Step> stack;  // rectangles still open to the east: heights strictly increase
  for (int j = 0; j < grid.rows; ++j) {
    stack.clear();
    for (int i = 0; i <= grid.columns; ++i) {
      int& height = run[static_cast<std::size_t>(i)];
      if (i < grid.columns) height = std::isnan(grid.z(i, j)) ? 0 : height + 1;
      int from = i;
      while (!stack.empty() && stack.back().height >= height) {
        const Step step = stack.back();
        stack.pop_back();
        const GridWindow window{step.from, j - step.height + 1, i - step.from, step.height};
        const std::int64_t area = std::int64_t{window.columns} * window.rows;
        if (area > 0 && better(window, area)) {
          best = window;
          best_area = area;
        }
        from = step.from;
      }
      stack.push_back({from, height});
    }
  }
  return best;
}

namespace {

// Half the resolution, rounded up: each sample the mean of those of its 2 × 2 that hold data.
HeightGrid halved(const HeightGrid& fine) {
  HeightGrid coarse;
  coarse.columns = (fine.columns + 1) / 2;
  coarse.rows = (fine.rows + 1) / 2;
  coarse.heights_m.reserve(static_cast<std::size_t>(coarse.columns) * static_cast<std::size_t>(coarse.rows));
  for (int j = 0; j < coarse.rows; ++j) {
    for (int i = 0; i < coarse.columns; ++i) {
      double sum = 0;
      int count = 0;
      for (int b = 2 * j; b < std::min(2 * j + 2, fine.rows); ++b) {
        for (int a = 2 * i; a < std::min(2 * i + 2, fine.columns); ++a) {
          if (std::isnan(fine.z(a, b))) continue;
          sum += fine.z(a, b);
          ++count;
        }
      }
      coarse.heights_m.push_back(count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return coarse;
}

// Gauss–Seidel in row order towards the mean of the neighbours, in the holes alone.
void relax(HeightGrid& grid, const std::vector<std::size_t>& holes) {
  constexpr int kRounds = 8;  // smooths the coarser grid's blocks away; broad shapes came from above
  const auto width = static_cast<std::size_t>(grid.columns);
  for (int round = 0; round < kRounds; ++round) {
    for (const std::size_t k : holes) {
      double sum = 0;
      int count = 0;
      const auto add = [&](bool inside, std::size_t neighbour) {
        if (!inside) return;
        sum += grid.heights_m[neighbour];
        ++count;
      };
      add(k >= width, k - width);
      add(k % width > 0, k - 1);
      add(k % width + 1 < width, k + 1);
      add(k + width < grid.heights_m.size(), k + width);
      if (count > 0) grid.heights_m[k] = sum / count;
    }
  }
}

}  // namespace

void fill_holes(HeightGrid& grid) {
  std::vector<std::size_t> holes;
  for (std::size_t k = 0; k < grid.heights_m.size(); ++k) {
    if (std::isnan(grid.heights_m[k])) holes.push_back(k);
  }
  if (holes.empty()) return;
  HeightGrid coarse = halved(grid);
  fill_holes(coarse);  // depth: log2 of the side; one sample with data is enough to end it
  for (const std::size_t k : holes) {
    const auto i = static_cast<int>(k % static_cast<std::size_t>(grid.columns));
    const auto j = static_cast<int>(k / static_cast<std::size_t>(grid.columns));
    // A coarse sample stands in the middle of its 2 × 2.
    grid.heights_m[k] = coarse.columns < 2 || coarse.rows < 2
                            ? coarse.z(i / 2, j / 2)
                            : coarse.interpolated((i - 0.5) / 2, (j - 0.5) / 2);
  }
  relax(grid, holes);
}

}  // namespace plumbline
