// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "algorithms/haar_quadtree/cut.h"
#include "algorithms/haar_quadtree/forest.h"
#include "algorithms/haar_quadtree/update.h"
#include "algorithms/lod_method.h"

namespace plumbline::haar_quadtree {

/// M1, the Haar vertex quadtree.
/// E. Yusov, V. Turlapov: "Dynamic terrain simplification based on Haar transform and vertices quadtree" (in
/// Russian), GraphiCon 2006. Implemented here: the vertex quadtree with averaged nodes and Haar detail norms,
/// the screen error, the bottom-up pass of the first frame and the coherent top-down pass, the adaptive
/// triangulation, morphing by error, the node budget. Promises: METHODS M1.C1–C8. Departures, with reasons:
/// the Haar step is mean-normalised, so that ε is in metres; the triangulation walks the dual of the
/// partition, which gives the same triangle set as the paper's fans; κ stands for the paper's s·d_near.
class HaarQuadtree final : public LodMethod {
 public:
  explicit HaarQuadtree(const Settings& settings) : settings_(settings) {}

  void prepare(const Terrain& terrain) override;
  void update(const Camera& camera, LodFrame& frame) override;
  [[nodiscard]] SampleBlock reference(const Terrain& terrain) const override;
  void reset() override;
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override;

  /// The cut of the latest frame, and the forest it is a cut of. Requires: prepared.
  [[nodiscard]] const Cut& cut() const { return cut_; }
  [[nodiscard]] const Forest& forest() const { return *forest_; }

 private:
  [[nodiscard]] int leaf_level(const Terrain& terrain) const;
  void place(const Node& node, Cut::Slot slot, Update& pass, LodFrame& frame);
  void add_vertex(const Node& node, LodFrame& frame);

  Settings settings_;
  std::shared_ptr<const Forest> forest_;
  Cut cut_, before_;          ///< of this frame and, for its memory, of the frame before
  std::uint32_t placed_ = 0;  ///< vertices of this frame so far
  bool first_frame_ = true;
};

}  // namespace plumbline::haar_quadtree
