// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/verdict/verdict.h"

#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/error.h"

namespace plumbline::verdict {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FrameVerdict judged_frame(int index, double p99_px, std::size_t pixels) {
  FrameVerdict frame;
  frame.index = index;
  frame.triangles = 100;
  frame.vertices = 60;
  frame.image.displacement_px = {p99_px * 3, p99_px * 2, p99_px, 1, 1, pixels};
  frame.vertical_m.area_m2 = 1;
  return frame;
}

TEST(Summarize, NoFrameGivesNoFigure) {
  const RunSummary summary = summarize({});
  EXPECT_EQ(summary.frames, 0u);
  EXPECT_EQ(summary.image.displacement_px.count, 0u);
  EXPECT_EQ(summary.triangles, 0);
}

TEST(Summarize, CountsAreSummed) {
  FrameVerdict a = judged_frame(0, 1, 10), b = judged_frame(1, 1, 10);
  a.conformity.crack = 2;
  b.conformity.crack = 5;
  b.conformity.unused_vertex = 1;
  a.visible_cracks = 1;
  a.image.uncovered_px = 7;
  b.image.silhouette_pixels = 4;
  b.counters.split = 9;
  b.shape.slivers = 3;
  const RunSummary summary = summarize({a, b});
  EXPECT_EQ(summary.conformity.crack, 7u);
  EXPECT_EQ(summary.conformity.unused_vertex, 1u);
  EXPECT_EQ(summary.visible_cracks, 1u);
  EXPECT_EQ(summary.image.uncovered_px, 7u);
  EXPECT_EQ(summary.image.silhouette_pixels, 4u);
  EXPECT_EQ(summary.counters.split, 9u);
  EXPECT_EQ(summary.shape.slivers, 3u);
  EXPECT_EQ(summary.image.displacement_px.count, 20u);
}

TEST(Summarize, ExtremesAreTheWorstFrames) {
  FrameVerdict a = judged_frame(4, 1, 10), b = judged_frame(5, 3, 10), c = judged_frame(6, 3, 10);
  a.vertical_m.max = 8;
  a.vertical_m.at = {1, 2};
  b.largest_gap_px = 0.5;
  c.triangles = 700;
  a.shape.min_quality = 0.4;
  b.shape.min_quality = 0.2;
  c.shape.min_quality = 0.3;
  const RunSummary summary = summarize({a, b, c});
  EXPECT_EQ(summary.image.displacement_px.p99, 3);
  EXPECT_EQ(summary.image.displacement_px.max, 9);
  EXPECT_EQ(summary.worst_frame, 5) << "the first among equals";
  EXPECT_EQ(summary.vertical_m.max, 8);
  EXPECT_EQ(summary.vertical_m.at, (Vec2{1, 2}));
  EXPECT_EQ(summary.largest_gap_px, 0.5);
  EXPECT_EQ(summary.triangles, 300);
  EXPECT_EQ(summary.triangles_min, 100u);
  EXPECT_EQ(summary.triangles_max, 700u);
  EXPECT_EQ(summary.shape.min_quality, 0.2);
}

TEST(Summarize, MeansAreWeightedByWhatWasJudged) {
  FrameVerdict a = judged_frame(0, 1, 30), b = judged_frame(1, 1, 10);
  a.image.displacement_px.mean = 1;
  b.image.displacement_px.mean = 5;
  a.image.displacement_px.rms = 2;
  b.image.displacement_px.rms = 6;
  a.image.over_threshold = 0;
  b.image.over_threshold = 0.5;
  a.vertical_m.area_m2 = 1;
  b.vertical_m.area_m2 = 3;
  a.vertical_m.rms = 1;
  b.vertical_m.rms = 3;
  const RunSummary summary = summarize({a, b});
  EXPECT_EQ(summary.image.displacement_px.mean, 2);             // (30·1 + 10·5) / 40
  EXPECT_EQ(summary.image.displacement_px.rms, std::sqrt(12));  // (30·4 + 10·36) / 40
  EXPECT_EQ(summary.image.over_threshold, 0.125);
  EXPECT_EQ(summary.vertical_m.rms, std::sqrt(7));  // (1·1 + 3·9) / 4
}

TEST(Summarize, FrameThatJudgedNothingHasNoWeight) {
  FrameVerdict sky = judged_frame(0, 0, 0);
  sky.triangles = 0;
  sky.vertical_m = {};
  FrameVerdict ground = judged_frame(1, 2, 10);
  ground.shape.min_quality = 0.5;
  const RunSummary summary = summarize({sky, ground});
  EXPECT_EQ(summary.image.displacement_px.mean, 1);
  EXPECT_EQ(summary.worst_frame, 1);
  EXPECT_EQ(summary.shape.min_quality, 0.5);
}

TEST(Summarize, NotANumberIsNotLost) {
  FrameVerdict a = judged_frame(0, 1, 10), b = judged_frame(1, kNan, 10), c = judged_frame(2, 2, 10);
  const RunSummary summary = summarize({a, b, c});
  EXPECT_TRUE(std::isnan(summary.image.displacement_px.p99));
  EXPECT_EQ(summary.worst_frame, 1);
}

TEST(Figure, EveryPathIsFoundOnce) {
  std::set<std::string_view> paths;
  for (const Figure& figure : figures()) EXPECT_TRUE(paths.insert(figure.path).second) << figure.path;
  EXPECT_THAT(paths, testing::IsSupersetOf<std::string_view>({"crack",
                                                              "t_junction",
                                                              "fold_over",
                                                              "degenerate",
                                                              "hole",
                                                              "overlap",
                                                              "outline",
                                                              "non_manifold",
                                                              "duplicate",
                                                              "non_finite",
                                                              "bad_index",
                                                              "unused_vertex",
                                                              "visible_cracks",
                                                              "largest_gap_m",
                                                              "largest_gap_px",
                                                              "vertical_m.max",
                                                              "vertical_m.certain_max",
                                                              "vertical_m.rms",
                                                              "vertical_m.mean",
                                                              "displacement_px.max",
                                                              "displacement_px.p999",
                                                              "displacement_px.p99",
                                                              "displacement_px.rms",
                                                              "displacement_px.mean",
                                                              "displacement_px.over_threshold",
                                                              "displacement_px.uncovered_px",
                                                              "depth_rel.max",
                                                              "depth_rel.p99",
                                                              "silhouette_px.pixels",
                                                              "silhouette_px.max",
                                                              "pop_px.max",
                                                              "pop_px.p99",
                                                              "shape.slivers",
                                                              "shape.min_quality",
                                                              "triangles",
                                                              "triangles_max"}));
}

TEST(Figure, ValuesAreTheSummarys) {
  RunSummary summary;
  summary.conformity.overlap = 3;
  summary.vertical_m.certain_max = 0.25;
  summary.image.displacement_px.p99 = 1.5;
  summary.image.silhouette_max_px = 9;
  summary.pop_px.max = 4;
  EXPECT_EQ(figure_value(summary, "overlap"), 3);
  EXPECT_EQ(figure_value(summary, "vertical_m.certain_max"), 0.25);
  EXPECT_EQ(figure_value(summary, "displacement_px.p99"), 1.5);
  EXPECT_EQ(figure_value(summary, "silhouette_px.max"), 9);
  EXPECT_EQ(figure_value(summary, "pop_px.max"), 4);
  EXPECT_EQ(figure_value(summary, "crack"), 0);
}

TEST(Figure, UnknownPathIsRefusedInOneLine) {
  try {
    figure_value({}, "displacement_px.p98");
    FAIL() << "an unknown figure was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("displacement_px.p98"));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

TEST(Pass, NeedsRunsAndEveryGateAndNothingVacuous) {
  SuiteVerdict good;
  good.runs.emplace_back();
  good.gates = {{"crack == 0", "r", "== 0", 0, true}};
  EXPECT_TRUE(good.pass());

  SuiteVerdict failed_gate = good;
  failed_gate.gates.push_back({"hole == 0", "r", "== 0", 1, false});
  EXPECT_FALSE(failed_gate.pass());
  SuiteVerdict vacuous = good;
  vacuous.vacuous.emplace_back("r: no pixel to measure");
  EXPECT_FALSE(vacuous.pass());
  SuiteVerdict interrupted = good;
  interrupted.interrupted = true;
  EXPECT_FALSE(interrupted.pass());
  EXPECT_FALSE(SuiteVerdict{}.pass()) << "no run, no pass";
}

}  // namespace
}  // namespace plumbline::verdict
