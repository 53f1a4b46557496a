// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/expected_file.h"

#include <string>
#include <vector>

#include "scenarios/gate_figures.h"
#include "scenarios/suite.h"
#include "support.h"

namespace plumbline {
namespace {

using test::input_error;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kSuite = R"([suite]
name = "x"
[[terrain]]
id = "hills"
generator = "fbm"
[[mesh]]
id = "thing"
generator = "instrument"
[[trajectory]]
id = "down"
kind = "nadir"
frames = 2
[[trajectory]]
id = "around"
kind = "orbit"
around = "mesh"
frames = 2
[[method]]
id = "block_bintree:repaired"
thresholds_px = [2, 0.5]
subjects = ["hills"]
[[method]]
id = "meshopt"
thresholds_px = [1]
trajectories = ["around"]
[gate]
crack = 0
)";

class ExpectedFile : public testing::Test {
 protected:
  [[nodiscard]] Suite suite() const { return load_suite(folder_.write("s.toml", kSuite)); }
  [[nodiscard]] std::vector<Expectation> read(const std::string& text) const {
    return read_expected(folder_.write("e.toml", text), suite());
  }
  [[nodiscard]] std::string complaint(const std::string& text) const {
    const std::string message = input_error([&] { (void)read(text); });
    const std::string folder = folder_.path().string() + "/";
    EXPECT_THAT(message, testing::StartsWith(folder));
    return message.substr(std::min(folder.size(), message.size()));
  }
  test::TemporaryFolder folder_;
};

TEST_F(ExpectedFile, RunsAreNamedAsResultsNameThem) {
  EXPECT_THAT(possible_run_ids(suite()),
              ElementsAre("hills.down.block_bintree-repaired.2", "hills.down.block_bintree-repaired.0.5",
                          "thing.around.meshopt.1"));
  EXPECT_THAT(possible_run_ids(suite(), {"meshopt"}), ElementsAre("thing.around.meshopt.1"));
}

TEST_F(ExpectedFile, AnEntryIsALimitOfItsRuns) {
  const auto expected = read(R"(expected = [
  { run = "hills.down.block_bintree-repaired.2", figure = "crack", value = 63, why = "M4.S1: steep ground" },
  { run = "*.meshopt.*", figure = "displacement_px.p99", value = "<= 1.5 tau", why = "no promise" },
])");
  ASSERT_EQ(expected.size(), 2u);
  EXPECT_EQ(expected[0].run, "hills.down.block_bintree-repaired.2");
  EXPECT_EQ(expected[0].limit.figure, "crack");
  EXPECT_EQ(expected[0].limit.text, "crack == 63");
  EXPECT_EQ(expected[0].limit.method, "");
  EXPECT_EQ(expected[0].why, "M4.S1: steep ground");
  EXPECT_EQ(expected[1].limit.comparison, "<=");
  EXPECT_TRUE(expected[1].limit.times_tau);
}

TEST_F(ExpectedFile, NothingMayBeExpected) { EXPECT_TRUE(read("expected = []\n").empty()); }

TEST_F(ExpectedFile, TheSuiteNamesItsFileRelativeToItself) {
  std::filesystem::create_directory(folder_.path() / "known");
  folder_.write("known/e.toml", R"(expected = [
  { run = "hills.*", figure = "crack", value = 1, why = "steep" },
])");
  const auto load = [&](const std::string& line) {
    return load_suite(folder_.write("s.toml", kSuite + line + "\n"));
  };
  EXPECT_EQ(load("expected = \"known/e.toml\"").expected.size(), 1u);
  EXPECT_EQ(load("expected = \"known/e.toml\"").gates.size(), 1u) << "it is no limit";
  EXPECT_THAT(input_error([&] { load("expcted = \"known/e.toml\""); }),
              HasSubstr("did you mean 'expected'?"));
  EXPECT_THAT(input_error([&] { load("expected = 3"); }), HasSubstr("'expected' in [gate] is an integer"));
  EXPECT_THAT(input_error([&] { load("expected = \"e.toml\""); }), HasSubstr("no such file"));
}

