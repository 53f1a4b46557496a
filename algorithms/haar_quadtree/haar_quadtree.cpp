// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/haar_quadtree/haar_quadtree.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "algorithms/haar_quadtree/dual_mesh.h"
#include "algorithms/mutant.h"
#include "scenarios/error.h"

namespace plumbline::haar_quadtree {
namespace {

/// α below which children are drawn as their parent. They stand within 10⁻⁶ of a cell of it; closer, doubles
/// far from the origin could not keep the order of the four apart.
constexpr double kLeastAlpha = 0x1p-20;

}  // namespace

void HaarQuadtree::prepare(const Terrain& terrain) {
  forest_ = std::make_shared<const Forest>(terrain, leaf_level(terrain));
  reset();
}

void HaarQuadtree::reset() {
  if (!PLUMBLINE_MUTANT(m1_reset_forgotten)) first_frame_ = true;
}

void HaarQuadtree::update(const Camera& camera, LodFrame& frame) {
  // All is overwritten below; vectors keep their length, so that nothing is filled twice.
  frame.domain.clear();
  frame.counters = {};
  frame.counters.nodes = forest_->node_count();
  Update pass(*forest_, settings_, camera, threshold_px(), frame.counters);
  if (first_frame_) {
    pass.from_leaves(cut_);
  } else {
    std::swap(cut_, before_);
    pass.from_roots(before_, cut_);
  }
  first_frame_ = false;

  placed_ = 0;
  frame.mesh.positions.resize(cut_.roots(forest_->patches()));
  frame.vertex_keys.resize(frame.mesh.positions.size());
  for (std::size_t p = 0; p < forest_->patches(); ++p) {
    place(forest_->patch(p), static_cast<Cut::Slot>(p), pass, frame);
  }
  frame.mesh.positions.resize(placed_);
  frame.vertex_keys.resize(placed_);
  triangulate(*forest_, cut_, frame.mesh.triangles);
  if (frame.mesh.triangles.empty()) {  // a lone root has no triangle, and so no vertex in the mesh
    frame.mesh.clear();
    frame.vertex_keys.clear();
  }
  frame.domain.add_rectangle({0, 0}, forest_->extent_m());
}

SampleBlock HaarQuadtree::reference(const Terrain&) const {
  return {forest_->columns(forest_->leaf_level()), forest_->rows(forest_->leaf_level())};
}

std::unique_ptr<LodMethod> HaarQuadtree::clone() const {
  auto copy = std::make_unique<HaarQuadtree>(settings_);
  copy->forest_ = forest_;
  if (PLUMBLINE_MUTANT(m1_clone_shares_state)) {
    copy->cut_ = cut_;
    copy->first_frame_ = first_frame_;
  }
  copy->set_threshold_px(threshold_px());
  return copy;
}

/// A patch has 2^level samples a side. Samples beyond the last whole patch are not represented.
int HaarQuadtree::leaf_level(const Terrain& terrain) const {
  const int least = std::min(terrain.columns, terrain.rows) - 1;
  int level = 0;
  if (settings_.patch_size > 0) {
    while ((1 << level) < settings_.patch_size) ++level;
    if (level < 1 || (1 << level) != settings_.patch_size || settings_.patch_size > least) {
      throw InputError(
          fmt::format("haar_quadtree: option patch_size = {} is no power of two up to {}, the "
                      "lesser side of {} x {} samples less one",
                      settings_.patch_size, least, terrain.columns, terrain.rows));
    }
    return level;
  }
  if (least < 2) {
    throw InputError(fmt::format("haar_quadtree: cannot take {} x {} samples; it needs at least 3 a side",
                                 terrain.columns, terrain.rows));
  }
  // The largest patch that divides both sides; where that is under 16, patches of 16 (or of what fits).
  const unsigned cells = static_cast<unsigned>(terrain.columns - 1) | static_cast<unsigned>(terrain.rows - 1);
  level = std::countr_zero(cells);
  while (level < 4 && (2 << level) <= least) ++level;
  return level;
}

/// Gives every root below `node` its vertex.
void HaarQuadtree::place(const Node& node, Cut::Slot slot, Update& pass, LodFrame& frame) {
  if (cut_.is_root(slot)) {
    cut_.set_vertex(slot, placed_);
    add_vertex(node, frame);
    return;
  }
  const Cut::Slot below = cut_.children(slot);
  double alpha = 1;
  if (settings_.morph && cut_.children_are_roots(slot)) {
    // Geomorphing: C_i = α·C_i⁰ + (1−α)·P, α from 0 at τ to 1 at λτ.
    const double tau = threshold_px();
    alpha = std::clamp((pass.error_px(node) - tau) / (settings_.lambda * tau - tau),
                       PLUMBLINE_MUTANT(m1_morph_clamped_wrongly) ? 0.5 : 0.0, 1.0);
  }
  if (alpha < kLeastAlpha) {
    // The children have met in the parent: one vertex, and the triangles between them are gone.
    for (Cut::Slot k = 0; k < 4; ++k) cut_.set_vertex(below + k, placed_);
    add_vertex(node, frame);
    return;
  }
  for (int k = 0; k < 4; ++k) place(child(node, k), below + static_cast<Cut::Slot>(k), pass, frame);
  if (alpha == 1) return;
  const Vec3 parent = forest_->position(node);
  for (std::uint32_t v = placed_ - 4; v < placed_; ++v) {
    frame.mesh.positions[v] = PLUMBLINE_MUTANT(m1_morph_weights_swapped)
                                  ? (1 - alpha) * frame.mesh.positions[v] + alpha * parent
                                  : alpha * frame.mesh.positions[v] + (1 - alpha) * parent;
  }
}

void HaarQuadtree::add_vertex(const Node& node, LodFrame& frame) {
  frame.mesh.positions[placed_] = forest_->position(node);
  frame.vertex_keys[placed_] = forest_->index(node);
  ++placed_;
}

}  // namespace plumbline::haar_quadtree
