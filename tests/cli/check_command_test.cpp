// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `plumbline check`: exit statuses, options, what it writes and what it says to bad input. What it finds is
// tests/properties/check_acceptance_test.cpp's business.
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace plumbline::testing_cli {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;

const fs::path kData = fs::path(PLUMBLINE_SOURCE_DIR) / "tests/data/check";

class CheckCommand : public ProgramTest {
 protected:
  /// Copies a folder of tests/data/check into the test's, under its last name.
  std::string take(const std::string& name) {
    const fs::path from = kData / name;
    fs::copy(from, folder() / from.filename(), fs::copy_options::recursive);
    return from.filename().string();
  }
  Outcome check(std::vector<std::string> words) {
    words.insert(words.begin(), "check");
    return run(words);
  }
  json checked(std::vector<std::string> words) {
    words.insert(words.end(), {"--json", "out.json", "--quiet"});
    const Outcome outcome = check(words);
    EXPECT_THAT(outcome.err, "");
    return json::parse(read_file(folder() / "out.json"));
  }
  void expect_refused(std::vector<std::string> words, const std::string& message) {
    words.insert(words.end(), {"--json", "refused.json", "--sarif", "refused.sarif", "--report", "refused"});
    const Outcome outcome = check(words);
    EXPECT_EQ(outcome.status, 2) << message;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    for (const char* file : {"refused.json", "refused.sarif", "refused"})
      EXPECT_FALSE(fs::exists(folder() / file)) << file << " after: " << outcome.err;
  }
};

constexpr const char* kSquare = "OFF\n4 2 0\n0 0 0\n8 0 0\n8 8 0\n0 8 0\n3 0 1 2\n3 0 2 3\n";

TEST_F(CheckCommand, StatusIsTheVerdict) {
  put("sound.off", kSquare);
  const Outcome sound = check({"sound.off"});
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_THAT(sound.out, StartsWith("sound.off: SOUND: no crack, hole, overlap or fold\n"));
  take("07_independent_edges/ply");
  const Outcome faulty = check({"ply/west.ply", "ply/east.ply"});
  EXPECT_EQ(faulty.status, 1);
  EXPECT_THAT(
      faulty.out,
      StartsWith("ply/west.ply and 1 more: FAULTY: 1 open seam, worst gap -1 m between west.ply and"));
  EXPECT_EQ(faulty.err, "");
  const Outcome quiet = check({"ply/west.ply", "ply/east.ply", "--quiet"});
  EXPECT_EQ(quiet.status, 1);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(CheckCommand, JsonIsAsTheContractSays) {
  take("03_walls_at_joints/tiles");
  const json out = checked({"tiles"});
  EXPECT_EQ(out["schema"], "plumbline.check/1");
  EXPECT_EQ(out["verdict"], "faulty");
  ASSERT_EQ(out["meshes"].size(), 2u);
  EXPECT_EQ(out["meshes"][0]["file"], "12/4266/3115.terrain");
  EXPECT_EQ(out["meshes"][0]["triangles"], 32);
  EXPECT_EQ(out["meshes"][0]["vertices"], 25);
  for (const char* name : {"crack", "t_junction", "fold_over", "degenerate", "hole", "overlap", "outline",
                           "non_manifold", "duplicate", "non_finite"})
    EXPECT_TRUE(out["conformity"][name].is_number_unsigned()) << name;
  EXPECT_EQ(out["conformity"]["crack"], 5);
  const json& worst = out["findings"][0];
  EXPECT_EQ(worst["code"], 302);
  EXPECT_EQ(worst["kind"], "height_mismatch");
  EXPECT_EQ(worst["mesh"], "12/4266/3115.terrain");
  EXPECT_EQ(worst["other_mesh"], "12/4267/3115.terrain");
  EXPECT_EQ(worst["at"].size(), 3u);
  EXPECT_EQ(worst["gap_m"], -4.0);
  EXPECT_TRUE(out["vertical_m"].is_null());
  EXPECT_TRUE(out["displacement_px"].is_null());
  EXPECT_EQ(out["seams"][0]["state"], "open");
  EXPECT_EQ(out["seams"][0]["must_meet"], true);
  EXPECT_EQ(out["sufficient_skirt_m"], 4.0);

  take("11_declared_error");
  const json over = checked({"11_declared_error/mesh.ply", "--terrain", "11_declared_error/dem.asc",
                             "--camera", "40,-60,120:40,40,55:60:160x120"});
  EXPECT_EQ(over["verdict"], "sound") << "no bound was declared";
  EXPECT_EQ(over["vertical_m"]["max"], 7.25);
  EXPECT_EQ(over["vertical_m"]["at"], json({30, 50}));
  for (const char* name : {"max", "certain_max", "rms", "mean"})
    EXPECT_TRUE(over["vertical_m"][name].is_number()) << name;
  EXPECT_GT(over["displacement_px"]["max"], 1);
}

TEST_F(CheckCommand, SarifForCodeScanning) {
  take("07_independent_edges/ply");
  EXPECT_EQ(check({"ply/west.ply", "ply/east.ply", "--sarif", "deep/out.sarif", "--quiet"}).status, 1);
  const json out = json::parse(read_file(folder() / "deep/out.sarif"));
  EXPECT_EQ(out["version"], "2.1.0");
  const json& results = out["runs"][0]["results"];
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0]["ruleId"], "PL302");
  EXPECT_EQ(results[0]["level"], "error");
  EXPECT_EQ(results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "ply/east.ply");
}

