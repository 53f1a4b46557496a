// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is swept by rows of samples. On each row the samples inside form an interval, so between two
// rows the halves of cells that lie wholly inside form an interval too: these go to the sums four errors a
// cell, without a look at the edges. What is left at both ends is cut, nearly always by one edge; a half cell
// cut by one line is a triangle or a quadrilateral whose areas and errors follow from the corners' distances
// to the line. Halves cut by more edges are clipped as polygons (vertical_slivers.cpp).

#include "oracle/vertical_overlay.h"

#include <algorithm>
#include <utility>

namespace plumbline::oracle::detail {

/// Distance to the line through an edge, times the edge's length: positive inside. Coordinates are columns
/// and rows of the grid from `origin`; for corners on samples every distance is an exact integer.
struct Overlay::Edge {
  double by_x = 0, by_y = 0, constant = 0;
  double noise = 0;        ///< below this a distance counts as zero: a bound on its rounding error
  double column_step = 0;  ///< −1/by_x, 0 for an edge along a row
};

/// Where a row of samples crosses the triangle; columns from the origin.
struct Overlay::Row {
  int y = 0;
  bool meets = false;                  ///< the row's line meets the triangle
  int first = 1, last = 0;             ///< samples inside; none if first > last
  int first_cell = 0, last_cell = -1;  ///< cells that the row's line crosses inside the triangle
  std::array<double, 3> base{};        ///< distance to each edge at column 0
  RowErrors errors;
};

/// Two neighbouring rows of one triangle.
struct Overlay::Strip {
  const GridTriangle& triangle;
  const std::array<Edge, 3>& edges;
  const Plane& plane;
  unsigned west_edges, east_edges;  ///< bit k: edge k faces west, east
  const Row& south;
  const Row& north;
  int origin_x, origin_y;
  int first_cell, last_cell;  ///< cells between the rows that the triangle may touch
};

namespace {

/// A cell's samples counter-clockwise from the south-west, and the halves' corners among them.
constexpr std::array<int, 4> kSampleX{0, 1, 1, 0};
constexpr std::array<int, 4> kSampleY{0, 0, 1, 1};
constexpr std::array<std::size_t, 3> kSoutheast{0, 1, 2};
constexpr std::array<std::size_t, 3> kNorthwest{0, 2, 3};

/// A corner's cells: west … east along its row, and the rows of cells that it belongs to.
struct CornerCells {
  int west, east, south, north;
};

/// ⌊x⌋ as an int. Requires: |x| < 2³¹.
int floor_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (truncated > x ? 1 : 0);
}
int ceil_int(double x) { return -floor_int(-x); }

bool on_samples(const GridTriangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(), [](const GridPoint& p) {
    return p.x == static_cast<int>(p.x) && p.y == static_cast<int>(p.y);
  });
}

/// Slivers narrower than this many cells are evaluated between their corners only: a plane fitted to them
/// would lose digits on its way to the next sample.
constexpr double kLeastHeightCells = 0.125;

constexpr int kRowsAhead = 3;
/// Asks for two cache lines of samples. A request beyond the grid is harmless: nothing is read.
void fetch(const double* heights) {
  __builtin_prefetch(heights);
  __builtin_prefetch(heights + 8);
}

}  // namespace

Overlay::Edge Overlay::make_edge(const GridPoint& from, const GridPoint& to) {
  Edge edge;
  edge.by_x = from.y - to.y;
  edge.by_y = to.x - from.x;
  edge.constant = -(edge.by_x * from.x + edge.by_y * from.y);
  // Coordinates of samples stay within the triangle's box plus one cell, so each of the products and sums in
  // a distance rounds by at most 2⁻⁵³ of this reach; corners between samples were rounded to 2⁻⁵³ of
  // themselves before.
  const double reach_x = std::max(std::fabs(from.x), std::fabs(to.x)) + 1;
  const double reach_y = std::max(std::fabs(from.y), std::fabs(to.y)) + 1;
  edge.noise = 0x1p-49 * (std::fabs(edge.by_x) * reach_x + std::fabs(edge.by_y) * reach_y);
  edge.column_step = edge.by_x == 0 ? 0 : -1 / edge.by_x;
  return edge;
}

Plane Overlay::fit_plane(const GridTriangle& local) {
  const double x1 = local[1].x - local[0].x, y1 = local[1].y - local[0].y, z1 = local[1].z - local[0].z;
  const double x2 = local[2].x - local[0].x, y2 = local[2].y - local[0].y, z2 = local[2].z - local[0].z;
  const double twice_area = x1 * y2 - x2 * y1;
  Plane plane;
  plane.base_m = local[0].z;
  plane.by_x = (z1 * y2 - z2 * y1) / twice_area;
  plane.by_y = (x1 * z2 - x2 * z1) / twice_area;
  plane.constant = -(plane.by_x * local[0].x + plane.by_y * local[0].y);
  return plane;
}

