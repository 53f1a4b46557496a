// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The figures of vertical error, shape, stability and likeness under the moves of symmetry.h: equal to the
// bit where the arithmetic is the same, else within a bound that says what was summed in another order.
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "oracle/likeness.h"
#include "oracle/shape.h"
#include "oracle/stability.h"
#include "oracle/vertical.h"
#include "properties/faults/faults.h"
#include "tests/oracle/conformity_meshes.h"
#include "tests/oracle/symmetry.h"
#include "tests/oracle/vertical_support.h"

namespace plumbline::oracle {
namespace {

using plumbline::test::Move;
namespace support = plumbline::test;

/// A terrain of random heights, multiples of 2⁻²⁰ m. `even`: z = f(x) + g(y), so that both diagonals of a
/// cell are the same surface and no symmetry changes the reference.
Terrain random_terrain(int columns, int rows, bool even, Random& random) {
  std::vector<double> f, g;
  for (int i = 0; i < columns; ++i) f.push_back(support::dyadic(random.between(0, 20)));
  for (int j = 0; j < rows; ++j) g.push_back(support::dyadic(random.between(0, 20)));
  return support::make_terrain(columns, rows, 4, [&](int i, int j) {
    return even ? f[static_cast<std::size_t>(i)] + g[static_cast<std::size_t>(j)]
                : support::dyadic(random.between(0, 20));
  });
}

/// A terrain's full mesh with one fault of the catalogue, or some vertices raised.
Mesh faulty_mesh(const Terrain& terrain, Random& random) {
  Mesh mesh = reference_mesh(terrain);
  if (random.below(3) == 0) {
    for (int k = 0; k < 4; ++k)
      mesh.positions[random.below(mesh.positions.size())].z += support::dyadic(random.between(-5, 5));
    return mesh;
  }
  const auto& kinds = faults::fault_kinds();
  const auto fault =
      faults::plant(kinds[random.below(kinds.size())].name, mesh, full_domain(terrain), random);
  return fault ? fault->mesh : mesh;
}

/// rms, mean and area are compensated sums in mesh order: the order is the same here, but the pieces of a
/// triangle come in another. Some hundred roundings of each piece.
constexpr double kSumRounding = 0x1p-44;

void expect_near(const VerticalError& one, const VerticalError& two, double bound_m, bool same_diagonal,
                 const std::string& context) {
  EXPECT_NEAR(one.certain_max, two.certain_max, bound_m) << context;
  EXPECT_NEAR(one.area_m2, two.area_m2, kSumRounding * one.area_m2) << context;
  if (!same_diagonal) return;
  EXPECT_NEAR(one.max, two.max, bound_m) << context;
  EXPECT_NEAR(one.rms, two.rms, kSumRounding * one.rms + bound_m) << context;
  EXPECT_NEAR(one.mean, two.mean, kSumRounding * one.mean + bound_m) << context;
}

TEST(SymmetryVertical, EightSymmetriesOverFaultyMeshes) {
  std::size_t faulty = 0, certain = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Random random(seed, "vertical");
    const bool even = seed % 2 == 0;
    const Terrain terrain = random_terrain(5 + static_cast<int>(seed % 3), 6, even, random);
    const Mesh mesh = faulty_mesh(terrain, random);
    const VerticalError before = vertical_error(mesh, terrain);
    faulty += before.max > 0;
    certain += before.certain_max > 0;
    // Both evaluate every value within kVerticalRoundingFactor of the exact one.
    const double range_m = terrain.highest_m() - terrain.lowest_m() + 10;
    const double bound_m = 2 * kVerticalRoundingFactor * 0x1p-53 * range_m;
    for (int number = 1; number < 8; ++number) {
      const Move move = support::symmetry_of(number, terrain);
      const Terrain other = support::moved(terrain, move);
      const VerticalError after = vertical_error(move(mesh), other);
      const std::string context = "seed " + std::to_string(seed) + ", " + move.name();
      // A flip of one axis turns the declared diagonal into the other one; where both are the same surface
      // that changes nothing.
      expect_near(before, after, bound_m, even || move.flip_x == move.flip_y, context);
      EXPECT_EQ(diagonal_ambiguity_m(terrain), diagonal_ambiguity_m(other)) << context;
      if (even || move.flip_x == move.flip_y) {
        // The place moves along, or there is another as high.
        const Vec2 at = move(before.at);
        const bool same_place = at == after.at;
        EXPECT_TRUE(same_place || std::fabs(before.max - after.max) <= bound_m) << context;
      }
    }
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(faulty, 60U);
  EXPECT_GT(certain, 40U);
}

TEST(SymmetryVertical, WhereEveryValueIsADoubleEveryFigureOfTheMaximumIsToo) {
  // Vertices on samples, heights multiples of 2⁻²⁰, triangles that are halves of squares of 2ᵏ cells: every
  // visited height is exact, so the maxima are equal to the bit in all eight.
  std::size_t faulty = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed, "exact");
    const Terrain terrain = random_terrain(9, 9, true, random);
    support::Surface s = support::random_bintree(3, random);
    for (Vec3& p : s.mesh.positions) p = {p.x * 4, p.y * 4, support::dyadic(random.between(0, 40))};
    const VerticalError before = vertical_error(s.mesh, terrain);
    faulty += before.max > 0;
    for (int number = 1; number < 8; ++number) {
      const Move move = support::symmetry_of(number, terrain);
      const VerticalError after = vertical_error(move(s.mesh), support::moved(terrain, move));
      EXPECT_EQ(before.max, after.max) << seed << ' ' << move.name();
      EXPECT_EQ(before.certain_max, after.certain_max) << seed << ' ' << move.name();
      EXPECT_EQ(before.area_m2, after.area_m2) << seed << ' ' << move.name();
      EXPECT_NEAR(before.rms, after.rms, kSumRounding * before.rms);
      EXPECT_NEAR(before.mean, after.mean, kSumRounding * before.mean);
    }
  }
  EXPECT_EQ(faulty, 100U);
}

