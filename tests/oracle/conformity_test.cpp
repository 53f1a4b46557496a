// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/conformity.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/predicates.h"
#include "scenarios/error.h"
#include "tests/oracle/conformity_meshes.h"

namespace plumbline {
namespace {

using oracle::check_conformity;
using oracle::ConformityReport;
using oracle::Finding;
using oracle::FindingCode;
using oracle::Severity;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PlanDomain rectangle(Vec2 low, Vec2 high) {
  PlanDomain domain;
  domain.add_rectangle(low, high);
  return domain;
}

/// 2 × 2 square of side 2, height 0, about the vertex 4:
///
///   6───7───8
///   │ ╲ │ ╱ │     triangles, counter-clockwise:
///   3───4───5     0: 0 1 4   1: 1 2 4   2: 2 5 4   3: 5 8 4
///   │ ╱ │ ╲ │     4: 8 7 4   5: 7 6 4   6: 6 3 4   7: 3 0 4
///   0───1───2
Mesh union_jack() {
  Mesh mesh;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) mesh.positions.push_back({1.0 * i, 1.0 * j, 0});
  }
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 5, 4}, {5, 8, 4}, {8, 7, 4}, {7, 6, 4}, {6, 3, 4}, {3, 0, 4}};
  return mesh;
}
const PlanDomain kSquare = rectangle({0, 0}, {2, 2});

/// The same square, coarse in the south:
///
///   6───7───8
///   │ ╲ │ ╱ │     4 stands on the edge 3–5 of the southern triangles
///   3───4───5     0: 0 2 5   1: 0 5 3   then the northern four
///   │    ╱  │
///   0───────2
Mesh coarse_south() {
  Mesh mesh = union_jack();
  mesh.triangles = {{0, 2, 5}, {0, 5, 3}, {5, 8, 4}, {8, 7, 4}, {7, 6, 4}, {6, 3, 4}};
  mesh.positions.erase(mesh.positions.begin() + 1);
  for (auto& corners : mesh.triangles) {
    for (auto& c : corners) c -= c > 1;
  }
  return mesh;  // indices after 1 moved down by one: 4 is now 3, 3 is 2, 5 is 4
}

Finding only(const ConformityReport& report) {
  EXPECT_EQ(report.findings.size(), 1u) << test::text(report);
  return report.findings.empty() ? Finding{} : report.findings.front();
}

TEST(Conformity, SoundSquareIsClean) {
  const ConformityReport report = check_conformity(union_jack(), kSquare);
  EXPECT_TRUE(report.clean()) << test::text(report);
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.left_over_edges, 8u) << "the border alone";
}

TEST(Conformity, EmptyMeshLeavesTheWholeDomainMissing) {
  const Finding finding = only(check_conformity({}, kSquare));
  EXPECT_EQ(finding.code, FindingCode::outline);
  EXPECT_EQ(finding.kind, "missing");
  EXPECT_EQ(finding.area_m2, 4);
  EXPECT_EQ(finding.loop.size(), 4u);
}

TEST(Conformity, NothingPromisedNothingThereIsClean) { EXPECT_TRUE(check_conformity({}, {}).clean()); }

TEST(Conformity, MeshWithoutAPromiseIsExtra) {
  const Finding finding = only(check_conformity(union_jack(), {}));
  EXPECT_EQ(finding.code, FindingCode::outline);
  EXPECT_EQ(finding.kind, "extra");
  EXPECT_EQ(finding.area_m2, 4);
}

TEST(Conformity, LoopsOfFewerThanThreeCornersPromiseNothing) {
  PlanDomain domain = kSquare;
  domain.loops.push_back({});
  domain.loops.push_back({{0.5, 0.5}, {1, 1}});
  EXPECT_TRUE(check_conformity(union_jack(), domain).clean());
}

TEST(Conformity, DomainCornerThatIsNotFiniteIsRefused) {
  PlanDomain domain = kSquare;
  domain.loops[0][1].x = kNan;
  EXPECT_THROW(check_conformity(union_jack(), domain), InputError);
}

TEST(Conformity, DomainLoopsMayShareEdges) {
  PlanDomain halves = rectangle({0, 0}, {1, 2});
  halves.add_rectangle({1, 0}, {2, 1});
  halves.add_rectangle({1, 1}, {2, 2});  // shares half a side with the first
  EXPECT_TRUE(check_conformity(union_jack(), halves).clean());
}

