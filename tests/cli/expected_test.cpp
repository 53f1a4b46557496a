// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Expected failures through the command line: recorded, held, and red on a change in either direction.
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

const std::string kSuites = PLUMBLINE_SOURCE_DIR "/scenarios/suites/";

/// The shipped suite of steep ground, whose failures are known by name.
class Expected : public ProgramTest {
 protected:
  Expected() {
    put("steep_known.toml", read_file(kSuites + "steep_known.toml"));
    put(kFile, shipped_);
  }
  Outcome fly(const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{"run", "steep_known.toml", "--out", "out", "--no-pictures"};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  }
  /// The first `figure` of the file with its value changed by `change`.
  void plant(const std::string& figure, long change) {
    std::string text = shipped_;
    const std::size_t entry = text.find("figure = \"" + figure + "\"");
    ASSERT_NE(entry, std::string::npos);
    const std::size_t value = text.find("value = ", entry) + 8;
    const std::size_t end = text.find(',', value);
    text.replace(value, end - value, std::to_string(std::stol(text.substr(value, end - value)) + change));
    put(kFile, text);
  }
  static constexpr const char* kFile = "steep_known.expected.toml";
  std::string shipped_ = read_file(kSuites + "steep_known.expected.toml");
};

TEST_F(Expected, TheShippedSuitePassesWithNamedFailures) {
  const Outcome outcome = fly();
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("as expected"));
  const json gates = json::parse(read_file(folder() / "out/results.json"))["gates"];
  std::size_t expected = 0;
  for (const json& gate : gates) {
    if (!gate.contains("expected")) continue;
    ++expected;
    EXPECT_GT(gate["value"], 0) << gate << ": a failure that is none need not be expected";
    EXPECT_THAT(gate["name"].get<std::string>(), HasSubstr("M4.S1"));
  }
  EXPECT_EQ(expected, static_cast<std::size_t>(std::count(shipped_.begin(), shipped_.end(), '{')));
  EXPECT_GT(expected, 0U);
}

TEST_F(Expected, FewerAndMoreFailuresAreBothRed) {
  plant("crack", +13);
  Outcome outcome = fly();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("better? update the expectation"));
  EXPECT_THAT(read_file(folder() / "out/junit.xml"), HasSubstr("better? update the expectation"));
  plant("crack", -1);
  outcome = fly();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("## Not as expected"));
  EXPECT_THAT(outcome.out, HasSubstr(": worse"));
}

TEST_F(Expected, AFailureThatIsNotExpectedIsRed) {
  put(kFile, "expected = []\n");
  const Outcome outcome = fly();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("## Failed gates"));
}

TEST_F(Expected, WhatIsWrittenIsWhatPasses) {
  // From nothing: everything that fails, with the gate as its reason.
  put("none.toml", "expected = []\n");
  EXPECT_EQ(fly({"--expected", "none.toml", "--write-expected", "e.toml"}).status, 1)
      << "the run's own status";
  const std::string written = read_file(folder() / "e.toml");
  EXPECT_THAT(written, HasSubstr("why = \"fails crack == 0\""));
  EXPECT_EQ(fly({"--expected", "e.toml"}).status, 0);
  // From the shipped file: the same bytes, reasons and all.
  EXPECT_EQ(fly({"--write-expected", "again.toml", "--quiet"}).status, 0);
  EXPECT_EQ(read_file(folder() / "again.toml"), shipped_);
  // A wrong value is put right, its reason stays.
  plant("crack", +13);
  EXPECT_EQ(fly({"--write-expected", kFile, "--quiet"}).status, 1);
  EXPECT_EQ(read_file(folder() / kFile), shipped_);
}

TEST_F(Expected, BadFilesAreOneLineBeforeAnythingIsFlown) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    const Outcome outcome = fly(options);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  refused({"--expected", "gone.toml"}, "gone.toml: no such file");
  put("bad.toml",
      "expected = [\n{ run = \"crags.nadir.block_bintree.5\", figure = \"crack\", value = 1, why = \"x\" }]");
  refused({"--expected", "bad.toml"}, "bad.toml:2: 'run' in [[expected]] is \"crags.nadir.block_bintree.5\"");
  refused({"--write-expected", "e.toml", "--methods", "block_bintree"}, "leave one out");
  put("file", "");
  refused({"--write-expected", "file/e.toml"}, "file");
  EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
}

TEST_F(Expected, MethodsThatAreLeftOutAreNotMissed) {
  EXPECT_EQ(fly({"--methods", "block_bintree:repaired"}).status, 0);
  EXPECT_EQ(fly({"--methods", "block_bintree"}).status, 0);
}

}  // namespace
}  // namespace plumbline::testing_cli
