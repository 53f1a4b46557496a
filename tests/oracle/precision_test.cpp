// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which precision decided: inputs that need doubles, intervals or exact arithmetic, asked of the predicates
// and of every oracle whose verdict rests on them. The tally counts what plain double could not tell, so
// "nothing beyond double" is a difference of zero.
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "oracle/conformity.h"
#include "oracle/economy.h"
#include "oracle/likeness.h"
#include "oracle/predicates.h"
#include "oracle/soundness.h"
#include "oracle/vertical.h"
#include "scenarios/random.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle {
namespace {

template <class Work>
PrecisionTally beyond_double(Work work) {
  const PrecisionTally before = precision_tally();
  work();
  return precision_tally() - before;
}

constexpr PrecisionTally kDoubleAlone{};

/// Points so placed that each precision is needed. Three on a line, by the doubles as given.
struct Line {
  Vec2 a, b, c;
};
/// Differences and products are whole numbers: intervals stay points, and see the zero.
constexpr Line kWhole{{0, 0}, {4, 2}, {2, 1}};
/// The differences are no doubles, so every interval has a width, and holds zero: x = y makes the line sure.
constexpr Line kTenths{{0.1, 0.1}, {0.7, 0.7}, {0.3, 0.3}};

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

TEST(Precision, FarApartIsDecidedInDouble) {
  const PrecisionTally tally = beyond_double([] {
    EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}).by, DecidedBy::double_filter);
    EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}).value, 1);
    EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}).value, -1);
  });
  EXPECT_EQ(tally, kDoubleAlone);
}

TEST(Precision, AnUlpBesideALineIsDecidedByIntervals) {
  // c is an ulp above or below the line through whole numbers: double's bound is wider than that, an interval
  // of exact differences is not.
  for (const int side : {1, -1}) {
    const Vec2 c{2, side > 0 ? up(1.0) : std::nextafter(1.0, 0.0)};
    const Sign sign = orientation(kWhole.a, kWhole.b, c);
    EXPECT_EQ(sign.value, side);
    EXPECT_EQ(sign.by, DecidedBy::interval);
  }
  const Sign flat = orientation(kWhole.a, kWhole.b, kWhole.c);
  EXPECT_EQ(flat.value, 0);
  EXPECT_EQ(flat.by, DecidedBy::interval) << "a zero that intervals can tell";
}

TEST(Precision, OnALineOfTenthsIsDecidedExactly) {
  const Sign flat = orientation(kTenths.a, kTenths.b, kTenths.c);
  EXPECT_EQ(flat.value, 0);
  EXPECT_EQ(flat.by, DecidedBy::exact);
  const Sign beside = orientation(kTenths.a, kTenths.b, {0.3, up(0.3)});
  EXPECT_EQ(beside.value, 1);
  EXPECT_NE(beside.by, DecidedBy::double_filter);
}

TEST(Precision, UnderflowAndOverflowAreDecidedExactly) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  constexpr double most = std::numeric_limits<double>::max();
  const Sign small = orientation({0, 0}, {tiny, 0}, {0, tiny});
  EXPECT_EQ(small.value, 1);
  EXPECT_EQ(small.by, DecidedBy::exact);
  const Sign large = orientation({-most, -most}, {most, most}, {0, 0});
  EXPECT_EQ(large.value, 0);
  EXPECT_EQ(large.by, DecidedBy::exact);
}

TEST(Precision, EveryPrecisionDecidesManyAndAllAgree) {
  // Random points on a coarse lattice of tenths, moved by nothing or an ulp: all three precisions have work,
  // and a turn of the corners never changes the sign, a swap always does.
  Random random(1);
  std::array<std::size_t, 3> decided{};
  for (int round = 0; round < 100000; ++round) {
    const auto draw = [&] {
      const double x = static_cast<double>(random.below(9)) * (round % 2 == 0 ? 1.0 : 0.1);
      return random.below(3) == 0 ? up(x) : x;
    };
    const Vec2 a{draw(), draw()}, b{draw(), draw()}, c{draw(), draw()};
    const Sign sign = orientation(a, b, c);
    ++decided[static_cast<std::size_t>(sign.by)];
    ASSERT_EQ(orientation(b, c, a).value, sign.value);
    ASSERT_EQ(orientation(b, a, c).value, -sign.value);
    // Whoever decided, the careful ones say the same.
    ASSERT_EQ(careful_orientation(a, b, c).value, sign.value);
  }
  for (const std::size_t count : decided) EXPECT_GT(count, 1000U);
}

