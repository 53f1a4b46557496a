// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// M2's collapses against a slow model that replays the list of collapses in force on the full TIN and asks
// the mesh that comes out of it.
#include "algorithms/ring_tin/collapse_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "lattice.h"
#include "scenarios/random.h"

namespace plumbline::ring_tin {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Refusal = CollapseMap::Refusal;

struct Model {
  const tin::Tin& tin;
  std::vector<std::array<std::uint32_t, 2>> in_force;  ///< from, to; in order
  std::vector<std::uint32_t> rep;
  std::vector<int> depth;

  explicit Model(const tin::Tin& full) : tin(full) { replay(); }
  void replay() {
    rep.resize(tin.mesh.positions.size());
    for (std::size_t v = 0; v < rep.size(); ++v) rep[v] = static_cast<std::uint32_t>(v);
    depth.assign(rep.size(), 1);
    for (const auto& [from, to] : in_force) {
      for (std::uint32_t& r : rep) r = r == from ? to : r;
      depth[to] = 1 + std::max(depth[from], depth[to]);
    }
  }
  void reset(std::uint32_t v) {
    const std::uint32_t root = rep[v];
    std::erase_if(in_force, [&](const auto& c) { return rep[c[1]] == root; });
    replay();
  }
  /// With the index of the full triangle.
  [[nodiscard]] std::map<std::uint32_t, Triangle> mesh() const {
    std::map<std::uint32_t, Triangle> out;
    for (std::size_t t = 0; t < tin.mesh.triangles.size(); ++t) {
      const auto& full = tin.mesh.triangles[t];
      const Triangle image{rep[full[0]], rep[full[1]], rep[full[2]]};
      if (image[0] == image[1] || image[1] == image[2] || image[2] == image[0]) continue;
      out[static_cast<std::uint32_t>(t)] = image;
    }
    return out;
  }
  /// §2.1, to the letter: grid coordinates are small multiples of the spacing, so plain doubles are exact.
  [[nodiscard]] double error_m(std::uint32_t from, std::uint32_t to) const {
    const auto area = [&](Vec3 a, Vec3 b, Vec3 c) {
      return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    };
    for (const auto& [index, t] : mesh()) {
      const auto here = std::find(t.begin(), t.end(), from);
      if (here == t.end() || std::find(t.begin(), t.end(), to) != t.end()) continue;
      Triangle moved = t;
      std::replace(moved.begin(), moved.end(), from, to);
      const Vec3 a = tin.mesh.positions[moved[0]], b = tin.mesh.positions[moved[1]],
                 c = tin.mesh.positions[moved[2]], p = tin.mesh.positions[from];
      const double whole = area(a, b, c), u = area(b, c, p), v = area(c, a, p), w = area(a, b, p);
      if (whole == 0 || u * whole < 0 || v * whole < 0 || w * whole < 0) continue;
      return std::abs((u * a.z + v * b.z + w * c.z) / whole - p.z);
    }
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] int orientation(const Triangle& t) const {
    return tin::plan_orientation(tin.mesh.positions[t[0]], tin.mesh.positions[t[1]],
                                 tin.mesh.positions[t[2]]);
  }
};

/// Rounding of a plane's height over heights of some tens of metres.
constexpr double kPlaneRoundingM = 1e-11;

void expect_equal(const Model& model, const tin::Adjacency& adjacency, CollapseMap& map) {
  const auto mesh = model.mesh();
  std::map<std::uint32_t, Triangle> seen;
  std::vector<CollapseMap::Corner> star;
  for (std::uint32_t v = 0; v < model.rep.size(); ++v) {
    ASSERT_EQ(map.rep(v), model.rep[v]);
    if (!map.is_live(v)) continue;
    ASSERT_EQ(map.depth(v), model.depth[v]);
    map.star(v, star);
    for (const CollapseMap::Corner& corner : star) {
      Triangle t{v, corner.next, corner.after};
      const auto known = mesh.find(corner.triangle);
      ASSERT_NE(known, mesh.end());
      while (t != known->second && t[0] != known->second[0]) std::rotate(t.begin(), t.begin() + 1, t.end());
      ASSERT_EQ(t, known->second);
      seen[corner.triangle] = t;
    }
  }
  ASSERT_EQ(seen, mesh);

  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> least;
  const auto& edges = adjacency.edges();
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto image = std::minmax(model.rep[edges[e][0]], model.rep[edges[e][1]]);
    if (image.first != image.second) least.try_emplace(image, e);
  }
  std::set<std::uint32_t> active;
  for (const auto& [image, e] : least) active.insert(e);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    ASSERT_EQ(map.is_active(e), active.contains(e)) << "edge " << e;
    if (!map.is_active(e)) continue;
    const double error_m = map.price(e);
    const std::uint32_t u = model.rep[edges[e][0]], v = model.rep[edges[e][1]];
    const double forth = model.error_m(u, v), back = model.error_m(v, u);
    if (std::isinf(error_m)) {
      ASSERT_TRUE(std::isinf(forth) && std::isinf(back));
      continue;
    }
    ASSERT_NEAR(error_m, std::min(forth, back), kPlaneRoundingM);
    ASSERT_NEAR(model.error_m(map.start(e), map.end(e)), error_m, kPlaneRoundingM) << "turned the wrong way";
    if (forth == back) {
      ASSERT_EQ(map.start(e), u) << "of equals, from the end of lower index";
    }
  }
}

