// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// O2's second, independent routes: dense sampling, which must never exceed the exact figures and must
// approach them; and the same figures in rational numbers, by clipping every triangle to every quarter of
// every cell. The rational route knows nothing of rows, distances, or of the envelope's convexity: it visits
// crossings with both diagonals.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include "oracle/vertical.h"
#include "tests/oracle/vertical_support.h"

namespace plumbline::oracle {
namespace {

using Rational = CGAL::Exact_rational;

struct Point {
  Rational x, y, z;
};
using Polygon = std::vector<Point>;

template <class Function>
Polygon clipped(const Polygon& polygon, Function function) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point& p = polygon[k];
    const Point& q = polygon[(k + 1) % polygon.size()];
    const Rational from = function(p), to = function(q);
    if (from >= 0) kept.push_back(p);
    if (from * to < 0) {
      const Rational t = from / (from - to);
      kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)});
    }
  }
  return kept;
}

struct ExactFigures {
  Rational max = 0, certain_max = 0, area = 0, square = 0, absolute = 0, samples_max = 0;
};
using Marks = std::vector<std::uint8_t>;  ///< empty: every sample holds data

Rational absolute(const Rational& value) { return value < 0 ? Rational(-value) : value; }

/// ∫e and ∫e² over a polygon whose z is e.
void integrate(const Polygon& polygon, Rational& area, Rational& first, Rational& second) {
  area = first = second = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Point &a = polygon[0], &b = polygon[k - 1], &c = polygon[k];
    const Rational part = ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
    area += part;
    first += part * (a.z + b.z + c.z) / 3;
    second += part * (a.z * a.z + b.z * b.z + c.z * c.z + a.z * b.z + b.z * c.z + c.z * a.z) / 6;
  }
}

bool cell_has_data(const Terrain& terrain, const Marks& has_data, int i, int j) {
  if (i < 0 || j < 0 || i + 1 >= terrain.columns || j + 1 >= terrain.rows) return false;
  if (has_data.empty()) return true;
  return has_data[terrain.index(i, j)] != 0 && has_data[terrain.index(i + 1, j)] != 0 &&
         has_data[terrain.index(i, j + 1)] != 0 && has_data[terrain.index(i + 1, j + 1)] != 0;
}

/// The triangle's height over a sample, less the sample's, if it lies inside or on the rim: by Cramer's rule.
void visit_sample(const Polygon& t, int i, int j, double height, ExactFigures& figures) {
  std::array<Rational, 3> share;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point &p = t[(k + 1) % 3], &q = t[(k + 2) % 3];
    share[k] = (q.x - p.x) * (j - p.y) - (q.y - p.y) * (i - p.x);
    if (share[k] < 0) return;
  }
  const Rational z =
      (share[0] * t[0].z + share[1] * t[1].z + share[2] * t[2].z) / (share[0] + share[1] + share[2]);
  figures.samples_max = std::max<Rational>(figures.samples_max, absolute(z - height));
}

