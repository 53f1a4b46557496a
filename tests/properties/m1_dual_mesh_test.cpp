// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// M1.C1, C2 and C6 on the triangulation alone: random cuts of random forests, drawn from RapidCheck
// generators with pinned keys. Everything is decided on whole numbers (twice the plan coordinates, in cells).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "algorithms/haar_quadtree/dual_mesh.h"

namespace plumbline::haar_quadtree {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
struct Point {
  std::int64_t x = 0, y = 0;
};

class Draw {
 public:
  explicit Draw(std::uint64_t index) : random_(rc::Random::Key{1, index, 0, 0}) {}
  int whole(int low, int high) { return rc::gen::inRange(low, high + 1)(random_.split()).value(); }
  bool chance(int percent) { return whole(0, 99) < percent; }

 private:
  rc::Random random_;
};

Terrain flat(int columns, int rows) {
  Terrain terrain{"flat", columns, rows, 1, {}};
  terrain.heights_m.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0);
  return terrain;
}

/// A forest with a cut of it; the cut's vertices are numbered along the walk.
struct Case {
  explicit Case(std::uint64_t index) : draw(index) {
    const int level = draw.whole(1, 6);
    const int across = draw.whole(1, 3), along = draw.whole(1, 3);
    terrain = flat((across << level) + 1, (along << level) + 1);
    forest.emplace_back(terrain, level);
    cut.start(forest[0].patches());
    // A third of the cases: a single leaf, deep down beside roots. Otherwise anything, denser or sparser.
    unbalanced = index % 3 == 0;
    const int percent = draw.whole(5, 95);
    const auto only = static_cast<std::size_t>(draw.whole(0, static_cast<int>(forest[0].patches()) - 1));
    for (std::size_t p = 0; p < forest[0].patches(); ++p) {
      if (!unbalanced) {
        scatter(forest[0].patch(p), static_cast<Cut::Slot>(p), percent);
      } else if (p == only) {
        drill(forest[0].patch(p), static_cast<Cut::Slot>(p));
      }
    }
    for_each_root(forest[0], cut, [&](const Node& node, Cut::Slot slot) {
      cut.set_vertex(slot, static_cast<std::uint32_t>(vertices.size()));
      const Vec3 p = forest[0].position(node);
      vertices.push_back({static_cast<std::int64_t>(2 * p.x), static_cast<std::int64_t>(2 * p.y)});
    });
    triangulate(forest[0], cut, triangles);
  }
  void scatter(const Node& node, Cut::Slot slot, int percent) {
    if (node.level == forest[0].leaf_level() || !draw.chance(percent)) return;
    const Cut::Slot below = cut.split(slot);
    for (int k = 0; k < 4; ++k) scatter(child(node, k), below + static_cast<Cut::Slot>(k), percent);
  }
  void drill(const Node& node, Cut::Slot slot) {
    if (node.level == forest[0].leaf_level()) return;
    const int k = draw.whole(0, 3);
    drill(child(node, k), cut.split(slot) + static_cast<Cut::Slot>(k));
  }
  /// The vertex of the root over each sample, row-major.
  [[nodiscard]] std::vector<std::uint32_t> owners() const {
    const Forest& f = forest[0];
    const int leaf = f.leaf_level(), columns = f.columns(leaf);
    std::vector<std::uint32_t> out(static_cast<std::size_t>(columns) *
                                   static_cast<std::size_t>(f.rows(leaf)));
    for_each_root(f, cut, [&](const Node& node, Cut::Slot slot) {
      const int size = 1 << (leaf - node.level);
      for (int j = node.b * size; j < (node.b + 1) * size; ++j) {
        for (int i = node.a * size; i < (node.a + 1) * size; ++i) {
          out[static_cast<std::size_t>(j * columns + i)] = cut.vertex(slot);
        }
      }
    });
    return out;
  }

  Draw draw;
  Terrain terrain;
  std::vector<Forest> forest;  ///< one; made after the terrain
  Cut cut;
  bool unbalanced = false;
  std::vector<Point> vertices;
  Triangles triangles;
};

