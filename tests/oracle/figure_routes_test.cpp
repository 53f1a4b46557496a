// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Second routes of economy, stability and shape: each figure counted again by its definition, without the
// oracle's code: every vertex really taken out and the whole picture measured, whole histories kept, rational
// numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include "oracle/economy.h"
#include "oracle/shape.h"
#include "oracle/stability.h"
#include "properties/faults/faults.h"
#include "tests/oracle/conformity_meshes.h"
#include "tests/oracle/image_scenes.h"

namespace plumbline::oracle {
namespace {

using Rational = CGAL::Exact_rational;

Rational twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (Rational(b.x) - a.x) * (Rational(c.y) - a.y) - (Rational(b.y) - a.y) * (Rational(c.x) - a.x);
}
Rational square(const Vec3& a, const Vec3& b) {
  const Rational x = Rational(b.x) - a.x, y = Rational(b.y) - a.y;
  return x * x + y * y;
}

// ---- O4 -----------------------------------------------------------------------------------------------

enum class Fate { kept, not_judged, taken_out };

/// The mesh without v by the definition in economy.h, in rationals; `out` is it if there is one.
Fate take_out(const Mesh& mesh, std::uint32_t v, Mesh& out) {
  out = {mesh.positions, {}};
  std::map<std::uint32_t, std::uint32_t> next, previous;
  for (const auto& t : mesh.triangles) {
    const auto at = std::find(t.begin(), t.end(), v);
    if (at == t.end()) {
      out.triangles.push_back(t);
      continue;
    }
    if (twice_area(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]) <= 0)
      return Fate::not_judged;
    const auto k = static_cast<std::size_t>(at - t.begin());
    const std::uint32_t from = t[(k + 1) % 3], to = t[(k + 2) % 3];
    if (!next.emplace(from, to).second || !previous.emplace(to, from).second) return Fate::not_judged;
  }
  if (next.empty()) return Fate::not_judged;
  std::vector<std::uint32_t> starts;
  for (const auto& [from, to] : next) {
    if (!previous.contains(from)) starts.push_back(from);
  }
  if (starts.size() > 1) return Fate::not_judged;
  const std::uint32_t start = starts.empty() ? next.begin()->first : starts[0];
  std::vector<std::uint32_t> ring{start};
  for (auto it = next.find(start); it != next.end() && it->second != start; it = next.find(it->second))
    ring.push_back(it->second);
  if (ring.size() < next.size() + starts.size()) return Fate::not_judged;  // several rounds
  const auto at = [&](std::uint32_t u) -> const Vec3& { return mesh.positions[u]; };
  if (!starts.empty()) {
    const Vec3 &a = at(ring.front()), &b = at(ring.back()), &p = at(v);
    const Rational along =
        (Rational(p.x) - a.x) * (Rational(b.x) - p.x) + (Rational(p.y) - a.y) * (Rational(b.y) - p.y);
    if (twice_area(a, b, p) != 0 || along <= 0) return Fate::kept;
  }
  while (ring.size() >= 3) {
    using Worth = std::tuple<Rational, double, double, double>;
    std::optional<Worth> best;
    std::size_t ear = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t n = ring.size();
      const std::uint32_t a = ring[(k + n - 1) % n], b = ring[k], c = ring[(k + 1) % n];
      const Rational area = twice_area(at(a), at(b), at(c));
      if (area <= 0) continue;
      const bool holds_another = std::any_of(ring.begin(), ring.end(), [&](std::uint32_t o) {
        return o != a && o != b && o != c && twice_area(at(a), at(b), at(o)) >= 0 &&
               twice_area(at(b), at(c), at(o)) >= 0 && twice_area(at(c), at(a), at(o)) >= 0;
      });
      if (holds_another) continue;
      const Worth worth{area / (square(at(a), at(b)) + square(at(b), at(c)) + square(at(c), at(a))), at(b).z,
                        std::min(at(a).z, at(c).z), std::max(at(a).z, at(c).z)};
      if (best && !(*best < worth)) continue;
      best = worth;
      ear = k;
    }
    if (!best) return Fate::kept;
    const std::size_t n = ring.size();
    out.triangles.push_back({ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return Fate::taken_out;
}

TEST(SlackRoute, TakingEveryVertexOutAndMeasuringTheWholePictureAgrees) {
  const RayDevice device;
  std::size_t removable = 0, needed = 0, not_judged = 0, over_before = 0;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr std::uint64_t kScenes = 4;
#else
  constexpr std::uint64_t kScenes = 40;
#endif
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    Random random(seed, "slack");
    // Heights of the mesh are wrong by up to a few pixels here and there, so that pixels over the threshold
    // are among those judged; half of the meshes are faulty. Plan coordinates are whole, so that the worth of
    // an ear is the same in doubles and in rationals.
    const plumbline::test::Surface lattice = plumbline::test::random_bintree(3, random);
    Terrain terrain = test::terrain_of(9, 9, 16, [&](int, int) { return random.between(0, 12); });
    const Mesh reference = reference_mesh(terrain);
    Mesh mesh = lattice.mesh;
    for (Vec3& p : mesh.positions) {
      p = {p.x * 16, p.y * 16, terrain.z(static_cast<int>(p.x), static_cast<int>(p.y))};
      if (random.below(5) == 0) p.z += random.between(-6, 6);
    }
    if (seed % 2 == 1) {
      PlanDomain domain = full_domain(terrain);
      const std::string_view kind =
          std::array{"triangle_flipped", "triangle_doubled", "triangle_dropped"}[seed / 2 % 3];
      if (const auto fault = faults::plant(kind, mesh, domain, random)) mesh = fault->mesh;
    }
    const Camera camera = make_camera({30, -70, 90}, {64, 64, 0}, 60, 64, 48);
    const double threshold_px = 1.5;
    const RaySurface a(device, reference), b(device, mesh);
    const PixelHits hits = a.look(camera);
    std::vector<std::uint8_t> told;
    const Slack slack = measure_slack(camera, a, hits, b, threshold_px, &told);
    ImageMaps before;
    over_before += static_cast<std::size_t>(
        1e6 * image_error(camera, a, hits, b, b.look(camera), threshold_px, &before).over_threshold);
    std::size_t count = 0, unjudged = 0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      Mesh without;
      const Fate fate = take_out(mesh, v, without);
      unjudged += fate == Fate::not_judged;
      bool bearable = fate == Fate::taken_out;
      if (bearable) {
        const RaySurface c(device, without);
        ImageMaps after;
        static_cast<void>(image_error(camera, a, hits, c, c.look(camera), threshold_px, &after));
        for (std::size_t i = 0; i < hits.triangle.size(); ++i) {
          const float was = before.displacement_px.values[i], is = after.displacement_px.values[i];
          if (std::isnan(was)) continue;  // uncovered before: nobody's star
          bearable = bearable && is <= std::max(static_cast<float>(threshold_px), was);  // false where NaN
        }
      }
      EXPECT_EQ(told[v] != 0, bearable) << "seed " << seed << ", vertex " << v;
      count += bearable;
    }
    EXPECT_EQ(slack.removable, count) << seed;
    EXPECT_EQ(slack.not_judged, unjudged) << seed;
    removable += count;
    needed += mesh.positions.size() - count;
    not_judged += unjudged;
  }
  EXPECT_GT(removable, 3 * kScenes);
  EXPECT_GT(needed, 3 * kScenes);
  EXPECT_GT(not_judged, 0U);
  EXPECT_GT(over_before, 0U) << "some pixels must be over the threshold beforehand";
}