/// All figures of meshes in units of cells, heights as they are.
ExactFigures exact_figures(const std::vector<Polygon>& triangles, const Terrain& terrain,
                           const Marks& has_data) {
  ExactFigures figures;
  for (const Polygon& triangle : triangles) {
    for (int j = 0; j < terrain.rows; ++j) {
      for (int i = 0; i < terrain.columns; ++i) {
        if (cell_has_data(terrain, has_data, i, j) || cell_has_data(terrain, has_data, i - 1, j) ||
            cell_has_data(terrain, has_data, i, j - 1) || cell_has_data(terrain, has_data, i - 1, j - 1)) {
          visit_sample(triangle, i, j, terrain.z(i, j), figures);
        }
      }
    }
    for (int j = 0; j + 1 < terrain.rows; ++j) {
      for (int i = 0; i + 1 < terrain.columns; ++i) {
        if (!cell_has_data(terrain, has_data, i, j)) continue;
        Polygon cell;
        for (const Point& p : triangle) cell.push_back({p.x - i, p.y - j, p.z});
        cell = clipped(cell, [](const Point& p) { return p.x; });
        cell = clipped(cell, [](const Point& p) { return p.y; });
        cell = clipped(cell, [](const Point& p) { return Rational(1 - p.x); });
        cell = clipped(cell, [](const Point& p) { return Rational(1 - p.y); });
        const Rational z00 = terrain.z(i, j), z10 = terrain.z(i + 1, j);
        const Rational z01 = terrain.z(i, j + 1), z11 = terrain.z(i + 1, j + 1);
        for (const int quarter : {0, 1, 2, 3}) {
          const bool southeast = quarter % 2 == 0, southwest = quarter / 2 == 0;
          Polygon piece = clipped(
              cell, [&](const Point& p) { return southeast ? Rational(p.x - p.y) : Rational(p.y - p.x); });
          piece = clipped(piece, [&](const Point& p) {
            return southwest ? Rational(1 - p.x - p.y) : Rational(p.x + p.y - 1);
          });
          for (Point& p : piece) {
            const Rational declared = southeast ? Rational(z00 + p.x * (z10 - z00) + p.y * (z11 - z10))
                                                : Rational(z00 + p.y * (z01 - z00) + p.x * (z11 - z01));
            const Rational other = southwest
                                       ? Rational(z00 + p.x * (z10 - z00) + p.y * (z01 - z00))
                                       : Rational(z11 + (1 - p.x) * (z01 - z11) + (1 - p.y) * (z10 - z11));
            const Rational high = declared > other ? declared : other,
                           low = declared > other ? other : declared;
            const Rational outside = p.z > high  ? Rational(p.z - high)
                                     : p.z < low ? Rational(low - p.z)
                                                 : Rational(0);
            p.z -= declared;
            if (absolute(p.z) > figures.max) figures.max = absolute(p.z);
            if (outside > figures.certain_max) figures.certain_max = outside;
          }
          Rational area, first, second;
          integrate(piece, area, first, second);
          figures.area += area;
          figures.square += second;
          integrate(clipped(piece, [](const Point& p) { return p.z; }), area, first, second);
          figures.absolute += first;
          integrate(clipped(piece, [](const Point& p) { return Rational(-p.z); }), area, first, second);
          figures.absolute -= first;
        }
      }
    }
  }
  return figures;
}

void expect_exact(const Mesh& mesh, const Terrain& terrain, double scale_factor, const Marks& has_data = {}) {
  std::vector<Polygon> triangles;
  for (const auto& triangle : mesh.triangles) {
    Polygon polygon;
    for (const std::uint32_t v : triangle) {
      const Vec3& p = mesh.positions[v];
      polygon.push_back({Rational(p.x) / Rational(terrain.spacing_m),
                         Rational(p.y) / Rational(terrain.spacing_m), Rational(p.z)});
    }
    triangles.push_back(polygon);
  }
  const ExactFigures exact = exact_figures(triangles, terrain, has_data);
  const VerticalError error = vertical_error_where_data(mesh, terrain, has_data);
  if (exact.area == 0) {  // beside the grid, or touching its rim: no domain in common
    EXPECT_EQ(error.area_m2, 0);
    EXPECT_EQ(error.max, 0);
    EXPECT_EQ(error.samples_max, 0);
    return;
  }
  const double bound_m =
      scale_factor * kVerticalRoundingFactor * 0x1p-53 * test::height_range_m(mesh, terrain);
  EXPECT_NEAR(error.max, CGAL::to_double(exact.max), bound_m);
  EXPECT_NEAR(error.certain_max, CGAL::to_double(exact.certain_max), bound_m);
  EXPECT_NEAR(error.samples_max, CGAL::to_double(exact.samples_max), bound_m);
  EXPECT_LE(error.samples_max, error.certain_max);
  const double area = CGAL::to_double(exact.area);
  // Rounded corners of pieces shift areas by a few 2⁻⁵³ of a cell times the number of pieces: below 10⁻¹³
  // cells here.
  constexpr double kAreaBound = 1e-13;
  EXPECT_NEAR(error.area_m2 / (terrain.spacing_m * terrain.spacing_m), area, kAreaBound);
  if (area < 1e-3) return;  // means over less are ill-conditioned: sums and area above are what is promised
  EXPECT_NEAR(error.rms, std::sqrt(CGAL::to_double(exact.square / exact.area)),
              bound_m + 40 * kAreaBound / area);
  EXPECT_NEAR(error.mean, CGAL::to_double(exact.absolute / exact.area), bound_m + 40 * kAreaBound / area);
}

