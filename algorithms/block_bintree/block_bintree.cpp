// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// block_bintree: block quadtree + right-triangle bintree with a saturated split function.
//
// Paper: "Real-time navigation over unlimited terrain" (in Russian; published default; METHODS M4). Here:
// section 2 (blocks, bintree, figures 1–5) and section 3 (split function and split test, equations 1–10).
// Section 4 (paging) is not.
//
// Promises (variants say which they keep): conforming (M4.C1) without any correction pass, since the split
// test is monotone over the split-node graph (M4.C3), since e is (M4.C2). On steep ground M4.C3 fails as
// published: METHODS M4.S1, and README.md for the bound that `repaired` keeps.
//
// Where the paper is silent: one bintree a cluster and blocks only as storage and as what is culled; a culled
// square is left out of the promised domain; a camera inside a ball keeps it. Departures: none in the
// published default. Units: metres, pixels. Levels: larger is finer, see bintree/cluster_grid.h.
#include "algorithms/block_bintree/block_bintree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "algorithms/bintree/sweep.h"
#include "algorithms/mutant.h"

namespace plumbline::block_bintree {

using bintree::RightTriangle;

void BlockBintree::prepare(const Terrain& terrain) {
  auto made = std::make_shared<Prepared>();
  const ClusterGrid grid(terrain, settings_.cluster_samples, "block_bintree");
  SplitConstants constants = published_constants(settings_.depth_ratio);
  if (settings_.repair) {
    constants = repaired_constants(settings_.depth_ratio, steepest_slope(terrain, grid));
  }
  made->terrain = &terrain;
  made->split_function = SplitFunction(terrain, grid, constants);
  const int block_exponent = std::bit_width(static_cast<unsigned>(settings_.block_samples) - 1) - 1;
  made->blocks = BlockTree(terrain, grid, std::min(block_exponent, grid.exponent()));
  if (settings_.cull_triangles) {
    made->radii_m = bintree::diamond_radii_m(terrain, grid, made->split_function.order());
  }
  adopt(std::move(made));
}

void BlockBintree::adopt(std::shared_ptr<const Prepared> prepared) {
  prepared_ = std::move(prepared);
  builder_ = bintree::FrameBuilder(*prepared_->terrain, prepared_->split_function.order());
  replaced_.assign(prepared_->blocks.count(), 0);
  stamp_ = 0;
}

std::unique_ptr<LodMethod> BlockBintree::clone() const {
  auto copy = std::make_unique<BlockBintree>(settings_);
  copy->set_threshold_px(threshold_px());
  if (prepared_) copy->adopt(prepared_);
  return copy;
}

void BlockBintree::update(const Camera& camera, LodFrame& frame) {
  if (stamp_ == std::numeric_limits<std::uint32_t>::max()) {
    std::fill(replaced_.begin(), replaced_.end(), 0);
    stamp_ = 0;
  }
  ++stamp_;
  counters_ = {};
  frame_ = prepared_->split_function.frame(camera, threshold_px());
  builder_.begin(frame);
  const ClusterGrid& grid = prepared_->split_function.grid();
  for (int b = 0; b < grid.cluster_rows(); ++b) {
    for (int a = 0; a < grid.cluster_columns(); ++a) {
      if (PLUMBLINE_MUTANT(m4_last_cluster_skipped) && a > 0 && a + 1 == grid.cluster_columns()) continue;
      if (settings_.levels_by_distance) {
        descend_block({0, a, b});
      } else {
        for (const RightTriangle& half : grid.halves(grid.root(a, b))) descend(half, 0, grid.levels());
      }
    }
  }
  builder_.finish();
  frame.counters = counters_;
}

bool BlockBintree::culled(GridPoint node, int level) const {
  // A triangle of level 2q is half a square of quadtree level q; a square's two halves get the same verdict.
  const BlockTree& blocks = prepared_->blocks;
  if (level % 2 == 0 && level / 2 <= blocks.finest_level() && !settings_.levels_by_distance &&
      blocks.outside_view_cone(blocks.containing(node, level / 2), frame_.camera)) {
    return true;
  }
  if (!settings_.cull_triangles) return false;
  if (PLUMBLINE_MUTANT(m4_culls_in_front)) {
    return frame_.camera.depth(prepared_->split_function.point(node)) <
           prepared_->split_function.grid().hypotenuse_m(level);
  }
  const SplitFunction& f = prepared_->split_function;
  return frame_.camera.outside_view_cone(f.point(node), prepared_->radii_m[f.order().index(node, level)]);
}

void BlockBintree::descend(const RightTriangle& triangle, int level, int last_level) {
  ++counters_.visited;
  if (level == last_level - (PLUMBLINE_MUTANT(m4_last_level_lost) ? 1 : 0)) {
    builder_.emit(triangle);
    return;
  }
  const GridPoint node = triangle.split_node();
  if (settings_.cull && culled(node, level)) {
    builder_.drop(triangle);
    return;
  }
  ++counters_.evaluated;
  if (!prepared_->split_function.splits(frame_, node, level)) {
    builder_.emit(triangle);
    return;
  }
  ++counters_.split;
  const BlockTree& blocks = prepared_->blocks;
  if (level % 2 == 0 && level / 2 >= blocks.exponent() && !settings_.levels_by_distance) {
    replaced_[blocks.index(blocks.containing(node, level / 2 - blocks.exponent()))] = stamp_;
  }
  descend(triangle.left_half(node), level + 1, last_level);
  descend(PLUMBLINE_MUTANT(m4_left_half_twice) && level + 1 == last_level ? triangle.left_half(node)
                                                                          : triangle.right_half(node),
          level + 1, last_level);
}

// by_distance: the block quadtree is descended by distance alone; in a block the bintree goes from its two
// triangles to the last level that the block stores.
void BlockBintree::descend_block(BlockId id) {
  const BlockTree& blocks = prepared_->blocks;
  const auto halves = prepared_->split_function.grid().halves(blocks.centre(id));
  if (settings_.cull && blocks.outside_view_cone(id, frame_.camera)) {
    for (const RightTriangle& half : halves) builder_.drop(half);
    return;
  }
  if (id.level < blocks.finest_level() &&
      blocks.distance_m(id, frame_.camera.position) < settings_.distance_factor * blocks.side_m(id.level)) {
    replaced_[blocks.index(id)] = stamp_;
    for (const BlockId child : blocks.children(id)) descend_block(child);
    return;
  }
  const int first_level = 2 * id.level;
  for (const RightTriangle& half : halves) descend(half, first_level, first_level + 2 * blocks.exponent());
}

std::vector<BlockId> BlockBintree::active_blocks() const {
  std::vector<BlockId> out;
  for (int row = 0; row < prepared_->blocks.rows(0); ++row) {
    for (int column = 0; column < prepared_->blocks.columns(0); ++column)
      collect_active({0, column, row}, out);
  }
  return out;
}

void BlockBintree::collect_active(BlockId id, std::vector<BlockId>& out) const {
  const BlockTree& blocks = prepared_->blocks;
  if (stamp_ == 0 || (settings_.cull && blocks.outside_view_cone(id, frame_.camera))) return;
  if (replaced_[blocks.index(id)] != stamp_) {
    out.push_back(id);
    return;
  }
  for (const BlockId child : blocks.children(id)) collect_active(child, out);
}

}  // namespace plumbline::block_bintree
