// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each kind is planted alone into a tile that is clean; then it is the only finding, with its witnesses.
#include "oracle/tile_conformance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/tile_support.h"

namespace plumbline::oracle {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kCells = 8;
const TileGrid kGrid{};
const TileAddress kPlace{9, 533, 383};
const TileBounds kBounds = kGrid.bounds_deg(kPlace);

QuantizedMesh clean(const TileAddress& place = kPlace) {
  return test::regular_tile(kGrid, place, kCells, test::hills_m, true);
}

std::uint32_t vertex_at(const QuantizedMesh& tile, std::int32_t u, std::int32_t v) {
  for (std::uint32_t i = 0; i < tile.vertices(); ++i) {
    if (tile.u[i] == u && tile.v[i] == v) return i;
  }
  ADD_FAILURE() << "no vertex at " << u << " " << v;
  return 0;
}

/// Steps of a column or row of the clean tile.
std::int32_t line(int k) { return (2 * k * kTileSteps + kCells) / (2 * kCells); }

/// Findings without those of another kind than `kind`: then the test shows that there is none.
TileFinding only(const QuantizedMesh& tile, const std::string& kind, Severity severity,
                 const std::optional<TileBounds>& bounds = kBounds) {
  const auto found = check_tile(tile, bounds);
  for (const TileFinding& f : found) EXPECT_EQ(f.finding.kind, kind) << f.text;
  if (found.size() != 1) {
    ADD_FAILURE() << found.size() << " findings";
    return {};
  }
  EXPECT_EQ(found[0].finding.code, FindingCode::tile_encoding);
  EXPECT_EQ(found[0].finding.severity, severity);
  EXPECT_FALSE(found[0].text.empty());
  return found[0];
}

TEST(TileConformance, GoodTilesHaveNoFindingAtAnyLevel) {
  for (const TileAddress place : {TileAddress{0, 0, 0}, TileAddress{0, 1, 0}, TileAddress{3, 15, 7}, kPlace,
                                  TileAddress{20, 1092123, 784512}}) {
    const QuantizedMesh tile = clean(place);
    EXPECT_THAT(check_tile(tile, kGrid.bounds_deg(place)), IsEmpty()) << tile_name(place);
    EXPECT_THAT(check_tile(tile, std::nullopt), IsEmpty());
    const QuantizedMesh read = parse_quantized_mesh(encode_quantized_mesh(tile), "a.terrain");
    EXPECT_THAT(check_tile(read, kGrid.bounds_deg(place)), IsEmpty()) << tile_name(place);
  }
  const QuantizedMesh flat = test::regular_tile(kGrid, kPlace, 1, [](double, double) { return 440.0; });
  EXPECT_THAT(check_tile(flat, kBounds), IsEmpty());
}

TEST(TileConformance, CornerMissing) {
  QuantizedMesh tile = clean();
  const std::uint32_t corner = vertex_at(tile, kTileSteps, 0);
  const auto uses = [&](const auto& t) { return std::find(t.begin(), t.end(), corner) != t.end(); };
  ASSERT_EQ(std::count_if(tile.triangles.begin(), tile.triangles.end(), uses), 1) << "the cells' diagonals";
  tile.triangles.erase(std::find_if(tile.triangles.begin(), tile.triangles.end(), uses));
  const TileFinding found = only(tile, "corner_missing", Severity::fault);
  EXPECT_EQ(found.finding.at.x, kTileSteps);
  EXPECT_EQ(found.finding.at.y, 0);
  EXPECT_THAT(found.text, HasSubstr("southeast corner"));
  EXPECT_THAT(found.finding.vertices, SizeIs(2)) << "the cut's ends";
  EXPECT_THAT(found.finding.triangles, SizeIs(1));
  EXPECT_THAT(check_tile(QuantizedMesh{}, kBounds), SizeIs(4));
}

TEST(TileConformance, OffBorderBesideTheBorderAndInside) {
  QuantizedMesh tile = clean();
  const std::uint32_t moved = vertex_at(tile, 0, line(3));
  tile.u[moved] = 1;
  test::list_edges(tile);
  const TileFinding border = only(tile, "off_border", Severity::fault);
  EXPECT_THAT(border.finding.vertices, AllOf(SizeIs(3), ::testing::Contains(moved)));
  EXPECT_THAT(border.text, HasSubstr("2 edges"));

  tile = clean();
  tile.triangles.erase(tile.triangles.begin() + 2 * kCells * 4 + 7);  // a triangle in the middle
  const TileFinding hole = only(tile, "off_border", Severity::fault);
  EXPECT_THAT(hole.finding.vertices, SizeIs(3));
  EXPECT_THAT(hole.finding.triangles, SizeIs(3)) << "those around the hole";

  // Two holes are two findings, sorted by place.
  tile.triangles.erase(tile.triangles.begin() + 2 * kCells * 2 + 7);
  const auto two = check_tile(tile, kBounds);
  ASSERT_THAT(two, SizeIs(2));
  EXPECT_LE(two[0].finding.at.x, two[1].finding.at.x);

  // A vertex twice at one place of the lattice is no gap; at two heights it is.
  tile = clean();
  const std::uint32_t middle = vertex_at(tile, line(4), line(4)),
                      twin = static_cast<std::uint32_t>(tile.vertices());
  tile.u.push_back(tile.u[middle]);
  tile.v.push_back(tile.v[middle]);
  tile.height.push_back(tile.height[middle]);
  tile.normals.push_back(tile.normals[middle]);
  int k = 0;
  for (auto& t : tile.triangles) {
    for (auto& i : t) {
      if (i == middle && ++k > 3) i = twin;
    }
  }
  EXPECT_THAT(check_tile(tile, kBounds), IsEmpty());
  tile.height[twin] += tile.height[twin] < 100 ? 1 : -1;
  only(tile, "off_border", Severity::fault);
}

TEST(TileConformance, EdgeLists) {
  const auto west = static_cast<std::size_t>(TileSide::west);
  QuantizedMesh tile = clean();
  const std::uint32_t left_out = tile.edges[west][3];
  tile.edges[west].erase(tile.edges[west].begin() + 3);
  TileFinding found = only(tile, "edge_list", Severity::fault);
  EXPECT_THAT(found.finding.vertices, ElementsAre(left_out));
  EXPECT_THAT(found.text, AllOf(HasSubstr("west"), HasSubstr("1 vertex on that side is not listed")));

  tile = clean();
  const std::uint32_t middle = vertex_at(tile, line(4), line(4));
  tile.edges[west].push_back(middle);
  found = only(tile, "edge_list", Severity::fault);
  EXPECT_THAT(found.finding.vertices, ElementsAre(middle));
  EXPECT_THAT(found.text, HasSubstr("not on that side"));

  tile = clean();
  tile.edges[3].push_back(tile.edges[3].front());
  found = only(tile, "edge_list", Severity::fault);
  EXPECT_THAT(found.text, AllOf(HasSubstr("north"), HasSubstr("again")));

  tile = clean();
  tile.edges[1].push_back(60000);
  found = only(tile, "edge_list", Severity::fault);
  EXPECT_THAT(found.finding.vertices, ElementsAre(60000));
  EXPECT_THAT(found.text, AllOf(HasSubstr("south"), HasSubstr("not there")));

  tile = clean();
  tile.edges[2].clear();
  EXPECT_THAT(only(tile, "edge_list", Severity::fault).finding.vertices, SizeIs(kCells + 1));

  // Sides taken for each other: both lists are wrong, in both ways, but at the corner that they share.
  tile = clean();
  std::swap(tile.edges[0], tile.edges[1]);
  EXPECT_THAT(check_tile(tile, kBounds), SizeIs(4));
}

TEST(TileConformance, IndexThroughTheFile) {
  std::string bytes = encode_quantized_mesh(clean());
  const std::size_t vertices = clean().vertices(), codes = 92 + 6 * vertices + 4;
  bytes[codes + 4] = 100;  // the third code of the first triangle: 0 becomes 100 below the mark
  const auto found = check_tile(parse_quantized_mesh(bytes, "a.terrain"), kBounds);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].finding.kind, "index") << "everything after it is shifted, yet the cause is told alone";
  EXPECT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].finding.triangles.front(), 0u);
  EXPECT_THAT(found[0].text, HasSubstr("names 4294967198 of 81"));

  QuantizedMesh tile = clean();
  tile.triangles[5][1] = static_cast<std::uint32_t>(tile.vertices());
  EXPECT_THAT(only(tile, "index", Severity::fault).finding.triangles, ElementsAre(5));
}

