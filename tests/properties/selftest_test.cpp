// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracles put to the test, and the test put to the test: blinded oracles in their place must be noticed.
#include "properties/selftest/selftest.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "oracle/soundness.h"
#include "properties/faults/faults.h"
#include "properties/faults/measured_faults.h"
#include "reports/report.h"

namespace plumbline::selftest {
namespace {

using verdict::KindScore;
using verdict::SelftestScore;

Request small(std::uint64_t seed = 1) {
  Request request = brief_request();
  request.seed = seed;
  request.clean = 100;
  return request;
}

std::string worst_kind(const SelftestScore& score) {
  for (const KindScore& kind : score.kinds) {
    if (!kind.perfect() || kind.faults == 0)
      return kind.oracle + " " + kind.kind + ": " + std::to_string(kind.faults) + " planted, " +
             std::to_string(kind.expected) + " expected, " + std::to_string(kind.found) + " found, " +
             std::to_string(kind.misplaced) + " misplaced, " + std::to_string(kind.false_alarms) +
             " false alarms";
  }
  return "none";
}

TEST(Selftest, EveryKindIsFoundAtItsPlaceAndNothingElse) {
  Request request = small();
  request.faults = 2000;
  request.clean = 2000;
  const SelftestScore score = run_selftest(request);
  EXPECT_TRUE(score.perfect()) << worst_kind(score);
  EXPECT_GE(score.planted(), 2000U);
  EXPECT_EQ(score.clean_meshes, 2000U);
  EXPECT_EQ(score.clean_false_alarms, 0U);
}

TEST(Selftest, JobsDoNotMoveAByteAndSeedsDo) {
  Request one = small(), two = small(), other = small(2);
  one.jobs = 1;
  two.jobs = 2;
  const std::string text = reports::selftest_json(run_selftest(one));
  EXPECT_EQ(text, reports::selftest_json(run_selftest(two)));
  EXPECT_NE(text, reports::selftest_json(run_selftest(other)));
}

TEST(Selftest, EveryOracleIsAskedAndEachHasAHarmlessTwin) {
  std::set<std::string_view> faulty{"O1 conformity", "O1 between meshes"}, sound = faulty;
  for (const faults::MeasuredFault& fault : faults::measured_faults())
    (fault.sound ? sound : faulty).insert(fault.oracle);
  EXPECT_EQ(faulty.size(), 10U);  // O1 to O7, O1 between meshes, tiles, placement
  EXPECT_EQ(faulty, sound);
}

/// What the score says of one oracle when another is put in its place.
KindScore with(const faults::Judges& judges, const std::string& oracle) {
  const SelftestScore score = run_selftest(small(), judges);
  EXPECT_FALSE(score.perfect());
  return score.total(oracle);
}

TEST(Selftest, ABlindOracleFindsNothing) {
  faults::Judges judges = faults::real_judges();
  judges.conformity = [](const Mesh&, const PlanDomain&) { return oracle::ConformityReport{}; };
  const KindScore conformity = with(judges, "O1 conformity");
  EXPECT_GT(conformity.expected, 100U);
  EXPECT_EQ(conformity.found, 0U);
  EXPECT_EQ(conformity.false_alarms, 0U);

  judges = faults::real_judges();
  judges.vertical = [](const Mesh&, const Terrain&) {
    oracle::VerticalError error;
    error.area_m2 = 1;
    return error;
  };
  EXPECT_EQ(with(judges, "O2 vertical error").found, 0U);

  judges = faults::real_judges();
  judges.picture = [](const Camera& camera, const Mesh&, const Mesh&, double) {
    faults::PictureVerdict verdict;
    verdict.error.displacement_px.count = 1;
    verdict.displacement_px = Raster(camera.width_px, camera.height_px, 0);
    return verdict;
  };
  EXPECT_EQ(with(judges, "O3 image error").found, 0U);

  judges = faults::real_judges();
  judges.toggles = [](std::span<const faults::FrameChange> flight) {
    return std::vector<std::size_t>(flight.size());
  };
  judges.recovery = [](std::span<const std::pair<bool, bool>>) { return 0; };
  judges.keys = [](std::span<const std::uint64_t>, std::span<const std::uint64_t>) { return std::size_t{0}; };
  EXPECT_EQ(with(judges, "O5 stability").found, 0U);

  judges = faults::real_judges();
  judges.seam = [](const oracle::Border&, const oracle::Border&) { return std::optional(oracle::Seam{}); };
  judges.slit = [](const oracle::Border&, const oracle::Border&, double) {
    return std::optional<oracle::Slit>{};
  };
  const KindScore seams = with(judges, "O1 between meshes");
  EXPECT_GT(seams.expected, 20U);
  EXPECT_EQ(seams.found, 0U);
  EXPECT_EQ(seams.false_alarms, 0U);

  judges = faults::real_judges();
  judges.tile = [](const QuantizedMesh&, const TileBounds&) { return std::vector<oracle::TileFinding>{}; };
  EXPECT_EQ(with(judges, "tile format").found, 0U);

  judges = faults::real_judges();
  judges.placement = [](std::span<const Vec3>, const Terrain&) {
    return std::optional<oracle::Misplacement>{};
  };
  EXPECT_EQ(with(judges, "placement").found, 0U);
}

TEST(Selftest, AWrongPlaceIsMisplaced) {
  faults::Judges judges = faults::real_judges();
  judges.conformity = [](const Mesh& mesh, const PlanDomain& domain) {
    oracle::ConformityReport report = oracle::check_conformity(mesh, domain);
    for (oracle::Finding& finding : report.findings) {
      for (std::uint32_t& v : finding.vertices) ++v;
      for (std::uint32_t& t : finding.triangles) ++t;
    }
    return report;
  };
  const KindScore conformity = with(judges, "O1 conformity");
  EXPECT_GT(conformity.misplaced, conformity.expected / 2);

  judges = faults::real_judges();
  judges.vertical = [](const Mesh& mesh, const Terrain& terrain) {
    oracle::VerticalError error = oracle::vertical_error(mesh, terrain);
    error.at = error.at + Vec2{1e6, 0};
    return error;
  };
  const KindScore vertical = with(judges, "O2 vertical error");
  EXPECT_EQ(vertical.found, 0U);
  EXPECT_EQ(vertical.misplaced, vertical.expected);

  judges = faults::real_judges();
  judges.seam = [](const oracle::Border& a, const oracle::Border& b) {
    std::optional<oracle::Seam> seam = oracle::compare_borders(a, b);
    if (!seam) return seam;
    for (oracle::SeamGap& gap : seam->gaps) gap.at.x += 1e6;
    return seam;
  };
  EXPECT_GT(with(judges, "O1 between meshes").misplaced, 20U);
}

TEST(Selftest, BordersThatAreOffByAnUlpAreHeard) {
  faults::Judges judges = faults::real_judges();
  judges.border = [](const Mesh& mesh) {
    oracle::Border border = oracle::border_of(mesh, oracle::take_walls_off(mesh), {});
    for (oracle::BorderEdge& edge : border.edges) {
      const double z = edge.height[0].low;
      if (edge.vertices[0] % 2 == 0) edge.height[0].low = std::nextafter(z, z + 1);
    }
    return border;
  };
  EXPECT_GT(with(judges, "O1 between meshes").false_alarms, 0U);
}

TEST(Selftest, AnOracleThatCriesWolfIsHeard) {
  faults::Judges judges = faults::real_judges();
  judges.soundness = [](const Mesh& mesh) {
    oracle::ConformityReport report = oracle::check_soundness(mesh);
    ++report.counts.duplicate;
    oracle::Finding finding;
    finding.code = oracle::FindingCode::duplicate;
    report.findings.push_back(finding);
    return report;
  };
  const SelftestScore score = run_selftest(small(), judges);
  EXPECT_FALSE(score.perfect());
  EXPECT_EQ(score.clean_false_alarms, score.clean_meshes);
  EXPECT_GT(score.total("O7 general meshes").false_alarms, 0U);
}

TEST(Selftest, OneUlpTooMuchIsNoFind) {
  faults::Judges judges = faults::real_judges();
  judges.vertical = [](const Mesh& mesh, const Terrain& terrain) {
    oracle::VerticalError error = oracle::vertical_error(mesh, terrain);
    error.max *= 1 + 0x1p-52;
    return error;
  };
  const SelftestScore score = run_selftest(small(), judges);
  const auto kind = std::find_if(score.kinds.begin(), score.kinds.end(),
                                 [](const KindScore& k) { return k.kind == "vertex_moved_ulp"; });
  ASSERT_NE(kind, score.kinds.end());
  EXPECT_EQ(kind->found, 0U);
}

TEST(Selftest, WhatPlantedNothingIsNoPass) {
  SelftestScore score;
  EXPECT_FALSE(score.perfect());
  score.kinds.emplace_back();
  EXPECT_FALSE(score.perfect());
  score.kinds[0].faults = 1;
  EXPECT_TRUE(score.perfect());
}

TEST(Selftest, StopsWhenAsked) {
  const std::atomic<bool> cancelled = true;
  Request request = small();
  request.cancelled = &cancelled;
  const SelftestScore score = run_selftest(request);
  EXPECT_TRUE(score.interrupted);
  EXPECT_FALSE(score.perfect());
}

}  // namespace
}  // namespace plumbline::selftest
