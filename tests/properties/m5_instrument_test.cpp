// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// M5's claims and suspicions about what is seen, on the instrument: figures for docs/claims.md.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "algorithms/vertex_tree/method.h"
#include "algorithms/vertex_tree/stars.h"
#include "m5_support.h"
#include "scenarios/instrument.h"

namespace plumbline::vertex_tree {
namespace {

constexpr int kSide = 600;  // pixels

Camera look(double distance_m, double angle) {
  return make_camera({distance_m * exact_cos(angle), distance_m * exact_sin(angle), 0.3 * distance_m},
                     {0, 0, 0.2}, 40, kSide, kSide);
}

std::vector<std::uint8_t> silhouette(const Mesh& mesh, const Camera& camera) {
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(kSide) * kSide, 0);
  for (const auto& t : mesh.triangles) {
    const Vec2 a = camera.project(mesh.positions[t[0]]), b = camera.project(mesh.positions[t[1]]),
               c = camera.project(mesh.positions[t[2]]);
    const int x0 = std::max(0, static_cast<int>(std::min({a.x, b.x, c.x}))),
              x1 = std::min(kSide - 1, static_cast<int>(std::max({a.x, b.x, c.x}))),
              y0 = std::max(0, static_cast<int>(std::min({a.y, b.y, c.y}))),
              y1 = std::min(kSide - 1, static_cast<int>(std::max({a.y, b.y, c.y})));
    const auto side = [](Vec2 p, Vec2 q, Vec2 r) {
      return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    };
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec2 p{x + 0.5, y + 0.5};
        const double d0 = side(a, b, p), d1 = side(b, c, p), d2 = side(c, a, p);
        if ((d0 >= 0 && d1 >= 0 && d2 >= 0) || (d0 <= 0 && d1 <= 0 && d2 <= 0))
          mask[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] = 1;
      }
    }
  }
  return mask;
}

std::size_t differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] != b[k] ? 1 : 0;
  return count;
}

Mesh mesh_of(const Cut& cut) {
  Mesh mesh;
  std::vector<std::uint64_t> keys;
  cut.extract(mesh, keys);
  return mesh;
}

const std::shared_ptr<const VertexTree>& instrument_tree() {
  static const auto tree = std::make_shared<const VertexTree>(build_tree(instrument_mesh(), {}));
  return tree;
}

double turn_deg(const VertexTree& tree, const Cut& cut, std::uint32_t t) {
  const auto normal = [&](const std::array<std::uint32_t, 3>& c) {
    return cross(tree.positions[c[1]] - tree.positions[c[0]], tree.positions[c[2]] - tree.positions[c[0]]);
  };
  const Vec3 was = normal(tree.triangles[t]), is = normal(cut.corners(t));
  return exact_atan2(length(cross(was, is)), dot(was, is)) / kRadiansPerDegree;
}

TEST(M5Instrument, HasThePapersTriangleCountAndClosedParts) {
  const Mesh mesh = instrument_mesh();
  EXPECT_EQ(mesh.triangles.size(), kInstrumentTriangles);
  EXPECT_NO_THROW(require_manifold(mesh));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  double volume6 = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
    volume6 += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]]));
    EXPECT_GT(quality(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]), 0);
  }
  for (const auto& [edge, count] : sides) ASSERT_EQ(count, 2) << edge.first << "-" << edge.second;
  EXPECT_GT(volume6, 0) << "outward oriented";
}

