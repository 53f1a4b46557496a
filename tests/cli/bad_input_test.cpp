// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad input through the command line: exactly one line on standard error, exit status 2, nothing left behind,
// at once (CONTRACT "Exit status"). The line must name what is wrong; each test says by which words.

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/cli/suite_text.h"

namespace plumbline::testing_cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A refusal needs no work; the rest is room for a slow, sanitized build on a busy machine.
constexpr double kRefusalLimit_s = 15;

class BadInput : public ProgramTest {
 protected:
  /// The command must be refused with one line that matches, and leave the folder as it was.
  void expect_refused(const std::vector<std::string>& arguments,
                      const ::testing::Matcher<std::string>& message) {
    const std::vector<std::string> before = files();
    const Outcome outcome = run(arguments, 2 * kRefusalLimit_s);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_LT(outcome.seconds, kRefusalLimit_s);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(!outcome.err.empty() && outcome.err.back() == '\n') << outcome.err;
    EXPECT_THAT(outcome.err, message);
    EXPECT_THAT(outcome.err, ::testing::Not(HasSubstr("internal fault")));
    EXPECT_EQ(files(), before);
  }

  void expect_suite_refused(const SuiteText& suite, const ::testing::Matcher<std::string>& message) {
    put("suite.toml", suite.text());
    expect_refused({"run", "suite.toml", "--out", "out"}, message);
  }