TEST(VerticalExact, TrianglesOnSamplesMatchRationals) {
  Random random(21);
  for (int round = 0; round < 400; ++round) {
    const int columns = 2 + static_cast<int>(random.below(4)), rows = 2 + static_cast<int>(random.below(4));
    const Terrain terrain = test::random_terrain(columns, rows, 30, random.bits());
    expect_exact(test::random_triangle(terrain, random, true, false), terrain, 1);
  }
}

TEST(VerticalExact, TrianglesAnywhereMatchRationals) {
  Random random(22);
  for (int round = 0; round < 400; ++round) {
    const int columns = 2 + static_cast<int>(random.below(4)), rows = 2 + static_cast<int>(random.below(4));
    const Terrain terrain =
        test::random_terrain(columns, rows, round % 2 == 0 ? 1.0 : 1.0 / 3, random.bits());
    expect_exact(test::random_triangle(terrain, random, false, false), terrain, 1);
  }
}

TEST(VerticalExact, SliversMatchRationals) {
  // A sliver's height is 10⁻³ of its length: a rounding of its coordinates moves heights by as much more.
  Random random(23);
  for (int round = 0; round < 400; ++round) {
    const Terrain terrain = test::random_terrain(5, 4, 1, random.bits());
    expect_exact(test::random_triangle(terrain, random, false, true), terrain, 1e3);
  }
}

TEST(VerticalExact, MeshesOfManyTrianglesMatchRationals) {
  // Coarse and fine parts, both diagonals, vertices between samples: a fan around a free point, and a full
  // grid.
  Random random(24);
  for (int round = 0; round < 30; ++round) {
    const Terrain terrain = test::random_terrain(5, 5, 1, random.bits());
    Mesh fan = test::two_triangles(terrain, [&](double, double) { return random.between(100, 120); });
    fan.positions.push_back({random.between(0.5, 3.5), random.between(0.5, 3.5), random.between(100, 120)});
    fan.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    expect_exact(fan, terrain, 1);
    Mesh grid = test::grid_mesh(terrain, [&](int, int) { return random.below(2) == 0; });
    for (Vec3& p : grid.positions) p.z += random.between(-1, 1);
    expect_exact(grid, terrain, 1);
  }
}

