// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "oracle/finding.h"
#include "scenarios/camera.h"
#include "scenarios/mesh.h"
#include "scenarios/raster.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle {

/// One ray-casting device (Embree). `isa`: "" for the best of this machine, or "sse2", "avx", "avx2", "avx512" to limit
/// it; the figures are the same for all of them, since Embree only proposes and doubles decide.
class RayDevice {
 public:
  explicit RayDevice(const std::string& isa = "");
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;
  struct State;
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// What each pixel's primary ray meets: rows from the top, width × height entries.
struct PixelHits {
  int width = 0, height = 0;
  std::vector<std::uint32_t> triangle;  ///< kNoHit where the ray meets nothing
  std::vector<double> depth_m;          ///< along the camera's forward axis; +∞ where nothing
  static constexpr std::uint32_t kNoHit = 0xffffffffu;
};

/// A mesh ready for rays and for vertical look-ups. Holds a copy of nothing: `mesh` must outlive it.
/// Triangles with a bad index or a non-finite corner are left out. Thread-safe for const use.
class RaySurface {
 public:
  RaySurface(const RayDevice& device, const Mesh& mesh);
  ~RaySurface();
  RaySurface(RaySurface&&) noexcept;
  RaySurface& operator=(RaySurface&&) noexcept;
  /// Primary hits of every pixel, decided in double: nearest along the ray, then least triangle index.
  [[nodiscard]] PixelHits look(const Camera& camera) const;
  [[nodiscard]] const Mesh& mesh() const;
  struct State;
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Distribution of a per-pixel figure, pixels.
struct PixelFigure {
  double max = 0, p999 = 0, p99 = 0, rms = 0, mean = 0;
  std::size_t count = 0;    ///< pixels judged; 0 means nothing was
};

/// O3's figures for one frame (ORACLES O3).
struct ImageError {
  PixelFigure displacement_px;
  double over_threshold = 0;      ///< share of the judged pixels above τ
  std::size_t uncovered_px = 0;   ///< pixels whose reference point has no mesh point over it
  PixelFigure depth_rel;          ///< relative depth difference along the same ray
  std::size_t silhouette_pixels = 0;  ///< terrain in one, sky in the other
  double silhouette_max_px = 0;       ///< largest distance of such a pixel to the other's silhouette
};

/// Per-pixel displacement for pictures; NaN where nothing was judged.
struct ImageMaps {
  Raster displacement_px;
};

/// Compares a mesh with the reference, both seen from `camera`. `reference_hits` = reference.look(camera), shared by all
/// methods; `mesh_hits` = mesh.look(camera). Pixel by pixel in row-major chunks of fixed size, so that sums do not
/// depend on threads.
ImageError image_error(const Camera& camera, const RaySurface& reference, const PixelHits& reference_hits,
                       const RaySurface& mesh, const PixelHits& mesh_hits, double threshold_px,
                       ImageMaps* maps = nullptr);

/// `pop_px`: displacement between the previous frame's mesh and this one, both seen from this frame's camera.
PixelFigure pop(const Camera& camera, const RaySurface& now, const PixelHits& now_hits, const RaySurface& before);

/// Fills `visibility` and `gap_px` of findings for a camera: in the picture or not, hidden behind the mesh or not.
void locate_in_picture(const Camera& camera, const RaySurface& mesh, std::span<Finding> findings);

/// A plain picture of a surface: shade in [0, 1] by slope and light from the north-west, NaN for sky; with `wireframe`,
/// pixels on a triangle's edge are darkened.
Raster shade(const Camera& camera, const RaySurface& surface, const PixelHits& hits, bool wireframe);

}  // namespace plumbline::oracle
