// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/placement.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/random.h"
#include "scenarios/terrain_source.h"
#include "tests/oracle/vertical_support.h"

namespace plumbline::oracle {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Kind = MisplacementKind;

/// Rough ground of any size.
Terrain rough(int columns, int rows, std::uint64_t seed, double spacing_m = 1) {
  TerrainSource source;
  source.id = "rough";
  source.generator = "fbm";
  source.size = 129;
  source.seed = seed;
  Terrain terrain = cropped(load_terrain(source), columns, rows);
  terrain.spacing_m = spacing_m;
  return terrain;
}

/// Some samples, as a greedy mesh keeps them, in sample units; heights err by up to `noise_m`.
std::vector<Vec3> some_samples(const Terrain& terrain, std::uint64_t seed, double noise_m = 0) {
  Random random(seed);
  std::vector<Vec3> vertices;
  for (int k = 0; k < 400; ++k) {
    const int i = static_cast<int>(random.below(static_cast<std::uint64_t>(terrain.columns)));
    const int j = static_cast<int>(random.below(static_cast<std::uint64_t>(terrain.rows)));
    vertices.push_back({static_cast<double>(i), static_cast<double>(j),
                        terrain.z(i, j) + random.between(-noise_m, noise_m)});
  }
  return vertices;
}

struct Planted {
  Kind kind;
  std::function<Vec3(Vec3, Vec2 last)> fault;  ///< what a wrong program did to a right mesh
};

const std::vector<Planted>& planted() {
  static const std::vector<Planted> all{
      {Kind::rows_flipped,
       [](Vec3 p, Vec2 last) {
         return Vec3{p.x, last.y - p.y, p.z};
       }},
      {Kind::columns_flipped,
       [](Vec3 p, Vec2 last) {
         return Vec3{last.x - p.x, p.y, p.z};
       }},
      {Kind::rotated_180,
       [](Vec3 p, Vec2 last) {
         return Vec3{last.x - p.x, last.y - p.y, p.z};
       }},
      // Rows and columns of the matrix swapped, its first row in the north, stretched over the same ground.
      {Kind::transposed,
       [](Vec3 p, Vec2 last) {
         const double column = p.x, row = last.y - p.y;
         return Vec3{row * last.x / last.y, last.y - column * last.y / last.x, p.z};
       }},
      {Kind::anti_transposed,
       [](Vec3 p, Vec2 last) {
         return Vec3{p.y * last.x / last.y, p.x * last.y / last.x, p.z};
       }},
      // Turned clockwise by the fault, so it has to be turned back.
      {Kind::rotated_90,
       [](Vec3 p, Vec2 last) {
         return Vec3{p.y * last.x / last.y, last.y - p.x * last.y / last.x, p.z};
       }},
      {Kind::rotated_270,
       [](Vec3 p, Vec2 last) {
         return Vec3{last.x - p.y * last.x / last.y, p.x * last.y / last.x, p.z};
       }},
      {Kind::height_offset,
       [](Vec3 p, Vec2) {
         return Vec3{p.x, p.y, p.z + 47.5};
       }},
      {Kind::height_factor,
       [](Vec3 p, Vec2) {
         return Vec3{p.x, p.y, p.z / 0.3048};
       }},
      {Kind::height_factor,
       [](Vec3 p, Vec2) {
         return Vec3{p.x, p.y, p.z * 0.3048};
       }},
      {Kind::height_factor,
       [](Vec3 p, Vec2) {
         return Vec3{p.x, p.y, p.z * 2.5};
       }},
      {Kind::cells_for_samples,
       [](Vec3 p, Vec2 last) {
         return Vec3{p.x * (last.x + 1) / last.x, p.y * (last.y + 1) / last.y, p.z};
       }},
      {Kind::cells_for_samples,
       [](Vec3 p, Vec2 last) {
         return Vec3{p.x * last.x / (last.x + 1), p.y * last.y / (last.y + 1), p.z};
       }},
      {Kind::cells_for_samples,  // over the cells' whole rectangle, half a cell beyond the samples
       [](Vec3 p, Vec2 last) {
         return Vec3{p.x * (last.x + 1) / last.x - 0.5, p.y * (last.y + 1) / last.y - 0.5, p.z};
       }},
      {Kind::shifted,
       [](Vec3 p, Vec2) {
         return Vec3{p.x + 0.5, p.y + 0.5, p.z};
       }},
      {Kind::shifted,
       [](Vec3 p, Vec2) {
         return Vec3{p.x - 0.5, p.y, p.z};
       }},
      {Kind::shifted,
       [](Vec3 p, Vec2) {
         return Vec3{p.x, p.y - 1, p.z};
       }},
      {Kind::shifted,
       [](Vec3 p, Vec2) {
         return Vec3{p.x - 3, p.y + 7, p.z};
       }},
      {Kind::shifted,
       [](Vec3 p, Vec2) {
         return Vec3{p.x + 8, p.y - 7.5, p.z};
       }},
  };
  return all;
}

TEST(Placement, EveryPlantedFaultIsRecognisedAsItself) {
  for (const auto& [columns, rows] : {std::pair{65, 65}, std::pair{97, 61}, std::pair{50, 129}}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Terrain terrain = rough(columns, rows, seed);
      const Vec2 last{columns - 1.0, rows - 1.0};
      for (std::size_t n = 0; n < planted().size(); ++n) {
        std::vector<Vec3> vertices = some_samples(terrain, seed);
        for (Vec3& p : vertices) p = planted()[n].fault(p, last);
        const auto found = recognise_misplacement(vertices, terrain);
        ASSERT_TRUE(found) << "fault " << n << ", " << columns << " x " << rows << ", seed " << seed;
        EXPECT_EQ(misplacement_name(found->kind), misplacement_name(planted()[n].kind)) << found->words;
        EXPECT_LT(found->rms_m, 1e-9 * found->given_rms_m) << found->words;
        EXPECT_LE(found->vertices, 400U);
        EXPECT_THAT(found->words, StartsWith("matches if "));
      }
    }
  }
}

