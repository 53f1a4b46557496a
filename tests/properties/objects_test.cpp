// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A suite of objects from file to reports: every frame judged without a plan, the same bytes on any number of
// threads, and nothing passes that was not judged.
#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "properties/harness/gates.h"
#include "properties/harness/run_suite.h"
#include "reports/report.h"
#include "scenarios/error.h"
#include "scenarios/portable_math.h"
#include "scenarios/whole_file.h"

namespace plumbline {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A closed ball of rings × around quadrilaterals, with poles, as OFF.
std::string ball_off(int rings, int around) {
  std::string vertices = "0 0 1\n", faces;
  for (int i = 1; i < rings; ++i) {
    const double polar = kPi * i / rings;
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * kPi * k / around;
      vertices += std::to_string(exact_sin(polar) * exact_cos(angle)) + " " +
                  std::to_string(exact_sin(polar) * exact_sin(angle)) + " " +
                  std::to_string(exact_cos(polar)) + "\n";
    }
  }
  vertices += "0 0 -1\n";
  const int count = 2 + (rings - 1) * around;
  int face_count = 0;
  const auto face = [&](std::initializer_list<int> corners) {
    faces += std::to_string(corners.size());
    for (const int corner : corners) faces += " " + std::to_string(corner);
    faces += "\n";
    ++face_count;
  };
  const auto at = [&](int ring, int k) { return 1 + (ring - 1) * around + k % around; };
  for (int k = 0; k < around; ++k) {
    face({0, at(1, k), at(1, k + 1)});
    for (int ring = 1; ring + 1 < rings; ++ring)
      face({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)});
    face({at(rings - 1, k), count - 1, at(rings - 1, k + 1)});
  }
  return "OFF\n" + std::to_string(count) + " " + std::to_string(face_count) + " 0\n" + vertices + faces;
}

class Objects : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("plumbline_objects_") + test->name());
    write_whole_file(folder_ / "ball.off", ball_off(12, 20));
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  [[nodiscard]] Suite suite() const {
    Suite suite;
    suite.name = "objects";
    suite.width_px = 96;
    suite.height_px = 64;
    MeshSource balls;
    balls.id = "balls";
    balls.file = folder_ / "ball.off";
    balls.at = {{0, 0, 0}, {1, 6, 0.5}};
    suite.meshes = {balls};
    for (const char* kind : {"approach", "two_ways"}) {
      TrajectorySpec flight;
      flight.id = flight.kind = kind;
      flight.around = Subject::mesh;
      flight.frames = 9;
      suite.trajectories.push_back(flight);
    }
    suite.methods = {{"vertex_tree", {1, 2}, {}}, {"vertex_tree:no_contour", {1}, {}}};
    return suite;
  }

  std::filesystem::path folder_;
};

TEST_F(Objects, EveryFrameIsJudgedWithoutAPlan) {
  const SuiteOutcome outcome = run_suite(suite(), {});
  const verdict::SuiteVerdict& verdict = outcome.verdict;
  ASSERT_EQ(verdict.runs.size(), 6u);
  EXPECT_EQ(verdict.runs[0].id, "balls.approach.vertex_tree.1");
  ASSERT_EQ(verdict.meshes.size(), 1u);
  EXPECT_EQ(verdict.meshes[0].objects, 2u);
  EXPECT_EQ(verdict.meshes[0].triangles, 880u);  // 2 × (2·20 + 10·20·2)
  for (const verdict::RunVerdict& run : verdict.runs) {
    EXPECT_EQ(run.subject, Subject::mesh);
    ASSERT_EQ(run.frames.size(), 9u);
    EXPECT_GT(run.summary.image.depth_rel.count, 0u) << run.id;
    EXPECT_EQ(run.summary.image.displacement_px.count, 0u);
    EXPECT_EQ(run.summary.conformity.total(), 0u) << run.id;
    EXPECT_TRUE(std::isnan(verdict::figure_value(run.summary, "crack")));
    EXPECT_TRUE(std::isnan(verdict::figure_value(run.summary, "vertical_m.max")));
    EXPECT_FALSE(std::isnan(verdict::figure_value(run.summary, "silhouette_px.max")));
  }
  EXPECT_LT(verdict.runs[2].summary.triangles_min, 880u) << "far away the ladder takes triangles away";
  EXPECT_GT(verdict.runs[2].summary.image.parallax_px.max, 0) << "and that shows";
  EXPECT_TRUE(verdict.vacuous.empty()) << verdict.vacuous.front();
  EXPECT_TRUE(verdict.pass()) << "clean by the default gates, as far as they are about objects";
  ASSERT_EQ(verdict.gates.size(), 6u * 6u) << "six runs, six findings that need no plan";
  EXPECT_EQ(outcome.pictures.size(), 2u);
}

