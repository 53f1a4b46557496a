// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The overlay's irregular pieces. Here a piece is found by clipping the mesh triangle to half a cell
// (Sutherland and Hodgman 1974): its heights are then means of the triangle's own corners, whatever its
// shape, so a sliver as steep as one likes gives no height outside its corners' range.

#include <algorithm>
#include <cmath>
#include <optional>

#include "oracle/predicates.h"
#include "oracle/vertical_overlay.h"

namespace plumbline::oracle::detail {
namespace {

/// Which sides of a clipping region a corner lies on; 0: a corner of the triangle itself.
using Sides = unsigned;
constexpr Sides kGridLine = 0b011;

struct PieceCorner {
  double x = 0, y = 0, z = 0;
  Sides sides = 0;
};

/// A convex polygon of at most 3 + 4 corners, in place.
struct Piece {
  std::array<PieceCorner, 8> corners;
  std::size_t size = 0;

  void push(const PieceCorner& corner) { corners[size++] = corner; }
};

/// Cuts off what lies where `distance` is negative; `settle` puts a new corner exactly on the line.
template <class Distance, class Settle>
void clip(Piece& piece, Sides side, Distance distance, Settle settle) {
  Piece kept;
  for (std::size_t k = 0; k < piece.size && kept.size < kept.corners.size(); ++k) {
    const PieceCorner& p = piece.corners[k];
    const PieceCorner& q = piece.corners[k + 1 == piece.size ? 0 : k + 1];
    const double from = distance(p);
    const double to = distance(q);
    if (from >= 0) kept.push(p);
    if ((from < 0) != (to < 0) && from != 0 && to != 0 && kept.size < kept.corners.size()) {
      // From the nearer end, so that the two triangles at an edge cut it at the same place up to rounding.
      const double share = from / (from - to);
      PieceCorner cut{p.x + share * (q.x - p.x), p.y + share * (q.y - p.y), p.z + share * (q.z - p.z),
                      side | (p.sides & q.sides)};
      settle(cut);
      kept.push(cut);
    }
  }
  piece = kept;
}

Piece as_piece(const GridTriangle& triangle, double origin_x, double origin_y, double base_m) {
  Piece piece;
  for (const GridPoint& p : triangle) piece.push({p.x - origin_x, p.y - origin_y, p.z - base_m, 0});
  return piece;
}

void clip_to_rows(Piece& piece, double south, double north) {
  clip(
      piece, 1, [&](const PieceCorner& p) { return p.y - south; }, [&](PieceCorner& p) { p.y = south; });
  clip(
      piece, 2, [&](const PieceCorner& p) { return north - p.y; }, [&](PieceCorner& p) { p.y = north; });
}
void clip_to_columns(Piece& piece, double west, double east) {
  clip(
      piece, 4, [&](const PieceCorner& p) { return p.x - west; }, [&](PieceCorner& p) { p.x = west; });
  clip(
      piece, 8, [&](const PieceCorner& p) { return east - p.x; }, [&](PieceCorner& p) { p.x = east; });
}

}  // namespace

/// The triangle's own corners: the only places inside a cell where the distance to the envelope can peak.
void Overlay::judge_corners(const GridTriangle& triangle) {
  for (const GridPoint& p : triangle) {
    if (p.x < 0 || p.y < 0 || p.x > columns_ - 1 || p.y > rows_ - 1) continue;
    int i = std::min(static_cast<int>(p.x), columns_ - 2);
    int j = std::min(static_cast<int>(p.y), rows_ - 2);
    if (!judged(i, j)) {  // on a grid line it touches the cells beyond as well
      const int west = p.x == i && i > 0 ? i - 1 : i, south = p.y == j && j > 0 ? j - 1 : j;
      if (judged(west, j)) {
        i = west;
      } else if (judged(i, south)) {
        j = south;
      } else if (judged(west, south)) {
        i = west;
        j = south;
      } else {
        continue;
      }
    }
    const double s = p.x - i;
    const double t = p.y - j;
    if ((s == 0 || s == 1) && (t == 0 || t == 1)) {
      visit_at_sample(p.z - terrain_.z(i + static_cast<int>(s), j + static_cast<int>(t)), p.x, p.y);
      continue;
    }
    const double z00 = terrain_.z(i, j), z10 = terrain_.z(i + 1, j);
    const double z01 = terrain_.z(i, j + 1), z11 = terrain_.z(i + 1, j + 1);
    const double height = p.z - z00;
    const double declared = s >= t ? s * (z10 - z00) + t * (z11 - z10) : t * (z01 - z00) + s * (z11 - z01);
    const double other = s + t <= 1 ? s * (z10 - z00) + t * (z01 - z00)
                                    : (z11 - z00) + (1 - s) * (z01 - z11) + (1 - t) * (z10 - z11);
    visit_declared(height - declared, p.x, p.y);
    const double above = height - std::max(declared, other);
    const double below = std::min(declared, other) - height;
    certain_peak_.visit(std::max({above, below, 0.0}), p.x, p.y);
  }
}

void Overlay::judge_sliver(const GridTriangle& triangle) {
  Piece inside = as_piece(triangle, 0, 0, triangle[0].z);
  clip_to_rows(inside, 0, rows_ - 1);
  clip_to_columns(inside, 0, columns_ - 1);
  if (inside.size == 0) return;
  const auto extent = [](const Piece& piece, double PieceCorner::*coordinate, int cells) {
    double low = piece.corners[0].*coordinate, high = low;
    for (std::size_t k = 1; k < piece.size; ++k) {
      low = std::min(low, piece.corners[k].*coordinate);
      high = std::max(high, piece.corners[k].*coordinate);
    }
    // A margin far above the rounding of a cut: a cell too many has an empty piece, a cell too few would be a
    // gap.
    constexpr double kMarginCells = 0x1p-24;
    return std::array<int, 2>{std::clamp(static_cast<int>(low - kMarginCells), 0, cells - 1),
                              std::clamp(static_cast<int>(high + kMarginCells), 0, cells - 1)};
  };
  const auto [south, north] = extent(inside, &PieceCorner::y, rows_ - 1);
  for (int row = south; row <= north + 1; ++row) judge_sliver_samples(triangle, row);
  for (int row = south; row <= north; ++row) {
    Piece strip = inside;
    clip_to_rows(strip, row, row + 1);
    if (strip.size == 0) continue;
    const auto [west, east] = extent(strip, &PieceCorner::x, columns_ - 1);
    for (int column = west; column <= east; ++column) {
      if (!judged(column, row)) continue;
      clip_to_half(triangle, column, row, Half::southeast);
      clip_to_half(triangle, column, row, Half::northwest);
    }
  }
}

/// The samples of one row under the triangle, decided exactly: clipping rounds, and might find a sample on
/// the edge between two triangles under neither. The height is a mean of where the row's line crosses the
/// edges.
void Overlay::judge_sliver_samples(const GridTriangle& triangle, int row) {
  struct Crossing {
    double x, z;
  };
  std::optional<Crossing> west, east;
  const auto meet = [&](double x, double z) {
    if (!west || x < west->x) west = {x, z};
    if (!east || x > east->x) east = {x, z};
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint& p = triangle[k];
    const GridPoint& q = triangle[(k + 1) % 3];
    if (p.y == row) meet(p.x, p.z);
    if ((p.y < row && q.y > row) || (p.y > row && q.y < row)) {
      const double share = (row - p.y) / (q.y - p.y);
      meet(p.x + share * (q.x - p.x), p.z + share * (q.z - p.z));
    }
  }
  if (!west) return;
  constexpr double kMarginCells = 0x1p-24;  // far above the rounding of a crossing
  const int first = static_cast<int>(std::ceil(std::max(west->x - kMarginCells, 0.0)));
  const int last = static_cast<int>(std::floor(std::min(east->x + kMarginCells, columns_ - 1.0)));
  for (int x = first; x <= last; ++x) {
    const Vec2 at{static_cast<double>(x), static_cast<double>(row)};
    bool inside = judged_around(x, row);
    for (std::size_t k = 0; k < 3 && inside; ++k) {
      const GridPoint& p = triangle[k];
      const GridPoint& q = triangle[(k + 1) % 3];
      inside = orientation({p.x, p.y}, {q.x, q.y}, at).value >= 0;
    }
    if (!inside) continue;
    const double width = east->x - west->x;
    const double share = width > 0 ? std::clamp((x - west->x) / width, 0.0, 1.0) : 0;
    const double height = west->z + share * (east->z - west->z);
    aside_peak_.visit(std::fabs(height - terrain_.z(x, row)), at.x, at.y);
  }
}

void Overlay::clip_to_half(const GridTriangle& triangle, int column, int row, Half half) {
  const double base_m = triangle[0].z;
  Piece piece = as_piece(triangle, column, row, base_m);
  const double z00 = terrain_.z(column, row) - base_m;
  const double z11 = terrain_.z(column + 1, row + 1) - base_m;
  double by_x = 0, by_y = 0;
  if (half == Half::southeast) {
    const double z10 = terrain_.z(column + 1, row) - base_m;
    by_x = z10 - z00;
    by_y = z11 - z10;
    clip(
        piece, 1, [](const PieceCorner& p) { return p.y; }, [](PieceCorner& p) { p.y = 0; });
    clip(
        piece, 2, [](const PieceCorner& p) { return 1 - p.x; }, [](PieceCorner& p) { p.x = 1; });
    clip(
        piece, 4, [](const PieceCorner& p) { return p.x - p.y; }, [](PieceCorner& p) { p.y = p.x; });
  } else {
    const double z01 = terrain_.z(column, row + 1) - base_m;
    by_y = z01 - z00;
    by_x = z11 - z01;
    clip(
        piece, 1, [](const PieceCorner& p) { return p.x; }, [](PieceCorner& p) { p.x = 0; });
    clip(
        piece, 2, [](const PieceCorner& p) { return 1 - p.y; }, [](PieceCorner& p) { p.y = 1; });
    clip(
        piece, 4, [](const PieceCorner& p) { return p.y - p.x; }, [](PieceCorner& p) { p.x = p.y; });
  }
  if (piece.size == 0) return;

  std::array<double, 8> error{};
  for (std::size_t k = 0; k < piece.size; ++k) {
    const PieceCorner& p = piece.corners[k];
    error[k] = p.z - (z00 + by_x * p.x + by_y * p.y);
    if ((p.sides & kGridLine) != 0) {
      visit_everywhere(error[k], column + p.x, row + p.y);
    } else if (p.sides != 0) {
      visit_declared(error[k], column + p.x, row + p.y);
    }
  }
  const PieceCorner& o = piece.corners[0];
  for (std::size_t k = 2; k < piece.size; ++k) {
    const PieceCorner& p = piece.corners[k - 1];
    const PieceCorner& q = piece.corners[k];
    const double twice_area = (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    if (twice_area > 0) sums_.add_triangle(error[0], error[k - 1], error[k], twice_area);
  }
}

}  // namespace plumbline::oracle::detail
