// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/check_report.h"

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "reports/check_page.h"
#include "reports/check_words.h"
#include "reports/json_text.h"
#include "reports/picture.h"
#include "scenarios/error.h"
#include "tests/reports/sample_check.h"

namespace plumbline::reports {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  return out;
}

/// The text without its line breaks, to look for sentences in.
std::string unwrapped(const std::string& text) { return std::regex_replace(text, std::regex("\n +"), " "); }

/// Regenerate by running this test with PLUMBLINE_WRITE_GOLDEN=1; review the difference.
void expect_golden(const std::string& name, const std::string& text) {
  const std::string path = PLUMBLINE_SOURCE_DIR "/tests/reports/golden/" + name;
  if (std::getenv("PLUMBLINE_WRITE_GOLDEN") != nullptr) std::ofstream(path, std::ios::binary) << text;
  std::ifstream file(path, std::ios::binary);
  ASSERT_TRUE(file) << path;
  const std::string golden{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, golden) << name;
}

TEST(CheckText, GoldenTexts) {
  expect_golden("check_sound.txt", check_text(sample::sound_check()));
  expect_golden("check_tiles.txt", check_text(sample::tiles_check()));
  expect_golden("check_terrain.txt", check_text(sample::terrain_check()));
  expect_golden("check_object.txt", check_text(sample::object_check()));
  expect_golden("check_many_tiles.txt", check_text(sample::tiles_check(20, 20)));
}

TEST(CheckText, SoundMeshIsToldInAFewLines) {
  const std::string text = check_text(sample::sound_check());
  EXPECT_LE(lines_of(text).size(), 6u);
  EXPECT_THAT(text, testing::StartsWith("two.ply: SOUND"));
  EXPECT_THAT(unwrapped(text),
              HasSubstr("every point of the rectangle of its box is covered exactly once, edge "
                        "to edge, at equal heights, decided exactly"));
}

TEST(CheckText, NothingIsProvedOfAMeshThatHasAFinding) {
  for (const auto count : {&oracle::ConformityCounts::crack, &oracle::ConformityCounts::t_junction,
                           &oracle::ConformityCounts::overlap, &oracle::ConformityCounts::bad_index}) {
    verdict::CheckVerdict check = sample::sound_check();
    check.meshes[0].conformity.*count = 1;
    EXPECT_THAT(check_text(check), Not(HasSubstr("Proved")));
  }
  verdict::CheckVerdict unused = sample::sound_check();
  unused.meshes[0].conformity.unused_vertex = 1;
  EXPECT_THAT(check_text(unused), HasSubstr("Proved"));
  verdict::CheckVerdict empty = sample::sound_check();
  empty.meshes[0].triangles = 0;
  EXPECT_THAT(check_text(empty), Not(HasSubstr("Proved")));
  verdict::CheckVerdict object = sample::object_check();
  object.meshes[0].self_intersections_judged = false;
  EXPECT_THAT(unwrapped(check_text(object)), Not(HasSubstr("no two triangles meet")));
}

TEST(CheckText, FirstLineNamesWorstPairGapAndPlace) {
  const std::string text = unwrapped(check_text(sample::tiles_check()));
  EXPECT_THAT(text, testing::StartsWith(
                        "9/533/383.terrain and 3 more: FAULTY: 1 open seam, worst gap -12.2 m between "
                        "9/533/383.terrain and 9/534/383.terrain at 7.044237013, 46.05901182, 812.5;"));
}

TEST(CheckText, SeamStatesAreNeverMixed) {
  const std::string text = unwrapped(check_text(sample::tiles_check(), Listing::full));
  EXPECT_THAT(text, HasSubstr("2 watertight, 1 covered by a skirt, 1 open"));
  EXPECT_THAT(text, HasSubstr("open: 9/533/383.terrain | 9/534/383.terrain"));
  EXPECT_THAT(text, HasSubstr("covered by a skirt: 9/533/383.terrain | 9/533/384.terrain"));
  EXPECT_THAT(text, HasSubstr("watertight: 9/534/383.terrain | 9/534/384.terrain"));
  EXPECT_THAT(text,
              HasSubstr("A skirt of 12.3 m below every border covers every gap between meshes; the worst "
                        "pair is 9/533/383.terrain and 9/534/383.terrain."));
}

