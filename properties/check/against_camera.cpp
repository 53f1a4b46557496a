// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a camera sees of the meshes: error in pixels, findings in the picture, skirts that show.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "oracle/image.h"
#include "properties/check/against.h"
#include "scenarios/portable_math.h"

namespace plumbline::checking {
namespace {

using oracle::FindingCode;
using oracle::Severity;

/// All subjects that are drawn as one mesh on the stage.
struct Scene {
  Mesh mesh;
  std::vector<bool> is_wall;         // per triangle
  std::vector<std::uint32_t> first;  // per subject: its first triangle
};

/// Tiles without a DEM stand in metres east and north of the south-west corner of them all.
Stage tile_stage(const Examination& exam) {
  double west = std::numeric_limits<double>::infinity(), south = west, north = -west;
  for (const Subject& subject : exam.subjects) {
    for (const Vec3& p : subject.places) {
      west = std::min(west, p.x);
      south = std::min(south, p.y);
      north = std::max(north, p.y);
    }
  }
  constexpr double kMetresPerDegree = 6378137 * kRadiansPerDegree;
  const double parallel = exact_cos(0.5 * (south + north) * kRadiansPerDegree);
  Stage stage;
  stage.place = [=](const Subject& subject, std::uint32_t v) {
    const Vec3& p = subject.places[v];
    return Vec3{(p.x - west) * kMetresPerDegree * parallel, (p.y - south) * kMetresPerDegree, p.z};
  };
  return stage;
}

Scene assemble(const Examination& exam, const Stage& stage) {
  Scene scene;
  for (const Subject& subject : exam.subjects) {
    scene.first.push_back(static_cast<std::uint32_t>(scene.mesh.triangles.size()));
    if (subject.tile && !subject.tile->drawn) continue;
    const auto base = static_cast<std::uint32_t>(scene.mesh.positions.size());
    const auto count = static_cast<std::uint32_t>(subject.mesh.positions.size());
    for (std::uint32_t v = 0; v < count; ++v)
      scene.mesh.positions.push_back(stage.place ? stage.place(subject, v)
                                                 : subject.mesh.positions[v] * exam.frame.unit_m);
    std::vector<bool> wall(subject.mesh.triangles.size(), false);
    for (const std::uint32_t t : subject.sheet.walls) wall[t] = true;
    for (std::size_t t = 0; t < subject.mesh.triangles.size(); ++t) {
      auto corners = subject.mesh.triangles[t];
      for (std::uint32_t& v : corners) v = v < count ? v + base : 0xffffffffu;
      scene.mesh.triangles.push_back(corners);
      scene.is_wall.push_back(wall[t]);
    }
  }
  return scene;
}

/// The findings so far, with the picture's answer: in it or not, and how large.
void locate(const Examination& exam, const Stage& stage, const Camera& camera,
            const oracle::RaySurface& surface, std::vector<verdict::CheckFinding*>& all) {
  // A finding without a vertex has a place in the mesh's own frame alone; a set's has no mesh.
  std::erase_if(all, [&](const verdict::CheckFinding* found) {
    return found->mesh == verdict::kNoMesh || (stage.place && found->finding.vertices.empty());
  });
  std::vector<oracle::Finding> placed;
  for (const verdict::CheckFinding* found : all) {
    oracle::Finding finding = found->finding;
    const Subject& subject = exam.subjects[found->mesh];
    if (!finding.vertices.empty() && finding.vertices.front() < subject.mesh.positions.size()) {
      const std::uint32_t v = finding.vertices.front();
      finding.at = stage.place ? stage.place(subject, v) : subject.mesh.positions[v] * exam.frame.unit_m;
    } else if (!subject.tile) {
      finding.at = finding.at * exam.frame.unit_m;
    }
    placed.push_back(std::move(finding));
  }
  oracle::locate_in_picture(camera, surface, placed);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k]->finding.visibility = placed[k].visibility;
    all[k]->finding.gap_px = placed[k].gap_px;
  }
}

}  // namespace

