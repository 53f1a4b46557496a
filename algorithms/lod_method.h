// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scenarios/camera.h"
#include "scenarios/mesh.h"
#include "scenarios/terrain.h"

namespace plumbline {

/// What an update did (METHODS, notation). A method without memory from frame to frame counts every split on
/// its way down from the root, and no merge.
struct Counters {
  std::uint64_t visited = 0;    ///< nodes (triangles, vertices, edges: the method's own unit) looked at
  std::uint64_t evaluated = 0;  ///< screen errors computed
  std::uint64_t split = 0;
  std::uint64_t merged = 0;
  std::uint64_t nodes = 0;  ///< all nodes of the hierarchy: what `visited` is a share of; 0: not stated
  std::uint64_t drawn = 0;  ///< nodes that were drawn (fans); 0: the method draws no nodes
  std::uint64_t tiles = 0;  ///< tiles in sight; 0: the method has none
};

/// A block of samples from the terrain's south-west corner: (columns) × (rows) of them.
struct SampleBlock {
  int columns = 0, rows = 0;
  friend bool operator==(const SampleBlock&, const SampleBlock&) = default;
};

/// One frame's result.
struct LodFrame {
  Mesh mesh;
  /// Identity of each vertex of `mesh`, the same number in every frame of a flight (a sample's index, a
  /// node's): what entered and left, and what toggles, is read off these. As long as `mesh.positions`,
  /// without repeats.
  std::vector<std::uint64_t> vertex_keys;
  PlanDomain domain;  ///< the plan region this frame promises to cover
  Counters counters;

  /// Empty, with the memory kept for the next frame.
  void clear() {
    mesh.clear();
    vertex_keys.clear();
    domain.clear();
    counters = {};
  }
};

/// A level-of-detail method: the one class to derive from. No renderer, clock, file or thread in it.
///
/// Life of an instance: created by its description's factory, prepared once (for a terrain or for objects),
/// then `clone`d for every flight (clones run on different threads); each clone gets its threshold and sees
/// the frames of one flight in order.
class LodMethod {
 public:
  virtual ~LodMethod() = default;

  /// Everything that depends on the terrain alone. `terrain` outlives the method and its clones. Throws
  /// InputError if the method cannot take this terrain (the message says which size would do).
  virtual void prepare(const Terrain& terrain) = 0;
  /// The same for objects instead of a terrain: oriented triangle meshes in one scene, metres, each with a
  /// level of detail of its own. No plan region is promised. Throws InputError if the method takes terrains
  /// only (MethodDescription::takes_objects says which do), or cannot take such a mesh.
  virtual void prepare_objects(const std::vector<Mesh>& objects);
  /// The mesh for this camera and the current threshold. `frame` may hold an earlier result (its memory is
  /// reused) and is overwritten whole. State kept from earlier frames is allowed.
  virtual void update(const Camera& camera, LodFrame& frame) = 0;
  /// The samples that the method represents, and is held to: all of them, unless its structure leaves some
  /// out (a quadtree of vertices takes 2ⁿ × 2ⁿ of 2ⁿ+1 a side). Requires: prepared.
  [[nodiscard]] virtual SampleBlock reference(const Terrain& terrain) const {
    return {terrain.columns, terrain.rows};
  }
  /// Forgets all earlier frames: the next `update` is a first frame.
  virtual void reset() = 0;
  /// A flyer over the same terrain, as after `reset`. Sharing what `prepare` made is for the method to
  /// arrange (std::shared_ptr<const …>); a plain copy is right too, if larger.
  [[nodiscard]] virtual std::unique_ptr<LodMethod> clone() const = 0;

  /// τ, pixels; > 0. May change between frames.
  void set_threshold_px(double threshold_px) { threshold_px_ = threshold_px; }
  [[nodiscard]] double threshold_px() const { return threshold_px_; }

 private:
  double threshold_px_ = 1;
};

}  // namespace plumbline