  /// A float32 raster that GDAL reads through a VRT, samples in row order from the north.
  void put_raster(const std::string& name, int columns, int rows, const std::vector<float>& samples,
                  const std::string& band_extra = {}) {
    std::string bytes(samples.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    put(name + ".raw", bytes);
    const std::string width = std::to_string(columns), height = std::to_string(rows);
    put(name, "<VRTDataset rasterXSize=\"" + width + "\" rasterYSize=\"" + height +
                  "\">\n  <SRS>EPSG:32633</SRS>\n"
                  "  <GeoTransform>500000, 10, 0, 5000000, 0, -10</GeoTransform>\n"
                  "  <VRTRasterBand dataType=\"Float32\" band=\"1\" subClass=\"VRTRawRasterBand\">\n" +
                  band_extra + "    <SourceFilename relativeToVRT=\"1\">" + name +
                  ".raw</SourceFilename>\n    <ImageOffset>0</ImageOffset>\n"
                  "    <PixelOffset>4</PixelOffset>\n    <LineOffset>" +
                  std::to_string(4 * columns) +
                  "</LineOffset>\n    <ByteOrder>LSB</ByteOrder>\n  </VRTRasterBand>\n</VRTDataset>\n");
  }

  static SuiteText with_file(const std::string& file, const std::string& more = {}) {
    SuiteText suite;
    suite.terrain = "id = \"dem\"\nfile = \"" + file + "\"\nsize = \"native\"\n" + more;
    return suite;
  }
};

// The control: what the tests below spoil is sound, so it is their one change that is refused.
TEST_F(BadInput, TheUnspoiledSuiteRuns) {
  put("suite.toml", SuiteText{}.text());
  const Outcome outcome = run({"run", "suite.toml", "--out", "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder() / "out/results.json"));
}

TEST_F(BadInput, TheUnspoiledRasterRuns) {
  std::vector<float> samples(17 * 17);  // a hill on a plain, so that there are levels of detail to see
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const int x = static_cast<int>(i % 17), y = static_cast<int>(i / 17);
    samples[i] = static_cast<float>(8 * std::max(0, 5 - std::max(std::abs(x - 8), std::abs(y - 8))));
  }
  put_raster("dem.vrt", 17, 17, samples);
  SuiteText suite = with_file("dem.vrt");
  suite.method = "id = \"restricted_quadtree\"\nthresholds_px = [0.5, 8]\n";
  put("suite.toml", suite.text());
  const Outcome outcome = run({"run", "suite.toml", "--out", "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// ---- the command line itself

TEST_F(BadInput, UnknownCommand) { expect_refused({"rnu", "suite.toml"}, HasSubstr("'run'")); }

TEST_F(BadInput, NoCommand) { expect_refused({}, HasSubstr("command")); }

TEST_F(BadInput, UnknownOption) {
  put("suite.toml", SuiteText{}.text());
  expect_refused({"run", "suite.toml", "--ouf", "out"}, HasSubstr("--ouf"));
}

TEST_F(BadInput, OptionWithoutItsValue) {
  put("suite.toml", SuiteText{}.text());
  expect_refused({"run", "suite.toml", "--out"}, HasSubstr("--out"));
}

TEST_F(BadInput, JobsThatAreNoCount) {
  put("suite.toml", SuiteText{}.text());
  for (const char* jobs : {"-1", "two", "1000000000", "1.5", ""}) {
    SCOPED_TRACE(jobs);
    expect_refused({"run", "suite.toml", "--out", "out", "--jobs", jobs}, HasSubstr("--jobs"));
  }
}

TEST_F(BadInput, UnknownInstructionSet) {
  put("suite.toml", SuiteText{}.text());
  expect_refused({"run", "suite.toml", "--out", "out", "--isa", "sse9"}, HasSubstr("sse9"));
}

TEST_F(BadInput, MethodOnTheCommandLineThatTheSuiteLacks) {
  put("suite.toml", SuiteText{}.text());
  expect_refused({"run", "suite.toml", "--out", "out", "--methods", "restricted_quadtee"},
                 HasSubstr("restricted_quadtree"));
}

TEST_F(BadInput, UnknownShelfOfList) { expect_refused({"list", "methds"}, HasSubstr("methods")); }

TEST_F(BadInput, FuzzWithUnknownNames) {
  expect_refused({"fuzz", "--method", "block_bintre", "--cases", "1", "--out", "out"},
                 HasSubstr("block_bintree"));
  expect_refused({"fuzz", "--law", "conformin", "--cases", "1", "--out", "out"}, HasSubstr("conforming"));
}

TEST_F(BadInput, FuzzWithoutAnyWork) {
  expect_refused({"fuzz", "--cases", "0", "--out", "out"}, HasSubstr("--cases"));
  expect_refused({"fuzz", "--cases", "-3", "--out", "out"}, HasSubstr("--cases"));
  expect_refused({"fuzz", "--seconds", "-1", "--out", "out"}, HasSubstr("--seconds"));
  expect_refused({"fuzz", "--seconds", "nan", "--out", "out"}, HasSubstr("seconds"));
}

TEST_F(BadInput, ReplayOfWhatIsNoCase) {
  expect_refused({"replay", "nowhere.toml"}, HasSubstr("nowhere.toml"));
  put("case.toml", "");
  expect_refused({"replay", "case.toml"}, HasSubstr("case.toml"));
  put("case.toml", "[case]\nlwa = \"conforming\"\n");
  expect_refused({"replay", "case.toml"}, HasSubstr("case.toml"));
}

// ---- the suite file

TEST_F(BadInput, MissingSuite) {
  expect_refused({"run", "nowhere.toml", "--out", "out"}, HasSubstr("nowhere.toml"));
}

TEST_F(BadInput, SuiteThatIsAFolder) {
  std::filesystem::create_directory(folder() / "suite.toml");
  expect_refused({"run", "suite.toml", "--out", "out"}, HasSubstr("suite.toml"));
}

TEST_F(BadInput, EmptySuite) {
  put("suite.toml", "");
  expect_refused({"run", "suite.toml", "--out", "out"}, HasSubstr("suite.toml"));
}

TEST_F(BadInput, SuiteThatIsNotToml) {
  put("suite.toml", "[suite]\nname = \"a\nviewport = [64, 48]\n");
  expect_refused({"run", "suite.toml", "--out", "out"}, HasSubstr("suite.toml:2"));
}

TEST_F(BadInput, SuiteOfRandomBytes) {
  std::string bytes;
  for (int i = 0; i < 4096; ++i) bytes.push_back(static_cast<char>((i * 7919 + i / 3) & 0xff));
  put("suite.toml", bytes);
  expect_refused({"run", "suite.toml", "--out", "out"}, HasSubstr("suite.toml"));
}

TEST_F(BadInput, SuiteNestedWithoutEnd) {
  put("suite.toml", "a = " + std::string(100000, '['));
  expect_refused({"run", "suite.toml", "--out", "out"}, HasSubstr("suite.toml"));
}

TEST_F(BadInput, UnknownKeyNamesItsLineAndTheNearestKey) {
  SuiteText suite;
  suite.suite = "name = \"tiny\"\nviewport = [64, 48]\nfov_y_degree = 60\n";
  expect_suite_refused(suite,
                       AllOf(HasSubstr("suite.toml:4"), HasSubstr("fov_y_degree"), HasSubstr("'fov_y_deg'")));
}

TEST_F(BadInput, UnknownKeyInEveryTable) {
  SuiteText suite;
  suite.terrain += "sed = 1\n";
  expect_suite_refused(suite, AllOf(HasSubstr("'sed'"), HasSubstr("'seed'")));
  suite = {};
  suite.trajectory += "frame = 1\n";
  expect_suite_refused(suite, AllOf(HasSubstr("'frame'"), HasSubstr("'frames'")));
  suite = {};
  suite.method += "threshold_px = [1]\n";
  expect_suite_refused(suite, AllOf(HasSubstr("'threshold_px'"), HasSubstr("'thresholds_px'")));
  suite = {};
  suite.gate += "crak = 0\n";
  expect_suite_refused(suite, AllOf(HasSubstr("crak"), HasSubstr("crack")));
  suite = {};
  put("suite.toml", suite.text() + "[[terain]]\nid = \"a\"\n");
  expect_refused({"run", "suite.toml", "--out", "out"}, AllOf(HasSubstr("terain"), HasSubstr("terrain")));
}

TEST_F(BadInput, UnknownNamesAsValues) {
  SuiteText suite;
  suite.method = "id = \"block_bintre\"\nthresholds_px = [1]\n";
  expect_suite_refused(suite, HasSubstr("block_bintree"));
  suite = {};
  suite.method = "id = \"block_bintree:tri_cul\"\nthresholds_px = [1]\n";
  expect_suite_refused(suite, HasSubstr("tri_cull"));
  suite = {};
  suite.method += "options = { no_such_option = 1 }\n";
  expect_suite_refused(suite, HasSubstr("no_such_option"));
  suite = {};
  suite.trajectory = "id = \"a\"\nkind = \"aproach\"\nframes = 2\n";
  expect_suite_refused(suite, HasSubstr("approach"));
  suite = {};
  suite.terrain = "id = \"a\"\ngenerator = \"fbn\"\nsize = 17\n";
  expect_suite_refused(suite, HasSubstr("fbm"));
}

TEST_F(BadInput, WrongTypes) {
  SuiteText suite;
  suite.suite = "name = \"tiny\"\nviewport = \"64x48\"\n";
  expect_suite_refused(suite, AllOf(HasSubstr("suite.toml:3"), HasSubstr("viewport")));
  suite = {};
  suite.suite = "name = 7\n";
  expect_suite_refused(suite, HasSubstr("name"));
  suite = {};
  suite.method = "id = \"full\"\nthresholds_px = [\"two\"]\n";
  expect_suite_refused(suite, HasSubstr("thresholds_px"));
  suite = {};
  suite.trajectory = "id = \"a\"\nkind = \"nadir\"\nframes = 2.5\n";
  expect_suite_refused(suite, HasSubstr("frames"));
}

TEST_F(BadInput, DuplicateIds) {
  const std::string again = "[[terrain]]\n" + SuiteText{}.terrain;
  put("suite.toml", SuiteText{}.text() + again);
  expect_refused({"run", "suite.toml", "--out", "out"}, HasSubstr("hills"));
}

TEST_F(BadInput, NothingToFly) {
  put("suite.toml", "[suite]\nname = \"none\"\n");
  expect_refused({"run", "suite.toml", "--out", "out"}, HasSubstr("terrain"));
  SuiteText suite;
  suite.method = "id = \"full\"\nthresholds_px = []\n";
  expect_suite_refused(suite, HasSubstr("thresholds_px"));
}

TEST_F(BadInput, ThresholdThatIsNotPositiveAndFinite) {
  for (const char* threshold : {"0", "-1", "0.0", "-0.0", "nan", "inf", "-inf"}) {
    SCOPED_TRACE(threshold);
    SuiteText suite;
    suite.method = std::string("id = \"restricted_quadtree\"\nthresholds_px = [2, ") + threshold + "]\n";
    expect_suite_refused(suite, HasSubstr("thresholds_px"));
  }
}

TEST_F(BadInput, GateThatCannotBeJudged) {
  for (const char* limit :
       {"crack = \"a few\"\n", "crack = \"<= 1 tua\"\n", "crack = nan\n", "crack = []\n"}) {
    SCOPED_TRACE(limit);
    SuiteText suite;
    suite.gate = limit;
    expect_suite_refused(suite, HasSubstr("crack"));
  }
}

// ---- sizes

TEST_F(BadInput, AbsurdViewport) {
  for (const char* viewport : {"[0, 48]", "[-64, 48]", "[64]", "[64, 48, 3]", "[1000000000, 1000000000]",
                               "[9223372036854775807, 2]", "[nan, 48]"}) {
    SCOPED_TRACE(viewport);
    SuiteText suite;
    suite.suite = std::string("name = \"tiny\"\nviewport = ") + viewport + "\n";
    expect_suite_refused(suite, HasSubstr("viewport"));
  }
}

TEST_F(BadInput, AbsurdFieldOfView) {
  for (const char* fov : {"0", "-60", "180", "1e300", "nan", "inf"}) {
    SCOPED_TRACE(fov);
    SuiteText suite;
    suite.suite = std::string("name = \"tiny\"\nviewport = [64, 48]\nfov_y_deg = ") + fov + "\n";
    expect_suite_refused(suite, HasSubstr("fov_y_deg"));
  }
}

TEST_F(BadInput, AbsurdTerrainSize) {
  for (const char* size : {"0", "1", "-17", "1000000000", "9223372036854775807", "1e9", "\"natve\""}) {
    SCOPED_TRACE(size);
    SuiteText suite;
    suite.terrain = std::string("id = \"a\"\ngenerator = \"fbm\"\nsize = ") + size + "\n";
    expect_suite_refused(suite, HasSubstr("size"));
  }
}

TEST_F(BadInput, AbsurdSpacing) {
  for (const char* spacing : {"0", "-10", "nan", "inf"}) {
    SCOPED_TRACE(spacing);
    SuiteText suite;
    suite.terrain = std::string("id = \"a\"\ngenerator = \"fbm\"\nsize = 17\nspacing_m = ") + spacing + "\n";
    expect_suite_refused(suite, HasSubstr("spacing_m"));
  }
}

TEST_F(BadInput, AbsurdNumberOfFrames) {
  for (const char* frames : {"0", "-1", "2000000000", "9223372036854775807"}) {
    SCOPED_TRACE(frames);
    SuiteText suite;
    suite.trajectory = std::string("id = \"a\"\nkind = \"nadir\"\nframes = ") + frames + "\n";
    expect_suite_refused(suite, HasSubstr("frames"));
  }
}

// ---- cameras

TEST_F(BadInput, CameraInsideTheGround) {
  SuiteText suite;
  suite.terrain = "id = \"a\"\ngenerator = \"plane\"\nsize = 17\nspacing_m = 10\n";
  suite.trajectory =
      "id = \"a\"\nkind = \"poses\"\n"
      "poses = [{ position = [80, 80, 500], look_at = [80, 90, 0] },\n"
      "         { position = [80, 80, -5000], look_at = [80, 90, 0] }]\n";
  expect_suite_refused(suite, HasSubstr("ground"));
}

TEST_F(BadInput, CameraWithoutADirection) {
  SuiteText suite;
  suite.trajectory =
      "id = \"a\"\nkind = \"poses\"\nposes = [{ position = [80, 80, 500], look_at = [80, 80, 500] }]\n";
  expect_suite_refused(suite, HasSubstr("look_at"));
}

TEST_F(BadInput, CameraThatIsNowhere) {
  for (const char* pose :
       {"{ position = [nan, 80, 500], look_at = [80, 90, 0] }",
        "{ position = [80, inf, 500], look_at = [80, 90, 0] }",
        "{ position = [80, 500], look_at = [80, 90, 0] }", "{ position = [80, 80, 500] }", "7"}) {
    SCOPED_TRACE(pose);
    SuiteText suite;
    suite.trajectory = std::string("id = \"a\"\nkind = \"poses\"\nposes = [") + pose + "]\n";
    expect_suite_refused(suite, HasSubstr("pose"));
  }
}

// ---- rasters

TEST_F(BadInput, MissingRaster) { expect_suite_refused(with_file("nowhere.tif"), HasSubstr("nowhere.tif")); }

TEST_F(BadInput, EmptyRaster) {
  put("dem.tif", "");
  expect_suite_refused(with_file("dem.tif"), HasSubstr("dem.tif"));
}

TEST_F(BadInput, RasterThatIsSomethingElse) {
  put("dem.tif", "this is a letter, not a map\n");
  expect_suite_refused(with_file("dem.tif"), HasSubstr("dem.tif"));
}

TEST_F(BadInput, RasterOfOneSample) {
  put_raster("dem.vrt", 1, 1, {5.0F});
  expect_suite_refused(with_file("dem.vrt"), HasSubstr("dem.vrt"));
}

TEST_F(BadInput, RasterOfOneRow) {
  put_raster("dem.vrt", 17, 1, std::vector<float>(17, 5.0F));
  expect_suite_refused(with_file("dem.vrt"), HasSubstr("dem.vrt"));
}

TEST_F(BadInput, RasterWithNaN) {
  std::vector<float> samples(17 * 17, 5.0F);
  samples[20] = std::numeric_limits<float>::quiet_NaN();
  put_raster("dem.vrt", 17, 17, samples);
  expect_suite_refused(with_file("dem.vrt"), AllOf(HasSubstr("dem"), HasSubstr("holes")));
}

TEST_F(BadInput, RasterWithInfinity) {
  for (const float infinite :
       {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    std::vector<float> samples(17 * 17, 5.0F);
    samples[20] = infinite;
    put_raster("dem.vrt", 17, 17, samples);
    expect_suite_refused(with_file("dem.vrt"), AllOf(HasSubstr("dem"), HasSubstr("holes")));
  }
}

// No policy can mend a raster of holes alone.
TEST_F(BadInput, RasterOfNoDataAlone) {
  put_raster("dem.vrt", 17, 17, std::vector<float>(17 * 17, -9999.0F),
             "    <NoDataValue>-9999</NoDataValue>\n");
  for (const char* holes : {"", "holes = \"refuse\"\n", "holes = \"crop\"\n", "holes = \"fill\"\n"}) {
    SCOPED_TRACE(holes);
    expect_suite_refused(with_file("dem.vrt", holes), HasSubstr("dem"));
  }
}

TEST_F(BadInput, UnknownHolePolicy) {
  put_raster("dem.vrt", 17, 17, std::vector<float>(17 * 17, 5.0F));
  expect_suite_refused(with_file("dem.vrt", "holes = \"cropp\"\n"), HasSubstr("crop"));
}

// A header may promise what no machine can hold; the samples behind it are not there either.
TEST_F(BadInput, RasterOfAbsurdSize) {
  put_raster("dem.vrt", 500000000, 500000000, {5.0F});
  expect_suite_refused(with_file("dem.vrt"), HasSubstr("dem.vrt"));
}

TEST_F(BadInput, RasterWhoseSamplesAreMissing) {
  put_raster("dem.vrt", 17, 17, std::vector<float>(17 * 17, 5.0F));
  std::filesystem::remove(folder() / "dem.vrt.raw");
  expect_suite_refused(with_file("dem.vrt"), HasSubstr("dem.vrt"));
}

// ---- output (a regular file stands where a folder is needed, so even root is refused)

TEST_F(BadInput, OutputBelowAFile) {
  put("suite.toml", SuiteText{}.text());
  put("file", "mine");
  expect_refused({"run", "suite.toml", "--out", "file/out"}, HasSubstr("file/out"));
  EXPECT_EQ(read_file(folder() / "file"), "mine");
}

TEST_F(BadInput, OutputThatIsAFile) {
  put("suite.toml", SuiteText{}.text());
  put("file", "mine");
  expect_refused({"run", "suite.toml", "--out", "file"}, HasSubstr("file"));
  EXPECT_EQ(read_file(folder() / "file"), "mine");
}

TEST_F(BadInput, OutputBelowADevice) {
  put("suite.toml", SuiteText{}.text());
  expect_refused({"run", "suite.toml", "--out", "/dev/null/out"}, HasSubstr("/dev/null/out"));
}

TEST_F(BadInput, FuzzOutputBelowAFile) {
  put("file", "mine");
  expect_refused({"fuzz", "--method", "full", "--cases", "1", "--out", "file/out"}, HasSubstr("file/out"));
}

// Folders that a refused run had to make on the way are gone again.
TEST_F(BadInput, NewFoldersDoNotOutliveARefusal) {
  put("suite.toml", with_file("nowhere.tif").text());
  expect_refused({"run", "suite.toml", "--out", "a/b/c"}, HasSubstr("nowhere.tif"));
}

// What was there before a refused run is still there, whole.
TEST_F(BadInput, RefusalKeepsAnOlderReport) {
  put("suite.toml", SuiteText{}.text());
  ASSERT_EQ(run({"run", "suite.toml", "--out", "out"}).status, 0);
  const std::string older = read_file(folder() / "out/results.json");
  ASSERT_FALSE(older.empty());
  SuiteText suite = with_file("nowhere.tif");
  expect_suite_refused(suite, HasSubstr("nowhere.tif"));
  EXPECT_EQ(read_file(folder() / "out/results.json"), older);
}

}  // namespace
}  // namespace plumbline::testing_cli
