// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to O2 (vertical.h): one mesh triangle over the grid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "oracle/vertical_pieces.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle::detail {

/// A corner in plan units of one cell: x = column, y = row (fractions between samples); z in metres.
struct GridPoint {
  double x = 0, y = 0, z = 0;
};
using GridTriangle = std::array<GridPoint, 3>;

/// Coordinates up to this many cells are taken as they are: products of two keep 53-bit accuracy to 2⁻⁸ of a
/// cell times a cell, sums to less, and an int holds any of them. Beyond, triangles are cut to the grid
/// first.
inline constexpr double kFarCells = 0x1p22;

/// The part of a triangle (corners in metres, counter-clockwise) over the grid, as triangles; cut in exact
/// arithmetic, then rounded.
std::vector<GridTriangle> cut_to_grid(const std::array<Vec3, 3>& triangle, const Terrain& terrain);

/// Visits every piece of (triangle ∩ grid) and gathers sums and peaks. One object judges one mesh.
class Overlay {
 public:
  /// `cells`: one byte a cell, rows from the south, 0 where nothing is to be judged; null: judge them all.
  Overlay(const Terrain& terrain, const std::uint8_t* cells);

  /// Requires: counter-clockwise, coordinates at most kFarCells from 0.
  void judge(const GridTriangle& triangle);
  /// Says that a triangle comes next, so that its first samples are near when it is judged. Changes no
  /// figure.
  void expect(const GridTriangle& triangle) const;
  void finish() {
    sums_.finish();
    if (aside_peak_.value >= 0) sample_peak_.visit(aside_peak_.value, aside_peak_.x, aside_peak_.y);
  }

  [[nodiscard]] const PieceSums& sums() const { return sums_; }
  [[nodiscard]] const Peak& peak() const { return peak_; }
  [[nodiscard]] const Peak& certain_peak() const { return certain_peak_; }
  /// Over the samples alone; value −1: none lies under the mesh. After finish().
  [[nodiscard]] const Peak& sample_peak() const { return sample_peak_; }

 private:
  struct Edge;
  struct Row;
  struct Strip;
  using CellErrors = std::array<double, 4>;  ///< at the south-west, south-east, north-east, north-west sample
  enum class Half { southeast, northwest };

  // vertical_overlay.cpp: triangles at least an eighth of a cell high, row by row.
  static Edge make_edge(const GridPoint& from, const GridPoint& to);
  static Plane fit_plane(const GridTriangle& local);
  static void cross_row(Row& row, const std::array<Edge, 3>& edges, int last_column);
  bool judge_one_cell(const GridTriangle& triangle);
  void judge_rows(const GridTriangle& triangle);
  void judge_strip(const Strip& strip);
  void judge_whole_cells(const Strip& strip, int first, int last);
  void judge_cells(const Strip& strip, int first, int last, unsigned edge_mask);
  void judge_half(const Strip& strip, const CellErrors& errors, Half half, int x, unsigned edge_mask);
  void cut_by_one(const Strip& strip, const CellErrors& errors, Half half, int x,
                  const std::array<double, 3>& distance);
  void visit_samples(const Strip& strip, int first, int last, double most);
  void visit_sample(const Strip& strip, int x, std::size_t sample, double error);
  void visit_crossing(const Strip& strip, int x, std::size_t from, std::size_t to, double error,
                      double share);

  // vertical_slivers.cpp: what is left: thin triangles, cells cut by two edges, corners between samples.
  void judge_corners(const GridTriangle& triangle);
  void judge_sliver(const GridTriangle& triangle);
  void judge_sliver_samples(const GridTriangle& triangle, int row);
  void clip_to_half(const GridTriangle& triangle, int column, int row, Half half);

  [[nodiscard]] bool judged(int column, int row) const {
    return cells_ == nullptr || cells_[static_cast<std::ptrdiff_t>(row) * (columns_ - 1) + column] != 0;
  }
  /// Whether a cell around this sample is judged.
  [[nodiscard]] bool judged_around(int i, int j) const;

  void visit_at_sample(double error, double x, double y) {
    visit_everywhere(error, x, y);
    if (std::fabs(error) >= sample_peak_.value) sample_peak_.visit(std::fabs(error), x, y);
  }
  void visit_everywhere(double error, double x, double y) {
    const double size = std::fabs(error);
    if (size >= certain_peak_.value) certain_peak_.visit(size, x, y);
    if (size >= peak_.value) peak_.visit(size, x, y);
  }
  void visit_declared(double error, double x, double y) {
    const double size = std::fabs(error);
    if (size >= peak_.value) peak_.visit(size, x, y);
  }

  const Terrain& terrain_;
  const int columns_, rows_;
  PieceSums sums_;
  const std::uint8_t* const cells_;
  Peak peak_, certain_peak_;
  Peak sample_peak_;  ///< never above certain_peak_: what enters here has entered there
  Peak aside_peak_;   ///< samples whose error is evaluated for this figure alone
};

}  // namespace plumbline::oracle::detail