class RandomCollapses : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(CollapseMap, RandomCollapses, ::testing::Bool(),
                         [](const auto& run) { return run.param ? "guarded" : "unguarded"; });

TEST_P(RandomCollapses, AreThoseOfTheSlowModel) {
  const bool guard = GetParam();
  int collapses = 0, resets = 0, folded = 0;
  std::map<Refusal, int> refusals;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const Terrain terrain = lattice::rough(8, 7, seed, 12);
    const tin::Tin tin = tin::grid_tin(terrain);
    const tin::Adjacency adjacency(tin);
    const int cap = 2 + static_cast<int>(random.below(5));
    CollapseMap map(tin, adjacency, price_all(tin, adjacency), cap);
    Model model(tin);
    for (int step = 0; step < 60; ++step) {
      if (random.below(8) == 0 && !model.in_force.empty()) {
        const std::uint32_t v = model.in_force[random.below(model.in_force.size())][0];
        std::vector<std::uint32_t> restored;
        map.reset_tree(v, restored);
        for (const std::uint32_t r : restored) ASSERT_EQ(model.rep[r], model.rep[v]);
        model.reset(v);
        ++resets;
        if (guard) {
          const std::size_t before = restored.size();
          map.mend_folds(restored);
          for (std::size_t k = before; k < restored.size(); ++k) model.reset(restored[k]);
        }
      } else {
        const auto e = static_cast<std::uint32_t>(random.below(adjacency.edges().size()));
        if (!map.is_active(e) || std::isinf(map.price(e))) continue;
        const Refusal refusal = map.refusal(e, guard);
        ++refusals[refusal];
        if (refusal != Refusal::none) continue;
        ASSERT_LE(1 + std::max(map.depth(map.start(e)), map.depth(map.end(e))), cap);
        model.in_force.push_back({map.start(e), map.end(e)});
        map.collapse(e);
        model.replay();
        ++collapses;
      }
      if (step % 6 == 0) expect_equal(model, adjacency, map);
      if (HasFatalFailure()) return;
      for (const auto& [index, t] : model.mesh()) folded += model.orientation(t) <= 0 ? 1 : 0;
    }
    expect_equal(model, adjacency, map);
    for (std::uint32_t v = 0; v < tin.mesh.positions.size(); ++v) {
      if (adjacency.is_border_vertex(v)) {
        ASSERT_TRUE(map.is_live(v)) << "the border is kept";
      }
    }
  }
  EXPECT_GT(collapses, 300);
  EXPECT_GT(resets, 50);
  EXPECT_GT(refusals[Refusal::border], 0);
  EXPECT_GT(refusals[Refusal::depth], 0);
  if (guard) {
    EXPECT_EQ(folded, 0);
    EXPECT_GT(refusals[Refusal::fold], 0);
  } else {
    EXPECT_GT(folded, 0) << "random collapses and resets do fold";
  }
}

TEST(CollapseMap, KeepsThePlaceOfRoads) {
  const Terrain terrain = lattice::rough(12, 12, 2, 12);
  const double s = terrain.spacing_m;
  // Two roads that meet at (6, 6) s.
  const std::vector<std::vector<Vec3>> roads{{{2.25 * s, 3 * s, 0},
                                              {4 * s, 4.5 * s, 0},
                                              {6 * s, 6 * s, 0},
                                              {8 * s, 6.5 * s, 0},
                                              {9.5 * s, 9 * s, 0}},
                                             {{6 * s, 6 * s, 0}, {5 * s, 7.5 * s, 0}, {3 * s, 9 * s, 0}}};
  std::vector<Vec3> points = reference_mesh(terrain).positions;
  const tin::Tin tin = tin::delaunay_tin(points, roads);
  const tin::Adjacency adjacency(tin);
  std::map<std::uint32_t, std::set<std::uint32_t>> along;  // road neighbours
  for (const tin::Edge& e : tin.roads) {
    along[e[0]].insert(e[1]);
    along[e[1]].insert(e[0]);
  }
  int road_collapses = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    CollapseMap map(tin, adjacency, price_all(tin, adjacency), 6);
    auto now = along;
    for (int step = 0; step < 4000; ++step) {
      const auto e = static_cast<std::uint32_t>(random.below(adjacency.edges().size()));
      if (!map.is_active(e) || std::isinf(map.price(e))) continue;
      const std::uint32_t from = map.start(e), to = map.end(e);
      const Refusal refusal = map.refusal(e, true);
      refused += refusal == Refusal::road ? 1 : 0;
      if (refusal != Refusal::none) continue;
      if (now.contains(from)) {
        ASSERT_EQ(now[from].size(), 2U) << "ends and junctions stay";
        ASSERT_TRUE(now[from].contains(to)) << "along the road";
        for (const std::uint32_t n : now[from]) {
          now[n].erase(from);
          if (n != to) {
            now[n].insert(to);
            now[to].insert(n);
          }
        }
        now.erase(from);
        ++road_collapses;
      }
      map.collapse(e);
    }
    for (const auto& [v, neighbours] : now) ASSERT_TRUE(map.is_live(v));
  }
  EXPECT_GT(road_collapses, 20);
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace plumbline::ring_tin
