// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// my_method: the terrain's rectangle as two triangles. Role: the least that is a method; copy it and replace
// everything.
//
// Paper: authors, title, venue, year; the sections and equations implemented here.
// Promises: each with its reason. Departures: each with its reason. Units: metres, pixels.
#include <memory>

#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

class MyMethod final : public LodMethod {
 public:
  void prepare(const Terrain& terrain) override {
    if (terrain.columns < 2 || terrain.rows < 2) {
      throw InputError("my_method: the terrain has no cell; give at least 2 x 2 samples");
    }
    terrain_ = &terrain;
  }

  void update(const Camera& camera, LodFrame& frame) override {
    frame.clear();
    const int east = terrain_->columns - 1, north = terrain_->rows - 1;
    for (const auto& [i, j] :
         {std::pair{0, 0}, std::pair{east, 0}, std::pair{east, north}, std::pair{0, north}}) {
      frame.mesh.positions.push_back(terrain_->point(i, j));
      frame.vertex_keys.push_back(terrain_->index(i, j));
    }
    frame.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};  // counter-clockwise seen from above
    frame.domain = full_domain(*terrain_);
    // A real method asks the camera: camera.kappa_px · error / distance against threshold_px().
    ++frame.counters.visited;
    (void)camera;
  }

  void reset() override {}  // nothing is kept from frame to frame
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    return std::make_unique<MyMethod>(*this);
  }

 private:
  const Terrain* terrain_ = nullptr;
};

}  // namespace

MethodDescription
describe_my_method();  // the registry declares it for a method that plumbline_add_method enters
MethodDescription describe_my_method() {
  using enum Promise;
  return {
      .id = "my_method",
      .title = "Two triangles",
      .citation = "authors, title, venue, year",
      .section = "reference",
      .variants = {{"",
                    "what the published default does",
                    {conforming, covers_domain, monotone_in_tau, idempotent, path_independent,
                     threshold_blind}}},
      .options = {},
      .claims = {},
      .make = [](std::string_view, const Options&) { return std::make_unique<MyMethod>(); },
  };
}

}  // namespace plumbline
