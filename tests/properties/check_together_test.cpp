// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that are judged together: what one has over, under or inside another, and walls that do or do not
// fill what they seem to.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/check/check.h"
#include "scenarios/error.h"
#include "scenarios/whole_file.h"
#include "tests/properties/corpus_parts.h"
#include "tests/scenarios/support.h"

namespace plumbline {
namespace {

using oracle::FindingCode;
using ::testing::HasSubstr;
using verdict::CheckFinding;
using verdict::CheckVerdict;

class CheckTogether : public testing::Test {
 protected:
  /// Writes the meshes as OBJ, in order, and judges them together.
  CheckOutcome check_all(const std::vector<Mesh>& meshes, CheckRequest request = {}) {
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      request.inputs.push_back(folder_.path() / fmt::format("{}.obj", k));
      write_whole_file(request.inputs.back(), test::obj_bytes(meshes[k]));
    }
    request.pictures = false;
    return check(request);
  }
  CheckVerdict judged(const std::vector<Mesh>& meshes, const CheckRequest& request = {}) {
    return check_all(meshes, request).verdict;
  }
  static std::size_t count(const CheckVerdict& verdict, FindingCode code) {
    const auto found = verdict.totals.find(code);
    return found == verdict.totals.end() ? 0 : found->second;
  }
  static const CheckFinding* first(const CheckVerdict& verdict, FindingCode code) {
    const auto found =
        std::ranges::find(verdict.findings, code, [](const auto& f) { return f.finding.code; });
    return found == verdict.findings.end() ? nullptr : &*found;
  }

  static Mesh square(double low, double high, double z, bool other_diagonal = false) {
    Mesh mesh{{{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}}, {{0, 1, 2}, {0, 2, 3}}};
    if (other_diagonal) mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
    return mesh;
  }
  /// The square of 10 m with a square hole from `low` to `high`.
  static Mesh ring(double low, double high) {
    Mesh mesh = square(0, 10, 0);
    mesh.triangles.clear();
    for (const Vec3& p : square(low, high, 0).positions) mesh.positions.push_back(p);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (k + 1) % 4;
      mesh.triangles.push_back({k, next, 4 + next});
      mesh.triangles.push_back({k, 4 + next, 4 + k});
    }
    return mesh;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(CheckTogether, AMeshInsideAnotherOverlapsIt) {
  const CheckVerdict verdict = judged({square(0, 10, 0), square(3, 4, 1)});
  EXPECT_FALSE(verdict.sound);
  EXPECT_EQ(verdict.conformity.overlap, 1U);
  const CheckFinding* overlap = first(verdict, FindingCode::overlap);
  ASSERT_NE(overlap, nullptr);
  EXPECT_EQ(overlap->finding.area_m2, 1);
  EXPECT_EQ(std::min(overlap->mesh, overlap->other_mesh), 0U);
  EXPECT_EQ(std::max(overlap->mesh, overlap->other_mesh), 1U);
}

TEST_F(CheckTogether, AMeshOverItsSimplificationOverlapsIt) {
  const CheckVerdict verdict = judged({square(0, 10, 0), square(0, 10, 0, true)});
  EXPECT_FALSE(verdict.sound);
  const CheckFinding* overlap = first(verdict, FindingCode::overlap);
  ASSERT_NE(overlap, nullptr);
  EXPECT_EQ(overlap->finding.area_m2, 100);
  EXPECT_NE(overlap->mesh, overlap->other_mesh);
}

TEST_F(CheckTogether, WhatOneMeshHasByItselfIsToldOnce) {
  Mesh folded = square(0, 10, 0);
  folded.positions.push_back({5, 2, 1});
  folded.triangles.push_back({0, 1, 4});  // over the first triangle
  const CheckVerdict alone = judged({folded});
  EXPECT_GT(count(alone, FindingCode::overlap), 0U);
  const CheckVerdict both = judged({folded, square(20, 30, 0)});
  EXPECT_EQ(count(both, FindingCode::overlap), count(alone, FindingCode::overlap));
}

TEST_F(CheckTogether, AHoleThatAnotherMeshFillsIsNone) {
  EXPECT_EQ(count(judged({ring(3, 7)}), FindingCode::hole), 1U);
  const CheckVerdict filled = judged({ring(3, 7), square(3, 7, 0)});
  EXPECT_TRUE(filled.sound);
  EXPECT_EQ(filled.conformity.hole, 0U);
  EXPECT_THAT(filled.meshes[0].domain, HasSubstr("fill its holes"));
  ASSERT_EQ(filled.seams.size(), 1U);
  EXPECT_EQ(filled.seams[0].state, verdict::SeamState::watertight);
}

TEST_F(CheckTogether, AHoleThatAnotherMeshFillsInPartStays) {
  const CheckVerdict part = judged({ring(3, 7), square(3, 5, 0)});
  EXPECT_FALSE(part.sound);
  EXPECT_GE(count(part, FindingCode::hole), 1U);
  const CheckVerdict elsewhere = judged({ring(3, 7), square(20, 30, 0)});
  EXPECT_EQ(count(elsewhere, FindingCode::hole), 1U);
  // A fill that stands higher is no hole, but a seam with a gap.
  const CheckVerdict raised = judged({ring(3, 7), square(3, 7, 2)});
  EXPECT_EQ(count(raised, FindingCode::hole), 0U);
  EXPECT_FALSE(raised.sound);
}

/// Two halves that meet at x = 8 but for their heights at (8, 4), in one mesh; a skirt around the whole.
struct Halves {
  Mesh mesh = test::sheet_between(0, {{0, 0}, {8, 0}}, 8, {{0, 0}, {4, 0}, {8, 0}}, 2);
  std::vector<std::uint32_t> west_of_middle, east_of_middle;  // southmost first

