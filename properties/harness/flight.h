// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/lod_method.h"
#include "oracle/image.h"
#include "properties/verdict/verdict.h"
#include "scenarios/terrain.h"

namespace plumbline {

/// A terrain with everything its judges share: the reference surface, ready for rays.
struct TerrainStage {
  Terrain terrain;
  Mesh reference;
  std::unique_ptr<oracle::RaySurface> surface;  ///< over `reference`
};

/// One method flying one trajectory at one threshold, judged frame by frame by every oracle.
/// A frame whose mesh and domain equal the frame before keeps that frame's camera-free figures: they are
/// functions of the mesh alone.
class Flight {
 public:
  Flight(std::unique_ptr<LodMethod> method, const TerrainStage& stage, const oracle::RayDevice& device);
  ~Flight();

  /// Moves the method to `camera` and judges what it draws there. `reference_hits` is the stage's surface
  /// seen from the same camera. Frames must come in order.
  verdict::FrameVerdict next(int index, const Camera& camera, const oracle::PixelHits& reference_hits);

  [[nodiscard]] double last_update_ms() const { return update_ms_; }
  [[nodiscard]] const LodFrame& frame() const { return *now_; }

 private:
  struct Judged;
  void judge_mesh(Judged& judged) const;

  std::unique_ptr<LodMethod> method_;
  const TerrainStage& stage_;
  const oracle::RayDevice& device_;
  std::unique_ptr<LodFrame> now_, before_;
  std::unique_ptr<Judged> judged_now_, judged_before_;
  std::vector<std::uint64_t> keys_now_, keys_before_;  ///< sorted
  double update_ms_ = 0;
};

}  // namespace plumbline