Triangles canonical(Triangles triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::int64_t twice_area(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

constexpr std::uint64_t kCases = 6000;

TEST(M1DualMesh, M1_C6_TheDualWalkIsTheCollapsedFullTriangulation) {
  std::size_t triangles = 0;
  int ratio = 0;
  for (std::uint64_t k = 0; k < kCases; ++k) {
    const Case c(k);
    Triangles naive;
    collapse_full_triangulation(c.forest[0], c.cut, naive);
    ASSERT_EQ(canonical(c.triangles), canonical(naive)) << "case " << k;
    triangles += naive.size();
    if (c.unbalanced) ratio = std::max(ratio, 1 << c.forest[0].leaf_level());
  }
  fmt::print("{} cuts, {} triangles, cells beside each other up to {} : 1\n", kCases, triangles, ratio);
  EXPECT_EQ(ratio, 64);
  EXPECT_GT(triangles, 100000u);
}

/// No fold-over, no sliver, and the area inside the ring of the outermost roots is covered once.
TEST(M1DualMesh, M1_C1_C6_EveryTriangleIsPositiveAndTheAreaIsExact) {
  for (std::uint64_t k = 0; k < kCases; ++k) {
    const Case c(k);
    std::int64_t covered = 0;
    for (const auto& [a, b, d] : c.triangles) {
      const std::int64_t area = twice_area(c.vertices[a], c.vertices[b], c.vertices[d]);
      ASSERT_GT(area, 0) << "case " << k;
      covered += area;
    }
    const std::vector<std::uint32_t> owner = c.owners();
    const int columns = c.terrain.columns - 1, rows = c.terrain.rows - 1;
    std::vector<Point> ring;
    const auto step = [&](int i, int j) {
      ring.push_back(c.vertices[owner[static_cast<std::size_t>(j * columns + i)]]);
    };
    for (int i = 0; i < columns; ++i) step(i, 0);
    for (int j = 0; j < rows; ++j) step(columns - 1, j);
    for (int i = columns - 1; i >= 0; --i) step(i, rows - 1);
    for (int j = rows - 1; j >= 0; --j) step(0, j);
    std::int64_t inside = 0;
    for (std::size_t v = 0; v < ring.size(); ++v) {
      inside += twice_area({0, 0}, ring[v], ring[(v + 1) % ring.size()]);
    }
    ASSERT_EQ(covered, inside) << "case " << k;
  }
}

/// Each inner edge has one twin: with positive triangles and the right area, nothing is left to crack.
TEST(M1DualMesh, M1_C1_EveryInnerEdgeHasItsTwin) {
  for (std::uint64_t k = 0; k < kCases; ++k) {
    const Case c(k);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& t : c.triangles) {
      for (std::size_t e = 0; e < 3; ++e) edges.emplace_back(t[e], t[(e + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    ASSERT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end()) << "case " << k;
    // Edges without a twin join roots on the border of the forest.
    const std::vector<std::uint32_t> owner = c.owners();
    const int columns = c.terrain.columns - 1, rows = c.terrain.rows - 1;
    std::set<std::uint32_t> border;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        if (i == 0 || j == 0 || i == columns - 1 || j == rows - 1) {
          border.insert(owner[static_cast<std::size_t>(j * columns + i)]);
        }
      }
    }
    for (const auto& [a, b] : edges) {
      if (std::binary_search(edges.begin(), edges.end(), std::pair{b, a})) continue;
      ASSERT_TRUE(border.contains(a) && border.contains(b)) << "case " << k;
    }
  }
}

TEST(M1DualMesh, M1_C2_OneOrTwoTrianglesACornerAndNoVertexBesidesTheRoots) {
  for (std::uint64_t k = 0; k < kCases; ++k) {
    const Case c(k);
    const std::vector<std::uint32_t> owner = c.owners();
    const int columns = c.terrain.columns - 1, rows = c.terrain.rows - 1;
    std::size_t expected = 0;
    for (int j = 0; j + 1 < rows; ++j) {
      for (int i = 0; i + 1 < columns; ++i) {
        const auto at = static_cast<std::size_t>(j * columns + i);
        const auto above = at + static_cast<std::size_t>(columns);
        const std::set<std::uint32_t> meet{owner[at], owner[at + 1], owner[above], owner[above + 1]};
        expected += meet.size() < 3 ? 0 : meet.size() - 2;
      }
    }
    ASSERT_EQ(c.triangles.size(), expected) << "case " << k;
    ASSERT_EQ(c.vertices.size(), c.cut.roots(c.forest[0].patches()));
  }
}

/// Geomorphing moves four sibling roots towards their parent, each four by an α of their own.
TEST(M1DualMesh, M1_C6_MorphingFoldsNothingOver) {
  std::size_t triangles = 0;
  for (std::uint64_t k = 0; k < kCases; ++k) {
    Case c(k);
    const Forest& forest = c.forest[0];
    // α in sixteenths, above 0: coordinates times 32 are whole.
    std::vector<Point> moved(c.vertices.size());
    const auto go = [&](const auto& self, const Node& node, Cut::Slot slot) -> void {
      if (c.cut.is_root(slot)) {
        const Point p = c.vertices[c.cut.vertex(slot)];
        moved[c.cut.vertex(slot)] = {16 * p.x, 16 * p.y};
        return;
      }
      const Cut::Slot below = c.cut.children(slot);
      for (int i = 0; i < 4; ++i) self(self, child(node, i), below + static_cast<Cut::Slot>(i));
      if (!c.cut.children_are_roots(slot)) return;
      const int alpha = c.draw.whole(1, 16);
      const Vec3 p = forest.position(node);
      for (Cut::Slot i = 0; i < 4; ++i) {
        const std::uint32_t v = c.cut.vertex(below + i);
        moved[v] = {alpha * c.vertices[v].x + (16 - alpha) * static_cast<std::int64_t>(2 * p.x),
                    alpha * c.vertices[v].y + (16 - alpha) * static_cast<std::int64_t>(2 * p.y)};
      }
    };
    for (std::size_t p = 0; p < forest.patches(); ++p) {
      go(go, forest.patch(p), static_cast<Cut::Slot>(p));
    }
    for (const auto& [a, b, d] : c.triangles) {
      ASSERT_GT(twice_area(moved[a], moved[b], moved[d]), 0) << "case " << k;
    }
    triangles += c.triangles.size();
  }
  fmt::print("morphed: {} triangles in {} cuts, none folded over\n", triangles, kCases);
}

}  // namespace
}  // namespace plumbline::haar_quadtree