TEST(CheckText, GapWithinTheTilesRoundingIsCalledThat) {
  verdict::CheckVerdict check = sample::tiles_check();
  EXPECT_THAT(unwrapped(check_text(check)), Not(HasSubstr("no more than their rounding")));
  check.seams[0].largest_gap_m = check.seams[0].quantum_m;
  EXPECT_THAT(unwrapped(check_text(check)), HasSubstr("no more than their rounding"));
}

TEST(CheckText, DeclaredBoundIsAnsweredThreeTimes) {
  const std::string text = unwrapped(check_text(sample::terrain_check()));
  EXPECT_THAT(text, HasSubstr("the declared 2.5 m does not hold between samples: 3 m at 500002, 6.5"));
  EXPECT_THAT(text, HasSubstr("At the DEM's samples it holds: the largest error there is 2.25 m"));
  EXPECT_THAT(text, HasSubstr("Between samples, whichever way the DEM's cells are split, it is broken"));
  EXPECT_THAT(text, HasSubstr("Everywhere, with the DEM read as it is said here, it is broken"));
}

TEST(CheckText, BoundOfAnObjectMayStayUndecided) {
  verdict::CheckVerdict check = sample::object_check();
  EXPECT_THAT(check_text(check), HasSubstr("The declared 1 m holds"));
  check.reference->declared_m = 0.8;  // the certified interval is 0.75 to 0.8125
  check.reference->declared_holds = false;
  EXPECT_THAT(check_text(check), HasSubstr("The declared 0.8 m is neither proved nor broken"));
  EXPECT_THAT(check_html(check, {}), HasSubstr(">undecided<"));
  check.reference->declared_broken = true;
  EXPECT_THAT(check_text(check), HasSubstr("The declared 0.8 m is broken"));
}

TEST(CheckText, BetterMatchComesFirst) {
  verdict::CheckVerdict check = sample::terrain_check();
  const std::string before = check_text(check);
  EXPECT_LT(before.find("Findings"), before.find("Against hill.tif"));
  check.terrain->better_match = "rows are flipped";
  const std::string text = check_text(check);
  EXPECT_THAT(unwrapped(text),
              testing::StartsWith("maps/hill & dale.glb: FAULTY: matches the DEM if rows are "
                                  "flipped"));
  EXPECT_LT(text.find("MATCHES IF rows are flipped"), text.find("Findings"));
  EXPECT_THAT(next_steps(check).at(0), HasSubstr("First of all"));
}

TEST(CheckText, LongListsAreCutAndCounted) {
  const verdict::CheckVerdict check = sample::tiles_check(20, 20);
  const std::string brief = check_text(check), full = check_text(check, Listing::full);
  EXPECT_LT(lines_of(brief).size(), 90u);
  EXPECT_GT(lines_of(full).size(), check.seams.size());
  const auto open = seam_totals(check).open;
  EXPECT_THAT(brief, HasSubstr(fmt::format("… and {} more open", open - 6)));
  EXPECT_THAT(full, Not(HasSubstr("…")));
  const auto told = std::ranges::count_if(
      lines_of(full), [](const std::string& line) { return line.starts_with("  open: "); });
  EXPECT_EQ(static_cast<std::size_t>(told), open);
}

TEST(CheckText, AHundredColumns) {
  for (const verdict::CheckVerdict& check :
       {sample::sound_check(), sample::tiles_check(20, 20), sample::terrain_check(), sample::object_check()})
    for (const std::string& line : lines_of(check_text(check)))
      EXPECT_LE(std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }), 100) << line;
}