TEST(M5Instrument, M5_C3_TheTreeReaches5381Triangles) {
  BuildSettings settings;
  settings.least_triangles = 5381;
  const auto tree = std::make_shared<const VertexTree>(build_tree(instrument_mesh(), settings));
  Cut cut(tree);
  cut.coarsen(0);
  EXPECT_EQ(cut.triangle_count(), 5380u);  // every part is closed: triangles go in pairs
  EXPECT_NO_THROW(require_manifold(mesh_of(cut)));
  const Camera camera = look(5, -1.2);
  const auto full = silhouette(mesh_of(Cut(tree)), camera), coarse = silhouette(mesh_of(cut), camera);
  std::size_t covered = 0;
  for (const auto pixel : full) covered += pixel;
  std::printf("5380 triangles: %zu of %zu silhouette pixels differ\n", differing(full, coarse), covered);
  EXPECT_GT(covered, 10'000u);
  EXPECT_LT(differing(full, coarse), covered / 20);
}

TEST(M5Instrument, M5_S1_NormalsTurnByMoreThanTheLimitOverManyCollapses) {
  const auto& tree = instrument_tree();
  Cut cut(tree);
  double greatest = 0;
  std::size_t over_limit = 0, flipped = 0;
  for (const std::size_t triangles : {17360u, 8680u, 5380u}) {
    cut.coarsen(triangles);
    greatest = 0;
    over_limit = flipped = 0;
    for (std::uint32_t t = 0; t < tree->triangles.size(); ++t) {
      if (!cut.live(t)) continue;
      const double turn = turn_deg(*tree, cut, t);
      greatest = std::max(greatest, turn);
      over_limit += turn > 45 ? 1 : 0;
      flipped += turn > 90 ? 1 : 0;
    }
    std::printf("%zu triangles: greatest turn %.1f degrees, %zu over 45, %zu over 90\n", cut.triangle_count(),
                greatest, over_limit, flipped);
  }
  EXPECT_GT(greatest, 45);
  EXPECT_GT(over_limit, 0u);
}

struct Ladder {
  std::size_t published_px = 0, bare_px = 0;
};

TEST(M5Instrument, M5_C2_TheContourRuleAgainstNoneAtEqualTriangles) {
  const auto& tree = instrument_tree();
  const auto full = mesh_of(Cut(tree));
  Ladder sum;
  for (int k = 0; k < 8; ++k) {
    const Camera camera = look(5, 0.4 + 0.785 * k);
    Cut held(tree), bare(tree);
    held.coarsen(kInstrumentTriangles / 10,
                 [&](std::uint32_t p) { return may_be_contour(*tree, p, camera.position); });
    bare.coarsen(held.triangle_count());
    const auto truth = silhouette(full, camera);
    const std::size_t a = differing(truth, silhouette(mesh_of(held), camera));
    const std::size_t b = differing(truth, silhouette(mesh_of(bare), camera));
    std::printf(
        "view %d: %zu triangles with the rule (10 %% asked: %zu), %zu without; %zu and %zu pixels differ\n",
        k, held.triangle_count(), kInstrumentTriangles / 10, bare.triangle_count(), a, b);
    sum.published_px += a;
    sum.bare_px += b;
    // M5.S3: what is held keeps its neighbours too.
    EXPECT_GT(held.triangle_count(), kInstrumentTriangles / 10);
  }
  EXPECT_LT(sum.published_px, sum.bare_px);
}

TEST(M5Instrument, M5_S2_HoveringOnARungSwitchesAFifthOfTheTriangles) {
  const auto& tree = instrument_tree();
  Object object(tree, ContourRule::none);
  // The distance at which the ball is 250 px wide, then a thousandth nearer and farther in turn.
  double near_m = 2, far_m = 100;
  for (int k = 0; k < 100; ++k) {
    const double middle = (near_m + far_m) / 2;
    (screen_size_px(look(middle, 0), tree->center, tree->radius_m) > 250 ? near_m : far_m) = middle;
  }
  Counters first;
  object.update(look(near_m * 0.999, 0), 1, first);
  auto mask = silhouette(mesh_of(object.cut()), look(near_m, 0));
  for (int frame = 0; frame < 6; ++frame) {
    Counters counters;
    object.update(look(near_m * (frame % 2 == 0 ? 1.001 : 0.999), 0), 1, counters);
    const auto next = silhouette(mesh_of(object.cut()), look(near_m, 0));
    if (frame == 0)
      std::printf("%llu collapses, %zu silhouette pixels change at 250 px\n",
                  static_cast<unsigned long long>(counters.merged), differing(mask, next));
    EXPECT_GE(2 * (counters.merged + counters.split), kInstrumentTriangles / 5 - 2);
    mask = next;
  }
}

TEST(M5Instrument, M5_S5_NodesCollapsedEarlierStayCollapsedOnTheContour) {
  const auto& tree = instrument_tree();
  const auto on_contour = [&](const Cut& cut, Vec3 eye) {
    std::size_t count = 0;
    for (auto p = static_cast<std::uint32_t>(tree->originals); p < tree->nodes(); ++p)
      count += cut.present(p) && may_be_contour(*tree, p, eye) ? 1 : 0;
    return count;
  };
  Object published(tree, ContourRule::hold), restoring(tree, ContourRule::restore);
  const Camera before = look(30, 0.4), after = look(30, 2.0);
  Counters counters;
  published.update(before, 1, counters);
  restoring.update(before, 1, counters);
  EXPECT_EQ(on_contour(published.cut(), before.position), 0u);
  published.update(after, 1, counters);
  restoring.update(after, 1, counters);
  std::printf("after the turn %zu made contour nodes, %zu where they are split again\n",
              on_contour(published.cut(), after.position), on_contour(restoring.cut(), after.position));
  EXPECT_GT(on_contour(published.cut(), after.position), 0u);
  EXPECT_EQ(on_contour(restoring.cut(), after.position), 0u);
}

TEST(M5Instrument, M5_S4_FlatPartsOfLongEdgesAreKeptWhileCurvedOnesGo) {
  // A flat plate of 20 × 20 cells of 1 m, and beside it the instrument's 2 m of fine parts.
  Mesh mesh = instrument_mesh();
  const std::size_t fine = mesh.triangles.size();
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t j = 0; j <= 20; ++j) {
    for (std::uint32_t i = 0; i <= 20; ++i) mesh.positions.push_back({5.0 + i, 1.0 * j, 0});
  }
  for (std::uint32_t j = 0; j < 20; ++j) {
    for (std::uint32_t i = 0; i < 20; ++i) {
      const std::uint32_t a = base + 21 * j + i;
      mesh.triangles.push_back({a, a + 1, a + 22});
      mesh.triangles.push_back({a, a + 22, a + 21});
    }
  }
  const auto tree = std::make_shared<const VertexTree>(build_tree(mesh, {}));
  Cut cut(tree);
  cut.coarsen(mesh.triangles.size() / 10);
  std::size_t flat_left = 0;
  for (auto t = static_cast<std::uint32_t>(fine); t < mesh.triangles.size(); ++t)
    flat_left += cut.live(t) ? 1 : 0;
  EXPECT_EQ(flat_left, 800u) << "not one of the plate's needless triangles is gone at a tenth of all";
}

