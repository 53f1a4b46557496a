// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reports/check_report.h"
#include "reports/check_words.h"
#include "reports/figures_json.h"

namespace plumbline::reports {
namespace {

using verdict::CheckedMesh;
using verdict::CheckVerdict;

Subject subject_of(const CheckedMesh& mesh) { return mesh.terrain ? Subject::terrain : Subject::mesh; }

Json mesh_ref(const CheckVerdict& verdict, std::uint32_t mesh) {
  return mesh < verdict.meshes.size() ? Json(verdict.meshes[mesh].file) : Json(nullptr);
}

Json skirt_json(const verdict::SkirtFigures& skirt) {
  if (skirt.triangles == 0 && !skirt.stated) return nullptr;
  return {{"triangles", skirt.triangles},
          {"least_depth_m", skirt.least_depth_m},
          {"border_share", skirt.border_share},
          {"stated", skirt.stated}};
}

Json mesh_json(const CheckedMesh& mesh) {
  return {
      {"file", mesh.file},
      {"triangles", mesh.triangles},
      {"vertices", mesh.vertices},
      {"format", mesh.format},
      {"held_as", mesh.terrain ? "terrain" : "object"},
      {"domain", mesh.domain},
      {"box", {{"low", xyz(mesh.box.low)}, {"high", xyz(mesh.box.high)}}},
      {"conformity", conformity_json(mesh.conformity, subject_of(mesh))},
      {"shape", shape_json(mesh.shape, mesh.terrain)},
      {"shortest_edge_m", mesh.shortest_edge_m},
      {"median_edge_m", mesh.median_edge_m},
      {"skirt", skirt_json(mesh.skirt)},
      {"least_skirt_m", mesh.least_skirt_m},
      {"self_intersections", mesh.self_intersections_judged ? Json(mesh.self_intersections) : Json(nullptr)}};
}

/// finding_json() with whose it is and where in the file; the frame's place stays beside it.
Json check_finding_json(const CheckVerdict& verdict, const verdict::CheckFinding& finding) {
  const Json plain = finding_json(finding.finding);
  Json out;
  for (auto member = plain.begin(); member != plain.end(); ++member) {
    if (member.key() == "name") {
      out["name"] = code_name(finding.finding.code);
    } else if (member.key() == "at") {
      out["mesh"] = mesh_ref(verdict, finding.mesh);
      out["other_mesh"] = mesh_ref(verdict, finding.other_mesh);
      out["at"] = xyz(finding.at);
      out["frame_at"] = *member;
    } else {
      out[member.key()] = *member;
    }
  }
  out["message"] = message_words(finding);
  return out;
}

Json seam_json(const CheckVerdict& verdict, const verdict::SeamVerdict& seam) {
  const auto level = [](int number) { return number < 0 ? Json(nullptr) : Json(number); };
  return {{"mesh", mesh_ref(verdict, seam.mesh)},
          {"other_mesh", mesh_ref(verdict, seam.other_mesh)},
          {"state", verdict::seam_state_name(seam.state)},
          {"must_meet", seam.must_meet},
          {"length_m", seam.length_m},
          {"t_junctions", seam.t_junctions},
          {"cracks", seam.cracks},
          {"largest_gap_m", seam.largest_gap_m},
          {"mean_gap_m", seam.mean_gap_m},
          {"mean_abs_gap_m", seam.mean_abs_gap_m},
          {"largest_at", seam.largest_gap_m != 0 ? xyz(seam.largest_at) : Json(nullptr)},
          {"least_skirt_m", seam.least_skirt_m},
          {"least_skirt_other_m", seam.least_skirt_other_m},
          {"quantum_m", seam.quantum_m},
          {"normal_max_deg", seam.normal_max_deg},
          {"level", level(seam.level)},
          {"other_level", level(seam.other_level)}};
}

Json seam_totals_json(const CheckVerdict& verdict) {
  const SeamTotals totals = seam_totals(verdict);
  Json out = Json::object();
  out[std::string(seam_state_name(verdict::SeamState::watertight))] = totals.watertight;
  out[std::string(seam_state_name(verdict::SeamState::covered_by_skirt))] = totals.covered;
  out[std::string(seam_state_name(verdict::SeamState::open))] = totals.open;
  return out;
}

/// The contract's figures, with their places in the file's coordinates.
Json vertical_in_file(const verdict::TerrainVerdict& terrain) {
  Json out = vertical_json(terrain.vertical_m);
  const bool any = terrain.vertical_m.area_m2 > 0;
  out["at"] = any ? xy(terrain.at) : Json(nullptr);
  out["certain_at"] = any ? xy(terrain.certain_at) : Json(nullptr);
  out["samples_max"] = judged(any, terrain.samples_max_m);
  out["samples_at"] = any ? xy(terrain.samples_at) : Json(nullptr);
  return out;
}

Json declared_json(const verdict::TerrainVerdict& terrain) {
  if (!terrain.declared_m) return nullptr;
  return {{"bound_m", *terrain.declared_m},
          {"at_samples", terrain.declared_at_samples},
          {"certain", terrain.declared_certain},
          {"everywhere", terrain.declared_everywhere}};
}

Json terrain_json(const verdict::TerrainVerdict& terrain) {
  return {{"file", terrain.file},
          {"reading", terrain.reading},
          {"placing", terrain.placing},
          {"judged_share", terrain.judged_share},
          {"diagonal_ambiguity_m", terrain.diagonal_ambiguity_m},
          {"better_match", terrain.better_match.empty() ? Json(nullptr) : Json(terrain.better_match)},
          {"declared", declared_json(terrain)}};
}

Json reference_json(const verdict::ReferenceVerdict& reference) {
  const oracle::Likeness& likeness = reference.likeness;
  Json out = {{"file", reference.file},
              {"hausdorff_m", distance_json(true, likeness.hausdorff())},
              {"to_mesh_m", distance_json(true, likeness.to_mesh)},
              {"from_mesh_m", distance_json(true, likeness.from_mesh)},
              {"normal_deg",
               {{"max", likeness.normal_max_deg},
                {"mean", likeness.normal_mean_deg},
                {"turned_share", likeness.turned_share}}},
              {"declared", nullptr}};
  if (reference.declared_m)
    out["declared"] = {{"bound_m", *reference.declared_m},
                       {"holds", reference.declared_holds},
                       {"broken", reference.declared_broken}};
  return out;
}

Json image_json(const verdict::ImageVerdict& image) {
  return {{"camera", camera_json(image.camera)},
          {"mesh_px", image.mesh_px},
          {"skirt_px", image.skirt_px},
          {"visible_findings", image.visible_findings},
          {"depth_rel", depth_json(image.image)},
          {"parallax_px", parallax_json(image.image)},
          {"silhouette_px",
           {{"pixels", judged(image.against_terrain, static_cast<double>(image.image.silhouette_pixels))},
            {"max", judged(image.against_terrain, image.image.silhouette_max_px)}}}};
}

/// Null counts only where no mesh has a plan and none of them was found.
Subject subject_of(const CheckVerdict& verdict) {
  const bool plan = verdict.meshes.empty() || std::ranges::any_of(verdict.meshes, &CheckedMesh::terrain);
  return plan ? Subject::terrain : Subject::mesh;
}

}  // namespace

std::string check_json(const CheckVerdict& verdict) {
  Json out = {{"schema", "plumbline.check/1"},
              {"verdict", verdict.sound ? "sound" : "faulty"},
              {"headline", headline_words(verdict)},
              {"frame", verdict.frame},
              {"meshes", Json::array()},
              {"conformity", conformity_json(verdict.conformity, subject_of(verdict))},
              {"tile_faults", verdict.tile_faults},
              {"findings_total", std::max(verdict.findings_total, verdict.findings.size())},
              {"findings", Json::array()},
              {"seam_states", seam_totals_json(verdict)},
              {"sufficient_skirt_m", judged(!verdict.seams.empty(), sufficient_skirt_m(verdict))},
              {"seams", Json::array()},
              {"vertical_m", verdict.terrain ? vertical_in_file(*verdict.terrain) : Json(nullptr)},
              {"displacement_px", verdict.image && verdict.image->against_terrain
                                      ? displacement_json(verdict.image->image, true)
                                      : Json(nullptr)},
              {"terrain", verdict.terrain ? terrain_json(*verdict.terrain) : Json(nullptr)},
              {"reference", verdict.reference ? reference_json(*verdict.reference) : Json(nullptr)},
              {"image", verdict.image ? image_json(*verdict.image) : Json(nullptr)},
              {"notes", verdict.notes}};
  for (const CheckedMesh& mesh : verdict.meshes) out["meshes"].push_back(mesh_json(mesh));
  for (const verdict::CheckFinding& finding : verdict.findings)
    out["findings"].push_back(check_finding_json(verdict, finding));
  for (const verdict::SeamVerdict& seam : verdict.seams) out["seams"].push_back(seam_json(verdict, seam));
  return json_text(out, 1);
}

}  // namespace plumbline::reports
