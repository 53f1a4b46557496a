// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/generators.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "support.h"

namespace plumbline {
namespace {

Terrain generate(const std::string& generator, int size, std::uint64_t seed = 1) {
  TerrainSource source;
  source.id = "t";
  source.generator = generator;
  source.size = size;
  source.seed = seed;
  return load_terrain(source);
}

// The bits of every generator's 65 × 65 terrain. A change here is a change of every result: it belongs into
// the changelog.
const std::map<std::string, std::uint64_t> kGolden{
    {"plane", 0x6207dd6b951489c5},        {"tilted_plane", 0xc9228bba76d589c3},
    {"cliff", 0xb6c93f076aca33eb},        {"sine", 0xe241c0f20e9956dc},
    {"fbm", 0x8c971a5543d84831},          {"ridged", 0x6a207e400060b10d},
    {"canyon", 0x81b79a88ec76e191},       {"spike", 0xba2015acff6b592},
    {"checkerboard", 0x8a33939e4b672471}, {"island", 0x701a5164d95a1b21},
};

TEST(Generators, SameBitsWithEveryCompilerAndBuild) {
  for (const GeneratorDescription& generator : terrain_generators()) {
    test::BitHash hash;
    hash.add(generate(generator.name, 65).heights_m);
    EXPECT_TRUE(kGolden.contains(generator.name)) << generator.name << " has no golden hash";
    EXPECT_EQ(hash.value(), kGolden.contains(generator.name) ? kGolden.at(generator.name) : 0)
        << generator.name << std::hex << " gives 0x" << hash.value();
  }
}

TEST(Generators, DefaultsAndShape) {
  TerrainSource source;
  source.id = "t";
  source.generator = "fbm";
  const Terrain terrain = load_terrain(source);
  EXPECT_EQ(terrain.columns, 257);
  EXPECT_EQ(terrain.rows, 257);
  EXPECT_EQ(terrain.spacing_m, 30);
  EXPECT_EQ(terrain.heights_m.size(), 257u * 257u);
  EXPECT_EQ(terrain.lowest_m(), 0);
  EXPECT_NEAR(terrain.highest_m(), 1000, 1e-9);
}

TEST(Generators, ReliefIsKept) {
  for (const GeneratorDescription& generator : terrain_generators()) {
    TerrainSource source;
    source.id = "t";
    source.generator = generator.name;
    source.size = 33;
    source.relief_m = 500;
    const Terrain terrain = load_terrain(source);
    EXPECT_GE(terrain.lowest_m(), 0) << generator.name;
    EXPECT_LE(terrain.highest_m(), 500) << generator.name;
    if (generator.name != "plane") {
      EXPECT_GT(terrain.highest_m() - terrain.lowest_m(), 400) << generator.name;
    }
  }
}

TEST(Generators, SmallestAndOddSizes) {
  for (const GeneratorDescription& generator : terrain_generators()) {
    for (const int size : {2, 3, 4, 5, 100}) {
      const Terrain terrain = generate(generator.name, size);
      EXPECT_EQ(terrain.columns, size);
      for (const double z : terrain.heights_m) ASSERT_TRUE(std::isfinite(z)) << generator.name << " " << size;
    }
  }
}

TEST(Generators, SeedMatters) {
  for (const char* name : {"fbm", "ridged", "canyon", "checkerboard", "island"}) {
    EXPECT_NE(generate(name, 33, 1).heights_m, generate(name, 33, 2).heights_m) << name;
  }
}

TEST(Generators, TiltedPlaneIsExactlyPlanar) {
  const Terrain terrain = generate("tilted_plane", 129);
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    for (int i = 0; i + 1 < terrain.columns; ++i) {
      ASSERT_EQ(terrain.z(i, j) + terrain.z(i + 1, j + 1), terrain.z(i + 1, j) + terrain.z(i, j + 1));
      ASSERT_EQ(terrain.z(i + 1, j) - terrain.z(i, j), terrain.z(1, 0) - terrain.z(0, 0));
    }
  }
}

TEST(Generators, CliffHasAStepWithinOneCell) {
  const Terrain terrain = generate("cliff", 65);
  double steepest_m = 0;
  for (int i = 0; i + 1 < terrain.columns; ++i) {
    steepest_m = std::max(steepest_m, terrain.z(i + 1, 10) - terrain.z(i, 10));
  }
  EXPECT_EQ(steepest_m, terrain.highest_m() / 2);
}

TEST(Generators, SpikeIsOneSample) {
  const Terrain terrain = generate("spike", 33);
  EXPECT_EQ(std::count(terrain.heights_m.begin(), terrain.heights_m.end(), 0.0), 33 * 33 - 1);
  EXPECT_GT(terrain.z(16, 16), 0);
}

TEST(Generators, IslandIsSurroundedByFlatSea) {
  const Terrain terrain = generate("island", 129);
  for (int k = 0; k < 129; ++k) {
    EXPECT_EQ(terrain.z(k, 0), 0);
    EXPECT_EQ(terrain.z(k, 128), 0);
    EXPECT_EQ(terrain.z(0, k), 0);
    EXPECT_EQ(terrain.z(128, k), 0);
  }
  const auto sea = std::count(terrain.heights_m.begin(), terrain.heights_m.end(), 0.0);
  EXPECT_GT(sea, 129 * 129 / 5);
  EXPECT_LT(sea, 129 * 129 * 4 / 5);
}

// Real relief: slopes of tens of degrees, at every scale about as steep (the structure function grows with
// distance).
TEST(Generators, FractalReliefGrowsWithDistance) {
  const Terrain terrain = generate("fbm", 513);
  double previous_m = 0;
  for (const int lag : {1, 2, 4, 8, 16, 32, 64}) {
    double sum = 0;
    int count = 0;
    for (int j = 0; j < terrain.rows; j += 8) {
      for (int i = 0; i + lag < terrain.columns; ++i, ++count)
        sum += std::fabs(terrain.z(i + lag, j) - terrain.z(i, j));
    }
    const double mean_m = sum / count;
    EXPECT_GT(mean_m, 1.3 * previous_m) << "lag " << lag;
    if (previous_m > 0) {
      EXPECT_LT(mean_m, 2 * previous_m) << "lag " << lag;
    }
    previous_m = mean_m;
  }
}

TEST(Generators, BadNumbersAreRefused) {
  const auto message = [](auto change) {
    TerrainSource source;
    source.id = "t";
    source.generator = "fbm";
    change(source);
    return test::input_error([&] { (void)load_terrain(source); });
  };
  EXPECT_EQ(message([](TerrainSource& s) { s.generator = "fmb"; }),
            "terrain 't': unknown generator 'fmb'; did you mean 'fbm'?");
  EXPECT_EQ(message([](TerrainSource& s) { s.size = 1; }),
            "terrain 't': size is 1; give 2 to 16385 samples a side");
  EXPECT_EQ(message([](TerrainSource& s) { s.size = 2'000'000'000; }),
            "terrain 't': size is 2000000000; give 2 to 16385 samples a side");
  EXPECT_EQ(message([](TerrainSource& s) { s.spacing_m = 0; }),
            "terrain 't': spacing_m is 0; give 1e-06 to 1000000");
  EXPECT_EQ(message([](TerrainSource& s) { s.relief_m = -1; }),
            "terrain 't': relief_m is -1; give 0 to 1000000");
  EXPECT_EQ(message([](TerrainSource& s) { s.z_scale = std::nan(""); }),
            "terrain 't': z_scale is nan; give a finite number");
  EXPECT_EQ(message([](TerrainSource& s) { s.file = "also.tif"; }),
            "terrain 't': needs exactly one of file, points, generator, samples");
  EXPECT_THAT(message([](TerrainSource& s) { s.z_scale = 1e9; }), testing::HasSubstr("mend z_scale"));
}

}  // namespace
}  // namespace plumbline