/// The samples and the cells that the row's line crosses inside the triangle, among samples 0 … last_column.
void Overlay::cross_row(Row& row, const std::array<Edge, 3>& edges, int last_column) {
  row.first = row.first_cell = 0;
  row.last = row.last_cell = last_column;
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge& edge = edges[k];
    if (edge.by_x == 0) continue;
    const auto distance = [&](int x) { return edge.by_x * x + row.base[k]; };
    // The division only proposes; which sample is the first inside is decided by the distances themselves.
    const double guess = row.base[k] * edge.column_step;
    int x = guess > 0 ? (guess < last_column ? static_cast<int>(guess) : last_column) : 0;
    if (edge.by_x > 0) {
      while (x > 0 && distance(x - 1) >= -edge.noise) --x;
      while (x <= last_column && distance(x) < -edge.noise) ++x;
      row.first = std::max(row.first, x);
      row.first_cell = std::max(row.first_cell, distance(x) <= edge.noise ? x : x - 1);
    } else {
      while (x < last_column && distance(x + 1) >= -edge.noise) ++x;
      while (x >= 0 && distance(x) < -edge.noise) --x;
      row.last = std::min(row.last, x);
      row.last_cell = std::min(row.last_cell, distance(x) <= edge.noise ? x - 1 : x);
    }
  }
}

Overlay::Overlay(const Terrain& terrain, const std::uint8_t* cells)
    : terrain_(terrain), columns_(terrain.columns), rows_(terrain.rows), cells_(cells) {}

bool Overlay::judged_around(int i, int j) const {
  if (cells_ == nullptr) return true;
  for (int row = std::max(j - 1, 0); row <= std::min(j, rows_ - 2); ++row) {
    for (int column = std::max(i - 1, 0); column <= std::min(i, columns_ - 2); ++column) {
      if (judged(column, row)) return true;
    }
  }
  return false;
}

void Overlay::expect(const GridTriangle& triangle) const {
  const GridPoint* south = &triangle[0];
  for (const GridPoint& p : triangle) {
    if (p.y < south->y) south = &p;
  }
  const double west = std::min({triangle[0].x, triangle[1].x, triangle[2].x});
  const double north_end = std::max({triangle[0].y, triangle[1].y, triangle[2].y});
  if (west < 0 || west > columns_ - 1 || south->y < 0 || north_end > rows_ - 1) return;
  const double* heights =
      terrain_.heights_m.data() + terrain_.index(static_cast<int>(west), static_cast<int>(south->y));
  const int rows = std::min(static_cast<int>(north_end) - static_cast<int>(south->y), kRowsAhead);
  for (int y = 0; y <= rows; ++y, heights += columns_) fetch(heights);
}

void Overlay::judge(const GridTriangle& given) {
  const auto [west, east] = std::minmax({given[0].x, given[1].x, given[2].x});
  const auto [south, north] = std::minmax({given[0].y, given[1].y, given[2].y});
  if (east <= 0 || north <= 0 || west >= columns_ - 1 || south >= rows_ - 1) return;

  // The same triangle from another corner is the same triangle: start at the southmost, then westmost.
  GridTriangle triangle = given;
  std::rotate(triangle.begin(),
              std::min_element(
                  triangle.begin(), triangle.end(),
                  [](const GridPoint& p, const GridPoint& q) { return p.y != q.y ? p.y < q.y : p.x < q.x; }),
              triangle.end());
  if (east - west <= 1 && north - south <= 1 && judge_one_cell(triangle)) return;
  judge_corners(triangle);
  const double twice_area = (triangle[1].x - triangle[0].x) * (triangle[2].y - triangle[0].y) -
                            (triangle[1].y - triangle[0].y) * (triangle[2].x - triangle[0].x);
  const double extent = (east - west) + (north - south);
  if (twice_area < kLeastHeightCells * extent) {
    judge_sliver(triangle);
  } else {
    judge_rows(triangle);
  }
}

