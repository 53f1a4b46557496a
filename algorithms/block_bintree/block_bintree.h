// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/bintree/frame_builder.h"
#include "algorithms/block_bintree/block_tree.h"
#include "algorithms/block_bintree/split_function.h"
#include "algorithms/lod_method.h"

namespace plumbline::block_bintree {

struct Settings {
  bool repair = false;              ///< variant repaired
  bool cull_triangles = false;      ///< variant tri_cull
  bool levels_by_distance = false;  ///< variant by_distance
  double depth_ratio = 0.1;         ///< ε_d
  double cluster_samples = 0;       ///< 2ⁿ+1; 0: the largest that fits
  double block_samples = 65;        ///< 2ᵏ+1; a cluster smaller than that is one block
  bool cull = true;                 ///< leave out blocks outside the view cone
  double distance_factor = 2;       ///< by_distance: a block nearer than this many of its sides is replaced
};

/// METHODS M4; roles, formulas and departures at the head of block_bintree.cpp.
class BlockBintree final : public LodMethod {
 public:
  explicit BlockBintree(const Settings& settings) : settings_(settings) {}

  void prepare(const Terrain& terrain) override;
  void update(const Camera& camera, LodFrame& frame) override;
  void reset() override {}  // nothing is kept from frame to frame
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override;

  /// For laws and tests. Requires: prepared.
  [[nodiscard]] const SplitFunction& split_function() const { return prepared_->split_function; }
  [[nodiscard]] const BlockTree& blocks() const { return prepared_->blocks; }
  /// The blocks that the last frame needed: those not culled and not replaced by their children, in the order
  /// of a walk down the quadtree. A block of level q is replaced iff a triangle of bintree level 2(q+k) or
  /// finer in it was reached and split, since that split node is stored in its children and not in itself.
  [[nodiscard]] std::vector<BlockId> active_blocks() const;

 private:
  /// What prepare() made; shared by all clones.
  struct Prepared {
    const Terrain* terrain = nullptr;
    SplitFunction split_function;
    BlockTree blocks;
    std::vector<double> radii_m;  ///< tri_cull: of each split node's diamond, in level order
  };

  void adopt(std::shared_ptr<const Prepared> prepared);
  void descend(const bintree::RightTriangle& triangle, int level, int last_level);
  void descend_block(BlockId id);
  [[nodiscard]] bool culled(GridPoint node, int level) const;
  void collect_active(BlockId id, std::vector<BlockId>& out) const;

  Settings settings_;
  std::shared_ptr<const Prepared> prepared_;
  bintree::FrameBuilder builder_;
  std::vector<std::uint32_t> replaced_;  ///< by block: the frame that last replaced it
  std::uint32_t stamp_ = 0;              ///< number of the frame, from 1
  SplitFunction::Frame frame_;
  Counters counters_;
};

}  // namespace plumbline::block_bintree
