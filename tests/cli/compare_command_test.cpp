// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `plumbline compare`: exit statuses, both kinds of files, what it prints, and what it says to bad input.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/cli/suite_text.h"

namespace plumbline::testing_cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string results(int cracks, double p99, int triangles, bool holds = true) {
  return json{
      {"schema", "plumbline.results/1"},
      {"suite", "s"},
      {"pass", holds},
      {"runs",
       {{{"id", "hills.down.full.1"},
         {"summary",
          {{"triangles", triangles},
           {"conformity", {{"crack", cracks}}},
           {"displacement_px", {{"p99", p99}}}}}}}},
      {"gates", {{{"name", "crack == 0"}, {"run", "hills.down.full.1"}, {"limit", "== 0"}, {"pass", holds}}}}}
      .dump();
}

class CompareCommand : public ProgramTest {
 protected:
  Outcome compare(const std::string& before, const std::string& after,
                  const std::vector<std::string>& options = {}) {
    put("old.json", before);
    put("new.json", after);
    std::vector<std::string> words{"compare", "old.json", "new.json"};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  }
  void expect_refused(const std::vector<std::string>& words, const std::string& message) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  }
};

TEST_F(CompareCommand, StatusSaysWhetherAnythingIsWorse) {
  const std::string base = results(3, 1.5, 100);
  EXPECT_EQ(compare(base, base).status, 0);
  EXPECT_EQ(compare(base, results(4, 1.5, 100)).status, 1);
  EXPECT_EQ(compare(base, results(2, 1.5, 100)).status, 0) << "better";
  EXPECT_EQ(compare(base, results(3, 1.5, 90)).status, 0) << "neither";
  EXPECT_EQ(compare(base, results(2, 1.5, 100), {"--any-change"}).status, 1);
  EXPECT_EQ(compare(base, results(3, 1.5, 90), {"--any-change"}).status, 1);
  EXPECT_EQ(compare(base, base, {"--any-change"}).status, 0);
  EXPECT_EQ(compare(base, results(3, 1.5000001, 100)).status, 1);
  EXPECT_EQ(compare(base, results(3, 1.5000001, 100), {"--tolerance", "1e-6"}).status, 0);
  EXPECT_EQ(compare(base, results(4, 1.5, 100), {"--tolerance", "0.9"}).status, 1) << "no count is close";
}

TEST_F(CompareCommand, PrintsTheWorstFirst) {
  const Outcome outcome = compare(results(0, 1.5, 100), results(12, 1.25, 110, false));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, StartsWith("worse: 3 worse, 1 better, 1 changed, 1 the same in 1 run\n"));
  std::vector<std::size_t> places;
  for (const char* row : {"pass |", "gate crack == 0", "| crack ", "displacement_px.p99", "triangles"}) {
    places.push_back(outcome.out.find(row));
    EXPECT_NE(places.back(), std::string::npos) << row << " in " << outcome.out;
  }
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end())) << outcome.out;
  EXPECT_EQ(compare(results(0, 1, 1), results(1, 1, 1), {"--quiet"}).out, "");
}

TEST_F(CompareCommand, MarkdownAndJson) {
  const Outcome outcome =
      compare(results(0, 1.5, 100), results(12, 1.5, 100), {"--markdown", "--json", "d.json"});
  EXPECT_THAT(outcome.out,
              StartsWith("### plumbline: worse\n\n1 worse, 0 better, 0 changed, 5 the same in 1 run.\n"));
  EXPECT_THAT(outcome.out, HasSubstr("| **worse** | `hills.down.full.1` | `crack` | 0 | 12 | +12 |"));
  const json differences = json::parse(read_file(folder() / "d.json"));
  EXPECT_EQ(differences["schema"], "plumbline.compare/1");
  EXPECT_EQ(differences["differences"][0]["what"], "crack");
}

TEST_F(CompareCommand, TellsNewFindingsOfAChecksFile) {
  const auto check = [](const std::string& findings) {
    return R"({"schema": "plumbline.check/1", "verdict": "faulty", "meshes": [{"file": "a.ply"}],
               "conformity": {"crack": 1}, "findings": [)" +
           findings + "]}";
  };
  const std::string known =
      R"({"code": 302, "name": "crack", "kind": "gap", "mesh": "a.ply", "at": [1, 2, 3]})";
  const std::string fresh =
      R"({"code": 302, "name": "crack", "kind": "gap", "mesh": "a.ply", "at": [4, 2, 3]})";
  EXPECT_EQ(compare(check(known), check(known)).status, 0) << "old violations are known";
  const Outcome outcome = compare(check(known), check(known + "," + fresh));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("302 crack: gap at 4, 2, 3"));
  EXPECT_EQ(compare(check(known + "," + fresh), check(known)).status, 0);
}

