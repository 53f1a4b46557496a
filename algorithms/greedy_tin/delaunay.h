// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace plumbline::greedy_tin {

/// A sample of the grid: column and row.
struct Sample {
  int i = 0, j = 0;
};

/// The Delaunay triangulation of some samples of a grid of `columns` × `rows`, to which samples are added one
/// by one; at first the four corners. Exact on the integer grid. Four samples on one circle are triangulated
/// as if the eastmost of them, then the southmost, lay just outside: the triangulation is a function of the
/// set of samples, in whatever order they came, and a cell with all corners is split by the reference's
/// diagonal.
class Delaunay {
 public:
  Delaunay(int columns, int rows);
  ~Delaunay();
  Delaunay(const Delaunay&) = delete;
  Delaunay& operator=(const Delaunay&) = delete;

  /// Triangles have numbers from 0 on that stay theirs; a number's triangle changes as samples are added.
  /// Adds a sample that is not yet a vertex, near triangle `near`, and puts the numbers of the new and
  /// changed triangles into `changed`: those around the sample. Others are as before.
  void insert(Sample sample, std::uint32_t near, std::vector<std::uint32_t>& changed);
  /// Triangles' corners, counter-clockwise seen from above, the least sample index (row-major) first.
  [[nodiscard]] std::array<Sample, 3> corners(std::uint32_t triangle) const;
  [[nodiscard]] std::size_t triangle_count() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumbline::greedy_tin