TEST(CheckText, NothingJudgedIsSaid) {
  EXPECT_THAT(check_text({}), HasSubstr("nothing was judged"));
  verdict::CheckVerdict check = sample::terrain_check();
  check.terrain->vertical_m = {};
  EXPECT_THAT(check_text(check), HasSubstr("nothing was judged: no plan area in common"));
}

TEST(CheckWords, CappedListKeepsCompleteCounts) {
  verdict::CheckVerdict check = sample::tiles_check();
  check.conformity.overlap = 7;
  EXPECT_EQ(group_findings(check).size(), 2u) << "the list is complete, so nothing was left out of it";
  check.findings_total = 500;
  const std::vector<CodeGroup> groups = group_findings(check);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].code, oracle::FindingCode::crack);
  EXPECT_EQ(groups[0].count, check.conformity.crack);
  EXPECT_TRUE(groups[0].exact);
  EXPECT_EQ(groups[1].code, oracle::FindingCode::overlap);
  EXPECT_EQ(groups[1].count, 7u);
  EXPECT_EQ(groups[2].code, oracle::FindingCode::t_junction);
  EXPECT_FALSE(groups[2].exact) << "cracks at T-vertices count there, too";
}

TEST(CheckWords, EveryCodeHasARemedy) {
  for (const oracle::FindingDescription& entry : oracle::finding_catalogue())
    EXPECT_FALSE(code_remedy(entry.code).empty()) << entry.name;
  EXPECT_EQ(code_name(static_cast<oracle::FindingCode>(399)), "finding_399");
  EXPECT_EQ(code_link(static_cast<oracle::FindingCode>(399)), "");
}

using Names = std::vector<std::string>;
Names keys(const Json& object) {
  Names out;
  for (auto member = object.begin(); member != object.end(); ++member) out.push_back(member.key());
  return out;
}

TEST(CheckJson, NamesOfTheContract) {
  const Json read = Json::parse(check_json(sample::terrain_check()));
  EXPECT_THAT(keys(read),
              ElementsAre("schema", "verdict", "headline", "frame", "meshes", "conformity", "tile_faults",
                          "findings_total", "findings", "seam_states", "sufficient_skirt_m", "seams",
                          "vertical_m", "displacement_px", "terrain", "reference", "image", "notes"));
  EXPECT_EQ(read["schema"], "plumbline.check/1");
  EXPECT_EQ(read["verdict"], "faulty");
  EXPECT_EQ(Json::parse(check_json(sample::sound_check()))["verdict"], "sound");
  EXPECT_THAT(keys(read["meshes"][0]),
              ElementsAre("file", "triangles", "vertices", "format", "held_as", "domain", "box", "conformity",
                          "shape", "shortest_edge_m", "median_edge_m", "skirt", "least_skirt_m",
                          "self_intersections"));
  EXPECT_THAT(keys(read["conformity"]),
              ElementsAre("crack", "t_junction", "fold_over", "degenerate", "hole", "overlap", "outline",
                          "non_manifold", "duplicate", "non_finite", "bad_index", "unused_vertex"));
  EXPECT_THAT(keys(read["findings"][0]),
              ElementsAre("code", "name", "kind", "severity", "mesh", "other_mesh", "at", "frame_at",
                          "visibility", "area_m2", "loop", "message"));
  EXPECT_THAT(keys(read["vertical_m"]), ElementsAre("max", "certain_max", "rms", "mean", "at", "certain_at",
                                                    "area_m2", "samples_max", "samples_at"));
  EXPECT_THAT(keys(read["displacement_px"]), ElementsAre("max", "p999", "p99", "rms", "mean",
                                                         "over_threshold", "uncovered_px", "judged_px"));
}