TEST(Precision, OrderInASegmentIsComparedAndTheLineIsDecided) {
  const Answer beyond = in_segment(kTenths.a, kTenths.b, {0.8, 0.8});
  EXPECT_FALSE(beyond.value);
  EXPECT_EQ(beyond.by, DecidedBy::double_filter) << "comparisons are exact by themselves";
  EXPECT_EQ(in_segment(kTenths.a, kTenths.b, kTenths.a).by, DecidedBy::double_filter) << "so are its ends";
  const Answer far = in_segment({0, 0}, {4, 0}, {2, 1});
  EXPECT_FALSE(far.value);
  EXPECT_EQ(far.by, DecidedBy::double_filter);
  const Answer whole = in_segment(kWhole.a, kWhole.b, kWhole.c);
  EXPECT_TRUE(whole.value);
  EXPECT_EQ(whole.by, DecidedBy::interval);
  const Answer tenths = in_segment(kTenths.a, kTenths.b, kTenths.c);
  EXPECT_TRUE(tenths.value);
  EXPECT_EQ(tenths.by, DecidedBy::exact);
  const Answer beside = in_segment(kTenths.a, kTenths.b, {0.3, up(0.3)});
  EXPECT_FALSE(beside.value);
  EXPECT_NE(beside.by, DecidedBy::double_filter);
}

TEST(Precision, SignsOfGaps) {
  const auto gap = [](Line profile) {  // the profile's y as height
    return height_gap({profile.a.x, 0, profile.a.y}, {profile.b.x, 0, profile.b.y},
                      {profile.c.x, 0, profile.c.y});
  };
  EXPECT_EQ(gap({{0, 0}, {4, 2}, {2, 5}}).by, DecidedBy::double_filter);
  EXPECT_EQ(gap(kWhole).by, DecidedBy::interval);
  EXPECT_EQ(gap(kWhole).sign, 0);
  const HeightGap ulp = gap({kWhole.a, kWhole.b, {2, up(1.0)}});
  EXPECT_EQ(ulp.by, DecidedBy::interval);
  EXPECT_EQ(ulp.sign, 1);
  EXPECT_EQ(ulp.metres, 0x1p-52) << "the exact gap";
  EXPECT_EQ(gap(kTenths).by, DecidedBy::exact);
  EXPECT_EQ(gap(kTenths).sign, 0);
}

/// A square of two triangles, the diagonal split on one side at `middle`.
struct Split {
  Mesh mesh;
  PlanDomain domain;
};
Split split_square(Vec2 low, Vec2 high, Vec3 middle) {
  Split s;
  s.mesh.positions = {
      {low.x, low.y, low.x}, {high.x, low.y, 0}, {high.x, high.y, high.x}, {low.x, high.y, 0}, middle};
  s.mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {0, 2, 3}};
  s.domain.add_rectangle(low, high);
  return s;
}

TEST(Precision, ConformityOfASoundMeshNeedsDoubleAlone) {
  Terrain terrain;
  terrain.columns = terrain.rows = 17;
  terrain.spacing_m = 0.1;
  Random random(2);
  for (int k = 0; k < 17 * 17; ++k) terrain.heights_m.push_back(random.between(0, 9));
  const Mesh mesh = reference_mesh(terrain);
  PlanDomain domain = full_domain(terrain);
  const PrecisionTally tally = beyond_double([&] { EXPECT_TRUE(check_conformity(mesh, domain).clean()); });
  EXPECT_EQ(tally.exact_signs + tally.exact_figures, 0U);
}

