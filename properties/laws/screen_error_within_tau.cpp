// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, no point of the picture is displaced by more than τ. Source:
// METHODS M1.C5, M3.C3; ORACLES O3 (displacement_px), against the samples that the method says it represents.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "oracle/image.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

/// The longer side of the picture that is judged, pixels. Fewer rays judge fewer points, each of them fully:
/// displacements are scaled to the picture asked for. A violation is one; "held" speaks of these rays.
constexpr int kJudgedSidePx = 32;

/// Displacements are made of a dozen rounded operations on depths and heights; relative to τ and to the
/// picture's size.
constexpr double kRounding = 0x1p-40;

/// The samples that the method represents.
Terrain represented(const Terrain& terrain, SampleBlock block) {
  Terrain out = terrain;
  out.columns = block.columns;
  out.rows = block.rows;
  out.heights_m.clear();
  for (int j = 0; j < block.rows; ++j) {
    const auto row = terrain.heights_m.begin() + static_cast<std::ptrdiff_t>(terrain.index(0, j));
    out.heights_m.insert(out.heights_m.end(), row, row + block.columns);
  }
  return out;
}

/// The camera with a smaller picture of the same view.
Camera smaller(const LawInput& input) {
  const int longer = std::max(input.width_px, input.height_px);
  const auto side = [&](int px) {
    return longer <= kJudgedSidePx ? px : std::max(1, px * kJudgedSidePx / longer);
  };
  const CameraPose& pose = input.poses.back();
  return make_camera(pose.position, pose.look_at, input.fov_y_deg, side(input.width_px),
                     side(input.height_px));
}

LawOutcome check(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const LodFrame frame = fly(*method, cameras(input));
  if (frame.mesh.triangles.empty()) return vacuous("nothing was drawn");
  static thread_local const oracle::RayDevice device;
  const Mesh full = reference_mesh(represented(input.terrain, method->reference(input.terrain)));
  const oracle::RaySurface reference(device, full);
  const oracle::RaySurface mesh(device, frame.mesh);
  const Camera camera = smaller(input);
  const double scale = judged_camera(input).kappa_px / camera.kappa_px;
  const oracle::PixelHits reference_hits = reference.look(camera);
  oracle::ImageMaps maps;
  const oracle::ImageError error = oracle::image_error(camera, reference, reference_hits, mesh,
                                                       mesh.look(camera), input.threshold_px / scale, &maps);
  if (error.displacement_px.count == 0) return vacuous("no pixel shows terrain under the mesh");
  const double displaced_px = error.displacement_px.max * scale;
  const double picture_px = std::max(input.width_px, input.height_px);
  if (displaced_px <= input.threshold_px + kRounding * (input.threshold_px + picture_px)) return held();

  // The first pixel that attains it, and the reference point it shows.
  int at_x = 0, at_y = 0;
  double worst = -1;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const double d = maps.displacement_px.at(x, y);
      if (d > worst) {
        worst = d;
        at_x = x;
        at_y = y;
      }
    }
  }
  const double depth_m =
      reference_hits.depth_m[static_cast<std::size_t>(at_y) * static_cast<std::size_t>(camera.width_px) +
                             static_cast<std::size_t>(at_x)];
  const Vec3 at = camera.position + camera.ray_direction(at_x + 0.5, at_y + 0.5) * depth_m;
  oracle::Finding finding = law_finding("displaced", at);
  finding.code = oracle::FindingCode::error_over_threshold;
  finding.gap_px = displaced_px;
  if (const auto z = mesh.height_at({at.x, at.y})) finding.gap_m = *z - at.z;
  const long over = std::lround(error.over_threshold * static_cast<double>(error.displacement_px.count));
  std::string what = fmt::format(
      "displaced by {:.6g} px = {:.4g} tau at ({:.6g}, {:.6g}, {:.6g}), {:.6g} m of height; {} of {} pixels "
      "over tau",
      displaced_px, displaced_px / input.threshold_px, at.x, at.y, at.z, std::fabs(finding.gap_m), over,
      error.displacement_px.count);
  return violated(std::move(what), std::move(finding));
}

}  // namespace

Law law_screen_error_within_tau() {
  return {.id = "screen_error_within_tau",
          .statement =
              "for every terrain, flight and threshold no point of the picture is displaced by more than the "
              "threshold",
          .source = "METHODS M1.C5, M3.C3; ORACLES O3",
          .applies = [](const MethodChoice& choice) { return !choice.promises(Promise::threshold_blind); },
          .promised =
              [](const MethodChoice& choice) { return choice.promises(Promise::screen_error_within_tau); },
          .check = check};
}

}  // namespace plumbline::properties
