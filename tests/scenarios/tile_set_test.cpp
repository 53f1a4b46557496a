// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/tiles/tile_set.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "scenarios/random.h"
#include "scenarios/tiles/ecef.h"
#include "tests/scenarios/support.h"

namespace plumbline {
namespace {

using test::input_error;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const TileGrid kTms{};
const TileGrid kXyz{TileProjection::geographic, TileScheme::xyz};
const TileGrid kMercator{TileProjection::mercator, TileScheme::xyz};

TEST(TileAddress, IsTheEndOfAPath) {
  EXPECT_EQ(tile_address("tiles/9/533/383.terrain"), (TileAddress{9, 533, 383}));
  EXPECT_EQ(tile_address("0/0/0.terrain"), (TileAddress{0, 0, 0}));
  for (const char* other :
       {"a/9/x/383.terrain", "9/533/383.png", "533/383.terrain", "9/533/-1.terrain", "9/533/0383.terrain",
        "26/1/1.terrain", "9/4294967296/1.terrain", "9/ 1/1.terrain", ""})
    EXPECT_EQ(tile_address(other), std::nullopt) << other;
  EXPECT_EQ(tile_name({9, 533, 383}), "9/533/383");
}

TEST(TileGrid, RootsAndTheirChildrenAreThoseOfTheSpecification) {
  EXPECT_EQ(kTms.bounds_deg({0, 0, 0}), (TileBounds{-180, -90, 0, 90}));
  EXPECT_EQ(kTms.bounds_deg({0, 1, 0}), (TileBounds{0, -90, 180, 90}));
  EXPECT_EQ(kTms.bounds_deg({1, 1, 0}), (TileBounds{-90, -90, 0, 0}));
  EXPECT_EQ(kTms.bounds_deg({1, 3, 1}), (TileBounds{90, 0, 180, 90}));
  EXPECT_EQ(kXyz.bounds_deg({1, 3, 1}), (TileBounds{90, -90, 180, 0}));
  EXPECT_FALSE(kTms.contains({0, 2, 0}));
  EXPECT_FALSE(kTms.contains({0, 0, 1}));
  EXPECT_FALSE(kMercator.contains({0, 1, 0}));
  EXPECT_TRUE(kMercator.contains({0, 0, 0}));
  // Web Mercator's square: 20037508.34 m, 85.0511°.
  const TileBounds whole = kMercator.bounds_projected({0, 0, 0});
  EXPECT_NEAR(whole.north, 20037508.342789244, 1e-8);
  EXPECT_EQ(whole.west, -whole.east);
  const TileBounds degrees = kMercator.bounds_deg({1, 0, 0});
  EXPECT_NEAR(degrees.north, 85.05112877980659, 1e-13);
  EXPECT_EQ(degrees.south, 0);
  EXPECT_EQ(degrees.west, -180);
  EXPECT_EQ(degrees.east, 0);
}

TEST(TileGrid, NeighboursShareTheirSidesBits) {
  for (const TileGrid& grid : {kTms, kXyz, kMercator}) {
    for (const TileAddress tile :
         {TileAddress{3, 5, 3}, TileAddress{9, 200, 383}, TileAddress{25, 12345678, 3355443}}) {
      const TileBounds b = grid.bounds_deg(tile);
      EXPECT_LT(b.west, b.east);
      EXPECT_LT(b.south, b.north);
      EXPECT_EQ(grid.bounds_deg(*grid.neighbour(tile, TileSide::west)).east, b.west);
      EXPECT_EQ(grid.bounds_deg(*grid.neighbour(tile, TileSide::east)).west, b.east);
      EXPECT_EQ(grid.bounds_deg(*grid.neighbour(tile, TileSide::south)).north, b.south);
      EXPECT_EQ(grid.bounds_deg(*grid.neighbour(tile, TileSide::north)).south, b.north);
      for (const TileSide side : kTileSides) {
        const auto across = static_cast<TileSide>((static_cast<int>(side) + 2) % 4);
        EXPECT_EQ(grid.neighbour(*grid.neighbour(tile, side), across), tile) << tile_side_name(side);
      }
      const TileBounds parent = grid.bounds_deg(*TileGrid::parent(tile));
      EXPECT_TRUE(parent.west <= b.west && b.east <= parent.east && parent.south <= b.south &&
                  b.north <= parent.north);
    }
    const auto children = grid.children({3, 5, 3});
    EXPECT_EQ(grid.bounds_deg(children[0]).south, grid.bounds_deg({3, 5, 3}).south);
    EXPECT_EQ(grid.bounds_deg(children[1]).east, grid.bounds_deg({3, 5, 3}).east);
    EXPECT_EQ(grid.bounds_deg(children[2]).north, grid.bounds_deg({3, 5, 3}).north);
    EXPECT_EQ(grid.bounds_deg(children[3]).west, grid.bounds_deg(children[2]).east);
    for (const TileAddress& child : children) EXPECT_EQ(TileGrid::parent(child), (TileAddress{3, 5, 3}));
  }
  EXPECT_EQ(kTms.neighbour({2, 7, 1}, TileSide::east), (TileAddress{2, 0, 1})) << "the antimeridian";
  EXPECT_EQ(kTms.neighbour({2, 0, 1}, TileSide::west), (TileAddress{2, 7, 1}));
  EXPECT_EQ(kTms.neighbour({2, 0, 3}, TileSide::north), std::nullopt);
  EXPECT_EQ(kXyz.neighbour({2, 0, 0}, TileSide::north), std::nullopt);
  EXPECT_EQ(kXyz.neighbour({2, 0, 3}, TileSide::south), std::nullopt);
  EXPECT_EQ(TileGrid::parent({0, 1, 0}), std::nullopt);
}

TEST(TileGrid, EqualPlacesOfTheLatticeHaveEqualBits) {
  Random random(7);
  for (const TileGrid& grid : {kTms, kXyz}) {
    for (int k = 0; k < 2000; ++k) {
      const int level = static_cast<int>(random.below(25));
      const TileAddress tile{level, static_cast<std::uint32_t>(random.below(grid.columns(level))),
                             static_cast<std::uint32_t>(random.below(TileGrid::rows(level)))};
      // A place of the south-west child is the same place of its parent.
      const auto u = static_cast<std::int32_t>(random.below(16384)),
                 v = static_cast<std::int32_t>(random.below(16384));
      const TileAddress child = grid.children(tile)[0];
      EXPECT_EQ(grid.position_deg(tile, u, v), grid.position_deg(child, 2 * u, 2 * v));
      EXPECT_EQ(grid.lattice(tile, u, v, 25), grid.lattice(child, 2 * u, 2 * v, 25));
      // The east side is the neighbour's west side.
      const auto east = *grid.neighbour(tile, TileSide::east);
      if (east.x == 0) continue;
      EXPECT_EQ(grid.position_deg(tile, kTileSteps, v), grid.position_deg(east, 0, v));
      EXPECT_EQ(grid.lattice(tile, kTileSteps, v, 25), grid.lattice(east, 0, v, 25));
    }
  }
  const TileBounds b = kTms.bounds_deg({9, 533, 383});
  EXPECT_EQ(kTms.position_deg({9, 533, 383}, 0, 0), (Vec2{b.west, b.south}));
  EXPECT_EQ(kTms.position_deg({9, 533, 383}, kTileSteps, kTileSteps), (Vec2{b.east, b.north}));
  EXPECT_EQ(kTms.lattice({1, 3, 1}, kTileSteps, kTileSteps, 3), (Vec2{4 * 32767.0 * 4, 2 * 32767.0 * 4}));
  EXPECT_EQ(kTms.lattice_width(3), 16 * 32767.0);
  EXPECT_EQ(kXyz.lattice({1, 3, 1}, 5, 7, 1), (Vec2{3 * 32767.0 + 5, 7}));
  const TileBounds m = kMercator.bounds_deg({4, 3, 5});
  EXPECT_EQ(kMercator.position_deg({4, 3, 5}, kTileSteps, kTileSteps).y, m.north);
  EXPECT_EQ(kMercator.position_deg({4, 3, 5}, 0, 0), (Vec2{m.west, m.south}));
}

TEST(TileGrid, MercatorIsGdals) {
  OGRSpatialReference degrees, metres;
  ASSERT_EQ(degrees.importFromEPSG(4326), OGRERR_NONE);
  ASSERT_EQ(metres.importFromEPSG(3857), OGRERR_NONE);
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  metres.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> transform(
      OGRCreateCoordinateTransformation(&metres, &degrees));
  ASSERT_NE(transform, nullptr);
  for (std::uint32_t y = 0; y < 16; ++y) {
    const TileBounds plane = kMercator.bounds_projected({4, y, y}), sphere = kMercator.bounds_deg({4, y, y});
    double east = plane.east, north = plane.north;
    ASSERT_TRUE(transform->Transform(1, &east, &north));
    EXPECT_NEAR(sphere.east, east, 1e-12);
    EXPECT_NEAR(sphere.north, north, 1e-12);
  }
}

TEST(Ecef, IsGdalsAndTheFastRouteAgrees) {
  OGRSpatialReference geodetic, geocentric;
  ASSERT_EQ(geodetic.importFromEPSG(4979), OGRERR_NONE);
  ASSERT_EQ(geocentric.importFromEPSG(4978), OGRERR_NONE);
  geodetic.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> transform(
      OGRCreateCoordinateTransformation(&geodetic, &geocentric));
  ASSERT_NE(transform, nullptr);
  EXPECT_EQ(geodetic_to_ecef(0, 0, 5), (Vec3{6378142, 0, 0}));
  EXPECT_NEAR(geodetic_to_ecef(0, 90, 0).z, 6356752.314245179, 1e-9);
  Random random(11);
  for (int k = 0; k < 3000; ++k) {
    const int level = static_cast<int>(random.below(20));
    const TileAddress tile{level, static_cast<std::uint32_t>(random.below(kTms.columns(level))),
                           static_cast<std::uint32_t>(random.below(TileGrid::rows(level)))};
    const double h = random.unit() * 9000 - 400;
    const Vec2 p = kTms.position_deg(tile, random.unit() * kTileSteps, random.unit() * kTileSteps);
    double x = p.x, y = p.y, z = h;
    ASSERT_TRUE(transform->Transform(1, &x, &y, &z));
    const Vec3 exact = geodetic_to_ecef(p.x, p.y, h);
    EXPECT_LT(length(exact - Vec3{x, y, z}), 1e-8);
    const TileEcef earth(kTms.bounds_deg(tile));
    EXPECT_LT(length(earth.at(p.x, p.y, h) - exact), 1e-8);
    EXPECT_NEAR(length(earth.up(p.x, p.y)), 1, 1e-14);
    EXPECT_NEAR(dot(earth.at(p.x, p.y, h + 1) - exact, earth.up(p.x, p.y)), 1, 1e-8);
  }
}

const std::string kLayer =
    R"({"tilejson":"2.1.0","format":"quantized-mesh-1.0","version":"1.0.0","scheme":"tms",
  "projection":"EPSG:4326","minzoom":0,"maxzoom":2,"bounds":[-180,-90,180,90],"extensions":["octvertexnormals"],
  "tiles":["{z}/{x}/{y}.terrain?v={version}"],
  "available":[[{"startX":0,"startY":0,"endX":1,"endY":0}],[{"startX":1,"startY":0,"endX":2,"endY":1}]]})";

