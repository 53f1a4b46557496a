// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// restricted_quadtree: restricted quadtree triangulation with the dependency graph. Role: what the papers
// compare themselves with (METHODS, reference methods).
//
// Paper: R. Pajarola, "Large scale terrain visualization using the restricted quadtree triangulation", IEEE
// Visualization 1998, pp. 19–26: the dependency relation of vertices, and selecting vertices with their
// dependencies. Every split node of the bintree (bintree/cluster_grid.h) depends on its two parents.
//
//   ε_v  = max(|z_v − mean of its hypotenuse's ends|, ε of the vertices that depend on v)      metres
//   v is selected iff κ·ε_v > τ·d_v,   d_v the distance from the camera to v in space
//   enabled = the centres of all clusters, the selected vertices, and what these depend on, transitively
//
// Promises: conforming, always: a vertex is enabled only with its parents, so the bintree of the enabled
// vertices has no T-junction, whatever was selected. Symmetric: the cluster's centre is always enabled, so
// the root diagonal is never drawn, and all else is symmetric under the eight symmetries of the grid.
//
// Departures: top-down selection instead of the paper's quadtree of blocks; a triangle in which no vertex can
// be selected (κ·ε ≤ τ·(distance to a ball around it)) is not searched, which changes the cost only.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "algorithms/bintree/cluster_grid.h"
#include "algorithms/bintree/frame_builder.h"
#include "algorithms/bintree/sweep.h"
#include "algorithms/mutant.h"
#include "algorithms/registry.h"

namespace plumbline {
namespace {

using bintree::ClusterGrid;
using bintree::GridPoint;
using bintree::LevelOrder;
using bintree::RightTriangle;

class RestrictedQuadtree final : public LodMethod {
 public:
  RestrictedQuadtree(double cluster_samples, bool cull) : cluster_samples_(cluster_samples), cull_(cull) {}

  void prepare(const Terrain& terrain) override;
  void update(const Camera& camera, LodFrame& frame) override;
  void reset() override {}  // nothing is kept from frame to frame
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override;

 private:
  /// A split node's data, side by side since a visit needs all of it.
  struct Vertex {
    double z_m = 0;
    double error_m = 0;   ///< ε
    double radius_m = 0;  ///< of a ball around the vertex that holds its diamond's samples
  };
  struct Prepared {
    const Terrain* terrain = nullptr;
    ClusterGrid grid;
    LevelOrder order;
    std::vector<Vertex> vertices;  ///< in level order
  };

  void adopt(std::shared_ptr<const Prepared> prepared);
  [[nodiscard]] bool outside_view(GridPoint node, int level) const;
  void select(const RightTriangle& triangle, int level);
  void enable(GridPoint node, int level);
  void triangulate(const RightTriangle& triangle, int level);

