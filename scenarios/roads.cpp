// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/roads.h"

#include <cmath>
#include <memory>

#include <cpl_error.h>
#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include "scenarios/error.h"
#include "scenarios/random.h"

namespace plumbline {
namespace {

class Reader {
 public:
  Reader(std::string label, const Terrain& terrain) : label_(std::move(label)), terrain_(terrain) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", label_, what));
  }
  void take(const OGRGeometry& geometry) {
    switch (wkbFlatten(geometry.getGeometryType())) {
      case wkbLineString:
        take_line(*geometry.toLineString());
        return;
      case wkbMultiLineString:
        for (const OGRLineString* line : *geometry.toMultiLineString()) take_line(*line);
        return;
      default:
        refuse(fmt::format("holds a {}; roads are lines, leave everything else out",
                           one_line(geometry.getGeometryName(), 40)));
    }
  }
  std::vector<std::vector<Vec2>> roads;

 private:
  void take_line(const OGRLineString& line) {
    if (line.getNumPoints() < 2) refuse("holds a line of fewer than two corners");
    corners_ += static_cast<std::size_t>(line.getNumPoints());
    if (corners_ > kMostRoadCorners) refuse(fmt::format("has more than {} corners", kMostRoadCorners));
    std::vector<Vec2>& road = roads.emplace_back();
    for (int k = 0; k < line.getNumPoints(); ++k) {
      const Vec2 p{line.getX(k), line.getY(k)};
      if (!(p.x >= 0 && p.x <= terrain_.width_m() && p.y >= 0 && p.y <= terrain_.depth_m())) {
        refuse(
            fmt::format("road {}: corner ({}, {}) lies off the terrain; give metres east and north of its "
                        "south-west sample, up to {} and {}",
                        roads.size(), p.x, p.y, terrain_.width_m(), terrain_.depth_m()));
      }
      road.push_back(p);
    }
  }

  std::string label_;
  const Terrain& terrain_;
  std::size_t corners_ = 0;
};

}  // namespace

std::vector<std::vector<Vec2>> load_roads(const std::filesystem::path& file, const Terrain& terrain,
                                          const std::string& terrain_id) {
  Reader reader(
      fmt::format("terrain '{}', roads of {}", one_line(terrain_id, 80), one_line(file.string(), 200)),
      terrain);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) reader.refuse("no such file");
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  GDALAllRegister();
  CPLErrorReset();
  const std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY),
      [](GDALDataset* d) { GDALClose(d); });
  if (dataset == nullptr) {
    const std::string reason = one_line(CPLGetLastErrorMsg(), 200);
    reader.refuse(fmt::format(
        "not a vector file that GDAL opens{}{}; give lines as GeoJSON, or as CSV with a WKT column",
        reason.empty() ? "" : ": ", reason));
  }
  for (OGRLayer* layer : dataset->GetLayers()) {
    for (const auto& feature : *layer) {
      const OGRGeometry* geometry = feature->GetGeometryRef();
      if (geometry != nullptr) reader.take(*geometry);
    }
  }
  if (reader.roads.empty()) reader.refuse("holds no line; give at least one");
  return std::move(reader.roads);
}

std::vector<std::vector<Vec2>> generate_roads(const Terrain& terrain, std::uint64_t seed) {
  constexpr int kSide = 4;
  // In cells between junctions: a road's halves then leave a junction within 34° of their axis, so that no
  // two meet elsewhere.
  constexpr double kMove = 0.1;
  Random random(seed, "roads");
  const auto moved = [&](double i, double j) {
    const double x = i + random.between(-kMove, kMove);
    const double y = j + random.between(-kMove, kMove);
    return Vec2{(x + 1) / (kSide + 1) * terrain.width_m(), (y + 1) / (kSide + 1) * terrain.depth_m()};
  };
  std::vector<Vec2> junctions;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) junctions.push_back(moved(i, j));
  }
  const auto junction = [&](int i, int j) { return junctions[static_cast<std::size_t>(j * kSide + i)]; };
  std::vector<std::vector<Vec2>> roads;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      if (i + 1 < kSide) roads.push_back({junction(i, j), moved(i + 0.5, j), junction(i + 1, j)});
      if (j + 1 < kSide) roads.push_back({junction(i, j), moved(i, j + 0.5), junction(i, j + 1)});
    }
  }
  return roads;
}

}  // namespace plumbline