/// A half of one cell, by either diagonal, from its corners' errors alone: no plane is fitted, so equal
/// heights give 0.
bool Overlay::judge_one_cell(const GridTriangle& triangle) {
  if (!on_samples(triangle)) return false;
  const double west = std::min({triangle[0].x, triangle[1].x, triangle[2].x});
  const double south = triangle[0].y;
  if (west < 0 || south < 0 || west > columns_ - 2 || south > rows_ - 2) return false;
  const int column = static_cast<int>(west);
  const int row = static_cast<int>(south);
  if (!judged(column, row)) {
    for (const GridPoint& p : triangle) {
      const int i = static_cast<int>(p.x), j = static_cast<int>(p.y);
      if (judged_around(i, j)) visit_at_sample(p.z - terrain_.z(i, j), p.x, p.y);
    }
    return true;
  }
  std::array<double, 3> error{};
  int corners_seen = 0;  // bit 0: south-west, 1: south-east, 2: north-west, 3: north-east
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint& p = triangle[k];
    error[k] = p.z - terrain_.z(static_cast<int>(p.x), static_cast<int>(p.y));
    corners_seen |= 1 << (static_cast<int>(p.x - west) + 2 * static_cast<int>(p.y - south));
    visit_at_sample(error[k], p.x, p.y);
  }
  const bool has_diagonal = (corners_seen & 0b1001) == 0b1001;
  if (has_diagonal) {
    sums_.add_triangle(error[0], error[1], error[2], 1);
    return true;
  }
  // The other diagonal: the declared one crosses it in the cell's middle and cuts the half into two quarters.
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint& right_angle = triangle[k];
    const GridPoint& p = triangle[(k + 1) % 3];
    const GridPoint& q = triangle[(k + 2) % 3];
    if (p.x == q.x || p.y == q.y || (right_angle.x != p.x && right_angle.y != p.y)) continue;
    const double middle = 0.5 * ((p.z + q.z) - (terrain_.z(column, row) + terrain_.z(column + 1, row + 1)));
    visit_declared(middle, west + 0.5, south + 0.5);
    sums_.add_triangle(error[k], error[(k + 1) % 3], middle, 0.5);
    sums_.add_triangle(error[k], middle, error[(k + 2) % 3], 0.5);
  }
  return true;
}

void Overlay::judge_rows(const GridTriangle& triangle) {
  const double west = std::min({triangle[0].x, triangle[1].x, triangle[2].x});
  const double east = std::max({triangle[0].x, triangle[1].x, triangle[2].x});
  const double south_end = triangle[0].y;  // judge() starts at the southmost corner
  const double north_end = std::max(triangle[1].y, triangle[2].y);
  const int origin_x = std::max(floor_int(west), 0);
  const int origin_y = std::max(floor_int(south_end), 0);
  const int last_column = std::min(ceil_int(east), columns_ - 1) - origin_x;
  const int last_row = std::min(ceil_int(north_end), rows_ - 1) - origin_y;
  const int first_met = ceil_int(south_end) - origin_y;
  const int last_met = floor_int(north_end) - origin_y;

  GridTriangle local = triangle;
  for (GridPoint& p : local) {
    p.x -= origin_x;
    p.y -= origin_y;
  }
  std::array<Edge, 3> edges;
  std::array<CornerCells, 3> corner_cells;
  unsigned west_edges = 0, east_edges = 0;
  for (unsigned k = 0; k < 3; ++k) {
    edges[k] = make_edge(local[k], local[(k + 1) % 3]);
    if (edges[k].by_x > 0) west_edges |= 1u << k;
    if (edges[k].by_x < 0) east_edges |= 1u << k;
    const GridPoint& p = local[k];
    corner_cells[k] = {floor_int(p.x), ceil_int(p.x) - 1, ceil_int(p.y) - 1, floor_int(p.y)};
  }
  const Plane plane = fit_plane(local);

  const auto locate = [&](Row& row, int y) {
    row.y = y;
    row.errors = {terrain_.heights_m.data() + terrain_.index(origin_x, origin_y + y),
                  plane.by_y * y + plane.constant};
    for (std::size_t k = 0; k < 3; ++k) row.base[k] = edges[k].by_y * y + edges[k].constant;
    row.meets = first_met <= y && y <= last_met;
    if (row.meets) cross_row(row, edges, last_column);
  };
  std::array<Row, 2> rows;
  locate(rows[0], 0);
  for (int y = 0; y < last_row; ++y) {
    const Row& south = rows[static_cast<std::size_t>(y % 2)];
    Row& north = rows[static_cast<std::size_t>((y + 1) % 2)];
    locate(north, y + 1);
    // Rows of samples lie far apart in memory: ask for those to come while this one is worked on.
    if (y + 1 + kRowsAhead <= last_row) {
      fetch(north.errors.heights + std::max(north.first_cell, 0) +
            kRowsAhead * static_cast<std::ptrdiff_t>(columns_));
    }
    // The cells that the triangle meets between two rows: from its cross-sections there and its corners in
    // between.
    int first = last_column, last = -1;
    for (const Row* row : {&south, &std::as_const(north)}) {
      if (!row->meets) continue;
      first = std::min(first, row->first_cell);
      last = std::max(last, row->last_cell);
    }
    for (const CornerCells& corner : corner_cells) {
      if (y < corner.south || y > corner.north) continue;
      first = std::min(first, corner.west);
      last = std::max(last, corner.east);
    }
    judge_strip({triangle, edges, plane, west_edges, east_edges, south, north, origin_x, origin_y,
                 std::max(first, 0), std::min(last, last_column - 1)});
  }
}

