// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "properties/harness/gates.h"
#include "properties/harness/mesh_dump.h"
#include "properties/harness/run_suite.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

/// Small, rugged, seen from four frames of a slow flight and one jump.
Suite small_suite() {
  Suite suite;
  suite.name = "harness";
  suite.width_px = 96;
  suite.height_px = 64;
  TerrainSource hills;
  hills.id = "hills";
  hills.generator = "fbm";
  hills.size = 33;
  hills.seed = 7;
  suite.terrains = {hills};
  TrajectorySpec orbit;
  orbit.id = "orbit";
  orbit.kind = "orbit";
  orbit.frames = 4;
  TrajectorySpec spin;
  spin.id = "spin";
  spin.kind = "spin";
  spin.frames = 3;
  suite.trajectories = {orbit, spin};
  suite.methods = {{"full", {1}, {}}, {"restricted_quadtree", {2, 16}, {}}, {"block_bintree", {2, 16}, {}}};
  return suite;
}

verdict::RunVerdict run_with(const std::string& method, double threshold_px, std::size_t cracks) {
  verdict::RunVerdict run;
  run.id = "t.f." + method;
  run.method = method;
  run.threshold_px = threshold_px;
  run.summary.frames = 1;
  run.summary.conformity.crack = cracks;
  run.summary.image.displacement_px.p99 = 3;
  run.summary.image.displacement_px.count = 100;
  return run;
}

TEST(RunSuite, RunsStandInTheSuitesOrderWithEveryFrameJudged) {
  const SuiteOutcome outcome = run_suite(small_suite(), {});
  ASSERT_EQ(outcome.verdict.runs.size(), 10u);  // 2 trajectories × (1 + 2 + 2) thresholds
  EXPECT_EQ(outcome.verdict.runs[0].id, "hills.orbit.full.1");
  EXPECT_EQ(outcome.verdict.runs[9].id, "hills.spin.block_bintree.16");
  for (std::size_t r = 0; r < outcome.verdict.runs.size(); ++r) {
    const verdict::RunVerdict& run = outcome.verdict.runs[r];
    EXPECT_EQ(run.frames.size(), run.trajectory == "orbit" ? 4u : 3u) << run.id;
    EXPECT_GT(run.summary.image.displacement_px.count, 0u) << run.id;
    EXPECT_EQ(outcome.timing.runs[r].run, run.id);
    EXPECT_EQ(outcome.timing.runs[r].update_ms.size(), run.frames.size());
  }
  EXPECT_THAT(outcome.verdict.vacuous, testing::IsEmpty());
}

TEST(RunSuite, FullGridIsTheReferenceSoItHasNoErrorAtAll) {
  const SuiteOutcome outcome = run_suite(small_suite(), {});
  const verdict::RunSummary& full = outcome.verdict.runs[0].summary;
  EXPECT_EQ(full.conformity.total(), 0u);
  EXPECT_EQ(full.vertical_m.max, 0);
  EXPECT_EQ(full.image.displacement_px.max, 0);
  EXPECT_EQ(full.image.silhouette_pixels, 0u);
  EXPECT_EQ(full.pop_px.max, 0);
  EXPECT_GT(full.pop_px.count, 0u);
}

TEST(RunSuite, VerticesThatEnterAndLeaveAccountForTheirNumber) {
  const SuiteOutcome outcome = run_suite(small_suite(), {});
  std::uint64_t moved = 0;
  for (const verdict::RunVerdict& run : outcome.verdict.runs) {
    std::uint64_t vertices = 0;
    for (const verdict::FrameVerdict& frame : run.frames) {
      vertices += frame.counters.entered;
      vertices -= frame.counters.left;
      EXPECT_EQ(vertices, frame.vertices) << run.id << " frame " << frame.index;
      moved += frame.counters.left;
    }
  }
  EXPECT_GT(moved, 0u) << "no vertex ever left: nothing was judged";
}