TEST_F(CompareCommand, FindingsAlone) {
  const auto check = [](int cracks, double error_m) {
    return json{{"schema", "plumbline.check/1"},     {"verdict", "faulty"},
                {"meshes", {{{"file", "a.ply"}}}},   {"findings", json::array()},
                {"conformity", {{"crack", cracks}}}, {"vertical_m", {{"max", error_m}}}}
        .dump();
  };
  EXPECT_EQ(compare(check(1, 2), check(1, 3)).status, 1);
  const Outcome moved = compare(check(1, 2), check(1, 3), {"--findings"});
  EXPECT_EQ(moved.status, 0) << "a figure moved, no finding is new";
  EXPECT_THAT(moved.out, HasSubstr("findings and their counts only"));
  EXPECT_EQ(compare(check(1, 2), check(2, 2), {"--findings"}).status, 1);
  EXPECT_EQ(compare(results(0, 1.5, 100), results(0, 2.5, 120), {"--findings", "--any-change"}).status, 0);
  EXPECT_EQ(compare(results(0, 1.5, 100), results(1, 1.5, 100), {"--findings"}).status, 1);
}

TEST_F(CompareCommand, ARunIsItsOwnTwin) {
  put("suite.toml", SuiteText{}.text());
  ASSERT_EQ(run({"run", "suite.toml", "--out", "a", "--quiet", "--no-pictures"}).status, 0);
  SuiteText finer;
  finer.method = "id = \"restricted_quadtree\"\nthresholds_px = [2]\noptions = { }\n";
  finer.trajectory = "id = \"down\"\nkind = \"nadir\"\nframes = 3\n";
  put("suite.toml", finer.text());
  ASSERT_EQ(run({"run", "suite.toml", "--out", "b", "--quiet", "--no-pictures"}).status, 0);
  EXPECT_EQ(run({"compare", "a/results.json", "a/results.json", "--any-change"}).status, 0);
  const Outcome outcome = run({"compare", "a/results.json", "b/results.json", "--any-change"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("frames"));
}

TEST_F(CompareCommand, BadInputIsOneLine) {
  const std::string good = results(0, 1.5, 100);
  put("good.json", good);
  put("cut.json", good.substr(0, good.size() / 2));
  put("text.json", "all is well\n");
  put("other.json", R"({"schema": "plumbline.timing/1"})");
  put("check.json", R"({"schema": "plumbline.check/1", "verdict": "sound", "meshes": [], "findings": []})");
  put("deep.json", std::string(1'000'000, '['));
  put("empty.json", "");
  std::filesystem::create_directory(folder() / "folder.json");
  expect_refused({"compare", "good.json", "cut.json"}, "cut.json: ends in the middle");
  expect_refused({"compare", "cut.json", "good.json"}, "cut.json: ends in the middle");
  expect_refused({"compare", "good.json", "text.json"}, "text.json: not valid JSON");
  expect_refused({"compare", "good.json", "other.json"}, "has the schema \"plumbline.timing/1\"");
  expect_refused({"compare", "good.json", "check.json"}, "compare two of one kind");
  expect_refused({"compare", "good.json", "deep.json"}, "nests deeper than 64 levels");
  expect_refused({"compare", "good.json", "empty.json"}, "empty.json: ends in the middle");
  expect_refused({"compare", "good.json", "none.json"}, "none.json: no such file");
  expect_refused({"compare", "good.json", "folder.json"}, "not a regular file");
  expect_refused({"compare", "good.json"}, "new is required");
  expect_refused({"compare", "good.json", "good.json", "--tolerance", "2"}, "--tolerance");
  expect_refused({"compare", "good.json", "good.json", "--tolerance", "nan"}, "--tolerance");
  expect_refused({"compare", "good.json", "good.json", "--json", "good.json/x.json"}, "cannot write");
}

}  // namespace
}  // namespace plumbline::testing_cli
