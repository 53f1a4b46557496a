// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Every fault of the catalogue, planted at random places of sound meshes: found at its place, and nothing
// else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "properties/faults/faults.h"
#include "scenarios/camera.h"
#include "scenarios/error.h"
#include "tests/oracle/conformity_meshes.h"

namespace plumbline {
namespace {

using namespace plumbline::faults;

class EveryFault : public testing::TestWithParam<FaultKind> {
 protected:
  enum Place { kMustHavePlace, kMayHaveNoPlace };

  /// Plants this kind into `rounds` meshes; returns the total score.
  template <typename Make>
  Score plant_in(Make&& make, int rounds, Place place = kMustHavePlace) {
    Score total;
    int planted_meshes = 0;
    for (int round = 0; round < rounds; ++round) {
      Random random(static_cast<std::uint64_t>(round), GetParam().name);
      const test::Surface surface = make(random);
      const auto fault = plant(GetParam().name, surface.mesh, surface.domain, random);
      if (!fault) continue;
      ++planted_meshes;
      const auto report = oracle::check_conformity(fault->mesh, fault->domain);
      const Score one = score(*fault, report);
      EXPECT_TRUE(one.perfect()) << GetParam().name << ", round " << round << ": planted " << one.planted
                                 << ", found " << one.found << ", false alarms " << one.false_alarms << '\n'
                                 << test::text(report);
      EXPECT_EQ(fault->expected.empty(), GetParam().sound);
      total.planted += one.planted;
      total.found += one.found;
      total.false_alarms += one.false_alarms;
      if (testing::Test::HasFailure()) break;  // the first is enough to look at
    }
    EXPECT_TRUE(planted_meshes > 0 || place == kMayHaveNoPlace)
        << "no mesh had a place for " << GetParam().name;
    return total;
  }
};

TEST_P(EveryFault, InGrids) {
  const Score total =
      plant_in([](Random& r) { return test::random_grid(4 + static_cast<int>(r.below(8)), r); }, 120);
  EXPECT_EQ(total.found, total.planted);
  EXPECT_EQ(total.false_alarms, 0u);
}

TEST_P(EveryFault, InLevelOfDetailMeshes) {
  const Score total = plant_in([](Random& r) { return test::random_bintree(4, r); }, 120);
  EXPECT_EQ(total.found, total.planted);
  EXPECT_EQ(total.false_alarms, 0u);
}

TEST_P(EveryFault, InDelaunayMeshes) {
  const Score total = plant_in(
      [](Random& r) { return test::random_delaunay(12 + static_cast<int>(r.below(40)), r.below(2) == 0, r); },
      120);
  EXPECT_EQ(total.found, total.planted);
  EXPECT_EQ(total.false_alarms, 0u);
}

/// A frame of a method on a random terrain, from a random camera; empty if the frame is not sound by itself
/// (a method need not promise that).
test::Surface frame_of(const MethodDescription& method, Random& random) {
  Terrain terrain;
  terrain.columns = terrain.rows = 33;
  terrain.spacing_m = 10;
  for (int k = 0; k < 33 * 33; ++k) terrain.heights_m.push_back(random.between(0, 12));
  const auto flyer = make_method(method.id);
  flyer->prepare(terrain);
  flyer->set_threshold_px(random.between(2, 40));
  const Vec3 eye{random.between(0, 320), random.between(0, 320), random.between(20, 200)};
  LodFrame frame;
  flyer->update(make_camera(eye, {160, 160, 0}, 60, 320, 200), frame);
  if (!oracle::check_conformity(frame.mesh, frame.domain).clean()) return {};
  return {frame.mesh, frame.domain};
}

TEST_P(EveryFault, InFramesOfEveryMethod) {
  Score total;
  for (const MethodDescription& method : registered_methods()) {
    SCOPED_TRACE(method.id);
    const Score one = plant_in([&](Random& r) { return frame_of(method, r); }, 12, kMayHaveNoPlace);
    total.planted += one.planted;
    total.found += one.found;
    total.false_alarms += one.false_alarms;
  }
  EXPECT_EQ(total.found, total.planted);
  EXPECT_EQ(total.false_alarms, 0u);
  EXPECT_TRUE(GetParam().sound || total.planted > 0) << "no frame of any method had a place for it";
}

TEST_P(EveryFault, BesideASeam) {
  const Score total = plant_in(
      [](Random& r) {
        test::Surface s = test::random_grid(8, r);
        const auto seam = plant("block_seam", s.mesh, s.domain, r);
        if (seam) s.mesh = seam->mesh;
        return s;
      },
      60);
  EXPECT_EQ(total.found, total.planted);
  EXPECT_EQ(total.false_alarms, 0u);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryFault, testing::ValuesIn(fault_kinds()),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(FaultCatalogue, CoversEveryConformityFinding) {
  std::set<oracle::FindingCode> planted;
  for (const FaultKind& kind : fault_kinds()) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      Random random(seed);
      const test::Surface s = test::random_grid(7, random);
      if (const auto fault = plant(kind.name, s.mesh, s.domain, random)) {
        for (const ExpectedFinding& expected : fault->expected) planted.insert(expected.code);
      }
    }
  }
  using enum oracle::FindingCode;
  // non_manifold never comes alone in plan (its triangles overlap); conformity_test has it.
  EXPECT_THAT(planted,
              testing::UnorderedElementsAre(bad_index, non_finite, degenerate, duplicate, unused_vertex,
                                            fold_over, t_junction, crack, hole, overlap, outline));
}

TEST(FaultCatalogue, SameSeedSameFault) {
  for (const FaultKind& kind : fault_kinds()) {
    Random one(7), two(7);
    const test::Surface a = test::random_grid(6, one), b = test::random_grid(6, two);
    const auto first = plant(kind.name, a.mesh, a.domain, one),
               second = plant(kind.name, b.mesh, b.domain, two);
    ASSERT_EQ(first.has_value(), second.has_value());
    if (first) {
      EXPECT_EQ(first->mesh.triangles, second->mesh.triangles) << kind.name;
    }
  }
}

TEST(FaultCatalogue, UnknownKind) {
  Random random(1);
  EXPECT_THROW((void)plant("no_such_fault", {}, {}, random), InputError);
}

TEST(FaultCatalogue, AMissedFaultScoresAsMissed) {
  Random random(3);
  const test::Surface s = test::random_grid(6, random);
  const auto fault = plant("triangle_dropped", s.mesh, s.domain, random);
  ASSERT_TRUE(fault);
  const Score blind = score(*fault, oracle::ConformityReport{});
  EXPECT_EQ(blind.found, 0u);
  EXPECT_FALSE(blind.perfect());
  // A report about another fault is both a miss and a false alarm.
  const auto other = plant("triangle_flipped", s.mesh, s.domain, random);
  const Score wrong = score(*fault, oracle::check_conformity(other->mesh, other->domain));
  EXPECT_EQ(wrong.found, 0u);
  EXPECT_EQ(wrong.false_alarms, 1u);
}

}  // namespace
}  // namespace plumbline