TEST(CheckJson, FiguresStandWhereTheyBelong) {
  const verdict::CheckVerdict check = sample::terrain_check();
  const Json read = Json::parse(check_json(check));
  EXPECT_EQ(read["findings"][0]["at"], Json::array({500006, 4, 2})) << "in the file";
  EXPECT_EQ(read["findings"][0]["frame_at"], Json::array({6, 4, 2}));
  EXPECT_EQ(read["findings"][0]["mesh"], "maps/hill & dale.glb");
  EXPECT_TRUE(read["findings"][0]["other_mesh"].is_null());
  EXPECT_EQ(read["vertical_m"]["max"], 3.25);
  EXPECT_EQ(read["vertical_m"]["at"], Json::array({500002, 7}));
  EXPECT_EQ(read["vertical_m"]["samples_max"], 2.25);
  EXPECT_EQ(read["terrain"]["declared"],
            Json({{"bound_m", 2.5}, {"at_samples", true}, {"certain", false}, {"everywhere", false}}));
  EXPECT_EQ(read["displacement_px"]["p99"], 4);
  EXPECT_EQ(read["image"]["mesh_px"], 61017);
  EXPECT_EQ(read["notes"].size(), 1u);
}

TEST(CheckJson, SeamsAndSkirts) {
  const verdict::CheckVerdict check = sample::tiles_check();
  const Json read = Json::parse(check_json(check));
  EXPECT_EQ(read["seam_states"], Json({{"watertight", 2}, {"covered by a skirt", 1}, {"open", 1}}));
  EXPECT_EQ(read["sufficient_skirt_m"], 12.25);
  const Json& seam = read["seams"][0];
  EXPECT_EQ(seam["mesh"], "9/533/383.terrain");
  EXPECT_EQ(seam["other_mesh"], "9/534/383.terrain");
  EXPECT_EQ(seam["state"], "open");
  EXPECT_EQ(seam["largest_gap_m"], -12.25);
  EXPECT_EQ(seam["largest_at"][2], 812.5);
  EXPECT_EQ(seam["least_skirt_other_m"], 12.25);
  EXPECT_EQ(seam["level"], 9);
  EXPECT_EQ(read["meshes"][0]["skirt"]["least_depth_m"], 10.5);
  EXPECT_EQ(read["findings"][0]["gap_m"], -12.25);
  EXPECT_EQ(read["findings"][0]["other_mesh"], "9/534/383.terrain");
}

TEST(CheckJson, WhatWasNotAskedIsNull) {
  const Json sound = Json::parse(check_json(sample::sound_check()));
  for (const char* part : {"vertical_m", "displacement_px", "terrain", "reference", "image"})
    EXPECT_TRUE(sound[part].is_null()) << part;
  EXPECT_TRUE(sound["meshes"][0]["skirt"].is_null());
  EXPECT_TRUE(sound["meshes"][0]["self_intersections"].is_null());
  const Json object = Json::parse(check_json(sample::object_check()));
  EXPECT_TRUE(object["conformity"]["crack"].is_null()) << "no plan";
  EXPECT_EQ(object["conformity"]["duplicate"], 0);
  EXPECT_EQ(object["meshes"][0]["self_intersections"], 0);
  EXPECT_EQ(object["reference"]["hausdorff_m"]["most"], 0.8125);
  EXPECT_EQ(object["reference"]["declared"]["holds"], true);
}

TEST(CheckJson, NumbersReadBackAndWhatIsNoneIsNull) {
  verdict::CheckVerdict check = sample::tiles_check();
  check.findings[0].at = {0.1 + 0.2, -0.0, std::numeric_limits<double>::infinity()};
  check.seams[0].normal_max_deg = std::numeric_limits<double>::quiet_NaN();
  const Json read = Json::parse(check_json(check));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(read["findings"][0]["at"][0].get<double>()),
            std::bit_cast<std::uint64_t>(0.1 + 0.2));
  EXPECT_FALSE(std::signbit(read["findings"][0]["at"][1].get<double>()));
  EXPECT_TRUE(read["findings"][0]["at"][2].is_null());
  EXPECT_TRUE(read["seams"][0]["normal_max_deg"].is_null());
  EXPECT_EQ(check_json(check), check_json(check));
}

