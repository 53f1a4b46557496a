// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/dem.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/height_grid.h"
#include "scenarios/local_frame.h"
#include "scenarios/portable_math.h"
#include "scenarios/raster_reader.h"
#include "scenarios/terrain_source.h"

namespace plumbline {
namespace {

constexpr const char* kId = "DEM";

[[noreturn]] void refuse(const DemRequest& request, const std::string& what) {
  throw InputError(fmt::format("DEM {}: {}", one_line(request.file.string(), 400), what));
}

void check_size(const DemRequest& request, const RasterFrame& frame) {
  if (std::max(frame.columns, frame.rows) <= kMostSamplesASide) return;
  refuse(request,
         fmt::format("has {} x {} samples, at most {} a side are checked; cut the mesh's window out: "
                     "gdal_translate -srcwin COLUMN ROW {} {} IN OUT",
                     frame.columns, frame.rows, kMostSamplesASide, std::min(frame.columns, kMostSamplesASide),
                     std::min(frame.rows, kMostSamplesASide)));
}

bool any_cell_with_data(const HeightGrid& grid) {
  for (int j = 0; j + 1 < grid.rows; ++j) {
    for (int i = 0; i + 1 < grid.columns; ++i) {
      // NaN if one of them is.
      if (!std::isnan(grid.z(i, j) + grid.z(i + 1, j) + grid.z(i, j + 1) + grid.z(i + 1, j + 1))) return true;
    }
  }
  return false;
}

void check_heights(const DemRequest& request, const HeightGrid& grid) {
  for (const double z : grid.heights_m) {
    if (std::fabs(z) > kHighestM) {
      refuse(request, fmt::format("holds a height of {} m; declare the raster's no-data value "
                                  "(gdal_edit.py -a_nodata)",
                                  z));
    }
  }
}

/// Settles the holes; returns which part of the file is kept.
GridWindow settle_holes(const DemRequest& request, HeightGrid& grid, Dem& dem) {
  GridWindow kept{0, 0, grid.columns, grid.rows};
  dem.holes = grid.count_holes();
  if (dem.holes == 0) return kept;
  if (!any_cell_with_data(grid)) refuse(request, "no 2 x 2 samples hold data; give another raster or window");
  switch (request.holes) {
    case DemHoles::refuse:
      refuse(request, fmt::format("{} of {} samples hold no data; say --holes leave_out, crop or fill",
                                  dem.holes, grid.heights_m.size()));
    case DemHoles::crop:
      kept = largest_window_without_holes(grid);
      if (kept.columns < 2 || kept.rows < 2) {
        refuse(request, "its largest rectangle without a hole is a line; say --holes leave_out or fill");
      }
      grid = cut(grid, kept);
      return kept;
    case DemHoles::leave_out:
      dem.has_data.reserve(grid.heights_m.size());
      for (const double z : grid.heights_m) dem.has_data.push_back(std::isnan(z) ? 0 : 1);
      break;
    case DemHoles::fill:
      break;
  }
  fill_holes(grid);
  return kept;
}

void place(const DemRequest& request, const RasterFrame& frame, GridWindow kept, Dem& dem) {
  dem.georeferenced = frame.georeferenced;
  dem.geographic = frame.geographic;
  // Metres, or degrees; a CRS in those keeps its bits.
  const double unit = !frame.geographic                     ? frame.own_unit
                      : frame.own_unit == kRadiansPerDegree ? 1
                                                            : frame.own_unit / kRadiansPerDegree;
  dem.crs_unit_m = frame.geographic ? 1 : frame.own_unit;
  dem.step_x = frame.own_step.x * unit;
  dem.step_y = frame.own_step.y * unit;
  dem.origin = {(frame.own_origin.x + kept.i * frame.own_step.x) * unit,
                (frame.own_origin.y + kept.j * frame.own_step.y) * unit};
  if (!frame.georeferenced) dem.origin = {0, 0};
  dem.metres_x = dem.step_x;
  dem.metres_y = dem.step_y;
  if (frame.geographic) {
    const Geographic middle{
        frame.south_west.longitude + 0.5 * (frame.columns - 1) * frame.step_x,
        std::clamp(frame.south_west.latitude + 0.5 * (frame.rows - 1) * frame.step_y, -kPi / 2, kPi / 2)};
    const LocalFrame local(middle, frame.semi_major_m, frame.inverse_flattening);
    dem.metres_x = local.parallel_radius_m() * frame.step_x;
    dem.metres_y = local.meridian_radius_m() * frame.step_y;
  }
  for (const double step : {dem.step_x, dem.step_y, dem.metres_x, dem.metres_y}) {
    if (!(step > 0) || !std::isfinite(step) || !std::isfinite(dem.origin.x + dem.origin.y)) {
      refuse(request, "stands where its samples have no size in metres; mend its georeference");
    }
  }
  dem.file_low = {static_cast<double>(-kept.i), static_cast<double>(-kept.j)};
  dem.file_high = {static_cast<double>(frame.columns - 1 - kept.i),
                   static_cast<double>(frame.rows - 1 - kept.j)};
}

std::string spacing_in_words(const Dem& dem) {
  if (dem.geographic) {
    return fmt::format("{} x {} degrees apart ({:.2f} x {:.2f} m in the middle)", dem.step_x, dem.step_y,
                       dem.metres_x, dem.metres_y);
  }
  return dem.georeferenced ? fmt::format("{} x {} m apart", dem.step_x, dem.step_y)
                           : "not georeferenced: taken as 1 m apart";
}

std::string crs_in_words(const RasterFrame& frame) {
  if (!frame.georeferenced) return "";
  if (frame.crs.empty()) return ", no CRS: taken as metres";
  return frame.crs == "unnamed" || frame.crs == "unknown" ? ", a CRS without a name" : ", " + frame.crs;
}

std::string rows_in_words(const RasterFrame& frame) {
  std::string words = !frame.georeferenced ? "the file's first row is taken as the northmost"
                      : frame.rows_from_north
                          ? "the file's first row is the northmost, as its georeference says"
                          : "the file's first row is the southmost, as its georeference says";
  if (frame.columns_from_east) words += ", its first column the eastmost";
  return words;
}

std::string holes_in_words(const Dem& dem, DemHoles policy, std::size_t samples) {
  if (dem.holes == 0) return "every sample holds data";
  const std::string count = fmt::format("{} of {} samples hold no data", dem.holes, samples);
  switch (policy) {
    case DemHoles::leave_out:
      return count + ", the cells around them are left out";
    case DemHoles::crop:
      return fmt::format("{}, cut to the largest rectangle without a hole, {} x {}", count,
                         dem.samples.columns, dem.samples.rows);
    case DemHoles::fill:
      return count + ", filled from their rims and judged as if they did";
    case DemHoles::refuse:
      break;
  }
  return count;
}

}  // namespace

Dem read_dem(const DemRequest& request) {
  const RasterReader reader(kId, request.file);
  const RasterFrame& frame = reader.frame();
  check_size(request, frame);
  HeightGrid grid = reader.read({0, 0, frame.columns, frame.rows}, 1);
  check_heights(request, grid);
  Dem dem;
  const GridWindow kept = settle_holes(request, grid, dem);
  place(request, frame, kept, dem);
  dem.samples.id = kId;
  dem.samples.columns = grid.columns;
  dem.samples.rows = grid.rows;
  dem.samples.heights_m = std::move(grid.heights_m);
  const std::size_t samples = static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows);
  dem.description = fmt::format(
      "{}: {} x {} samples, {}{}; {}; samples are points at the centres of the file's cells; heights in {}; "
      "{}",
      one_line(request.file.filename().string(), 100), frame.columns, frame.rows, spacing_in_words(dem),
      crs_in_words(frame), rows_in_words(frame),
      frame.height_unit_m == 1 ? "metres" : fmt::format("'{}', turned into metres", frame.height_unit),
      holes_in_words(dem, request.holes, samples));
  return dem;
}

