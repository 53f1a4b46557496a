// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Result files that are none: each is refused with one line that names the file and what is wrong.
#include "properties/compare/result_file.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>

#include "reports/report.h"
#include "scenarios/error.h"
#include "tests/reports/sample_verdict.h"

namespace plumbline::compare {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const std::string& text) {
  try {
    (void)parse_result(text, "r.json");
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_THAT(message, StartsWith("r.json: "));
    EXPECT_LT(message.size(), 600u);
    return message;
  }
  ADD_FAILURE() << "was taken: " << text.substr(0, 200);
  return {};
}

std::string results(const std::string& runs, const std::string& more = {}) {
  return R"({"schema": "plumbline.results/1", "suite": "s", "pass": true, "gates": [], "runs": [)" + runs +
         "]" + more + "}";
}

TEST(ResultFile, ReadsWhatReportsWrite) {
  const verdict::SuiteVerdict suite = sample::suite_verdict({{"canyon"}, {"orbit"}, 3});
  const ResultFile file = parse_result(reports::results_json(suite), "r.json");
  ASSERT_EQ(file.subjects.size(), suite.runs.size());
  EXPECT_EQ(file.gates.size(), suite.gates.size());
  EXPECT_EQ(file.schema, kResultsSchema);
  for (std::size_t r = 0; r < suite.runs.size(); ++r) {
    EXPECT_EQ(file.subjects[r].id, suite.runs[r].id);
    EXPECT_NE(file.subjects[r].frames, 0u);
    // Exactly the figures that a run over terrain is asked for, and the number of frames, with the verdict's
    // bits.
    std::size_t judged = 0;
    for (const Reading& reading : file.subjects[r].readings) {
      if (reading.kind != Reading::Kind::number || reading.path == "frames") continue;
      EXPECT_EQ(reading.value, verdict::figure_value(suite.runs[r].summary, reading.path)) << reading.path;
      ++judged;
    }
    EXPECT_GT(judged, 30u);
    EXPECT_EQ(file.subjects[r].readings.size(), verdict::figures().size() + 1) << "none is missing";
  }
}

TEST(ResultFile, RefusesWhatIsNoResult) {
  EXPECT_THAT(refusal(""), HasSubstr("ends in the middle, after "));
  EXPECT_THAT(refusal("hello"), HasSubstr("not valid JSON"));
  EXPECT_THAT(refusal("{\"schema\": 1e999}"), HasSubstr("not valid JSON"));
  EXPECT_THAT(refusal("[]"), HasSubstr("has no \"schema\""));
  EXPECT_THAT(refusal("3"), HasSubstr("has no \"schema\""));
  EXPECT_THAT(refusal("{}"), HasSubstr("has no \"schema\""));
  EXPECT_THAT(refusal("{\"schema\": 1}"), HasSubstr("has \"schema\" of type number, where a string belongs"));
  EXPECT_THAT(refusal("{\"schema\": \"plumbline.timing/1\"}"),
              HasSubstr("has the schema \"plumbline.timing/1\"; give a file of \"plumbline.results/1\" or"));
  EXPECT_THAT(refusal(results("") + "x"), HasSubstr("not valid JSON"));
  EXPECT_THAT(refusal("\xff\xfe{}"), HasSubstr("not valid JSON"));
}

TEST(ResultFile, RefusesATruncatedFileAtEveryByte) {
  const std::string whole = reports::results_json(sample::suite_verdict({{"canyon"}, {"orbit"}, 1}));
  const std::size_t body = whole.find_last_of('}');
  for (std::size_t bytes = 0; bytes <= body; bytes += 1 + bytes / 50) (void)refusal(whole.substr(0, bytes));
  (void)parse_result(whole.substr(0, body + 1), "r.json");
}

