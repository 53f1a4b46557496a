// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "scenarios/terrain_source.h"

namespace plumbline {

/// Heights as a raster holds them, on the way to a terrain: any spacing, holes still in it (NaN).
struct HeightGrid {
  int columns = 0, rows = 0;
  std::vector<double> heights_m;  ///< row-major, row 0 southmost, column 0 westmost; NaN: hole

  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
  }
  [[nodiscard]] double z(int i, int j) const { return heights_m[index(i, j)]; }
  /// Bilinear interpolation at column u, row v (fractions between samples), clamped to the grid. At a sample
  /// its height, bit for bit. Requires: no holes, 2 × 2 samples.
  [[nodiscard]] double interpolated(double u, double v) const;
  [[nodiscard]] std::size_t count_holes() const;
};

/// The part of a grid from column i, row j.
struct GridWindow {
  int i = 0, j = 0, columns = 0, rows = 0;
};
HeightGrid cut(const HeightGrid& grid, GridWindow window);

/// The largest window without a hole; of equals the southmost, then the westmost. Linear in samples (largest
/// rectangle under each row's histogram of hole-free run lengths).
GridWindow largest_window_without_holes(const HeightGrid& grid);

/// Fills the holes from their rims: averages over ever coarser grids, then down again, each hole sample
/// interpolated from the coarser grid ("pull-push": Gortler et al., The Lumigraph, SIGGRAPH 1996,
/// section 3.4) and relaxed a few times towards the mean of its four neighbours. Samples with data keep their
/// bits. Linear in samples. Requires: one sample with data.
void fill_holes(HeightGrid& grid);

}  // namespace plumbline