void Overlay::judge_strip(const Strip& strip) {
  const Row& south = strip.south;
  const Row& north = strip.north;
  // Cells with all four samples inside the triangle.
  const int first = std::max(south.first, north.first);
  const int last = std::min(south.last, north.last) - 1;
  if (first > last || !south.meets || !north.meets) {
    return judge_cells(strip, strip.first_cell, strip.last_cell, 0b111);
  }
  if (cells_ == nullptr) {
    judge_whole_cells(strip, first, last);
  } else {
    const std::uint8_t* const cells =
        cells_ + static_cast<std::ptrdiff_t>(strip.origin_y + south.y) * (columns_ - 1) + strip.origin_x;
    const auto run_end = [&](int from, bool in_run) {
      return static_cast<int>(std::find_if(cells + from, cells + last + 1,
                                           [&](std::uint8_t cell) { return (cell != 0) != in_run; }) -
                              cells);
    };
    for (int x = run_end(first, false); x <= last;) {
      const int end = run_end(x, true);
      judge_whole_cells(strip, x, end - 1);
      x = run_end(end, false);
    }
  }
  // West of a whole cell, an edge that faces east has all samples inside: only edges that face west can cut.
  judge_cells(strip, strip.first_cell, first - 1, strip.west_edges);
  judge_cells(strip, last + 1, strip.last_cell, strip.east_edges);
}

void Overlay::judge_whole_cells(const Strip& strip, int first, int last) {
  const double most =
      sums_.add_cells(strip.plane, strip.south.errors, strip.north.errors, first, last - first + 1);
  if (most >= sample_peak_.value) visit_samples(strip, first, last + 1, most);
}

/// Cells that some edge of the mask may cut.
void Overlay::judge_cells(const Strip& strip, int first, int last, unsigned edge_mask) {
  for (int x = first; x <= last; ++x) {
    if (!judged(strip.origin_x + x, strip.origin_y + strip.south.y)) continue;
    const CellErrors errors{strip.south.errors.at(strip.plane, x), strip.south.errors.at(strip.plane, x + 1),
                            strip.north.errors.at(strip.plane, x + 1), strip.north.errors.at(strip.plane, x)};
    judge_half(strip, errors, Half::southeast, x, edge_mask);
    judge_half(strip, errors, Half::northwest, x, edge_mask);
  }
}

inline void Overlay::judge_half(const Strip& strip, const CellErrors& errors, Half half, int x,
                                unsigned edge_mask) {
  const bool southeast = half == Half::southeast;
  std::array<double, 3> cutting{};
  std::array<bool, 3> outside{};  // samples of this half; told only where more than one edge cuts it
  int cuts = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if ((edge_mask >> k & 1u) == 0) continue;
    const Edge& edge = strip.edges[k];
    const auto snapped = [&](double d) { return std::fabs(d) <= edge.noise ? 0.0 : d; };
    const double west = edge.by_x * x;
    const double east = edge.by_x * (x + 1);
    const double base_south = strip.south.base[k];
    const double base_north = strip.north.base[k];
    const std::array<double, 3> distance{snapped(west + base_south),
                                         snapped(southeast ? east + base_south : east + base_north),
                                         snapped(southeast ? east + base_north : west + base_north)};
    const double least = std::min(std::min(distance[0], distance[1]), distance[2]);
    if (least >= 0) continue;
    // No area inside: what the triangle touches here is the rim of other halves.
    if (std::max(std::max(distance[0], distance[1]), distance[2]) <= 0) return;
    if (cuts > 0) {
      for (std::size_t n = 0; n < 3; ++n) outside[n] = outside[n] || cutting[n] < 0 || distance[n] < 0;
    }
    cutting = distance;
    ++cuts;
  }
  if (cuts == 1) return cut_by_one(strip, errors, half, x, cutting);
  if (cuts > 1) {
    const std::array<std::size_t, 3>& sample = southeast ? kSoutheast : kNorthwest;
    for (std::size_t n = 0; n < 3; ++n) {
      if (outside[n]) continue;
      aside_peak_.visit(std::fabs(errors[sample[n]]), strip.origin_x + x + kSampleX[sample[n]],
                        strip.origin_y + strip.south.y + kSampleY[sample[n]]);
    }
    return clip_to_half(strip.triangle, strip.origin_x + x, strip.origin_y + strip.south.y, half);
  }
  const double middle = southeast ? errors[1] : errors[3];
  sums_.add_triangle(errors[0], middle, errors[2], 1);
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}, southeast ? std::size_t{1} : std::size_t{3}}) {
    visit_sample(strip, x, k, errors[k]);
  }
}

