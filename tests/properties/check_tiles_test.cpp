// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sets of quantized-mesh tiles: who is whose neighbour, what hangs below, what is no set.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/check/check.h"
#include "properties/check/tiles.h"
#include "scenarios/error.h"
#include "scenarios/whole_file.h"
#include "tests/properties/corpus_parts.h"
#include "tests/scenarios/support.h"

namespace plumbline {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using verdict::CheckFinding;
using verdict::CheckVerdict;
using verdict::SeamState;

const TileGrid kGeographic{TileProjection::geographic, TileScheme::tms};
const TileGrid kMercator{TileProjection::mercator, TileScheme::tms};

class CheckTiles : public testing::Test {
 protected:
  void put(const TileGrid& grid, const TileAddress& address, const std::function<double(int, int)>& height_m,
           const std::string& set = "tiles") {
    put(address, test::exact_tile(grid, address, 4, 0, height_m), set);
  }
  void put(const TileAddress& address, const QuantizedMesh& tile, const std::string& set = "tiles") {
    write_whole_file(folder_.path() / set / (tile_name(address) + ".terrain"), encode_quantized_mesh(tile));
  }
  void layer(const std::string& json) { write_whole_file(folder_.path() / "tiles/layer.json", json); }

  [[nodiscard]] CheckVerdict judged(CheckRequest request = {}) const {
    if (request.inputs.empty()) request.inputs = {folder_.path() / "tiles"};
    request.pictures = false;
    return check(request).verdict;
  }
  [[nodiscard]] std::string refused(const CheckRequest& request = {}) const {
    try {
      const CheckVerdict verdict = judged(request);
      return "judged " + std::to_string(verdict.meshes.size());
    } catch (const InputError& error) {
      return error.what();
    }
  }

