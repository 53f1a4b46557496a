// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `plumbline selftest`: exit status, table, score as JSON, and what it says to bad options.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace plumbline::testing_cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class SelftestCommand : public ProgramTest {
 protected:
  std::string path(const std::string& name) const { return (folder() / name).string(); }
};

TEST_F(SelftestCommand, PrintsTheScoreOfEveryOracle) {
  const Outcome outcome =
      run({"selftest", "--faults", "200", "--clean", "100", "--json", path("score.json")});
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  for (const char* word : {"O1 conformity", "O2 vertical error", "O3 image error", "O4 economy",
                           "O5 stability", "O6 shape", "O7 general meshes", "O1 between meshes",
                           "tile format", "placement", "corner_lifted_ulp", "0 misplaced"})
    EXPECT_THAT(outcome.out, HasSubstr(word));
  const json score = json::parse(read_file(path("score.json")));
  EXPECT_EQ(score["schema"], "plumbline.selftest/1");
  EXPECT_TRUE(score["pass"]);
  EXPECT_GE(score["planted"], 200);
  EXPECT_EQ(score["clean_meshes"], 100);
  EXPECT_EQ(score["found"], score["expected"]);
}

TEST_F(SelftestCommand, AnotherSeedPlantsOtherwiseTheSameDoesNot) {
  const auto text = [&](const char* seed) {
    return run({"selftest", "--faults", "100", "--clean", "10", "--seed", seed, "--quiet", "--json",
                path(seed)})
                       .status == 0
               ? read_file(path(seed))
               : std::string();
  };
  const std::string one = text("1"), again = text("1"), two = text("2");
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, again);
  EXPECT_NE(one, two);
}

TEST_F(SelftestCommand, BadOptionsAreOneLine) {
  put("no_folder", "");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"selftest", "--faults", "0"},
        {"selftest", "--faults", "-3"},
        {"selftest", "--clean", "many"},
        {"selftest", "--seed", "x"},
        {"selftest", "--jobs", "-1"},
        {"selftest", "--faults", "1", "--clean", "1", "--json", path("no_folder/score.json"), "--quiet"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments[1];
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

}  // namespace
}  // namespace plumbline::testing_cli
