// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "algorithms/lod_method.h"
#include "algorithms/vertex_tree/cut.h"

namespace plumbline::vertex_tree {

/// The projected diameter of the ball, pixels: 2κ·r/√(d² − r²) at distance d; +∞ from inside it.
double screen_size_px(const Camera& camera, Vec3 center, double radius_m);

/// Triangles the ladder grants (paper, step 6): 100, 80, 60, 40, 20, 10 % of `full` for a screen size over
/// 300, 250, 200, 150, 100 px and below, each rung times `scale`; rounded down.
std::size_t ladder_triangles(double size_px, double scale, std::size_t full);

/// Whether node p may lie on the contour (paper, step 7): some normal in its cone is orthogonal to some
/// direction from the eye into its ball. Requires: p is a made node.
bool may_be_contour(const VertexTree& tree, std::uint32_t p, Vec3 eye);

enum class ContourRule {
  hold,    ///< published: a contour node is not collapsed
  none,    ///< nothing is held
  restore  ///< besides, contour nodes collapsed earlier are split again, forced where need be
};

struct Settings {
  BuildSettings build;
  ContourRule contour = ContourRule::hold;
};

/// One object of a scene with its own ladder. Copies fly on their own over the same tree.
class Object {
 public:
  Object(std::shared_ptr<const VertexTree> tree, ContourRule contour)
      : cut_(std::move(tree)), contour_(contour) {}
  /// Moves the cut to what the camera asks for; out of the view cone it stays as it is. `scale` multiplies
  /// the rungs. Adds to `counters`.
  void update(const Camera& camera, double scale, Counters& counters);
  [[nodiscard]] const Cut& cut() const { return cut_; }
  [[nodiscard]] Cut& cut() { return cut_; }

 private:
  Cut cut_;
  ContourRule contour_;
};

/// The method on a terrain: its reference mesh is the one object; the threshold multiplies the rungs.
class VertexTreeMethod final : public LodMethod {
 public:
  explicit VertexTreeMethod(const Settings& settings) : settings_(settings) {}
  void prepare(const Terrain& terrain) override;
  /// Any number of manifold meshes, drawn together. A vertex's key is (object << 32) + identifier. Throws
  /// InputError as build_tree does.
  void prepare_objects(const std::vector<Mesh>& objects) override;
  void update(const Camera& camera, LodFrame& frame) override;
  void reset() override;
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override;

 private:
  Settings settings_;
  PlanDomain domain_;
  std::vector<std::shared_ptr<const VertexTree>> trees_;
  std::vector<Object> objects_;
};

}  // namespace plumbline::vertex_tree
