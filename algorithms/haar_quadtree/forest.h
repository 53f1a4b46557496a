// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenarios/camera.h"
#include "scenarios/terrain.h"
#include "scenarios/vec.h"

namespace plumbline::haar_quadtree {

/// A node of the forest. Levels count from the roots: level 0 is a patch's root, level `leaf_level` a sample.
/// Indices run over the whole forest: at level l there are (patches_x << l) × (patches_y << l) nodes,
/// row-major from the south.
struct Node {
  int level = 0;
  int a = 0;  ///< column
  int b = 0;  ///< row
  friend bool operator==(const Node&, const Node&) = default;
};

/// What M1 knows of a terrain before the first frame: a forest of vertex quadtrees over the first 2ⁿ × 2ⁿ
/// samples of each patch (the terrain's last row and column are outside), in flat arrays by level. One linear
/// pass, bottom-up.
class Forest {
 public:
  /// As many patches of 2^leaf_level samples a side as fit into all but the last row and column. Requires:
  /// one fits.
  Forest(const Terrain& terrain, int leaf_level);

  [[nodiscard]] int leaf_level() const { return leaf_level_; }
  [[nodiscard]] int patches_x() const { return patches_x_; }
  [[nodiscard]] int patches_y() const { return patches_y_; }
  [[nodiscard]] int columns(int level) const { return patches_x_ << level; }
  [[nodiscard]] int rows(int level) const { return patches_y_ << level; }
  /// Nodes of all levels.
  [[nodiscard]] std::size_t node_count() const { return first_.back(); }
  /// Position of a node in arrays over the forest; nodes of one level are contiguous, coarse levels first.
  [[nodiscard]] std::size_t index(Node node) const {
    return first_[static_cast<std::size_t>(node.level)] +
           static_cast<std::size_t>(node.b) * static_cast<std::size_t>(columns(node.level)) +
           static_cast<std::size_t>(node.a);
  }
  /// The mean of the samples below the node: M1's vertex, metres.
  [[nodiscard]] Vec3 position(Node node) const;
  /// ε, metres: the Chebyshev norm of the node's three Haar detail coefficients; 0 at leaves.
  [[nodiscard]] double error_m(Node node) const { return error_m_[index(node)]; }
  /// κ·ε/d·sqrt(1 − (ê_P·ê_z)²), pixels (§3); d to the nearest point of the box of the samples below; +∞
  /// inside the box.
  [[nodiscard]] double screen_error_px(Node node, const Camera& camera) const;
  /// Whether the ball around the node's box lies outside the view cone.
  [[nodiscard]] bool culled(Node node, const Camera& camera) const;
  /// The rectangle of the outermost samples.
  [[nodiscard]] Vec2 extent_m() const;

 private:
  struct Box {
    Vec3 low, high;
  };
  [[nodiscard]] Box box(Node node) const;

  int leaf_level_, patches_x_, patches_y_;
  double spacing_m_;
  std::vector<std::size_t> first_;  ///< first node of each level, and one past the last
  std::vector<double> mean_m_, error_m_, low_m_, high_m_;
};

}  // namespace plumbline::haar_quadtree