// ---- O5 -----------------------------------------------------------------------------------------------

TEST(StabilityRoute, TogglesRecountedFromTheWholeHistory) {
  std::size_t toggles = 0, quiet = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed, "toggles");
    constexpr int kFrames = 80;
    constexpr std::size_t kKeys = 30;
    const std::uint64_t rarity = 2 + random.below(20);
    std::vector<std::array<bool, kKeys>> in(kFrames);
    for (std::size_t k = 0; k < kKeys; ++k) in[0][k] = random.below(2) == 0;
    ToggleWatch watch;
    for (int f = 1; f < kFrames; ++f) {
      const auto frame = static_cast<std::size_t>(f);
      std::vector<std::uint64_t> entered, left;
      for (std::size_t k = 0; k < kKeys; ++k) {
        in[frame][k] = in[frame - 1][k] != (random.below(rarity) == 0);
        if (in[frame][k] != in[frame - 1][k]) (in[frame][k] ? entered : left).push_back(7 * k);
      }
      // A vertex toggles when it changes and has changed in one of the ten frames before.
      std::size_t expected = 0;
      for (std::size_t k = 0; k < kKeys; ++k) {
        if (in[frame][k] == in[frame - 1][k]) continue;
        bool before = false;
        for (int g = std::max(1, f - 10); g < f; ++g)
          before = before || in[static_cast<std::size_t>(g)][k] != in[static_cast<std::size_t>(g) - 1][k];
        expected += before;
        quiet += !before;
      }
      ASSERT_EQ(watch.next(f, entered, left), expected) << "seed " << seed << ", frame " << f;
      toggles += expected;
    }
  }
  EXPECT_GT(toggles, 1000U);
  EXPECT_GT(quiet, 1000U);
}