TEST(VerticalExact, HolesAreLeftOutAsByRationals) {
  // Meshes without gaps over the whole grid, so that what one triangle has on the rim of a hole its neighbour
  // has, too.
  Random random(26);
  for (int round = 0; round < 60; ++round) {
    const Terrain terrain = test::random_terrain(6, 5, 1, random.bits());
    Marks has_data(terrain.heights_m.size(), 1);
    Terrain holed = terrain;  // a hole's placeholder is never looked at
    for (std::uint64_t holes = 1 + random.below(8); holes > 0; --holes) {
      const std::size_t k = random.below(has_data.size());
      has_data[k] = 0;
      holed.heights_m[k] = std::numeric_limits<double>::quiet_NaN();
    }
    Mesh fan = test::two_triangles(terrain, [&](double, double) { return random.between(100, 120); });
    fan.positions.push_back({random.between(0.5, 4.5), random.between(0.5, 3.5), random.between(100, 120)});
    if (round % 2 == 0) fan.positions.back() = {2, 3, 90};  // on a sample
    fan.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    expect_exact(fan, terrain, 1, has_data);
    Mesh grid = test::grid_mesh(terrain, [&](int, int) { return random.below(2) == 0; });
    for (Vec3& p : grid.positions) p.z += random.between(-1, 1);
    expect_exact(grid, terrain, 1, has_data);
    for (const Mesh& mesh : {fan, grid}) {
      const VerticalError error = vertical_error_where_data(mesh, terrain, has_data);
      EXPECT_EQ(error, vertical_error_where_data(mesh, holed, has_data));
      std::size_t cells = 0;
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 5; ++i) cells += cell_has_data(terrain, has_data, i, j) ? 1 : 0;
      }
      EXPECT_NEAR(error.area_m2, static_cast<double>(cells), 1e-13);
    }
    ASSERT_FALSE(HasFailure()) << round;
  }
}

TEST(VerticalExact, ThinTrianglesMissNoSampleOnTheirEdges) {
  // Every edge of the fan runs through samples; its triangles are slivers, so clipping alone decides by
  // rounded corners which of them a sample on an edge belongs to.
  const Terrain terrain = test::random_terrain(13, 9, 1, 27);
  Random random(28);
  for (int round = 0; round < 40; ++round) {
    Mesh fan;
    fan.positions.push_back({0, 0, 110});
    const int over = 2 + static_cast<int>(random.below(5)), up = 1 + static_cast<int>(random.below(4));
    for (int k = -3; k <= 3; ++k) {
      const double aside = k * 0.05;
      fan.positions.push_back({2.0 * over - aside * up, 2.0 * up + aside * over, random.between(90, 130)});
    }
    for (std::uint32_t k = 1; k < 7; ++k) fan.triangles.push_back({0, k, k + 1});
    expect_exact(fan, terrain, 1e2);
  }
}

/// Largest slope of any half of a cell, split either way: the terrain's Lipschitz constant, and that of both
/// bounds of its envelope.
double steepest(const Terrain& terrain) {
  double most = 0;
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    for (int i = 0; i + 1 < terrain.columns; ++i) {
      const double west = terrain.z(i, j + 1) - terrain.z(i, j),
                   east = terrain.z(i + 1, j + 1) - terrain.z(i + 1, j);
      const double south = terrain.z(i + 1, j) - terrain.z(i, j),
                   north = terrain.z(i + 1, j + 1) - terrain.z(i, j + 1);
      for (const double x : {south, north}) {
        for (const double y : {west, east})
          most = std::max(most, std::sqrt(x * x + y * y) / terrain.spacing_m);
      }
    }
  }
  return most;
}

/// Distance of height z at plan point p to the envelope of the two ways to split its cell: by hand.
double outside_envelope(const Terrain& terrain, Vec3 p) {
  const int i = std::min(static_cast<int>(p.x / terrain.spacing_m), terrain.columns - 2);
  const int j = std::min(static_cast<int>(p.y / terrain.spacing_m), terrain.rows - 2);
  const double u = p.x / terrain.spacing_m - i, v = p.y / terrain.spacing_m - j;
  const double z00 = terrain.z(i, j), z10 = terrain.z(i + 1, j), z01 = terrain.z(i, j + 1),
               z11 = terrain.z(i + 1, j + 1);
  const double one =
      u >= v ? z00 + u * (z10 - z00) + v * (z11 - z10) : z00 + v * (z01 - z00) + u * (z11 - z01);
  const double two = u + v <= 1 ? z00 + u * (z10 - z00) + v * (z01 - z00)
                                : z11 + (1 - u) * (z01 - z11) + (1 - v) * (z10 - z11);
  return std::max({0.0, p.z - std::max(one, two), std::min(one, two) - p.z});
}

