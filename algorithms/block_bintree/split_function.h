// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "algorithms/bintree/level_order.h"
#include "scenarios/camera.h"
#include "scenarios/terrain.h"

namespace plumbline::block_bintree {

using bintree::ClusterGrid;
using bintree::GridPoint;

/// ε_d and q of METHODS M4 (the paper's ε and q, equations 6–10).
struct SplitConstants {
  double depth_ratio = 0.1;  ///< ε_d: a hypotenuse longer than ε_d times its depth splits
  double saturation = 1.05;  ///< q: e(parent) ≥ q·e(child)
};

/// The published constants: q = 1 + ε_d/2 (equation 7).
SplitConstants published_constants(double depth_ratio);

/// The constants of variant `repaired`: the same shape of rule, with q and ε_d chosen from `steepest_slope`
/// so that M4.C3 holds for every camera (README.md derives them). With g = ε_d·sqrt(1+s²)/(2√2):
///   ε_d is lowered, if need be, until g ≤ 1 − 1/√2;   q = max(1 + ε_d/2, 1/(1 − g)).
SplitConstants repaired_constants(double depth_ratio, double steepest_slope);

/// s: the steepest |Δz| / distance in plan between a split node and one of its parents; 0 if no node has a
/// parent.
double steepest_slope(const Terrain& terrain, const ClusterGrid& grid);

/// The split function e of one terrain, and the split test: all that M4.C2 and M4.C3 speak of. Immutable.
/// The node graph is `grid()`'s: level(), parents(), children(), diamond(), hypotenuse_m().
class SplitFunction {
 public:
  SplitFunction() = default;
  /// Computes e bottom-up (equation 10) in one pass. `terrain` must outlive this.
  SplitFunction(const Terrain& terrain, const ClusterGrid& grid, SplitConstants constants);

  [[nodiscard]] const ClusterGrid& grid() const { return grid_; }
  [[nodiscard]] const SplitConstants& constants() const { return constants_; }

  /// δ of equation 1, metres: the node's own deviation, the larger over the diamond's existing corner pairs.
  [[nodiscard]] double deviation_m(GridPoint node) const;
  /// e of equation 10, metres; Requires: a split node.
  [[nodiscard]] double e_m(GridPoint node) const { return nodes_[order_.index(node)].e_m; }
  [[nodiscard]] const bintree::LevelOrder& order() const { return order_; }
  [[nodiscard]] Vec3 point(GridPoint p) const { return terrain_->point(p.i, p.j); }

  /// The frame's part of the split test. `e·κ/τ` is evaluated as e·(κ/τ), and d/ε_d once a level.
  struct Frame {
    Camera camera;
    double px_ratio = 0;                  ///< κ/τ
    std::vector<double> depth_limit_m{};  ///< d/ε_d by level
  };
  [[nodiscard]] Frame frame(const Camera& camera, double threshold_px) const;

  /// Equation 8: split iff max(e·κ/τ, d/ε_d) ≥ depth. Always at depth ≤ 0. `level` is the node's.
  [[nodiscard]] bool splits(const Frame& frame, GridPoint node, int level) const {
    const Node& n = nodes_[order_.index(node, level)];
    const double depth_m = frame.camera.depth({node.i * spacing_m_, node.j * spacing_m_, n.z_m});
    return n.e_m * frame.px_ratio >= depth_m ||
           frame.depth_limit_m[static_cast<std::size_t>(level)] >= depth_m;
  }
  /// The same for one node, for laws and tests.
  [[nodiscard]] bool splits(GridPoint node, const Camera& camera, double threshold_px) const {
    return splits(frame(camera, threshold_px), node, grid_.level(node));
  }

 private:
  /// What a split test reads of a node, side by side.
  struct Node {
    double z_m = 0;
    double e_m = 0;
  };

  const Terrain* terrain_ = nullptr;
  double spacing_m_ = 0;
  ClusterGrid grid_;
  bintree::LevelOrder order_;
  SplitConstants constants_;
  std::vector<Node> nodes_;  ///< in level order
};

}  // namespace plumbline::block_bintree
