// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// M3: errors, division, no-data padding, and the removal of cracks inside tiles and between them, seen on the
// integer grid (lattice.h), without the oracle.

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "algorithms/isolated_quadtree/tile_grid.h"
#include "algorithms/registry.h"
#include "lattice.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using isolated_quadtree::Node;
using isolated_quadtree::TileGrid;

struct Flyer {
  Flyer(const Terrain& over, double tile_size, const std::string& id = "isolated_quadtree")
      : terrain(over), method(make_method(id, {{"tile_size", tile_size}})) {
    method->prepare(terrain);
  }
  LodFrame look(const Camera& camera, double threshold_px) {
    method->set_threshold_px(threshold_px);
    LodFrame frame;
    method->update(camera, frame);
    return frame;
  }
  const Terrain& terrain;
  std::unique_ptr<LodMethod> method;
};

/// The whole terrain in view, from above and aside.
Camera whole_view(const Terrain& terrain, double fov_y_deg = 60) {
  const double w = terrain.width_m();
  return make_camera({-1.5 * w, -1.4 * w, terrain.highest_m() + 1.6 * w}, {w / 2, terrain.depth_m() / 2, 0},
                     fov_y_deg, 640, 480);
}

/// Checks every node of a tile, from the given one down.
int check_monotone(const TileGrid& grid, Node node) {
  if (node.side == 2) {
    EXPECT_EQ(grid.error_m(node), 0);
    return 0;
  }
  const int h = node.half();
  int checked = 0;
  for (const Node& child : {Node{node.i, node.j, h}, Node{node.i + h, node.j, h}, Node{node.i, node.j + h, h},
                            Node{node.i + h, node.j + h, h}}) {
    EXPECT_GE(grid.error_m(node), grid.error_m(child));
    checked += 1 + check_monotone(grid, child);
  }
  return checked;
}

TEST(IsolatedQuadtree, M3_C2_NoParentsErrorIsBelowAChilds) {
  int checked = 0;
  for (const auto& [columns, rows, side] :
       {std::array{65, 65, 64}, std::array{65, 65, 16}, std::array{40, 31, 16}, std::array{7, 50, 8}}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Terrain terrain = lattice::rough(columns, rows, seed, 40);
      const TileGrid grid(terrain, side);
      for (int b = 0; b < grid.tiles_y(); ++b) {
        for (int a = 0; a < grid.tiles_x(); ++a) checked += check_monotone(grid, grid.tile(a, b));
      }
    }
  }
  EXPECT_GT(checked, 50000);
}

TEST(IsolatedQuadtree, ErrorIsTheLargestDeviationOfTheNextSamplesFromTheFan) {
  Terrain terrain = lattice::flat(5, 5);
  EXPECT_EQ(TileGrid(terrain, 4).error_m({0, 0, 4}), 0);
  terrain.heights_m[terrain.index(1, 0)] = 3;  // midpoint of a rim edge from (0, 0) to (2, 0)
  EXPECT_EQ(TileGrid(terrain, 4).error_m({0, 0, 4}), 3);
  terrain.heights_m[terrain.index(1, 1)] = -7;  // midpoint of the spoke from (0, 0) to (2, 2)
  EXPECT_EQ(TileGrid(terrain, 4).error_m({0, 0, 4}), 7);
  // A sample that the fan draws is no error of its own: the midpoints beside it are.
  Terrain centre = lattice::flat(5, 5);
  centre.heights_m[centre.index(2, 2)] = 8;
  EXPECT_EQ(TileGrid(centre, 4).error_m({0, 0, 4}), 4);
}

TEST(IsolatedQuadtree, NoDataEntersNoError) {
  Terrain terrain = lattice::flat(4, 4);
  for (double& z : terrain.heights_m) z = 100;
  const TileGrid grid(terrain, 4);
  EXPECT_EQ(grid.error_m(grid.tile(0, 0)), 0);
}

TEST(IsolatedQuadtree, ShortTilesStandAtTheRightAndTheBottom) {
  const Terrain terrain = lattice::flat(10, 8);
  const TileGrid grid(terrain, 4);
  EXPECT_EQ(grid.tiles_x(), 3);
  EXPECT_EQ(grid.tiles_y(), 2);
  EXPECT_TRUE(grid.whole(grid.tile(0, 1)));   // upper left
  EXPECT_FALSE(grid.whole(grid.tile(2, 1)));  // upper right: one column of cells
  EXPECT_FALSE(grid.whole(grid.tile(0, 0)));  // lower left: three rows of cells
  EXPECT_EQ(grid.tile(0, 1).j + 4, terrain.rows - 1);
  EXPECT_EQ(grid.tile(0, 0).j, -1);
  EXPECT_FALSE(grid.has_data(0, -1));
  EXPECT_FALSE(grid.has_data(10, 0));
}

