// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `plumbline tables` from outside: refusals, and what an interrupted run leaves. The figures are tested where
// they are made (tests/properties/tables_protocol_test.cpp).
#include <algorithm>
#include <csignal>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace plumbline::testing_cli {
namespace {

using ::testing::HasSubstr;

class TablesCommand : public ProgramTest {
 protected:
  void expect_refused(const std::vector<std::string>& arguments, const std::string& words) {
    const Outcome outcome = run(arguments, 20);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_TRUE(files().empty());
  }
};

TEST_F(TablesCommand, WhatIsNotReproducedIsSaidInOneLine) {
  expect_refused({"tables", "P3", "--out", "out"}, "P3 is not reproduced by this build");
}

TEST_F(TablesCommand, AMeshThatIsNotThereIsNamed) {
  expect_refused({"tables", "P4", "--mesh", "gone.ply", "--out", "out"}, "gone.ply");
}

TEST_F(TablesCommand, AnUnknownTableNamesTheNearest) {
  expect_refused({"tables", "P22", "--out", "out"}, "did you mean 'P2'?");
}

TEST_F(TablesCommand, AMissingTerrainIsNamed) {
  expect_refused({"tables", "P0", "--terrain", "gone.tif", "--out", "out"}, "gone.tif");
}

TEST_F(TablesCommand, AFolderThatCannotBeIsRefusedBeforeTheWork) {
  expect_refused({"tables", "P0", "--out", "/proc/none"}, "cannot write");
}

TEST_F(TablesCommand, JobsOutOfRangeAreRefused) { expect_refused({"tables", "--jobs", "-1"}, "--jobs"); }

TEST_F(TablesCommand, InterruptedItLeavesWholeFiles) {
  bool asked = false;
  const Outcome outcome = run({"tables", "--out", "out", "--quiet"}, 60, [&](pid_t child) {
    if (asked || !waits_for_interrupt(child)) return;
    asked = true;
    kill(child, SIGINT);
  });
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const auto json = nlohmann::json::parse(read_file(folder() / "out" / "tables.json"));
  EXPECT_EQ(json["schema"], "plumbline.tables/1");
  EXPECT_TRUE(json["tables"].empty());  // none was whole by then
  EXPECT_EQ(nlohmann::json::parse(read_file(folder() / "out" / "tables_timing.json"))["schema"],
            "plumbline.tables_timing/1");
}

TEST_F(TablesCommand, AreListed) {
  const Outcome outcome = run({"list", "tables"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("P0"));
  EXPECT_THAT(outcome.out, HasSubstr("P2"));
}

}  // namespace
}  // namespace plumbline::testing_cli