TEST_F(Objects, ThreadsChangeNoByte) {
  RunOptions one, four;
  one.jobs = 1;
  four.jobs = 4;
  const SuiteOutcome a = run_suite(suite(), one), b = run_suite(suite(), four);
  EXPECT_EQ(reports::results_json(a.verdict), reports::results_json(b.verdict));
  EXPECT_EQ(reports::results_csv(a.verdict), reports::results_csv(b.verdict));
  EXPECT_EQ(reports::junit_xml(a.verdict), reports::junit_xml(b.verdict));
}

TEST_F(Objects, ReportsSayWhatWasNotAsked) {
  const SuiteOutcome outcome = run_suite(suite(), {});
  const std::string json = reports::results_json(outcome.verdict);
  EXPECT_THAT(json, HasSubstr("\"subject\": \"mesh\""));
  EXPECT_THAT(json, HasSubstr("\"meshes\""));
  const std::string summary = reports::summary_md(outcome.verdict, outcome.timing);
  EXPECT_THAT(summary, HasSubstr("## Objects"));
  EXPECT_THAT(summary, Not(HasSubstr("## Speed and accuracy"))) << "no displacement was judged";
  EXPECT_THAT(summary, Not(HasSubstr("crack,"))) << "what was not asked is not said to be absent";
}

TEST_F(Objects, TerrainsAndMeshesStandSideBySide) {
  Suite mixed = suite();
  TerrainSource hills;
  hills.id = "hills";
  hills.generator = "fbm";
  hills.size = 17;
  mixed.terrains = {hills};
  TrajectorySpec over;
  over.id = "over";
  over.kind = "nadir";
  over.frames = 2;
  mixed.trajectories.insert(mixed.trajectories.begin(), over);
  mixed.methods = {{"restricted_quadtree", {1}, {}}, {"vertex_tree", {1}, {}}};
  const verdict::SuiteVerdict verdict = run_suite(mixed, {}).verdict;
  std::vector<std::string> ids;
  for (const verdict::RunVerdict& run : verdict.runs) ids.push_back(run.id);
  EXPECT_THAT(ids, testing::ElementsAre("hills.over.restricted_quadtree.1", "hills.over.vertex_tree.1",
                                        "balls.approach.vertex_tree.1", "balls.two_ways.vertex_tree.1"));
  EXPECT_GT(verdict.runs[1].summary.vertical_m.area_m2, 0);
}

TEST_F(Objects, NothingPassesUnjudged) {
  Suite away = suite();
  TrajectorySpec poses;
  poses.id = "away";
  poses.kind = "poses";
  poses.around = Subject::mesh;
  poses.poses = {{{50, 0, 0}, {100, 0, 0}}, {{60, 0, 0}, {100, 0, 0}}};  // the balls are behind
  away.trajectories = {poses};
  away.gates = {{"silhouette_px.max", "", "<=", 1, false, "silhouette_px.max <= 1"},
                {"crack", "", "==", 0, false, "crack == 0"}};
  const verdict::SuiteVerdict verdict = run_suite(away, {}).verdict;
  EXPECT_FALSE(verdict.pass());
  EXPECT_THAT(verdict.vacuous, testing::Contains(HasSubstr("no pixel to measure")));
  ASSERT_FALSE(verdict.gates.empty());
  for (const verdict::GateVerdict& gate : verdict.gates) {
    EXPECT_FALSE(gate.pass) << gate.name << ": nothing was in the picture, nobody has a plan";
    EXPECT_TRUE(std::isnan(gate.value));
  }
}

TEST_F(Objects, MethodsForTerrainsOnlyAreRefusedWhereThereIsNone) {
  Suite wrong = suite();
  wrong.methods.push_back({"restricted_quadtree", {1}, {}});
  EXPECT_THAT([&] { (void)run_suite(wrong, {}); },
              testing::ThrowsMessage<InputError>(HasSubstr("restricted_quadtree takes terrains only")));
}

}  // namespace
}  // namespace plumbline