  explicit Halves(double southern_end_m) {
    const Mesh east = test::sheet_between(8, {{0, southern_end_m}, {4, 1}, {8, 0}}, 16, {{0, 0}, {8, 0}}, 2);
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), east.positions.begin(), east.positions.end());
    for (auto t : east.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    for (const double y : {0.0, 4.0, 8.0}) {
      for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.positions[v].x == 8 && mesh.positions[v].y == y)
          (v < base ? west_of_middle : east_of_middle).push_back(v);
      }
    }
  }
  void wall(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh.triangles.push_back({a, b, c}); }
};

// The seam's southern end belongs to the outer border, too, where a skirt hangs: it hides nothing of the
// crack.
TEST_F(CheckTogether, ASkirtOutsideExcusesNoCrackInside) {
  Halves halves(1);
  const auto corner = [&](double x, double y, bool western) {
    for (std::uint32_t v = 0; v < halves.mesh.positions.size(); ++v) {
      const Vec3& p = halves.mesh.positions[v];
      if (p.x == x && p.y == y && (x != 8 || (v < 6) == western)) return v;
    }
    return 0U;
  };
  test::hang_skirt(halves.mesh, {corner(0, 0, true), corner(8, 0, true)}, 100);
  test::hang_skirt(halves.mesh, {corner(8, 0, false), corner(16, 0, false)}, 100);
  const CheckVerdict verdict = judged({halves.mesh});
  EXPECT_FALSE(verdict.sound);
  const CheckFinding* crack = first(verdict, FindingCode::crack);
  ASSERT_NE(crack, nullptr);
  EXPECT_EQ(crack->finding.severity, oracle::Severity::fault);
}

TEST_F(CheckTogether, AWallFillsACrackWhereItStandsInAllOfIt) {
  Halves triangle(0);  // two gaps, each a triangle: closed by one wall each
  const auto &west = triangle.west_of_middle, &east = triangle.east_of_middle;
  ASSERT_EQ(west.size(), 3U);
  ASSERT_EQ(east.size(), 3U);
  EXPECT_FALSE(judged({triangle.mesh}).sound);
  triangle.wall(west[0], east[1], west[1]);
  EXPECT_FALSE(judged({triangle.mesh}).sound) << "one of two gaps is closed";
  triangle.wall(west[1], east[1], west[2]);
  const CheckVerdict filled = judged({triangle.mesh});
  EXPECT_TRUE(filled.sound);
  ASSERT_NE(first(filled, FindingCode::crack), nullptr);
  EXPECT_EQ(first(filled, FindingCode::crack)->finding.kind, "cliff");

  Halves quad(1);  // the southern gap has two ends: half a wall leaves half of it open
  quad.wall(quad.west_of_middle[0], quad.east_of_middle[1], quad.west_of_middle[1]);
  quad.wall(quad.west_of_middle[1], quad.east_of_middle[1], quad.west_of_middle[2]);
  EXPECT_FALSE(judged({quad.mesh}).sound);
  quad.wall(quad.west_of_middle[0], quad.east_of_middle[0], quad.east_of_middle[1]);
  EXPECT_TRUE(judged({quad.mesh}).sound);
}

