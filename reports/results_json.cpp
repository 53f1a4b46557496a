// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/figures_json.h"
#include "reports/json_text.h"
#include "reports/report.h"
#include "reports/selftest_text.h"

namespace plumbline::reports {
namespace {

using verdict::FrameVerdict;
using verdict::RunSummary;

Json stability_json(const verdict::StabilityFigures& frame) {
  return {{"cut", frame.cut},
          {"under_threshold", frame.under_threshold},
          {"settled", frame.settled},
          {"toggles", frame.toggles},
          {"jitter_vertices", frame.jitter_vertices},
          {"jitter_px", frame.jitter_px},
          {"path_share", frame.path_share},
          {"path_px", frame.path_px},
          {"revisit_share", judged(frame.revisit, frame.revisit_share)}};
}

Json stability_json(const verdict::StabilitySummary& run) {
  return {{"cuts", run.cuts},
          {"recovery_frames", judged(run.cuts > 0, run.recovery_frames)},
          {"unrecovered", judged(run.cuts > 0, static_cast<double>(run.unrecovered))},
          {"lag_frames", judged(run.cuts > 0, run.lag_frames)},
          {"unsettled", judged(run.cuts > 0, static_cast<double>(run.unsettled))},
          {"toggles", run.toggles},
          {"jitter_vertices", run.jitter_vertices},
          {"jitter_px", run.jitter_px},
          {"path_share", run.path_share},
          {"path_px", run.path_px},
          {"revisits", run.revisits},
          {"revisit_share", judged(run.revisits > 0, run.revisit_share)}};
}

Json economy_json(const FrameVerdict& frame) {
  const verdict::EconomyFigures& economy = frame.economy;
  return {{"excess", judged(economy.needed > 0, static_cast<double>(frame.triangles) / economy.needed)},
          {"needed_triangles", judged(economy.needed > 0, economy.needed)},
          {"slack", judged(economy.slack_judged, economy.slack.share())},
          {"slack_in_view", judged(economy.slack_judged, economy.slack.share_in_view())}};
}

Json economy_json(const RunSummary& run) {
  const verdict::EconomySummary& economy = run.economy;
  const bool any = economy.slack_frames > 0;
  return {{"excess", judged(economy.excess_frames > 0, economy.drawn / economy.needed)},
          {"excess_frames", economy.excess_frames},
          {"slack", judged(any, economy.slack.share())},
          {"slack_in_view", judged(any, economy.slack.share_in_view())},
          {"slack_frames", economy.slack_frames},
          {"stars_not_judged", economy.slack.not_judged}};
}

/// O7. Frames of terrains have none of it; their summaries say so, figure by figure.
void add_space(Json& out, const FrameVerdict& frame) {
  if (frame.subject == Subject::terrain) return;
  const verdict::SpaceFigures& space = frame.space;
  const bool any = space.judged;
  const oracle::Likeness& likeness = space.likeness;
  out["self_intersection"] = any ? Json(space.self_intersections) : Json(nullptr);
  out["hausdorff_m"] = distance_json(any, likeness.hausdorff());
  out["to_mesh_m"] = distance_json(any, likeness.to_mesh);
  out["from_mesh_m"] = distance_json(any, likeness.from_mesh);
  out["normal_deg"] = {{"max", judged(any, likeness.normal_max_deg)},
                       {"mean", judged(any, likeness.normal_mean_deg)},
                       {"turned_share", judged(any, likeness.turned_share)}};
  out["projected_area"] = judged(space.area_judged, space.projected_area);
}

void add_space(Json& out, const RunSummary& run) {
  const verdict::SpaceSummary& space = run.space;
  const bool any = space.frames > 0;
  out["self_intersection"] = any ? Json(space.self_intersections) : Json(nullptr);
  out["hausdorff_m"] = distance_json(any, space.hausdorff_m);
  out["normal_deg"] = {{"max", judged(any, space.normal_max_deg)},
                       {"mean", judged(any, space.normal_mean_deg)},
                       {"turned_share", judged(any, space.turned_share)}};
  out["projected_area"] = judged(space.area_frames > 0, space.projected_area);
}

/// What a frame and a trajectory have in common, in CONTRACT's order.
template <class Judged>
void add_figures(Json& out, const Judged& frame) {
  const bool plan = frame.subject == Subject::terrain;
  out["conformity"] = conformity_json(frame.conformity, frame.subject);
  out["visible_cracks"] = plan ? Json(frame.visible_cracks) : Json(nullptr);
  out["largest_gap_m"] = judged(plan, frame.largest_gap_m);
  out["largest_gap_px"] = judged(plan, frame.largest_gap_px);
  out["nothing_judged"] = frame.nothing_judged;
  out["vertical_m"] = vertical_json(frame.vertical_m);
  out["displacement_px"] = displacement_json(frame.image, plan);
  out["parallax_px"] = parallax_json(frame.image);
  out["depth_rel"] = depth_json(frame.image);
  out["silhouette_px"] = {{"pixels", frame.image.silhouette_pixels}, {"max", frame.image.silhouette_max_px}};
  out["pop_px"] = {{"max", judged(frame.pop_px.count > 0, frame.pop_px.max)},
                   {"p99", judged(frame.pop_px.count > 0, frame.pop_px.p99)},
                   {"judged_px", frame.pop_px.count}};
  out["stability"] = stability_json(frame.stability);
  out["economy"] = economy_json(frame);
  add_space(out, frame);
  out["shape"] = shape_json(frame.shape, plan);
  const verdict::CounterFigures& counters = frame.counters;
  out["counters"] = {
      {"visited", counters.visited}, {"evaluated", counters.evaluated}, {"split", counters.split},
      {"merged", counters.merged},   {"entered", counters.entered},     {"left", counters.left},
      {"nodes", counters.nodes},     {"drawn", counters.drawn},         {"tiles", counters.tiles}};
}

Json frame_json(const FrameVerdict& frame) {
  Json out = {{"index", frame.index},
              {"camera", camera_json(frame.camera)},
              {"triangles", frame.triangles},
              {"vertices", frame.vertices}};
  add_figures(out, frame);
  out["findings"] = Json::array();
  for (const oracle::Finding& finding : frame.findings) out["findings"].push_back(finding_json(finding));
  return out;
}

Json summary_json(const RunSummary& summary) {
  Json out = {{"frames", summary.frames},
              {"triangles", summary.triangles},
              {"triangles_min", summary.triangles_min},
              {"triangles_max", summary.triangles_max},
              {"vertices", summary.vertices}};
  add_figures(out, summary);
  out["worst_frame"] = summary.worst_frame;
  return out;
}

Json run_json(const verdict::RunVerdict& run) {
  Json out = {{"id", run.id},         {"terrain", run.terrain},           {"trajectory", run.trajectory},
              {"method", run.method}, {"threshold_px", run.threshold_px}, {"frames", Json::array()}};
  if (run.subject == Subject::mesh) out["subject"] = "mesh";  // absent: a terrain
  for (const FrameVerdict& frame : run.frames) out["frames"].push_back(frame_json(frame));
  out["summary"] = summary_json(run.summary);
  return out;
}

}  // namespace

std::string results_json(const verdict::SuiteVerdict& verdict) {
  Json out = {{"schema", "plumbline.results/1"},
              {"suite", verdict.suite},
              {"yardstick", verdict.yardstick.empty() ? Json(nullptr) : Json(verdict.yardstick)},
              {"pass", verdict.pass()},
              {"interrupted", verdict.interrupted},
              {"viewport", Json::array({verdict.width_px, verdict.height_px})},
              {"fov_y_deg", verdict.fov_y_deg},
              {"terrains", Json::array()},
              {"runs", Json::array()},
              {"gates", Json::array()},
              {"vacuous", verdict.vacuous}};
  for (const verdict::TerrainFacts& terrain : verdict.terrains)
    out["terrains"].push_back({{"id", terrain.id},
                               {"columns", terrain.columns},
                               {"rows", terrain.rows},
                               {"spacing_m", terrain.spacing_m},
                               {"lowest_m", terrain.lowest_m},
                               {"highest_m", terrain.highest_m},
                               {"diagonal_ambiguity_m", terrain.diagonal_ambiguity_m}});
  for (const verdict::MeshFacts& mesh : verdict.meshes) {
    out["meshes"].push_back({{"id", mesh.id},
                             {"objects", mesh.objects},
                             {"triangles", mesh.triangles},
                             {"vertices", mesh.vertices},
                             {"center", xyz(mesh.center)},
                             {"radius_m", mesh.radius_m},
                             {"object_radius_m", mesh.object_radius_m}});
  }
  for (const verdict::RunVerdict& run : verdict.runs) out["runs"].push_back(run_json(run));
  for (const verdict::GateVerdict& gate : verdict.gates) {
    Json one = {{"name", gate.name},
                {"run", gate.run},
                {"limit", gate.limit},
                {"value", gate.value},
                {"pass", gate.pass}};
    if (gate.expected) one["expected"] = true;  // absent: a gate that asks for what is promised
    if (!gate.note.empty()) one["note"] = gate.note;
    out["gates"].push_back(std::move(one));
  }
  if (!verdict.selftest.kinds.empty()) out["selftest"] = selftest_object(verdict.selftest);
  return json_text(out, 3);
}

}  // namespace plumbline::reports
