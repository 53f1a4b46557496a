// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/tables/stage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace plumbline::tables {

Camera look_at_middle(const Terrain& terrain, const View& view, double distance_m, const Picture& picture) {
  const double x = terrain.width_m() / 2;
  const double y = terrain.depth_m() / 2;
  const Vec3 middle{x, y, terrain.surface_height_m(x, y)};
  const Vec3 position = middle + view.from * (distance_m / length(view.from));
  return make_camera(position, middle, picture.fov_y_deg, picture.width_px, picture.height_px);
}

void Workshop::check() const {
  if (cancelled != nullptr && cancelled->load()) throw Interrupted{};
}

void Workshop::step() const {
  check();
  if (figure_done) figure_done();
}

Terrain load_stand_in(const StandInSource& stand_in, int size) {
  TerrainSource source = stand_in.source;
  source.size = size;
  Terrain terrain = load_terrain(source);
  if (stand_in.height_classes == 0) return terrain;
  const double low_m = terrain.lowest_m();
  const double class_m = (terrain.highest_m() - low_m) / stand_in.height_classes;
  if (class_m == 0) return terrain;
  for (double& z : terrain.heights_m) {
    // The summit belongs to the highest class, not to one of its own.
    const double lower = std::min(std::floor((z - low_m) / class_m), stand_in.height_classes - 1.0);
    z = low_m + lower * class_m;
  }
  return terrain;
}

std::unique_ptr<LodMethod> prepared(const MethodUse& use, const Terrain& terrain) {
  std::unique_ptr<LodMethod> method = make_method(use.id, use.options);
  method->prepare(terrain);
  return method;
}

Ground::Ground(const oracle::RayDevice& device, const Terrain& terrain, SampleBlock block) : device_(device) {
  Terrain part;
  part.columns = block.columns;
  part.rows = block.rows;
  part.spacing_m = terrain.spacing_m;
  for (int j = 0; j < block.rows; ++j) {
    const auto row = terrain.heights_m.begin() + static_cast<std::ptrdiff_t>(terrain.index(0, j));
    part.heights_m.insert(part.heights_m.end(), row, row + block.columns);
  }
  mesh_ = std::make_unique<Mesh>(reference_mesh(part));
  surface_ = std::make_unique<oracle::RaySurface>(device, *mesh_);
}

oracle::PixelFigure Ground::displacement_px(const Camera& camera, const oracle::PixelHits& hits,
                                            const Mesh& mesh) const {
  // O3's displacement and its popping are one figure, of two meshes over one picture; this is the route to
  // it that does not look at the second mesh.
  return oracle::pop(camera, *surface_, hits, oracle::RaySurface(device_, mesh));
}

std::optional<double> per(double count, double of) {
  return of > 0 ? std::optional(count / of) : std::nullopt;
}

void put(const Table& table, Trial& trial, std::string_view row, std::string_view name,
         std::optional<double> ours) {
  trial.ours.resize(table.figures.size());
  for (std::size_t k = 0; k < table.figures.size(); ++k) {
    if (table.figures[k].row != row || table.figures[k].name != name) continue;
    trial.ours[k] = ours;
    return;
  }
  throw std::logic_error(fmt::format("table {} has no figure '{}, {}'", table.id, row, name));
}

}  // namespace plumbline::tables