TEST(SymmetryVertical, ScalesAndOrders) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed, "scales");
    const Terrain terrain = random_terrain(6, 6, false, random);
    const Mesh mesh = faulty_mesh(terrain, random);
    const VerticalError before = vertical_error(mesh, terrain);
    for (const double scale : {0x1p-60, 0.5, 0x1p60}) {
      Move move;
      move.scale = scale;
      const VerticalError after = vertical_error(move(mesh), support::moved(terrain, move));
      EXPECT_EQ(before.max * scale, after.max);
      EXPECT_EQ(before.certain_max * scale, after.certain_max);
      EXPECT_EQ(before.rms * scale, after.rms);
      EXPECT_EQ(before.mean * scale, after.mean);
      EXPECT_EQ(before.area_m2 * scale * scale, after.area_m2);
      EXPECT_EQ(move(before.at), after.at);
    }
    // Lifting both surfaces by a power of two leaves their difference: exactly where heights stay doubles.
    Move lift;
    lift.shift = {0, 0, 1024};
    const VerticalError lifted = vertical_error(lift(mesh), support::moved(terrain, lift));
    const double bound_m = 2 * kVerticalRoundingFactor * 0x1p-53 * 40;
    expect_near(before, lifted, bound_m, true, "lifted");
    const support::Shuffled other = support::shuffled(mesh, random);
    const VerticalError after = vertical_error(other.mesh, terrain);
    EXPECT_EQ(before.max, after.max);
    EXPECT_EQ(before.certain_max, after.certain_max);
    EXPECT_EQ(before.at, after.at);
    expect_near(before, after, 0, true, "shuffled");
  }
}

/// A quality comes from a dozen roundings, another corner to begin with rounds otherwise; a mean from one
/// sum more.
constexpr double kShapeRounding = 0x1p-46;

