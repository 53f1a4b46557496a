// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Every precision of the predicates, and which of them decided.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "oracle/predicates.h"

namespace plumbline {
namespace {

TEST(Predicates, EasyTurnsAreDecidedInDouble) {
  const oracle::Sign sign = oracle::orientation({0, 0}, {1, 0}, {0, 1});
  EXPECT_EQ(sign.value, 1);
  EXPECT_EQ(sign.by, oracle::DecidedBy::double_filter);
  EXPECT_EQ(oracle::orientation({0, 0}, {0, 1}, {1, 0}).value, -1);
}

TEST(Predicates, HardTurnsAreDecidedExactly) {
  // 0.1 + 0.2 is not 0.3: the three points miss a line by less than double sees in the determinant.
  const Vec2 a{0.1, 0.1}, b{0.2, 0.2}, c{0.1 + 0.2, std::nextafter(0.1 + 0.2, 1)};
  const oracle::Sign sign = oracle::orientation(a, b, c);
  EXPECT_EQ(sign.value, 1);
  EXPECT_EQ(oracle::orientation(b, a, c).value, -1);
  const oracle::Sign flat = oracle::orientation({0.1, 0.1}, {0.7, 0.7}, {0.3, 0.3});
  EXPECT_EQ(flat.value, 0);
  EXPECT_EQ(flat.by, oracle::DecidedBy::exact);
}

TEST(Predicates, ProductsThatUnderflowAreDecidedExactly) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  const oracle::Sign sign = oracle::orientation({0, 0}, {tiny, 0}, {0, tiny});
  EXPECT_EQ(sign.value, 1);
  EXPECT_EQ(sign.by, oracle::DecidedBy::exact);
}

TEST(Predicates, ProductsThatOverflowAreDecidedExactly) {
  constexpr double most = std::numeric_limits<double>::max();
  EXPECT_EQ(oracle::orientation({-most, -most}, {most, -most}, {most, most}).value, 1);
  EXPECT_EQ(oracle::orientation({-most, -most}, {most, most}, {0, 0}).value, 0);
}

TEST(Predicates, HeightGapIsSignedExactlyAndNeverRoundedToZero) {
  const Vec3 a{0, 0, 0.1}, b{2, 0, 0.3};
  const oracle::HeightGap gap =
      oracle::height_gap(a, b, {1, 0, 0.2});  // 0.1 + 0.3 is not twice 0.2, in doubles
  EXPECT_NE(gap.sign, 0);
  EXPECT_EQ(gap.metres > 0 ? 1 : -1, gap.sign);
  EXPECT_EQ(oracle::height_gap(b, a, {1, 0, 0.2}).metres, gap.metres) << "whichever way the edge runs";
  EXPECT_EQ(oracle::height_gap({0, 0, 1}, {0, 4, 3}, {0, 1, 1.5}).sign, 0) << "along y";
  EXPECT_EQ(oracle::height_gap({0, 0, 1}, {0, 4, 3}, {0, 1, 1.25}).metres, -0.25);
}

}  // namespace
}  // namespace plumbline
