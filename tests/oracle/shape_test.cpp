// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "scenarios/portable_math.h"
#include "scenarios/random.h"
#include "tests/oracle/vertical_support.h"

namespace plumbline::oracle {
namespace {

/// A quality or an angle comes from a dozen roundings.
constexpr double kRelativeTolerance = 0x1p-48;

Mesh one_triangle(Vec3 a, Vec3 b, Vec3 c) { return {{a, b, c}, {{0, 1, 2}}}; }

TEST(Shape, EquilateralTriangleIsPerfect) {
  const ShapeReport report = shape(one_triangle({0, 0, 5}, {2, 0, -7}, {1, std::sqrt(3.0), 90}));
  EXPECT_NEAR(report.min_quality, 1, kRelativeTolerance);
  EXPECT_NEAR(report.mean_quality, 1, kRelativeTolerance);
  EXPECT_NEAR(report.least_angle_deg, 60, 60 * kRelativeTolerance);
  EXPECT_EQ(report.slivers, 0u);
}

TEST(Shape, HalfSquareHasFortyFiveDegrees) {
  const ShapeReport report = shape(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  EXPECT_DOUBLE_EQ(report.least_angle_deg, 45);
  EXPECT_DOUBLE_EQ(report.min_quality, std::sqrt(3.0) / 2);  // 4·√3·½ / (1 + 1 + 2)
}

TEST(Shape, LeastAngleIsTheLeastOfAllTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {10, 0, 0}, {10, 1, 0}, {10, 20, 0}};
  mesh.triangles = {{1, 3, 2}, {0, 1, 2}, {0, 1, 3}};  // the first is degenerate: collinear
  EXPECT_EQ(shape(mesh).least_angle_deg, 0);
  mesh.triangles.erase(mesh.triangles.begin());
  const ShapeReport report = shape(mesh);
  EXPECT_EQ(report.least_angle_deg, exact_atan2(10, 100) / kRadiansPerDegree);
  // The triangle of 10 × 1: 4·√3·5 / (100 + 1 + 101).
  EXPECT_DOUBLE_EQ(report.min_quality, 20 * std::sqrt(3.0) / 202);
}

TEST(Shape, SliversAreCountedBelowTheLimitOnly) {
  Mesh mesh;
  // Height h over a base of 1: quality 4·√3·(h/2) / (1 + 2(¼ + h²)); the limit 0.05 falls at h = 0.02168….
  for (const double h : {0.0215, 0.0218, 0.5, 0.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, h, 0}}) mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const ShapeReport report = shape(mesh);
  EXPECT_EQ(report.slivers, 2u);
  EXPECT_EQ(report.min_quality, 0);
}

TEST(Shape, InnerVerticesOfAGridHaveValenceSix) {
  const Terrain terrain = test::random_terrain(5, 4, 30, 1);
  const ShapeReport report = shape(reference_mesh(terrain));
  EXPECT_EQ(report.max_valence, 6u);
  EXPECT_DOUBLE_EQ(report.mean_valence, 3.0 * 24 / 20);
  EXPECT_DOUBLE_EQ(report.least_angle_deg, 45);
}

TEST(Shape, UnusedVerticesDoNotLowerTheValence) {
  Mesh mesh = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.positions.push_back({5, 5, 5});
  EXPECT_EQ(shape(mesh).mean_valence, 1);
}

TEST(Shape, FansAreTakenInMeshOrder) {
  // A wheel of eight around vertex 0, then one triangle apart: fans of eight and one.
  Mesh mesh;
  mesh.positions.push_back({0, 0, 0});
  for (const Vec2 p : {Vec2{2, 0}, Vec2{2, 2}, Vec2{0, 2}, Vec2{-2, 2}, Vec2{-2, 0}, Vec2{-2, -2},
                       Vec2{0, -2}, Vec2{2, -2}}) {
    mesh.positions.push_back({p.x, p.y, 0});
  }
  for (std::uint32_t k = 1; k <= 8; ++k) mesh.triangles.push_back({0, k, k % 8 + 1});
  EXPECT_EQ(shape(mesh).mean_fan_length, 8);
  EXPECT_EQ(shape(mesh).max_valence, 8u);
  for (const Vec3 p : {Vec3{9, 9, 0}, Vec3{10, 9, 0}, Vec3{9, 10, 0}}) mesh.positions.push_back(p);
  mesh.triangles.push_back({9, 10, 11});
  EXPECT_EQ(shape(mesh).mean_fan_length, 4.5);
  // Put in the middle, it parts the wheel: fans of four, one, four.
  std::rotate(mesh.triangles.begin() + 4, mesh.triangles.end() - 1, mesh.triangles.end());
  EXPECT_EQ(shape(mesh).mean_fan_length, 3);
}

TEST(Shape, AStripIsNotOneFan) {
  // 0-1-2, 1-3-2, 2-3-4, 3-5-4: three triangles share vertex 2 (or 3), the fourth begins anew.
  Mesh mesh;
  for (int k = 0; k < 6; ++k)
    mesh.positions.push_back({static_cast<double>(k / 2), static_cast<double>(k % 2), 0});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
  EXPECT_EQ(shape(mesh).mean_fan_length, 2);
}

TEST(Shape, TurnedOverTrianglesCountByTheirArea) {
  const ShapeReport report = shape(one_triangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0}));
  EXPECT_DOUBLE_EQ(report.min_quality, std::sqrt(3.0) / 2);
}

