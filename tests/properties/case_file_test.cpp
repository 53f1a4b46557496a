// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Case files: what is written reads back to the same bits, what is malformed is refused in one line, a replay
// says whether the stored verdict came out again. And the atlas: every case in it comes out as stored.

#include "properties/atlas/case_file.h"

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/laws/generators.h"
#include "scenarios/error.h"

namespace plumbline::properties {
namespace {

const std::filesystem::path kAtlas = std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "properties" / "atlas";

/// METHODS M4.S1: 5 × 5 samples, 10 m apart, z = 11·i, 3 m more at node (2, 1), seen from (20, 20, 304)
/// straight down.
Case steep_case() {
  Case c;
  c.law = "conforming";
  c.input.method = "block_bintree";
  Terrain& terrain = c.input.terrain;
  terrain.columns = terrain.rows = 5;
  terrain.spacing_m = 10;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) terrain.heights_m.push_back(11 * i);
  }
  terrain.heights_m[terrain.index(2, 1)] += 3;
  c.input.poses = {{{20, 20, 304}, {20, 20, 0}}};
  c.input.fov_y_deg = 90;
  c.input.width_px = c.input.height_px = 186;
  c.input.threshold_px = 1;
  return c;
}

TEST(CaseFile, M4_S1_ComesOutAsMethodsTellsIt) {
  const Case c = steep_case();
  const LawOutcome split_test = judge(find_law("M4_C3_split_test_is_monotone"), c.input);
  EXPECT_EQ(split_test.kind, LawOutcome::Kind::violated);
  EXPECT_EQ(split_test.what,
            "node (2, 1) splits (e 3 m, depth 279 m), its parent (1, 1) does not (e 3.15 m, depth 293 m)");
  const LawOutcome crack = judge(find_law("conforming"), c.input);
  EXPECT_EQ(crack.kind, LawOutcome::Kind::violated);
  ASSERT_TRUE(crack.finding);
  EXPECT_EQ(crack.finding->code, oracle::FindingCode::crack);
  EXPECT_EQ(crack.finding->at, (Vec3{20, 10, 25}));
  EXPECT_EQ(std::fabs(crack.finding->gap_m), 3);
  EXPECT_THAT(crack.what, testing::HasSubstr("gap 3 m = 1 px = 1 tau at depth 279 m"));
}

TEST(CaseFile, ReadsBackToTheSameBits) {
  Case c = steep_case();
  c.note = "quotes \" and \\ and a tab \t and ü";
  c.input.options["depth_ratio"] = 0.1;
  c.input.options["cull"] = false;
  c.input.options["cluster_size"] = 5.0;
  c.input.options["a key.with \"all\""] = 1.0;  // as a key's name stood, it did not read back
  const double awkward[] = {0.1,
                            -0.0,
                            1e300,
                            5e-324,
                            1.0 / 3,
                            123456789012345678.0,
                            -7,
                            0x1p53,
                            std::numeric_limits<double>::min(),
                            std::nextafter(1.0, 2.0)};
  std::size_t k = 0;
  for (const double x : awkward) c.input.terrain.heights_m[k++] = x;
  c.input.poses.push_back({{1.0 / 3, -0.0, 1e17}, {0.1, 0.2, 0.30000000000000004}});
  c.input.threshold_px = 0.1 + 0.2;
  c.expected = judge(find_law(c.law), steep_case().input);

  const std::string text = case_text(c);
  const Case back = parse_case(text, "memory");
  EXPECT_EQ(case_text(back), text);
  EXPECT_EQ(back.note, c.note);
  EXPECT_EQ(back.law, c.law);
  EXPECT_EQ(back.input.method, c.input.method);
  EXPECT_EQ(back.input.options, c.input.options);
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  ASSERT_EQ(back.input.terrain.heights_m.size(), c.input.terrain.heights_m.size());
  for (std::size_t n = 0; n < c.input.terrain.heights_m.size(); ++n) {
    EXPECT_EQ(bits(back.input.terrain.heights_m[n]), bits(c.input.terrain.heights_m[n])) << n;
  }
  ASSERT_EQ(back.input.poses.size(), 2u);
  EXPECT_EQ(bits(back.input.poses[1].position.y), bits(-0.0));
  EXPECT_EQ(back.input.poses[1].look_at, c.input.poses[1].look_at);
  EXPECT_EQ(bits(back.input.threshold_px), bits(c.input.threshold_px));
  ASSERT_TRUE(back.expected.finding);
  EXPECT_EQ(back.expected.what, c.expected.what);
  EXPECT_EQ(back.expected.finding->code, c.expected.finding->code);
  EXPECT_EQ(back.expected.finding->kind, c.expected.finding->kind);
  EXPECT_EQ(back.expected.finding->at, c.expected.finding->at);
  EXPECT_EQ(bits(back.expected.finding->gap_m), bits(c.expected.finding->gap_m));
}

TEST(CaseFile, RandomCasesReadBack) {
  for (std::uint64_t k = 0; k < 100; ++k) {
    Case c;
    c.input = draw_case("block_bintree", 31, k).input;
    c.law = "conforming";
    c.expected = judge(find_law(c.law), c.input);
    const std::string text = case_text(c);
    const Case back = parse_case(text, "memory");
    EXPECT_EQ(case_text(back), text);
    EXPECT_TRUE(replay(back).confirmed) << replay(back).difference;
  }
}