TEST_F(ExpectedFile, ComplaintsNameLineKeyAndMending) {
  const std::string good =
      "expected = [\n  { run = \"hills.down.block_bintree-repaired.2\", figure = \"crack\", value = 63, why "
      "= \"steep\" },\n";
  const auto spoiled = [&](const std::string& from, const std::string& to) {
    std::string text = good + "]\n";
    text.replace(text.find(from), from.size(), to);
    return complaint(text);
  };
  EXPECT_TRUE(read(good + "]\n").size() == 1) << "the control";
  EXPECT_EQ(spoiled("figure", "figur"),
            "e.toml:2: unknown key 'figur' in [[expected]]; did you mean 'figure'?");
  EXPECT_EQ(spoiled("\"crack\"", "\"crak\""),
            "e.toml:2: 'figure' in [[expected]] is \"crak\", which is no figure; did you mean \"crack\"?");
  EXPECT_EQ(
      spoiled("repaired.2", "repaired.3"),
      "e.toml:2: 'run' in [[expected]] is \"hills.down.block_bintree-repaired.3\", and the suite has no "
      "such run; did you mean \"hills.down.block_bintree-repaired.2\"?");
  EXPECT_THAT(spoiled("hills.down", "*.up"), HasSubstr("matches no run of the suite"));
  EXPECT_THAT(spoiled("63", "\"about 63\""), HasSubstr("give a limit like 0"));
  EXPECT_THAT(spoiled("63", "nan"), HasSubstr("not finite"));
  EXPECT_THAT(spoiled(", why = \"steep\"", ""), HasSubstr("has no 'why'; add one"));
  EXPECT_THAT(spoiled("\"steep\"", "\"\""), HasSubstr("give the reason"));
  EXPECT_THAT(spoiled("\"steep\"", "\"a\\nb\""), HasSubstr("on one line"));
  EXPECT_EQ(spoiled("expected", "expect"),
            "e.toml:1: unknown key 'expect' in the top level; did you mean 'expected'?");
  EXPECT_THAT(complaint(""), HasSubstr("has no 'expected'"));
  EXPECT_THAT(complaint("expected = [1]"), HasSubstr("'expected' in the top level is an integer"));
  EXPECT_THAT(complaint(good + good.substr(good.find("  {")) + "]\n"),
              HasSubstr("e.toml:3: 'run' in [[expected]] and 'crack' stand here twice"));
}

TEST_F(ExpectedFile, PatternsAreFew) {
  std::string text = "expected = [\n";
  for (int k = 0; k < 1001; ++k) {
    const std::string stars(static_cast<std::size_t>(1 + k / 50), '*');
    text += "{ run = \"" + stars + "\", figure = \"" +
            std::string(kGateFigures[static_cast<std::size_t>(k % 50)]) + "\", value = 0, why = \"w\" },\n";
  }
  EXPECT_THAT(complaint(text + "]"), HasSubstr("there are more than 1000; name runs in full"));
}

TEST(RunMatches, AStarStandsForAnyText) {
  EXPECT_TRUE(run_matches("a.b.c.1", "a.b.c.1"));
  EXPECT_FALSE(run_matches("a.b.c.1", "a.b.c.10"));
  EXPECT_FALSE(run_matches("a.b.c.10", "a.b.c.1"));
  EXPECT_TRUE(run_matches("*", ""));
  EXPECT_TRUE(run_matches("*.c.*", "a.b.c.1"));
  EXPECT_TRUE(run_matches("a*1", "a.1.1"));
  EXPECT_FALSE(run_matches("a*1", "a.1.2"));
  EXPECT_TRUE(run_matches("a**b", "ab"));
  EXPECT_FALSE(run_matches("a.*.c", "a.b.c.1"));
  EXPECT_FALSE(run_matches("", "a"));
}

TEST(RunMatches, AHostilePatternTakesNoLongTime) {
  std::string pattern;
  for (int k = 0; k < 100; ++k) pattern += "*a";
  EXPECT_FALSE(run_matches(pattern + "b", std::string(20'000, 'a')));
}

}  // namespace
}  // namespace plumbline
