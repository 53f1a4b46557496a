// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <expat.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/digest.h"
#include "reports/escape.h"
#include "reports/report.h"
#include "tests/reports/sample_verdict.h"

namespace plumbline::reports {
namespace {

using testing::HasSubstr;
using testing::Not;

const verdict::SuiteVerdict& sample_suite() {
  static const verdict::SuiteVerdict verdict = sample::suite_verdict({{"canyon"}, {"orbit", "skim"}, 9});
  return verdict;
}

/// RFC 4180, strictly: every record ends in CRLF.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row;
  std::string field;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        field += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        field += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      EXPECT_TRUE(field.empty()) << "a quote inside a plain field";
      quoted = true;
    } else if (c == ',' || c == '\r') {
      row.push_back(std::move(field));
      field.clear();
      if (c == '\r') {
        EXPECT_EQ(text.at(++i), '\n');
        rows.push_back(std::move(row));
        row.clear();
      }
    } else {
      EXPECT_NE(c, '\n') << "a bare line break";
      field += c;
    }
  }
  EXPECT_TRUE(field.empty() && row.empty() && !quoted) << "the last record is not ended";
  return rows;
}

TEST(ResultsCsv, OneLineAFrameAndEveryFigureAColumn) {
  const auto rows = parse_csv(results_csv(sample_suite()));
  std::size_t frames = 0;
  for (const verdict::RunVerdict& run : sample_suite().runs) frames += run.frames.size();
  ASSERT_EQ(rows.size(), frames + 1);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  for (const verdict::Figure& figure : verdict::figures())
    EXPECT_THAT(rows[0], testing::Contains(std::string(figure.path)));
}

TEST(ResultsCsv, CellsHoldTheFramesFigures) {
  const auto rows = parse_csv(results_csv(sample_suite()));
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(rows[0], name) - rows[0].begin());
  };
  const verdict::RunVerdict& run = sample_suite().runs[1];
  const verdict::FrameVerdict& frame = run.frames[2];
  const auto& row = rows[1 + sample_suite().runs[0].frames.size() + 2];
  EXPECT_EQ(row[column("run")], run.id);
  EXPECT_EQ(row[column("frame")], "2");
  EXPECT_EQ(std::stod(row[column("displacement_px.p99")]), frame.image.displacement_px.p99);
  EXPECT_EQ(row[column("triangles")], std::to_string(frame.triangles));
  EXPECT_EQ(row[column("visited")], std::to_string(frame.counters.visited));
  EXPECT_EQ(rows[1][column("pop_px.max")], "") << "the first frame has no frame before it";
}

TEST(ResultsCsv, AwkwardNamesAreQuoted) {
  verdict::SuiteVerdict verdict = sample_suite();
  verdict.runs.resize(1);
  verdict.runs[0].terrain = "a, \"b\"\r\nc";
  const auto rows = parse_csv(results_csv(verdict));
  EXPECT_EQ(rows[1][1], "a, \"b\"\r\nc");
}

/// A JUnit file as a real XML parser sees it.
struct Junit {
  std::string error;  ///< empty: well-formed
  std::map<std::string, int> elements;
  std::map<std::string, std::string> root;
  std::vector<std::string> case_names, failures;
};

void on_element(void* user, const XML_Char* name, const XML_Char** attributes) {
  Junit& seen = *static_cast<Junit*>(user);
  const bool is_root = seen.elements.empty();
  ++seen.elements[name];
  for (; *attributes != nullptr; attributes += 2) {
    const std::string key = attributes[0], value = attributes[1];
    if (is_root) seen.root[key] = value;
    if (std::string_view(name) == "testcase" && key == "name") seen.case_names.push_back(value);
    if (std::string_view(name) == "failure" && key == "message") seen.failures.push_back(value);
  }
}

Junit parse_junit(const std::string& text) {
  Junit seen;
  XML_Parser parser = XML_ParserCreate(nullptr);
  XML_SetUserData(parser, &seen);
  XML_SetStartElementHandler(parser, on_element);
  if (XML_Parse(parser, text.data(), static_cast<int>(text.size()), 1) == XML_STATUS_ERROR)
    seen.error = XML_ErrorString(XML_GetErrorCode(parser));
  XML_ParserFree(parser);
  return seen;
}

TEST(JunitXml, ATestCasePerGate) {
  const Junit junit = parse_junit(junit_xml(sample_suite()));
  ASSERT_EQ(junit.error, "");
  const auto failed =
      std::ranges::count_if(sample_suite().gates, [](const auto& gate) { return !gate.pass; });
  ASSERT_GT(failed, 0);
  EXPECT_EQ(junit.elements.at("testsuite"), static_cast<int>(sample_suite().runs.size()));
  EXPECT_EQ(junit.elements.at("testcase"), static_cast<int>(sample_suite().gates.size()));
  EXPECT_EQ(junit.elements.at("failure"), failed);
  EXPECT_EQ(junit.root.at("tests"), std::to_string(sample_suite().gates.size()));
  EXPECT_EQ(junit.root.at("failures"), std::to_string(failed));
}

TEST(JunitXml, FailureTellsValueAndLimit) {
  verdict::SuiteVerdict verdict;
  verdict.runs.emplace_back();
  verdict.gates.push_back({"crack == 0", "r", "== 0", 12, false});
  EXPECT_THAT(parse_junit(junit_xml(verdict)).failures, testing::ElementsAre("value 12, limit == 0"));
}

