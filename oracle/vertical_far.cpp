// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles that reach so far beyond the grid that doubles would lose the digits of what lies on it. They are
// cut to the grid in rationals: slow (a fraction of a millisecond each), and hardly ever needed.

#include <CGAL/Exact_rational.h>

#include "oracle/predicates.h"
#include "oracle/vertical_overlay.h"

namespace plumbline::oracle::detail {
namespace {

using Rational = CGAL::Exact_rational;

struct ExactPoint {
  Rational x, y, z;
};
using ExactPolygon = std::vector<ExactPoint>;

/// Keeps what lies where `distance`, a linear function, is not negative.
template <class Distance>
ExactPolygon cut(const ExactPolygon& polygon, Distance distance) {
  ExactPolygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ExactPoint& p = polygon[k];
    const ExactPoint& q = polygon[(k + 1) % polygon.size()];
    const Rational from = distance(p), to = distance(q);
    if (from >= 0) kept.push_back(p);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const Rational share = from / (from - to);
      kept.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y), p.z + share * (q.z - p.z)});
    }
  }
  return kept;
}

}  // namespace

std::vector<GridTriangle> cut_to_grid(const std::array<Vec3, 3>& triangle, const Terrain& terrain) {
  ++precision_tally().exact_figures;
  const Rational spacing = terrain.spacing_m;
  ExactPolygon polygon;
  for (const Vec3& p : triangle)
    polygon.push_back({Rational(p.x) / spacing, Rational(p.y) / spacing, Rational(p.z)});
  const Rational east = terrain.columns - 1, north = terrain.rows - 1;
  polygon = cut(polygon, [](const ExactPoint& p) { return p.x; });
  polygon = cut(polygon, [](const ExactPoint& p) { return p.y; });
  polygon = cut(polygon, [&](const ExactPoint& p) { return Rational(east - p.x); });
  polygon = cut(polygon, [&](const ExactPoint& p) { return Rational(north - p.y); });
  std::vector<GridPoint> corners;
  for (const ExactPoint& p : polygon) {
    corners.push_back({CGAL::to_double(p.x), CGAL::to_double(p.y), CGAL::to_double(p.z)});
  }
  std::vector<GridTriangle> parts;
  for (std::size_t k = 2; k < corners.size(); ++k) parts.push_back({corners[0], corners[k - 1], corners[k]});
  return parts;
}

}  // namespace plumbline::oracle::detail