TEST(TileLayer, ReadsWhatItSays) {
  const TileLayer layer = parse_tile_layer(kLayer, "layer.json");
  EXPECT_EQ(layer.grid.projection, TileProjection::geographic);
  EXPECT_EQ(layer.grid.scheme, TileScheme::tms);
  EXPECT_EQ(layer.least_level, 0);
  EXPECT_EQ(layer.deepest_level, 2);
  EXPECT_THAT(layer.extensions, ElementsAre("octvertexnormals"));
  EXPECT_TRUE(layer.advertises);
  ASSERT_THAT(layer.available, SizeIs(2));
  EXPECT_EQ(layer.available[1].level, 1);
  EXPECT_EQ(layer.available[1].west, 1u);
  EXPECT_EQ(layer.available[1].last_y, 1u);
  EXPECT_THAT(layer.notes, IsEmpty());
  const TileLayer other =
      parse_tile_layer(R"({"scheme":"slippyMap","projection":"EPSG:3857","tiles":["{z}/{y}/{x}.terrain"],)"
                       R"("parentUrl":"../world","metadataAvailability":10})",
                       "layer.json");
  EXPECT_EQ(other.grid.projection, TileProjection::mercator);
  EXPECT_EQ(other.grid.scheme, TileScheme::xyz);
  EXPECT_FALSE(other.advertises);
  EXPECT_EQ(other.least_level, std::nullopt);
  for (const char* note : {"no format", "{z}/{y}/{x}", "no available", "metadataAvailability", "parentUrl"})
    EXPECT_THAT(other.notes, Contains(HasSubstr(note)));
  const TileLayer empty = parse_tile_layer("{}", "layer.json");
  EXPECT_THAT(empty.notes,
              AllOf(Contains(HasSubstr("EPSG:4326 is assumed")), Contains(HasSubstr("tms is assumed"))));
}