TEST(Precision, ConformitysTVertexIsToldByTheOneThatIsNeeded) {
  // Whole numbers: intervals tell that the vertex is on the edge in plan, and that it is at its height.
  const Split whole = split_square({0, 0}, {4, 4}, {2, 2, 2});
  PrecisionTally tally = beyond_double([&] {
    const ConformityReport report = check_conformity(whole.mesh, whole.domain);
    EXPECT_EQ(report.counts.t_junction, 1U);
    EXPECT_EQ(report.counts.crack, 0U);
  });
  EXPECT_GT(tally.interval_signs, 0U);
  EXPECT_EQ(tally.exact_signs, 0U);
  // Tenths: only exact arithmetic can.
  const Split tenths = split_square({0.1, 0.1}, {0.7, 0.7}, {0.3, 0.3, 0.3});
  tally = beyond_double([&] {
    const ConformityReport report = check_conformity(tenths.mesh, tenths.domain);
    EXPECT_EQ(report.counts.t_junction, 1U);
    EXPECT_EQ(report.counts.crack, 0U);
  });
  EXPECT_GT(tally.exact_signs, 0U);
  // An ulp off the edge in height: a crack, its gap computed in rationals.
  const Split ulp = split_square({0.1, 0.1}, {0.7, 0.7}, {0.3, 0.3, up(0.3)});
  tally = beyond_double([&] {
    const ConformityReport report = check_conformity(ulp.mesh, ulp.domain);
    EXPECT_EQ(report.counts.crack, 1U);
    EXPECT_EQ(report.largest_gap_m, up(0.3) - 0.3);
  });
  EXPECT_EQ(tally.exact_figures, 1U);
  // An ulp off the edge in plan: no T-vertex but a sliver of a hole or an overlap.
  const Split aside = split_square({0.1, 0.1}, {0.7, 0.7}, {0.3, up(0.3), 0.3});
  tally = beyond_double([&] {
    const ConformityReport report = check_conformity(aside.mesh, aside.domain);
    EXPECT_EQ(report.counts.t_junction + report.counts.crack, 0U);
    EXPECT_EQ(report.counts.hole + report.counts.overlap, 1U);
  });
  EXPECT_GT(tally.interval_signs + tally.exact_signs, 0U);
}

TEST(Precision, AConformityTriangleOfNoAreaIsToldExactly) {
  const auto triangle = [](Line l) {
    return Mesh{{{l.a.x, l.a.y, 0}, {l.b.x, l.b.y, 0}, {l.c.x, l.c.y, 0}}, {{0, 1, 2}}};
  };
  ConformityReport report;
  PrecisionTally tally = beyond_double([&] { report = check_conformity(triangle(kTenths), {}); });
  EXPECT_EQ(report.counts.degenerate, 1U);
  EXPECT_EQ(report.exact_orientations, 1U);
  EXPECT_GT(tally.exact_signs, 0U);
  tally = beyond_double([&] { report = check_conformity(triangle({kWhole.a, kWhole.b, {2, up(1.0)}}), {}); });
  EXPECT_EQ(report.counts.degenerate, 0U);
  EXPECT_EQ(report.exact_orientations, 1U);
  EXPECT_GT(tally.interval_signs, 0U);
}

Terrain flat(int side, double spacing_m) {
  Terrain terrain;
  terrain.columns = terrain.rows = side;
  terrain.spacing_m = spacing_m;
  terrain.heights_m.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0);
  return terrain;
}

