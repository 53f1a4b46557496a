// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The same faults, told in another order or seen from another side, are the same findings.
#include <algorithm>
#include <functional>
#include <numeric>

#include <gtest/gtest.h>

#include "oracle/conformity.h"
#include "properties/faults/faults.h"
#include "tests/oracle/conformity_meshes.h"

namespace plumbline {
namespace {

using oracle::check_conformity;
using oracle::ConformityReport;
using oracle::Finding;

/// A mesh with up to three faults of random kinds. Coordinates are multiples of 2⁻²⁰, below 2¹⁰, so that
/// shifts by integers and scalings by powers of two are exact.
test::Surface faulty_mesh(Random& random) {
  test::Surface s =
      random.below(2) == 0 ? test::random_bintree(3, random) : test::random_delaunay(30, true, random);
  const auto plant = [&](std::string_view kind) {
    if (const auto fault = faults::plant(kind, s.mesh, s.domain, random)) s.mesh = fault->mesh;
  };
  if (random.below(3) == 0) {
    const auto& kind = faults::fault_kinds()[random.below(faults::fault_kinds().size())];
    if (kind.name != "vertex_nan") plant(kind.name);  // the place of that one cannot be moved along
  } else {
    // These do not mind that the mesh is no longer sound after the first.
    constexpr std::array<std::string_view, 8> kMixable{
        "corner_lifted_1m", "triangle_dropped", "triangle_flipped",  "triangle_doubled",
        "edge_split_1m",    "triangle_over",    "vertex_moved_over", "border_shifted_in"};
    for (int k = 0; k < 3; ++k) plant(kMixable[random.below(kMixable.size())]);
  }
  for (Vec3& p : s.mesh.positions) {
    const auto round = [](double c) { return std::floor(c * 0x1p20 + 0.5) * 0x1p-20; };
    p = {round(p.x), round(p.y), round(p.z)};
  }
  return s;
}

/// What must be the same: code, kind, severity, place, gap, loop as a set of corners, and how many witnesses.
using Essence = std::tuple<int, std::string, std::array<double, 3>, double,
                           std::vector<std::pair<double, double>>, std::size_t, std::size_t>;
using Move = std::function<Vec3(Vec3)>;

std::vector<Essence> essence(const ConformityReport& report, const Move& move, double scale,
                             bool with_place) {
  std::vector<Essence> all;
  for (const Finding& f : report.findings) {
    const Vec3 at = with_place ? move(f.at) : Vec3{};
    std::vector<std::pair<double, double>> loop;
    for (const Vec2 p : f.loop) {
      const Vec3 moved = move({p.x, p.y, 0});
      loop.emplace_back(moved.x + 0.0, moved.y + 0.0);
    }
    std::sort(loop.begin(), loop.end());
    all.emplace_back(static_cast<int>(f.code), f.kind, std::array{at.x + 0.0, at.y + 0.0, at.z + 0.0},
                     f.gap_m * scale, loop, f.vertices.size(), f.triangles.size());
  }
  std::sort(all.begin(), all.end());
  return all;
}

Move identity() {
  return [](Vec3 p) { return p; };
}

test::Surface moved(const test::Surface& s, const Move& move, bool mirror) {
  test::Surface result = s;
  for (Vec3& p : result.mesh.positions) p = move(p);
  for (auto& loop : result.domain.loops) {
    for (Vec2& p : loop) {
      const Vec3 q = move({p.x, p.y, 0});
      p = {q.x, q.y};
    }
    if (mirror) std::reverse(loop.begin(), loop.end());
  }
  if (mirror) {
    for (auto& c : result.mesh.triangles) std::swap(c[1], c[2]);
  }
  return result;
}

/// A place is the first of several corners along x, so mirrors and turns may choose another one.
void expect_same(const test::Surface& s, const Move& move, bool mirror, double scale, bool with_place,
                 std::uint64_t seed) {
  const test::Surface other = moved(s, move, mirror);
  const auto before = check_conformity(s.mesh, s.domain), after = check_conformity(other.mesh, other.domain);
  EXPECT_EQ(before.counts, after.counts) << "seed " << seed << '\n'
                                         << test::text(before) << "then\n"
                                         << test::text(after);
  EXPECT_EQ(essence(before, move, scale, with_place), essence(after, identity(), 1, with_place))
      << "seed " << seed << '\n'
      << test::text(before) << "then\n"
      << test::text(after);
}

constexpr std::uint64_t kRounds = 150;

TEST(ConformityInvariance, OrderOfTrianglesAndVertices) {
  std::size_t judged = 0;
  for (std::uint64_t seed = 0; seed < kRounds; ++seed) {
    Random random(seed, "permutation");
    const test::Surface s = faulty_mesh(random);
    test::Surface shuffled = s;
    const auto shuffle = [&random](auto& list) {
      for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random.below(i)]);
    };
    shuffle(shuffled.mesh.triangles);
    std::vector<std::uint32_t> order(s.mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    shuffle(order);
    for (std::uint32_t v = 0; v < order.size(); ++v) shuffled.mesh.positions[order[v]] = s.mesh.positions[v];
    for (auto& corners : shuffled.mesh.triangles) {
      for (auto& c : corners) c = c < order.size() ? order[c] : c;
      std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                  corners.end());
    }
    const auto before = check_conformity(s.mesh, s.domain),
               after = check_conformity(shuffled.mesh, shuffled.domain);
    EXPECT_EQ(before.counts, after.counts) << "seed " << seed;
    EXPECT_EQ(essence(before, identity(), 1, true), essence(after, identity(), 1, true))
        << "seed " << seed << '\n'
        << test::text(before) << "then\n"
        << test::text(after);
    judged += before.counts.total();
  }
  EXPECT_GT(judged, kRounds) << "there must be findings to compare";
}

