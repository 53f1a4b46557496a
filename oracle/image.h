// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracle/finding.h"
#include "scenarios/camera.h"
#include "scenarios/mesh.h"
#include "scenarios/raster.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle {

// How a hit is decided. In double, over all triangles, by the edge functions of image_view.h: a ray meets a
// closed triangle from either side, the first hit is the least depth, then the least triangle index. Two
// routes lead there. `look` scan-converts every triangle over the pixel grid; it leaves nothing out, so it
// needs no proposals. `first_hit` takes Embree's: boxes wide enough that no rounding of single precision can
// lose a triangle, each one that a ray comes upon decided in double. Both give the same bits (the tests
// compare them in every pixel, and with a brute force), so no figure can depend on Embree's instruction set,
// on the order of its tree, or on threads.

/// One ray-casting device (Embree), shared by the surfaces made with it. `isa`: "" for the best of this
/// machine, or "sse2", "sse4.2", "avx", "avx2", "avx512" to limit it; the figures are the same for all of
/// them. Throws InputError for another name or one that this machine cannot run.
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

/// Where a ray first meets a surface.
struct RayHit {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t triangle = kNone;
  double depth_m = std::numeric_limits<double>::infinity();  ///< along the camera's forward axis
  friend bool operator==(const RayHit&, const RayHit&) = default;
};

/// What each pixel's primary ray meets: rows from the top, width × height entries.
struct PixelHits {
  int width = 0, height = 0;
  std::vector<std::uint32_t> triangle;  ///< kNoHit where the ray meets nothing
  std::vector<double> depth_m;          ///< along the camera's forward axis; +∞ where nothing
  static constexpr std::uint32_t kNoHit = RayHit::kNone;
};

/// A mesh ready for rays and for vertical look-ups. Holds a copy of nothing: `mesh` and `device` must outlive
/// it. Triangles with a bad index or a non-finite corner are left out. Thread-safe for const use. Cheap to
/// make: what only some questions need (a tree for single rays, an index for vertical look-ups) is built when
/// first asked.
class RaySurface {
 public:
  RaySurface(const RayDevice& device, const Mesh& mesh);
  ~RaySurface();
  RaySurface(RaySurface&&) noexcept;
  RaySurface& operator=(RaySurface&&) noexcept;
  /// Primary hits of every pixel, decided in double: nearest along the ray, then least triangle index.
  [[nodiscard]] PixelHits look(const Camera& camera) const;
  /// First hit of the ray through picture coordinates (x, y), which may lie beside the picture. At a pixel's
  /// centre the same bits as `look`.
  [[nodiscard]] RayHit first_hit(const Camera& camera, double x_px, double y_px) const;
  /// Height of the surface over plan point p, metres, the topmost where it folds or overlaps; nothing where
  /// no triangle lies over p. Triangles without plan area (walls, skirts) lie over nothing.
  [[nodiscard]] std::optional<double> height_at(Vec2 p) const;
  [[nodiscard]] const Mesh& mesh() const;
  struct State;
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Distribution of a per-pixel figure, pixels (depth_rel: no unit). A quantile q is the value of rank
/// ⌈q·count⌉ from below (nearest rank), so it is one of the values.
struct PixelFigure {
  double max = 0, p999 = 0, p99 = 0, rms = 0, mean = 0;
  std::size_t count = 0;  ///< pixels judged; 0 means nothing was
};

/// O3's figures for one frame (ORACLES O3).
struct ImageError {
  /// ‖π(S) − π(S′)‖: S where the pixel's ray meets the reference, S′ the mesh's topmost point over S's (x,
  /// y). Where the error is so large that S′ lies behind the camera, it is taken where the vertical line from
  /// S to S′ comes as near the camera's plane as 2⁻¹⁰ of S's depth: some hundred picture widths, and finite.
  PixelFigure displacement_px;
  double over_threshold = 0;     ///< share of the judged pixels above τ
  std::size_t uncovered_px = 0;  ///< pixels whose reference point has no mesh point over it
  /// Distance between the two hits of a pixel that sees both surfaces, as seen from a camera moved to the
  /// right by 1 % of the mean depth of the reference over those pixels.
  PixelFigure parallax_px;
  PixelFigure depth_rel;  ///< |depth_mesh − depth_ref| / depth_ref along the same ray, where both are hit
  std::size_t silhouette_pixels = 0;  ///< terrain in one, sky in the other
  /// Largest distance of such a pixel to the other's silhouette: to the nearest terrain pixel of the picture
  /// in which it is sky, between pixel centres. The picture's diagonal where that picture is all sky.
  double silhouette_max_px = 0;
};

/// Per-pixel displacement for pictures; NaN where nothing was judged.
struct ImageMaps {
  Raster displacement_px;
};

/// Compares a mesh with the reference, both seen from `camera`. `reference_hits` = reference.look(camera),
/// shared by all methods; `mesh_hits` = mesh.look(camera). Sums run over each row, then over the rows: no
/// figure depends on threads. A mesh equal to the reference gives exactly 0. Throws std::invalid_argument if
/// the hits are not of the camera's size.
ImageError image_error(const Camera& camera, const RaySurface& reference, const PixelHits& reference_hits,
                       const RaySurface& mesh, const PixelHits& mesh_hits, double threshold_px,
                       ImageMaps* maps = nullptr);

/// The figures that make sense on meshes that are no height fields: parallax_px, depth_rel and the
/// silhouettes; "the mesh's point over S's (x, y)" has no meaning there, so nothing is judged for
/// displacement_px, and uncovered_px is 0. `parallax_px`, if asked for, gets each pixel's parallax, +∞ where
/// one surface is seen and the other is not, NaN where neither is.
ImageError ray_error(const Camera& camera, const PixelHits& reference_hits, const PixelHits& mesh_hits,
                     Raster* parallax_px = nullptr);

/// `pop_px`: displacement between the previous frame's mesh and this one, both seen from this frame's camera.
PixelFigure pop(const Camera& camera, const RaySurface& now, const PixelHits& now_hits,
                const RaySurface& before);

/// Fills `visibility` and `gap_px` of findings for a camera: in the picture or not, hidden behind the mesh or
/// not. gap_px is the length in the picture of the vertical segment of |gap_m| at the finding; 0 outside of
/// the picture.
void locate_in_picture(const Camera& camera, const RaySurface& mesh, std::span<Finding> findings);

/// A plain picture of a surface: shade in [0, 1] by slope and light from the north-west, NaN for sky; with
/// `wireframe`, pixels on a triangle's edge are darkened.
Raster shade(const Camera& camera, const RaySurface& surface, const PixelHits& hits, bool wireframe);

}  // namespace plumbline::oracle