TEST(IsolatedQuadtree, M3_C1_OneTileHasNoCrackOverAnyLevelDifference) {
  Random random(3);
  int several_levels = 0;
  for (int round = 0; round < 300; ++round) {
    const Terrain terrain = lattice::rough(33, 33, static_cast<std::uint64_t>(round), 30);
    Flyer flyer(terrain, 33);
    const Camera camera = lattice::any_camera(random, terrain);
    const LodFrame frame = flyer.look(camera, std::exp2(random.between(-2, 5)));
    if (frame.mesh.triangles.empty()) continue;
    const lattice::Faults faults = lattice::look_at(terrain, frame);
    EXPECT_EQ(faults.t_junctions, 0);
    EXPECT_EQ(faults.turned, 0);
    EXPECT_EQ(faults.doubled, 0);
    EXPECT_EQ(faults.inner_border, 0);
    EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
    if (frame.counters.drawn > 4) ++several_levels;
  }
  EXPECT_GT(several_levels, 100);
}

TEST(IsolatedQuadtree, OneSpikeMakesNeighboursThatDifferByEveryLevel) {
  Terrain terrain = lattice::flat(65, 65);
  terrain.heights_m[terrain.index(31, 31)] = 20;  // beside the middle: its quarter alone is divided
  Flyer flyer(terrain, 65);
  const LodFrame frame = flyer.look(whole_view(terrain), 0.01);
  const lattice::Faults faults = lattice::look_at(terrain, frame);
  EXPECT_EQ(faults.t_junctions, 0);
  EXPECT_EQ(faults.inner_border, 0);
  EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
  // A smallest node (side 2) stands beside one of side 32: both have the middle as a corner.
  std::map<double, int> by_area;
  for (const auto& t : frame.mesh.triangles) {
    const Vec3 u = frame.mesh.positions[t[1]] - frame.mesh.positions[t[0]];
    const Vec3 v = frame.mesh.positions[t[2]] - frame.mesh.positions[t[0]];
    ++by_area[(u.x * v.y - u.y * v.x) / 2];
  }
  EXPECT_EQ(by_area.begin()->first, 0.5);
  EXPECT_EQ(by_area.rbegin()->first, 128);
}

/// Samples on a line between tiles.
bool on_tile_border(const Terrain& terrain, std::uint64_t key, int side) {
  const auto columns = static_cast<std::uint64_t>(terrain.columns);
  const auto step = static_cast<std::uint64_t>(side);
  return key % columns % step == 0 || key / columns % step == 0;
}

TEST(IsolatedQuadtree, BetweenTilesHeightsAreAveragedInTheFrameOnly) {
  Random random(5);
  int moved = 0;
  for (int round = 0; round < 100; ++round) {
    const Terrain terrain = lattice::rough(33, 33, static_cast<std::uint64_t>(round), 30);
    const std::vector<double> stored = terrain.heights_m;
    Flyer flyer(terrain, 9);
    for (int step = 0; step < 3; ++step) {
      const Camera camera = lattice::any_camera(random, terrain);
      const double threshold_px = std::exp2(random.between(-1, 4));
      const LodFrame frame = flyer.look(camera, threshold_px);
      EXPECT_EQ(terrain.heights_m, stored);
      Flyer fresh(terrain, 9);
      EXPECT_TRUE(lattice::same_mesh(frame, fresh.look(camera, threshold_px)));
      for (std::size_t v = 0; v < frame.vertex_keys.size(); ++v) {
        const std::uint64_t key = frame.vertex_keys[v];
        if (frame.mesh.positions[v].z == terrain.heights_m[key]) continue;
        ++moved;
        EXPECT_TRUE(on_tile_border(terrain, key, 8));
      }
    }
  }
  EXPECT_GT(moved, 100);
}

