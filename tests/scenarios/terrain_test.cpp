// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/terrain.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "scenarios/portable_math.h"
#include "scenarios/random.h"

namespace plumbline {
namespace {

// One cell, 10 m: heights 0, 1 (east), 2 (north), 7 (north-east); its diagonal runs from south-west to
// north-east.
Terrain one_cell() { return {"cell", 2, 2, 10, {0, 1, 2, 7}}; }

TEST(Terrain, SurfaceFollowsTheDeclaredDiagonal) {
  const Terrain terrain = one_cell();
  EXPECT_EQ(terrain.surface_height_m(5, 5), 3.5) << "on the diagonal: halfway from 0 to 7";
  EXPECT_EQ(terrain.surface_height_m(5, 0), 0.5);
  EXPECT_EQ(terrain.surface_height_m(10, 5), 4);
  EXPECT_EQ(terrain.surface_height_m(0, 5), 1);
  EXPECT_EQ(terrain.surface_height_m(7.5, 2.5), 0.75 * 1 + 0.25 * 6) << "south-east triangle";
  EXPECT_EQ(terrain.surface_height_m(2.5, 7.5), 0.75 * 2 + 0.25 * 5) << "north-west triangle";
  EXPECT_EQ(terrain.surface_height_m(-99, 99), 2) << "outside: the nearest border point";
}

TEST(Terrain, ReferenceMeshLiesOnTheSurface) {
  const Terrain terrain{"t", 3, 2, 2, {0, 5, 1, 3, -2, 4}};
  const Mesh mesh = reference_mesh(terrain);
  ASSERT_EQ(mesh.positions.size(), 6u);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 4}));
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 4, 3}));
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]];
    const Vec3 b = mesh.positions[t[1]];
    const Vec3 c = mesh.positions[t[2]];
    EXPECT_GT(cross(b - a, c - a).z, 0) << "counter-clockwise from above";
    const Vec3 middle = (a + b + c) * (1.0 / 3);
    EXPECT_NEAR(terrain.surface_height_m(middle.x, middle.y), middle.z, 1e-12);
  }
}

TEST(Terrain, ExtremesAndDomain) {
  const Terrain terrain = one_cell();
  EXPECT_EQ(terrain.lowest_m(), 0);
  EXPECT_EQ(terrain.highest_m(), 7);
  const PlanDomain domain = full_domain(terrain);
  ASSERT_EQ(domain.loops.size(), 1u);
  EXPECT_EQ(domain.loops[0], (std::vector<Vec2>{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
}

// The reference implementation's first outputs for seed 0 (Vigna's splitmix64.c).
TEST(Random, IsSplitMix64) {
  Random random(0);
  EXPECT_EQ(random.bits(), 0xe220a8397b1dcdafu);
  EXPECT_EQ(random.bits(), 0x6e789e6aa1b965f4u);
  EXPECT_EQ(random.bits(), 0x06c45d188009454fu);
}

TEST(Random, StreamsDifferAndRangesHold) {
  EXPECT_NE(Random(1, "a").bits(), Random(1, "b").bits());
  EXPECT_NE(Random(1, "a").bits(), Random(2, "a").bits());
  Random random(3);
  std::set<std::uint64_t> seen;
  for (int k = 0; k < 1000; ++k) {
    const double unit = random.unit();
    EXPECT_GE(unit, 0);
    EXPECT_LT(unit, 1);
    const std::uint64_t below = random.below(7);
    EXPECT_LT(below, 7u);
    seen.insert(below);
  }
  EXPECT_EQ(seen.size(), 7u);
}

TEST(LatticeHash, DependsOnEveryArgument) {
  const std::uint64_t hash = lattice_hash(1, 2, 3);
  EXPECT_NE(lattice_hash(2, 2, 3), hash);
  EXPECT_NE(lattice_hash(1, 3, 3), hash);
  EXPECT_NE(lattice_hash(1, 2, 4), hash);
  EXPECT_NE(lattice_hash(1, 3, 2), hash);
  EXPECT_EQ(lattice_hash(1, 2, 3), hash);
}

// Against the C library, which is within one unit in the last place; and at values that are known.
TEST(PortableMath, AgreesWithTheLibraryToItsLastPlace) {
  for (double x = -7; x <= 7; x += 0.37) {
    EXPECT_DOUBLE_EQ(exact_sin(x), std::sin(x));
    EXPECT_DOUBLE_EQ(exact_cos(x), std::cos(x));
    EXPECT_DOUBLE_EQ(exact_tan(x), std::tan(x));
    EXPECT_DOUBLE_EQ(exact_pow(2.5, x), std::pow(2.5, x));
  }
  EXPECT_EQ(exact_sin(0), 0);
  EXPECT_EQ(exact_cos(0), 1);
  EXPECT_EQ(exact_pow(2, 10), 1024);
  EXPECT_EQ(exact_sin(kPi), 0x1.1a62633145c07p-53) << "the rounding error of pi itself";
}

}  // namespace
}  // namespace plumbline