TEST(Placement, APartIsTurnedWithinItsOwnBox) {
  // A tile of larger ground, flipped or turned by its maker before it was put where it belongs.
  const Terrain terrain = rough(97, 97, 11);
  std::size_t tried = 0;
  for (const Planted& one : planted()) {
    if (one.kind > Kind::rotated_270) continue;
    std::vector<Vec3> vertices;
    for (int j = 0; j <= 24; j += 2) {
      for (int i = 0; i <= 36; i += 2) {
        const Vec3 p = one.fault({i * 1.0, j * 1.0, terrain.z(20 + i, 50 + j)}, {36, 24});
        vertices.push_back({20 + p.x, 50 + p.y, p.z});
      }
    }
    const auto found = recognise_misplacement(vertices, terrain);
    ASSERT_TRUE(found) << misplacement_name(one.kind);
    EXPECT_EQ(found->kind, one.kind) << found->words;
    EXPECT_LT(found->rms_m, 1e-9 * found->given_rms_m) << found->words;
    ++tried;
  }
  EXPECT_EQ(tried, 7U);
}

TEST(Placement, RemediesAreNumbers) {
  const Terrain terrain = rough(65, 65, 4, 30);
  const auto after = [&](auto fault) {
    std::vector<Vec3> vertices = some_samples(terrain, 5);
    for (Vec3& p : vertices) {
      p = fault(p);
      p.x *= 30;
      p.y *= 30;
    }
    const auto found = recognise_misplacement(vertices, terrain);
    EXPECT_TRUE(found);
    return found.value_or(Misplacement{});
  };
  const Misplacement moved = after([](Vec3 p) { return Vec3{p.x - 0.5, p.y + 2, p.z}; });
  EXPECT_EQ(moved.shift, (Vec2{0.5, -2}));
  EXPECT_THAT(moved.words, HasSubstr("moved 0.5 samples east and 2 samples south: RMS 0 m instead of "));
  const Misplacement lifted = after([](Vec3 p) { return Vec3{p.x, p.y, p.z + 47.5}; });
  EXPECT_NEAR(lifted.offset_m, -47.5, 1e-9);
  EXPECT_THAT(lifted.words, HasSubstr("lowered by 47.5 m"));
  EXPECT_NEAR(lifted.given_rms_m, 47.5, 1e-9);
  const Misplacement feet = after([](Vec3 p) { return Vec3{p.x, p.y, p.z / 0.3048}; });
  EXPECT_EQ(feet.factor, 0.3048);
  EXPECT_THAT(feet.words, HasSubstr("feet taken for metres"));
  const Misplacement exaggerated = after([](Vec3 p) { return Vec3{p.x, p.y, p.z * 2}; });
  EXPECT_NEAR(exaggerated.factor, 0.5, 1e-12);
  const Misplacement flipped = after([](Vec3 p) { return Vec3{p.x, 64 - p.y, p.z}; });
  EXPECT_THAT(flipped.words, HasSubstr("rows are flipped"));
}

TEST(Placement, FaultsShowThroughAMeshsOwnError) {
  const Terrain terrain = rough(97, 61, 6);
  const double relief_m = terrain.highest_m() - terrain.lowest_m();
  std::size_t tried = 0;
  for (const Planted& one : planted()) {
    // What lies wrong by a sample or less costs about as much as this mesh errs.
    if (one.kind == Kind::cells_for_samples || one.kind == Kind::shifted) continue;
    std::vector<Vec3> vertices = some_samples(terrain, 7, 0.01 * relief_m);
    for (Vec3& p : vertices) p = one.fault(p, {96, 60});
    const auto found = recognise_misplacement(vertices, terrain);
    ASSERT_TRUE(found) << misplacement_name(one.kind);
    EXPECT_EQ(found->kind, one.kind) << found->words;
    ++tried;
  }
  EXPECT_EQ(tried, 11U);
}