TEST(RunSuite, VerdictDoesNotDependOnJobs) {
  RunOptions one;
  one.jobs = 1;
  RunOptions four;
  four.jobs = 4;
  const SuiteOutcome a = run_suite(small_suite(), one);
  const SuiteOutcome b = run_suite(small_suite(), four);
  ASSERT_EQ(a.verdict.runs.size(), b.verdict.runs.size());
  for (std::size_t r = 0; r < a.verdict.runs.size(); ++r) {
    const verdict::RunSummary& x = a.verdict.runs[r].summary;
    const verdict::RunSummary& y = b.verdict.runs[r].summary;
    EXPECT_EQ(x.triangles, y.triangles);
    EXPECT_EQ(x.image.displacement_px.rms, y.image.displacement_px.rms);
    EXPECT_EQ(x.vertical_m.rms, y.vertical_m.rms);
    EXPECT_EQ(x.pop_px.mean, y.pop_px.mean);
  }
}

TEST(RunSuite, DrawsTheWorstFrameOfEachMethod) {
  const SuiteOutcome outcome = run_suite(small_suite(), {});
  ASSERT_EQ(outcome.pictures.size(), 3u);
  EXPECT_EQ(outcome.pictures[1].threshold_px, 16);
  EXPECT_EQ(outcome.pictures[1].shaded.width, 96);
  EXPECT_EQ(outcome.pictures[1].displacement_px.height, 64);
}

TEST(RunSuite, KeepsOnlyTheMethodsAskedFor) {
  RunOptions options;
  options.methods = {"full"};
  EXPECT_EQ(run_suite(small_suite(), options).verdict.runs.size(), 2u);
  options.methods = {"block_bintree:tri_cull"};
  EXPECT_THROW(run_suite(small_suite(), options), InputError);
}

TEST(RunSuite, CancelledRunKeepsWholeFlightsOnly) {
  const std::atomic<bool> cancelled{true};
  RunOptions options;
  options.cancelled = &cancelled;
  const SuiteOutcome outcome = run_suite(small_suite(), options);
  EXPECT_TRUE(outcome.verdict.interrupted);
  EXPECT_TRUE(outcome.verdict.runs.empty());
  EXPECT_FALSE(outcome.verdict.pass());
}

TEST(Gates, MethodsOwnGateReplacesTheGeneralOne) {
  const std::vector<GateSpec> gates{{"crack", "", "==", 0, false, "crack == 0"},
                                    {"crack", "block_bintree", "<=", 5, false, "crack <= 5"}};
  const auto judged = judge_gates(gates, {run_with("full", 1, 1), run_with("block_bintree", 1, 5)});
  ASSERT_EQ(judged.size(), 2u);
  EXPECT_FALSE(judged[0].pass);
  EXPECT_TRUE(judged[1].pass);
  EXPECT_EQ(judged[1].value, 5);
}

TEST(Gates, LimitInTauScalesWithTheThreshold) {
  const std::vector<GateSpec> gates{
      {"displacement_px.p99", "", "<=", 1, true, "displacement_px.p99 <= 1 tau"}};
  const auto judged = judge_gates(gates, {run_with("full", 2, 0), run_with("full", 4, 0)});
  ASSERT_EQ(judged.size(), 2u);
  EXPECT_FALSE(judged[0].pass);  // 3 px against 2
  EXPECT_TRUE(judged[1].pass);   // 3 px against 4
}

TEST(Vacuous, OneLevelOfDetailAtEveryThresholdIsAFailure) {
  std::vector<verdict::RunVerdict> runs{run_with("restricted_quadtree", 1, 0),
                                        run_with("restricted_quadtree", 8, 0)};
  for (verdict::RunVerdict& run : runs) {
    run.summary.triangles_min = run.summary.triangles_max = 32;
    run.summary.image.displacement_px.count = 9;
    run.summary.vertical_m.area_m2 = 1;
  }
  EXPECT_THAT(find_vacuous(runs), testing::ElementsAre(testing::HasSubstr("one level of detail")));
  runs[1].summary.triangles_min = 30;
  EXPECT_THAT(find_vacuous(runs), testing::IsEmpty());
}