TEST(Conformity, ClockwiseLoopIsAPromisedHole) {
  PlanDomain domain = rectangle({-1, -1}, {3, 3});
  domain.loops.push_back({{0, 0}, {0, 2}, {2, 2}, {2, 0}});  // clockwise
  Mesh frame;
  //  outer square −1…3, inner square 0…2, two triangles a side
  for (const Vec2 p : {Vec2{-1, -1}, {3, -1}, {3, 3}, {-1, 3}, {0, 0}, {2, 0}, {2, 2}, {0, 2}}) {
    frame.positions.push_back({p.x, p.y, 0});
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    frame.triangles.insert(frame.triangles.end(), {{k, next, next + 4}, {k, next + 4, k + 4}});
  }
  EXPECT_TRUE(check_conformity(frame, domain).clean());
  const Finding filled = only(check_conformity(frame, rectangle({-1, -1}, {3, 3})));
  EXPECT_EQ(filled.code, FindingCode::hole);
  EXPECT_EQ(filled.area_m2, 4);
}

TEST(Conformity, TVertexOnTheEdgeIsAHazardWithoutGap) {
  const ConformityReport report = check_conformity(coarse_south(), kSquare);
  const Finding finding = only(report);
  EXPECT_EQ(finding.code, FindingCode::t_junction);
  EXPECT_EQ(finding.severity, Severity::hazard);
  EXPECT_EQ(finding.kind, "t_vertex");
  EXPECT_EQ(finding.at, (Vec3{1, 1, 0}));
  EXPECT_EQ(finding.gap_m, 0);
  EXPECT_THAT(finding.vertices, ElementsAre(3, 2, 4));
  EXPECT_THAT(finding.triangles, ElementsAre(1));
  EXPECT_EQ(report.counts.t_junction, 1u);
  EXPECT_EQ(report.counts.crack, 0u);
}

TEST(Conformity, TVertexOffTheEdgeIsOneCrackCountedTwice) {
  for (const double lift_m : {1.0, -1.0, 1e-3, std::numeric_limits<double>::denorm_min()}) {
    Mesh mesh = coarse_south();
    mesh.positions[3].z = lift_m;
    const ConformityReport report = check_conformity(mesh, kSquare);
    const Finding finding = only(report);
    EXPECT_EQ(finding.code, FindingCode::crack);
    EXPECT_EQ(finding.severity, Severity::fault);
    EXPECT_EQ(finding.gap_m, lift_m) << "vertex minus edge";
    EXPECT_EQ(report.largest_gap_m, std::fabs(lift_m));
    EXPECT_EQ(report.counts.t_junction, 1u);
    EXPECT_EQ(report.counts.crack, 1u);
  }
}

TEST(Conformity, AnUlpUnderARoundedMidpointHeightIsStillACrack) {
  // z = 0.1 and 0.3 at the ends: their exact mean is no double, so any vertex there has a gap.
  Mesh mesh = coarse_south();
  mesh.positions[2].z = 0.1;
  mesh.positions[4].z = 0.3;
  mesh.positions[3].z = 0.2;
  const ConformityReport report = check_conformity(mesh, kSquare);
  const Finding finding = only(report);
  EXPECT_EQ(finding.code, FindingCode::crack);
  EXPECT_GT(std::fabs(finding.gap_m), 0);
  EXPECT_LT(std::fabs(finding.gap_m), 0x1p-53);
}

TEST(Conformity, EndHeightsOfACutEdgeAreCompared) {
  // The northern half has vertices of its own at 3 and 5, higher: T-vertex 4 stays level with the southern
  // edge.
  Mesh mesh = coarse_south();
  const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back({0, 1, 2});
  for (std::size_t t = 2; t < mesh.triangles.size(); ++t) {
    for (auto& c : mesh.triangles[t]) {
      if (c == 2) c = copy;
    }
  }
  const ConformityReport report = check_conformity(mesh, kSquare);
  EXPECT_EQ(report.counts.t_junction, 1u) << test::text(report);
  EXPECT_EQ(report.counts.crack, 1u);
  ASSERT_EQ(report.findings.size(), 2u);
  EXPECT_EQ(report.findings[1].kind, "height_mismatch");
  EXPECT_EQ(report.findings[1].gap_m, 2);
  EXPECT_EQ(report.findings[1].at, (Vec3{0, 1, 2}));
}