TEST(Placement, NothingIsWrongWithARightMesh) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Terrain terrain = rough(97, 61, seed);
    EXPECT_FALSE(recognise_misplacement(some_samples(terrain, seed), terrain));
    for (const double noise_m : {1e-9, 0.1, 1.0, 10.0, 100.0}) {
      const auto found = recognise_misplacement(some_samples(terrain, seed, noise_m), terrain);
      EXPECT_FALSE(found) << noise_m << ": " << found->words;
    }
  }
}

TEST(Placement, NothingIsWrongWithAMeshThatIsMerelyCoarse) {
  // Every eighth sample, and each of its vertices the mean of the ground around it: as an averaging
  // simplifier displaces them.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Terrain terrain = rough(97, 97, seed);
    std::vector<Vec3> vertices;
    for (int j = 4; j < 97; j += 8) {
      for (int i = 4; i < 97; i += 8) {
        double sum = 0;
        for (int b = j - 4; b <= j + 4; ++b) {
          for (int a = i - 4; a <= i + 4; ++a) sum += terrain.z(a, b);
        }
        vertices.push_back({static_cast<double>(i), static_cast<double>(j), sum / 81});
      }
    }
    const auto found = recognise_misplacement(vertices, terrain);
    EXPECT_FALSE(found) << found->words;
  }
}

TEST(Placement, OnFlatAndSymmetricGroundNothingIsSaid) {
  const Terrain flat = test::make_terrain(40, 40, 1, [](int, int) { return 12.0; });
  EXPECT_FALSE(recognise_misplacement(some_samples(flat, 1), flat));
  EXPECT_FALSE(recognise_misplacement(some_samples(flat, 1, 1), flat)) << "noise fits nothing better";
  // A round hill is its own image; flipping it changes nothing.
  const Terrain hill = test::make_terrain(41, 41, 1, [](int i, int j) {
    return 500.0 / (1 + 0.01 * ((i - 20) * (i - 20) + (j - 20) * (j - 20)));
  });
  std::vector<Vec3> vertices = some_samples(hill, 2);
  for (Vec3& p : vertices) p.y = 40 - p.y;
  EXPECT_FALSE(recognise_misplacement(vertices, hill));
}

TEST(Placement, OfEquallyGoodReasonsTheSimplerIsNamed) {
  // On a plane that falls to the east a shift is an offset.
  const Terrain plane = test::make_terrain(40, 40, 1, [](int i, int) { return 100 - 2.0 * i; });
  std::vector<Vec3> vertices = some_samples(plane, 3);
  for (Vec3& p : vertices) p.x += 3;
  const auto found = recognise_misplacement(vertices, plane);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Kind::height_offset) << found->words;
}

TEST(Placement, FewVerticesProveNothingAndHolesAreNotCompared) {
  const Terrain terrain = rough(65, 65, 8);
  std::vector<Vec3> vertices = some_samples(terrain, 9);
  for (Vec3& p : vertices) p.y = 64 - p.y;
  EXPECT_FALSE(recognise_misplacement(std::span(vertices).first(kMisplacementVertices - 1), terrain));
  EXPECT_FALSE(recognise_misplacement({}, terrain));
  // The northern half holds placeholders; they must not be looked at.
  std::vector<std::uint8_t> has_data(terrain.heights_m.size(), 1);
  Terrain holed = terrain;
  for (int j = 33; j < 65; ++j) {
    for (int i = 0; i < 65; ++i) {
      has_data[terrain.index(i, j)] = 0;
      holed.heights_m[terrain.index(i, j)] = 1e5;
    }
  }
  const auto found = recognise_misplacement(vertices, holed, has_data);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Kind::rows_flipped);
  EXPECT_EQ(found->rms_m, 0);
  EXPECT_LT(found->vertices, 250U);
  // Far away there is nothing to compare.
  for (Vec3& p : vertices) p.x += 1000;
  EXPECT_FALSE(recognise_misplacement(vertices, terrain));
}

TEST(Placement, ManyVerticesAreDrawnFromAlwaysTheSame) {
  const Terrain terrain = rough(129, 129, 10);
  std::vector<Vec3> vertices;
  for (int j = 0; j < 129; ++j) {
    for (int i = 0; i < 129; ++i)
      vertices.push_back({static_cast<double>(j), static_cast<double>(i), terrain.z(i, j)});
  }
  ASSERT_GT(vertices.size(), kMisplacementSample);
  const auto found = recognise_misplacement(vertices, terrain);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Kind::anti_transposed);
  EXPECT_EQ(found->vertices, kMisplacementSample);
  EXPECT_EQ(found->given_rms_m, recognise_misplacement(vertices, terrain)->given_rms_m);
}

}  // namespace
}  // namespace plumbline::oracle