TEST(TileConformance, Range) {
  QuantizedMesh tile = clean();
  const std::uint32_t middle = vertex_at(tile, line(4), line(4));
  tile.height[middle] = kTileSteps + 1;
  EXPECT_THAT(only(tile, "range", Severity::fault).finding.vertices, ElementsAre(middle));
  tile = clean();
  const std::uint32_t border = vertex_at(tile, kTileSteps, line(4));
  tile.u[border] = kTileSteps + 9;
  const TileFinding found = only(tile, "range", Severity::fault);
  EXPECT_THAT(found.finding.vertices, ElementsAre(border));
  EXPECT_EQ(found.finding.at.x, kTileSteps + 9);
  tile.v[middle] = -1;
  EXPECT_THAT(only(tile, "range", Severity::fault).finding.vertices, SizeIs(2));
}

TEST(TileConformance, HeightRange) {
  QuantizedMesh tile = clean();
  std::swap(tile.min_height_m, tile.max_height_m);
  EXPECT_THAT(only(tile, "height_range", Severity::fault).text, HasSubstr("above its greatest"));
  // Ground so steep that heights upside down would leave the ball.
  tile = test::regular_tile(kGrid, {14, 1092, 784}, kCells,
                            [](double x, double y) { return test::hills_m(x, y) * 9; });
  std::swap(tile.min_height_m, tile.max_height_m);
  only(tile, "height_range", Severity::fault, kGrid.bounds_deg({14, 1092, 784}));
  tile = clean();
  tile.sphere_radius_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(only(tile, "height_range", Severity::fault).text, HasSubstr("not finite"));
  tile = clean();
  for (std::int32_t& h : tile.height) h /= 2;
  const TileFinding found = only(tile, "height_range", Severity::hazard);
  EXPECT_THAT(found.text, HasSubstr("0 to 16383 of 32767"));
  EXPECT_EQ(tile.height[found.finding.vertices.at(0)], 16383);
}

