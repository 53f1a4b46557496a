// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Expectations as reports show and write them.
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "reports/digest.h"
#include "reports/report.h"
#include "scenarios/toml_reader.h"
#include "tests/reports/sample_verdict.h"

namespace plumbline::reports {
namespace {

using testing::HasSubstr;
using testing::Not;

verdict::GateVerdict gate(const std::string& figure, double value, bool pass) {
  verdict::GateVerdict out;
  out.name = figure + " == 0";
  out.run = "canyon.orbit.block_bintree.4";
  out.limit = "== 0";
  out.value = value;
  out.pass = pass;
  out.figure = figure;
  return out;
}

verdict::GateVerdict expectation(const std::string& figure, double value, bool pass, const std::string& why) {
  verdict::GateVerdict out = gate(figure, value, pass);
  out.name = "expected: " + figure + " (" + why + ")";
  out.limit = "== 63";
  out.expected = true;
  out.why = why;
  if (!pass) out.note = "expected 63 " + figure + " (" + why + "), found 60: better? update the expectation";
  return out;
}

verdict::SuiteVerdict suite_with(std::vector<verdict::GateVerdict> gates) {
  verdict::SuiteVerdict out = sample::suite_verdict({{"canyon"}, {"orbit"}, 2});
  out.gates = std::move(gates);
  return out;
}

TEST(ExpectedToml, RecordsWhatFailsAndKeepsReasons) {
  const std::string text = expected_toml(
      suite_with({gate("hole", 0, true), gate("overlap", 12, false),
                  expectation("crack", 60, false, "steep \"ground\" \\ ü\x7f"),
                  expectation("displacement_px.p99", 0.1 + 0.2, true, "no promise"), gate("crack", 3, false),
                  gate("vertical_m.max", std::numeric_limits<double>::quiet_NaN(), false)}));
  const TomlTable file = parse_toml(text, "e.toml");
  const auto entries = file.tables("expected");
  ASSERT_EQ(entries.size(), 3u) << text;
  EXPECT_EQ(entries[0]->at("run").text(), "canyon.orbit.block_bintree.4");
  EXPECT_EQ(entries[0]->at("figure").text(), "overlap");
  EXPECT_EQ(entries[0]->at("value").number(), 12);
  EXPECT_EQ(entries[0]->at("why").text(), "fails overlap == 0");
  EXPECT_EQ(entries[1]->at("figure").text(), "crack");
  EXPECT_EQ(entries[1]->at("value").number(), 60) << "as found, and once";
  EXPECT_EQ(entries[1]->at("why").text(), "steep \"ground\" \\ ü") << "control characters are blanks";
  EXPECT_EQ(entries[2]->at("value").number(), 0.1 + 0.2) << "to the last bit";
  EXPECT_THAT(text, HasSubstr("# vertical_m.max of canyon.orbit.block_bintree.4: nothing was measured"));
}

TEST(ExpectedToml, DropsWhatNeedNotBeExpected) {
  verdict::GateVerdict mended = expectation("crack", 0, false, "steep");
  mended.needless = true;
  const TomlTable file = parse_toml(expected_toml(suite_with({mended})), "e.toml");
  EXPECT_TRUE(file.tables("expected").empty());
  EXPECT_TRUE(file.has("expected"));
}

TEST(ExpectedGates, AreMarkedInEveryReport) {
  const verdict::SuiteVerdict suite =
      suite_with({gate("hole", 0, true), expectation("crack", 60, false, "steep"),
                  expectation("t_junction", 63, true, "steep")});
  const auto gates = nlohmann::json::parse(results_json(suite))["gates"];
  EXPECT_FALSE(gates[0].contains("expected"));
  EXPECT_FALSE(gates[0].contains("note"));
  EXPECT_EQ(gates[1]["expected"], true);
  EXPECT_THAT(gates[1]["note"].get<std::string>(), HasSubstr("found 60: better?"));
  EXPECT_EQ(gates[2]["name"], "expected: t_junction (steep)");
  EXPECT_FALSE(gates[2].contains("note"));

  EXPECT_THAT(
      junit_xml(suite),
      HasSubstr(
          "<failure message=\"expected 63 crack (steep), found 60: better? update the expectation\"/>"));
  const std::string summary = summary_md(suite, {});
  EXPECT_THAT(summary,
              HasSubstr("## Not as expected\n\n- canyon.orbit.block_bintree.4: expected 63 crack (steep)"));
  EXPECT_THAT(summary, Not(HasSubstr("## Failed gates"))) << "told once";
  EXPECT_THAT(verdict_in_words(suite).headline, testing::EndsWith("; 1 figure is as expected"));
  EXPECT_THAT(verdict_in_words(suite_with({gate("hole", 0, true)})).headline, Not(HasSubstr("as expected")));
  EXPECT_THAT(report_html(suite, {}, {}, ""), HasSubstr("not as expected"));
}

TEST(ExpectedGates, SummaryListsABoundedNumber) {
  std::vector<verdict::GateVerdict> gates(50, expectation("crack", 60, false, "steep"));
  EXPECT_THAT(summary_md(suite_with(gates), {}), HasSubstr("… and 30 more, in junit.xml."));
}

}  // namespace
}  // namespace plumbline::reports
