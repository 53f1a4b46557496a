// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "scenarios/height_grid.h"
#include "scenarios/local_frame.h"
#include "scenarios/vec.h"

namespace plumbline {

/// Where a raster's samples stand.
struct RasterFrame {
  int columns = 0, rows = 0;
  bool georeferenced = false;  ///< false: no geotransform; steps are 1
  bool geographic = false;     ///< steps in radians of longitude and latitude; otherwise metres
  double step_x = 1, step_y = 1;
  Geographic south_west;  ///< geographic: the sample (0, 0)
  double semi_major_m = 0, inverse_flattening = 0;
  bool rows_from_north = true;     ///< the file's first row is the northmost
  bool columns_from_east = false;  ///< its first column is the eastmost
  /// Sample (0, 0) and the steps again, as the file has them: in the CRS's own unit, which is `own_unit`
  /// metres (geographic: radians).
  Vec2 own_origin;
  Vec2 own_step{1, 1};
  double own_unit = 1;
  std::string crs;          ///< its name; empty: none
  std::string height_unit;  ///< as the file names it; empty: not said, taken as metres
  double height_unit_m = 1;
};

/// Band 1 of a raster that GDAL opens. GDAL's own messages never reach the terminal: they become part of the
/// one line of an InputError, which names the terrain and the file.
class RasterReader {
 public:
  /// Opens the file and reads its header. Refuses (InputError) what cannot become a terrain, before anything
  /// of the raster's size is allocated: no band, complex samples, sides beyond 2²⁰, more than 2³² samples,
  /// storage blocks over 1 GiB, a rotated or singular geotransform, a vertical unit that is neither metres
  /// nor feet.
  RasterReader(const std::string& terrain_id, const std::filesystem::path& file);
  ~RasterReader();
  RasterReader(const RasterReader&) = delete;
  RasterReader& operator=(const RasterReader&) = delete;

  [[nodiscard]] const RasterFrame& frame() const;

  /// Every `step`-th sample of the window (in our order: row 0 southmost), in metres; holes are NaN. Throws
  /// InputError if the file ends early or GDAL complains otherwise.
  [[nodiscard]] HeightGrid read(GridWindow window, int step) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline
