// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "algorithms/lod_method.h"
#include "oracle/image.h"
#include "properties/verdict/verdict.h"
#include "scenarios/terrain.h"
#include "scenarios/trajectory.h"

namespace plumbline {

/// What a method is held to, with everything its judges share: samples, or objects, and their surface, ready
/// for rays.
struct TerrainStage {
  Subject subject = Subject::terrain;
  Terrain terrain;  ///< as far as the method represents it (LodMethod::reference); of a mesh: empty
  Mesh reference;
  std::unique_ptr<oracle::RaySurface> surface;  ///< over `reference`
};

/// One frame of a flight, as all methods see it.
struct FrameScene {
  int index = 0;
  Camera camera;
  const oracle::PixelHits* reference_hits = nullptr;  ///< the stage's surface seen from `camera`
  /// Of what the reference shows from `camera`, metres; +∞ where it shows nothing.
  double mean_depth_m = std::numeric_limits<double>::infinity();
  bool cut = false;          ///< the camera was cut to this frame (oracle::is_cut)
  int first_visit = -1;      ///< the first frame of the flight with this camera, if that is an earlier one
  bool asks_all = false;     ///< the costly figures too: slack (O4), distances in space (O7)
  bool comes_again = false;  ///< the first of several frames with this camera
};

/// One method flying one trajectory at one threshold, judged frame by frame by every oracle.
/// A frame whose mesh and domain equal the frame before keeps that frame's camera-free figures: they are
/// functions of the mesh alone.
class Flight {
 public:
  Flight(std::unique_ptr<LodMethod> method, const TerrainStage& stage, const oracle::RayDevice& device);
  ~Flight();

  /// Moves the method to the scene's camera and judges what it draws there. Frames must come in order.
  verdict::FrameVerdict next(const FrameScene& scene);

  [[nodiscard]] double last_update_ms() const { return update_ms_; }
  [[nodiscard]] const LodFrame& frame() const { return *now_; }

 private:
  struct Judged;
  void judge_mesh(Judged& judged) const;
  void judge_space(Judged& judged) const;
  [[nodiscard]] oracle::ImageError judge_image(const FrameScene& scene, const oracle::RaySurface& surface,
                                               const oracle::PixelHits& hits) const;
  /// What changes in the picture between two meshes: displacement or, on a mesh, parallax.
  [[nodiscard]] oracle::PixelFigure jump(const Camera& camera, const oracle::RaySurface& now,
                                         const oracle::PixelHits& hits,
                                         const oracle::RaySurface& before) const;
  verdict::StabilityFigures judge_stability(const FrameScene& scene, const verdict::FrameVerdict& frame,
                                            const oracle::PixelHits& hits);

  std::unique_ptr<LodMethod> method_;
  const TerrainStage& stage_;
  const oracle::RayDevice& device_;
  std::unique_ptr<LodFrame> now_, before_;
  std::unique_ptr<Judged> judged_now_, judged_before_;
  std::vector<std::uint64_t> keys_now_, keys_before_;  ///< sorted
  double update_ms_ = 0;

  // O5. The probe is a second flyer that starts afresh at every camera.
  std::unique_ptr<LodMethod> probe_;
  std::unique_ptr<LodFrame> fresh_, shaken_, again_;
  oracle::ToggleWatch toggles_;
  std::map<int, std::vector<std::uint64_t>> visited_;  ///< keys of first visits, by frame
};

}  // namespace plumbline