  const test::TemporaryFolder folder_;
};

double flat(int, int) { return 8; }
double raised(int, int) { return 16; }

// The world closes: the last column's eastern side is the first one's western.
TEST_F(CheckTiles, MeetBeyondTheAntimeridian) {
  put(kGeographic, {1, 0, 0}, flat);
  put(kGeographic, {1, 3, 0}, raised);
  const CheckVerdict verdict = judged();
  ASSERT_EQ(verdict.seams.size(), 1U);
  EXPECT_EQ(verdict.seams[0].state, SeamState::open);
  EXPECT_EQ(std::fabs(verdict.seams[0].largest_gap_m), 8);
  EXPECT_FALSE(verdict.sound);
}

TEST_F(CheckTiles, OfTwoLevelsMeetBeyondTheAntimeridianToo) {
  put(kGeographic, {0, 0, 0}, flat);
  put(kGeographic, {1, 3, 0}, raised);
  put(kGeographic, {1, 3, 1}, raised);
  const CheckVerdict verdict = judged();
  std::size_t across = 0;
  for (const auto& seam : verdict.seams) across += seam.level != seam.other_level && seam.largest_gap_m != 0;
  EXPECT_EQ(across, 2U) << "the coarse tile's western side, against two finer ones";
}

TEST_F(CheckTiles, OneTileAroundTheWorldMeetsItself) {
  layer(R"({"format":"quantized-mesh-1.0","projection":"EPSG:3857"})");
  put(kMercator, {0, 0, 0}, [](int column, int) { return column == 4 ? 16.0 : 8.0; });
  const CheckVerdict verdict = judged();
  ASSERT_EQ(verdict.seams.size(), 1U);
  EXPECT_EQ(std::fabs(verdict.seams[0].largest_gap_m), 8);
}

TEST_F(CheckTiles, ColumnsBetweenLevelsOfMercatorAreNotComparedAndSaidSo) {
  layer(R"({"format":"quantized-mesh-1.0","projection":"EPSG:3857"})");
  put(kMercator, {2, 1, 1}, flat);
  put(kMercator, {3, 4, 2}, raised);  // east of it
  put(kMercator, {3, 2, 4}, raised);  // north of it
  const CheckVerdict verdict = judged();
  ASSERT_EQ(verdict.seams.size(), 1U);
  EXPECT_THAT(verdict.notes, Contains(HasSubstr("EPSG:3857 latitude runs evenly inside a tile only")));
}

// One step of the heights' range is rounding, whatever the step: in double it is now a little more, now less.
TEST_F(CheckTiles, OneStepIsRoundingAtEveryHeight) {
  for (const int step : {1, 77, 1000, 9999, 16383, 20001, 32765}) {
    const double height = step / 128.0;
    const test::TemporaryFolder other;
    auto west = test::exact_tile(kGeographic, {3, 1, 1}, 4, 0, [&](int, int) { return height; });
    auto east = test::exact_tile(kGeographic, {3, 2, 1}, 4, 0, [&](int, int) { return height; });
    for (QuantizedMesh* tile : {&west, &east}) {  // a range whose step no double holds
      tile->min_height_m = 0;
      tile->max_height_m = 1000;
    }
    for (const std::uint32_t v : east.edges[0]) ++east.height[v];
    test::set_header(west, kGeographic, {3, 1, 1});
    test::set_header(east, kGeographic, {3, 2, 1});
    put({3, 1, 1}, west);
    put({3, 2, 1}, east);
    const CheckVerdict verdict = judged();
    EXPECT_TRUE(verdict.sound) << step;
    ASSERT_FALSE(verdict.findings.empty()) << step;
    for (const CheckFinding& found : verdict.findings) EXPECT_EQ(found.finding.kind, "quantization") << step;
  }
}

TEST_F(CheckTiles, AHeaderThatIsNoNumberIsAFindingAndNoCrash) {
  QuantizedMesh tile = test::exact_tile(kGeographic, {3, 1, 1}, 4, 0, flat);
  tile.min_height_m = std::numeric_limits<float>::quiet_NaN();
  for (auto& step : tile.height) step = kTileSteps;
  put({3, 1, 1}, tile);
  put(kGeographic, {3, 2, 1}, flat);
  const CheckVerdict verdict = judged();
  EXPECT_FALSE(verdict.sound);
  EXPECT_GT(verdict.tile_faults, 0U);
}

TEST_F(CheckTiles, OfTwoSetsAreRefused) {
  put(kGeographic, {3, 1, 1}, flat, "tiles");
  put(kGeographic, {3, 1, 1}, flat, "other");
  CheckRequest request;
  request.inputs = {folder_.path() / "tiles", folder_.path() / "other"};
  EXPECT_THAT(refused(request), HasSubstr("two sets of tiles"));
  request.inputs = {folder_.path() / "tiles", folder_.path() / "tiles/3/1/1.terrain"};
  EXPECT_EQ(refused(request), "judged 2");
}

TEST_F(CheckTiles, OfWhichNoneLiesAnywhereAreRefused) {
  const QuantizedMesh tile = test::exact_tile(kGeographic, {3, 1, 1}, 4, 0, flat);
  write_whole_file(folder_.path() / "tiles/03/0001/0001.terrain", encode_quantized_mesh(tile));
  EXPECT_THAT(refused(), HasSubstr("0001.terrain"));
}

TEST_F(CheckTiles, AStrayOneIsAHazard) {
  put(kGeographic, {3, 1, 1}, flat);
  const QuantizedMesh tile = test::exact_tile(kGeographic, {3, 2, 1}, 4, 0, flat);
  write_whole_file(folder_.path() / "tiles/03/0002/0001.terrain", encode_quantized_mesh(tile));
  const CheckVerdict verdict = judged();
  EXPECT_TRUE(verdict.sound);
  ASSERT_EQ(verdict.findings.size(), 1U);
  EXPECT_EQ(verdict.findings[0].finding.kind, "misplaced_tile");
  EXPECT_THAT(verdict.findings[0].file, HasSubstr("0002/0001.terrain"));
}

// A client that adds a skirt does not take the file's own away.
TEST_F(CheckTiles, AStatedSkirtLeavesADeeperOne) {
  for (const double stated : {0.0, 1.0}) {
    Mesh west = test::sheet_between(0, {{0, 10}, {8, 10}}, 8, {{0, 10}, {8, 10}}, 12);
    const Mesh east = test::sheet_between(8, {{0, 0}, {8, 0}}, 16, {{0, 0}, {8, 0}}, 2);
    const auto is = [&](double x, double y) {
      const auto found =
          std::ranges::find_if(west.positions, [&](const Vec3& p) { return p.x == x && p.y == y; });
      return static_cast<std::uint32_t>(found - west.positions.begin());
    };
    test::hang_skirt(west, {is(8, 0), is(8, 8)}, 50);
    CheckRequest request;
    request.inputs = {folder_.path() / "west.obj", folder_.path() / "east.obj"};
    write_whole_file(request.inputs[0], test::obj_bytes(west));
    write_whole_file(request.inputs[1], test::obj_bytes(east));
    request.up = CheckRequest::Up::z;
    request.kind = CheckRequest::Kind::terrain;
    request.skirt_m = stated;
    const CheckVerdict verdict = judged(request);
    ASSERT_EQ(verdict.seams.size(), 1U);
    EXPECT_EQ(verdict.seams[0].state, SeamState::covered_by_skirt) << stated;
  }
}

// CesiumJS divides by the number of tiles around the world at level 0.
TEST_F(CheckTiles, CesiumsSkirtIsFiveErrorsOfTheLevel) {
  constexpr double kEquatorM = 2 * 3.14159265358979323846 * 6378137.0;
  const auto expected = [&](int tiles, int level) {
    return std::ldexp(5 * kEquatorM * 0.25 / (65 * tiles), -level);
  };
  EXPECT_NEAR(checking::cesium_skirt_m(kGeographic, 0), expected(2, 0), 1);
  EXPECT_NEAR(checking::cesium_skirt_m(kGeographic, 14), expected(2, 14), 1e-3);
  EXPECT_NEAR(checking::cesium_skirt_m(kMercator, 14), expected(1, 14), 1e-3);
}

// Levels lie above each other: the picture shows the deepest.
TEST_F(CheckTiles, ACameraSeesTheDeepestTilesOnly) {
  put(kGeographic, {9, 533, 383}, raised);
  for (const std::uint32_t x : {0U, 1U}) {
    for (const std::uint32_t y : {0U, 1U}) put(kGeographic, {10, 2 * 533 + x, 2 * 383 + y}, flat);
  }
  CheckRequest request;
  request.camera = {{20000, 20000, 40000}, {20000, 20001, 0}, 60, 64, 64};
  const CheckVerdict verdict = judged(request);
  ASSERT_TRUE(verdict.image.has_value());
  EXPECT_GT(verdict.image->mesh_px, 0U);
  EXPECT_THAT(verdict.notes, Contains(HasSubstr("1 tile has deeper ones above it")));
}

}  // namespace
}  // namespace plumbline