TEST(Gates, SuiteWithoutGatesIsHeldToACleanMesh) {
  const auto judged = judge_gates({}, {run_with("full", 1, 0), run_with("block_bintree", 1, 2)});
  ASSERT_EQ(judged.size(), 24u);
  EXPECT_TRUE(std::all_of(judged.begin(), judged.begin() + 12, [](const auto& gate) { return gate.pass; }));
  EXPECT_FALSE(judged[12].pass) << judged[12].name;
}

TEST(Gates, LimitOnWhatNothingWasMeasuredForDoesNotHold) {
  const std::vector<GateSpec> gates{
      {"displacement_px.p99", "", "<=", 1, true, "displacement_px.p99 <= 1 tau"}};
  verdict::RunVerdict run = run_with("full", 4, 0);
  run.summary.image.displacement_px.count = 0;
  run.summary.image.uncovered_px = 9;
  const auto judged = judge_gates(gates, {run});
  ASSERT_EQ(judged.size(), 1u);
  EXPECT_FALSE(judged[0].pass);
  EXPECT_TRUE(std::isnan(judged[0].value));
}

TEST(Gates, AFigureAboutCutsAsksTheFlightsThatHaveThem) {
  GateSpec gate;
  gate.figure = "stability.lag_frames";
  gate.comparison = "<=";
  gate.bound = 3;
  gate.text = "stability.lag_frames <= 3";
  verdict::RunVerdict calm = run_with("full", 1, 0);
  verdict::RunVerdict cut = run_with("full", 1, 0);
  cut.summary.stability.cuts = 1;
  cut.summary.stability.lag_frames = 5;
  const auto judged = judge_gates({gate}, {calm, cut});
  ASSERT_EQ(judged.size(), 1u);
  EXPECT_EQ(judged[0].value, 5);
  EXPECT_FALSE(judged[0].pass);

  const auto vacuous = judge_gates({gate}, {calm});
  ASSERT_EQ(vacuous.size(), 1u);
  EXPECT_TRUE(std::isnan(vacuous[0].value));
  EXPECT_FALSE(vacuous[0].pass) << "no flight was asked: that is no pass";
}

Expectation expect(const std::string& run, const std::string& figure, const std::string& comparison,
                   double bound) {
  return {run,
          {figure, "", comparison, bound, false, fmt::format("{} {} {}", figure, comparison, bound)},
          "steep"};
}

const std::vector<GateSpec> kNoCracks{{"crack", "", "==", 0, false, "crack == 0"}};

TEST(Expected, ReplacesTheGateWhileTheFigureIsAsExpected) {
  const auto judged = judge_gates(kNoCracks, {run_with("full", 1, 0), run_with("block_bintree", 1, 211)},
                                  {expect("t.f.block_bintree", "crack", "==", 211)});
  ASSERT_EQ(judged.size(), 2u);
  EXPECT_FALSE(judged[0].expected);
  EXPECT_TRUE(judged[1].expected);
  EXPECT_TRUE(judged[1].pass);
  EXPECT_EQ(judged[1].name, "expected: crack (steep)");
  EXPECT_EQ(judged[1].limit, "== 211");
  EXPECT_EQ(judged[1].note, "");
  EXPECT_FALSE(judged[1].needless);
}

TEST(Expected, AChangeInEitherDirectionFails) {
  const std::vector<Expectation> expected{expect("t.f.block_bintree", "crack", "==", 211)};
  const auto found = [&](std::size_t cracks) {
    const auto judged = judge_gates(kNoCracks, {run_with("block_bintree", 1, cracks)}, expected);
    EXPECT_EQ(judged.size(), 1u);
    EXPECT_FALSE(judged.at(0).pass);
    return judged.at(0);
  };
  EXPECT_EQ(found(198).note, "expected 211 crack (steep), found 198: better? update the expectation");
  EXPECT_EQ(found(230).note, "expected 211 crack (steep), found 230: worse");
  EXPECT_EQ(found(0).note,
            "expected 211 crack (steep), found 0: \"crack == 0\" holds now, remove the expectation");
  EXPECT_TRUE(found(0).needless);
}

