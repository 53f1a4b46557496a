// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/height_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "scenarios/random.h"

namespace plumbline {
namespace {

constexpr double kHole = std::numeric_limits<double>::quiet_NaN();

// Rows are written as they look from above: the first line is the northmost row. '.' is a hole, a digit a
// height.
HeightGrid drawn(const std::vector<std::string>& rows_from_north) {
  HeightGrid grid;
  grid.rows = static_cast<int>(rows_from_north.size());
  grid.columns = static_cast<int>(rows_from_north[0].size());
  for (auto row = rows_from_north.rbegin(); row != rows_from_north.rend(); ++row) {
    for (const char c : *row) grid.heights_m.push_back(c == '.' ? kHole : c - '0');
  }
  return grid;
}

HeightGrid random_grid(int columns, int rows, double holes, std::uint64_t seed) {
  Random random(seed, "height_grid_test");
  HeightGrid grid{columns, rows, {}};
  for (int k = 0; k < columns * rows; ++k) {
    const double z = random.between(0, 100);
    grid.heights_m.push_back(random.unit() < holes ? kHole : z);
  }
  return grid;
}

TEST(HeightGrid, InterpolationKeepsSamplesBitForBit) {
  const HeightGrid grid = random_grid(7, 5, 0, 1);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 7; ++i) EXPECT_EQ(grid.interpolated(i, j), grid.z(i, j));
  }
  EXPECT_EQ(grid.interpolated(-3, 99), grid.z(0, 4)) << "outside: the nearest border";
}

TEST(HeightGrid, InterpolationIsBilinear) {
  const HeightGrid grid = drawn({"48", "02"});
  EXPECT_EQ(grid.interpolated(0.5, 0), 1);
  EXPECT_EQ(grid.interpolated(0, 0.5), 2);
  EXPECT_EQ(grid.interpolated(0.5, 0.5), 3.5);
}

TEST(HeightGrid, CutKeepsOrder) {
  const HeightGrid part = cut(drawn({"789", "456", "123"}), {1, 1, 2, 2});
  EXPECT_EQ(part.heights_m, (std::vector<double>{5, 6, 8, 9}));
}

TEST(LargestWindow, OfDrawnGrids) {
  const auto window = [](const std::vector<std::string>& rows) {
    const GridWindow w = largest_window_without_holes(drawn(rows));
    return std::vector<int>{w.i, w.j, w.columns, w.rows};
  };
  EXPECT_EQ(window({"111", "111"}), (std::vector<int>{0, 0, 3, 2}));
  EXPECT_EQ(window({"11.", "111", ".11"}), (std::vector<int>{1, 0, 2, 2})) << "of equals the southmost";
  EXPECT_EQ(window({"1.1", "1.1"}), (std::vector<int>{0, 0, 1, 2})) << "of equals the westmost";
  EXPECT_EQ(window({"....", ".11.", ".11.", "...."}), (std::vector<int>{1, 1, 2, 2}));
  EXPECT_EQ(window({"...", "..."}), (std::vector<int>{0, 0, 0, 0}));
}

// The slow obvious twin: every window of small grids.
TEST(LargestWindow, AgreesWithTryingAll) {
  int with_holes = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const int columns = 1 + static_cast<int>(seed % 7);
    const int rows = 1 + static_cast<int>(seed / 7 % 6);
    const HeightGrid grid = random_grid(columns, rows, 0.25, seed);
    with_holes += grid.count_holes() > 0 ? 1 : 0;
    GridWindow best;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        for (int h = 1; j + h <= rows; ++h) {
          for (int w = 1; i + w <= columns; ++w) {
            if (cut(grid, {i, j, w, h}).count_holes() == 0 && w * h > best.columns * best.rows)
              best = {i, j, w, h};
          }
        }
      }
    }
    const GridWindow found = largest_window_without_holes(grid);
    EXPECT_EQ(found.columns * found.rows, best.columns * best.rows) << seed;
    EXPECT_EQ(std::pair(found.j, found.i), std::pair(best.j, best.i)) << seed;
    EXPECT_EQ(cut(grid, found).count_holes(), 0u) << seed;
  }
  EXPECT_GT(with_holes, 200);
}

TEST(FillHoles, KeepsDataAndStaysWithinItsRange) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const HeightGrid holed =
        random_grid(3 + static_cast<int>(seed % 40), 2 + static_cast<int>(seed % 31), 0.6, seed);
    if (holed.count_holes() == holed.heights_m.size()) continue;
    double low = 100, high = 0;
    for (const double z : holed.heights_m) {
      if (std::isnan(z)) continue;
      low = std::min(low, z);
      high = std::max(high, z);
    }
    constexpr double kRoundingM = 1e-9;  // means of numbers below 100 err by far less
    HeightGrid filled = holed;
    fill_holes(filled);
    for (std::size_t k = 0; k < holed.heights_m.size(); ++k) {
      if (!std::isnan(holed.heights_m[k])) {
        EXPECT_EQ(filled.heights_m[k], holed.heights_m[k]);
      } else {
        EXPECT_GE(filled.heights_m[k], low - kRoundingM);
        EXPECT_LE(filled.heights_m[k], high + kRoundingM);
      }
    }
  }
}

TEST(FillHoles, ContinuesASlope) {
  HeightGrid grid{65, 65, {}};
  for (int j = 0; j < 65; ++j) {
    for (int i = 0; i < 65; ++i) {
      const bool hole = i > 20 && i < 44 && j > 25 && j < 40;
      grid.heights_m.push_back(hole ? kHole : 10.0 * i);
    }
  }
  fill_holes(grid);
  for (int i = 21; i < 44; ++i)
    EXPECT_NEAR(grid.z(i, 32), 10.0 * i, 25) << "two and a half samples' rise, at most";
}

TEST(FillHoles, OneSampleFillsAll) {
  HeightGrid grid = drawn({".....", "...7.", "....."});
  fill_holes(grid);
  for (const double z : grid.heights_m) EXPECT_EQ(z, 7);
}

}  // namespace
}  // namespace plumbline