TEST(IsolatedQuadtree, BetweenTilesEveryMovedVertexLiesOnTheNeighboursEdge) {
  // Rounding of one interpolation of heights below 64 m: a few units in the last place of 64.
  constexpr double kRoundingM = 0x1p-44;
  Random random(6);
  int on_edges = 0;
  for (int round = 0; round < 100; ++round) {
    const Terrain terrain = lattice::rough(33, 33, static_cast<std::uint64_t>(round), 30);
    Flyer flyer(terrain, 9);
    const LodFrame frame = flyer.look(lattice::any_camera(random, terrain), std::exp2(random.between(-1, 4)));
    std::map<std::pair<int, int>, double> height;
    for (std::size_t v = 0; v < frame.vertex_keys.size(); ++v) {
      const auto columns = static_cast<std::uint64_t>(terrain.columns);
      const std::uint64_t key = frame.vertex_keys[v];
      const bool fresh = height
                             .try_emplace({static_cast<int>(key % columns), static_cast<int>(key / columns)},
                                          frame.mesh.positions[v].z)
                             .second;
      EXPECT_TRUE(fresh) << "a sample has one vertex, also where four tiles meet";
    }
    for (const auto& t : frame.mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = frame.mesh.positions[t[k]];
        const Vec3& q = frame.mesh.positions[t[(k + 1) % 3]];
        const int i0 = static_cast<int>(p.x), j0 = static_cast<int>(p.y);
        const int di = static_cast<int>(q.x) - i0, dj = static_cast<int>(q.y) - j0;
        const int steps = std::gcd(di, dj);
        for (int s = 1; s < steps; ++s) {
          const auto between = height.find({i0 + di / steps * s, j0 + dj / steps * s});
          if (between == height.end()) continue;
          ++on_edges;  // a T-vertex, which the averaging brought down to the edge (M3.S4)
          EXPECT_NEAR(between->second, p.z + (q.z - p.z) * s / steps, kRoundingM);
        }
      }
    }
  }
  EXPECT_GT(on_edges, 100);
}

TEST(IsolatedQuadtree, RepairedHasNoTVertexBetweenTilesAndMovesNothing) {
  Random random(8);
  int several_tiles = 0;
  for (int round = 0; round < 100; ++round) {
    const Terrain terrain = lattice::rough(33, 33, static_cast<std::uint64_t>(round), 30);
    Flyer flyer(terrain, 9, "isolated_quadtree:repaired");
    const LodFrame frame = flyer.look(whole_view(terrain), std::exp2(random.between(-1, 4)));
    const lattice::Faults faults = lattice::look_at(terrain, frame);
    EXPECT_EQ(faults.t_junctions, 0);
    EXPECT_EQ(faults.turned, 0);
    EXPECT_EQ(faults.inner_border, 0);
    EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
    for (std::size_t v = 0; v < frame.vertex_keys.size(); ++v) {
      EXPECT_EQ(frame.mesh.positions[v].z, terrain.heights_m[frame.vertex_keys[v]]);
    }
    several_tiles += frame.counters.drawn > frame.counters.tiles ? 1 : 0;
  }
  EXPECT_GT(several_tiles, 50);
}

TEST(IsolatedQuadtree, RepairedKeepsToShortTilesAndToTheTilesInSight) {
  Random random(9);
  int hidden = 0;
  for (int round = 0; round < 300; ++round) {
    const int columns = static_cast<int>(random.between(2, 31));
    const int rows = static_cast<int>(random.between(2, 31));
    const Terrain terrain = lattice::rough(columns, rows, static_cast<std::uint64_t>(round), 10);
    Flyer flyer(terrain, 9, "isolated_quadtree:repaired");
    const LodFrame frame = flyer.look(lattice::any_camera(random, terrain), std::exp2(random.between(-4, 4)));
    const lattice::Faults faults = lattice::look_at(terrain, frame);
    EXPECT_EQ(faults.t_junctions, 0);
    EXPECT_EQ(faults.turned, 0);
    EXPECT_EQ(faults.doubled, 0);
    EXPECT_NEAR(static_cast<double>(faults.double_area), lattice::double_area(frame.domain, 1),
                lattice::kAreaRoundingCells);
    hidden += faults.double_area < lattice::double_area(terrain) ? 1 : 0;
  }
  EXPECT_GT(hidden, 30);
}

TEST(IsolatedQuadtree, NothingAdaptsToATileOutsideTheFrustum) {
  // The north tile is divided for its bump; the south tile would take split points from it, were it drawn.
  Terrain terrain = lattice::flat(5, 9);
  terrain.heights_m[terrain.index(2, 7)] = 1;
  Flyer flyer(terrain, 5);
  const LodFrame both = flyer.look(make_camera({2, 4, 9}, {2, 4.1, 0}, 90, 200, 200), 1);
  ASSERT_EQ(both.counters.tiles, 2U);
  EXPECT_EQ(both.counters.drawn, 5U);
  EXPECT_EQ(both.mesh.triangles.size(), 5U * 8 + 2);
  const LodFrame south = flyer.look(make_camera({2, 1, 9}, {2, 1.1, 0}, 20, 200, 200), 1);
  ASSERT_EQ(south.counters.tiles, 1U);
  EXPECT_EQ(south.mesh.triangles.size(), 8U);
}

