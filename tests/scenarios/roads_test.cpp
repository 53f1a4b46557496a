// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/roads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/suite.h"
#include "scenarios/terrain_source.h"
#include "support.h"

namespace plumbline {
namespace {

using ::testing::HasSubstr;

Terrain ground() {
  TerrainSource source;
  source.id = "ground";
  source.generator = "plane";
  source.size = 101;
  source.spacing_m = 10;
  return load_terrain(source);
}

std::string error_of(const std::filesystem::path& file) {
  try {
    load_roads(file, ground(), "ground");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

using Roads = std::vector<std::vector<Vec2>>;

TEST(LoadRoads, GeoJsonLinesComeAsTheyStand) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("roads.geojson", R"({ "type": "FeatureCollection", "features": [
    { "type": "Feature", "properties": {}, "geometry": { "type": "LineString", "coordinates": [[0, 0], [500.25, 100], [1000, 1000, 7]] } },
    { "type": "Feature", "properties": {}, "geometry": { "type": "MultiLineString", "coordinates": [[[1, 2], [3, 4]], [[5, 6], [7, 8]]] } } ] })");
  EXPECT_EQ(load_roads(file, ground(), "ground"),
            (Roads{{{0, 0}, {500.25, 100}, {1000, 1000}}, {{1, 2}, {3, 4}}, {{5, 6}, {7, 8}}}));
}

TEST(LoadRoads, CsvWithWkt) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("roads.csv", "WKT,name\n\"LINESTRING (10 20, 30.5 40)\",main\n");
  EXPECT_EQ(load_roads(file, ground(), "ground"), (Roads{{{10, 20}, {30.5, 40}}}));
}

TEST(LoadRoads, RefusesWhatAreNoRoads) {
  const test::TemporaryFolder folder;
  const auto geometry = [&](const char* text) {
    return folder.write("one.geojson",
                        std::string(R"({"type":"Feature","properties":{},"geometry":)") + text + "}");
  };
  const auto expect = [](const std::string& error, const char* words) {
    EXPECT_THAT(error, HasSubstr(words));
    EXPECT_EQ(error.find('\n'), std::string::npos);
  };
  expect(error_of(folder.path() / "gone.geojson"), "no such file");
  expect(error_of(folder.write("text.geojson", "not JSON at all")), "GDAL");
  expect(error_of(geometry(R"({"type":"Point","coordinates":[1,2]})")), "roads are lines");
  expect(error_of(geometry(R"({"type":"LineString","coordinates":[[1,2]]})")), "two corners");
  expect(error_of(geometry(R"({"type":"LineString","coordinates":[[1,2],[1001,2]]})")), "off the terrain");
  expect(error_of(geometry(R"({"type":"LineString","coordinates":[[1,2],[1e400,2]]})")), "off the terrain");
  expect(error_of(folder.write("none.geojson", R"({"type":"FeatureCollection","features":[]})")), "no line");
}

TEST(GenerateRoads, MeetOnlyAtJunctions) {
  const Terrain terrain = ground();
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Roads roads = generate_roads(terrain, seed);
    ASSERT_EQ(roads.size(), 24U);
    EXPECT_EQ(roads, generate_roads(terrain, seed));
    EXPECT_NE(roads, generate_roads(terrain, seed + 1));
    std::vector<std::pair<Vec2, Vec2>> segments;
    for (const auto& road : roads) {
      for (std::size_t k = 0; k + 1 < road.size(); ++k) segments.emplace_back(road[k], road[k + 1]);
    }
    const auto side = [](Vec2 a, Vec2 b, Vec2 p) {
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    for (const auto& [a, b] : segments) {
      for (const Vec2 p : {a, b}) {
        EXPECT_TRUE(p.x > 0 && p.y > 0 && p.x < terrain.width_m() && p.y < terrain.depth_m());
      }
      for (const auto& [c, d] : segments) {
        if (a == c || a == d || b == c || b == d) continue;
        EXPECT_FALSE(side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0);
      }
    }
  }
}

TEST(SuiteConstraints, AreReadWithTheTerrain) {
  const test::TemporaryFolder folder;
  folder.write("roads.csv", "WKT,name\n\"LINESTRING (10 20, 30.5 40)\",main\n");
  const auto suite = [&](const char* constraints) {
    return load_suite(
        folder.write("suite.toml", std::string("[suite]\nname = \"s\"\n[[terrain]]\nid = \"t\"\ngenerator = "
                                               "\"fbm\"\nsize = 65\nconstraints = ") +
                                       constraints +
                                       "\n[[trajectory]]\nid = \"a\"\nkind = \"hover\"\nframes = 1\n"
                                       "[[method]]\nid = \"full\"\nthresholds_px = [1]\n"));
  };
  EXPECT_EQ(load_terrain(suite("\"roads.csv\"").terrains[0]).roads, (Roads{{{10, 20}, {30.5, 40}}}));
  EXPECT_EQ(load_terrain(suite("\"generated\"").terrains[0]).roads.size(), 24U);
  EXPECT_THROW(suite("\"\""), InputError);
  EXPECT_THROW(load_terrain(suite("\"gone.csv\"").terrains[0]), InputError);
}

}  // namespace
}  // namespace plumbline
