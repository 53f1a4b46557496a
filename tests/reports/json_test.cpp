// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/json_text.h"
#include "reports/quantile.h"
#include "reports/report.h"
#include "tests/reports/sample_verdict.h"

namespace plumbline::reports {
namespace {

using Names = std::vector<std::string>;

/// The smallest suite that has everything: a crack, a null figure, a failed gate, something vacuous.
verdict::SuiteVerdict small_verdict() {
  verdict::SuiteVerdict out;
  out.suite = "small";
  out.width_px = 64;
  out.height_px = 48;
  out.fov_y_deg = 60;
  out.terrains.push_back({"spike", 5, 5, 10, 0, 12.5, 0.1});
  verdict::RunVerdict run;
  run.id = "spike.hover.block_bintree.1";
  run.terrain = "spike";
  run.trajectory = "hover";
  run.method = "block_bintree";
  run.threshold_px = 1;
  verdict::FrameVerdict frame;
  frame.camera.position = {20, -40, 1.0 / 3};
  frame.camera.width_px = 64;
  frame.camera.height_px = 48;
  frame.triangles = 8;
  frame.vertices = 9;
  frame.conformity.crack = 1;
  frame.conformity.t_junction = 1;
  frame.visible_cracks = 1;
  frame.largest_gap_m = 1e-300;
  frame.largest_gap_px = 0.1;
  frame.vertical_m = {2.5, 2, 1e22, 0.5, {10, -0.0}, {10, 0}, 1600};
  frame.image.displacement_px = {3, 2, 1.5, std::numeric_limits<double>::infinity(), 0.5, 3072};
  frame.image.over_threshold = 0.25;
  frame.findings.push_back(sample::t_vertex({10, 20, 3}, -1e-300, 0.1, oracle::Visibility::visible));
  run.frames.push_back(frame);
  run.summary = verdict::summarize(run.frames);
  out.runs.push_back(run);
  out.gates.push_back({"crack == 0", run.id, "== 0", 1, false});
  out.vacuous.emplace_back("spike.hover.block_bintree.1: one level of detail");
  return out;
}

Names keys(const Json& object) {
  Names out;
  for (auto member = object.begin(); member != object.end(); ++member) out.push_back(member.key());
  return out;
}

/// Whether all of `wanted` occur among the keys, in this order.
void expect_in_order(const Json& object, const Names& wanted) {
  const Names have = keys(object);
  auto from = have.begin();
  for (const std::string& name : wanted) {
    const auto found = std::find(from, have.end(), name);
    ASSERT_NE(found, have.end()) << name << " is missing or out of order in " << object.dump();
    from = found + 1;
  }
}

TEST(NumberText, ReadsBackBitForBit) {
  std::uint64_t state = 1;
  int tried = 0;
  for (int i = 0; i < 20000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double value = std::bit_cast<double>(state);
    if (!std::isfinite(value) || value == 0) continue;
    ++tried;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(std::strtod(number_text(value).c_str(), nullptr)), state);
  }
  EXPECT_GT(tried, 19000);
}

TEST(NumberText, SpecialValues) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(2), "2");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(number_text(std::numeric_limits<double>::denorm_min()), "5e-324");
}