TEST(CheckJson, OneFindingALine) {
  const std::string text = check_json(sample::tiles_check(12, 8));
  std::size_t findings = 0;
  for (const std::string& line : lines_of(text)) findings += line.starts_with("    {\"code\": ") ? 1 : 0;
  EXPECT_EQ(findings, sample::tiles_check(12, 8).findings.size());
}

TEST(CheckPlan, ABoxAMeshAndAPathAState) {
  const auto count = [](const std::string& svg, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
    return n;
  };
  const std::string svg = plan_svg(sample::tiles_check());
  EXPECT_EQ(count(svg, "<rect class=\"mesh\""), 4u);
  EXPECT_EQ(count(svg, "<path class=\"seam"), 3u);
  EXPECT_EQ(count(svg, "<circle class=\"fault\""), 1u);
  EXPECT_EQ(count(svg, "<circle class=\"hazard\""), 1u);

  const std::string many = plan_svg(sample::tiles_check(100, 100));
  EXPECT_EQ(count(many, "class=\"mesh\""), 0u);
  EXPECT_GT(count(many, "<rect class=\"cell open\""), 100u);
  EXPECT_LT(many.size(), 1500000u);
  EXPECT_EQ(plan_svg({}), "");
}

TEST(CheckPlan, NoNumberLeavesThePicture) {
  verdict::CheckVerdict check = sample::tiles_check();
  check.meshes[0].box.low.x = std::numeric_limits<double>::quiet_NaN();
  check.findings[0].finding.at.x = std::numeric_limits<double>::infinity();
  verdict::CheckVerdict point = sample::sound_check();
  point.meshes[0].box = {{5, 5, 0}, {5, 5, 0}};
  for (const std::string& svg : {plan_svg(check), plan_svg(point)}) {
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

TEST(DifferenceMap, SignsHaveColoursAndTheWorstARing) {
  Raster metres(2, 1, -1);
  metres.values[1] = 2;
  const Picture map = difference_map(metres);
  EXPECT_EQ(map.height, 320 + bar_height_px(map.width));
  const Rgb low = map.at(10, 10), high = map.at(map.width - 10, 10);
  EXPECT_GT(low[2], low[0]) << "blue";
  EXPECT_GT(high[0], high[2]) << "red";
  const int x = map.width * 3 / 4, y = 160;
  bool ring = false;
  for (int dx = 0; dx < 40; ++dx) ring = ring || map.at(x + dx, y) == Rgb{255, 255, 255};
  EXPECT_TRUE(ring);

  const Picture nothing = difference_map(Raster(4, 4, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(nothing.at(50, 50), kNotJudged);
  EXPECT_EQ(difference_map(Raster(4, 4, 0)).at(50, 50), (Rgb{247, 247, 247}));
}

class CheckFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              fmt::format("plumbline_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(),
                          getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file()) out.insert(fs::relative(entry.path(), folder_).generic_string());
    return out;
  }

  const verdict::CheckVerdict terrain_ = sample::terrain_check();
  const verdict::CheckPictures pictures_ = sample::check_pictures(terrain_);
  fs::path folder_;
};

TEST_F(CheckFiles, AllOfThemWholeAndNothingElse) {
  write_check_report(terrain_, pictures_, folder_, "plumbline check 'maps/hill & dale.glb'");
  const std::string second = "spots/" + spot_file(pictures_.spots[1]);
  EXPECT_EQ(files(), (std::set<std::string>{"check.html", "check.json", "check.sarif", "check.txt",
                                            "images/check.camera.error.png", "images/check.camera.mesh.png",
                                            "images/check.camera.reference.png", "images/check.error_map.png",
                                            "spots/01-hole.glb", second}));
  EXPECT_EQ(read(folder_ / "check.json"), check_json(terrain_));
  EXPECT_EQ(read(folder_ / "check.sarif"), check_sarif(terrain_));
  EXPECT_EQ(read(folder_ / "check.txt"), check_text(terrain_, Listing::full));
  EXPECT_EQ(read(folder_ / "spots/01-hole.glb"), spot_glb(terrain_, pictures_.spots[0]));
  EXPECT_EQ(read(folder_ / "check.html"),
            check_html(terrain_, pictures_, "plumbline check 'maps/hill & dale.glb'"));
}

TEST_F(CheckFiles, EarlierSpotsAndPicturesGoOtherFilesStay) {
  write_check_report(terrain_, pictures_, folder_);
  std::ofstream(folder_ / "images" / "mine.png") << "mine";
  write_check_report(sample::sound_check(), {}, folder_);
  EXPECT_EQ(files(), (std::set<std::string>{"check.html", "check.json", "check.sarif", "check.txt",
                                            "images/mine.png"}));
}

TEST_F(CheckFiles, FolderThatCannotBeMadeIsRefusedInOneLine) {
  std::ofstream(folder_ / "file") << "in the way";
  try {
    write_check_report(terrain_, pictures_, folder_ / "file" / "out");
    FAIL() << "wrote below a file";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write"));
  }
  EXPECT_EQ(files(), std::set<std::string>{"file"});
}

TEST_F(CheckFiles, NamesOfSpotsStayInTheirFolder) {
  verdict::CheckPictures pictures = pictures_;
  pictures.spots.resize(1);
  pictures.spots[0].name = "../up/50%";
  write_check_report(terrain_, pictures, folder_ / "out");
  EXPECT_TRUE(fs::exists(folder_ / "out/spots/%2E.%2Fup%2F50%25.glb"));
  EXPECT_THAT(read(folder_ / "out/check.html"), HasSubstr("href=\"spots/%252E.%252Fup%252F50%2525.glb\""));
}

TEST_F(CheckFiles, PageFetchesNothingAndRunsNothing) {
  const std::string page = check_html(terrain_, pictures_);
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy\" content=\"default-src 'none'"));
  for (const char* pattern : {"<script", "<link\\b", "<iframe", "\\ssrc=\"(?!data:)", "@import", "url\\(",
                              "href=\"(?!#|spots/)", "\\son[a-z]+="})
    EXPECT_FALSE(std::regex_search(page, std::regex(pattern))) << pattern;
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme:dark"));
  EXPECT_THAT(page, HasSubstr("@media print"));
}

