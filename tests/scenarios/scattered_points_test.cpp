// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/scattered_points.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/error.h"
#include "scenarios/random.h"
#include "scenarios/terrain_source.h"

namespace plumbline {
namespace {

using ::testing::HasSubstr;

class PointFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string complaint(const TerrainSource& source) {
    try {
      load_terrain(source);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  std::filesystem::path folder_;
};

double plane_m(double x, double y) { return 0.25 * x - 0.5 * y + 100; }

/// Corners of a square far from the origin, and points inside it, on a tilted plane.
std::string points_on_a_plane(int inside) {
  std::string text = "x,y,z\n";
  Random random(5, "points");
  const auto add = [&](double x, double y) {
    text += fmt::format("{},{},{}\n", 500000 + x, 4000000 + y, plane_m(x, y));
  };
  for (const double x : {0.0, 1000.0}) {
    for (const double y : {0.0, 1000.0}) add(x, y);
  }
  for (int k = 0; k < inside; ++k) add(random.between(1, 999), random.between(1, 999));
  return text;
}

TEST_F(PointFile, SamplesLieInThePointsTriangles) {
  TerrainSource source;
  source.id = "survey";
  source.points = write("p.csv", points_on_a_plane(300));
  source.size = 41;
  const Terrain terrain = load_terrain(source);
  EXPECT_EQ(terrain.columns, 41);
  EXPECT_EQ(terrain.spacing_m, 25);
  // Barycentric weights of a triangle in a box of 1000 m: far more than the rounding of three products.
  constexpr double kRoundingM = 1e-6;
  for (int j = 0; j < 41; ++j) {
    for (int i = 0; i < 41; ++i) EXPECT_NEAR(terrain.z(i, j), plane_m(25 * i, 25 * j), kRoundingM);
  }
  ASSERT_EQ(terrain.points.size(), 300u);
  for (const Vec3 p : terrain.points) EXPECT_NEAR(p.z, plane_m(p.x, p.y), kRoundingM);
}

TEST_F(PointFile, WithoutASizeTheMeanDistanceIsTaken) {
  TerrainSource source;
  source.id = "survey";
  source.points = write("p.csv", points_on_a_plane(396));
  const Terrain terrain = load_terrain(source);
  EXPECT_EQ(terrain.spacing_m, 50);  // √(1000 · 1000 / 400)
  EXPECT_EQ(terrain.columns, 21);
}

TEST_F(PointFile, BeyondTheHullAreHoles) {
  TerrainSource source;
  source.id = "survey";
  // A triangle: the north-east half of its box is empty.
  source.points = write("p.csv", "x,y,z\n0,0,1\n100,0,2\n0,100,3\n20,20,5\n");
  source.size = 11;
  EXPECT_THAT(complaint(source), HasSubstr("samples hold no data; say holes"));
  source.holes = HolePolicy::crop;
  const Terrain cropped = load_terrain(source);
  EXPECT_GE(cropped.columns, 5);
  EXPECT_GE(cropped.rows, 5);
  ASSERT_EQ(cropped.points.size(), 1u);
  EXPECT_EQ(cropped.points[0], (Vec3{20, 20, 5}));
}

TEST_F(PointFile, ReadsGeoJsonInMetres) {
  TerrainSource source;
  source.id = "survey";
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (const char* p : {"0,0,1", "1000,0,2", "0,1000,3", "1000,1000,4"})
    text += fmt::format(
        R"({{"type":"Feature","properties":{{}},"geometry":{{"type":"Point","coordinates":[{}]}}}},)", p);
  text.back() = ']';
  source.points = write("p.geojson", text + "}");
  source.size = 3;
  EXPECT_EQ(load_terrain(source).z(0, 2), 3);
}

TEST_F(PointFile, ComplaintsSayWhatIsWrong) {
  const struct {
    const char* file;
    const char* text;
    const char* says;
  } cases[] = {
      {"p.csv", "x,y\n1,2\n3,4\n5,7\n", "point 1 has no height"},
      {"p.csv", "a,b,c\n1,2,3\n4,5,6\n7,8,10\n", "a CSV needs columns named x, y and z"},
      {"p.csv", "x,y,z\n1,2,3\n4,5,6\n", "holds 2 points; a terrain needs three"},
      {"p.csv", "x,y,z\n1,2,3\n1,5,6\n1,8,6\n", "all points stand on one line"},
      {"p.csv", "x,y,z\n1,1,3\n2,2,6\n3,3,6\n", "all points stand on one line"},
      {"p.csv", "x,y,z\n1,1,3\nnan,2,6\n3,1,6\n", "row 2 has no place"},
      {"p.geojson", R"({"type":"Point","coordinates":[500000,4000000,1000]})", "holds 1 points"},
      {"p.geojson", R"({"type":"MultiPoint","coordinates":[[7.5,46.5,1],[7.6,46.5,1],[7.5,46.6,1]]})",
       "longitudes and latitudes"},
      {"p.geojson", R"({"type":"LineString","coordinates":[[7.5,46.5,1],[7.6,46.5,1]]})",
       "holds a LINESTRING"},
      {"p.csv", "", "not a vector file"},
  };
  for (const auto& c : cases) {
    TerrainSource source;
    source.id = "survey";
    source.points = write(c.file, c.text);
    source.size = 5;
    EXPECT_THAT(complaint(source), HasSubstr(c.says)) << c.text;
    EXPECT_THAT(complaint(source), Not(HasSubstr("\n")));
  }
  TerrainSource absent;
  absent.id = "survey";
  absent.points = folder_ / "none.csv";
  EXPECT_THAT(complaint(absent), HasSubstr("no such file"));
}

}  // namespace
}  // namespace plumbline