TEST(JunitXml, VacuousAndInterruptedAreFailedCases) {
  verdict::SuiteVerdict verdict;
  verdict.runs.emplace_back();
  verdict.vacuous.emplace_back("r: no pixel to measure");
  verdict.interrupted = true;
  const Junit junit = parse_junit(junit_xml(verdict));
  EXPECT_EQ(junit.elements.at("failure"), 2);
  EXPECT_THAT(junit.failures[0], HasSubstr("no pixel to measure"));
}

TEST(JunitXml, AnyTextStaysWellFormed) {
  verdict::SuiteVerdict verdict;
  verdict.suite = "<&\"'>\x01\xff\xEF\xBF\xBF]]>";
  verdict.gates.push_back({"a < b & \"c\"", "r\x08", "<= 1 tau", 2, false});
  const Junit junit = parse_junit(junit_xml(verdict));
  EXPECT_EQ(junit.error, "");
  EXPECT_THAT(junit.case_names, testing::Contains("a < b & \"c\""));
}

TEST(Digest, HeadlineCountsSoundMethodsAndGates) {
  const VerdictWords words = verdict_in_words(sample_suite());
  EXPECT_THAT(words.headline, HasSubstr("2 of 3 methods are sound"));
  EXPECT_THAT(words.headline, HasSubstr("gates failed"));
  ASSERT_EQ(words.sentences.size(), 1u);
  EXPECT_THAT(words.sentences[0], HasSubstr("block_bintree"));
}

TEST(Digest, MethodWithoutAFrameIsNotSound) {
  verdict::SuiteVerdict verdict;
  verdict.runs.emplace_back().method = "full";
  EXPECT_EQ(verdict_in_words(verdict).headline, "full is not sound; no gate was judged");
  EXPECT_EQ(verdict_in_words({}).headline, "No run was finished; no gate was judged");
}

TEST(Digest, VisibleFindingIsWorseThanALargerHiddenOne) {
  verdict::SuiteVerdict verdict;
  verdict::RunVerdict& run = verdict.runs.emplace_back();
  verdict::FrameVerdict& frame = run.frames.emplace_back();
  frame.findings = {sample::t_vertex({1, 0, 0}, 9, 9, oracle::Visibility::occluded),
                    sample::t_vertex({2, 0, 0}, -2, -1.5, oracle::Visibility::visible),
                    sample::t_vertex({3, 0, 0}, 1, 1, oracle::Visibility::visible)};
  const auto worst = worst_findings(verdict);
  ASSERT_EQ(worst.size(), 1u) << "one for each method and code";
  EXPECT_EQ(worst[0].finding->at.x, 2);
}

TEST(Digest, ShortNumbers) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(0.012345), "0.0123");
  EXPECT_EQ(short_number(2.5), "2.5");
  EXPECT_EQ(short_number(524288), "524288");
  EXPECT_EQ(short_number(1532.7), "1533");
  EXPECT_EQ(short_number(std::nan("")), "—");
}

TEST(SummaryMd, VerdictFirstThenTables) {
  const std::string text = summary_md(sample_suite(), sample::suite_timing(sample_suite()));
  EXPECT_THAT(text, testing::StartsWith("# default: FAIL\n\n2 of 3 methods are sound"));
  for (const char* part : {"## Findings", "## Failed gates", "## Worst offenders", "## Speed and accuracy",
                           "## Economy", "| block_bintree ", "not sound", "302 crack, visible"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_LT(std::ranges::count(text, '\n'), 70) << "a summary is short";
}

TEST(SummaryMd, TableRowsHaveEqualWidth) {
  const std::string text = summary_md(sample_suite(), {});
  std::size_t width = 0, rows = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('\n', from);
    const std::string line = text.substr(from, end - from);
    from = end + 1;
    const auto bars = static_cast<std::size_t>(std::ranges::count(line, '|'));
    if (line.starts_with("|")) {
      if (width != 0) {
        EXPECT_EQ(bars, width) << line;
      }
      width = bars;
      ++rows;
    } else {
      width = 0;
    }
  }
  EXPECT_GT(rows, 10u);
}

TEST(SummaryMd, CleanSuitePasses) {
  verdict::SuiteVerdict verdict = sample_suite();
  std::erase_if(verdict.runs, [](const auto& run) { return run.method == "block_bintree"; });
  std::erase_if(verdict.gates, [](const auto& gate) { return !gate.pass; });
  const std::string text = summary_md(verdict, {});
  EXPECT_THAT(text, testing::StartsWith("# default: pass\n\n2 of 2 methods are sound; all "));
  EXPECT_THAT(text, Not(HasSubstr("Failed gates")));
  EXPECT_THAT(text, Not(HasSubstr("Worst offenders")));
}

TEST(Escape, MarkdownCellsStayOneCell) { EXPECT_EQ(markdown_cell("a|b\nc`"), "a\\|b c\\`"); }

TEST(Escape, Base64OfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Escape, FileStemsStayInTheFolderAndApart) {
  EXPECT_EQ(file_stem("alps.orbit.block_bintree.2"), "alps.orbit.block_bintree.2");
  EXPECT_EQ(file_stem("../x"), "%2E.%2Fx");
  EXPECT_NE(file_stem("a:b"), file_stem("a%3Ab"));
}

}  // namespace
}  // namespace plumbline::reports
