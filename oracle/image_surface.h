// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "oracle/image.h"
#include "oracle/image_plan_index.h"
#include "oracle/image_view.h"

// Inside of the image oracle: what its sources share.

namespace plumbline::oracle {

/// Embree's part: the tree over one surface's triangles that proposes candidates (image_rays.cpp).
class RayTree {
 public:
  RayTree(const RayDevice& device, const Mesh& mesh, const std::vector<std::uint8_t>& usable);
  ~RayTree();
  RayTree(const RayTree&) = delete;
  RayTree& operator=(const RayTree&) = delete;
  [[nodiscard]] RayHit first_hit(const View& view, double x_px, double y_px) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

struct RaySurface::State {
  const RayDevice* device = nullptr;
  const Mesh* mesh = nullptr;
  std::vector<std::uint8_t> usable;  ///< 0: left out; empty: every triangle is used

  [[nodiscard]] const PlanIndex& plan_index() const {
    std::call_once(plan_index_once_, [this] { plan_index_ = std::make_unique<PlanIndex>(*mesh, usable); });
    return *plan_index_;
  }
  [[nodiscard]] const RayTree& tree() const {
    std::call_once(tree_once_, [this] { tree_ = std::make_unique<RayTree>(*device, *mesh, usable); });
    return *tree_;
  }

 private:
  mutable std::once_flag plan_index_once_, tree_once_;
  mutable std::unique_ptr<PlanIndex> plan_index_;
  mutable std::unique_ptr<RayTree> tree_;
};

}  // namespace plumbline::oracle