TEST_F(CheckCommand, ReportHasPagePicturesAndSpots) {
  take("11_declared_error");
  const Outcome outcome =
      check({"11_declared_error/mesh.ply", "--terrain", "11_declared_error/dem.asc", "--declared", "5",
             "--camera", "40,-60,120:40,40,55:60:160x120", "--report", "report"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("report: report/check.html\n"));
  for (const char* name : {"check.html", "check.json", "check.sarif", "check.txt"})
    EXPECT_TRUE(fs::is_regular_file(folder() / "report" / name)) << name;
  const std::string page = read_file(folder() / "report/check.html");
  EXPECT_THAT(page, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("</html>"), HasSubstr("--declared 5")));
  EXPECT_FALSE(json::parse(read_file(folder() / "report/check.json")).empty());
  std::size_t spots = 0;
  for (const auto& entry : fs::directory_iterator(folder() / "report/spots")) {
    EXPECT_THAT(read_file(entry.path()), StartsWith("glTF"));
    ++spots;
  }
  EXPECT_GT(spots, 0u);
  for (const std::string& name : files()) EXPECT_THAT(name, Not(HasSubstr(".tmp")));
}

TEST_F(CheckCommand, SkirtsAreWhatTheUserSays) {
  take("19_least_skirt/tiles");
  EXPECT_EQ(check({"tiles", "--quiet"}).status, 1);
  EXPECT_EQ(check({"tiles", "--quiet", "--skirt", "10"}).status, 1);
  EXPECT_EQ(check({"tiles", "--quiet", "--skirt", "18.25"}).status, 0);
  const json cesium = checked({"tiles", "--skirt", "cesium"});
  EXPECT_EQ(cesium["verdict"], "sound");
  EXPECT_NEAR(cesium["meshes"][0]["skirt"]["least_depth_m"], 5 * 77067.34 / 4096, 1e-9) << "level 12";
  EXPECT_EQ(check({"tiles", "--quiet", "--skirt", "18.25", "--strict"}).status, 1)
      << "a covered gap is a hazard";
  put("square.off", kSquare);
  expect_refused({"square.off", "--skirt", "cesium"}, "has no level");
  expect_refused({"square.off", "--skirt", "deep"}, "--skirt");
  expect_refused({"square.off", "--skirt", "-1"}, "give its height in metres, or 'cesium'");
}