TEST(TileConformance, SphereSaysByHowMuch) {
  QuantizedMesh tile = clean();
  const double radius_m = tile.sphere_radius_m;
  tile.sphere_radius_m -= 100;
  TileFinding found = only(tile, "sphere", Severity::fault);
  EXPECT_NEAR(found.finding.gap_m, 100, 1e-6);
  EXPECT_FALSE(found.finding.vertices.empty());
  EXPECT_LT(found.finding.vertices.size(), tile.vertices());
  tile.sphere_radius_m = -1;
  EXPECT_THAT(only(tile, "sphere", Severity::fault).finding.vertices, SizeIs(tile.vertices()));
  // Half a lattice cell is what rounding may cost: half of some 1.2 m each way here.
  tile.sphere_radius_m = radius_m - 0.5;
  EXPECT_THAT(check_tile(tile, kBounds), IsEmpty());
  tile.sphere_radius_m = radius_m - 2;
  EXPECT_NEAR(only(tile, "sphere", Severity::fault).finding.gap_m, 2, 1e-6);
  EXPECT_THAT(check_tile(tile, std::nullopt), IsEmpty()) << "nobody said where the tile is";
  // The tile of another place.
  QuantizedMesh other = clean({9, 100, 300});
  other.normals.clear();  // these would point elsewhere, too
  const auto elsewhere = check_tile(other, kBounds);
  ASSERT_THAT(elsewhere, SizeIs(2));
  EXPECT_EQ(elsewhere[0].finding.kind, "sphere");
  EXPECT_THAT(elsewhere[0].finding.vertices, SizeIs(tile.vertices()));
  EXPECT_EQ(elsewhere[1].finding.kind, "center");
}

TEST(TileConformance, Center) {
  QuantizedMesh tile = clean();
  tile.center = {0, 0, 0};
  EXPECT_NEAR(only(tile, "center", Severity::hazard).finding.distance_m, 6.37e6, 2e4);
}

TEST(TileConformance, Normals) {
  QuantizedMesh tile = clean();
  tile.normals.pop_back();
  EXPECT_THAT(only(tile, "normal", Severity::fault).text, HasSubstr("80 normals for 81 vertices"));
  tile.normals.clear();
  EXPECT_THAT(check_tile(tile, kBounds), IsEmpty());
  tile.extensions = {1};
  EXPECT_THAT(only(tile, "normal", Severity::fault).text, HasSubstr("0 normals"));
  tile = clean();
  tile.normals[7] = {0, 0, 0};
  EXPECT_THAT(only(tile, "normal", Severity::fault, std::nullopt).finding.vertices, ElementsAre(7));
  tile = clean();
  tile.normals[9] = -tile.normals[9];
  EXPECT_THAT(only(tile, "normal", Severity::hazard).finding.vertices, ElementsAre(9));
  // An extension that was never filled in: in the file it is 0 0, a vector along −z.
  std::string bytes = encode_quantized_mesh(clean());
  std::fill(bytes.end() - 2 * 81, bytes.end(), '\0');
  EXPECT_THAT(only(parse_quantized_mesh(bytes, "a"), "normal", Severity::hazard).finding.vertices,
              SizeIs(81));
}

TEST(TileConformance, Trailing) {
  const std::string bytes = encode_quantized_mesh(clean()) + "abc";
  EXPECT_THAT(only(parse_quantized_mesh(bytes, "a"), "trailing", Severity::hazard).text,
              HasSubstr("3 bytes"));
}

TEST(TileConformance, FaultsComeBeforeHazards) {
  QuantizedMesh tile = clean();
  tile.center = {0, 0, 0};
  tile.sphere_radius_m = 1;
  tile.edges[2].clear();
  std::vector<std::string> kinds;
  for (const TileFinding& f : check_tile(tile, kBounds)) kinds.push_back(f.finding.kind);
  EXPECT_THAT(kinds, ElementsAre("edge_list", "sphere", "center"));
}

}  // namespace
}  // namespace plumbline::oracle
