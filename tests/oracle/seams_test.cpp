// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Borders made by hand. Unless said otherwise the first lies west of the line x = 0 and runs north, the
// second east of it and runs south; posts are given from south to north for both.
#include "oracle/seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/predicates.h"
#include "tests/oracle/border_support.h"

namespace plumbline::oracle {
namespace {

using test::chain;
using test::Post;
using ::testing::SizeIs;

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
double down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

struct Height {
  double y = 0, z = 0, skirt_m = 0;
};
std::vector<Post> posts(const std::vector<Height>& heights) {
  std::vector<Post> out;
  for (const Height& h : heights) out.push_back({{0, h.y, h.z}, h.skirt_m});
  return out;
}
Border west(const std::vector<Height>& heights) { return chain(posts(heights)); }
Border east(std::vector<Height> heights) {
  std::reverse(heights.begin(), heights.end());
  return chain(posts(heights));
}

Seam seam_of(const Border& first, const Border& second, Vec2 metres_per_unit = {1, 1}) {
  const auto seam = compare_borders(first, second, metres_per_unit);
  EXPECT_TRUE(seam) << "they share no stretch";
  return seam.value_or(Seam{});
}

TEST(Seams, EqualBordersAreWatertight) {
  const std::vector<Height> line{{0, 5}, {1, 7.3}, {2.5, -1e-9}, {4, 1e9}};
  const Seam seam = seam_of(west(line), east(line));
  EXPECT_TRUE(seam.watertight());
  EXPECT_EQ(seam.length, 4);
  EXPECT_EQ(seam.t_junctions + seam.cracks + seam.uncovered + seam.normals, 0u);
  EXPECT_EQ(seam.mean_gap_m, 0);
  EXPECT_EQ(seam.mean_abs_gap_m, 0);
  EXPECT_EQ(seam.largest_gap_m, 0);
  EXPECT_EQ(seam.first_over_second_m, 0);
  EXPECT_EQ(seam.second_over_first_m, 0);
}

TEST(Seams, OneMovedVertexIsOneGapOfItsSize) {
  for (const double moved : {up(7.3), 7.301, 8.3, down(7.3), 6.3}) {
    const Seam seam = seam_of(west({{0, 5}, {1, moved}, {2, 6}}), east({{0, 5}, {1, 7.3}, {2, 6}}));
    ASSERT_THAT(seam.gaps, SizeIs(1)) << moved;
    const SeamGap& gap = seam.gaps[0];
    EXPECT_EQ(gap.gap_m, moved - 7.3);
    EXPECT_EQ(gap.sign, moved > 7.3 ? 1 : -1);
    EXPECT_EQ(gap.at, (Vec3{0, 1, std::max(moved, 7.3)}));
    EXPECT_FALSE(gap.t_junction);
    EXPECT_EQ(gap.vertex, 1u);
    EXPECT_FALSE(gap.covered);
    EXPECT_EQ(seam.cracks, 1u);
    EXPECT_EQ(seam.t_junctions, 0u);
    EXPECT_EQ(seam.uncovered, 1u);
    EXPECT_EQ(seam.largest_gap_m, gap.gap_m);
    EXPECT_EQ(seam.largest_at, gap.at);
    // A tent of that height over the whole length.
    EXPECT_EQ(seam.mean_gap_m, gap.gap_m / 2);
    EXPECT_EQ(seam.mean_abs_gap_m, std::fabs(gap.gap_m) / 2);
    EXPECT_EQ(seam.first_over_second_m, std::max(gap.gap_m, 0.0));
    EXPECT_EQ(seam.second_over_first_m, std::max(-gap.gap_m, 0.0));
  }
}

TEST(Seams, AVertexOnTheOthersEdgeIsATJunctionWithoutAGap) {
  //  4  +   +  8
  //     |   |
  //     |   +  5    at y = 1, a quarter of the way: 4 + (8 - 4)/4
  //  0  +   +  4
  const Seam seam = seam_of(west({{0, 4}, {4, 8}}), east({{0, 4}, {1, 5}, {4, 8}}));
  ASSERT_THAT(seam.gaps, SizeIs(1));
  const SeamGap& gap = seam.gaps[0];
  EXPECT_TRUE(gap.t_junction);
  EXPECT_FALSE(gap.of_first);
  EXPECT_EQ(gap.vertex, 1u);
  EXPECT_EQ(gap.triangle, 0u);
  EXPECT_EQ(gap.sign, 0);
  EXPECT_EQ(gap.gap_m, 0);
  EXPECT_EQ(gap.at, (Vec3{0, 1, 5}));
  EXPECT_EQ(seam.t_junctions, 1u);
  EXPECT_EQ(seam.cracks, 0u);
  EXPECT_EQ(seam.uncovered, 1u);
  EXPECT_FALSE(seam.watertight());
  EXPECT_EQ(seam.length, 4);
  EXPECT_EQ(seam.mean_abs_gap_m, 0);
}

TEST(Seams, AnUlpOffTheEdgeIsAGapOfThatSign) {
  for (const double z : {up(5), down(5)}) {
    const Seam seam = seam_of(west({{0, 4}, {1, z}, {4, 8}}), east({{0, 4}, {4, 8}}));
    ASSERT_THAT(seam.gaps, SizeIs(1));
    EXPECT_TRUE(seam.gaps[0].t_junction);
    EXPECT_TRUE(seam.gaps[0].of_first);
    EXPECT_EQ(seam.gaps[0].gap_m, z - 5);
    EXPECT_EQ(seam.t_junctions, 1u);
    EXPECT_EQ(seam.cracks, 1u);
  }
  // Where the edge's height is no double, the sign is that of the exact one: as the predicate of O1 tells it.
  std::array<int, 3> seen{};
  for (int k = 1; k <= 40; ++k) {
    const double a = 0.1 * k, b = 0.7 + 0.3 * k, y = 0.1;
    for (const double z : {down(a + (b - a) * y), a + (b - a) * y, up(a + (b - a) * y)}) {
      const HeightGap wanted = height_gap({0, 0, a}, {0, 1, b}, {0, y, z});
      const Seam seam = seam_of(west({{0, a}, {y, z}, {1, b}}), east({{0, a}, {1, b}}));
      ASSERT_THAT(seam.gaps, SizeIs(1));
      EXPECT_EQ(seam.gaps[0].sign, wanted.sign);
      EXPECT_EQ(seam.gaps[0].gap_m, wanted.metres);
      EXPECT_LE(std::fabs(wanted.metres), 2e-15);
      ++seen[static_cast<std::size_t>(wanted.sign + 1)];
    }
  }
  EXPECT_GE(seen[0], 40);
  EXPECT_GE(seen[2], 40);
}

TEST(Seams, DifferentSubdivisionsTellAllTheirVertices) {
  //  3   2 +   +  4
  //  2  -1 +   |
  // 1.5    |   +  1     the line opposite: 0.5 at y = 1.5, 2/3 at 1, 2 at 2
  //  1   0 +   |
  //  0   0 +   +  0
  const Seam seam = seam_of(west({{0, 0}, {1, 0}, {2, -1}, {3, 2}}), east({{0, 0}, {1.5, 1}, {3, 4}}));
  ASSERT_THAT(seam.gaps, SizeIs(4));
  const double y[] = {1, 1.5, 2, 3};
  const double gap[] = {-2.0 / 3, -0.5 - 1, -1 - 2, 2 - 4};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(seam.gaps[k].at.y, y[k]);
    EXPECT_DOUBLE_EQ(seam.gaps[k].gap_m, gap[k]);
    EXPECT_EQ(seam.gaps[k].t_junction, k < 3);
    EXPECT_EQ(seam.gaps[k].of_first, k == 0 || k == 2);
  }
  EXPECT_EQ(seam.gaps[0].vertex, 1u);
  EXPECT_EQ(seam.gaps[1].vertex, 1u);
  EXPECT_EQ(seam.gaps[2].vertex, 2u);
  EXPECT_EQ(seam.gaps[3].vertex, 3u) << "both have one: the first's";
  EXPECT_EQ(seam.t_junctions, 3u);
  EXPECT_EQ(seam.cracks, 4u);
  EXPECT_EQ(seam.largest_gap_m, -3);
  EXPECT_EQ(seam.largest_at, (Vec3{0, 2, 2}));
  EXPECT_EQ(seam.first_over_second_m, 0);
  EXPECT_EQ(seam.second_over_first_m, 3);
  // Trapezia: ⅓ + ½·(⅔ + 1½)/2 + ½·(1½ + 3)/2 + (3 + 2)/2, over 3.
  EXPECT_DOUBLE_EQ(seam.mean_abs_gap_m, (1.0 / 3 + 13.0 / 24 + 9.0 / 8 + 2.5) / 3);
  EXPECT_DOUBLE_EQ(seam.mean_gap_m, -seam.mean_abs_gap_m);
}

TEST(Seams, AGapThatChangesItsSignIsMeasuredOnBothSides) {
  const Seam seam = seam_of(west({{0, 1}, {4, -3}}), east({{0, 0}, {4, 0}}));
  EXPECT_EQ(seam.mean_gap_m, -1);
  EXPECT_EQ(seam.mean_abs_gap_m, (1 * 1 + 3 * 3) / (2.0 * 4));
  EXPECT_EQ(seam.largest_gap_m, -3);
  EXPECT_EQ(seam.first_over_second_m, 1);
  EXPECT_EQ(seam.second_over_first_m, 3);
  EXPECT_EQ(seam.cracks, 2u);
  // Of equals the first in plan order.
  const Seam even = seam_of(west({{0, -2}, {4, 2}}), east({{0, 0}, {4, 0}}));
  EXPECT_EQ(even.largest_gap_m, -2);
  EXPECT_EQ(even.largest_at.y, 0);
  EXPECT_EQ(even.mean_gap_m, 0);
  EXPECT_EQ(even.mean_abs_gap_m, 1);
  // So small that squares underflow.
  const Seam tiny = seam_of(west({{0, 1e-300}, {4, -3e-300}}), east({{0, 0}, {4, 0}}));
  EXPECT_DOUBLE_EQ(tiny.mean_abs_gap_m, 1.25e-300);
}

TEST(Seams, OnlyTheCommonStretchCounts) {
  //        4 +            the first's edge from 0 to 4, the second's from 3 to 6: common from 3 to 4
  //  6  +    |
  const Seam seam = seam_of(west({{0, 0}, {4, 8}}), east({{3, 6}, {6, 12}}));
  EXPECT_EQ(seam.length, 1);
  ASSERT_THAT(seam.gaps, SizeIs(2));
  EXPECT_FALSE(seam.gaps[0].of_first);
  EXPECT_EQ(seam.gaps[0].at, (Vec3{0, 3, 6}));
  EXPECT_TRUE(seam.gaps[1].of_first);
  EXPECT_EQ(seam.gaps[1].at, (Vec3{0, 4, 8}));
  EXPECT_EQ(seam.t_junctions, 2u);
  EXPECT_EQ(seam.cracks, 0u) << "the line is the same";
  // In metres: half a metre a unit along y.
  EXPECT_EQ(seam_of(west({{0, 0}, {4, 8}}), east({{3, 6}, {6, 12}}), {9, 0.5}).length, 0.5);
  // Two stretches with a pause between them.
  Border halves = east({{0, 0}, {1, 2}});
  const Border north = east({{2, 4}, {4, 8}});
  halves.edges.insert(halves.edges.end(), north.edges.begin(), north.edges.end());
  test::set_box(halves);
  EXPECT_EQ(seam_of(west({{0, 0}, {4, 8}}), halves).length, 3);
}

TEST(Seams, WithoutACommonStretchThereIsNone) {
  const Border first = west({{0, 0}, {4, 0}});
  EXPECT_FALSE(compare_borders(first, east({{4, 0}, {6, 0}}))) << "a point";
  EXPECT_FALSE(compare_borders(first, east({{5, 0}, {6, 0}}))) << "nothing";
  EXPECT_FALSE(compare_borders(first, west({{0, 0}, {4, 0}}))) << "on the same side: they overlap";
  EXPECT_FALSE(compare_borders(first, Border{}));
  EXPECT_FALSE(compare_borders(Border{}, first));
  EXPECT_FALSE(compare_borders(first, chain({{{-1, 2, 0}}, {{1, 2, 0}}}))) << "across";
  EXPECT_FALSE(compare_borders(first, chain({{{0, 2, 0}}, {{1, 2, 0}}}))) << "standing on it";
  EXPECT_FALSE(compare_borders(first, chain({{{up(0), 4, 0}}, {{up(0), 0, 0}}}))) << "an ulp beside";
  EXPECT_FALSE(compare_borders(first, chain({{{0, 4, 0}}, {{up(0), 0, 0}}}))) << "an ulp askew";
}

TEST(Seams, LinesThatAreNoAxis) {
  // Along (3, 1): vertices at whole multiples lie on it exactly.
  const auto at = [](double k, double z) { return Post{{3 * k, k, z}}; };
  const Border first = chain({at(0, 0), at(4, 8)});
  const Seam seam = seam_of(first, chain({at(4, 8), at(3, 7), at(1, 2), at(0, 0)}));
  ASSERT_THAT(seam.gaps, SizeIs(2));
  EXPECT_EQ(seam.gaps[0].gap_m, 0);
  EXPECT_EQ(seam.gaps[0].at, (Vec3{3, 1, 2}));
  EXPECT_EQ(seam.gaps[1].gap_m, -1);
  EXPECT_EQ(seam.gaps[1].vertex, 1u);
  EXPECT_DOUBLE_EQ(seam.length, 4 * std::sqrt(10.0));
  EXPECT_DOUBLE_EQ(seam.mean_gap_m, -0.5 * 3 / 4) << "a tent from 1 to 4";
  // Tenths, as far as doubles have them: x = y holds exactly.
  const Border diagonal = chain({{{0.1, 0.1, 1}}, {{0.7, 0.7, 1}}});
  EXPECT_THAT(seam_of(diagonal, chain({{{0.7, 0.7, 1}}, {{0.3, 0.3, 1}}, {{0.1, 0.1, 1}}})).gaps, SizeIs(1));
  EXPECT_FALSE(compare_borders(diagonal, chain({{{0.7, 0.7, 1}}, {{0.3, up(0.3), 1}}, {{0.1, 0.1, 1}}})));
}

TEST(Seams, ABorderThatTouchesItselfIsComparedAllTheSame) {
  // The first has an edge from 0 to 4 and, of another part of it, a vertex at 2, which is on that edge. The
  // second's edge is the same. Neither of the two edges has a vertex at 2.
  Border first = west({{0, 0}, {4, 8}});
  const Border spur = chain({{{-1, 2, 0}}, {{0, 2, 50}}, {{-1, 3, 0}}});
  first.edges.insert(first.edges.end(), spur.edges.begin(), spur.edges.end());
  test::set_box(first);
  EXPECT_TRUE(seam_of(first, east({{0, 0}, {4, 8}})).watertight());
  const Seam seam = seam_of(first, east({{0, 1}, {4, 8}}));
  EXPECT_EQ(seam.length, 4);
  ASSERT_THAT(seam.gaps, SizeIs(1)) << "the widest place alone";
  EXPECT_EQ(seam.gaps[0].at.y, 0);
  EXPECT_DOUBLE_EQ(seam.mean_gap_m, -0.5);
  // At two heights in one place: the greater gap is told, once.
  Border step = west({{0, 0}, {1, 0}});
  const Border above = west({{1, 5}, {2, 0}});
  step.edges.insert(step.edges.end(), above.edges.begin(), above.edges.end());
  test::set_box(step);
  for (const bool swapped : {false, true}) {
    const Border flat = east({{0, 0}, {1, 0}, {2, 0}});
    const Seam both = swapped ? seam_of(flat, step) : seam_of(step, flat);
    ASSERT_THAT(both.gaps, SizeIs(1));
    EXPECT_EQ(both.gaps[0].gap_m, swapped ? -5 : 5);
    EXPECT_EQ(both.mean_abs_gap_m, 1.25);
  }
}

// Heights on a lattice of integers.

/// Both borders one edge from 0 to 4, at one height each.
Seam seam_at(const ExactHeight& first, const ExactHeight& second) {
  const auto level = [](Border border, const ExactHeight& h) {
    for (BorderEdge& edge : border.edges) edge.height = {h, h};
    return border;
  };
  return seam_of(level(west({{0, 0}, {4, 0}}), first), level(east({{0, 0}, {4, 0}}), second));
}

using Rational = CGAL::Exact_rational;
Rational exact(const ExactHeight& h) {
  return Rational(h.low) - Rational(h.drop) +
         (Rational(h.high) - Rational(h.low)) * Rational(static_cast<int>(h.step)) / 32767;
}

TEST(Seams, TheSameHeightOnDifferentLatticesIsNoGap) {
  const std::vector<std::vector<ExactHeight>> equal{
      {{0, 32767, 100, 0},
       {100, 100, 0, 0},
       {100, -7, 0, 0},
       {0, 65534, 50, 0},
       {-100, 32667, 200, 0},
       {7, 7, 0, -93}},
      {{0, 1, 2, 0}, {0, 2, 1, 0}, {1, 0, 32765, 0}, {3, 4, 2, 3}},
      {{0.1, 0.7, 32767, 0}, {0.7, 0.1, 0, 0}, {0.7, 5, 0, 0}},
  };
  for (std::size_t i = 0; i < equal.size(); ++i) {
    for (std::size_t j = 0; j < equal.size(); ++j) {
      for (const ExactHeight& a : equal[i]) {
        for (const ExactHeight& b : equal[j]) {
          const Seam seam = seam_at(a, b);
          EXPECT_EQ(seam.watertight(), i == j) << a.low << " " << a.step << " : " << b.low << " " << b.step;
          EXPECT_EQ(seam.mean_abs_gap_m == 0, i == j);
        }
      }
    }
  }
}

TEST(Seams, WhatADoubleCannotSeeHasTheRightSign) {
  // Steps of a tile beside the nearest doubles: the difference is far below their last digit.
  std::array<int, 3> seen{};
  for (std::uint32_t step = 1; step < 32767; step += 777) {
    const ExactHeight tile{1e6, 1e6 + 1, step, 0};
    const double near = tile.metres();
    for (const double z : {down(near), near, up(near)}) {
      const Rational wanted = exact(tile) - Rational(z);
      const Seam seam = seam_at(tile, {z, z, 0, 0});
      const int sign = CGAL::sign(wanted);
      ++seen[static_cast<std::size_t>(sign + 1)];
      if (sign == 0) {
        EXPECT_TRUE(seam.watertight());
        continue;
      }
      ASSERT_THAT(seam.gaps, SizeIs(2));
      EXPECT_EQ(seam.gaps[0].sign, sign);
      EXPECT_DOUBLE_EQ(seam.gaps[0].gap_m, CGAL::to_double(wanted));
      EXPECT_LT(std::fabs(seam.gaps[0].gap_m), 3e-10) << "two units in the last place";
    }
  }
  EXPECT_GT(seen[0], 40);
  EXPECT_GT(seen[2], 40);
  // Between two lattices: 1/3 of the steps of one is never a step of the other.
  const Seam seam = seam_at({0, 3, 10923, 0}, {0, 1, 32767, 0});
  EXPECT_NEAR(seam.largest_gap_m, CGAL::to_double(Rational(2) / 32767), 1e-15);
}

TEST(Seams, HeightsOfAnySize) {
  constexpr double most = std::numeric_limits<double>::max(),
                   least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(seam_at({least, least, 0, 0}, {0, 0, 0, 0}).largest_gap_m, least);
  EXPECT_EQ(seam_at({most, most, 0, 0}, {-most, -most, 0, 0}).largest_gap_m, most);
  EXPECT_EQ(seam_at({most, most, 0, 0}, {down(most), 0, 0, 0}).largest_gap_m, most - down(most));
  // The middle of an edge from 0 to 3 least numbers, on both: 3/2 either way, whatever it rounds to.
  EXPECT_EQ(seam_of(west({{0, 0}, {1, 0}, {2, 3 * least}}), east({{0, 0}, {2, 3 * least}})).gaps.at(0).sign,
            -1);
  const Border rising = west({{0, 0}, {2, 3 * least}}), falling = east({{1, 2 * least}, {3, least}});
  EXPECT_EQ(seam_of(rising, falling).gaps.at(0).sign, -1) << "3/2 less 2";
  // An edge longer than any double.
  const Seam seam = seam_of(west({{-most, 0}, {most, 8}}), east({{-most, 0}, {0, 5}, {most, 8}}));
  ASSERT_THAT(seam.gaps, SizeIs(1));
  EXPECT_EQ(seam.gaps[0].gap_m, -1);
  EXPECT_EQ(seam.gaps[0].at.z, 5);
}

// Skirts.

TEST(Seams, ASkirtCoversToTheLastBit) {
  // The first a metre above the second. Its skirt of a metre ends exactly on it; 11 − (1 − 2⁻⁵³) rounds to
  // the same, and does not reach.
  struct Case {
    double first_m, second_m;
    bool covered;
  };
  for (const Case& c : {Case{1, 0, true}, Case{down(1), 0, false}, Case{0, 0, false}, Case{0, 5, false},
                        Case{5, 0, true}, Case{1, 5, true}}) {
    const Seam seam = seam_of(west({{0, 11, c.first_m}, {1, 11, c.first_m}}),
                              east({{0, 10, c.second_m}, {1, 10, c.second_m}}));
    EXPECT_EQ(seam.uncovered, c.covered ? 0u : 2u) << c.first_m << " " << c.second_m;
    EXPECT_FALSE(seam.watertight());
    EXPECT_EQ(seam.first_over_second_m, 1) << "what the skirt would need";
    EXPECT_EQ(seam.second_over_first_m, 0);
    // The other way round the skirt is the second's.
    EXPECT_EQ(seam_of(west({{0, 10, c.second_m}, {1, 10, c.second_m}}),
                      east({{0, 11, c.first_m}, {1, 11, c.first_m}}))
                  .uncovered,
              seam.uncovered);
  }
}

TEST(Seams, ASkirtOnPartOfTheBorderCoversThatPart) {
  // The skirt ends at y = 1: there one side of the gap is open.
  const Seam seam =
      seam_of(west({{0, 1, 2}, {1, 1, 2}, {2, 1}, {3, 1}}), east({{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
  ASSERT_THAT(seam.gaps, SizeIs(4));
  EXPECT_TRUE(seam.gaps[0].covered);
  EXPECT_FALSE(seam.gaps[1].covered);
  EXPECT_FALSE(seam.gaps[2].covered);
  EXPECT_FALSE(seam.gaps[3].covered);
  EXPECT_EQ(seam.uncovered, 3u);
  // Coming from the other end of the border, the same.
  EXPECT_EQ(
      seam_of(west({{0, 1}, {1, 1}, {2, 1, 2}, {3, 1, 2}}), east({{0, 0}, {1, 0}, {2, 0}, {3, 0}})).uncovered,
      3u);
}

TEST(Seams, WhereTheSidesCrossEachNeedsASkirtOfItsOwn) {
  const std::vector<Height> first{{0, 2, 2}, {4, 0, 2}};
  EXPECT_EQ(seam_of(west(first), east({{0, 1, 1}, {4, 1, 1}})).uncovered, 0u);
  EXPECT_EQ(seam_of(west(first), east({{0, 1}, {4, 1}})).uncovered, 1u);
  EXPECT_EQ(seam_of(west({{0, 2}, {4, 0}}), east({{0, 1, 1}, {4, 1, 1}})).uncovered, 1u);
}

TEST(Seams, AJunctionWithoutAGapIsHiddenByEitherSkirt) {
  const auto uncovered = [](double first_m, double second_m) {
    return seam_of(west({{0, 0, first_m}, {4, 4, first_m}}),
                   east({{0, 0, second_m}, {1, 1, second_m}, {4, 4, second_m}}))
        .uncovered;
  };
  EXPECT_EQ(uncovered(0, 0), 1u);
  EXPECT_EQ(uncovered(1, 0), 0u);
  EXPECT_EQ(uncovered(0, 1), 0u);
}

TEST(Seams, SkirtsOfMeshesAreFoundThroughTheirWalls) {
  // Two squares that share x = 4; the first stands 1 above the second there, with walls down by 1 or an ulp
  // less.
  const Mesh second{{{4, 0, 10}, {8, 0, 0}, {8, 4, 0}, {4, 4, 10}}, {{0, 1, 2}, {0, 2, 3}}};
  for (const double foot : {10.0, up(10)}) {
    const Mesh first{{{0, 0, 0}, {4, 0, 11}, {4, 4, 11}, {0, 4, 0}, {4, 0, foot}, {4, 4, 10}},
                     {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}};
    const Border ours = border_of(first, take_walls_off(first), {});
    const Seam seam = seam_of(ours, border_of(second, take_walls_off(second), {}));
    EXPECT_EQ(seam.length, 4);
    EXPECT_EQ(seam.cracks, 2u);
    EXPECT_EQ(seam.uncovered, foot == 10 ? 0u : 1u);
  }
}

// Normals.

TEST(Seams, NormalsAreComparedAtVerticesThatBothHave) {
  const double degree = 0.017453292519943295;
  const std::vector<Vec3> turned{{0, 0, 1}, {std::sin(degree), 0, std::cos(degree)}, {0, 1, 0}, {0, 0, -1}};
  const double angle[] = {0, 1, 90, 180};
  for (std::size_t worst = 0; worst < 4; ++worst) {
    for (const bool first_last : {false, true}) {
      // Vertices at 0, 1, 3 on both; at 2 on the first alone, with a normal that would be the largest.
      Border first = west({{0, 5}, {1, 6}, {2, 7}, {3, 8}}), second = east({{0, 5}, {1, 6}, {3, 8}});
      const double place = first_last ? 3 : 0;
      for (BorderEdge& edge : first.edges) {
        for (std::size_t k = 0; k < 2; ++k)
          edge.normal[k] = edge.plan[k].y == place ? turned[worst]
                           : edge.plan[k].y == 2   ? Vec3{1, 0, 0}
                                                   : Vec3{0, 0, 1};
      }
      for (BorderEdge& edge : second.edges) edge.normal = {Vec3{0, 0, 1}, Vec3{0, 0, 1}};
      const Seam seam = seam_of(first, second);
      EXPECT_EQ(seam.normals, 3u);
      EXPECT_NEAR(seam.normal_max_deg, angle[worst], 1e-12);
      EXPECT_EQ(seam.normal_at, (worst == 0 ? Vec3{0, 0, 5} : Vec3{0, place, 5 + place}));
      // One without a normal is not compared.
      for (BorderEdge& edge : second.edges) {
        for (std::size_t k = 0; k < 2; ++k) {
          if (edge.plan[k].y == place) edge.normal[k] = {};
        }
      }
      const Seam less = seam_of(first, second);
      EXPECT_EQ(less.normals, 2u);
      EXPECT_EQ(less.normal_max_deg, 0);
    }
  }
  EXPECT_EQ(seam_of(west({{0, 0}, {1, 0}}), east({{0, 0}, {1, 0}})).normals, 0u);
}

}  // namespace
}  // namespace plumbline::oracle