TEST(SymmetryShape, MirrorsAndScalesToTheBitOrdersUpToTheSum) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed, "shape");
    const support::Surface s = support::random_delaunay(30, seed % 2 == 0, random);
    const auto& kinds = faults::fault_kinds();
    const auto fault = faults::plant(kinds[seed % kinds.size()].name, s.mesh, s.domain, random);
    const Mesh& mesh = fault ? fault->mesh : s.mesh;
    const ShapeReport before = shape(mesh);
    for (int number = 1; number < 8; ++number) {
      for (const double scale : {1.0, 0x1p-600, 0x1p600}) {
        Move move = support::symmetry(number);
        move.scale = scale;
        const ShapeReport after = shape(move(mesh));
        EXPECT_EQ(before.min_quality, after.min_quality) << move.name();
        EXPECT_EQ(before.mean_quality, after.mean_quality) << move.name();
        EXPECT_EQ(before.least_angle_deg, after.least_angle_deg) << move.name();
        EXPECT_EQ(before.slivers, after.slivers);
        EXPECT_EQ(before.max_valence, after.max_valence);
        EXPECT_EQ(before.mean_valence, after.mean_valence);
        EXPECT_EQ(before.mean_fan_length, after.mean_fan_length);
      }
    }
    // mean_fan_length alone is a figure of the order: triangles in a row.
    const ShapeReport after = shape(support::shuffled(mesh, random).mesh);
    EXPECT_NEAR(before.min_quality, after.min_quality, kShapeRounding);
    EXPECT_NEAR(before.mean_quality, after.mean_quality, kShapeRounding);
    EXPECT_NEAR(before.least_angle_deg, after.least_angle_deg, 180 * kShapeRounding);
    EXPECT_EQ(before.slivers, after.slivers);
    EXPECT_EQ(before.max_valence, after.max_valence);
    EXPECT_EQ(before.mean_valence, after.mean_valence);
  }
}

TEST(SymmetryStability, IdentitiesMayBeNamedOtherwise) {
  // Another numbering of the vertices is another order of keys: what toggles, and what differs, stays.
  std::size_t toggles = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed, "names");
    constexpr std::uint64_t kKeys = 40;
    const std::vector<std::uint32_t> name = support::random_order(kKeys, random);
    ToggleWatch watch, renamed;
    std::set<std::uint64_t> in;
    for (int frame = 0; frame < 60; ++frame) {
      std::set<std::uint64_t> entered, left, entered_renamed, left_renamed;
      for (std::uint64_t key = 0; key < kKeys; ++key) {
        if (random.below(8) != 0) continue;
        const bool was_in = in.contains(key);
        (was_in ? left : entered).insert(key);
        (was_in ? left_renamed : entered_renamed).insert(name[key]);
        if (was_in) {
          in.erase(key);
        } else {
          in.insert(key);
        }
      }
      const auto list = [](const std::set<std::uint64_t>& keys) {
        return std::vector<std::uint64_t>(keys.begin(), keys.end());
      };
      const std::size_t one = watch.next(frame, list(entered), list(left));
      EXPECT_EQ(one, renamed.next(frame, list(entered_renamed), list(left_renamed)));
      toggles += one;
      const KeyDifference a = compare_keys(list(entered), list(in)),
                          b = compare_keys(list(in), list(entered));
      EXPECT_EQ(a.differing, b.differing) << "whichever comes first";
      EXPECT_EQ(a.all, b.all);
    }
  }
  EXPECT_GT(toggles, 1000U);
}

TEST(SymmetryStability, CamerasMovedAlong) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed, "cameras");
    const auto anywhere = [&] {
      return support::dyadic(
          Vec3{random.between(-100, 100), random.between(-100, 100), random.between(0, 100)});
    };
    std::vector<Camera> flight;
    for (int k = 0; k < 6; ++k) flight.push_back(make_camera(anywhere(), anywhere(), 60, 64, 48));
    const double median_m = median_step_m(flight);
    for (int number = 0; number < 8; ++number) {
      for (const double scale : {1.0, 0x1p-30, 0x1p30}) {
        Move move = support::symmetry(number);
        move.scale = scale;
        std::vector<Camera> moved;
        for (const Camera& camera : flight) moved.push_back(move(camera));
        EXPECT_EQ(median_step_m(moved), median_m * scale);
        for (std::size_t k = 1; k < flight.size(); ++k) {
          for (const double depth_m : {1.0, 100.0, 400.0}) {
            EXPECT_EQ(is_cut(moved[k - 1], moved[k], depth_m * scale, median_m * scale),
                      is_cut(flight[k - 1], flight[k], depth_m, median_m));
          }
        }
        // "To the right" is to the left in a mirrored scene. The jitter of both has the same size.
        const Camera one = jittered(flight[0], 50), two = jittered(moved[0], 50 * scale);
        const Vec3 stepped = one.position - flight[0].position, other = two.position - moved[0].position;
        constexpr double kStepRounding_m = 0x1p-44;  // of coordinates below 2⁷ m: their difference is left
        EXPECT_NEAR(length(stepped) * scale, length(other), kStepRounding_m * scale);
        constexpr double kUnitRounding = 0x1p-51;  // f + r and f − r are rounded each
        EXPECT_NEAR(dot(one.forward, flight[0].forward), dot(two.forward, moved[0].forward), kUnitRounding);
        if (!move.mirrors()) {
          EXPECT_EQ(move.turned(one.forward), two.forward) << move.name();
          EXPECT_EQ(move(one.position), two.position) << move.name();
        }
      }
    }
  }
}