TEST(StabilityRoute, RecoveryRecountedFromTheWholeFlight) {
  std::size_t cuts = 0, unrecovered = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed, "recovery");
    const std::size_t frames = 1 + random.below(40);
    std::vector<bool> cut, good;
    for (std::size_t f = 0; f < frames; ++f) {
      cut.push_back(random.below(9) == 0);
      good.push_back(random.below(4) == 0);
    }
    RecoveryWatch watch;
    for (std::size_t f = 0; f < frames; ++f) watch.next(cut[f], good[f]);
    std::size_t expected_cuts = 0, lost = 0;
    int most = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      if (!cut[f]) continue;
      ++expected_cuts;
      std::size_t end = f + 1;
      while (end < frames && !cut[end]) ++end;
      std::size_t at = f;
      while (at < end && !good[at]) ++at;
      most = std::max(most, static_cast<int>(at - f));
      lost += at == end;
    }
    ASSERT_EQ(watch.cuts(), expected_cuts) << seed;
    ASSERT_EQ(watch.most_frames(), most) << seed;
    ASSERT_EQ(watch.unrecovered(), lost) << seed;
    cuts += expected_cuts;
    unrecovered += lost;
  }
  EXPECT_GT(cuts, 500U);
  EXPECT_GT(unrecovered, 50U);
}

TEST(StabilityRoute, KeysMediansAndCutsByTheirDefinitions) {
  std::size_t cuts = 0, steady = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed, "definitions");
    std::set<std::uint64_t> a, b;
    for (int k = 0; k < 20; ++k) {
      if (random.below(2) == 0) a.insert(random.below(30));
      if (random.below(2) == 0) b.insert(random.below(30));
    }
    std::vector<std::uint64_t> differing, all;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(differing));
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
    const std::vector<std::uint64_t> one(a.begin(), a.end()), two(b.begin(), b.end());
    EXPECT_EQ(compare_keys(one, two).differing, differing.size());
    EXPECT_EQ(compare_keys(one, two).all, all.size());

    std::vector<Camera> flight;
    const auto anywhere = [&] {
      return Vec3{random.between(-9, 9), random.between(-9, 9), random.between(0, 9)};
    };
    for (std::uint64_t k = 0; k < 2 + random.below(7); ++k)
      flight.push_back(make_camera(anywhere(), anywhere(), 60, 64, 48));
    std::vector<double> steps_m;
    for (std::size_t k = 1; k < flight.size(); ++k)
      steps_m.push_back(length(flight[k].position - flight[k - 1].position));
    std::sort(steps_m.begin(), steps_m.end());
    const double median_m = median_step_m(flight);
    EXPECT_EQ(median_m, steps_m[(steps_m.size() + 1) / 2 - 1]);
    for (std::size_t k = 1; k < flight.size(); ++k) {
      const double depth_m = random.between(1, 40);
      const double step_m = length(flight[k].position - flight[k - 1].position);
      const double turn = std::acos(std::clamp(dot(flight[k].forward, flight[k - 1].forward), -1.0, 1.0));
      const double width = 2 * std::atan(32 / flight[k].kappa_px);
      if (std::fabs(turn - width) < 1e-9) continue;  // acos cannot tell
      const bool cut = (step_m > 0.5 * depth_m && step_m > 4 * median_m) || turn > width;
      EXPECT_EQ(is_cut(flight[k - 1], flight[k], depth_m, median_m), cut) << seed;
      (cut ? cuts : steady) += 1;
    }
  }
  EXPECT_GT(cuts, 100U);
  EXPECT_GT(steady, 100U);
}