TEST(TileLayer, BadOnesAreOneClearLine) {
  const auto said = [](const std::string& json) {
    return input_error([&] { parse_tile_layer(json, "layer.json"); });
  };
  const auto range = [&](const std::string& text) { return said(R"({"available":[[)" + text + "]]}"); };
  EXPECT_THAT(said(""), HasSubstr("layer.json: the JSON: has a syntax error at byte"));
  EXPECT_THAT(said("[1e999]"), HasSubstr("out of range"));
  EXPECT_THAT(said("[]"), HasSubstr("is no object"));
  EXPECT_THAT(said(std::string(200000, '[')), HasSubstr("syntax error"));
  EXPECT_THAT(said(R"({"format":"heightmap-1.0"})"), HasSubstr("format: 'heightmap-1.0' is not read"));
  EXPECT_THAT(said(R"({"projection":"EPSG:2056"})"), HasSubstr("neither EPSG:4326 nor EPSG:3857"));
  EXPECT_THAT(said(R"({"scheme":7})"), HasSubstr("scheme: is no text"));
  EXPECT_THAT(said(R"({"scheme":"zyx"})"), HasSubstr("neither tms nor slippyMap"));
  EXPECT_THAT(said(R"({"maxzoom":-1})"), HasSubstr("maxzoom: -1 is not a whole number"));
  EXPECT_THAT(said(R"({"bounds":[1,2,3]})"), HasSubstr("bounds: is not a list of four numbers"));
  EXPECT_THAT(said(R"({"bounds":[1,2,3,"4"]})"), HasSubstr("bounds: is not a list of four numbers"));
  EXPECT_THAT(said(R"({"extensions":[1]})"), HasSubstr("extensions:"));
  EXPECT_THAT(said(R"({"available":7})"), HasSubstr("available: is no list of levels"));
  EXPECT_THAT(said(R"({"available":[7]})"), HasSubstr("available[0]: is no list of ranges"));
  EXPECT_THAT(range("7"), HasSubstr("available[0]: has a range without startX"));
  EXPECT_THAT(range(R"({"startX":0,"startY":0,"endX":0})"), HasSubstr("without"));
  EXPECT_THAT(range(R"({"startX":0.5,"startY":0,"endX":0,"endY":0})"), HasSubstr("available[0].startX: 0.5"));
  EXPECT_THAT(range(R"({"startX":1,"startY":0,"endX":0,"endY":0})"), HasSubstr("of 2 × 1 tiles"));
  EXPECT_THAT(range(R"({"startX":0,"startY":0,"endX":4294967295,"endY":4294967295})"),
              HasSubstr("of 2 × 1 tiles"));
  std::string deep = R"({"available":[)";
  for (int k = 0; k < 26; ++k) deep += "[],";
  EXPECT_THAT(said(deep + R"([{"startX":0,"startY":0,"endX":0,"endY":0}]]})"),
              HasSubstr("deeper than level 25"));
}