TEST(M5Instrument, OutOfTheViewConeNothingMovesAndObjectsKeepTheirOwnLadders) {
  VertexTreeMethod method({{}, ContourRule::none});
  Mesh far = instrument_mesh();
  for (Vec3& p : far.positions) p = p + Vec3{0, 60, 0};
  method.prepare_objects({instrument_mesh(), far});
  method.set_threshold_px(1);
  LodFrame frame;
  method.update(make_camera({0, -4, 0}, {0, 0, 0}, 40, kSide, kSide), frame);
  EXPECT_EQ(frame.mesh.triangles.size(), kInstrumentTriangles + kInstrumentTriangles / 10);
  // Far away and looking aside: both stay; then the near one follows, its ladder at the lowest rung.
  method.update(make_camera({0, -400, 0}, {0, -800, 0}, 40, kSide, kSide), frame);
  EXPECT_EQ(frame.counters.merged + frame.counters.split, 0u);
  method.update(make_camera({0, -400, 0}, {0, 0, 0}, 40, kSide, kSide), frame);
  EXPECT_EQ(frame.mesh.triangles.size(), 2 * (kInstrumentTriangles / 10));
  EXPECT_EQ(frame.vertex_keys.size(), frame.mesh.positions.size());
}

TEST(M5Terrain, M5_S1_TrianglesTurnOverInPlanOnSteepGroundOnly) {
  // Steepness: the greatest height over the spacing. Building judges normals in space, one step at a time.
  for (const double steep : {0.3, 3.0}) {
    std::size_t folded = 0, meshes = 0, triangles = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      Random random(seed);
      Terrain terrain{"random", 9, 9, 1.0, {}};
      for (int k = 0; k < 81; ++k) terrain.heights_m.push_back(steep * random.unit());
      VertexTreeMethod method({{}, ContourRule::none});
      method.prepare(terrain);
      method.set_threshold_px(1e9);
      LodFrame frame;
      method.update(make_camera({4, -40, 9}, {4, 4, 0}, 60, kSide, kSide), frame);
      std::size_t here = 0;
      double area2 = 0;
      for (const auto& t : frame.mesh.triangles) {
        const Vec3 a = frame.mesh.positions[t[0]], b = frame.mesh.positions[t[1]],
                   c = frame.mesh.positions[t[2]];
        const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        area2 += twice;
        here += twice <= 0 ? 1 : 0;
      }
      EXPECT_NEAR(area2, 128, 1e-9) << "m2: the border keeps the plan region, sums of a few hundred terms";
      folded += here;
      meshes += here > 0 ? 1 : 0;
      triangles += frame.mesh.triangles.size();
    }
    std::printf("heights up to %g spacings: %zu of %zu triangles turned over in plan, in %zu of 300 meshes\n",
                steep, folded, triangles, meshes);
    EXPECT_GT(triangles, 0u);
    if (steep < 1) {
      EXPECT_EQ(folded, 0u);
    } else {
      EXPECT_GT(folded, 0u);
    }
  }
}

TEST(M5Input, AMeshThatIsNotManifoldIsRefusedByItsFirstBadEdge) {
  const auto message = [](const Mesh& mesh) -> std::string {
    try {
      build_tree(mesh, {});
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const std::vector<Vec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  EXPECT_NE(message({five, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}).find("edge 0-1 "), std::string::npos);
  EXPECT_NE(message({five, {{0, 1, 2}, {0, 1, 3}}}).find("same way along edge 0-1 "), std::string::npos);
  EXPECT_NE(message({five, {{0, 1, 2}, {0, 3, 4}}}).find("vertex 0 "), std::string::npos);
  EXPECT_NE(message({five, {{0, 1, 7}}}).find("names vertex 7"), std::string::npos);
  EXPECT_NE(message({five, {{0, 1, 1}}}).find("names vertex 1 twice"), std::string::npos);
  EXPECT_NE(message({{{0, 0, 0}, {1, 0, NAN}, {0, 1, 0}}, {{0, 1, 2}}}).find("vertex 1"), std::string::npos);
  EXPECT_NE(message({}).find("no triangles"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::vertex_tree