TEST(IsolatedQuadtree, PreparesTheSameOnAnyNumberOfThreads) {
  const Terrain terrain = lattice::rough(150, 131, 3, 40);
  const auto errors = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const TileGrid grid(terrain, 16);
    std::vector<double> out;
    for (int side = 2; side <= 16; side *= 2) {
      for (int j = grid.tile(0, 0).j; j + side < terrain.rows; j += side) {
        for (int i = 0; i + 1 < terrain.columns; i += side) out.push_back(grid.error_m({i, j, side}));
      }
    }
    return out;
  };
  const std::vector<double> alone = errors(1);
  EXPECT_GT(*std::max_element(alone.begin(), alone.end()), 0);
  EXPECT_EQ(alone, errors(2));
  EXPECT_EQ(alone, errors(7));
}

TEST(IsolatedQuadtree, NoDataBeyondTheTerrainIsNeverDrawn) {
  Random random(7);
  for (const auto& [columns, rows] :
       {std::pair{40, 31}, std::pair{10, 9}, std::pair{34, 33}, std::pair{12, 3}, std::pair{2, 2}}) {
    for (int round = 0; round < 20; ++round) {
      const Terrain terrain = lattice::rough(columns, rows, static_cast<std::uint64_t>(round), 10);
      Flyer flyer(terrain, 9);
      const LodFrame frame = flyer.look(whole_view(terrain), std::exp2(random.between(-6, 5)));
      const lattice::Faults faults = lattice::look_at(terrain, frame);
      EXPECT_EQ(faults.turned, 0);
      EXPECT_EQ(faults.doubled, 0);
      EXPECT_EQ(faults.double_area, lattice::double_area(terrain)) << columns << " x " << rows;
    }
  }
}

TEST(IsolatedQuadtree, TilesOutsideTheFrustumAreNeitherDrawnNorPromised) {
  const Terrain terrain = lattice::rough(65, 65, 4, 5);
  Flyer flyer(terrain, 17);
  EXPECT_EQ(flyer.look(whole_view(terrain), 1).counters.tiles, 16U);
  const LodFrame near = flyer.look(make_camera({8, 8, 20}, {8, 9, 0}, 30, 480, 480), 1);
  EXPECT_EQ(near.counters.tiles, 1U);
  EXPECT_EQ(near.domain.loops.size(), 1U);
  const LodFrame away = flyer.look(make_camera({-10, -10, 20}, {-20, -20, 20}, 30, 480, 480), 1);
  EXPECT_EQ(away.counters.tiles, 0U);
  EXPECT_TRUE(away.mesh.triangles.empty());
}

TEST(IsolatedQuadtree, TheCosineSparesWhatLiesAsideAndBehind) {
  const Terrain terrain = lattice::rough(65, 65, 4, 20);
  Flyer with(terrain, 65), without(terrain, 65, "isolated_quadtree:no_cos");
  const Camera inside = make_camera({32, 32, 40}, {60, 60, 30}, 90, 480, 480);
  const LodFrame spared = with.look(inside, 4);
  const LodFrame full = without.look(inside, 4);
  EXPECT_LT(spared.counters.drawn, full.counters.drawn);
  std::set<std::uint64_t> keys(full.vertex_keys.begin(), full.vertex_keys.end());
  for (const std::uint64_t key : spared.vertex_keys) EXPECT_TRUE(keys.contains(key));
}

TEST(IsolatedQuadtree, CountsWhatItDid) {
  const Terrain terrain = lattice::rough(65, 65, 4, 20);
  Flyer flyer(terrain, 33);
  const LodFrame frame = flyer.look(whole_view(terrain), 0.5);
  EXPECT_EQ(frame.counters.nodes, 4U * (1 + 4 + 16 + 64 + 256));
  // Each split makes four nodes of one: drawn = tiles + 3 splits; all are visited.
  EXPECT_EQ(frame.counters.drawn, frame.counters.tiles + 3 * frame.counters.split);
  EXPECT_EQ(frame.counters.visited, frame.counters.tiles + 4 * frame.counters.split);
  EXPECT_GE(frame.mesh.triangles.size(), 8 * frame.counters.drawn);
}

TEST(IsolatedQuadtree, RefusesTilesThatAreNoPowerOfTwo) {
  for (const double size : {0.0, 2.0, 4.0, 256.0, 3.5, -257.0, 1e30}) {
    EXPECT_THROW((void)make_method("isolated_quadtree", {{"tile_size", size}}), InputError) << size;
  }
}

}  // namespace
}  // namespace plumbline
