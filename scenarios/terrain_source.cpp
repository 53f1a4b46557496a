// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/terrain_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/generators.h"
#include "scenarios/height_grid.h"
#include "scenarios/local_frame.h"
#include "scenarios/portable_math.h"
#include "scenarios/raster_reader.h"
#include "scenarios/roads.h"
#include "scenarios/scattered_points.h"

namespace plumbline {
namespace {

constexpr double kLargestSpanRad = 6 * kRadiansPerDegree;  // what the series of LocalFrame are good for
constexpr double kHighestLatitudeRad =
    86 * kRadiansPerDegree;  // beyond, columns of equal longitude run to a point
constexpr double kSquareWithin =
    1e-6;  // spacings this near to each other (relative) are one: half a sample in 2^19

[[noreturn]] void refuse(const TerrainSource& source, const std::string& what) {
  throw InputError(fmt::format("terrain '{}': {}", source.id, what));
}

// The samples asked for: centred in an extent, spacing_m apart.
struct Layout {
  int columns = 0, rows = 0;
  double spacing_m = 1;
};

// Fits a layout into an extent of metres, by the rules of TerrainSource.
Layout lay_out(const TerrainSource& source, double width_m, double depth_m, double native_spacing_m) {
  constexpr double kRounding = 1e-9;  // an extent of 10 spacings less this much still has 11 samples
  const bool keeps_spacing = source.fit == FitRule::crop && source.size;
  const double spacing_m = keeps_spacing ? native_spacing_m : source.spacing_m.value_or(native_spacing_m);
  if (source.size) {
    const double side_m = std::min(width_m, depth_m);
    if (!keeps_spacing && !source.spacing_m) return {*source.size, *source.size, side_m / (*source.size - 1)};
    if ((*source.size - 1) * spacing_m > side_m * (1 + kRounding)) {
      refuse(source, fmt::format("{} samples at {} m need {} m, the data covers {} x {} m; make size{} less",
                                 *source.size, spacing_m, (*source.size - 1) * spacing_m, width_m, depth_m,
                                 keeps_spacing ? "" : " or spacing_m"));
    }
    return {*source.size, *source.size, spacing_m};
  }
  const double columns = std::floor(width_m / spacing_m * (1 + kRounding)) + 1;
  const double rows = std::floor(depth_m / spacing_m * (1 + kRounding)) + 1;
  if (columns > kMostSamplesASide || rows > kMostSamplesASide || columns < 2 || rows < 2) {
    refuse(source,
           fmt::format("would have {} x {} samples at {} m; give a size or spacing_m for 2 to {} a side",
                       columns, rows, spacing_m, kMostSamplesASide));
  }
  return {static_cast<int>(columns), static_cast<int>(rows), spacing_m};
}

HeightGrid without_holes(const TerrainSource& source, HeightGrid grid) {
  const std::size_t holes = grid.count_holes();
  if (holes == 0) return grid;
  if (holes == grid.heights_m.size()) refuse(source, "no sample holds data; give another raster or window");
  switch (source.holes) {
    case HolePolicy::refuse:
      refuse(source, fmt::format("{} of {} samples hold no data; say holes = \"crop\" or \"fill\"", holes,
                                 grid.heights_m.size()));
    case HolePolicy::crop: {
      const GridWindow window = largest_window_without_holes(grid);
      if (window.columns < 2 || window.rows < 2)
        refuse(source, "no 2 x 2 samples without a hole; say holes = \"fill\"");
      return cut(grid, window);
    }
    case HolePolicy::fill:
      fill_holes(grid);
  }
  return grid;
}

// Samples on a metric grid, without holes, to a terrain.
Terrain fit_metric(const TerrainSource& source, HeightGrid grid, double step_x_m, double step_y_m,
                   bool resample_to_spacing) {
  const double native_m = (step_x_m + step_y_m) / 2;
  const bool square = std::fabs(step_x_m - step_y_m) <= kSquareWithin * native_m;
  Terrain terrain;
  if (square && !resample_to_spacing) {
    // In whole samples, so that heights keep their bits where nothing needs interpolating.
    const bool crop = source.fit == FitRule::crop;
    const int side = std::min(grid.columns, grid.rows);
    const int kept = !source.size ? 0 : crop ? *source.size : side;
    if (kept > side) {
      refuse(source,
             fmt::format(
                 "has {} x {} samples; {} a side cannot be cropped, use fit = \"resample\" or a lesser size",
                 grid.columns, grid.rows, kept));
    }
    if (kept > 0) grid = cut(grid, {(grid.columns - kept) / 2, (grid.rows - kept) / 2, kept, kept});
    if (!source.size || *source.size == grid.columns) {
      if (std::max(grid.columns, grid.rows) > kMostSamplesASide) {
        refuse(source, fmt::format("has {} x {} samples, more than {} a side; give a size", grid.columns,
                                   grid.rows, kMostSamplesASide));
      }
      terrain.columns = grid.columns;
      terrain.rows = grid.rows;
      terrain.spacing_m = native_m;
      terrain.heights_m = std::move(grid.heights_m);
      return terrain;
    }
    const int last = *source.size - 1;
    terrain.columns = terrain.rows = last + 1;
    terrain.spacing_m = native_m * (kept - 1) / last;
    for (int j = 0; j <= last; ++j) {
      const double v = static_cast<double>(j) * (kept - 1) / last;
      for (int i = 0; i <= last; ++i) {
        terrain.heights_m.push_back(grid.interpolated(static_cast<double>(i) * (kept - 1) / last, v));
      }
    }
    return terrain;
  }
  const Layout layout = lay_out(source, (grid.columns - 1) * step_x_m, (grid.rows - 1) * step_y_m, native_m);
  terrain.columns = layout.columns;
  terrain.rows = layout.rows;
  terrain.spacing_m = layout.spacing_m;
  for (int j = 0; j < layout.rows; ++j) {
    const double v = 0.5 * (grid.rows - 1) + (j - 0.5 * (layout.rows - 1)) * (layout.spacing_m / step_y_m);
    for (int i = 0; i < layout.columns; ++i) {
      const double u =
          0.5 * (grid.columns - 1) + (i - 0.5 * (layout.columns - 1)) * (layout.spacing_m / step_x_m);
      terrain.heights_m.push_back(grid.interpolated(u, v));
    }
  }
  return terrain;
}

// Samples on a graticule, without holes, to a terrain in the local frame of their middle.
Terrain fit_geographic(const TerrainSource& source, const HeightGrid& grid, Geographic south_west,
                       double step_x, double step_y, const RasterFrame& raster) {
  const Geographic north_east{south_west.longitude + (grid.columns - 1) * step_x,
                              south_west.latitude + (grid.rows - 1) * step_y};
  const Geographic middle{(south_west.longitude + north_east.longitude) / 2,
                          (south_west.latitude + north_east.latitude) / 2};
  if (north_east.longitude - south_west.longitude > kLargestSpanRad ||
      north_east.latitude - south_west.latitude > kLargestSpanRad) {
    refuse(source,
           "spans more than 6 degrees; cut it first (gdal_translate -projwin), or take fit = \"crop\" with a "
           "size");
  }
  if (north_east.latitude > kHighestLatitudeRad || south_west.latitude < -kHighestLatitudeRad) {
    refuse(source, "reaches beyond 86 degrees of latitude; warp it to a polar projection first (gdalwarp)");
  }
  const LocalFrame frame(middle, raster.semi_major_m, raster.inverse_flattening);
  // The largest rectangle around the central meridian that the bent outline of the data holds.
  const Vec2 corner_north = frame.to_plan(north_east);
  const Vec2 corner_south = frame.to_plan({north_east.longitude, south_west.latitude});
  const double north = std::min(corner_north.y, frame.to_plan({middle.longitude, north_east.latitude}).y);
  const double south = std::max(corner_south.y, frame.to_plan({middle.longitude, south_west.latitude}).y);
  const double half_width = std::min(corner_north.x, corner_south.x);
  if (!(north > south) || !(half_width > 0))
    refuse(source, "covers no rectangle in metres; give a larger window");
  const double native_m = (frame.parallel_radius_m() * step_x + frame.meridian_radius_m() * step_y) / 2;
  const Layout layout = lay_out(source, 2 * half_width, north - south, native_m);
  Terrain terrain;
  terrain.columns = layout.columns;
  terrain.rows = layout.rows;
  terrain.spacing_m = layout.spacing_m;
  for (int j = 0; j < layout.rows; ++j) {
    const LocalFrame::Row row =
        frame.row((north + south) / 2 + (j - 0.5 * (layout.rows - 1)) * layout.spacing_m);
    for (int i = 0; i < layout.columns; ++i) {
      const Geographic p = row.at((i - 0.5 * (layout.columns - 1)) * layout.spacing_m);
      terrain.heights_m.push_back(grid.interpolated((p.longitude - south_west.longitude) / step_x,
                                                    (p.latitude - south_west.latitude) / step_y));
    }
  }
  return terrain;
}

// `crop` reads no more than it keeps, and a margin where it must interpolate.
GridWindow window_to_read(const TerrainSource& source, const RasterFrame& raster) {
  const GridWindow whole{0, 0, raster.columns, raster.rows};
  if (source.fit != FitRule::crop || !source.size || source.holes == HolePolicy::crop) return whole;
  double x_m = raster.step_x, y_m = raster.step_y;
  if (raster.geographic) {
    const Geographic middle{raster.south_west.longitude + (raster.columns - 1) / 2.0 * raster.step_x,
                            raster.south_west.latitude + (raster.rows - 1) / 2.0 * raster.step_y};
    if (!(std::fabs(middle.latitude) < kHighestLatitudeRad)) return whole;  // refused later, with its reason
    const LocalFrame frame(middle, raster.semi_major_m, raster.inverse_flattening);
    x_m *= frame.parallel_radius_m();
    y_m *= frame.meridian_radius_m();
  }
  const double spacing_m = (x_m + y_m) / 2;
  const bool exact = !raster.geographic && std::fabs(x_m - y_m) <= kSquareWithin * spacing_m;
  const auto samples = [&](double step_m, int available) {
    const double needed = exact ? *source.size : std::ceil(*source.size * (spacing_m / step_m) * 1.1) + 4;
    return needed < available ? static_cast<int>(needed) : available;
  };
  const int columns = samples(x_m, raster.columns);
  const int rows = samples(y_m, raster.rows);
  if (exact) return {(raster.columns - columns) / 2, (raster.rows - rows) / 2, columns, rows};
  // The same number off both sides: the middle stays where it is.
  const int aside = (raster.columns - columns) / 2;
  const int below = (raster.rows - rows) / 2;
  return {aside, below, raster.columns - 2 * aside, raster.rows - 2 * below};
}

Terrain load_file(const TerrainSource& source) {
  const RasterReader reader(source.id, source.file);
  const RasterFrame& raster = reader.frame();
  const GridWindow window = window_to_read(source, raster);
  int step = 1;
  if (std::max(window.columns, window.rows) > kMostSamplesASide) {
    if (!source.size && !source.spacing_m) {
      refuse(source, fmt::format("has {} x {} samples, more than {} a side; give a size", raster.columns,
                                 raster.rows, kMostSamplesASide));
    }
    if (source.fit == FitRule::crop || source.holes == HolePolicy::crop) {
      refuse(source, fmt::format("needs {} x {} samples read, more than {} a side; cut it first",
                                 window.columns, window.rows, kMostSamplesASide));
    }
    step = (std::max(window.columns, window.rows) - 2) / (kMostSamplesASide - 1) + 1;
    if (std::min(window.columns, window.rows) <= step) {
      refuse(source,
             fmt::format("has {} x {} samples, too long a strip; cut it first", raster.columns, raster.rows));
    }
  }
  HeightGrid grid = reader.read(window, step);
  GridWindow kept{0, 0, grid.columns, grid.rows};
  if (source.holes == HolePolicy::crop && grid.count_holes() > 0 &&
      grid.count_holes() < grid.heights_m.size()) {
    kept = largest_window_without_holes(grid);
  }
  grid = without_holes(source, std::move(grid));
  if (!raster.georeferenced) {
    const double spacing_m = source.spacing_m.value_or(1) * step;
    return fit_metric(source, std::move(grid), spacing_m, spacing_m, false);
  }
  const double step_x = raster.step_x * step;
  const double step_y = raster.step_y * step;
  if (!raster.geographic)
    return fit_metric(source, std::move(grid), step_x, step_y, source.spacing_m.has_value());
  const Geographic south_west{raster.south_west.longitude + window.i * raster.step_x + kept.i * step_x,
                              raster.south_west.latitude + window.j * raster.step_y + kept.j * step_y};
  return fit_geographic(source, grid, south_west, step_x, step_y, raster);
}

Terrain load_survey(const TerrainSource& source) {
  const std::string label =
      fmt::format("terrain '{}': {}", one_line(source.id, 80), one_line(source.points.string(), 200));
  std::vector<Vec3> points = load_points(source.points, label);
  Vec2 low{points.front().x, points.front().y};
  Vec2 high = low;
  for (const Vec3 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 extent{high.x - low.x, high.y - low.y};
  if (!(extent.x > 0 && extent.y > 0))
    refuse(source, "all points stand on one line; a terrain needs an area");
  const double mean_m = std::sqrt(extent.x * extent.y / static_cast<double>(points.size()));
  const Layout layout = lay_out(source, extent.x, extent.y, mean_m);
  const Vec2 south_west{(low.x + high.x) / 2 - 0.5 * (layout.columns - 1) * layout.spacing_m,
                        (low.y + high.y) / 2 - 0.5 * (layout.rows - 1) * layout.spacing_m};
  HeightGrid grid = grid_points(points, south_west, layout.columns, layout.rows, layout.spacing_m, label);
  GridWindow kept{0, 0, grid.columns, grid.rows};
  if (source.holes == HolePolicy::crop && grid.count_holes() < grid.heights_m.size()) {
    kept = largest_window_without_holes(grid);
  }
  grid = without_holes(source, std::move(grid));
  Terrain terrain;
  terrain.columns = grid.columns;
  terrain.rows = grid.rows;
  terrain.spacing_m = layout.spacing_m;
  terrain.heights_m = std::move(grid.heights_m);
  const Vec2 corner{south_west.x + kept.i * layout.spacing_m, south_west.y + kept.j * layout.spacing_m};
  for (const Vec3 p : points) {
    const Vec3 local{p.x - corner.x, p.y - corner.y, p.z * source.z_scale};
    // The rim is the samples'.
    if (local.x > 0 && local.y > 0 && local.x < terrain.width_m() && local.y < terrain.depth_m())
      terrain.points.push_back(local);
  }
  return terrain;
}

Terrain load_samples(const TerrainSource& source) {
  const auto expected = static_cast<std::size_t>(std::max(source.columns, 0)) *
                        static_cast<std::size_t>(std::max(source.rows, 0));
  if (source.columns < 2 || source.rows < 2 || source.columns > kMostSamplesASide ||
      source.rows > kMostSamplesASide || source.samples.size() != expected) {
    refuse(source, fmt::format("{} samples for {} columns and {} rows; give columns x rows, each 2 to {}",
                               source.samples.size(), source.columns, source.rows, kMostSamplesASide));
  }
  HeightGrid grid{source.columns, source.rows, source.samples};
  for (double& z : grid.heights_m) {
    if (!std::isfinite(z)) z = std::numeric_limits<double>::quiet_NaN();
  }
  const double spacing_m = source.spacing_m.value_or(30);
  return fit_metric(source, without_holes(source, std::move(grid)), spacing_m, spacing_m, false);
}

void check_source(const TerrainSource& source) {
  const int kinds = (source.file.empty() ? 0 : 1) + (source.points.empty() ? 0 : 1) +
                    (source.generator.empty() ? 0 : 1) + (source.samples.empty() ? 0 : 1);
  if (kinds != 1) refuse(source, "needs exactly one of file, points, generator, samples");
  if (source.size && (*source.size < 2 || *source.size > kMostSamplesASide)) {
    refuse(source, fmt::format("size is {}; give 2 to {} samples a side", *source.size, kMostSamplesASide));
  }
  if (source.spacing_m && !(*source.spacing_m >= kLeastSpacingM && *source.spacing_m <= kLargestSpacingM)) {
    refuse(source, fmt::format("spacing_m is {}; give {} to {}", *source.spacing_m, kLeastSpacingM,
                               kLargestSpacingM));
  }
  if (!std::isfinite(source.z_scale))
    refuse(source, fmt::format("z_scale is {}; give a finite number", source.z_scale));
}

// i·spacing is then exact for every sample, so that samples on a straight line of the grid stand on a
// straight line: conformity is decided exactly, and must not see a rounding as a bend. Moves no sample by
// more than 2⁻³² of the extent.
double with_exact_multiples(double spacing_m) {
  constexpr int kSignificantBits = 32;
  int exponent = 0;
  const double mantissa = std::frexp(spacing_m, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, kSignificantBits)), exponent - kSignificantBits);
}

}  // namespace

Terrain load_terrain(const TerrainSource& source) {
  check_source(source);
  Terrain terrain = !source.file.empty()        ? load_file(source)
                    : !source.points.empty()    ? load_survey(source)
                    : !source.generator.empty() ? generate_terrain(source)
                                                : load_samples(source);
  terrain.id = source.id;
  terrain.spacing_m = with_exact_multiples(terrain.spacing_m);
  if (!(terrain.spacing_m >= kLeastSpacingM && terrain.spacing_m <= kLargestSpacingM)) {
    refuse(source, fmt::format("samples stand {} m apart; {} to {} m are read", terrain.spacing_m,
                               kLeastSpacingM, kLargestSpacingM));
  }
  for (double& z : terrain.heights_m) {
    z *= source.z_scale;
    if (!(std::fabs(z) <= kHighestM)) {
      refuse(source,
             fmt::format("holds a height of {} m; declare the raster's no-data value or mend z_scale", z));
    }
  }
  if (!source.constraints.empty()) terrain.roads = load_roads(source.constraints, terrain, source.id);
  if (source.generated_roads) terrain.roads = generate_roads(terrain, source.seed);
  return terrain;
}

}  // namespace plumbline
