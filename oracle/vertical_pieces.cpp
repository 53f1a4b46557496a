// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/vertical_pieces.h"

namespace plumbline::oracle::detail {

namespace {

/// Errors at columns x and x + 1, as RowErrors::at has them.
Pair errors_at(const RowErrors& row, int x, Pair columns) {
  return (row.by_x * columns + row.row_height) - (load(row.heights + x) - row.base_m);
}

}  // namespace

double PieceSums::add_cells(const RowErrors& south, const RowErrors& north, int first, int count) {
  Pair squares = cell_squares_;
  Pair absolutes = cell_absolutes_;
  Pair lowest{}, highest{};
  const auto add = [&](Pair a, Pair b, Pair c, Pair d) {
    const Pair low = lesser(lesser(a, b), lesser(c, d));
    const Pair high = greater(greater(a, b), greater(c, d));
    lowest = lesser(lowest, low);
    highest = greater(highest, high);
    const Pair diagonal = a + c;
    const Pair southeast = diagonal + b;
    const Pair northwest = diagonal + d;
    squares += (southeast * southeast + northwest * northwest) + ((b * b + d * d) + 2 * (a * a + c * c));
    absolutes += absolute_term(a, b, c, southeast) + absolute_term(a, c, d, northwest);
  };
  int x = first;
  const int end = first + count;
  Pair columns{static_cast<double>(x), static_cast<double>(x + 1)};
  for (; x + 1 < end; x += 2) {
    const Pair next = columns + 1;
    add(errors_at(south, x, columns), errors_at(south, x + 1, next), errors_at(north, x + 1, next),
        errors_at(north, x, columns));
    columns += 2;
  }
  if (x < end) {  // one cell is left; the other lane adds nothing
    add(Pair{south.at(x), 0}, Pair{south.at(x + 1), 0}, Pair{north.at(x + 1), 0}, Pair{north.at(x), 0});
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
    squares += weight * square_term(a, b, c);
    absolutes += weight * absolute_term(a, b, c, a + b + c);
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