TEST(Expected, WordsFollowTheDirectionOfTheFigure) {
  verdict::RunVerdict run = run_with("full", 2, 0);
  const auto note = [&](const Expectation& one) { return judge_gates(kNoCracks, {run}, {one}).at(1).note; };
  run.summary.triangles = 7;
  EXPECT_EQ(note(expect("t.*", "triangles", "==", 8)),
            "expected 8 triangles (steep), found 7: changed? update the expectation");
  run.summary.shape.min_quality = 0.25;
  EXPECT_EQ(note(expect("t.*", "shape.min_quality", "==", 0.5)),
            "expected shape.min_quality of 0.5 (steep), found 0.25: worse");
  Expectation within = expect("t.*", "displacement_px.p99", "<=", 1);
  within.limit.times_tau = true;
  EXPECT_EQ(note(within), "expected displacement_px.p99 of <= 1 tau (steep), found 3: worse");
}

TEST(Expected, MethodsOwnGateAndDefaultGatesAreReplacedToo) {
  std::vector<GateSpec> gates = kNoCracks;
  gates.push_back({"crack", "block_bintree", "<=", 5, false, "crack <= 5"});
  const std::vector<Expectation> expected{expect("*", "crack", "==", 9)};
  EXPECT_EQ(judge_gates(gates, {run_with("block_bintree", 1, 9)}, expected).size(), 1u);
  const auto bare = judge_gates({}, {run_with("full", 1, 9)}, expected);
  EXPECT_EQ(bare.size(), 12u) << "eleven of the default gates, and the expectation";
  EXPECT_TRUE(bare.back().expected && bare.back().pass);
}

TEST(Expected, EveryEntryIsJudgedForItself) {
  const auto judged = judge_gates(kNoCracks, {run_with("full", 1, 3)},
                                  {expect("t.*", "crack", "<=", 5), expect("t.f.full", "crack", "==", 4)});
  ASSERT_EQ(judged.size(), 2u);
  EXPECT_TRUE(judged[0].pass);
  EXPECT_FALSE(judged[1].pass);
}

TEST(Expected, OfNoRunOrOfNothingMeasuredNeverHolds) {
  const auto idle = judge_gates(kNoCracks, {run_with("full", 1, 0)}, {expect("t.gone.*", "crack", ">=", 0)});
  ASSERT_EQ(idle.size(), 2u);
  EXPECT_FALSE(idle[1].pass);
  EXPECT_EQ(idle[1].run, "t.gone.*");
  EXPECT_THAT(idle[1].note, testing::HasSubstr("was not flown"));

  const auto silent =
      judge_gates(kNoCracks, {run_with("full", 1, 0)}, {expect("t.*", "vertical_m.max", ">=", 0)});
  ASSERT_EQ(silent.size(), 2u);
  EXPECT_FALSE(silent[1].pass);
  EXPECT_TRUE(std::isnan(silent[1].value));
  EXPECT_THAT(silent[1].note, testing::HasSubstr("nothing was measured"));
}

TEST(Expected, NothingIsExpectedOfMethodsLeftOut) {
  Suite suite = small_suite();
  suite.expected = {expect("hills.orbit.full.1", "triangles", ">=", 1),
                    expect("hills.orbit.block_bintree.2", "triangles", "==", 0)};
  RunOptions options;
  options.pictures = false;
  options.methods = {"full"};
  const auto count = [](const SuiteOutcome& outcome) {
    return std::count_if(outcome.verdict.gates.begin(), outcome.verdict.gates.end(),
                         [](const verdict::GateVerdict& gate) { return gate.expected; });
  };
  EXPECT_EQ(count(run_suite(suite, options)), 1);
  options.methods.clear();
  const SuiteOutcome whole = run_suite(suite, options);
  EXPECT_EQ(count(whole), 2);
  EXPECT_FALSE(whole.verdict.pass());
}