TEST(ValidUtf8, BrokenBytesAreReplaced) {
  EXPECT_EQ(valid_utf8("a\xff"
                       "b"),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(valid_utf8("Zürich"), "Zürich");
}

TEST(ResultsJson, NamesOfTheContract) {
  const Json results = Json::parse(results_json(small_verdict()));
  EXPECT_EQ(results["schema"], "plumbline.results/1");
  expect_in_order(results, {"schema", "suite", "runs", "gates"});
  const Json& run = results["runs"][0];
  expect_in_order(run, {"id", "terrain", "trajectory", "method", "threshold_px", "frames", "summary"});
  const Json& frame = run["frames"][0];
  expect_in_order(frame, {"index", "camera", "triangles", "vertices", "conformity", "vertical_m",
                          "displacement_px", "silhouette_px", "pop_px", "shape", "counters"});
  expect_in_order(frame["camera"], {"position", "forward", "up", "fov_y_deg", "viewport"});
  for (const Json& figures : {frame, run["summary"]}) {
    expect_in_order(figures, {"triangles", "vertices", "conformity", "vertical_m", "displacement_px",
                              "silhouette_px", "pop_px", "shape", "counters"});
    expect_in_order(figures["conformity"], {"crack", "t_junction", "fold_over", "degenerate", "hole",
                                            "overlap", "outline", "non_manifold", "duplicate", "non_finite"});
    expect_in_order(figures["vertical_m"], {"max", "certain_max", "rms", "mean", "at"});
    expect_in_order(figures["displacement_px"],
                    {"max", "p999", "p99", "rms", "mean", "over_threshold", "uncovered_px"});
    expect_in_order(figures["silhouette_px"], {"pixels", "max"});
    expect_in_order(figures["pop_px"], {"max", "p99"});
    expect_in_order(figures["shape"], {"slivers", "min_quality"});
    expect_in_order(figures["counters"], {"visited", "evaluated", "split", "merged", "entered", "left"});
  }
  expect_in_order(results["gates"][0], {"name", "run", "limit", "value", "pass"});
}

TEST(ResultsJson, EveryFigureThatAGateCanNameStandsUnderItsPath) {
  const Json summary = Json::parse(results_json(small_verdict()))["runs"][0]["summary"];
  for (const verdict::Figure& figure : verdict::figures()) {
    const std::string path(figure.path);
    const std::size_t dot = path.find('.');
    if (dot != std::string::npos) {
      ASSERT_TRUE(summary.contains(path.substr(0, dot))) << path;
      EXPECT_TRUE(summary[path.substr(0, dot)].contains(path.substr(dot + 1))) << path;
    } else {
      EXPECT_TRUE(summary.contains(path) || summary["conformity"].contains(path)) << path;
    }
  }
}

TEST(ResultsJson, NumbersReadBackBitForBit) {
  const verdict::SuiteVerdict verdict = sample::suite_verdict({{"canyon"}, {"orbit"}, 7});
  const Json results = Json::parse(results_json(verdict));
  ASSERT_EQ(results["runs"].size(), verdict.runs.size());
  const auto same = [](const Json& text, double value) {
    return std::bit_cast<std::uint64_t>(text.get<double>()) == std::bit_cast<std::uint64_t>(value);
  };
  std::size_t compared = 0;
  for (std::size_t r = 0; r < verdict.runs.size(); ++r)
    for (std::size_t f = 0; f < verdict.runs[r].frames.size(); ++f) {
      const verdict::FrameVerdict& frame = verdict.runs[r].frames[f];
      const Json& read = results["runs"][r]["frames"][f];
      EXPECT_TRUE(same(read["displacement_px"]["p99"], frame.image.displacement_px.p99));
      EXPECT_TRUE(same(read["vertical_m"]["rms"], frame.vertical_m.rms));
      EXPECT_TRUE(same(read["camera"]["position"][2], frame.camera.position.z));
      EXPECT_EQ(read["triangles"].get<std::size_t>(), frame.triangles);
      EXPECT_EQ(read["findings"].size(), frame.findings.size());
      ++compared;
    }
  EXPECT_EQ(compared, 7u * 7u);
}

TEST(ResultsJson, WhatWasNotJudgedIsNull) {
  const Json frame = Json::parse(results_json(small_verdict()))["runs"][0]["frames"][0];
  EXPECT_TRUE(frame["pop_px"]["max"].is_null());
  EXPECT_TRUE(frame["depth_rel"]["p99"].is_null());
  EXPECT_TRUE(frame["displacement_px"]["rms"].is_null()) << "infinity is no JSON number";
  EXPECT_EQ(frame["displacement_px"]["p99"], 1.5);
}

TEST(ResultsJson, LongWitnessListsAreCutAndCounted) {
  verdict::SuiteVerdict verdict = small_verdict();
  oracle::Finding& finding = verdict.runs[0].frames[0].findings[0];
  finding.loop.assign(1000, Vec2{1, 2});
  const Json read = Json::parse(results_json(verdict))["runs"][0]["frames"][0]["findings"][0];
  EXPECT_LT(read["loop"].size(), 1000u);
  EXPECT_EQ(read["loop_count"], 1000);
}

TEST(ResultsJson, OneFrameALine) {
  const std::string text = results_json(sample::suite_verdict({{"canyon"}, {"orbit"}, 7}));
  std::istringstream lines(text);
  std::size_t frames = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find("{\"index\":");
    if (first == std::string::npos) continue;
    ++frames;
    EXPECT_EQ(line.find("{\"index\":", first + 1), std::string::npos);
  }
  EXPECT_EQ(frames, 7u * 7u);
}

/// Regenerate by running this test with PLUMBLINE_WRITE_GOLDEN=1; review the difference.
TEST(ResultsJson, GoldenText) {
  const std::string path = PLUMBLINE_SOURCE_DIR "/tests/reports/golden/small.results.json";
  const std::string text = results_json(small_verdict());
  if (std::getenv("PLUMBLINE_WRITE_GOLDEN") != nullptr) std::ofstream(path, std::ios::binary) << text;
  std::ifstream file(path, std::ios::binary);
  ASSERT_TRUE(file) << path;
  const std::string golden{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, golden);
}

TEST(TimingJson, MedianAndPercentilePerRun) {
  verdict::SuiteTiming timing{"a machine", "gcc 12", "Release", 2, 3.5, {}};
  timing.runs.push_back({"run", 0.5, {4, 1, 3, 2}, 0.25});
  const Json read = Json::parse(timing_json(timing));
  EXPECT_EQ(read["schema"], "plumbline.timing/1");
  EXPECT_EQ(read["jobs"], 2);
  const Json& update = read["runs"][0]["update_ms"];
  EXPECT_EQ(update["median"], 2);
  EXPECT_EQ(update["p95"], 4);
  EXPECT_EQ(update["frames"], Json::array({4, 1, 3, 2}));
  EXPECT_EQ(read["runs"][0]["prepare_s"], 0.5);
}

TEST(Quantile, NearestRank) {
  EXPECT_EQ(quantile({}, 0.5), 0);
  EXPECT_EQ(quantile({7}, 0.95), 7);
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({1, 2, 3, 4}, 0), 1);
  EXPECT_EQ(quantile({1, 2, 3, 4}, 1), 4);
}

}  // namespace
}  // namespace plumbline::reports
