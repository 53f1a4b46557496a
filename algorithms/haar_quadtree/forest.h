// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "scenarios/camera.h"
#include "scenarios/terrain.h"
#include "scenarios/vec.h"

namespace plumbline::haar_quadtree {

/// A node of the forest. Levels count from the roots: level 0 is a patch's root, level `leaf_level` a sample.
/// `a` and `b` run over the whole forest from the south-west: at level l there are (patches_x << l) ×
/// (patches_y << l) nodes.
struct Node {
  int level = 0;
  int a = 0;             ///< column
  int b = 0;             ///< row
  std::size_t rank = 0;  ///< position within its level: patch by patch, then along a Z curve
  friend bool operator==(const Node&, const Node&) = default;
};

/// The children in the order south-west, south-east, north-west, north-east.
inline Node child(const Node& node, int corner) {
  return {node.level + 1, 2 * node.a + (corner & 1), 2 * node.b + (corner >> 1),
          4 * node.rank + static_cast<std::size_t>(corner)};
}

/// What M1 knows of a terrain before the first frame: a forest of vertex quadtrees over the first 2ⁿ × 2ⁿ
/// samples of each patch (the terrain's last row and column are outside). One pass over the samples makes all
/// levels. The four children of a node lie side by side, so a walk down the tree touches few cache lines;
/// samples are not stored again.
class Forest {
 public:
  /// As many patches of 2^leaf_level samples a side as fit into all but the last row and column. Requires:
  /// one fits, leaf_level ≥ 1; `terrain` outlives the forest.
  Forest(const Terrain& terrain, int leaf_level);

  [[nodiscard]] int leaf_level() const { return leaf_level_; }
  [[nodiscard]] int patches_x() const { return patches_x_; }
  [[nodiscard]] int patches_y() const { return patches_y_; }
  [[nodiscard]] std::size_t patches() const {
    return static_cast<std::size_t>(patches_x_) * static_cast<std::size_t>(patches_y_);
  }
  [[nodiscard]] int columns(int level) const { return patches_x_ << level; }
  [[nodiscard]] int rows(int level) const { return patches_y_ << level; }
  /// The root of patch p; patches run row-major from the south.
  [[nodiscard]] Node patch(std::size_t p) const {
    const auto across = static_cast<std::size_t>(patches_x_);
    return {0, static_cast<int>(p % across), static_cast<int>(p / across), p};
  }
  /// Nodes of all levels.
  [[nodiscard]] std::size_t node_count() const { return first_.back(); }
  /// A number of its own for each node, coarse levels first.
  [[nodiscard]] std::size_t index(const Node& node) const {
    return first_[static_cast<std::size_t>(node.level)] + node.rank;
  }
  /// The mean of the samples below the node: M1's vertex, metres.
  [[nodiscard]] Vec3 position(const Node& node) const {
    const double size = 1 << (leaf_level_ - node.level);
    const double z = node.level == leaf_level_ ? terrain_->z(node.a, node.b) : inner_[index(node)].mean_m;
    return {((node.a + 0.5) * size - 0.5) * spacing_m_, ((node.b + 0.5) * size - 0.5) * spacing_m_, z};
  }
  /// ε, metres: the Chebyshev norm of the node's three Haar detail coefficients; 0 at leaves.
  [[nodiscard]] double error_m(const Node& node) const {
    return node.level == leaf_level_ ? 0 : inner_[index(node)].error_m;
  }
  /// κ·ε/d·sqrt(1 − (ê_P·ê_z)²), pixels (§3); d to the nearest point of the box of the samples below; +∞
  /// inside the box. Requires: no leaf.
  [[nodiscard]] double screen_error_px(const Node& node, const Camera& camera) const;
  /// Whether the ball around the node's box lies outside the view cone. Requires: no leaf.
  [[nodiscard]] bool culled(const Node& node, const Camera& camera) const;
  /// The rectangle of the outermost samples.
  [[nodiscard]] Vec2 extent_m() const;

 private:
  struct Inner {
    double mean_m, error_m, low_m, high_m;
  };
  struct Box {
    Vec3 low, high;
  };
  [[nodiscard]] Box box(const Node& node) const;
  Inner build(const Node& node);

  int leaf_level_, patches_x_, patches_y_;
  double spacing_m_;
  const Terrain* terrain_;
  std::vector<std::size_t> first_;  ///< index of the first node of each level, and one past the last
  std::vector<Inner> inner_;        ///< all nodes but the leaves, by index
};

// Here, because half of a frame's time is spent in it.
inline double Forest::screen_error_px(const Node& node, const Camera& camera) const {
  const Inner& inner = inner_[index(node)];
  const double size = 1 << (leaf_level_ - node.level);
  const double half_m = (size - 1) / 2 * spacing_m_;  // of the box, east and north of the node
  const double x = ((node.a + 0.5) * size - 0.5) * spacing_m_ - camera.position.x;
  const double y = ((node.b + 0.5) * size - 0.5) * spacing_m_ - camera.position.y;
  const double z = inner.mean_m - camera.position.z;
  const Vec3 away{std::max(std::abs(x) - half_m, 0.0), std::max(std::abs(y) - half_m, 0.0),
                  std::max(std::max(inner.low_m - camera.position.z, camera.position.z - inner.high_m), 0.0)};
  const double nearest2 = dot(away, away);
  if (nearest2 == 0) return std::numeric_limits<double>::infinity();
  // The horizontal share of the direction to the node, (x² + y²)/(x² + y² + z²), is 1 − (ê_P·ê_z)².
  const double horizontal2 = x * x + y * y;
  return camera.kappa_px * inner.error_m * std::sqrt(horizontal2 / ((horizontal2 + z * z) * nearest2));
}

}  // namespace plumbline::haar_quadtree