TEST(Precision, VerticalErrorSkipsByExactSignsAndCutsFarTrianglesInRationals) {
  const Terrain terrain = flat(9, 0.125);
  const auto judged = [&](std::array<Vec2, 3> c) {
    return vertical_error({{{c[0].x, c[0].y, 1}, {c[1].x, c[1].y, 1}, {c[2].x, c[2].y, 1}}, {{0, 1, 2}}},
                          terrain);
  };
  PrecisionTally tally = beyond_double([&] { EXPECT_GT(judged({{{0, 0}, {1, 0}, {0, 1}}}).area_m2, 0); });
  EXPECT_EQ(tally, kDoubleAlone);
  tally = beyond_double([&] {
    EXPECT_EQ(judged({kTenths.a, kTenths.b, kTenths.c}).area_m2, 0) << "no triangle";
  });
  EXPECT_EQ(tally.exact_signs, 1U);
  tally = beyond_double([&] {
    EXPECT_EQ(judged({kTenths.a, kTenths.b, {0.3, up(0.3)}}).max, 1) << "an ulp makes it one";
  });
  EXPECT_GE(tally.interval_signs + tally.exact_signs, 1U)
      << "and tells the samples beside it from those inside";
  constexpr double far = 0x1p40;
  tally = beyond_double([&] {
    const VerticalError error = judged({{{-far, -far}, {far, -far}, {0, far}}});
    EXPECT_EQ(error.max, 1);
    EXPECT_EQ(error.area_m2, 1);
  });
  EXPECT_EQ(tally.exact_figures, 1U) << "one triangle was cut";
}

TEST(Precision, SoundnessAndIntersectionsOfTrianglesOfNoArea) {
  const auto triangle = [](double third) {
    return Mesh{{{0.1, 0.1, 0.1}, {0.7, 0.7, 0.7}, {0.3, 0.3, third}}, {{0, 1, 2}}};
  };
  PrecisionTally tally =
      beyond_double([&] { EXPECT_EQ(check_soundness(triangle(0.3)).counts.degenerate, 1U); });
  EXPECT_EQ(tally.exact_signs, 3U) << "one for each coordinate plane";
  tally = beyond_double([&] { EXPECT_TRUE(check_soundness(triangle(up(0.3))).clean()); });
  EXPECT_GE(tally.exact_signs, 1U);
  tally = beyond_double([&] { EXPECT_TRUE(check_soundness(triangle(5)).clean()); });
  EXPECT_LE(tally.exact_signs, 1U) << "the plane of x and y, in which it is still a line";
  // CGAL's own predicates decide here; their filters cannot be asked. A needle's tip that is an ulp below,
  // on, or an ulp above a sheet: the verdict turns at the ulp.
  const auto needle = [](double tip) {
    return Mesh{
        {{0.1, 0.1, 0.3}, {0.7, 0.1, 0.3}, {0.1, 0.7, 0.3}, {0.2, 0.2, tip}, {0.25, 0.2, 9}, {0.2, 0.25, 9}},
        {{0, 1, 2}, {3, 4, 5}}};
  };
  EXPECT_EQ(self_intersections(needle(up(0.3)))->size(), 0U);
  EXPECT_EQ(self_intersections(needle(0.3))->size(), 1U);
  EXPECT_EQ(self_intersections(needle(std::nextafter(0.3, 0.0)))->size(), 1U);
}

TEST(Precision, SlackAsksWhetherTheOutlineRunsStraight) {
  // A square whose south side bends by an ulp, or not at all: the vertex between is only removable where the
  // side is straight. 0.1 + 0.6 · x is on no line of doubles, so the sides run along x = y.
  const auto slack = [](double y) {
    const Mesh mesh{{{0.1, 0.1, 0}, {0.7, 0.7, 0}, {0.1, 0.7, 0}, {0.3, y, 0}}, {{0, 3, 2}, {3, 1, 2}}};
    const RayDevice device;
    const RaySurface surface(device, mesh);
    const Camera camera = make_camera({0.3, 0.4, 2}, {0.3, 0.4, 0}, 60, 16, 16);
    std::vector<std::uint8_t> removable;
    static_cast<void>(measure_slack(camera, surface, surface.look(camera), surface, 1, &removable));
    return removable[3];
  };
  PrecisionTally tally = beyond_double([&] { EXPECT_EQ(slack(0.3), 1); });
  EXPECT_GT(tally.exact_signs, 0U);
  tally = beyond_double([&] { EXPECT_EQ(slack(std::nextafter(0.3, 0.0)), 0); });
  EXPECT_GT(tally.interval_signs + tally.exact_signs, 0U);
}

}  // namespace
}  // namespace plumbline::oracle