/// A rough sheet over the unit lattice.
Mesh sheet(Random& random) {
  Mesh mesh = reference_mesh(random_terrain(4, 4, false, random));
  for (Vec3& p : mesh.positions) p = {p.x * 0.25, p.y * 0.25, p.z * 0.0625};
  return mesh;
}

TEST(SymmetryLikeness, InSpace) {
  // CGAL's bounded search walks another way round in a moved scene, so its estimate may be another one inside
  // the interval; the true distance lies in both. Normals are summed in another order of coordinates.
  constexpr double kWithin_m = 0x1p-10;
  constexpr double kAngleRounding_deg = 0x1p-38;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed, "likeness");
    const Mesh reference = sheet(random), mesh = sheet(random);
    const auto before = compare_in_space(mesh, reference, kWithin_m);
    ASSERT_TRUE(before);
    EXPECT_GT(before->to_mesh.least_m, 0);
    const auto meets = [](CertifiedDistance a, CertifiedDistance b) {
      return a.least_m <= b.most_m && b.least_m <= a.most_m;
    };
    const auto same = [&](const std::optional<Likeness>& after, const std::string& context) {
      ASSERT_TRUE(after) << context;
      EXPECT_TRUE(meets(before->to_mesh, after->to_mesh)) << context;
      EXPECT_TRUE(meets(before->from_mesh, after->from_mesh)) << context;
      EXPECT_NEAR(before->normal_max_deg, after->normal_max_deg, kAngleRounding_deg) << context;
      EXPECT_NEAR(before->normal_mean_deg, after->normal_mean_deg, kAngleRounding_deg) << context;
      EXPECT_NEAR(before->turned_share, after->turned_share, 0x1p-48) << context;
    };
    for (int number = 1; number < 8; ++number) {
      const Move move = support::symmetry(number);
      same(compare_in_space(move(mesh), move(reference), kWithin_m), move.name());
    }
    Move shift;
    shift.shift = {512, -256, 128};
    same(compare_in_space(shift(mesh), shift(reference), kWithin_m), "shifted");
    same(compare_in_space(support::shuffled(mesh, random).mesh, support::shuffled(reference, random).mesh,
                          kWithin_m),
         "in another order");
    Move wide;
    wide.scale = 1024;
    const auto after = compare_in_space(wide(mesh), wide(reference), 1024 * kWithin_m);
    ASSERT_TRUE(after);
    EXPECT_EQ(1024 * before->to_mesh.most_m, after->to_mesh.most_m);
    EXPECT_EQ(1024 * before->from_mesh.least_m, after->from_mesh.least_m);
    EXPECT_EQ(before->normal_mean_deg, after->normal_mean_deg);
  }
}

TEST(SymmetryLikeness, IntersectionsAreTheSamePairs) {
  std::size_t pairs = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed, "pairs");
    Mesh mesh;
    for (std::uint32_t t = 0; t < 8; ++t) {
      for (int k = 0; k < 3; ++k) {
        mesh.positions.push_back(
            support::dyadic(Vec3{random.between(0, 8), random.between(0, 8), random.between(0, 8)}));
      }
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const auto before = self_intersections(mesh);
    ASSERT_TRUE(before);
    pairs += before->size();
    for (int number = 1; number < 8; ++number) {
      for (const double scale : {1.0, 0x1p-30, 0x1p30}) {
        Move move = support::symmetry(number);
        move.scale = scale;
        EXPECT_EQ(self_intersections(move(mesh)), before) << move.name();
      }
    }
    Move shift;
    shift.shift = {1024, 4096, -512};
    EXPECT_EQ(self_intersections(shift(mesh)), before);
    const support::Shuffled other = support::shuffled(mesh, random);
    std::vector<std::array<std::uint32_t, 2>> renamed;
    for (const auto& [s, t] : *before) {
      const std::uint32_t a = other.triangle[s], b = other.triangle[t];
      renamed.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(renamed.begin(), renamed.end());
    EXPECT_EQ(self_intersections(other.mesh), renamed);
  }
  EXPECT_GT(pairs, 200U);
}

}  // namespace
}  // namespace plumbline::oracle
