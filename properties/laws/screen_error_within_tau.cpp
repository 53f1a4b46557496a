// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, no point of the picture is displaced by more than τ. Source:
// METHODS M1.C5, M3.C3; ORACLES O3 (displacement_px), against the samples that the method says it represents.
// And law covers_picture, which is judged on the same picture: no pixel that shows terrain is without a mesh
// over it.

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

/// What the judged camera sees of the samples and of the mesh.
struct Picture {
  LodFrame frame;
  Camera camera;
  double scale = 1;  ///< pixels of the picture asked for in one of the judged
  oracle::PixelHits reference_hits;
  std::unique_ptr<oracle::RaySurface> mesh;
  oracle::ImageError error;
  oracle::ImageMaps maps;
};
std::unique_ptr<Picture> look(const LawInput& input) {
  auto out = std::make_unique<Picture>();
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  out->frame = fly(*method, cameras(input));
  if (out->frame.mesh.triangles.empty()) return out;
  static thread_local const oracle::RayDevice device;
  const Mesh full = reference_mesh(represented(input.terrain, method->reference(input.terrain)));
  const oracle::RaySurface reference(device, full);
  out->mesh = std::make_unique<oracle::RaySurface>(device, out->frame.mesh);
  out->camera = smaller(input);
  out->scale = judged_camera(input).kappa_px / out->camera.kappa_px;
  out->reference_hits = reference.look(out->camera);
  out->error = oracle::image_error(out->camera, reference, out->reference_hits, *out->mesh,
                                   out->mesh->look(out->camera), input.threshold_px / out->scale, &out->maps);
  return out;
}

LawOutcome check_covers(const LawInput& input) {
  const std::unique_ptr<Picture> picture = look(input);
  const std::size_t judged = picture->error.displacement_px.count;
  if (const std::size_t bare = picture->error.uncovered_px; bare > 0) {
    oracle::Finding finding = law_finding("uncovered", input.poses.back().position);
    finding.code = oracle::FindingCode::uncovered;
    return violated(
        fmt::format("{} of {} pixels that show terrain have no mesh over it", bare, bare + judged),
        std::move(finding));
  }
  if (picture->frame.mesh.triangles.empty()) {
    const Mesh full = reference_mesh(input.terrain);
    for (const Vec3& p : full.positions) {
      if (!judged_camera(input).sees(p)) continue;
      oracle::Finding finding = law_finding("uncovered", p);
      finding.code = oracle::FindingCode::uncovered;
      return violated(fmt::format("nothing is drawn, with sample ({}, {}, {}) in the picture", p.x, p.y, p.z),
                      std::move(finding));
    }
  }
  return judged == 0 ? vacuous("no pixel shows terrain") : held();
}

LawOutcome check(const LawInput& input) {
  const std::unique_ptr<Picture> picture = look(input);
  const auto& [frame, camera, scale, reference_hits, mesh, error, maps] = *picture;
  if (frame.mesh.triangles.empty()) return vacuous("nothing was drawn");
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
  if (const auto z = mesh->height_at({at.x, at.y})) finding.gap_m = *z - at.z;
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

Law law_covers_picture() {
  return {
      .id = "covers_picture",
      .statement =
          "for every terrain, flight and threshold, no pixel that shows terrain is without a mesh over it",
      .source = "ORACLES O3 (uncovered)",
      .applies = [](const MethodChoice&) { return true; },
      // A method may leave out what is out of sight from the domain that it promises; no other.
      .promised = [](const MethodChoice& choice) { return choice.promises(Promise::covers_domain); },
      .check = check_covers};
}

}  // namespace plumbline::properties