TEST_F(CheckCommand, DeclaredIsHeldAgainstTheTerrain) {
  take("11_declared_error");
  const auto status = [&](const std::string& declared) {
    return check({"11_declared_error/mesh.ply", "--terrain", "11_declared_error/dem.asc", "--declared",
                  declared, "--quiet"})
        .status;
  };
  EXPECT_EQ(status("5"), 1);
  EXPECT_EQ(status("7.25"), 0) << "attained exactly";
  EXPECT_EQ(status("7.2"), 1);
  expect_refused({"11_declared_error/mesh.ply", "--declared", "5"}, "against what?");
  expect_refused({"11_declared_error/mesh.ply", "--terrain", "11_declared_error/dem.asc", "--declared", "-5"},
                 "give a bound in metres");
  expect_refused({"11_declared_error/mesh.ply", "--terrain", "11_declared_error/dem.asc", "--declared", "5m"},
                 "give a number");
  expect_refused(
      {"11_declared_error/mesh.ply", "--terrain", "11_declared_error/dem.asc", "--declared", "nan"},
      "give a bound in metres");
}

TEST_F(CheckCommand, ReferenceIsAMesh) {
  take("11_declared_error");
  EXPECT_EQ(check({"11_declared_error/box.off", "--reference", "11_declared_error/box_reference.off",
                   "--declared", "0.1", "--quiet"})
                .status,
            1);
  const json twin = checked({"11_declared_error/box_twin.off", "--reference",
                             "11_declared_error/box_reference.off", "--declared", "0.1"});
  EXPECT_EQ(twin["verdict"], "sound");
  EXPECT_EQ(twin["reference"]["declared"]["holds"], true);
  expect_refused({"11_declared_error/box.off", "--reference", "none.off"}, "none.off");
}

TEST_F(CheckCommand, UpAndUnitAreGuessedAndSaidOtherwise) {
  // The same two strips with y up: what was north runs to −z.
  put("west.off", "OFF\n4 2 0\n0 0 0\n8 0 0\n8 0 -8\n0 0 -8\n3 0 1 2\n3 0 2 3\n");
  put("east.off", "OFF\n4 2 0\n8 10 0\n16 10 0\n16 10 -8\n8 10 -8\n3 0 1 2\n3 0 2 3\n");
  const json guessed = checked({"west.off", "east.off"});
  EXPECT_EQ(guessed["seams"][0]["largest_gap_m"], -10);
  EXPECT_THAT(guessed["notes"].dump(), HasSubstr("up is taken to be y"));
  EXPECT_EQ(checked({"west.off", "east.off", "--up", "y"})["notes"].dump().find("up is taken"),
            std::string::npos);
  EXPECT_DOUBLE_EQ(
      checked({"west.off", "east.off", "--unit", "feet"})["seams"][0]["largest_gap_m"].get<double>(), -3.048);
  EXPECT_DOUBLE_EQ(
      checked({"west.off", "east.off", "--unit", "0.01"})["seams"][0]["largest_gap_m"].get<double>(), -0.1);
  EXPECT_EQ(checked({"west.off", "--kind", "object"})["meshes"][0]["held_as"], "object");
  expect_refused({"west.off", "--up", "w"}, "--up");
  expect_refused({"west.off", "--unit", "0"}, "--unit");
  expect_refused({"west.off", "--unit", "ells"}, "--unit");
  expect_refused({"west.off", "--kind", "terrian"}, "terrain");
}

TEST_F(CheckCommand, CameraSeesTheCliff) {
  take("06_cliff_or_crack/cliff");
  const json out = checked({"cliff/west.off", "cliff/east.off", "--camera", "26,4,9:10,4,6:60:320x240"});
  EXPECT_EQ(out["verdict"], "sound");
  EXPECT_GT(out["image"]["skirt_px"], 1000);
  EXPECT_EQ(check({"cliff/west.off", "cliff/east.off", "--camera", "26,4,9:10,4,6:60:320x240", "--strict",
                   "--quiet"})
                .status,
            1);
  const json away = checked({"cliff/west.off", "cliff/east.off", "--camera", "26,4,9:40,4,9"});
  EXPECT_EQ(away["verdict"], "faulty") << "nothing was judged, which is no pass";
  EXPECT_EQ(away["findings"][0]["code"], 110);
  expect_refused({"cliff/west.off", "--camera", "1,2:3"}, "camera");
  expect_refused({"cliff/west.off", "--camera", "1,2,3:1,2,3"}, "");
}

