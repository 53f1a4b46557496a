// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// find_slit: what runs beside a border without meeting it, and what only leaves a corner that both share.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/seams.h"
#include "scenarios/random.h"
#include "tests/oracle/border_support.h"

namespace plumbline::oracle {
namespace {

using test::chain;
using test::Post;

/// A closed counter-clockwise chain through plan points.
Border loop(std::vector<Vec2> points) {
  points.push_back(points.front());
  std::vector<Post> posts;
  for (const Vec2 p : points) posts.push_back({{p.x, p.y, 0}});
  return chain(posts);
}

/// The side from a to b, a included, with the given shares of the way between.
void side(std::vector<Vec2>& out, Vec2 a, Vec2 b, const std::vector<double>& shares) {
  out.push_back(a);
  for (const double s : shares) out.push_back(a + (b - a) * s);
}

/// Of both directions.
bool any_slit(const Border& a, const Border& b, double within) {
  return find_slit(a, b, within).has_value() || find_slit(b, a, within).has_value();
}

/// A rectangle with vertices at whole numbers, and some at `near` of its corners on every side.
Border tile(double x, double y, double width, double height, const std::vector<double>& near = {}) {
  std::vector<Vec2> points;
  const std::array<Vec2, 4> corner{{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const double length = k % 2 == 0 ? width : height;
    std::vector<double> shares;
    for (double s = 1; s < length; ++s) shares.push_back(s / length);
    for (const double s : near) shares.insert(shares.end(), {s / length, 1 - s / length});
    std::sort(shares.begin(), shares.end());
    side(points, corner[k], corner[(k + 1) % 4], shares);
  }
  return loop(points);
}

TEST(Slit, ItsWidthAndItsVerticesAreTold) {
  //   +---+  +---+     four vertices each way along the slit
  //   |   |  |   |
  //   +---+  +---+
  for (const double width : {1e-9, 0.125, 0.2}) {
    const Border first = tile(0, 0, 3, 3), second = tile(3 + width, 0, 3, 3);
    const auto slit = find_slit(first, second, 0.25);
    ASSERT_TRUE(slit) << width;
    EXPECT_DOUBLE_EQ(slit->width, 3 + width - 3);
    EXPECT_EQ(slit->vertices, 4u);
    EXPECT_EQ(slit->at.x, 3);
    EXPECT_EQ(find_slit(second, first, 0.25)->vertices, 4u);
    // The same the other way: they overlap by so much.
    const auto over = find_slit(first, tile(3 - width, 0, 3, 3), 0.25);
    ASSERT_TRUE(over);
    EXPECT_NEAR(over->width, width, 1e-15);
  }
  EXPECT_FALSE(any_slit(tile(0, 0, 3, 3), tile(3.25, 0, 3, 3), 0.25)) << "not nearer than that";
  EXPECT_FALSE(any_slit(tile(0, 0, 3, 3), tile(9, 0, 3, 3), 0.25));
  EXPECT_FALSE(find_slit(Border{}, tile(0, 0, 3, 3), 0.25));
  EXPECT_FALSE(find_slit(tile(0, 0, 3, 3), Border{}, 0.25));
}

TEST(Slit, TheWidestPlaceIsTold) {
  // One vertex moved off the common side, by 1/8 and another by 1/16.
  Border first = chain({{{0, 0, 1}}, {{-0.0625, 1, 2}}, {{0, 2, 3}}, {{-0.125, 3, 4}}, {{0, 4, 5}}});
  const Border second = chain({{{0, 4, 0}}, {{0, 3, 0}}, {{0, 2, 0}}, {{0, 1, 0}}, {{0, 0, 0}}});
  const auto slit = find_slit(first, second, 0.25);
  ASSERT_TRUE(slit);
  EXPECT_EQ(slit->width, 0.125);
  EXPECT_EQ(slit->vertices, 2u);
  EXPECT_EQ(slit->at, (Vec3{-0.125, 3, 4}));
  EXPECT_EQ(slit->vertex, 3u);
  EXPECT_EQ(find_slit(second, first, 0.25)->vertices, 2u);
}

TEST(Slit, BordersThatMeetHaveNone) {
  // On the same line, cut differently: T-junctions are another finding.
  EXPECT_FALSE(any_slit(tile(0, 0, 3, 3), tile(3, 0, 3, 3), 0.25));
  EXPECT_FALSE(any_slit(tile(0, 0, 3, 3, {0.1}), tile(3, 0, 3, 3, {0.2, 0.45}), 0.25));
  EXPECT_FALSE(any_slit(tile(0, 0, 3, 3), tile(3, 1, 5, 7, {0.01}), 0.25));
}

TEST(Slit, VerticesNearASharedCornerAreNotBesideTheOtherBorder) {
  // Four tiles round a corner, each with vertices close to its corners on every side: those on the sides that
  // lead away from the common one are near the other tile, and belong there.
  //   C | D
  //   --+--
  //   A | B
  const std::vector<double> near{0.001, 0.05, 0.2};
  const std::array<Border, 4> tiles{tile(0, 0, 3, 3, near), tile(3, 0, 3, 3, near), tile(0, 3, 3, 3, near),
                                    tile(3, 3, 3, 3, near)};
  for (const Border& a : tiles) {
    for (const Border& b : tiles) EXPECT_FALSE(find_slit(a, b, 0.25));
  }
  // A small tile beside the middle of a large one's side: its sides leave that side at right angles.
  EXPECT_FALSE(any_slit(tile(0, 0, 9, 9), tile(9, 3, 2, 2, near), 0.25));
}

TEST(Slit, WhereCornersMissEachOtherTheWidthIsThatOfTheSlit) {
  // Both corners of the side are 1e-9 off; the perpendicular sides' vertices, within reach, say nothing.
  const std::vector<double> near{0.05, 0.2};
  const auto slit = find_slit(tile(0, 0, 3, 3, near), tile(3 + 1e-9, 0, 3, 3, near), 0.25);
  ASSERT_TRUE(slit);
  EXPECT_NEAR(slit->width, 1e-9, 1e-15);
  EXPECT_EQ(slit->vertices, 8u);
}

TEST(Slit, AStripThinnerThanASlitMayBeIsNone) {
  // The strip's far side is as near, but the strip itself lies between.
  EXPECT_FALSE(any_slit(tile(0, 0, 3, 3), tile(3, 0, 0.125, 3), 0.25));
  // Beside the strip, a slit between it and the next tile.
  EXPECT_TRUE(any_slit(tile(3, 0, 0.125, 3), tile(3.25, 0, 3, 3), 0.25));
}

TEST(Slit, SidesPartAtAnyAngleOfACornerThatMeshesShare) {
  // Two triangles with a common vertex, nothing else: from 30 degrees on they are two corners of a fan. The
  // first fills what lies between 287 and 360 degrees, the second 23 degrees.
  const std::vector<double> shares{0.02, 0.05, 0.1, 0.3, 0.6};
  for (int degrees = 30; degrees <= 225; degrees += 15) {
    const double angle = degrees * 0.017453292519943295;
    std::vector<Vec2> one, two;
    const Vec2 corner{0, 0}, along{1, 0}, away{std::cos(angle), std::sin(angle)};
    // The first's side runs along +x, its body below; the second's side along `away`, its body beyond.
    const Vec2 below{0.3, -1}, beyond{std::cos(angle + 0.4), std::sin(angle + 0.4)};
    side(one, below, along, {});
    side(one, along, corner, shares);
    side(one, corner, below, {});
    side(two, corner, away, shares);
    side(two, away, beyond, {});
    side(two, beyond, corner, {});
    EXPECT_FALSE(any_slit(loop(one), loop(two), 0.05)) << degrees;
  }
}

TEST(Slit, ASharperAngleIsASlitThatOpens) {
  //  +        +     they part at the common vertex 0, by 1/8 over a length of 1
  //   \      |
  //    0-----0
  const auto slit = find_slit(chain({{{0, 0, 0}}, {{0, 1, 0}}, {{-0.125, 2, 0}}}),
                              chain({{{0, 2, 0}}, {{0, 1, 0}}, {{0, 0, 0}}}), 0.25);
  ASSERT_TRUE(slit);
  EXPECT_EQ(slit->width, 0.125);
  EXPECT_EQ(slit->vertices, 1u);
}

// Partitions of the plane, as meshers leave them: polygons between the corners of a shaken grid.

class PartitionMaker {
 public:
  explicit PartitionMaker(Random& random) : random_(random) {
    for (int j = 0; j <= kSide; ++j) {
      for (int i = 0; i <= kSide; ++i)
        corners_.push_back({i + random.between(-0.2, 0.2), j + random.between(-0.2, 0.2)});
    }
  }

  /// Neighbours share all vertices of their side exactly.
  std::vector<std::vector<Vec2>> make() {
    std::vector<std::vector<Vec2>> cells;
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        std::vector<Vec2> points;
        const std::array<int, 4> c{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        for (std::size_t k = 0; k < 4; ++k) add(points, c[k], c[(k + 1) % 4]);
        cells.push_back(points);
      }
    }
    return cells;
  }
  static constexpr int kSide = 3;

 private:
  static int at(int i, int j) { return j * (kSide + 1) + i; }

  void add(std::vector<Vec2>& points, int from, int to) {
    const std::pair key{std::min(from, to), std::max(from, to)};
    auto found = std::find_if(sides_.begin(), sides_.end(), [&](const auto& s) { return s.first == key; });
    if (found == sides_.end()) {
      // Small and irregular, most of them close to the corners.
      std::vector<double> shares;
      for (std::uint64_t n = random_.below(7); n > 0; --n) {
        const double s = random_.unit();
        shares.push_back(random_.below(2) == 0 ? s * s * s : 1 - s * s * s);
      }
      std::sort(shares.begin(), shares.end());
      const Vec2 a = corners_[static_cast<std::size_t>(key.first)],
                 b = corners_[static_cast<std::size_t>(key.second)];
      std::vector<Vec2> inner;
      for (const double s : shares) inner.push_back(a + (b - a) * s);
      found = sides_.insert(sides_.end(), {key, inner});
    }
    points.push_back(corners_[static_cast<std::size_t>(from)]);
    std::vector<Vec2> inner = found->second;
    if (from > to) std::reverse(inner.begin(), inner.end());
    points.insert(points.end(), inner.begin(), inner.end());
  }

  Random& random_;
  std::vector<Vec2> corners_;
  std::vector<std::pair<std::pair<int, int>, std::vector<Vec2>>> sides_;
};

TEST(Slit, SoundPartitionsHaveNoneAndMovedCellsDo) {
  Random random(5, "partitions");
  std::size_t pairs = 0, slits = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto cells = PartitionMaker(random).make();
    const double within = random.between(0.01, 0.2);
    for (std::size_t a = 0; a < cells.size(); ++a) {
      for (std::size_t b = 0; b < cells.size(); ++b) {
        if (a == b) continue;
        const auto slit = find_slit(loop(cells[a]), loop(cells[b]), within);
        EXPECT_FALSE(slit) << trial << ": cells " << a << ", " << b << " at " << slit->at.x << " "
                           << slit->at.y;
        ++pairs;
      }
    }
    // The middle cell moved east by w: beside its western neighbour that is a slit of about w times the
    // side's cosine, never more than w.
    const double w = within * 0.5;
    std::vector<Vec2> shifted = cells[4];
    for (Vec2& p : shifted) p.x += w;
    const auto slit = find_slit(loop(shifted), loop(cells[3]), within);
    if (!slit) continue;
    ++slits;
    EXPECT_LE(slit->width, w * (1 + 1e-9));
    EXPECT_GE(slit->width, w * 0.8);
  }
  EXPECT_EQ(pairs, 300u * 72u);
  EXPECT_GE(slits, 295u);
}

}  // namespace
}  // namespace plumbline::oracle