TEST(Shape, SizeDoesNotMatter) {
  for (const double size : {0x1p-1040, 0x1p-600, 0x1p-20, 0x1p30, 0x1p600, 0x1p1022}) {
    const ShapeReport report = shape(one_triangle({-size, 0, 0}, {size, 0, 0}, {0, size, 0}));
    EXPECT_DOUBLE_EQ(report.least_angle_deg, 45) << size;
    EXPECT_DOUBLE_EQ(report.min_quality, std::sqrt(3.0) / 2) << size;
  }
}

TEST(Shape, UnusableTrianglesAreSkipped) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, std::numeric_limits<double>::quiet_NaN()}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 7}};
  for (const Mesh& empty : {mesh, Mesh{}}) {
    const ShapeReport report = shape(empty);
    EXPECT_EQ(report.min_quality, 0);
    EXPECT_EQ(report.least_angle_deg, 0);
    EXPECT_EQ(report.max_valence, 0u);
    EXPECT_EQ(report.mean_valence, 0);
    EXPECT_EQ(report.mean_fan_length, 0);
  }
}

TEST(Shape, MatchesAnglesFromDirections) {
  // The slow twin: each corner's angle from the directions of its sides.
  Random random(31);
  for (int round = 0; round < 500; ++round) {
    const auto draw = [&] { return Vec3{random.between(-5, 5), random.between(-5, 5), random.unit()}; };
    const Mesh mesh = one_triangle(draw(), draw(), draw());
    double least_deg = 180;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 to = mesh.positions[(k + 1) % 3] - mesh.positions[k];
      const Vec3 from = mesh.positions[(k + 2) % 3] - mesh.positions[k];
      double turn = std::fabs(exact_atan2(to.y, to.x) - exact_atan2(from.y, from.x));
      turn = std::min(turn, 2 * kPi - turn);
      least_deg = std::min(least_deg, turn / kRadiansPerDegree);
    }
    // Directions are differences of two angles up to 180 degrees: they carry that absolute error.
    EXPECT_NEAR(shape(mesh).least_angle_deg, least_deg, 180 * kRelativeTolerance);
  }
}