TEST(ResultFile, RefusesDeepNesting) {
  const std::string deep(10'000'000, '[');
  EXPECT_THAT(refusal(deep), HasSubstr("nests deeper than 64 levels"));
  EXPECT_THAT(refusal(results(R"({"id": "a", "frames": [)" + deep)), HasSubstr("nests deeper than 64 levels"))
      << "inside frames, too, which are not kept";
  std::string objects;
  for (int k = 0; k < 1000; ++k) objects += "{\"a\":";
  EXPECT_THAT(refusal(objects), HasSubstr("nests deeper than 64 levels"));
}

TEST(ResultFile, NamesTheRunAndTheFigureOfAnotherType) {
  EXPECT_THAT(refusal(results("3")), HasSubstr("one of \"runs\" is no object"));
  EXPECT_THAT(refusal(results("{}")), HasSubstr("one of \"runs\" has no \"id\""));
  EXPECT_THAT(refusal(results(R"({"id": "a"})")), HasSubstr("run \"a\" has no \"summary\""));
  EXPECT_THAT(refusal(results(R"({"id": "a", "summary": []})")),
              HasSubstr("run \"a\" has \"summary\" of type array, where an object belongs"));
  EXPECT_THAT(refusal(results(R"({"id": "a", "summary": {}})")), HasSubstr("has no figure in its summary"));
  EXPECT_THAT(refusal(results(R"({"id": "a", "summary": {"conformity": {"crack": "3"}}})")),
              HasSubstr("run \"a\" has \"crack\" of type string, where a number belongs"));
  const std::string run = R"({"id": "a", "summary": {"triangles": 3}})";
  (void)parse_result(results(run), "r.json");
  EXPECT_THAT(refusal(results(run + "," + run)), HasSubstr("has two runs called \"a\""));
  EXPECT_THAT(refusal(results(run, ", \"vacuous\": [3]")), HasSubstr("\"vacuous\""));
  EXPECT_THAT(refusal(results(run, ", \"interrupted\": 3")), HasSubstr("\"interrupted\" of type number"));
  EXPECT_THAT(refusal(R"({"schema": "plumbline.results/1", "pass": true, "runs": []})"),
              HasSubstr("has no \"gates\""));
}

TEST(ResultFile, TheLastOfEqualKeysStaysWhateverItsType) {
  const std::string text =
      results(R"({"id": 3, "id": "a", "summary": 5, "summary": {"triangles": [], "triangles": 3}})");
  EXPECT_EQ(parse_result(text, "r.json").subjects.at(0).readings.at(0).value, 3);
}

TEST(ResultFile, RefusesAWrongCheck) {
  const std::string head = R"({"schema": "plumbline.check/1", )";
  EXPECT_THAT(refusal(head + R"("verdict": "fine"})"), HasSubstr("neither \"sound\" nor \"faulty\""));
  EXPECT_THAT(refusal(head + R"("verdict": "sound", "findings": []})"), HasSubstr("has no \"meshes\""));
  EXPECT_THAT(refusal(head + R"("verdict": "sound", "meshes": []})"), HasSubstr("has no \"findings\""));
  EXPECT_THAT(refusal(head + R"("verdict": "sound", "meshes": [], "findings": [{"code": 302, "mesh": 7}]})"),
              HasSubstr("names mesh 7, and there are 0"));
  EXPECT_THAT(refusal(head + R"("verdict": "sound", "meshes": [3], "findings": []})"),
              HasSubstr("one of \"meshes\" is no object"));
  EXPECT_THAT(refusal(head + R"("verdict": "sound", "meshes": [], "findings": [{"mesh": null}]})"),
              HasSubstr("has no \"code\""));
  EXPECT_THAT(refusal(head + R"("verdict": "sound", "meshes": [], "findings": [], "seams": [[]]})"),
              HasSubstr("one of \"seams\" is no object"));
}

TEST(ResultFile, NamesAFileThatIsNotThere) {
  try {
    (void)read_result_file("no/such/results.json");
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "no/such/results.json: no such file; check the path");
  }
  EXPECT_THROW((void)read_result_file(testing::TempDir()), InputError);
}

}  // namespace
}  // namespace plumbline::compare
