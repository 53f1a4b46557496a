// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/error_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "oracle/vertical.h"
#include "tests/oracle/vertical_support.h"

namespace plumbline::oracle {
namespace {

using test::make_terrain;
using test::two_triangles;

TEST(ErrorMap, ShowsSignedErrorsRowsFromTheNorth) {
  // The mesh lies 2 m too high in the south and 1 m too low in the north of a tilted plane.
  const Terrain terrain = make_terrain(9, 5, 10, [](int i, int) { return 3.0 * i; });
  const Mesh mesh = two_triangles(terrain, [](double x, double y) { return 0.3 * x + 2 - y * 3 / 40; });
  const ErrorMap map = vertical_error_map(mesh, terrain, {}, 80);
  ASSERT_EQ(map.error_m.width, 80);
  ASSERT_EQ(map.error_m.height, 40);
  EXPECT_EQ(map.low, (Vec2{0, 0}));
  EXPECT_EQ(map.high, (Vec2{80, 40}));
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 80; ++x) {
      const double expected = 2 - (39.5 - y) * 3 / 40;
      EXPECT_NEAR(map.error_m.at(x, y), expected, 1e-5) << x << ' ' << y;
    }
  }
}

TEST(ErrorMap, NothingIsShownWhereNothingIsJudged) {
  const Terrain terrain = make_terrain(9, 9, 1, [](int, int) { return 0.0; });
  std::vector<std::uint8_t> has_data(81, 1);
  has_data[terrain.index(2, 6)] = 0;
  Mesh mesh = two_triangles(terrain, [](double, double) { return 1.0; });
  mesh.triangles.pop_back();  // the south-east half is left
  const ErrorMap map = vertical_error_map(mesh, terrain, has_data, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const double east = (x + 0.5) / 2, north = (15.5 - y) / 2;
      const bool hole = std::fabs(east - 2) < 1 && std::fabs(north - 6) < 1;
      EXPECT_EQ(std::isnan(map.error_m.at(x, y)), east < north || hole) << x << ' ' << y;
    }
  }
  EXPECT_TRUE(vertical_error_map({}, terrain, {}, 16).error_m.values.empty());
  for (Vec3& p : mesh.positions) p.x += 100;
  EXPECT_TRUE(vertical_error_map(mesh, terrain, {}, 16).error_m.values.empty()) << "beside the terrain";
}

TEST(ErrorMap, CoversWhatBothHaveInCommonInSquarePixels) {
  const Terrain terrain = make_terrain(9, 9, 1, [](int, int) { return 0.0; });
  Mesh mesh;
  mesh.positions = {{-4, 2, 1}, {4, 2, 1}, {4, 6, 1}, {-4, 6, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const ErrorMap map = vertical_error_map(mesh, terrain, {}, 100, {1, 2});
  EXPECT_EQ(map.low, (Vec2{0, 2}));
  EXPECT_EQ(map.high, (Vec2{4, 6}));
  EXPECT_EQ(map.error_m.width, 50);  // rows stand twice as far apart as columns
  EXPECT_EQ(map.error_m.height, 100);
  EXPECT_TRUE(
      std::all_of(map.error_m.values.begin(), map.error_m.values.end(), [](float e) { return e == 1; }));
}

TEST(ErrorMap, NeverExceedsTheExactFigureAndDoesNotDependOnOrder) {
  Random random(31);
  for (int round = 0; round < 20; ++round) {
    const Terrain terrain = test::random_terrain(17, 13, 30, random.bits());
    Mesh mesh;
    for (int k = 0; k < 40; ++k) {
      const Mesh one = test::random_triangle(terrain, random, k % 2 == 0, k % 5 == 0);
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), one.positions.begin(), one.positions.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const ErrorMap map = vertical_error_map(mesh, terrain, {}, 200);
    const VerticalError exact = vertical_error(mesh, terrain);
    double greatest = 0;
    for (const float e : map.error_m.values) {
      if (!std::isnan(e)) greatest = std::max(greatest, std::fabs(static_cast<double>(e)));
    }
    EXPECT_LE(greatest, exact.max * (1 + 1e-6));
    EXPECT_GT(greatest, 0.8 * exact.max) << "a picture of 200 pixels comes near";
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    for (auto& corners : mesh.triangles) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    const ErrorMap again = vertical_error_map(mesh, terrain, {}, 200);
    for (std::size_t k = 0; k < map.error_m.values.size(); ++k) {
      const float a = map.error_m.values[k], b = again.error_m.values[k];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
    }
  }
}

}  // namespace
}  // namespace plumbline::oracle