/// A half cell cut by one line, with corners on both sides. With d the corners' distances to the line, it
/// crosses the side from p to q at the share d_p/(d_p − d_q), and the error there follows, being linear over
/// the half.
inline void Overlay::cut_by_one(const Strip& strip, const CellErrors& errors, Half half, int x,
                                const std::array<double, 3>& distance) {
  const std::array<std::size_t, 3>& sample = half == Half::southeast ? kSoutheast : kNorthwest;
  int inside = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (distance[k] >= 0) visit_sample(strip, x, sample[k], errors[sample[k]]);
    inside += distance[k] > 0 ? 1 : 0;
  }
  // `apex` stands alone strictly on its side of the line; p and q follow it counter-clockwise.
  const bool apex_inside = inside == 1;
  std::size_t apex = 0;
  while (apex_inside ? distance[apex] <= 0 : distance[apex] >= 0) ++apex;
  const std::size_t p = apex == 2 ? 0 : apex + 1;
  const std::size_t q = apex == 0 ? 2 : apex - 1;
  const double error = errors[sample[apex]];
  const double to_p = distance[apex] / (distance[apex] - distance[p]);
  const double to_q = distance[apex] / (distance[apex] - distance[q]);
  const double at_p = error + to_p * (errors[sample[p]] - error);
  const double at_q = error + to_q * (errors[sample[q]] - error);
  if (apex_inside) {
    sums_.add_triangle(error, at_p, at_q, to_p * to_q);
  } else {
    sums_.add_triangle(errors[sample[p]], errors[sample[q]], at_q, 1 - to_q);
    sums_.add_triangle(errors[sample[p]], at_q, at_p, to_q * (1 - to_p));
  }
  if (std::fabs(at_p) >= certain_peak_.value) visit_crossing(strip, x, sample[apex], sample[p], at_p, to_p);
  if (std::fabs(at_q) >= certain_peak_.value) visit_crossing(strip, x, sample[apex], sample[q], at_q, to_q);
}

inline void Overlay::visit_sample(const Strip& strip, int x, std::size_t sample, double error) {
  if (std::fabs(error) < sample_peak_.value) return;
  visit_at_sample(error, strip.origin_x + x + kSampleX[sample],
                  strip.origin_y + strip.south.y + kSampleY[sample]);
}

/// A mesh edge crosses the side between two samples of a cell, at this share of the way.
void Overlay::visit_crossing(const Strip& strip, int x, std::size_t from, std::size_t to, double error,
                             double share) {
  const int along_x = kSampleX[to] - kSampleX[from];
  const int along_y = kSampleY[to] - kSampleY[from];
  const double at_x = strip.origin_x + (x + (kSampleX[from] + share * along_x));
  const double at_y = strip.origin_y + (strip.south.y + (kSampleY[from] + share * along_y));
  if (along_x != 0 && along_y != 0) {
    visit_declared(error, at_x, at_y);
  } else {
    visit_everywhere(error, at_x, at_y);
  }
}

/// Finds where among the samples first … last of both rows the greatest error stands.
void Overlay::visit_samples(const Strip& strip, int first, int last, double most) {
  for (const Row* row : {&strip.south, &strip.north}) {
    const double at_y = strip.origin_y + row->y;
    if (!certain_peak_.admits(most, strip.origin_x + first, at_y) &&
        !peak_.admits(most, strip.origin_x + first, at_y) &&
        !sample_peak_.admits(most, strip.origin_x + first, at_y)) {
      continue;
    }
    for (int x = first; x <= last; ++x) {
      if (std::fabs(row->errors.at(strip.plane, x)) != most) continue;
      visit_at_sample(most, strip.origin_x + x, at_y);
      break;
    }
  }
}

}  // namespace plumbline::oracle::detail