TEST_F(CheckCommand, BadInputIsOneLineAndNothingIsWritten) {
  put("good.off", kSquare);
  put("empty.ply", "");
  put("short.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty double x\nproperty double "
      "y\nproperty double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n1234");
  put("cut.off", std::string(kSquare).substr(0, 30));
  put("nan.off", "OFF\nnan 2 0\n");
  put("none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
  put("mesh.xyz", "1 2 3\n");
  put("huge.off", "OFF\n99999999999999999999 1 0\n");
  put("bad.terrain", "not a tile");
  put("image.asc", "ncols 2\nthis is no raster\n");
  fs::create_directory(folder() / "nothing");
  fs::create_directory(folder() / "text");
  put("text/readme.txt", "no tiles here\n");
  expect_refused({"empty.ply"}, "empty.ply");
  expect_refused({"short.ply"}, "short.ply");
  expect_refused({"cut.off"}, "cut.off");
  expect_refused({"nan.off"}, "nan.off");
  expect_refused({"none.off"}, "has no triangle");
  expect_refused({"mesh.xyz"}, "mesh.xyz");
  expect_refused({"huge.off"}, "huge.off");
  expect_refused({"bad.terrain"}, "bad.terrain");
  expect_refused({"missing.ply"}, "missing.ply");
  expect_refused({"nothing"}, "nothing");
  expect_refused({"text"}, "text");
  expect_refused({"good.off", "missing.ply"}, "missing.ply");
  expect_refused({"good.off", "--terrain", "missing.tif"}, "missing.tif");
  expect_refused({"good.off", "--terrain", "image.asc"}, "image.asc");
  expect_refused({"good.off", "--terrain", "text"}, "text");
  expect_refused({"good.off", "--placing", "somewhere", "--terrain", "good.off"}, "good.off");
  expect_refused({"good.off", "--holes", "many"}, "--holes");
  expect_refused({"good.off", "--tau", "0"}, "--tau");
  expect_refused({"good.off", "--jobs", "-1"}, "--jobs");
  const Outcome bare = check({});
  EXPECT_EQ(bare.status, 2);
  EXPECT_THAT(bare.err, HasSubstr("mesh"));
}

TEST_F(CheckCommand, WhatCannotBeWrittenIsSaidAndLeavesNothing) {
  put("good.off", kSquare);
  put("file", "in the way\n");
  for (const char* option : {"--json", "--sarif"}) {
    const Outcome outcome = check({"good.off", option, "file/out"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("cannot write"));
  }
  const Outcome report = check({"good.off", "--report", "file"});
  EXPECT_EQ(report.status, 2);
  EXPECT_THAT(report.err, HasSubstr("cannot write"));
  EXPECT_EQ(report.out, "") << "known before the work";
  EXPECT_THAT(files(), ElementsAre("file", "good.off"));
  EXPECT_EQ(read_file(folder() / "file"), "in the way\n");
}

TEST_F(CheckCommand, SameVerdictOnAnyNumberOfThreads) {
  take("05_gap_exceeds_skirt/tiles");
  std::set<std::string> bytes;
  for (const char* jobs : {"1", "2", "7"}) {
    check({"tiles", "--skirt", "5", "--quiet", "--json", "out.json", "--jobs", jobs});
    bytes.insert(read_file(folder() / "out.json"));
  }
  EXPECT_EQ(bytes.size(), 1u);
}

}  // namespace
}  // namespace plumbline::testing_cli
