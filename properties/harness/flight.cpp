// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Judges one flight. Conformity, vertical error and shape depend on the mesh alone; image error, popping and
// visibility on the camera too.
#include "properties/harness/flight.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <utility>

#include "oracle/conformity.h"
#include "oracle/economy.h"
#include "oracle/shape.h"
#include "oracle/soundness.h"
#include "oracle/vertical.h"

namespace plumbline {
namespace {

/// Processor time of this thread, milliseconds: what an update costs, whatever else the machine is doing.
/// Methods have no threads of their own, so nothing escapes it.
double thread_time_ms() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

bool same_surface(const LodFrame& a, const LodFrame& b) {
  return a.mesh.triangles == b.mesh.triangles && a.mesh.positions == b.mesh.positions &&
         a.domain.loops == b.domain.loops;
}

using Keys = std::vector<std::uint64_t>;

Keys sorted_keys(const LodFrame& frame) {
  Keys keys = frame.vertex_keys;
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Those of `a` that are not in `b`; both sorted.
Keys missing_from(const Keys& a, const Keys& b) {
  Keys out;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

/// A T-vertex is a crack too unless its gap is exactly zero, which makes it a hazard only.
bool is_crack(const oracle::Finding& finding) {
  return finding.code == oracle::FindingCode::crack ||
         (finding.code == oracle::FindingCode::t_junction && finding.severity == oracle::Severity::fault);
}

/// Worst first: what shows in the picture, then by size, then in the oracle's own order.
void keep_worst(std::vector<oracle::Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(), [](const oracle::Finding& a, const oracle::Finding& b) {
    const bool a_shows = a.visibility == oracle::Visibility::visible;
    const bool b_shows = b.visibility == oracle::Visibility::visible;
    if (a_shows != b_shows) return a_shows;
    if (a.severity != b.severity) return a.severity == oracle::Severity::fault;
    if (a.gap_px != b.gap_px) return a.gap_px > b.gap_px;
    const double a_gap = std::abs(a.gap_m);
    const double b_gap = std::abs(b.gap_m);
    if (a_gap != b_gap) return a_gap > b_gap;
    return a.area_m2 > b.area_m2;
  });
  if (findings.size() > verdict::FrameVerdict::kFindingsListed) {
    findings.resize(verdict::FrameVerdict::kFindingsListed);
  }
}

}  // namespace

struct Flight::Judged {
  oracle::ConformityReport conformity;
  oracle::VerticalError vertical_m;
  oracle::ShapeReport shape;
  std::unique_ptr<oracle::RaySurface> surface;
  verdict::SpaceFigures space;
};

Flight::Flight(std::unique_ptr<LodMethod> method, const TerrainStage& stage, const oracle::RayDevice& device)
    : method_(std::move(method)),
      stage_(stage),
      device_(device),
      now_(std::make_unique<LodFrame>()),
      before_(std::make_unique<LodFrame>()),
      probe_(method_->clone()),
      fresh_(std::make_unique<LodFrame>()),
      shaken_(std::make_unique<LodFrame>()),
      again_(std::make_unique<LodFrame>()) {
  probe_->set_threshold_px(method_->threshold_px());
}

Flight::~Flight() = default;

void Flight::judge_mesh(Judged& judged) const {
  if (stage_.subject == Subject::mesh) {
    judged.conformity = oracle::check_soundness(now_->mesh);
  } else {
    judged.conformity = oracle::check_conformity(now_->mesh, now_->domain);
    judged.vertical_m = oracle::vertical_error(now_->mesh, stage_.terrain);
    judged.shape = oracle::shape(now_->mesh);
  }
  judged.surface = std::make_unique<oracle::RaySurface>(device_, now_->mesh);
}

void Flight::judge_space(Judged& judged) const {
  if (judged.space.judged) return;
  // Far below what a picture of some hundred pixels shows of the object.
  constexpr double kWithinShare = 0x1p-10;  // of the reference's half diagonal
  Vec3 low = stage_.reference.positions.front(), high = low;
  for (const Vec3 p : stage_.reference.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto likeness =
      oracle::compare_in_space(now_->mesh, stage_.reference, kWithinShare * length(high - low) / 2);
  const auto pairs = oracle::self_intersections(now_->mesh);
  if (!likeness || !pairs) return;  // no manifold: reported by soundness, and these figures stay unjudged
  judged.space.judged = true;
  judged.space.likeness = *likeness;
  judged.space.self_intersections = pairs->size();
}

oracle::ImageError Flight::judge_image(const FrameScene& scene, const oracle::RaySurface& surface,
                                       const oracle::PixelHits& hits) const {
  if (stage_.subject == Subject::mesh) return oracle::ray_error(scene.camera, *scene.reference_hits, hits);
  return oracle::image_error(scene.camera, *stage_.surface, *scene.reference_hits, surface, hits,
                             method_->threshold_px());
}

oracle::PixelFigure Flight::jump(const Camera& camera, const oracle::RaySurface& now,
                                 const oracle::PixelHits& hits, const oracle::RaySurface& before) const {
  if (stage_.subject == Subject::terrain) return oracle::pop(camera, now, hits, before);
  return oracle::ray_error(camera, hits, before.look(camera)).parallax_px;
}

verdict::FrameVerdict Flight::next(const FrameScene& scene) {
  const Camera& camera = scene.camera;
  const bool first = judged_now_ == nullptr;
  // The surface of the frame before refers to that frame's mesh, so meshes and judgements change places
  // together.
  std::swap(now_, before_);
  std::swap(judged_now_, judged_before_);
  std::swap(keys_now_, keys_before_);

  const double start_ms = thread_time_ms();
  method_->update(camera, *now_);
  update_ms_ = thread_time_ms() - start_ms;

  bool unchanged = !first && same_surface(*now_, *before_);
  if (unchanged) {
    // Keep one copy of the mesh and what is known about it; popping compares it with itself.
    before_->counters = now_->counters;
    std::swap(now_, before_);
    std::swap(judged_now_, judged_before_);
    std::swap(keys_now_, keys_before_);
  } else {
    judged_now_ = std::make_unique<Judged>();
    judge_mesh(*judged_now_);
    keys_now_ = sorted_keys(*now_);
  }

  const Judged& judged = *judged_now_;
  verdict::FrameVerdict out;
  out.index = scene.index;
  out.subject = stage_.subject;
  out.camera = camera;
  out.triangles = now_->mesh.triangles.size();
  out.vertices = now_->mesh.positions.size();
  out.conformity = judged.conformity.counts;
  out.vertical_m = judged.vertical_m;
  out.shape = judged.shape;
  out.largest_gap_m = judged.conformity.largest_gap_m;

  const oracle::PixelHits hits = judged.surface->look(camera);
  out.image = judge_image(scene, *judged.surface, hits);
  const bool of_mesh = stage_.subject == Subject::mesh;
  const std::size_t judged_px = of_mesh ? out.image.depth_rel.count + out.image.silhouette_pixels
                                        : out.image.displacement_px.count + out.image.uncovered_px;
  out.nothing_judged = judged_px == 0 ? 1 : 0;
  if (!first) {
    const Judged& earlier = unchanged ? judged : *judged_before_;
    out.pop_px = jump(camera, *judged.surface, hits, *earlier.surface);
  }

  out.findings = judged.conformity.findings;
  oracle::locate_in_picture(camera, *judged.surface, out.findings);
  for (const oracle::Finding& finding : out.findings) {
    if (!is_crack(finding) || finding.visibility != oracle::Visibility::visible) continue;
    ++out.visible_cracks;
    out.largest_gap_px = std::max(out.largest_gap_px, finding.gap_px);
  }
  if (out.nothing_judged > 0) {
    oracle::Finding nothing;
    nothing.code = oracle::FindingCode::nothing_judged;
    nothing.kind = "no_pixel";
    nothing.at = camera.position;
    nothing.severity = oracle::Severity::hazard;
    nothing.visibility = oracle::Visibility::outside;
    out.findings.push_back(std::move(nothing));
  }
  keep_worst(out.findings);

  const Counters& counters = now_->counters;
  out.counters = {counters.visited, counters.evaluated, counters.split, counters.merged, 0, 0,
                  counters.nodes,   counters.drawn,     counters.tiles};
  Keys entered, left;
  if (first) {
    out.counters.entered = keys_now_.size();
  } else if (!unchanged) {
    entered = missing_from(keys_now_, keys_before_);
    left = missing_from(keys_before_, keys_now_);
    out.counters.entered = entered.size();
    out.counters.left = left.size();
  }
  if (stage_.subject == Subject::mesh) {
    if (scene.asks_all) judge_space(*judged_now_);
    // A mesh that stays keeps what was measured when it was asked for.
    out.space = judged.space;
    out.space.area_judged = true;
    out.space.projected_area = oracle::projected_area_error(*scene.reference_hits, hits);
  }
  if (scene.asks_all && stage_.subject == Subject::terrain) {
    out.economy.slack_judged = true;
    out.economy.slack = oracle::measure_slack(camera, *stage_.surface, *scene.reference_hits, *judged.surface,
                                              method_->threshold_px());
  }
  out.stability = judge_stability(scene, out, hits);
  out.stability.toggles = toggles_.next(scene.index, entered, left);
  return out;
}

verdict::StabilityFigures Flight::judge_stability(const FrameScene& scene, const verdict::FrameVerdict& frame,
                                                  const oracle::PixelHits& hits) {
  const Camera& camera = scene.camera;
  const double tau = method_->threshold_px();
  verdict::StabilityFigures out;
  out.cut = scene.cut;
  const oracle::ImageError& image = frame.image;
  // Where no pixel could be judged because there is no mesh, nothing is under a threshold.
  const bool of_mesh = stage_.subject == Subject::mesh;
  if (of_mesh) {
    out.under_threshold = image.silhouette_max_px <= tau;
  } else {
    out.under_threshold =
        image.displacement_px.count > 0 ? image.displacement_px.p99 <= tau : image.uncovered_px == 0;
  }

  probe_->reset();
  probe_->update(camera, *fresh_);
  const Keys fresh_keys = sorted_keys(*fresh_);
  const bool as_fresh = same_surface(*now_, *fresh_);
  const oracle::RaySurface* fresh_surface = judged_now_->surface.get();
  std::unique_ptr<oracle::RaySurface> own_surface;
  out.settled = as_fresh;
  if (!as_fresh) {
    own_surface = std::make_unique<oracle::RaySurface>(device_, fresh_->mesh);
    fresh_surface = own_surface.get();
    out.path_share = oracle::compare_keys(keys_now_, fresh_keys).share();
    out.path_px = jump(camera, *judged_now_->surface, hits, *fresh_surface).max;
    const oracle::ImageError fresh = judge_image(scene, *fresh_surface, fresh_surface->look(camera));
    out.settled = of_mesh ? image.silhouette_max_px <= fresh.silhouette_max_px &&
                                image.parallax_px.p99 <= fresh.parallax_px.p99
                          : image.uncovered_px <= fresh.uncovered_px &&
                                image.displacement_px.p99 <= fresh.displacement_px.p99;
  }

  const Camera shaken_camera = oracle::jittered(camera, scene.mean_depth_m);
  probe_->update(shaken_camera, *shaken_);
  if (!same_surface(*fresh_, *shaken_)) {
    // A second update that changes the mesh without any jitter is another matter: compared are second
    // updates.
    probe_->reset();
    probe_->update(camera, *again_);
    probe_->update(camera, *again_);
    out.jitter_vertices = oracle::compare_keys(sorted_keys(*again_), sorted_keys(*shaken_)).differing;
    if (!same_surface(*again_, *shaken_)) {
      const oracle::RaySurface still(device_, again_->mesh);
      const oracle::RaySurface shaken(device_, shaken_->mesh);
      out.jitter_px = jump(shaken_camera, shaken, shaken.look(shaken_camera), still).max;
    }
  }

  if (scene.comes_again) visited_[scene.index] = keys_now_;
  if (scene.first_visit >= 0) {
    out.revisit = true;
    out.revisit_share = oracle::compare_keys(keys_now_, visited_.at(scene.first_visit)).share();
  }
  return out;
}

}  // namespace plumbline