TEST(EdgeLengths, InPlanAndInSpace) {
  // Sides 3, 4, 5 in plan; the vertex at (3, 0) stands 4 up: 5, √32, 5 in space.
  const Mesh mesh{{{0, 0, 0}, {3, 0, 4}, {3, 4, 0}}, {{0, 1, 2}}};
  const EdgeLengths plan = edge_lengths(mesh, false), space = edge_lengths(mesh, true);
  EXPECT_EQ(plan.shortest, 3);
  EXPECT_EQ(plan.median, 4);
  EXPECT_EQ(plan.shortest_vertices, (std::array{0u, 1u}));
  EXPECT_EQ(space.shortest, 5);
  EXPECT_EQ(space.median, 5);
  EXPECT_EQ(space.shortest_vertices, (std::array{0u, 1u})) << "of equals the first";
}

TEST(EdgeLengths, WhatHasNoLengthDoesNotCount) {
  // A wall's upright edge has none in plan, a repeated place none at all.
  Mesh mesh{{{0, 0, 0}, {0, 0, -2}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 9}}};
  EXPECT_EQ(edge_lengths(mesh, false).shortest, 1);
  EXPECT_EQ(edge_lengths(mesh, false).median, 1);
  EXPECT_EQ(edge_lengths(mesh, true).shortest, 1);
  EXPECT_EQ(edge_lengths(mesh, true).median, 1) << "1, 1, 1, 2, √5";
  mesh.positions[2].x = mesh.positions[3].x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(edge_lengths(mesh, false).shortest, 0);
  EXPECT_EQ(edge_lengths(mesh, true).median, 2);
  EXPECT_EQ(edge_lengths({}, true).shortest, 0);
  EXPECT_EQ(edge_lengths({}, true).median, 0);
}

TEST(EdgeLengths, SizeDoesNotMatter) {
  for (const double size : {0x1p-1060, 0x1p-600, 1.0, 0x1p600, 0x1p1020}) {
    const Mesh mesh{{{0, 0, 0}, {3 * size, 0, 0}, {3 * size, 4 * size, 0}}, {{0, 1, 2}}};
    for (const bool in_space : {false, true}) {
      EXPECT_EQ(edge_lengths(mesh, in_space).shortest, 3 * size);
      EXPECT_EQ(edge_lengths(mesh, in_space).median, 4 * size);
    }
  }
}

TEST(EdgeLengths, MatchesAllLengthsSorted) {
  Random random(32);
  for (int round = 0; round < 300; ++round) {
    Mesh mesh;
    const std::size_t vertices = 3 + random.below(60), triangles = 1 + random.below(120);
    // From a few whole numbers (many equal lengths), or of sizes apart by any factor.
    const bool whole = random.below(2) == 0;
    const auto coordinate = [&] {
      return whole ? static_cast<double>(random.below(4))
                   : std::ldexp(random.between(-1, 1), static_cast<int>(random.below(40)) - 20);
    };
    for (std::size_t v = 0; v < vertices; ++v)
      mesh.positions.push_back({coordinate(), coordinate(), coordinate()});
    for (std::size_t t = 0; t < triangles; ++t) {
      mesh.triangles.push_back({static_cast<std::uint32_t>(random.below(vertices)),
                                static_cast<std::uint32_t>(random.below(vertices)),
                                static_cast<std::uint32_t>(random.below(vertices))});
    }
    for (const bool in_space : {false, true}) {
      std::vector<double> all;
      for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 d = mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]];
          const double length = std::sqrt(d.x * d.x + d.y * d.y + (in_space ? d.z * d.z : 0));
          if (length > 0) all.push_back(length);
        }
      }
      std::sort(all.begin(), all.end());
      const EdgeLengths found = edge_lengths(mesh, in_space);
      EXPECT_EQ(found.shortest, all.empty() ? 0 : all.front());
      EXPECT_EQ(found.median, all.empty() ? 0 : all[(all.size() - 1) / 2]);
      if (all.empty()) continue;
      const Vec3 d = mesh.positions[found.shortest_vertices[1]] - mesh.positions[found.shortest_vertices[0]];
      EXPECT_EQ(std::sqrt(d.x * d.x + d.y * d.y + (in_space ? d.z * d.z : 0)), found.shortest);
    }
  }
}

}  // namespace
}  // namespace plumbline::oracle
