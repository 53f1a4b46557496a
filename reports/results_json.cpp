// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <span>
#include <string_view>

#include "reports/json_text.h"
#include "reports/report.h"
#include "reports/selftest_text.h"

namespace plumbline::reports {
namespace {

using verdict::FrameVerdict;
using verdict::RunSummary;

/// A finding's witnesses are listed up to here; their number is always given in full.
constexpr std::size_t kWitnessesListed = 16;

Json xy(Vec2 p) { return Json::array({p.x, p.y}); }
Json xyz(Vec3 p) { return Json::array({p.x, p.y, p.z}); }

/// A figure that nothing was judged for is null, which no reader can take for a perfect score.
Json judged(bool any, double value) { return any ? Json(value) : Json(nullptr); }

Json camera_json(const Camera& camera) {
  return {{"position", xyz(camera.position)},
          {"forward", xyz(camera.forward)},
          {"up", xyz(camera.up)},
          {"fov_y_deg", camera.fov_y_deg},
          {"viewport", Json::array({camera.width_px, camera.height_px})}};
}

Json conformity_json(const oracle::ConformityCounts& counts, Subject subject) {
  if (subject == Subject::mesh) {  // no plan: what was not asked is null, not zero
    return {{"crack", nullptr},
            {"t_junction", nullptr},
            {"fold_over", nullptr},
            {"degenerate", counts.degenerate},
            {"hole", nullptr},
            {"overlap", nullptr},
            {"outline", nullptr},
            {"non_manifold", counts.non_manifold},
            {"duplicate", counts.duplicate},
            {"non_finite", counts.non_finite},
            {"bad_index", counts.bad_index},
            {"unused_vertex", counts.unused_vertex}};
  }
  return {{"crack", counts.crack},         {"t_junction", counts.t_junction},
          {"fold_over", counts.fold_over}, {"degenerate", counts.degenerate},
          {"hole", counts.hole},           {"overlap", counts.overlap},
          {"outline", counts.outline},     {"non_manifold", counts.non_manifold},
          {"duplicate", counts.duplicate}, {"non_finite", counts.non_finite},
          {"bad_index", counts.bad_index}, {"unused_vertex", counts.unused_vertex}};
}

Json vertical_json(const oracle::VerticalError& error) {
  const bool any = error.area_m2 > 0;
  return {{"max", judged(any, error.max)},
          {"certain_max", judged(any, error.certain_max)},
          {"rms", judged(any, error.rms)},
          {"mean", judged(any, error.mean)},
          {"at", any ? xy(error.at) : Json(nullptr)},
          {"certain_at", any ? xy(error.certain_at) : Json(nullptr)},
          {"area_m2", error.area_m2}};
}

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

Json distance_json(bool any, oracle::CertifiedDistance distance) {
  return {{"least", judged(any, distance.least_m)}, {"most", judged(any, distance.most_m)}};
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
  const oracle::PixelFigure& displacement = frame.image.displacement_px;
  const oracle::PixelFigure& depth = frame.image.depth_rel;
  const bool seen = displacement.count > 0;
  const bool plan = frame.subject == Subject::terrain;
  out["conformity"] = conformity_json(frame.conformity, frame.subject);
  out["visible_cracks"] = plan ? Json(frame.visible_cracks) : Json(nullptr);
  out["largest_gap_m"] = judged(plan, frame.largest_gap_m);
  out["largest_gap_px"] = judged(plan, frame.largest_gap_px);
  out["nothing_judged"] = frame.nothing_judged;
  out["vertical_m"] = vertical_json(frame.vertical_m);
  out["displacement_px"] = {{"max", judged(seen, displacement.max)},
                            {"p999", judged(seen, displacement.p999)},
                            {"p99", judged(seen, displacement.p99)},
                            {"rms", judged(seen, displacement.rms)},
                            {"mean", judged(seen, displacement.mean)},
                            {"over_threshold", judged(seen, frame.image.over_threshold)},
                            {"uncovered_px", plan ? Json(frame.image.uncovered_px) : Json(nullptr)},
                            {"judged_px", displacement.count}};
  const oracle::PixelFigure& parallax = frame.image.parallax_px;
  out["parallax_px"] = {{"max", judged(parallax.count > 0, parallax.max)},
                        {"p999", judged(parallax.count > 0, parallax.p999)},
                        {"p99", judged(parallax.count > 0, parallax.p99)},
                        {"rms", judged(parallax.count > 0, parallax.rms)},
                        {"mean", judged(parallax.count > 0, parallax.mean)},
                        {"judged_px", parallax.count}};
  out["depth_rel"] = {{"max", judged(depth.count > 0, depth.max)},
                      {"p99", judged(depth.count > 0, depth.p99)},
                      {"judged_px", depth.count}};
  out["silhouette_px"] = {{"pixels", frame.image.silhouette_pixels}, {"max", frame.image.silhouette_max_px}};
  out["pop_px"] = {{"max", judged(frame.pop_px.count > 0, frame.pop_px.max)},
                   {"p99", judged(frame.pop_px.count > 0, frame.pop_px.p99)},
                   {"judged_px", frame.pop_px.count}};
  out["stability"] = stability_json(frame.stability);
  out["economy"] = economy_json(frame);
  add_space(out, frame);
  out["shape"] = {{"slivers", plan ? Json(frame.shape.slivers) : Json(nullptr)},
                  {"min_quality", judged(plan, frame.shape.min_quality)},
                  {"mean_quality", judged(plan, frame.shape.mean_quality)},
                  {"least_angle_deg", judged(plan, frame.shape.least_angle_deg)},
                  {"max_valence", plan ? Json(frame.shape.max_valence) : Json(nullptr)},
                  {"mean_valence", judged(plan, frame.shape.mean_valence)},
                  {"mean_fan_length", judged(plan, frame.shape.mean_fan_length)}};
  const verdict::CounterFigures& counters = frame.counters;
  out["counters"] = {
      {"visited", counters.visited}, {"evaluated", counters.evaluated}, {"split", counters.split},
      {"merged", counters.merged},   {"entered", counters.entered},     {"left", counters.left},
      {"nodes", counters.nodes},     {"drawn", counters.drawn},         {"tiles", counters.tiles}};
}

std::string_view severity_name(oracle::Severity severity) {
  return severity == oracle::Severity::hazard ? "hazard" : "fault";
}

std::string_view visibility_name(oracle::Visibility visibility) {
  switch (visibility) {
    case oracle::Visibility::unknown:
      return "unknown";
    case oracle::Visibility::outside:
      return "outside";
    case oracle::Visibility::occluded:
      return "occluded";
    case oracle::Visibility::visible:
      return "visible";
  }
  return "unknown";
}

template <class Item, class Show>
void add_witnesses(Json& out, const char* name, const std::vector<Item>& items, Show show) {
  if (items.empty()) return;
  Json listed = Json::array();
  for (const Item& item : std::span(items).first(std::min(items.size(), kWitnessesListed)))
    listed.push_back(show(item));
  out[name] = std::move(listed);
  if (items.size() > kWitnessesListed) out[std::string(name) + "_count"] = items.size();
}

Json finding_json(const oracle::Finding& finding) {
  using oracle::FindingCode;
  Json out = {{"code", static_cast<int>(finding.code)},
              {"name", oracle::finding_name(finding.code)},
              {"kind", finding.kind},
              {"severity", severity_name(finding.severity)},
              {"at", xyz(finding.at)},
              {"visibility", visibility_name(finding.visibility)}};
  if (finding.code == FindingCode::crack || finding.code == FindingCode::t_junction) {
    out["gap_m"] = finding.gap_m;
    out["gap_px"] = finding.gap_px;
  }
  if (finding.area_m2 != 0) out["area_m2"] = finding.area_m2;
  if (finding.distance_m != 0) out["distance_m"] = finding.distance_m;
  const auto as_is = [](std::uint32_t index) { return Json(index); };
  add_witnesses(out, "vertices", finding.vertices, as_is);
  add_witnesses(out, "triangles", finding.triangles, as_is);
  add_witnesses(out, "loop", finding.loop, xy);
  return out;
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
