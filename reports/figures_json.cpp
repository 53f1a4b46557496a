// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/figures_json.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace plumbline::reports {
namespace {

/// A finding's witnesses are listed up to here; their number is always given in full.
constexpr std::size_t kWitnessesListed = 16;

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

}  // namespace

Json xy(Vec2 p) { return Json::array({p.x, p.y}); }
Json xyz(Vec3 p) { return Json::array({p.x, p.y, p.z}); }

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

Json displacement_json(const oracle::ImageError& image, bool plan) {
  const oracle::PixelFigure& displacement = image.displacement_px;
  const bool seen = displacement.count > 0;
  return {{"max", judged(seen, displacement.max)},
          {"p999", judged(seen, displacement.p999)},
          {"p99", judged(seen, displacement.p99)},
          {"rms", judged(seen, displacement.rms)},
          {"mean", judged(seen, displacement.mean)},
          {"over_threshold", judged(seen, image.over_threshold)},
          {"uncovered_px", plan ? Json(image.uncovered_px) : Json(nullptr)},
          {"judged_px", displacement.count}};
}

Json parallax_json(const oracle::ImageError& image) {
  const oracle::PixelFigure& parallax = image.parallax_px;
  const bool seen = parallax.count > 0;
  return {{"max", judged(seen, parallax.max)},   {"p999", judged(seen, parallax.p999)},
          {"p99", judged(seen, parallax.p99)},   {"rms", judged(seen, parallax.rms)},
          {"mean", judged(seen, parallax.mean)}, {"judged_px", parallax.count}};
}

Json depth_json(const oracle::ImageError& image) {
  const oracle::PixelFigure& depth = image.depth_rel;
  return {{"max", judged(depth.count > 0, depth.max)},
          {"p99", judged(depth.count > 0, depth.p99)},
          {"judged_px", depth.count}};
}

Json shape_json(const oracle::ShapeReport& shape, bool plan) {
  return {{"slivers", plan ? Json(shape.slivers) : Json(nullptr)},
          {"min_quality", judged(plan, shape.min_quality)},
          {"mean_quality", judged(plan, shape.mean_quality)},
          {"least_angle_deg", judged(plan, shape.least_angle_deg)},
          {"max_valence", plan ? Json(shape.max_valence) : Json(nullptr)},
          {"mean_valence", judged(plan, shape.mean_valence)},
          {"mean_fan_length", judged(plan, shape.mean_fan_length)}};
}

Json distance_json(bool any, oracle::CertifiedDistance distance) {
  return {{"least", judged(any, distance.least_m)}, {"most", judged(any, distance.most_m)}};
}

std::string_view severity_name(oracle::Severity severity) {
  return severity == oracle::Severity::hazard ? "hazard" : "fault";
}

Json finding_json(const oracle::Finding& finding) {
  using oracle::FindingCode;
  Json out = {{"code", static_cast<int>(finding.code)},
              {"name", oracle::finding_name(finding.code)},
              {"kind", finding.kind},
              {"severity", severity_name(finding.severity)},
              {"at", xyz(finding.at)},
              {"visibility", visibility_name(finding.visibility)}};
  if (finding.code == FindingCode::crack || finding.code == FindingCode::t_junction || finding.gap_m != 0) {
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

}  // namespace plumbline::reports
