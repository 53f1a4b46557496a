// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/vertical_pieces.h"

namespace plumbline::oracle::detail {

double PieceSums::add_cells(const Plane& plane, const RowErrors& south, const RowErrors& north, int first,
                            int count) {
  Pair squares = cell_squares_;
  Pair absolutes = cell_absolutes_;
  Pair lowest{}, highest{};
  const auto add = [&](Pair a, Pair b, Pair c, Pair d) {
    const Pair diagonal = a + c;
    const Pair southeast = diagonal + b;
    const Pair northwest = diagonal + d;
    squares += (southeast * southeast + northwest * northwest) + ((b * b + d * d) + 2 * (a * a + c * c));
    const Pair diagonal_low = lesser(a, c);
    const Pair diagonal_high = greater(a, c);
    const Pair southeast_low = lesser(b, diagonal_low);
    const Pair southeast_high = greater(b, diagonal_high);
    const Pair northwest_low = lesser(d, diagonal_low);
    const Pair northwest_high = greater(d, diagonal_high);
    lowest = lesser(lowest, lesser(southeast_low, northwest_low));
    highest = greater(highest, greater(southeast_high, northwest_high));
    absolutes += absolute_term(southeast_low, greater(diagonal_low, lesser(b, diagonal_high)), southeast_high,
                               southeast) +
                 absolute_term(northwest_low, greater(diagonal_low, lesser(d, diagonal_high)), northwest_high,
                               northwest);
  };
  const double* s = south.heights + first;
  const double* n = north.heights + first;
  Pair columns{static_cast<double>(first), static_cast<double>(first + 1)};
  int left = count;
  for (; left >= 2; left -= 2, s += 2, n += 2, columns += 2) {
    const Pair west = plane.by_x * columns;
    const Pair east = plane.by_x * (columns + 1);
    add((west + south.row_height) - (load(s) - plane.base_m),
        (east + south.row_height) - (load(s + 1) - plane.base_m),
        (east + north.row_height) - (load(n + 1) - plane.base_m),
        (west + north.row_height) - (load(n) - plane.base_m));
  }
  if (left == 1) {  // its halves side by side
    const int x = first + count - 1;
    const double shared = south.at(plane, x), opposite = north.at(plane, x + 1);
    const Pair a{shared, shared};
    const Pair b{south.at(plane, x + 1), opposite};
    const Pair c{opposite, north.at(plane, x)};
    const Pair sum = a + b + c;
    const Pair low = lesser(a, b), high = greater(a, b);
    const Pair least = lesser(low, c), most = greater(high, c);
    squares += 2 * square_term(a, b, c, sum);
    absolutes += absolute_term(least, greater(low, lesser(high, c)), most, sum);
    lowest = lesser(lowest, least);
    highest = greater(highest, most);
  }
  cell_squares_ = squares;
  cell_absolutes_ = absolutes;
  whole_cells_ += static_cast<std::size_t>(count);
  cells_in_lanes_ += count;
  if (cells_in_lanes_ >= kCellsPerLane) flush_cells();
  const Pair most = greater(highest, -lowest);
  return most[0] > most[1] ? most[0] : most[1];
}

void PieceSums::flush_cells() {
  for (const std::size_t lane : {0, 1}) {
    square_.add(0.5 * cell_squares_[lane]);
    absolute_.add(cell_absolutes_[lane]);
  }
  cell_squares_ = Pair{};
  cell_absolutes_ = Pair{};
  cells_in_lanes_ = 0;
}

void PieceSums::flush_triangles() {
  if (waiting_ % 2 != 0) a_[waiting_] = b_[waiting_] = c_[waiting_] = twice_area_[waiting_] = 0;
  Pair squares{}, absolutes{}, areas{};
  for (std::size_t k = 0; k < waiting_; k += 2) {
    const Pair a = load(&a_[k]);
    const Pair b = load(&b_[k]);
    const Pair c = load(&c_[k]);
    const Pair weight = load(&twice_area_[k]);
    const Pair sum = a + b + c;
    const Pair low = lesser(a, b);
    const Pair high = greater(a, b);
    squares += weight * square_term(a, b, c, sum);
    absolutes += weight * absolute_term(lesser(low, c), greater(low, lesser(high, c)), greater(high, c), sum);
    areas += weight;
  }
  for (const std::size_t lane : {0, 1}) {
    square_.add(squares[lane]);
    absolute_.add(absolutes[lane]);
    twice_area_sum_.add(areas[lane]);
  }
  waiting_ = 0;
}

void PieceSums::finish() {
  flush_cells();
  flush_triangles();
}

}  // namespace plumbline::oracle::detail