TEST(Conformity, SeamOfDuplicatedVerticesIsSound) {
  Mesh mesh = union_jack();
  for (auto& corners : mesh.triangles) {  // every triangle its own corners
    for (auto& c : corners) {
      mesh.positions.push_back(mesh.positions[c]);
      c = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
  }
  mesh.positions.erase(mesh.positions.begin(), mesh.positions.begin() + 9);
  for (auto& corners : mesh.triangles) {
    for (auto& c : corners) c -= 9;
  }
  EXPECT_TRUE(check_conformity(mesh, kSquare).clean());
  mesh.positions[2] = {1, 1, -0.0};  // minus zero is zero
  mesh.positions[0] = {-0.0, -0.0, 0};
  EXPECT_TRUE(check_conformity(mesh, kSquare).clean());
}

TEST(Conformity, SeamAtAnotherHeightIsACrack) {
  //  the western half ends in 1′ and 4′ and 7′, at other heights than 1, 4, 7
  Mesh mesh = union_jack();
  for (const std::uint32_t v : {1u, 4u, 7u}) mesh.positions.push_back(mesh.positions[v]);
  mesh.positions[10].z = 0.5;  // 4′
  for (const std::size_t t : {0u, 5u, 6u, 7u}) {
    for (auto& c : mesh.triangles[t]) c = c == 1 ? 9 : c == 4 ? 10 : c == 7 ? 11 : c;
  }
  const ConformityReport report = check_conformity(mesh, kSquare);
  EXPECT_EQ(report.counts.crack, 2u) << test::text(report);
  EXPECT_EQ(report.counts.total(), 2u);
  EXPECT_EQ(report.largest_gap_m, 0.5);
  for (const Finding& f : report.findings) EXPECT_EQ(f.at, (Vec3{1, 1, 0.5}));
}

TEST(Conformity, DroppedInnerTriangleIsAHole) {
  test::Surface s;
  Random random(1);
  s = test::random_grid(5, random);
  Mesh mesh = s.mesh;
  mesh.triangles.erase(mesh.triangles.begin() + 12);
  const Finding finding = only(check_conformity(mesh, s.domain));
  EXPECT_EQ(finding.code, FindingCode::hole);
  EXPECT_EQ(finding.loop.size(), 3u);
  EXPECT_GT(finding.area_m2, 0);
}

TEST(Conformity, DroppedBorderTriangleIsMissingOutline) {
  Mesh mesh = union_jack();
  mesh.triangles.erase(mesh.triangles.begin());
  const Finding finding = only(check_conformity(mesh, kSquare));
  EXPECT_EQ(finding.code, FindingCode::outline);
  EXPECT_EQ(finding.kind, "missing");
  EXPECT_EQ(finding.area_m2, 0.5);
  EXPECT_EQ(finding.distance_m, 1) << "vertex 4 is a metre from the side";
}

TEST(Conformity, NeighbouringDroppedTrianglesAreOneHoleOthersAreTwo) {
  Random random(1);
  const test::Surface s = test::random_grid(9, random);
  Mesh mesh = s.mesh;
  mesh.triangles.erase(mesh.triangles.begin() + 40, mesh.triangles.begin() + 42);  // the two of one cell
  EXPECT_EQ(only(check_conformity(mesh, s.domain)).loop.size(), 4u);
  mesh.triangles.erase(mesh.triangles.begin() + 80);
  EXPECT_EQ(check_conformity(mesh, s.domain).counts.hole, 2u);
}

TEST(Conformity, ExtraTriangleBeyondTheBorder) {
  Mesh mesh = union_jack();
  mesh.positions.push_back({1, -0.5, 0});
  mesh.triangles.push_back({0, 9, 1});
  const Finding finding = only(check_conformity(mesh, kSquare));
  EXPECT_EQ(finding.code, FindingCode::outline);
  EXPECT_EQ(finding.kind, "extra");
  EXPECT_EQ(finding.area_m2, 0.25);
  EXPECT_EQ(finding.distance_m, 0.5);
}

TEST(Conformity, FreeTriangleAcrossTheBorderOverlapsInsideAndIsExtraOutside) {
  Mesh mesh = union_jack();
  for (const Vec2 p : {Vec2{1.25, 0.25}, {1.5, -0.5}, {1.75, 0.25}}) mesh.positions.push_back({p.x, p.y, 3});
  mesh.triangles.push_back({9, 10, 11});
  const ConformityReport report = check_conformity(mesh, kSquare);
  EXPECT_EQ(report.counts.overlap, 1u) << test::text(report);
  EXPECT_EQ(report.counts.outline, 1u);
  EXPECT_EQ(report.counts.total(), 2u);
}

TEST(Conformity, FinOnAnInnerEdgeIsNonManifoldAndOverlaps) {
  Mesh mesh = union_jack();
  mesh.positions.push_back({1.5, 0.75, 1});
  mesh.triangles.push_back({1, 9, 4});  // on the edge 1–4, above triangles 1 and 2
  const ConformityReport report = check_conformity(mesh, kSquare);
  EXPECT_EQ(report.counts.non_manifold, 1u) << test::text(report);
  EXPECT_EQ(report.counts.overlap, 1u);
  EXPECT_EQ(report.counts.total(), 2u);
  EXPECT_THAT(report.findings[0].vertices, ElementsAre(1, 4));
  EXPECT_THAT(report.findings[0].triangles, ElementsAre(0, 1, 8));
}

TEST(Conformity, WholeMeshWoundClockwiseIsFoldOversAlone) {
  Mesh mesh = union_jack();
  for (auto& c : mesh.triangles) std::swap(c[0], c[1]);
  const ConformityReport report = check_conformity(mesh, kSquare);
  EXPECT_EQ(report.counts.fold_over, 8u) << test::text(report);
  EXPECT_EQ(report.counts.total(), 8u);
  for (const Finding& f : report.findings) EXPECT_EQ(f.kind, "reversed");
}

TEST(Conformity, VertexPushedAcrossItsLinkFoldsOver) {
  Mesh mesh = union_jack();
  mesh.positions[4] = {1, -0.5, 0};  // below the southern side: triangles 0 and 1 turn over
  const ConformityReport report = check_conformity(mesh, kSquare);
  EXPECT_EQ(report.counts.fold_over, 2u) << test::text(report);
  EXPECT_EQ(report.counts.total(), 2u);
  for (const Finding& f : report.findings) EXPECT_EQ(f.kind, "folded");
}

TEST(Conformity, DoubledAndReversedTriangleIsADuplicateOfTheSoundOne) {
  Mesh mesh = union_jack();
  mesh.triangles.insert(mesh.triangles.begin(), {0, 4, 1});  // clockwise copy of the next
  const Finding finding = only(check_conformity(mesh, kSquare));
  EXPECT_EQ(finding.code, FindingCode::duplicate);
  EXPECT_THAT(finding.triangles, ElementsAre(0, 1)) << "the copy, then the one that is kept";
}

TEST(Conformity, DegenerateTriangleThatFillsATJunctionIsTheOnlyFinding) {
  Mesh mesh = coarse_south();
  mesh.triangles.push_back({2, 4, 3});  // the flat triangle between 3–5 and 4, in the indices of coarse_south
  mesh.positions[3].z = 1;              // a wall in space
  const Finding finding = only(check_conformity(mesh, kSquare));
  EXPECT_EQ(finding.code, FindingCode::degenerate);
  EXPECT_EQ(finding.kind, "collinear");
}

TEST(Conformity, BrokenInputIsReportedOnceAndLeftOut) {
  Mesh mesh = union_jack();
  mesh.positions[4].z = kNan;
  const ConformityReport report = check_conformity(mesh, kSquare);
  const Finding vertex = only(report);
  EXPECT_EQ(vertex.code, FindingCode::non_finite);
  EXPECT_EQ(vertex.at, (Vec3{1, 1, 0}));
  EXPECT_EQ(vertex.triangles.size(), 8u);

  mesh = union_jack();
  mesh.triangles[2] = {2, 5, 77};
  const Finding index = only(check_conformity(mesh, kSquare));
  EXPECT_EQ(index.code, FindingCode::bad_index);
  EXPECT_THAT(index.triangles, ElementsAre(2));

  mesh.triangles[2] = {2, 77, 78};
  EXPECT_EQ(only(check_conformity(mesh, kSquare)).code, FindingCode::bad_index);
}

TEST(Conformity, HugeAndTinyCoordinatesAreDecidedExactly) {
  for (const double scale : {0x1p-1070, 0x1p-500, 0x1p60, 0x1p500, 0x1p1000}) {
    Mesh mesh = coarse_south();
    PlanDomain domain = rectangle({0, 0}, {2 * scale, 2 * scale});
    for (Vec3& p : mesh.positions) p = p * scale;
    EXPECT_EQ(only(check_conformity(mesh, domain)).code, FindingCode::t_junction) << scale;
    mesh.positions[3].z = scale;
    EXPECT_EQ(only(check_conformity(mesh, domain)).gap_m, scale) << scale;
    mesh.triangles.erase(mesh.triangles.begin() + 3);
    const ConformityReport report = check_conformity(mesh, domain);
    EXPECT_EQ(report.counts.outline, 1u) << scale;
    EXPECT_TRUE(std::isfinite(report.findings.back().area_m2));
  }
  // A vertex beside a line by the last bit, a petametre from the origin: not on it, not a T-junction.
  const double far_m = 1e15, bit_m = std::nextafter(far_m, 2e15) - far_m;
  EXPECT_EQ(oracle::orientation({far_m, far_m}, {far_m + 4 * bit_m, far_m + 4 * bit_m},
                                {far_m + 2 * bit_m, far_m + 3 * bit_m})
                .value,
            1);
}

TEST(Conformity, FindingsAreCountedCompletelyWhenThereAreVeryMany) {
  // 300 × 300 cells, a strip of coarse cells beside each strip of fine ones would do; here every cell is its
  // own patch at its own height: each inner cell side is a crack.
  constexpr int kCells = 300;
  Mesh mesh;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const auto v = static_cast<std::uint32_t>(mesh.positions.size());
      const double z = j * kCells + i;
      mesh.positions.insert(
          mesh.positions.end(),
          {{1.0 * i, 1.0 * j, z}, {i + 1.0, 1.0 * j, z}, {i + 1.0, j + 1.0, z}, {1.0 * i, j + 1.0, z}});
      mesh.triangles.insert(mesh.triangles.end(), {{v, v + 1, v + 2}, {v, v + 2, v + 3}});
    }
  }
  const ConformityReport report = check_conformity(mesh, rectangle({0, 0}, {kCells, kCells}));
  EXPECT_EQ(report.counts.crack, 2u * kCells * (kCells - 1));
  EXPECT_EQ(report.counts.total(), report.counts.crack);
  EXPECT_EQ(report.largest_gap_m, kCells);
}