void put(const test::TemporaryFolder& folder, const std::string& name) {
  std::filesystem::create_directories((folder.path() / name).parent_path());
  folder.write(name, "");
}

TEST(TileSet, ListsTilesInTheirOrderAndMisplacedOnes) {
  const test::TemporaryFolder folder;
  for (const char* name :
       {"10/3/4.terrain", "2/1/3.terrain", "2/1/0.terrain", "2/0/1.terrain", "0/1/0.terrain", "2/8/0.terrain",
        "2/1/notes.terrain", "2/1/x.png", "26/0/0.terrain", "readme/1/1.terrain"})
    put(folder, name);
  folder.write("layer.json", kLayer);
  const TileSet set = read_tile_set(folder.path());
  std::vector<std::string> names;
  for (const TileFile& tile : set.tiles) names.push_back(tile_name(tile.address));
  EXPECT_THAT(names, ElementsAre("0/1/0", "2/0/1", "2/1/0", "2/1/3", "10/3/4"));
  EXPECT_EQ(set.tiles[4].path, folder.path() / "10/3/4.terrain");
  EXPECT_THAT(set.misplaced, ElementsAre(folder.path() / "2/1/notes.terrain", folder.path() / "2/8/0.terrain",
                                         folder.path() / "26/0/0.terrain"));
  EXPECT_EQ(find_tile(set, {2, 1, 3}), &set.tiles[3]);
  EXPECT_EQ(find_tile(set, {2, 1, 2}), nullptr);
  const TileAvailability found = compare_availability(set);
  EXPECT_EQ(found.advertised, 2u + 4u);
  EXPECT_EQ(found.missing, 5u);
  EXPECT_THAT(found.first_missing,
              ElementsAre(TileAddress{0, 0, 0}, TileAddress{1, 1, 0}, TileAddress{1, 1, 1},
                          TileAddress{1, 2, 0}, TileAddress{1, 2, 1}));
  EXPECT_EQ(found.unadvertised, 4u);
  EXPECT_EQ(found.first_unadvertised[0], (TileAddress{2, 0, 1}));
}