  double cluster_samples_ = 0;
  bool cull_ = false;
  std::shared_ptr<const Prepared> prepared_;
  bintree::FrameBuilder builder_;
  std::vector<std::uint32_t> enabled_;  ///< in level order: the frame that last enabled it
  std::uint32_t stamp_ = 0;             ///< number of the frame, from 1
  std::vector<std::pair<GridPoint, int>>
      pending_;  ///< enabled, with level; their parents are still to be enabled
  Camera camera_;
  double px_ratio_ = 0;  ///< κ/τ
  Counters counters_;
};

void RestrictedQuadtree::prepare(const Terrain& terrain) {
  auto made = std::make_shared<Prepared>();
  made->terrain = &terrain;
  made->grid = ClusterGrid(terrain, cluster_samples_, "restricted_quadtree");
  const std::vector<double>& z = terrain.heights_m;
  made->order = LevelOrder(made->grid);
  const std::vector<double> radii_m = bintree::diamond_radii_m(terrain, made->grid, made->order);
  std::vector<double> errors_m(z.size(), 0.0);  // by sample
  made->vertices.resize(made->order.size());
  bintree::sweep_bottom_up(made->grid, [&](const bintree::SweepNode& s) {
    double error_m = std::fabs(z[s.node] - (z[s.left] + z[s.right]) / 2);
    for (int c = 0; c < s.child_count && !PLUMBLINE_MUTANT(rq_error_not_maxed); ++c) {
      error_m = std::max(error_m, errors_m[s.children[static_cast<std::size_t>(c)]]);
    }
    errors_m[s.node] = error_m;
    const std::size_t k = made->order.index(s.at, s.level);
    made->vertices[k] = {z[s.node], error_m, radii_m[k]};
  });
  adopt(std::move(made));
}

void RestrictedQuadtree::adopt(std::shared_ptr<const Prepared> prepared) {
  prepared_ = std::move(prepared);
  builder_ = bintree::FrameBuilder(*prepared_->terrain, prepared_->order);
  enabled_.assign(prepared_->order.size(), 0);
  stamp_ = 0;
}

std::unique_ptr<LodMethod> RestrictedQuadtree::clone() const {
  auto copy = std::make_unique<RestrictedQuadtree>(cluster_samples_, cull_);
  copy->set_threshold_px(threshold_px());
  if (prepared_) copy->adopt(prepared_);
  return copy;
}

void RestrictedQuadtree::update(const Camera& camera, LodFrame& frame) {
  if (stamp_ == std::numeric_limits<std::uint32_t>::max()) {
    std::fill(enabled_.begin(), enabled_.end(), 0);
    stamp_ = 0;
  }
  ++stamp_;
  counters_ = {};
  camera_ = camera;
  px_ratio_ = camera.kappa_px / threshold_px();
  builder_.begin(frame);
  const ClusterGrid& grid = prepared_->grid;
  const auto every_root = [&](auto&& visit) {
    for (int b = 0; b < grid.cluster_rows(); ++b) {
      for (int a = 0; a < grid.cluster_columns(); ++a) {
        for (const RightTriangle& half : grid.halves(grid.root(a, b))) visit(half);
      }
    }
  };
  every_root([&](const RightTriangle& half) {
    enable(half.split_node(), 0);
    select(half, 0);
  });
  every_root([&](const RightTriangle& half) { triangulate(half, 0); });
  builder_.finish();
  frame.counters = counters_;
}

bool RestrictedQuadtree::outside_view(GridPoint node, int level) const {
  const Vertex& v = prepared_->vertices[prepared_->order.index(node, level)];
  const double spacing_m = prepared_->grid.spacing_m();
  return camera_.outside_view_cone({node.i * spacing_m, node.j * spacing_m, v.z_m}, v.radius_m);
}

void RestrictedQuadtree::select(const RightTriangle& triangle, int level) {
  if (level == prepared_->grid.levels()) return;
  ++counters_.visited;
  const GridPoint node = triangle.split_node();
  const Vertex& v = prepared_->vertices[prepared_->order.index(node, level)];
  if (v.error_m == 0) return;  // and so are all below
  if (cull_ && outside_view(node, level)) return;
  ++counters_.evaluated;
  const double spacing_m = prepared_->grid.spacing_m();
  const double distance_m = length(Vec3{node.i * spacing_m, node.j * spacing_m, v.z_m} - camera_.position);
  const double reach_m = v.error_m * px_ratio_;  // up to this distance the error is above τ
  if (reach_m > distance_m) enable(node, level);
  // All vertices below have at most this error and stand inside the ball.
  if (reach_m <= distance_m - (PLUMBLINE_MUTANT(rq_ball_forgotten) ? 0 : v.radius_m)) return;
  select(triangle.left_half(node), level + 1);
  select(triangle.right_half(node), level + 1);
}

void RestrictedQuadtree::enable(GridPoint node, int level) {
  const auto newly = [&](GridPoint p, int l) {
    return std::exchange(enabled_[prepared_->order.index(p, l)], stamp_) != stamp_;
  };
  if (!newly(node, level)) return;
  pending_.emplace_back(node, level);
  while (!pending_.empty()) {
    const auto [next, next_level] = pending_.back();
    pending_.pop_back();
    for (const GridPoint parent : prepared_->grid.parents(next)) {
      if (newly(parent, next_level - 1)) pending_.emplace_back(parent, next_level - 1);
      if (PLUMBLINE_MUTANT(rq_second_parent_forgotten)) break;
    }
  }
}

void RestrictedQuadtree::triangulate(const RightTriangle& triangle, int level) {
  ++counters_.visited;
  if (level == prepared_->grid.levels()) {
    builder_.emit(triangle);
    return;
  }
  const GridPoint node = triangle.split_node();
  if (cull_ && outside_view(node, level)) {
    builder_.drop(triangle);
    return;
  }
  if (enabled_[prepared_->order.index(node, level)] != stamp_) {
    builder_.emit(triangle);
    return;
  }
  ++counters_.split;
  triangulate(triangle.left_half(node), level + 1);
  triangulate(triangle.right_half(node), level + 1);
}

}  // namespace

MethodDescription describe_restricted_quadtree() {
  using enum Promise;
  return {
      .id = "restricted_quadtree",
      .title = "Restricted quadtree triangulation with the dependency graph",
      .citation =
          "R. Pajarola, \"Large scale terrain visualization using the restricted quadtree triangulation\", "
          "IEEE Visualization 1998",
      .section = "reference",
      .variants = {{"",
                    "vertices by saturated error over distance, closed under their dependencies",
                    {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero,
                     symmetric}}},
      .options =
          {
              {"cluster_size", "samples along a cluster's side, 2^n+1; 0: the largest that fits the terrain",
               0.0},
              {"cull", "leave out triangles whose ball lies outside the view cone", false},
          },
      .claims = {},
      .make =
          [](std::string_view, const Options& options) {
            return std::make_unique<RestrictedQuadtree>(option_number(options, "cluster_size", 0.0),
                                                        option_flag(options, "cull", false));
          },
  };
}

}  // namespace plumbline
