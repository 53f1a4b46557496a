// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "oracle/image.h"
#include "properties/verdict/paper_table.h"
#include "scenarios/camera.h"
#include "scenarios/terrain_source.h"

namespace plumbline::tables {

/// A terrain in a paper's stead, at whatever size a table asks for.
struct StandInSource {
  TerrainSource source;  ///< its `size` is set by the table
  std::string origin;    ///< what it is, in a few words
  /// Heights are cut down to this many equal classes, as the colours of a map give them; 0: as they are.
  int height_classes = 0;
};

/// A method with its options.
struct MethodUse {
  std::string id;
  Options options;
};

/// The papers give neither viewport nor field of view. Decided: a screen of their years, and the field of
/// view of OpenGL's own examples.
struct Picture {
  int width_px = 1024;
  int height_px = 768;
  double fov_y_deg = 45;
};

/// A line of sight onto the terrain's middle: from where, as (east, north, up) steps away from it.
struct View {
  std::string name;
  Vec3 from;
};

/// A camera `distance_m` away from the surface at the terrain's middle, looking at it.
Camera look_at_middle(const Terrain& terrain, const View& view, double distance_m, const Picture& picture);

/// Thrown out of a table's work when the user has had enough.
struct Interrupted {};

/// What all tables' work shares. Thread-safe.
struct Workshop {
  const oracle::RayDevice& device;
  Picture picture;
  std::function<void()> figure_done;  ///< called for every figure that took work
  const std::atomic<bool>* cancelled = nullptr;

  void step() const;   ///< figure_done, or Interrupted
  void check() const;  ///< Interrupted, if so
};

Terrain load_stand_in(const StandInSource& stand_in, int size);
std::unique_ptr<LodMethod> prepared(const MethodUse& use, const Terrain& terrain);

/// The samples that a method is held to (LodMethod::reference), as a surface to measure against.
class Ground {
 public:
  Ground(const oracle::RayDevice& device, const Terrain& terrain, SampleBlock block);
  /// O3's displacement of `mesh` against the surface, both seen from `camera`; `hits` = look(camera).
  [[nodiscard]] oracle::PixelFigure displacement_px(const Camera& camera, const oracle::PixelHits& hits,
                                                    const Mesh& mesh) const;
  [[nodiscard]] oracle::PixelHits look(const Camera& camera) const { return surface_->look(camera); }

 private:
  const oracle::RayDevice& device_;
  std::unique_ptr<Mesh> mesh_;
  std::unique_ptr<oracle::RaySurface> surface_;
};

/// count ÷ of; nothing where `of` is 0.
std::optional<double> per(double count, double of);

/// Enters one of a trial's own figures. Throws std::logic_error if the table has no such figure.
void put(const Table& table, Trial& trial, std::string_view row, std::string_view name,
         std::optional<double> ours);

}  // namespace plumbline::tables
