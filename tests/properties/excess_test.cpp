// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "properties/verdict/economy.h"

namespace plumbline::verdict {
namespace {

RunVerdict run_of(const std::string& method, std::size_t triangles, double p99_px) {
  RunVerdict run;
  run.terrain = "t";
  run.trajectory = "f";
  run.method = method;
  FrameVerdict frame;
  frame.triangles = triangles;
  frame.image.displacement_px.count = 100;
  frame.image.displacement_px.p99 = p99_px;
  run.frames.push_back(frame);
  run.summary = summarize(run.frames);
  return run;
}

TEST(Excess, IsTakenAtTheSameMeasuredError) {
  SuiteVerdict suite;
  suite.runs = {run_of("yard", 4000, 0.5), run_of("yard", 1000, 2),  run_of("other", 3000, 1),
                run_of("other", 3000, 2),  run_of("other", 3000, 4), run_of("other", 3000, 0.1)};
  add_excess(suite, "yard");
  EXPECT_EQ(suite.yardstick, "yard");
  EXPECT_EQ(suite.runs[2].frames[0].economy.needed, 2000);  // 1/p99: half way in 4000·½ = 1000·2
  EXPECT_EQ(figure_value(suite.runs[2].summary, "economy.excess"), 1.5);
  EXPECT_EQ(figure_value(suite.runs[3].summary, "economy.excess"), 3);             // on a point of the curve
  EXPECT_TRUE(std::isnan(figure_value(suite.runs[4].summary, "economy.excess")));  // beyond its ends
  EXPECT_TRUE(std::isnan(figure_value(suite.runs[5].summary, "economy.excess")));
  EXPECT_TRUE(std::isnan(figure_value(suite.runs[0].summary, "economy.excess")));  // the yardstick itself
}

TEST(Excess, OtherFlightsAndFramesSayNothing) {
  SuiteVerdict suite;
  suite.runs = {run_of("yard", 4000, 0.5), run_of("yard", 1000, 2), run_of("other", 3000, 1)};
  suite.runs[2].trajectory = "g";
  add_excess(suite, "yard");
  EXPECT_TRUE(std::isnan(figure_value(suite.runs[2].summary, "economy.excess")));
  suite.runs[2].trajectory = "f";
  suite.runs[2].frames[0].index = 1;
  add_excess(suite, "yard");
  EXPECT_TRUE(std::isnan(figure_value(suite.runs[2].summary, "economy.excess")));
}

TEST(Excess, WithoutAYardstickNothingIsSaid) {
  SuiteVerdict suite;
  suite.runs = {run_of("other", 3000, 1)};
  add_excess(suite, "yard");
  EXPECT_TRUE(suite.yardstick.empty());
  EXPECT_TRUE(std::isnan(figure_value(suite.runs[0].summary, "economy.excess")));
}

TEST(Excess, AGateOnItFailsWhereNothingIsKnown) {
  SuiteVerdict suite;
  suite.runs = {run_of("other", 3000, 1)};
  add_excess(suite, "yard");
  const double value = figure_value(suite.runs[0].summary, "economy.excess");
  EXPECT_FALSE(value <= 1e9);
}

}  // namespace
}  // namespace plumbline::verdict
