// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/scattered_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <cpl_error.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_alg.h>
#include <ogrsf_frmts.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

class PointReader {
 public:
  explicit PointReader(std::string label) : label_(std::move(label)) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", label_, what));
  }
  void take(const OGRGeometry& geometry) {
    switch (wkbFlatten(geometry.getGeometryType())) {
      case wkbPoint:
        take_point(*geometry.toPoint());
        return;
      case wkbMultiPoint:
        for (const OGRPoint* point : *geometry.toMultiPoint()) take_point(*point);
        return;
      default:
        refuse(fmt::format("holds a {}; a terrain is made of points, leave everything else out",
                           one_line(geometry.getGeometryName(), 40)));
    }
  }
  void check_reference(const OGRLayer& layer) const {
    // GetSpatialRef is not const before GDAL 3.12.
    const OGRSpatialReference* reference = const_cast<OGRLayer&>(layer).GetSpatialRef();
    // GeoJSON without a reference is read as longitudes and latitudes by its standard: then the numbers
    // decide.
    if (reference == nullptr || reference->IsGeographic() == 0) return;
    const bool degrees = std::all_of(points.begin(), points.end(),
                                     [](Vec3 p) { return std::fabs(p.x) <= 180 && std::fabs(p.y) <= 90; });
    if (degrees)
      refuse("is in longitudes and latitudes; project it first, to metres (ogr2ogr -t_srs EPSG:…)");
  }
  std::vector<Vec3> points;

 private:
  void take_point(const OGRPoint& point) {
    if (points.size() >= kMostPoints) refuse(fmt::format("has more than {} points", kMostPoints));
    if (point.IsEmpty()) refuse(fmt::format("point {} is empty; leave it out", points.size() + 1));
    if (!point.Is3D()) {
      refuse(fmt::format("point {} has no height; give x, y and z", points.size() + 1));
    }
    const Vec3 p{point.getX(), point.getY(), point.getZ()};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      refuse(fmt::format("point {} is ({}, {}, {}), not finite", points.size() + 1, p.x, p.y, p.z));
    points.push_back(p);
  }
  std::string label_;
};

}  // namespace

std::vector<Vec3> load_points(const std::filesystem::path& file, const std::string& label) {
  PointReader reader(label);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) reader.refuse("no such file");
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  GDALAllRegister();
  CPLErrorReset();
  CPLStringList options;
  options.SetNameValue("X_POSSIBLE_NAMES", "x,easting");
  options.SetNameValue("Y_POSSIBLE_NAMES", "y,northing");
  options.SetNameValue("Z_POSSIBLE_NAMES", "z,elevation,height");
  options.SetNameValue("KEEP_GEOM_COLUMNS", "NO");
  const std::string suffix = file.extension().string();
  const bool csv = suffix == ".csv" || suffix == ".CSV";
  const std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr,
                        csv ? options.List() : nullptr),
      [](GDALDataset* d) { GDALClose(d); });
  if (dataset == nullptr) {
    const std::string reason = one_line(CPLGetLastErrorMsg(), 200);
    reader.refuse(fmt::format(
        "not a vector file that GDAL opens{}{}; give points as CSV with columns x, y, z, or as GeoJSON",
        reason.empty() ? "" : ": ", reason));
  }
  std::size_t features = 0, first_nowhere = 0;
  for (OGRLayer* layer : dataset->GetLayers()) {
    for (const auto& feature : *layer) {
      ++features;
      if (const OGRGeometry* geometry = feature->GetGeometryRef()) {
        reader.take(*geometry);
      } else if (first_nowhere == 0) {
        first_nowhere = features;
      }
    }
    reader.check_reference(*layer);
  }
  if (features > 0 && reader.points.empty())
    reader.refuse("none of its rows has a place; a CSV needs columns named x, y and z");
  if (first_nowhere > 0) {
    reader.refuse(
        fmt::format("row {} has no place, or one that is no number; mend it or leave it out", first_nowhere));
  }
  if (reader.points.size() < 3)
    reader.refuse(fmt::format("holds {} points; a terrain needs three", reader.points.size()));
  return std::move(reader.points);
}

HeightGrid grid_points(const std::vector<Vec3>& points, Vec2 south_west, int columns, int rows,
                       double spacing_m, const std::string& label) {
  // Asked here, since qhull would print a page on standard error.
  constexpr double kThinnest = 1e-12;  // area of the widest triangle over the square of its longest side
  double longest2 = 0, widest = 0;
  const Vec3 first = points.front();
  Vec3 farthest = first;
  for (const Vec3 p : points) {
    const double dx = p.x - first.x, dy = p.y - first.y;
    if (dx * dx + dy * dy <= longest2) continue;
    longest2 = dx * dx + dy * dy;
    farthest = p;
  }
  for (const Vec3 p : points) {
    widest = std::max(widest, std::fabs((farthest.x - first.x) * (p.y - first.y) -
                                        (farthest.y - first.y) * (p.x - first.x)));
  }
  if (!(widest > kThinnest * longest2))
    throw InputError(fmt::format("{}: all points stand on one line; a terrain needs an area", label));
  std::vector<double> x, y, z;
  for (const Vec3 p : points) {
    // Near the origin, where differences of coordinates are exact enough for any triangulation.
    x.push_back(p.x - south_west.x);
    y.push_back(p.y - south_west.y);
    z.push_back(p.z);
  }
  HeightGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.heights_m.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  GDALGridLinearOptions options{};
  options.nSizeOfStructure = sizeof options;
  options.dfRadius = 0;  // nothing beyond the hull
  options.dfNoDataValue = std::numeric_limits<double>::quiet_NaN();
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  CPLErrorReset();
  // Samples stand in the middle of GDAL's cells.
  const CPLErr status =
      GDALGridCreate(GGA_Linear, &options, static_cast<GUInt32>(points.size()), x.data(), y.data(), z.data(),
                     -0.5 * spacing_m, (columns - 0.5) * spacing_m, -0.5 * spacing_m,
                     (rows - 0.5) * spacing_m, static_cast<GUInt32>(columns), static_cast<GUInt32>(rows),
                     GDT_Float64, grid.heights_m.data(), nullptr, nullptr);
  if (status != CE_None) {
    throw InputError(
        fmt::format("{}: GDAL cannot grid its points: {}", label, one_line(CPLGetLastErrorMsg(), 120)));
  }
  return grid;
}

}  // namespace plumbline