TEST(ConformityInvariance, ScalingByPowersOfTwo) {
  for (std::uint64_t seed = 0; seed < kRounds; ++seed) {
    Random random(seed, "scale");
    const test::Surface s = faulty_mesh(random);
    for (const double scale : {0x1p-300, 0.5, 4.0, 0x1p300}) {
      expect_same(
          s, [scale](Vec3 p) { return p * scale; }, false, scale, true, seed);
    }
  }
}

TEST(ConformityInvariance, ExactShifts) {
  for (std::uint64_t seed = 0; seed < kRounds; ++seed) {
    Random random(seed, "shift");
    const Vec3 by{static_cast<double>(random.below(1 << 20)), -static_cast<double>(random.below(1 << 20)),
                  4096};
    const test::Surface s = faulty_mesh(random);
    const test::Surface other = moved(
        s, [by](Vec3 p) { return p + by; }, false);
    const auto before = check_conformity(s.mesh, s.domain),
               after = check_conformity(other.mesh, other.domain);
    // Gaps and crossing points are rounded, so they may differ in the last bit: what is decided must not.
    EXPECT_EQ(before.counts, after.counts) << "seed " << seed;
    ASSERT_EQ(before.findings.size(), after.findings.size());
    for (std::size_t i = 0; i < before.findings.size(); ++i) {
      EXPECT_EQ(before.findings[i].code, after.findings[i].code);
      EXPECT_EQ(before.findings[i].kind, after.findings[i].kind);
      EXPECT_EQ(before.findings[i].triangles, after.findings[i].triangles);
      EXPECT_EQ(before.findings[i].vertices, after.findings[i].vertices);
    }
  }
}

TEST(ConformityInvariance, EightSymmetriesOfTheGrid) {
  for (std::uint64_t seed = 0; seed < kRounds; ++seed) {
    Random random(seed, "symmetry");
    const test::Surface s = faulty_mesh(random);
    for (int symmetry = 1; symmetry < 8; ++symmetry) {
      const bool swap = (symmetry & 1) != 0, flip_x = (symmetry & 2) != 0, flip_y = (symmetry & 4) != 0;
      const Move move = [=](Vec3 p) {
        if (swap) std::swap(p.x, p.y);
        return Vec3{flip_x ? -p.x : p.x, flip_y ? -p.y : p.y, p.z};
      };
      expect_same(s, move, swap ^ flip_x ^ flip_y, 1, false, seed);
    }
  }
}

}  // namespace
}  // namespace plumbline