TEST(VerticalExact, DenseSamplesNeverExceedAndConverge) {
  // The difference is continuous and no steeper than the triangle and the terrain together. The corners of a
  // subdivision into n² triangles leave no point farther than longest side / n from a sample, so a sampled
  // maximum is at most (slopes · side) / n low; every other sample set contains the one before, so it never
  // falls. Means over the n² centroids are off by no more than that either.
  Random random(25);
  std::size_t close = 0;
  for (int round = 0; round < 60; ++round) {
    const int columns = 3 + static_cast<int>(random.below(8)), rows = 3 + static_cast<int>(random.below(8));
    const Terrain terrain = test::random_terrain(columns, rows, round % 2 == 0 ? 30 : 1.0 / 3, random.bits());
    Mesh mesh;
    double twice_area = 0;
    while (twice_area < 0.1 * terrain.width_m() * terrain.depth_m()) {  // inside the grid, and no sliver
      mesh.positions.clear();
      for (int k = 0; k < 3; ++k) {
        mesh.positions.push_back(
            {random.unit() * terrain.width_m(), random.unit() * terrain.depth_m(), random.between(95, 125)});
      }
      const Vec3 u = mesh.positions[1] - mesh.positions[0], v = mesh.positions[2] - mesh.positions[0];
      twice_area = u.x * v.y - u.y * v.x;
    }
    mesh.triangles = {{0, 1, 2}};
    const auto& p = mesh.positions;
    const VerticalError error = vertical_error(mesh, terrain);
    const double rounding_m = kVerticalRoundingFactor * 0x1p-53 * test::height_range_m(mesh, terrain);
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double slope = std::sqrt(normal.x * normal.x + normal.y * normal.y) / normal.z + steepest(terrain);
    double side_m = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 e = p[(k + 1) % 3] - p[k];
      side_m = std::max(side_m, std::sqrt(e.x * e.x + e.y * e.y));
    }
    double last = 0;
    for (const int n : {16, 32, 64, 128, 256}) {
      const double bound_m = slope * side_m / n;
      double most = 0, certain = 0, squares = 0, absolutes = 0;
      int count = 0;
      for (int a = 0; a <= n; ++a) {
        for (int b = 0; a + b <= n; ++b) {
          const auto at = [&](double da, double db) {
            const double u = (a + da) / n, v = (b + db) / n;
            return p[0] * (1 - u - v) + p[1] * u + p[2] * v;
          };
          const auto difference = [&](Vec3 q) { return std::fabs(q.z - terrain.surface_height_m(q.x, q.y)); };
          const Vec3 corner = at(0, 0);
          most = std::max(most, difference(corner));
          certain = std::max(certain, outside_envelope(terrain, corner));
          for (const double third : {1.0 / 3, 2.0 / 3}) {  // of the upright and of the inverted triangle
            if (a + b + (third > 0.5 ? 2 : 1) > n) continue;
            const double e = difference(at(third, third));
            squares += e * e;
            absolutes += e;
            ++count;
          }
        }
      }
      EXPECT_EQ(count, n * n);
      EXPECT_LE(most, error.max + rounding_m) << round;
      EXPECT_GE(most, error.max - bound_m) << round << ", n = " << n;
      EXPECT_LE(certain, error.certain_max + rounding_m) << round;
      EXPECT_GE(certain, error.certain_max - bound_m) << round << ", n = " << n;
      EXPECT_GE(most, last) << "finer samples contain the coarser ones";
      EXPECT_NEAR(std::sqrt(squares / count), error.rms, bound_m) << round;
      EXPECT_NEAR(absolutes / count, error.mean, bound_m) << round;
      last = most;
    }
    close += last > 0.99 * error.max;
  }
  EXPECT_GT(close, 55U) << "the densest samples nearly reach it";
}

}  // namespace
}  // namespace plumbline::oracle