// ---- O6 -----------------------------------------------------------------------------------------------

TEST(ShapeRoute, RationalsAgreeWithinTheStatedRounding) {
  constexpr double kDegreesPerRadian = 57.29577951308232;
  std::size_t slivers = 0, faulty = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed, "shape");
    const plumbline::test::Surface s =
        plumbline::test::random_delaunay(8 + static_cast<int>(seed % 30), seed % 3 == 0, random);
    const auto& kinds = faults::fault_kinds();
    const auto fault = faults::plant(kinds[seed % kinds.size()].name, s.mesh, s.domain, random);
    const Mesh& mesh = fault ? fault->mesh : s.mesh;
    faulty += fault.has_value();
    const ShapeReport report = shape(mesh);

    // "A few 2⁻⁵³ of (coordinates / shortest edge)": sixteen.
    double bound = 0, sum = 0;
    std::optional<Rational> least_square, least_tangent_square;
    std::size_t judged = 0, sharp = 0;
    std::map<std::uint32_t, std::size_t> valence;
    std::set<std::uint32_t> common;
    std::size_t fans = 0;
    const Rational limit = Rational(kSliverQuality) * Rational(kSliverQuality);
    for (const auto& t : mesh.triangles) {
      const auto usable = [&](std::uint32_t v) {
        return v < mesh.positions.size() && std::isfinite(mesh.positions[v].x) &&
               std::isfinite(mesh.positions[v].y) && std::isfinite(mesh.positions[v].z);
      };
      if (!std::all_of(t.begin(), t.end(), usable)) continue;
      ++judged;
      std::set<std::uint32_t> left;
      for (const std::uint32_t v : t) {
        ++valence[v];
        if (common.contains(v)) left.insert(v);
      }
      if (left.empty()) {
        ++fans;
        left.insert(t.begin(), t.end());
      }
      common = left;
      const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      std::array<Rational, 3> sides{square(a, b), square(b, c), square(c, a)};
      std::sort(sides.begin(), sides.end());
      const Rational area = twice_area(a, b, c), total = sides[0] + sides[1] + sides[2];
      // quality² = (4√3 · area)² / (Σl²)² = 12 · (2·area)² / (Σl²)²
      const Rational quality_square = total == 0 ? Rational(0) : Rational(12 * area * area / (total * total));
      const Rational run = total / 2 - sides[0];
      const Rational tangent_square = run > 0 ? Rational(area * area / (run * run)) : Rational(0);
      if (!least_square || quality_square < *least_square) least_square = quality_square;
      if (!least_tangent_square || tangent_square < *least_tangent_square)
        least_tangent_square = tangent_square;
      sharp += quality_square < limit;
      sum += std::sqrt(CGAL::to_double(quality_square));
      double reach = 0;
      for (const Vec3* p : {&a, &b, &c}) reach = std::max({reach, std::fabs(p->x), std::fabs(p->y)});
      const double shortest = std::sqrt(CGAL::to_double(sides[0]));
      if (shortest > 0) bound = std::max(bound, 16 * 0x1p-53 * reach / shortest);
    }
    if (judged == 0) continue;
    bound = std::max(bound, 16 * 0x1p-53);
    EXPECT_NEAR(report.min_quality, std::sqrt(CGAL::to_double(*least_square)), bound) << seed;
    EXPECT_NEAR(report.mean_quality, sum / static_cast<double>(judged), bound) << seed;
    EXPECT_NEAR(report.least_angle_deg,
                std::atan(std::sqrt(CGAL::to_double(*least_tangent_square))) * kDegreesPerRadian,
                bound * kDegreesPerRadian)
        << seed;
    EXPECT_EQ(report.slivers, sharp) << seed;
    std::size_t most = 0, corners = 0;
    for (const auto& [v, count] : valence) {
      most = std::max(most, count);
      corners += count;
    }
    EXPECT_EQ(report.max_valence, most);
    EXPECT_DOUBLE_EQ(report.mean_valence, static_cast<double>(corners) / static_cast<double>(valence.size()));
    EXPECT_DOUBLE_EQ(report.mean_fan_length, static_cast<double>(judged) / static_cast<double>(fans));
    slivers += sharp;
  }
  EXPECT_GT(slivers, 100U);
  EXPECT_GT(faulty, 200U);
}

}  // namespace
}  // namespace plumbline::oracle