TEST(TileSet, FoldersWithoutTilesAreOneClearLine) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(input_error([&] { read_tile_set(folder.path()); }), HasSubstr("holds no tile"));
  EXPECT_THAT(input_error([&] { read_tile_set(folder.path() / "none"); }),
              HasSubstr("is no folder of tiles"));
  put(folder, "0/0/0.terrain");
  const TileSet set = read_tile_set(folder.path());
  EXPECT_THAT(set.layer.notes, ElementsAre(HasSubstr("there is no layer.json")));
  EXPECT_EQ(compare_availability(set).advertised, 0u);
  EXPECT_EQ(compare_availability(set).unadvertised, 0u) << "nothing is advertised";
}

// Overlapping ranges against files, counted tile by tile.
TEST(TileSet, AvailabilityIsThatOfEnumeration) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    TileSet set;
    set.layer.advertises = true;
    std::set<TileAddress> advertised, files;
    for (std::uint64_t k = random.below(6); k > 0; --k) {
      const int level = 2 + static_cast<int>(random.below(2));
      const auto pick = [&](std::uint32_t most) {
        auto a = static_cast<std::uint32_t>(random.below(most)),
             b = static_cast<std::uint32_t>(random.below(most));
        return std::pair(std::min(a, b), std::max(a, b));
      };
      const auto [west, east] = pick(kTms.columns(level));
      const auto [low, high] = pick(TileGrid::rows(level));
      set.layer.available.push_back({level, west, low, east, high});
      for (std::uint32_t x = west; x <= east; ++x) {
        for (std::uint32_t y = low; y <= high; ++y) advertised.insert({level, x, y});
      }
    }
    for (std::uint64_t k = random.below(40); k > 0; --k) {
      const int level = 1 + static_cast<int>(random.below(3));
      files.insert({level, static_cast<std::uint32_t>(random.below(kTms.columns(level))),
                    static_cast<std::uint32_t>(random.below(TileGrid::rows(level)))});
    }
    for (const TileAddress& file : files) set.tiles.push_back({file, ""});
    std::vector<TileAddress> missing, unadvertised;
    std::set_difference(advertised.begin(), advertised.end(), files.begin(), files.end(),
                        std::back_inserter(missing));
    std::set_difference(files.begin(), files.end(), advertised.begin(), advertised.end(),
                        std::back_inserter(unadvertised));
    const TileAvailability found = compare_availability(set);
    EXPECT_EQ(found.advertised, advertised.size());
    EXPECT_EQ(found.missing, missing.size());
    EXPECT_EQ(found.unadvertised, unadvertised.size());
    missing.resize(std::min(missing.size(), TileAvailability::kMostListed));
    EXPECT_EQ(found.first_missing, missing);
    EXPECT_EQ(found.first_unadvertised, unadvertised);
  }
}

TEST(TileSet, HugeRangesCostNothing) {
  std::string json = R"({"available":[)";
  for (int k = 0; k < 25; ++k) json += "[],";
  json += "[";
  for (int k = 0; k < 3000; ++k)
    json += std::string(k == 0 ? "" : ",") + R"({"startX":)" + std::to_string(k) +
            R"(,"startY":0,"endX":67108863,"endY":33554431})";
  TileSet set;
  set.layer = parse_tile_layer(json + "]]}", "layer.json");
  set.tiles.push_back({{25, 5, 5}, ""});
  const TileAvailability found = compare_availability(set);
  EXPECT_EQ(found.advertised, std::uint64_t{1} << 51U);
  EXPECT_EQ(found.missing, (std::uint64_t{1} << 51U) - 1);
  EXPECT_EQ(found.first_missing.front(), (TileAddress{25, 0, 0}));
  EXPECT_THAT(found.first_missing, SizeIs(TileAvailability::kMostListed));
}

}  // namespace
}  // namespace plumbline
