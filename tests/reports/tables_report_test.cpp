// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/tables_report.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "scenarios/error.h"

namespace plumbline::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two figures that are printed, one of them wrongly, and one that is not; two views of one terrain.
tables::Table sample_table() {
  tables::Table table;
  table.id = "P9";
  table.title = "A table";
  table.source = "Somebody, somewhere";
  table.protocol = {"What was done."};
  table.notes = {"What was read."};
  tables::StandIn stand_in;
  stand_in.id = "hills";
  stand_in.origin = "made up";
  stand_in.columns = stand_in.rows = 5;
  stand_in.spacing_m = 10;
  stand_in.highest_m = 100;
  table.stand_ins = {stand_in};
  table.figures = {{"7", "triangles", "", 0, tables::Kind::fitted, "23 510", std::nullopt},
                   {"7", "share", "%", 2, tables::Kind::derived, "4.6", 4.484},
                   {"8", "error, \"p99\"", "px", 2, tables::Kind::measured, "", std::nullopt}};
  tables::Trial near, far;
  near.terrain = far.terrain = "hills";
  near.view = "near";
  near.fits = {{"distance", "m", 1234.5, "7", "triangles", 23510, 23508}};
  near.ours = {23508, 8.968, std::nullopt};
  far.view = "far";
  far.fits = {{"distance", "m", 4321, "7", "triangles", 23510, 23511}};
  far.ours = {23511, 2.242, 0.5};
  table.trials = {near, far};
  return table;
}

TEST(TablesMd, ShowsThePaperBesideOursWithTheRatio) {
  const std::string text = tables_md(std::vector{sample_table()});
  EXPECT_THAT(text, HasSubstr("## P9: A table"));
  EXPECT_THAT(text, HasSubstr("4.6 (misprint)"));
  EXPECT_THAT(text, HasSubstr("23 508"));
  EXPECT_THAT(text, ::testing::ContainsRegex("share \\(%\\).*4.48.*8.97.*2.000.*2.24.*0.500"));
  EXPECT_THAT(text, HasSubstr("What was done."));
  EXPECT_THAT(text, HasSubstr("What was read."));
  EXPECT_THAT(text, HasSubstr("1234.5 m"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(TablesMd, RowsOfATableAreOfOneLength) {
  std::istringstream text(tables_md(std::vector{sample_table()}));
  std::size_t bars_before = 0, rows = 0;
  for (std::string line; std::getline(text, line);) {
    const auto bars = static_cast<std::size_t>(std::count(line.begin(), line.end(), '|'));
    if (bars > 0 && bars_before > 0) {
      EXPECT_EQ(bars, bars_before) << line;
      ++rows;
    }
    bars_before = bars;
  }
  EXPECT_GE(rows, 6U);
}

TEST(TablesMd, FitsThatAllViewsShareStandOnce) {
  tables::Table table = sample_table();
  table.trials[1].fits = table.trials[0].fits;
  const std::string text = tables_md(std::vector{table});
  EXPECT_EQ(text.find("1234.5 m"), text.rfind("1234.5 m"));
  EXPECT_THAT(text, ::testing::ContainsRegex("hills +\\| all +\\|"));
}

TEST(TablesJson, HoldsFiguresAndTrials) {
  const auto json = nlohmann::json::parse(tables_json(std::vector{sample_table()}));
  EXPECT_EQ(json["schema"], "plumbline.tables/1");
  const auto& table = json["tables"][0];
  EXPECT_EQ(table["id"], "P9");
  EXPECT_EQ(table["figures"][1]["printed"], "4.6");
  EXPECT_EQ(table["figures"][1]["recomputed"], 4.484);
  EXPECT_EQ(table["figures"][1]["agreement"], "misprint");
  EXPECT_TRUE(table["figures"][2]["printed"].is_null());
  EXPECT_EQ(table["trials"][0]["fits"][0]["reached"], 23508);
  EXPECT_EQ(table["trials"][0]["values"].size(), 3U);
  EXPECT_EQ(table["trials"][0]["values"][1]["ours_to_paper"], 2.0);
  EXPECT_TRUE(table["trials"][0]["values"][2]["ours"].is_null());
  EXPECT_EQ(table["trials"][1]["values"][2]["ours"], 0.5);
}

TEST(TablesJson, NumbersThatAreNotFiniteAreNull) {
  tables::Table table = sample_table();
  table.trials[0].ours[0] = std::numeric_limits<double>::quiet_NaN();
  const auto json = nlohmann::json::parse(tables_json(std::vector{table}));
  EXPECT_TRUE(json["tables"][0]["trials"][0]["values"][0]["ours"].is_null());
}

TEST(TablesCsv, HasALineForEveryFigureAndTrial) {
  const std::string csv = tables_csv(std::vector{sample_table()});
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 3);
  EXPECT_THAT(csv, HasSubstr("P9,hills,near,7,share,%,derived,4.6,4.484,misprint,8.968,"));
  EXPECT_THAT(csv, HasSubstr("\"error, \"\"p99\"\"\",px,measured,,,not checked,0.5,\r\n"));
}

TEST(TablesTiming, StandsApart) {
  tables::Timings timings;
  timings.machine = "a machine";
  timings.jobs = 2;
  timings.entries = {{"P9", "hills", "preprocessing", "10 h", 0.125, 0.25, 120},
                     {"P9", "hills", "more", "", 1, 1, 0}};
  const auto json = nlohmann::json::parse(tables_timing_json(timings));
  EXPECT_EQ(json["schema"], "plumbline.tables_timing/1");
  EXPECT_EQ(json["entries"][0]["paper"], "10 h");
  EXPECT_EQ(json["entries"][0]["wall_s"], 0.125);
  EXPECT_EQ(json["entries"][0]["cpu_s"], 0.25);
  EXPECT_TRUE(json["entries"][1]["paper"].is_null());
  EXPECT_TRUE(json["entries"][1]["peak_mb"].is_null());
  EXPECT_THAT(tables_timing_md(timings),
              ::testing::ContainsRegex("preprocessing .*10 h .*0.125 .*0.250 .*120"));
}

TEST(WriteTables, LeavesFourWholeFiles) {
  std::string name = (std::filesystem::temp_directory_path() / "plumbline-tables-XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const std::filesystem::path folder = name;
  write_tables(std::vector{sample_table()}, {}, folder / "new");
  for (const char* file : {"tables.md", "tables.json", "tables.csv", "tables_timing.json"}) {
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "new" / file)) << file;
  }
  std::ofstream(folder / "file") << "in the way";
  EXPECT_THROW(write_tables(std::vector{sample_table()}, {}, folder / "file"), InputError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace plumbline::reports
