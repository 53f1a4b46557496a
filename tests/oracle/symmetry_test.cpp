// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Every kind of fault, planted once and looked at from all sides: the verdicts of conformity and of soundness
// are the same findings, with the same witnesses and, to the bit, the same gaps and areas. No axis is
// forgotten: each kind is counted by the direction it faces.
#include "tests/oracle/symmetry.h"

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "oracle/conformity.h"
#include "oracle/soundness.h"
#include "properties/faults/faults.h"
#include "tests/oracle/conformity_meshes.h"

namespace plumbline {
namespace {

using oracle::check_conformity;
using oracle::check_soundness;
using oracle::ConformityReport;
using oracle::Finding;
using test::Move;

/// A domain's distance is measured by doubles along each side in its direction: roundings of coordinates
/// below 2¹¹ m, squared and rooted.
constexpr double kDistanceRounding_m = 0x1p-36;

test::Surface sound_mesh(Random& random) {
  test::Surface s;
  switch (random.below(3)) {
    case 0:
      s = test::random_grid(5 + static_cast<int>(random.below(4)), random);
      break;
    case 1:
      s = test::random_bintree(3, random);
      break;
    default:
      s = test::random_delaunay(30, random.below(2) == 0, random);
  }
  for (Vec3& p : s.mesh.positions) p = test::dyadic(p);
  for (auto& loop : s.domain.loops) {
    for (Vec2& p : loop) p = {test::dyadic(p.x), test::dyadic(p.y)};
  }
  return s;
}

/// What a finding says, without its place: equal to the bit whichever way the mesh lies.
using Essence = std::tuple<int, std::string, int, std::vector<std::uint32_t>, std::vector<std::uint32_t>,
                           double, double, std::vector<std::pair<double, double>>>;

/// `renumber` maps old indices to the other mesh's; `ordered` triangles tell the kept one of two duplicates,
/// which is a matter of order.
struct Renumbering {
  const std::vector<std::uint32_t>* vertex = nullptr;
  const std::vector<std::uint32_t>* triangle = nullptr;
};

Essence essence(const Finding& f, const Move& move, const Renumbering& renumber) {
  std::vector<std::uint32_t> vertices, triangles;
  for (const std::uint32_t v : f.vertices) {
    const bool known = renumber.vertex != nullptr && v < renumber.vertex->size();
    vertices.push_back(known ? (*renumber.vertex)[v] : v);
  }
  for (const std::uint32_t t : f.triangles)
    triangles.push_back(renumber.triangle != nullptr ? (*renumber.triangle)[t] : t);
  std::sort(vertices.begin(), vertices.end());
  std::sort(triangles.begin(), triangles.end());
  std::vector<std::pair<double, double>> loop;
  for (const Vec2 p : f.loop) {
    const Vec2 q = move(p);
    loop.emplace_back(q.x, q.y);
  }
  std::sort(loop.begin(), loop.end());
  return {static_cast<int>(f.code),
          f.kind,
          static_cast<int>(f.severity),
          vertices,
          triangles,
          f.gap_m * move.scale,
          f.area_m2 * move.scale * move.scale,
          loop};
}

std::vector<Essence> essences(const ConformityReport& report, const Move& move = {},
                              const Renumbering& renumber = {}) {
  std::vector<Essence> all;
  for (const Finding& f : report.findings) all.push_back(essence(f, move, renumber));
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::array<double, 3>> places(const ConformityReport& report, const Move& move = {}) {
  std::vector<std::array<double, 3>> all;
  for (const Finding& f : report.findings) {
    const Vec3 p = move(f.at);
    all.push_back({p.x + 0.0, p.y + 0.0, p.z + 0.0});
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<double> distances(const ConformityReport& report) {
  std::vector<double> all;
  for (const Finding& f : report.findings) all.push_back(f.distance_m);
  std::sort(all.begin(), all.end());
  return all;
}

/// A finding about several points stands at the first of them along x, so a move may choose another of its
/// points, never one that is not its own.
bool stands_on_its_own(const Finding& f, const Mesh& mesh) {
  const auto same = [&](Vec3 p) { return p.x == f.at.x && p.y == f.at.y; };
  for (const std::uint32_t v : f.vertices) {
    if (v < mesh.positions.size() && same(mesh.positions[v])) return true;
  }
  for (const std::uint32_t t : f.triangles) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v < mesh.positions.size() && same(mesh.positions[v])) return true;
    }
  }
  for (const Vec2 p : f.loop) {
    if (same({p.x, p.y, 0})) return true;
  }
  return f.vertices.size() == 2 || f.code == oracle::FindingCode::bad_index ||
         f.code == oracle::FindingCode::non_finite;  // the middle of an edge; no place at all
}

void expect_same(const ConformityReport& before, const ConformityReport& after, const Move& move,
                 const Mesh& moved, const std::string& context, const Renumbering& renumber = {}) {
  EXPECT_EQ(before.counts, after.counts) << context;
  EXPECT_EQ(before.largest_gap_m * move.scale, after.largest_gap_m) << context;
  EXPECT_EQ(essences(before, move, renumber), essences(after)) << context << '\n'
                                                               << test::text(before) << "then\n"
                                                               << test::text(after);
  const std::vector<double> one = distances(before), two = distances(after);
  ASSERT_EQ(one.size(), two.size()) << context;
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_NEAR(one[i] * move.scale, two[i], kDistanceRounding_m * move.scale) << context;
  for (const Finding& f : after.findings) EXPECT_TRUE(stands_on_its_own(f, moved)) << context;
}

/// Where the fault faces: from the middle of the triangle that it is a fault of to its witnesses, or from the
/// middle of the mesh. Told from what was planted, not from what was found.
Vec2 facing(const faults::PlantedFault& fault) {
  const Mesh& mesh = fault.mesh;
  const auto middle = [&](const auto& vertices) {
    Vec2 sum{};
    int count = 0;
    for (const std::uint32_t v : vertices) {
      if (v >= mesh.positions.size()) continue;
      const Vec3& p = mesh.positions[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      sum = sum + Vec2{p.x, p.y};
      ++count;
    }
    return count == 0 ? sum : sum * (1.0 / count);
  };
  const faults::ExpectedFinding& expected = fault.expected.front();
  std::vector<std::uint32_t> witnesses = expected.vertices;
  if (!expected.triangles.empty()) {
    const auto& corners = mesh.triangles[expected.triangles[0]];
    const Vec2 v = middle(witnesses) - middle(corners);
    const bool own_corners = std::all_of(witnesses.begin(), witnesses.end(), [&](auto w) {
      return std::find(corners.begin(), corners.end(), w) != corners.end();
    });
    if (own_corners && witnesses.size() < 3 && !witnesses.empty()) return v;
    witnesses.assign(corners.begin(), corners.end());
  }
  std::vector<std::uint32_t> all(mesh.positions.size());
  std::iota(all.begin(), all.end(), 0u);
  return middle(witnesses) - middle(all);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kRounds = 4;
#else
constexpr std::uint64_t kRounds = 100;
#endif

struct Tally {
  std::array<std::size_t, 4> planted{}, found{};
};

TEST(Symmetry, EveryFaultIsFoundInAllEightOrientations) {
  std::map<std::string, Tally> tallies;
  for (const faults::FaultKind& kind : faults::fault_kinds()) {
    for (std::uint64_t seed = 0; seed < kRounds; ++seed) {
      Random random(seed, kind.name);
      const test::Surface s = sound_mesh(random);
      if (!check_conformity(s.mesh, s.domain).clean()) continue;  // rounding to 2⁻²⁰ m bent a straight border
      const auto fault = faults::plant(kind.name, s.mesh, s.domain, random);
      if (!fault) continue;
      const ConformityReport before = check_conformity(fault->mesh, fault->domain);
      for (int number = 0; number < 8; ++number) {
        const Move move = test::symmetry(number);
        faults::PlantedFault moved = *fault;
        moved.mesh = move(fault->mesh);
        moved.domain = move(fault->domain);
        const ConformityReport after = check_conformity(moved.mesh, moved.domain);
        const faults::Score score = faults::score(moved, after);
        const std::string context =
            std::string(kind.name) + ", seed " + std::to_string(seed) + ", " + move.name();
        ASSERT_TRUE(score.perfect()) << context << '\n' << test::text(after);
        expect_same(before, after, move, moved.mesh, context);
        ASSERT_FALSE(HasFailure());
        if (kind.sound) continue;
        for (const std::size_t direction : test::directions(facing(moved))) {
          ++tallies[std::string(kind.name)].planted[direction];
          if (score.perfect()) ++tallies[std::string(kind.name)].found[direction];
        }
      }
    }
  }
  std::size_t kinds = 0;
  for (const faults::FaultKind& kind : faults::fault_kinds()) {
    if (kind.sound) continue;
    const Tally& tally = tallies[std::string(kind.name)];
    for (std::size_t d = 0; d < 4; ++d) {
      EXPECT_GT(tally.planted[d], 0U) << kind.name << " never faced " << test::kDirections[d];
      EXPECT_EQ(tally.found[d], tally.planted[d]) << kind.name << ' ' << test::kDirections[d];
      RecordProperty(fmt::format("{} {}", kind.name, test::kDirections[d]),
                     fmt::format("{} of {}", tally.found[d], tally.planted[d]));
    }
    ++kinds;
  }
  EXPECT_GT(kinds, 20U);
}

/// Up to three faults in one mesh, so that they meet.
test::Surface faulty_mesh(Random& random) {
  test::Surface s = sound_mesh(random);
  constexpr std::array<std::string_view, 8> kMixable{
      "corner_lifted_1m", "triangle_dropped", "triangle_flipped",  "triangle_doubled",
      "edge_split_1m",    "triangle_over",    "vertex_moved_over", "border_shifted_in"};
  for (int k = 0; k < 3; ++k) {
    if (const auto fault = faults::plant(kMixable[random.below(kMixable.size())], s.mesh, s.domain, random))
      s.mesh = fault->mesh;
  }
  for (Vec3& p : s.mesh.positions) p = test::dyadic(p);
  return s;
}

TEST(Symmetry, SeveralFaultsAtOnceScaleShiftAndTurnExactly) {
  std::size_t judged = 0, at_their_place = 0;
  for (std::uint64_t seed = 0; seed < 5 * kRounds; ++seed) {
    Random random(seed, "moves");
    const test::Surface s = faulty_mesh(random);
    const ConformityReport before = check_conformity(s.mesh, s.domain);
    std::vector<Move> moves;
    for (int number = 1; number < 8; ++number) moves.push_back(test::symmetry(number));
    for (const double scale : {0x1p-100, 0x1p-1, 0x1p7, 0x1p100})
      moves.push_back({false, false, false, scale});
    moves.push_back({false, false, false, 1, {1024, -4096, 512}});
    moves.push_back({true, false, true, 0.25, {-3, 5.5, 0x1p-18}});
    for (const Move& move : moves) {
      const test::Surface other{move(s.mesh), move(s.domain)};
      const ConformityReport after = check_conformity(other.mesh, other.domain);
      const std::string context = "seed " + std::to_string(seed) + ", " + move.name();
      if (move.shift == Vec3{}) {
        expect_same(before, after, move, other.mesh, context);
      } else {
        // Crossings of edges are rounded where they lie, so a shift may move a loop's corner by an ulp there,
        // and a region's area with it. What is decided must not move, nor a gap.
        EXPECT_EQ(before.counts, after.counts) << context;
        EXPECT_EQ(before.largest_gap_m * move.scale, after.largest_gap_m) << context;
        ASSERT_EQ(before.findings.size(), after.findings.size()) << context;
      }
      if (!move.transpose && !move.flip_x && !move.flip_y && move.shift == Vec3{}) {
        EXPECT_EQ(places(before, move), places(after)) << context;
        at_their_place += before.findings.size();
      }
    }
    ASSERT_FALSE(HasFailure());
    judged += before.findings.size();
  }
  EXPECT_GT(judged, 5 * kRounds) << "there must be findings to compare";
  EXPECT_GT(at_their_place, 5 * kRounds);
}

TEST(Symmetry, OrderOfTrianglesAndVerticesMovesNoFinding) {
  std::size_t judged = 0;
  for (std::uint64_t seed = 0; seed < 10 * kRounds; ++seed) {
    Random random(seed, "order");
    const test::Surface s = faulty_mesh(random);
    const test::Shuffled other = test::shuffled(s.mesh, random);
    const ConformityReport before = check_conformity(s.mesh, s.domain),
                           after = check_conformity(other.mesh, s.domain);
    EXPECT_EQ(before.counts, after.counts) << seed;
    EXPECT_EQ(before.largest_gap_m, after.largest_gap_m) << seed;
    EXPECT_EQ(places(before), places(after)) << seed << '\n'
                                             << test::text(before) << "then\n"
                                             << test::text(after);
    // Which of two equal triangles is the extra one, which of several uses of an edge a finding names, is a
    // matter of order; the figures and regions are not.
    const auto bare = [](std::vector<Essence> all) {
      for (Essence& e : all) {
        std::get<3>(e).clear();
        std::get<4>(e).clear();
      }
      std::sort(all.begin(), all.end());
      return all;
    };
    EXPECT_EQ(bare(essences(before)), bare(essences(after))) << seed;
    ASSERT_FALSE(HasFailure());
    judged += before.findings.size();
  }
  EXPECT_GT(judged, 10 * kRounds);
}

TEST(Symmetry, SoundnessOfFaultyMeshes) {
  std::set<oracle::FindingCode> seen;
  for (const faults::FaultKind& kind : faults::fault_kinds()) {
    for (std::uint64_t seed = 0; seed < kRounds; ++seed) {
      Random random(seed, kind.name);
      const test::Surface s = sound_mesh(random);
      const auto fault = faults::plant(kind.name, s.mesh, s.domain, random);
      if (!fault) continue;
      Mesh mesh = fault->mesh;
      if (seed % 4 == 0 && mesh.triangles.size() > 1)
        mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], 0});
      const ConformityReport before = check_soundness(mesh);
      for (const Finding& f : before.findings) seen.insert(f.code);
      for (int number = 1; number < 8; ++number) {
        for (const double scale : {1.0, 0x1p-40, 0x1p40}) {
          Move move = test::symmetry(number);
          move.scale = scale;
          const Mesh other = move(mesh);
          const ConformityReport after = check_soundness(other);
          expect_same(before, after, move, other, std::string(kind.name) + ' ' + move.name());
        }
      }
      const test::Shuffled other = test::shuffled(mesh, random);
      const ConformityReport after = check_soundness(other.mesh);
      EXPECT_EQ(before.counts, after.counts) << kind.name;
      EXPECT_EQ(places(before), places(after)) << kind.name << ' ' << seed << '\n'
                                               << test::text(before) << "then\n"
                                               << test::text(after);
      ASSERT_FALSE(HasFailure());
    }
  }
  using enum oracle::FindingCode;
  EXPECT_EQ(seen, (std::set{bad_index, non_finite, degenerate, duplicate, non_manifold, unused_vertex}));
}

}  // namespace
}  // namespace plumbline
