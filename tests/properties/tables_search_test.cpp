// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "properties/tables/search.h"

namespace plumbline::tables {
namespace {

TEST(Search, FindsACountThatFalls) {
  // As triangles do with τ: 10⁶ / x², whole numbers.
  const Found found = search({20569, 1, true, 0}, [](double x) { return std::floor(1e6 / (x * x)); });
  EXPECT_TRUE(found.bracketed);
  EXPECT_EQ(found.value, 20569);
  EXPECT_EQ(std::floor(1e6 / (found.x * found.x)), 20569);
}

TEST(Search, FindsACountThatRises) {
  const Found found = search({129, 64, false, 0}, [](double x) { return std::floor(40 * std::sqrt(x)); });
  EXPECT_TRUE(found.bracketed);
  EXPECT_EQ(found.value, 129);
}

TEST(Search, StartsOnEitherSide) {
  for (const double start : {1e-6, 1e6}) {
    const Found found = search({100, start, true, 1e-9}, [](double x) { return 1000 / x; });
    EXPECT_NEAR(found.x, 10, 1e-7) << start;
  }
}

TEST(Search, StopsWithinTheTolerance) {
  int calls = 0;
  const auto measure = [&](double x) {
    ++calls;
    return x;
  };
  const Found found = search({3, 1, false, 1e-3}, measure);
  EXPECT_NEAR(found.value, 3, 3e-3);
  EXPECT_LT(calls, 16);
}

TEST(Search, AJumpOverTheGoalGivesTheNearerSide) {
  const Found found = search({100, 1, true, 0}, [](double x) { return x < 7 ? 110.0 : 60.0; });
  EXPECT_TRUE(found.bracketed);
  EXPECT_EQ(found.value, 110);
  EXPECT_LT(found.x, 7);
}

TEST(Search, AGoalOutOfReachGivesTheNearestAndSaysSo) {
  const Found found = search({1000, 1, true, 0}, [](double x) { return x < 1e-3 ? 500.0 : 400.0; });
  EXPECT_FALSE(found.bracketed);
  EXPECT_EQ(found.value, 500);
  const Found flat = search({1000, 2, true, 0}, [](double) { return 8.0; });
  EXPECT_FALSE(flat.bracketed);
  EXPECT_EQ(flat.value, 8);
  EXPECT_EQ(flat.x, 2);
}

TEST(Search, TakesTheSameStepsEveryTime) {
  const auto steps = [] {
    std::vector<double> tried;
    search({38530, 1, true, 0}, [&](double x) {
      tried.push_back(x);
      return std::floor(2e5 / x);
    });
    return tried;
  };
  EXPECT_EQ(steps(), steps());
  EXPECT_GT(steps().size(), 3U);
}

}  // namespace
}  // namespace plumbline::tables