Dem resampled_dem(const DemRequest& request) {
  TerrainSource source;
  source.id = kId;
  source.file = request.file;
  source.holes = request.holes == DemHoles::refuse ? HolePolicy::refuse
                 : request.holes == DemHoles::fill ? HolePolicy::fill
                                                   : HolePolicy::crop;
  Dem dem;
  dem.samples = load_terrain(source);
  dem.resampled = true;
  dem.step_x = dem.step_y = dem.metres_x = dem.metres_y = dem.samples.spacing_m;
  dem.file_high = {static_cast<double>(dem.samples.columns - 1), static_cast<double>(dem.samples.rows - 1)};
  dem.description = fmt::format(
      "{}: resampled to plumbline's local frame, {} x {} samples, {} m apart, x east and y north of the "
      "south-west sample{}",
      one_line(request.file.filename().string(), 100), dem.samples.columns, dem.samples.rows,
      dem.samples.spacing_m,
      source.holes == HolePolicy::crop ? "; cut to the largest rectangle without a hole, if there are any"
                                       : "");
  dem.samples.spacing_m = 1;
  return dem;
}

std::string reading_in_words(const Dem& dem, double diagonal_ambiguity_m) {
  return fmt::format(
      "{}; each cell is split from south-west to north-east: between samples the DEM itself is ambiguous by "
      "up "
      "to {:.3g} m",
      dem.description, diagonal_ambiguity_m);
}

std::optional<double> height_where_data_m(const Terrain& terrain, std::span<const std::uint8_t> has_data,
                                          Vec2 at) {
  // Written so that NaN is outside.
  if (!(at.x >= 0 && at.y >= 0 && at.x <= terrain.columns - 1 && at.y <= terrain.rows - 1)) return {};
  if (!has_data.empty()) {
    const int i = std::min(static_cast<int>(at.x), terrain.columns - 2);
    const int j = std::min(static_cast<int>(at.y), terrain.rows - 2);
    for (const std::size_t k : {terrain.index(i, j), terrain.index(i + 1, j), terrain.index(i, j + 1),
                                terrain.index(i + 1, j + 1)}) {
      if (has_data[k] == 0) return {};
    }
  }
  return terrain.surface_height_m(at.x * terrain.spacing_m, at.y * terrain.spacing_m);
}

}  // namespace plumbline