TEST(Conformity, OneLongEdgeMayHaveVeryManyTVertices) {
  //  ┌┬┬┬┬┬┬┬┬┬┐ 2
  //  ├┴┴┴┴┴┴┴┴┴┤ 1   fine above, two triangles below
  //  └─────────┘ 0
  constexpr int kCells = 20000;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {kCells, 0, 0}, {kCells, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int i = 0; i <= kCells; ++i) {
    mesh.positions.insert(mesh.positions.end(), {{1.0 * i, 1, i % 3 == 1 ? 0.5 : 0.0}, {1.0 * i, 2, 0}});
  }
  for (std::uint32_t i = 0; i < kCells; ++i) {
    const std::uint32_t a = 4 + 2 * i;
    mesh.triangles.insert(mesh.triangles.end(), {{a, a + 2, a + 3}, {a, a + 3, a + 1}});
  }
  const ConformityReport report = check_conformity(mesh, rectangle({0, 0}, {kCells, 2}));
  EXPECT_EQ(report.counts.t_junction, kCells - 1u);
  EXPECT_EQ(report.counts.crack, (kCells + 1u) / 3);
  EXPECT_EQ(report.findings.size(), kCells - 1u) << "a T-vertex with a gap is one finding under two counts";
}

TEST(Conformity, ATangleEndsWithOneFindingForEachOfItsPieces) {
  // Triangles strewn at random, each across hundreds of others: too many crossings to lay them all out.
  Random random(11);
  Mesh mesh;
  constexpr std::uint32_t kTriangles = 3000;
  for (std::uint32_t t = 0; t < kTriangles; ++t) {
    for (int k = 0; k < 3; ++k) mesh.positions.push_back({random.unit(), random.unit(), 0});
    const Vec3 *a = &mesh.positions[3 * t], *b = a + 1, *c = a + 2;
    const bool left = oracle::orientation({a->x, a->y}, {b->x, b->y}, {c->x, c->y}).value > 0;
    mesh.triangles.push_back({3 * t, 3 * t + (left ? 1 : 2), 3 * t + (left ? 2 : 1)});
  }
  const ConformityReport report = check_conformity(mesh, rectangle({0, 0}, {1, 1}));
  EXPECT_EQ(report.counts.overlap, kTriangles);
  EXPECT_EQ(report.counts.outline, 1u);
  EXPECT_EQ(report.counts.total(), kTriangles + 1u);
  for (const Finding& f : report.findings) EXPECT_EQ(f.kind, "tangled");
}

TEST(Conformity, FindingsComeSorted) {
  Random random(5);
  const test::Surface s = test::random_grid(9, random);
  Mesh mesh = s.mesh;
  std::swap(mesh.triangles[90][0], mesh.triangles[90][1]);
  mesh.triangles.erase(mesh.triangles.begin() + 60);
  mesh.triangles.erase(mesh.triangles.begin() + 30);
  mesh.triangles.push_back(mesh.triangles[3]);
  const ConformityReport report = check_conformity(mesh, s.domain);
  EXPECT_EQ(report.findings.size(), 4u);
  EXPECT_TRUE(
      std::is_sorted(report.findings.begin(), report.findings.end(), [](const Finding& a, const Finding& b) {
        return std::tuple(a.code, a.at.x, a.at.y, a.at.z) < std::tuple(b.code, b.at.x, b.at.y, b.at.z);
      }));
}

}  // namespace
}  // namespace plumbline