TEST(CaseFile, ReplayTellsWhatDiffers) {
  Case c = steep_case();
  c.expected = judge(find_law(c.law), c.input);
  EXPECT_TRUE(replay(c).confirmed);
  const auto differs = [](const Case& changed, const char* what) {
    const ReplayResult result = replay(changed);
    EXPECT_FALSE(result.confirmed) << what;
    EXPECT_THAT(result.difference, testing::HasSubstr(what));
  };
  Case other = c;
  other.expected.kind = LawOutcome::Kind::held;
  differs(other, "outcome is violated, stored is held");
  other = c;
  other.expected.finding->gap_m = std::nextafter(other.expected.finding->gap_m, 1e9);
  differs(other, "gap of");
  other = c;
  other.expected.finding->at.z += 1;
  differs(other, "finding at");
  other = c;
  other.expected.finding->code = oracle::FindingCode::hole;
  differs(other, "stored is 303");
  other = c;
  other.expected.what = "something else";
  differs(other, "something else");
  other = c;
  other.expected.finding.reset();
  differs(other, "none is stored");
}

TEST(CaseFile, TerrainMayComeFromAGenerator) {
  std::string text = case_text(steep_case());
  const std::size_t begin = text.find("[terrain]"), end = text.find("[[pose]]");
  text.replace(begin, end - begin, "[terrain]\ngenerator = \"fbm\"\nseed = 3\nsize = 9\nspacing_m = 30\n\n");
  const Case c = parse_case(text, "memory");
  EXPECT_EQ(c.input.terrain.columns, 9);
  EXPECT_EQ(c.input.terrain.spacing_m, 30);
  EXPECT_EQ(case_text(parse_case(case_text(c), "again")), case_text(c));
}

struct Malformed {
  const char* name;
  const char* from;  ///< replaced by …
  const char* to;
  const char* says;  ///< in the complaint
};

class MalformedCase : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedCase, IsRefusedInOneLine) {
  Case c = steep_case();
  c.expected = judge(find_law(c.law), c.input);
  std::string text = case_text(c);
  const std::size_t at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, std::string(GetParam().from).size(), GetParam().to);
  try {
    parse_case(text, "bad.toml");
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("bad.toml"));
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().says));
    EXPECT_THAT(std::string(error.what()), testing::Not(testing::HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    CaseFile, MalformedCase,
    testing::Values(Malformed{"NotToml", "schema =", "schema", "bad.toml"},
                    Malformed{"OtherSchema", "plumbline.case/1", "plumbline.case/9", "plumbline.case/1"},
                    Malformed{"UnknownKey", "threshold_px", "treshold_px", "threshold_px"},
                    Malformed{"UnknownLaw", "\"conforming\"", "\"conformin\"", "conforming"},
                    Malformed{"UnknownMethod", "\"block_bintree\"", "\"block_bintre\"", "block_bintree"},
                    Malformed{"NegativeThreshold", "threshold_px = 1", "threshold_px = -1", "threshold_px"},
                    Malformed{"ThresholdIsText", "threshold_px = 1", "threshold_px = \"1\"", "threshold_px"},
                    Malformed{"ViewportOfOne", "[186, 186]", "[186]", "viewport"},
                    Malformed{"RowMissing", "rows = 5", "rows = 6", "rows"},
                    Malformed{"SampleMissing", "[0, 11, 22, 33, 44]", "[0, 11, 22, 33]", "samples_m"},
                    Malformed{"SampleNotFinite", "[0, 11, 22, 33, 44]", "[0, nan, 22, 33, 44]", "samples_m"},
                    Malformed{"HugeGrid", "columns = 5", "columns = 1000000000", "columns"},
                    Malformed{"NoPose", "[[pose]]\nposition = [20, 20, 304]\nlook_at = [20, 20, 0]\n", "",
                              "pose"},
                    Malformed{"PoseOfTwo", "[20, 20, 304]", "[20, 20]", "position"},
                    Malformed{"UnknownOutcome", "\"violated\"", "\"violate\"", "violated"},
                    Malformed{"UnknownCode", "code = 302", "code = 399", "code"},
                    Malformed{"ViolatedWithoutFinding",
                              "code = 302 # crack\nkind = \"t_vertex\"\nat = [20, 10, 25]\n", "", "finding"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(CaseFile, MissingFileIsRefused) { EXPECT_THROW(load_case("/nowhere/case.toml"), InputError); }

TEST(Atlas, EveryCaseComesOutAsStored) {
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kAtlas)) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const Case c = load_case(entry.path());
    EXPECT_FALSE(c.note.empty());
    const ReplayResult result = replay(c);
    EXPECT_TRUE(result.confirmed) << result.difference;
    // The text in the repository is what write_case would write: no hand-made drift.
    std::ifstream file(entry.path());
    const std::string stored((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_EQ(case_text(c), stored);
    ++cases;
  }
  EXPECT_GE(cases, 5);
}

TEST(Atlas, M4_S1_IsThere) {
  const Case stored = load_case(kAtlas / "m4_s1_5x5.toml");
  EXPECT_EQ(stored.input.terrain.heights_m, steep_case().input.terrain.heights_m);
  EXPECT_EQ(stored.input.terrain.spacing_m, 10);
  ASSERT_TRUE(stored.expected.finding);
  EXPECT_EQ(std::fabs(stored.expected.finding->gap_m), 3);
}

}  // namespace
}  // namespace plumbline::properties
