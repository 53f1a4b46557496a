// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// check_conformity_without_outline beside check_conformity, which knows the outline: everything but
// `outline` must agree.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/conformity.h"
#include "properties/faults/faults.h"
#include "properties/faults/sound_meshes.h"
#include "scenarios/random.h"

namespace plumbline::oracle {
namespace {

using ::testing::Contains;
using ::testing::SizeIs;

/// n × n cells of two triangles from (x, y) on, `cell` wide, at height z.
Mesh grid(double x, double y, int n, double cell = 1, double z = 0) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) mesh.positions.push_back({x + i * cell, y + j * cell, z});
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

Mesh together(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& mesh : meshes) {
    const auto base = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (auto t : mesh.triangles) {
      for (std::uint32_t& v : t) v += base;
      all.triangles.push_back(t);
    }
  }
  return all;
}

ConformityCounts counts(const std::vector<Mesh>& meshes) {
  return check_conformity_without_outline(together(meshes)).counts;
}
ConformityCounts only_holes(std::size_t n) {
  ConformityCounts c;
  c.hole = n;
  return c;
}
ConformityCounts only_overlaps(std::size_t n) {
  ConformityCounts c;
  c.overlap = n;
  return c;
}

TEST(FreeOutline, MeshesEndWhereTheyEnd) {
  EXPECT_EQ(counts({grid(0, 0, 3)}), ConformityCounts{});
  EXPECT_EQ(counts({grid(0, 0, 3), grid(9, 9, 2)}), ConformityCounts{}) << "apart";
  EXPECT_EQ(counts({grid(0, 0, 3), grid(3, 0, 3)}), ConformityCounts{}) << "side by side";
  EXPECT_EQ(counts({grid(0, 0, 3), grid(3, 3, 3)}), ConformityCounts{}) << "corner to corner";
  // An L, a U: not convex, and no hole.
  EXPECT_EQ(counts({grid(0, 0, 3), grid(3, 0, 3), grid(0, 3, 3)}), ConformityCounts{});
  EXPECT_EQ(counts({grid(0, 0, 1), grid(1, 0, 1), grid(2, 0, 1), grid(0, 1, 1), grid(2, 1, 1)}),
            ConformityCounts{});
}

TEST(FreeOutline, ARingOfTilesEnclosesOneHole) {
  std::vector<Mesh> ring;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      if (i != 1 || j != 1) ring.push_back(grid(i * 4, j * 4, 4));
    }
  }
  const ConformityReport report = check_conformity_without_outline(together(ring));
  EXPECT_EQ(report.counts, only_holes(1));
  ASSERT_THAT(report.findings, SizeIs(1));
  EXPECT_EQ(report.findings[0].area_m2, 16);
  for (const Vec2 corner : {Vec2{4, 4}, Vec2{8, 4}, Vec2{8, 8}, Vec2{4, 8}})
    EXPECT_THAT(report.findings[0].loop, Contains(corner));
  // Filled it is sound, with cells of half the size it has T-junctions, and no hole.
  ring.push_back(grid(4, 4, 4));
  EXPECT_EQ(counts(ring), ConformityCounts{});
  ring.back() = grid(4, 4, 8, 0.5);
  ConformityCounts junctions;
  junctions.t_junction = 16;
  EXPECT_EQ(counts(ring), junctions);
  // A smaller island in it: what is round it is still one hole, of less area.
  ring.back() = grid(5, 5, 2);
  const ConformityReport moat = check_conformity_without_outline(together(ring));
  EXPECT_EQ(moat.counts, only_holes(1));
  EXPECT_EQ(moat.findings.at(0).area_m2, 12);
  // A tile taken out of the ring opens it.
  ring.pop_back();
  ring.erase(ring.begin() + 3);
  EXPECT_EQ(counts(ring), ConformityCounts{});
}

TEST(FreeOutline, WhatTouchesTheOutsideInAPointAloneIsEnclosed) {
  // Four tiles round an empty middle, corner to corner: no way out through a point.
  EXPECT_EQ(counts({grid(1, 0, 1), grid(0, 1, 1), grid(2, 1, 1), grid(1, 2, 1)}), only_holes(1));
}

