// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed forms, planted faults, invariances and refusals of O2. Its second route stands in
// vertical_exact_test.cpp.

#include "oracle/vertical.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "scenarios/error.h"
#include "tests/oracle/vertical_support.h"

namespace plumbline::oracle {
namespace {

using test::grid_mesh;
using test::make_terrain;
using test::random_terrain;
using test::two_triangles;

/// Sums of a few hundred terms, each rounded a dozen times: far below this share of themselves.
constexpr double kSumTolerance = 1e-13;

constexpr auto flat = [](int, int) { return 0.0; };
constexpr auto at_zero = [](double, double) { return 0.0; };

TEST(Vertical, LiftedPlaneIsTheLiftEverywhere) {
  const Terrain terrain = make_terrain(9, 5, 30, [](int i, int j) { return 250 + 2.5 * i - 0.75 * j; });
  const Mesh mesh = two_triangles(terrain, [](double x, double y) { return 250.375 + x / 12 - y / 40; });
  const VerticalError error = vertical_error(mesh, terrain);
  const double bound_m = kVerticalRoundingFactor * 0x1p-53 * test::height_range_m(mesh, terrain);
  EXPECT_NEAR(error.max, 0.375, bound_m);
  EXPECT_NEAR(error.certain_max, 0.375, bound_m);
  EXPECT_NEAR(error.rms, 0.375, bound_m);
  EXPECT_NEAR(error.mean, 0.375, bound_m);
  EXPECT_DOUBLE_EQ(error.area_m2, 240 * 120);
}

TEST(Vertical, TiltedPlaneHasTheIntegralsOfALinearFunction) {
  // e = x/8 − 1 over [0, 16] × [0, 4]: |e| ≤ 1, ∫e² = 1/3 and ∫|e| = 1/2 of the area; the sign changes along
  // x = 8.
  const Terrain terrain = make_terrain(17, 5, 1, flat);
  const Mesh mesh = two_triangles(terrain, [](double x, double) { return x / 8 - 1; });
  const VerticalError error = vertical_error(mesh, terrain);
  EXPECT_EQ(error.max, 1);
  EXPECT_EQ(error.certain_max, 1);
  EXPECT_EQ(error.at, (Vec2{0, 0}));
  EXPECT_NEAR(error.rms, std::sqrt(1.0 / 3), kSumTolerance);
  EXPECT_NEAR(error.mean, 0.5, kSumTolerance);
  EXPECT_EQ(error.area_m2, 64);
}

TEST(Vertical, SignChangeInsideCellsIsSplitExactly) {
  // e = x − ½ over one column of cells: ∫|e| = 1/4, ∫e² = 1/12 of the area, though |e| = ½ at every sample.
  const Terrain terrain = make_terrain(2, 4, 1, flat);
  const VerticalError error =
      vertical_error(two_triangles(terrain, [](double x, double) { return x - 0.5; }), terrain);
  EXPECT_NEAR(error.mean, 0.25, kSumTolerance);
  EXPECT_NEAR(error.rms, std::sqrt(1.0 / 12), kSumTolerance);
}

TEST(Vertical, FlatMeshOverASpikeMeasuresTheTent) {
  // The spike's six triangles have area ½ each: ∫e = 6 · ½ · h/3 = h, ∫e² = 6 · ½ · h²/6 = h²/2 (cells).
  const Terrain terrain = make_terrain(9, 9, 2, [](int i, int j) { return i == 5 && j == 3 ? 7.0 : 0.0; });
  const VerticalError error = vertical_error(two_triangles(terrain, at_zero), terrain);
  EXPECT_EQ(error.max, 7);
  EXPECT_EQ(error.certain_max, 7);
  EXPECT_EQ(error.samples_max, 7);
  EXPECT_EQ(error.samples_at, (Vec2{10, 6}));
  EXPECT_EQ(error.at, (Vec2{10, 6}));
  EXPECT_NEAR(error.mean, 7.0 / 64, kSumTolerance);
  EXPECT_NEAR(error.rms, std::sqrt(0.5 * 49 / 64), kSumTolerance);
}

TEST(Vertical, ReferenceMeshIsExactlyZero) {
  for (const double spacing_m : {1.0 / 3, 30.0, 0.7, 1e-3}) {
    const Terrain terrain = random_terrain(33, 21, spacing_m, 5);
    const VerticalError error = vertical_error(reference_mesh(terrain), terrain);
    EXPECT_EQ(error.max, 0);
    EXPECT_EQ(error.certain_max, 0);
    EXPECT_EQ(error.rms, 0);
    EXPECT_EQ(error.mean, 0);
    EXPECT_EQ(error.at, (Vec2{0, 0}));
    EXPECT_DOUBLE_EQ(error.area_m2, terrain.width_m() * terrain.depth_m());
  }
}

TEST(Vertical, AnyChoiceOfDiagonalsIsCertainlyRight) {
  const Terrain terrain = random_terrain(33, 21, 1.0 / 3, 6);
  Random random(2);
  const auto alternating = [](int i, int j) { return (i + j) % 2 == 0; };
  for (const Mesh& mesh : {grid_mesh(terrain, alternating),
                           grid_mesh(terrain, [&](int, int) { return random.below(2) == 0; })}) {
    const VerticalError error = vertical_error(mesh, terrain);
    EXPECT_EQ(error.certain_max, 0);
    EXPECT_GT(error.max, 0);
    EXPECT_LE(error.max, diagonal_ambiguity_m(terrain) * (1 + 0x1p-40));
  }
}

TEST(Vertical, OtherDiagonalEverywhereReachesTheAmbiguity) {
  const Terrain terrain = make_terrain(3, 2, 4, [](int i, int j) { return i == 1 && j == 1 ? 6.0 : 0.0; });
  const VerticalError error = vertical_error(grid_mesh(terrain, [](int, int) { return false; }), terrain);
  EXPECT_EQ(diagonal_ambiguity_m(terrain), 3);
  EXPECT_EQ(error.max, 3);
  EXPECT_EQ(error.at, (Vec2{2, 2}));  // the western of two equal cell middles
  // A gap of 3 m in the middle falls to 0 at the rim: a pyramid of volume 1 cell per cell; ∫e² = 9/6.
  EXPECT_NEAR(error.mean, 1, kSumTolerance);
  EXPECT_NEAR(error.rms, std::sqrt(9.0 / 6), kSumTolerance);
}

TEST(Vertical, ErrorBetweenSamplesIsFoundWhereSamplesAgree) {
  // Both triangles pass through all six samples; the edge between them crosses the line x = 1 half way, 4 m
  // too high. A greedy mesh whose maker looks at samples only has such errors (PEERS.md).
  const Terrain terrain = make_terrain(3, 2, 10, [](int i, int j) {
    return i == 1 ? 0.0 : (i == 0) == (j == 0) ? 4.0 : -4.0;
  });
  Mesh mesh;
  mesh.positions = {terrain.point(0, 0), terrain.point(2, 0), terrain.point(2, 1), terrain.point(0, 1)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const VerticalError error = vertical_error(mesh, terrain);
  EXPECT_EQ(error.max, 4);
  EXPECT_EQ(error.certain_max, 4);
  EXPECT_EQ(error.at, (Vec2{10, 5}));
  EXPECT_EQ(error.certain_at, (Vec2{10, 5}));
  EXPECT_EQ(error.samples_max, 0) << "the maker's bound holds where he looked";
}

TEST(Vertical, ErrorAtSamplesIsToldFromTheLargerOneBetweenThem) {
  // The same with one sample of the middle pulled down by 1 m: 3 m short of what is between them.
  const Terrain terrain = make_terrain(3, 2, 10, [](int i, int j) {
    return i == 1 ? (j == 1 ? -1.0 : 0.0) : (i == 0) == (j == 0) ? 4.0 : -4.0;
  });
  Mesh mesh;
  mesh.positions = {terrain.point(0, 0), terrain.point(2, 0), terrain.point(2, 1), terrain.point(0, 1)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const VerticalError error = vertical_error(mesh, terrain);
  EXPECT_EQ(error.max, 4.5);
  EXPECT_EQ(error.certain_max, 4.5);
  EXPECT_EQ(error.samples_max, 1);
  EXPECT_EQ(error.samples_at, (Vec2{10, 10}));
}

TEST(Vertical, ErrorAtASampleInsideASmallTriangleIsFound) {
  // No half of a cell lies inside, each is cut twice; and a thin one over the same sample.
  const Terrain terrain = make_terrain(5, 5, 1, [](int i, int j) { return i == 2 && j == 2 ? -6.0 : 0.0; });
  for (const double half_height : {0.3, 0.02}) {
    Mesh mesh;
    mesh.positions = {{1.6, 2 - half_height, 0}, {2.4, 2 - half_height, 0}, {2, 2 + half_height, 0}};
    mesh.triangles = {{0, 1, 2}};
    const VerticalError error = vertical_error(mesh, terrain);
    EXPECT_NEAR(error.samples_max, 6, kVerticalRoundingFactor * 0x1p-53 * 6) << half_height;
    EXPECT_EQ(error.samples_at, (Vec2{2, 2}));
  }
}

TEST(Vertical, MeshBetweenSamplesHasNoErrorAtThem) {
  const Terrain terrain = make_terrain(5, 5, 1, flat);
  Mesh mesh;
  mesh.positions = {{1.1, 1.1, 3}, {1.9, 1.1, 3}, {1.9, 1.9, 3}};
  mesh.triangles = {{0, 1, 2}};
  const VerticalError error = vertical_error(mesh, terrain);
  EXPECT_EQ(error.max, 3);
  EXPECT_EQ(error.samples_max, 0);
}

TEST(Vertical, WhereASampleHoldsNoDataFourCellsAreNotJudged) {
  // The greatest error stands beside the hole, a lesser one elsewhere; both triangles are large.
  Terrain terrain = make_terrain(9, 9, 2, [](int i, int j) {
    return i == 4 && j == 5 ? 1000.0 : i == 5 && j == 5 ? 9.0 : i == 1 && j == 2 ? -7.0 : 0.0;
  });
  std::vector<std::uint8_t> has_data(terrain.heights_m.size(), 1);
  const Mesh mesh = two_triangles(terrain, at_zero);
  EXPECT_EQ(vertical_error_where_data(mesh, terrain, has_data), vertical_error(mesh, terrain));
  has_data[terrain.index(4, 5)] = 0;
  VerticalError error = vertical_error_where_data(mesh, terrain, has_data);
  EXPECT_EQ(error.max, 9) << "a sample on the rim of what is judged";
  EXPECT_EQ(error.at, (Vec2{10, 10}));
  EXPECT_EQ(error.samples_max, 9);
  EXPECT_EQ(error.area_m2, (64 - 4) * 4);
  EXPECT_EQ(diagonal_ambiguity_m(terrain, has_data), 4.5);
  has_data[terrain.index(5, 5)] = 0;
  error = vertical_error_where_data(mesh, terrain, has_data);
  EXPECT_EQ(error.max, 7);
  EXPECT_EQ(error.at, (Vec2{2, 4}));
  EXPECT_EQ(error.area_m2, (64 - 6) * 4);
  EXPECT_EQ(diagonal_ambiguity_m(terrain, has_data), 3.5);
  std::fill(has_data.begin(), has_data.end(), std::uint8_t{0});
  EXPECT_EQ(vertical_error_where_data(mesh, terrain, has_data), VerticalError{});
  has_data.pop_back();
  EXPECT_THROW(vertical_error_where_data(mesh, terrain, has_data), InputError);
}

TEST(Vertical, PlantedSampleIsFoundAtItsPlaceToTheBit) {
  const Terrain terrain = random_terrain(17, 13, 1.0 / 3, 8);
  Random random(3);
  for (const double move_m : {0x1p-46, 1e-3, -1e-3, 1.0, -1.0}) {
    for (int round = 0; round < 50; ++round) {
      const int i = static_cast<int>(random.below(17)), j = static_cast<int>(random.below(13));
      Mesh mesh = reference_mesh(terrain);
      double& z = mesh.positions[terrain.index(i, j)].z;
      z += move_m;
      const double moved_m = z - terrain.z(i, j);
      ASSERT_NE(moved_m, 0);
      const VerticalError error = vertical_error(mesh, terrain);
      EXPECT_EQ(error.max, std::fabs(moved_m));
      EXPECT_EQ(error.certain_max, std::fabs(moved_m));
      EXPECT_EQ(error.at, (Vec2{terrain.point(i, j).x, terrain.point(i, j).y}));
    }
  }
}

TEST(Vertical, PlantedSampleUnderALargeTriangleIsFoundAtItsPlace) {
  Random random(4);
  for (const double move_m : {1e-3, -1.0}) {
    for (int round = 0; round < 50; ++round) {
      const int i = static_cast<int>(random.below(33)), j = static_cast<int>(random.below(33));
      Terrain terrain = make_terrain(33, 33, 30, [](int a, int b) { return 500.0 + 3 * a + 2 * b; });
      const Mesh mesh = two_triangles(terrain, [](double x, double y) { return 500 + x / 10 + y / 15; });
      terrain.heights_m[terrain.index(i, j)] += move_m;
      const VerticalError error = vertical_error(mesh, terrain);
      EXPECT_NEAR(error.max, std::fabs(move_m), kVerticalRoundingFactor * 0x1p-53 * 160);
      EXPECT_EQ(error.at, (Vec2{30.0 * i, 30.0 * j}));
    }
  }
}

TEST(Vertical, MovedMeshVertexBetweenSamplesIsFound) {
  const Terrain terrain = make_terrain(5, 5, 1, flat);
  Mesh mesh = two_triangles(terrain, at_zero);
  mesh.positions.push_back({1.25, 2.5, 0.5});
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const VerticalError error = vertical_error(mesh, terrain);
  EXPECT_EQ(error.max, 0.5);
  EXPECT_EQ(error.certain_max, 0.5);
  EXPECT_EQ(error.at, (Vec2{1.25, 2.5}));
  EXPECT_NEAR(error.mean, 0.5 / 3, kSumTolerance);  // a pyramid
  EXPECT_NEAR(error.rms, std::sqrt(0.25 / 6), kSumTolerance);
}

TEST(Vertical, WhatLiesOutsideTheGridIsNotJudged) {
  const Terrain terrain = make_terrain(5, 5, 1, flat);
  Mesh mesh;
  mesh.positions = {{-3, -3, 2}, {9, -3, 2}, {-3, 9, 2}, {20, 20, 9}, {30, 20, 9}, {20, 30, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const VerticalError error = vertical_error(mesh, terrain);
  EXPECT_EQ(error.max, 2);
  EXPECT_NEAR(error.area_m2, 16 - 0.5 * 2 * 2,
              kSumTolerance * 16);  // the hypotenuse x + y = 6 cuts a corner off
  EXPECT_NEAR(error.rms, 2, kSumTolerance);
}

TEST(Vertical, TrianglesReachingFarBeyondTheGridAreCutToIt) {
  const Terrain terrain = random_terrain(9, 9, 1, 3);
  for (const double reach_m : {1e3, 1e8, 1e15, 1e100}) {
    Mesh mesh;
    mesh.positions = {{-reach_m, -reach_m, 110},
                      {reach_m, -reach_m, 110},
                      {reach_m, reach_m, 110},
                      {-reach_m, reach_m, 110}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const VerticalError far = vertical_error(mesh, terrain);
    const VerticalError near =
        vertical_error(two_triangles(terrain, [](double, double) { return 110.0; }), terrain);
    EXPECT_EQ(far.max, near.max) << reach_m;
    EXPECT_EQ(far.at, near.at) << reach_m;
    EXPECT_NEAR(far.area_m2, 64, 1e-9) << reach_m;
    EXPECT_NEAR(far.mean, near.mean, 1e-12) << reach_m;
  }
}

TEST(Vertical, UnusableTrianglesAreSkipped) {
  const Terrain terrain = make_terrain(3, 3, 1, flat);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  Mesh mesh;
  mesh.positions = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {2, 0, 5}, {nan, 0, 5}, {1, 1, infinite}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}, {0, 1, 99}, {0, 0, 1}};
  EXPECT_EQ(vertical_error(mesh, terrain), VerticalError{});
  EXPECT_EQ(vertical_error(Mesh{}, terrain), VerticalError{});
  mesh.triangles.push_back({0, 1, 2});
  EXPECT_EQ(vertical_error(mesh, terrain).max, 5);
  EXPECT_EQ(vertical_error(mesh, terrain).area_m2, 0.5);
}

TEST(Vertical, OverlappingTrianglesAreJudgedEach) {
  const Terrain terrain = make_terrain(5, 5, 1, flat);
  Mesh mesh = two_triangles(terrain, [](double, double) { return 1.0; });
  const Mesh upper = two_triangles(terrain, [](double, double) { return 3.0; });
  for (const Vec3& p : upper.positions) mesh.positions.push_back(p);
  mesh.triangles.push_back({4, 5, 6});
  mesh.triangles.push_back({4, 6, 7});
  const VerticalError error = vertical_error(mesh, terrain);
  EXPECT_EQ(error.max, 3);
  EXPECT_EQ(error.area_m2, 32);
  EXPECT_NEAR(error.mean, 2, kSumTolerance);
}

TEST(Vertical, SteepSliverStaysWithinItsCornersHeights) {
  const Terrain terrain = make_terrain(65, 65, 1, flat);
  for (const double width_m : {1e-3, 1e-9, 1e-14}) {
    Mesh mesh;
    mesh.positions = {{0.5, 0.25, 0}, {60.5, 50.25 - width_m, 100}, {60.5, 50.25, -100}};
    mesh.triangles = {{0, 1, 2}};
    const VerticalError error = vertical_error(mesh, terrain);
    EXPECT_EQ(error.max, 100) << width_m;
    EXPECT_LE(error.rms, 100) << width_m;
  }
}

TEST(Vertical, PowersOfTwoScaleExactly) {
  const Terrain terrain = random_terrain(17, 17, 0.7, 9);
  Random random(5);
  Mesh mesh;
  for (int k = 0; k < 60; ++k) {
    const Mesh one = test::random_triangle(terrain, random, k % 2 == 0, k % 5 == 0);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), one.positions.begin(), one.positions.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const VerticalError error = vertical_error(mesh, terrain);
  for (const auto& [plan, up] :
       {std::pair{4.0, 4.0}, std::pair{0.125, 0.125}, std::pair{1.0, 1024.0}, std::pair{0x1p30, 1.0}}) {
    Terrain scaled = terrain;
    scaled.spacing_m *= plan;
    for (double& z : scaled.heights_m) z *= up;
    Mesh scaled_mesh = mesh;
    for (Vec3& p : scaled_mesh.positions) p = {p.x * plan, p.y * plan, p.z * up};
    const VerticalError expected{error.max * up,
                                 error.certain_max * up,
                                 error.rms * up,
                                 error.mean * up,
                                 error.at * plan,
                                 error.certain_at * plan,
                                 error.area_m2 * plan * plan,
                                 error.samples_max * up,
                                 error.samples_at * plan};
    EXPECT_EQ(vertical_error(scaled_mesh, scaled), expected);
  }
}

TEST(Vertical, OrderOfTrianglesAndCornersDoesNotMatter) {
  const Terrain terrain = random_terrain(33, 33, 1, 10);
  Random random(6);
  for (int round = 0; round < 20; ++round) {
    Mesh mesh;
    for (int k = 0; k < 40; ++k) {
      const Mesh one = test::random_triangle(terrain, random, k % 2 == 0, k % 5 == 0);
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), one.positions.begin(), one.positions.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const VerticalError error = vertical_error(mesh, terrain);
    for (std::size_t k = mesh.triangles.size() - 1; k > 0; --k) {
      std::swap(mesh.triangles[k], mesh.triangles[random.below(k + 1)]);
    }
    for (auto& triangle : mesh.triangles) {
      std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                  triangle.end());
    }
    const VerticalError shuffled = vertical_error(mesh, terrain);
    EXPECT_EQ(shuffled.max, error.max);
    EXPECT_EQ(shuffled.certain_max, error.certain_max);
    EXPECT_EQ(shuffled.at, error.at);
    EXPECT_EQ(shuffled.certain_at, error.certain_at);
    EXPECT_EQ(shuffled.samples_max, error.samples_max);
    EXPECT_EQ(shuffled.samples_at, error.samples_at);
    EXPECT_NEAR(shuffled.rms, error.rms, kSumTolerance * error.rms);
    EXPECT_NEAR(shuffled.mean, error.mean, kSumTolerance * error.mean);
  }
}

TEST(Vertical, CertainErrorHasTheGridsEightSymmetries) {
  // Half of them map the declared diagonal to the other one; the envelope of both stays.
  constexpr int kSide = 17;
  const Terrain terrain = random_terrain(kSide, kSide, 1, 11);
  Random random(7);
  Mesh mesh;
  for (int k = 0; k < 30; ++k) {
    const Mesh one = test::random_triangle(terrain, random, true, false);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), one.positions.begin(), one.positions.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const VerticalError error = vertical_error(mesh, terrain);
  const double bound_m = 2 * kVerticalRoundingFactor * 0x1p-53 * test::height_range_m(mesh, terrain);
  for (int symmetry = 0; symmetry < 8; ++symmetry) {
    const bool transpose = (symmetry & 1) != 0, mirror_x = (symmetry & 2) != 0,
               mirror_y = (symmetry & 4) != 0;
    const auto image = [&](double x, double y) {
      if (transpose) std::swap(x, y);
      return Vec2{mirror_x ? kSide - 1 - x : x, mirror_y ? kSide - 1 - y : y};
    };
    Terrain moved = terrain;
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const Vec2 p = image(i, j);
        moved.heights_m[moved.index(static_cast<int>(p.x), static_cast<int>(p.y))] = terrain.z(i, j);
      }
    }
    Mesh moved_mesh = mesh;
    for (Vec3& p : moved_mesh.positions) {
      const Vec2 q = image(p.x, p.y);
      p = {q.x, q.y, p.z};
    }
    if (transpose != (mirror_x != mirror_y)) {
      for (auto& triangle : moved_mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    const VerticalError again = vertical_error(moved_mesh, moved);
    EXPECT_NEAR(again.certain_max, error.certain_max, bound_m) << symmetry;
    EXPECT_NEAR(again.area_m2, error.area_m2, kSumTolerance * error.area_m2) << symmetry;
    EXPECT_EQ(diagonal_ambiguity_m(moved), diagonal_ambiguity_m(terrain)) << symmetry;
    if (mirror_x == mirror_y) {  // the declared diagonal stays
      EXPECT_NEAR(again.max, error.max, bound_m) << symmetry;
      EXPECT_NEAR(again.rms, error.rms, kSumTolerance * error.rms) << symmetry;
    }
  }
}

TEST(Vertical, UnusableTerrainIsRefused) {
  Terrain thin = make_terrain(1, 5, 1, flat);
  EXPECT_THROW(vertical_error(Mesh{}, thin), InputError);
  Terrain short_of_samples = make_terrain(3, 3, 1, flat);
  short_of_samples.heights_m.pop_back();
  EXPECT_THROW(vertical_error(Mesh{}, short_of_samples), InputError);
  for (const double spacing_m : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(vertical_error(Mesh{}, make_terrain(3, 3, spacing_m, flat)), InputError);
  }
  EXPECT_THROW(diagonal_ambiguity_m(thin), InputError);
}

}  // namespace
}  // namespace plumbline::oracle
