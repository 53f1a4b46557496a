// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "reports/escape.h"
#include "reports/json_text.h"
#include "reports/report.h"

namespace plumbline::reports {
namespace {

struct Case {
  std::string name;
  std::string failure;  ///< empty: passed
};
struct TestSuite {
  std::string name;
  std::vector<Case> cases;
  [[nodiscard]] std::size_t failures() const {
    std::size_t count = 0;
    for (const Case& test : cases) count += test.failure.empty() ? 0 : 1;
    return count;
  }
};

std::vector<TestSuite> test_suites(const verdict::SuiteVerdict& verdict) {
  std::vector<TestSuite> suites;
  for (const verdict::GateVerdict& gate : verdict.gates) {  // gates come in run order
    if (suites.empty() || suites.back().name != gate.run) suites.push_back({gate.run, {}});
    std::string failure;
    if (!gate.pass) {
      failure = gate.note.empty() ? fmt::format("value {}, limit {}", number_text(gate.value), gate.limit)
                                  : gate.note;
    }
    suites.back().cases.push_back({gate.name, failure});
  }
  TestSuite whole{verdict.suite, {}};
  for (const std::string& why : verdict.vacuous)
    whole.cases.push_back(
        {fmt::format("judged something: {}", why), fmt::format("nothing judged (finding 110): {}", why)});
  if (verdict.runs.empty()) whole.cases.push_back({"has runs", "no run was made"});
  if (verdict.interrupted) whole.cases.push_back({"finished", "interrupted before the last frame"});
  if (!whole.cases.empty()) suites.push_back(std::move(whole));
  return suites;
}

}  // namespace

std::string junit_xml(const verdict::SuiteVerdict& verdict) {
  const std::vector<TestSuite> suites = test_suites(verdict);
  std::size_t tests = 0, failures = 0;
  for (const TestSuite& suite : suites) {
    tests += suite.cases.size();
    failures += suite.failures();
  }
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" tests=\"{}\" failures=\"{}\">\n",
      markup_escape(verdict.suite), tests, failures);
  for (const TestSuite& suite : suites) {
    const std::string name = markup_escape(suite.name);
    out += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n", name, suite.cases.size(),
                       suite.failures());
    for (const Case& test : suite.cases) {
      out += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", name, markup_escape(test.name));
      out += test.failure.empty()
                 ? "/>\n"
                 : fmt::format("><failure message=\"{}\"/></testcase>\n", markup_escape(test.failure));
    }
    out += "  </testsuite>\n";
  }
  return out + "</testsuites>\n";
}

}  // namespace plumbline::reports