void against_camera(Examination& exam, const Stage& given, std::vector<verdict::CheckFinding>& findings,
                    verdict::CheckPictures& pictures) {
  CheckRequest::Pose pose = *exam.request.camera;
  const Vec3 asked = pose.position;
  const bool in_file_axes = !given.place && !exam.subjects.front().tile;
  if (in_file_axes) {
    pose.position = exam.frame.from_file(pose.position);
    pose.look_at = exam.frame.from_file(pose.look_at);
  }
  const Camera camera =
      make_camera(pose.position, pose.look_at, pose.fov_y_deg, pose.width_px, pose.height_px);
  const bool tiles = std::any_of(exam.subjects.begin(), exam.subjects.end(),
                                 [](const Subject& subject) { return subject.tile.has_value(); });
  const bool placed = std::all_of(exam.subjects.begin(), exam.subjects.end(), [](const Subject& subject) {
    return subject.tile && subject.tile->placed;
  });
  Stage own;
  if (tiles && !given.place) {
    if (!placed) {
      verdict::CheckFinding found;
      found.finding.code = FindingCode::nothing_judged;
      found.finding.kind = "camera";
      found.mesh = 0;
      found.at = asked;
      found.message =
          "the camera was not asked: tiles and meshes together, or tiles whose path does not say where they "
          "lie, have no common place";
      findings.push_back(std::move(found));
      return;
    }
    own = tile_stage(exam);
    exam.verdict.notes.emplace_back(
        "the camera stands in metres east, north and up of the south-west corner of all tiles");
  }
  const Stage& stage = given.place ? given : own;
  const Scene scene = assemble(exam, stage);
  const oracle::RayDevice device;
  const oracle::RaySurface surface(device, scene.mesh);
  const oracle::PixelHits hits = surface.look(camera);
  verdict::ImageVerdict& out = exam.verdict.image.emplace();
  out.camera = camera;
  std::map<std::uint32_t, std::size_t> walls;  // pixels of each
  for (const std::uint32_t t : hits.triangle) {
    if (t == oracle::PixelHits::kNoHit) continue;
    ++out.mesh_px;
    if (!scene.is_wall[t]) continue;
    ++out.skirt_px;
    ++walls[t];
  }
  if (pictures.camera || exam.request.pictures) {
    verdict::FramePictures& frame = pictures.camera.emplace();
    frame.run = "check";
    frame.threshold_px = exam.request.threshold_px;
    frame.shaded = oracle::shade(camera, surface, hits, true);
  }
  if (given.reference) {
    const oracle::RaySurface reference(device, *given.reference);
    const oracle::PixelHits reference_hits = reference.look(camera);
    oracle::ImageMaps maps;
    out.against_terrain = true;
    out.image = oracle::image_error(camera, reference, reference_hits, surface, hits,
                                    exam.request.threshold_px, &maps);
    if (pictures.camera) {
      pictures.camera->reference = oracle::shade(camera, reference, reference_hits, false);
      pictures.camera->displacement_px = std::move(maps.displacement_px);
    }
  }
  std::vector<verdict::CheckFinding*> all;
  for (Subject& subject : exam.subjects) {
    const auto index = static_cast<std::uint32_t>(&subject - exam.subjects.data());
    for (verdict::CheckFinding& found : subject.findings) {
      found.mesh = index;
      all.push_back(&found);
    }
  }
  for (verdict::CheckFinding& found : exam.between) all.push_back(&found);
  locate(exam, stage, camera, surface, all);
  out.visible_findings =
      static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const auto* found) {
        return found->finding.visibility == oracle::Visibility::visible;
      }));
  if (out.mesh_px == 0) {
    verdict::CheckFinding found;
    found.finding.code = FindingCode::nothing_judged;
    found.finding.kind = "camera";
    found.mesh = 0;
    found.at = asked;
    found.message = "the camera sees nothing of the mesh: no pixel was judged";
    findings.push_back(std::move(found));
  }
  if (walls.empty()) return;
  const auto widest = std::max_element(walls.begin(), walls.end(), [](const auto& a, const auto& b) {
    return a.second < b.second;  // of equals the first
  });
  verdict::CheckFinding found;
  found.finding.code = FindingCode::skirt_visible;
  found.finding.severity = Severity::hazard;
  found.finding.visibility = oracle::Visibility::visible;
  const auto after = std::upper_bound(scene.first.begin(), scene.first.end(), widest->first);
  found.mesh = static_cast<std::uint32_t>(after - scene.first.begin()) - 1;
  const std::uint32_t triangle = widest->first - scene.first[found.mesh];
  const Subject& subject = exam.subjects[found.mesh];
  const auto& corners = subject.mesh.triangles[triangle];
  found.finding.triangles = {triangle};
  found.finding.at = subject.mesh.positions[corners[0]];
  found.at = subject.tile && subject.tile->placed ? subject.places[corners[0]]
                                                  : exam.frame.to_file(found.finding.at);
  found.message = fmt::format(
      "{} of {} pixels that show the mesh show a skirt's wall, most of them here: the eye "
      "sees a cliff where the ground has none",
      out.skirt_px, out.mesh_px);
  findings.push_back(std::move(found));
}

}  // namespace plumbline::checking