TEST(Vacuous, OneLevelOnEachOfTwoTerrainsIsAFailure) {
  std::vector<verdict::RunVerdict> runs{
      run_with("restricted_quadtree", 1, 0), run_with("restricted_quadtree", 8, 0),
      run_with("restricted_quadtree", 1, 0), run_with("restricted_quadtree", 8, 0)};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    runs[r].terrain = r < 2 ? "small" : "large";
    runs[r].summary.triangles_min = runs[r].summary.triangles_max = r < 2 ? 32 : 128;
    runs[r].summary.vertical_m.area_m2 = 1;
  }
  EXPECT_THAT(find_vacuous(runs), testing::ElementsAre(testing::HasSubstr("one level of detail")));
}

TEST(Vacuous, NothingInThePictureIsAFailure) {
  std::vector<verdict::RunVerdict> runs{run_with("full", 1, 0)};
  runs[0].summary.image.displacement_px.count = 0;
  runs[0].summary.triangles_max = 2;
  runs[0].summary.vertical_m.area_m2 = 1;
  EXPECT_THAT(find_vacuous(runs), testing::ElementsAre(testing::HasSubstr("no pixel")));
  EXPECT_THAT(find_vacuous({}), testing::ElementsAre(testing::HasSubstr("no run")));
}

/// A flight that never has the terrain in the picture: every figure of its pictures would be that of nothing.
TEST(Vacuous, AFlightThatLooksAwayFailsWithFinding110) {
  Suite suite = small_suite();
  TrajectorySpec away;
  away.id = "away";
  away.kind = "poses";
  away.poses = {{{480, 480, 9000}, {480, 480, 9100}}, {{480, 480, 9000}, {480, 4800, 9500}}};
  suite.trajectories = {away};
  suite.methods = {{"restricted_quadtree", {2}, {}}};
  suite.gates = {{"nothing_judged", "", "==", 0, false, "nothing_judged == 0"}};
  const verdict::SuiteVerdict verdict = run_suite(suite, {}).verdict;
  ASSERT_EQ(verdict.runs.size(), 1u);
  const verdict::RunVerdict& run = verdict.runs[0];
  EXPECT_EQ(run.summary.nothing_judged, 2u);
  for (const verdict::FrameVerdict& frame : run.frames) {
    EXPECT_GT(frame.triangles, 0u);
    ASSERT_FALSE(frame.findings.empty());
    EXPECT_EQ(frame.findings.back().code, oracle::FindingCode::nothing_judged);
  }
  ASSERT_EQ(verdict.gates.size(), 1u);
  EXPECT_FALSE(verdict.gates[0].pass);
  EXPECT_EQ(verdict.gates[0].value, 2);
  EXPECT_THAT(verdict.vacuous, testing::Contains(testing::HasSubstr("no pixel")));
  EXPECT_FALSE(verdict.pass());

  // One frame that sees the terrain is something; the gate still asks for all of them.
  suite.trajectories[0].poses.push_back({{480, 480, 3000}, {470, 480, 0}});
  const verdict::SuiteVerdict seen = run_suite(suite, {}).verdict;
  EXPECT_EQ(seen.runs.at(0).summary.nothing_judged, 2u);
  EXPECT_THAT(seen.vacuous, testing::Not(testing::Contains(testing::HasSubstr("no pixel"))));
  EXPECT_FALSE(seen.gates.at(0).pass);
}

TEST(MeshDump, PlyHoldsTheVeryBits) {
  Mesh mesh;
  mesh.positions = {{0.1, 1e-310, -0.0}, {1, 0, 1e300}, {0, 1, 3}};
  mesh.triangles = {{0, 1, 2}};
  const std::string ply = to_ply(mesh);
  const std::size_t body = ply.find("end_header\n") + std::strlen("end_header\n");
  ASSERT_EQ(ply.size(), body + 3 * 24 + 13);
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_EQ(std::memcmp(ply.data() + body + 24 * v, &mesh.positions[v], 24), 0);
  }
  EXPECT_EQ(ply[body + 72], 3);
}

}  // namespace
}  // namespace plumbline