TEST_F(CheckFiles, PageHasItsParts) {
  const std::string page = check_html(terrain_, pictures_, "plumbline check a.ply --declared 2.5");
  for (const char* part :
       {"id=\"map\"", "id=\"findings\"", "id=\"terrain\"", "id=\"camera\"", "id=\"meshes\"", "id=\"notes\"",
        "id=\"what-303\"", "href=\"spots/01-hole.glb\"", "<pre>plumbline check a.ply --declared 2.5</pre>"})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(check_html(sample::tiles_check(), {}), HasSubstr("id=\"seams\""));
  EXPECT_THAT(check_html(sample::object_check(), {}), HasSubstr("id=\"reference\""));
  EXPECT_THAT(check_html(sample::sound_check(), {}), HasSubstr("<pre>plumbline check two.ply</pre>"));
}

TEST_F(CheckFiles, NamesCannotBreakOutOfThePage) {
  verdict::CheckVerdict check = terrain_;
  const std::string bad = "</style><script>alert(1)</script>\"'<!--";
  check.meshes[0].file = check.findings[0].message = check.findings[0].finding.kind = bad;
  check.terrain->file = check.terrain->reading = check.terrain->better_match = check.frame = bad;
  check.notes = {bad};
  EXPECT_THAT(check_html(check, pictures_, bad), Not(HasSubstr("<script")));
}

TEST_F(CheckFiles, PageOfManyTilesStaysSmall) {
  EXPECT_LT(check_html(sample::tiles_check(100, 100), {}).size(), 2500000u);
}

}  // namespace
}  // namespace plumbline::reports