TEST(FreeOutline, OverlapsAreFoundWithTheirArea) {
  const ConformityReport report =
      check_conformity_without_outline(together({grid(0, 0, 4), grid(2.5, 3.25, 4)}));
  EXPECT_EQ(report.counts, only_overlaps(1));
  EXPECT_EQ(report.findings.at(0).area_m2, 1.5 * 0.75);
  EXPECT_EQ(counts({grid(0, 0, 4), grid(1.25, 1.25, 1)}), only_overlaps(1)) << "within the other";
  // A cross of two bars: the middle is covered twice.
  Mesh bar = grid(0, 0, 3), post = bar;
  for (Vec3& p : bar.positions) p.y = p.y / 3 + 1;
  for (Vec3& p : post.positions) p = {p.x / 3 + 1.125, p.y + 0.0625, 0};
  EXPECT_EQ(counts({bar, post}), only_overlaps(1));
}

/// The counts that both must share.
ConformityCounts but_outline(ConformityCounts c) {
  c.outline = 0;
  return c;
}

TEST(FreeOutline, AgreesWithTheKnownOutlineOnEveryPlantedFault) {
  std::vector<std::size_t> planted(faults::fault_kinds().size());
  std::size_t outlines = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed, "free outline");
    const faults::Surface surface = seed % 2 == 0
                                        ? faults::random_grid(4 + static_cast<int>(random.below(5)), random)
                                        : faults::random_bintree(3, random);
    EXPECT_TRUE(check_conformity_without_outline(surface.mesh).clean());
    for (std::size_t k = 0; k < planted.size(); ++k) {
      const auto fault = faults::plant(faults::fault_kinds()[k].name, surface.mesh, surface.domain, random);
      if (!fault) continue;
      ++planted[k];
      const ConformityReport known = check_conformity(fault->mesh, fault->domain);
      const ConformityReport free = check_conformity_without_outline(fault->mesh);
      EXPECT_EQ(free.counts.outline, 0u);
      EXPECT_EQ(free.counts, but_outline(known.counts)) << fault->kind << ", seed " << seed;
      EXPECT_EQ(free.largest_gap_m, known.largest_gap_m);
      outlines += known.counts.outline > 0;
      std::vector<Finding> wanted;
      std::copy_if(known.findings.begin(), known.findings.end(), std::back_inserter(wanted),
                   [](const Finding& f) { return f.code != FindingCode::outline; });
      ASSERT_THAT(free.findings, SizeIs(wanted.size()));
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_EQ(free.findings[i].code, wanted[i].code);
        EXPECT_EQ(free.findings[i].kind, wanted[i].kind);
        EXPECT_EQ(free.findings[i].at, wanted[i].at);
        EXPECT_EQ(free.findings[i].area_m2, wanted[i].area_m2);
        EXPECT_EQ(free.findings[i].triangles, wanted[i].triangles);
      }
    }
  }
  for (std::size_t k = 0; k < planted.size(); ++k)
    EXPECT_GT(planted[k], 10u) << faults::fault_kinds()[k].name << " was hardly tried";
  EXPECT_GT(outlines, 100u);
}

TEST(FreeOutline, DoesNotDependOnTheOrderOfMeshes) {
  std::vector<Mesh> meshes{grid(0, 0, 3), grid(3, 0, 3, 1, 2), grid(0, 3, 6, 0.5), grid(3, 3.25, 3)};
  const ConformityCounts wanted = counts(meshes);
  EXPECT_GT(wanted.crack, 0u);
  EXPECT_GT(wanted.t_junction, 0u);
  for (int turn = 0; turn < 3; ++turn) {
    std::rotate(meshes.begin(), meshes.begin() + 1, meshes.end());
    EXPECT_EQ(counts(meshes), wanted);
  }
}

TEST(FreeOutline, BordersTooManyToArrangeAreSaidSo) {
  // Triangles apart, half a million of their edges: nobody can tell holes from outside in time.
  Mesh dust;
  constexpr std::uint32_t kSide = 300;
  for (std::uint32_t k = 0; k < kSide * kSide; ++k) {
    const double x = 2.0 * (k % kSide), y = 2.0 * (k / kSide);
    dust.positions.insert(dust.positions.end(), {{x, y, 0}, {x + 1, y, 0}, {x, y + 1, 0}});
    dust.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  const ConformityReport report = check_conformity_without_outline(dust);
  EXPECT_EQ(report.counts, ConformityCounts{});
  ASSERT_THAT(report.findings, SizeIs(1));
  EXPECT_EQ(report.findings[0].code, FindingCode::nothing_judged);
  EXPECT_EQ(report.findings[0].kind, "outline");
  EXPECT_EQ(report.findings[0].at, (Vec3{0, 0, 0}));
}

TEST(FreeOutline, NothingIsClean) { EXPECT_TRUE(check_conformity_without_outline({}).findings.empty()); }

}  // namespace
}  // namespace plumbline::oracle