TEST_F(CheckTogether, AnObjectWithACoordinateThatIsNoNumberIsJudgedWithoutIt) {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  Mesh mesh{{{0, 0, 0}, {nan, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  CheckRequest request;
  request.kind = CheckRequest::Kind::object;
  const CheckVerdict verdict = judged({mesh}, request);
  EXPECT_FALSE(verdict.sound);
  EXPECT_EQ(count(verdict, FindingCode::non_finite), 1U);
  EXPECT_EQ(count(verdict, FindingCode::self_intersection), 0U);
}

// Pairs grow with the square of the triangles: all are counted, few are kept.
TEST_F(CheckTogether, ManySelfIntersectionsAreCountedAndFewListed) {
  Mesh mesh;
  constexpr std::uint32_t kBlades = 20;
  for (std::uint32_t k = 0; k < kBlades; ++k) {  // tetrahedra through one another, no two faces in one plane
    const double t = 0.1 * k, size = 10 + 0.37 * k;
    for (const Vec3 p :
         {Vec3{-size, t, -size}, Vec3{size, -t, -size + t}, Vec3{t, size, -size}, Vec3{t, -t, size}})
      mesh.positions.push_back(p);
    const std::uint32_t b = 4 * k;
    for (const auto& f :
         {std::array{b, b + 2, b + 1}, {b, b + 1, b + 3}, {b + 1, b + 2, b + 3}, {b, b + 3, b + 2}})
      mesh.triangles.push_back(f);
  }
  CheckRequest request;
  request.kind = CheckRequest::Kind::object;
  const CheckVerdict verdict = judged({mesh}, request);
  ASSERT_TRUE(verdict.meshes[0].self_intersections_judged);
  EXPECT_GT(verdict.meshes[0].self_intersections, 100U);
  EXPECT_EQ(count(verdict, FindingCode::self_intersection), verdict.meshes[0].self_intersections);
  EXPECT_EQ(verdict.findings.size(), 100U);
  EXPECT_EQ(verdict.findings_total, verdict.meshes[0].self_intersections);
}

TEST_F(CheckTogether, AReferenceThatCannotBeJudgedIsNotPassedOver) {
  Mesh fan = square(0, 10, 0);
  fan.positions.push_back({5, 5, 5});
  fan.triangles.push_back({0, 2, 4});  // a third triangle on the diagonal
  CheckRequest request;
  request.reference = folder_.path() / "reference.obj";
  write_whole_file(request.reference, test::obj_bytes(fan));
  request.declared_m = 0.1;
  const CheckVerdict verdict = judged({square(0, 10, 0)}, request);
  EXPECT_FALSE(verdict.sound);
  ASSERT_NE(first(verdict, FindingCode::nothing_judged), nullptr);
  EXPECT_EQ(first(verdict, FindingCode::nothing_judged)->finding.kind, "reference");
}

// Rows that run south make every triangle clockwise, in the mesh and in its reference.
TEST_F(CheckTogether, AReferenceIsTurnedAsTheMeshIs) {
  Mesh mesh = square(0, 10, 0), reference = square(0, 10, 0, true);
  for (Mesh* one : {&mesh, &reference}) {
    for (auto& t : one->triangles) std::swap(t[1], t[2]);
  }
  CheckRequest request;
  request.reference = folder_.path() / "reference.obj";
  request.declared_m = 0;  // no search goes down to nothing
  write_whole_file(request.reference, test::obj_bytes(reference));
  const CheckVerdict verdict = judged({mesh}, request);
  ASSERT_TRUE(verdict.reference.has_value());
  EXPECT_EQ(verdict.reference->likeness.normal_max_deg, 0);
  EXPECT_EQ(verdict.reference->likeness.turned_share, 0);
  EXPECT_FALSE(verdict.reference->declared_broken);
}

// Nothing folds over z there, however steep it is.
TEST_F(CheckTogether, SteepGroundKeepsItsUp) {
  const Mesh steep = test::grid(6, 6, 10, [](int c, int r) { return 15.0 * c + (c * r % 3); });
  const CheckVerdict verdict = judged({steep});
  EXPECT_TRUE(verdict.sound);
  EXPECT_EQ(verdict.frame, "the files' own coordinates, z up, metres");
}

TEST_F(CheckTogether, AMeshThatMeetsNoOtherIsSaidToBeAlone) {
  const CheckVerdict apart = judged({square(0, 10, 0), square(13, 23, 0)});
  EXPECT_TRUE(apart.sound) << "a hazard";
  ASSERT_NE(first(apart, FindingCode::nothing_judged), nullptr);
  EXPECT_EQ(first(apart, FindingCode::nothing_judged)->finding.kind, "no_neighbour");
  CheckRequest strict;
  strict.strict = true;
  EXPECT_FALSE(judged({square(0, 10, 0), square(13, 23, 0)}, strict).sound);
}

TEST_F(CheckTogether, ABoundThatIsUndecidedIsNoPass) {
  CheckRequest request;
  request.reference = folder_.path() / "reference.obj";
  request.declared_m = 0;
  write_whole_file(request.reference, test::obj_bytes(square(0, 10, 0, true)));
  const CheckVerdict verdict = judged({square(0, 10, 0)}, request);
  EXPECT_FALSE(verdict.sound);
  ASSERT_NE(first(verdict, FindingCode::nothing_judged), nullptr);
  EXPECT_THAT(first(verdict, FindingCode::nothing_judged)->message, HasSubstr("undecided"));
}

TEST_F(CheckTogether, AMeshBesideItsDemIsNotStretchedOverIt) {
  write_whole_file(folder_.path() / "dem.asc",
                   test::asc(9, 9, 30, [](int c, int r) { return 10.0 * c + r * r; }));
  const auto ground = [](int c, int r) { return 10.0 * c + r * r; };
  CheckRequest request;
  request.terrain = folder_.path() / "dem.asc";
  request.declared_m = 1;
  const Mesh far = test::grid(9, 9, 30, ground, {1e6, 0});
  const CheckVerdict guessed = judged({far}, request);
  EXPECT_FALSE(guessed.sound);
  ASSERT_NE(first(guessed, FindingCode::nothing_judged), nullptr);
  EXPECT_EQ(first(guessed, FindingCode::nothing_judged)->finding.kind, "stretched");
  request.placing = "fit";
  EXPECT_TRUE(judged({far}, request).sound) << "as said";
}

// Lifted to the DEM's mean, any surface is better; it still matches nothing.
TEST_F(CheckTogether, AFlatMeshMatchesNoHillsHoweverItIsLifted) {
  const auto hills = [](int c, int r) { return 300.0 + 40 * ((c * 7 + r * 5) % 6) + 11 * (r % 4); };
  write_whole_file(folder_.path() / "dem.asc", test::asc(17, 17, 30, hills));
  CheckRequest request;
  request.terrain = folder_.path() / "dem.asc";
  const CheckVerdict flat = judged({test::grid(17, 17, 30, [](int, int) { return 0.0; })}, request);
  ASSERT_TRUE(flat.terrain.has_value());
  EXPECT_EQ(flat.terrain->better_match, "");
  const CheckVerdict lifted =
      judged({test::grid(17, 17, 30, [&](int c, int r) { return hills(c, r) - 90; })}, request);
  EXPECT_THAT(lifted.terrain->better_match, HasSubstr("lifted"));
}

TEST_F(CheckTogether, AnObjectSaysWhetherItIsClosedAndWhichWayRound) {
  Mesh solid{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  CheckRequest request;
  request.kind = CheckRequest::Kind::object;
  EXPECT_THAT(judged({solid}, request).notes, testing::IsEmpty());
  Mesh turned = solid;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  EXPECT_THAT(judged({turned}, request).notes, testing::Contains(HasSubstr("face inwards")));
  solid.triangles.pop_back();
  EXPECT_THAT(judged({solid}, request).notes, testing::Contains(HasSubstr("not closed: 3 edges")));
}

// A game engine's mesh has y up; the pose is given in its own coordinates.
TEST_F(CheckTogether, TheCameraStandsInTheFilesOwnAxes) {
  Mesh mesh = square(0, 10, 0);
  for (Vec3& p : mesh.positions) p = {p.x, p.z, -p.y};
  CheckRequest request;
  request.up = CheckRequest::Up::y;
  request.camera = {{5, 20, -5}, {5, 0, -5.01}, 60, 64, 64};
  const CheckVerdict verdict = judged({mesh}, request);
  ASSERT_TRUE(verdict.image.has_value());
  EXPECT_GT(verdict.image->mesh_px, 200U);
}

// --unit speaks of the plan, too, where a placing is in metres.
TEST_F(CheckTogether, APlanInFeetLiesOverItsDem) {
  constexpr double kFootM = 0.3048;
  write_whole_file(folder_.path() / "dem.asc",
                   test::asc(5, 5, 30.48, [](int c, int r) { return 10.0 * c + r; }));
  const Mesh mesh = test::grid(5, 5, 30.48 / kFootM, [&](int c, int r) { return (10.0 * c + r) / kFootM; });
  CheckRequest request;
  request.terrain = folder_.path() / "dem.asc";
  request.placing = "local";
  request.unit_m = kFootM;
  const CheckVerdict verdict = judged({mesh}, request);
  ASSERT_TRUE(verdict.terrain.has_value());
  EXPECT_LT(verdict.terrain->vertical_m.max, 1e-9);
  EXPECT_GT(verdict.terrain->judged_share, 0.999);
}

}  // namespace
}  // namespace plumbline
