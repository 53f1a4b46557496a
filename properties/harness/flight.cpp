// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Judges one flight. Conformity, vertical error and shape depend on the mesh alone; image error, popping and
// visibility on the camera too.
#include "properties/harness/flight.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "oracle/conformity.h"
#include "oracle/shape.h"
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

/// How many of `a` are not in `b`; both sorted.
std::uint64_t missing_from(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  std::uint64_t count = 0;
  auto other = b.begin();
  for (const std::uint64_t key : a) {
    while (other != b.end() && *other < key) ++other;
    if (other == b.end() || *other != key) ++count;
  }
  return count;
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
};

Flight::Flight(std::unique_ptr<LodMethod> method, const TerrainStage& stage, const oracle::RayDevice& device)
    : method_(std::move(method)),
      stage_(stage),
      device_(device),
      now_(std::make_unique<LodFrame>()),
      before_(std::make_unique<LodFrame>()) {}

Flight::~Flight() = default;

void Flight::judge_mesh(Judged& judged) const {
  judged.conformity = oracle::check_conformity(now_->mesh, now_->domain);
  judged.vertical_m = oracle::vertical_error(now_->mesh, stage_.terrain);
  judged.shape = oracle::shape(now_->mesh);
  judged.surface = std::make_unique<oracle::RaySurface>(device_, now_->mesh);
}

verdict::FrameVerdict Flight::next(int index, const Camera& camera, const oracle::PixelHits& reference_hits) {
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
    keys_now_ = now_->vertex_keys;
    std::sort(keys_now_.begin(), keys_now_.end());
  }

  const Judged& judged = *judged_now_;
  verdict::FrameVerdict out;
  out.index = index;
  out.camera = camera;
  out.triangles = now_->mesh.triangles.size();
  out.vertices = now_->mesh.positions.size();
  out.conformity = judged.conformity.counts;
  out.vertical_m = judged.vertical_m;
  out.shape = judged.shape;
  out.largest_gap_m = judged.conformity.largest_gap_m;

  const oracle::PixelHits hits = judged.surface->look(camera);
  out.image = oracle::image_error(camera, *stage_.surface, reference_hits, *judged.surface, hits,
                                  method_->threshold_px());
  if (!first) {
    const Judged& earlier = unchanged ? judged : *judged_before_;
    out.pop_px = oracle::pop(camera, *judged.surface, hits, *earlier.surface);
  }

  out.findings = judged.conformity.findings;
  oracle::locate_in_picture(camera, *judged.surface, out.findings);
  for (const oracle::Finding& finding : out.findings) {
    if (!is_crack(finding) || finding.visibility != oracle::Visibility::visible) continue;
    ++out.visible_cracks;
    out.largest_gap_px = std::max(out.largest_gap_px, finding.gap_px);
  }
  keep_worst(out.findings);

  const Counters& counters = now_->counters;
  out.counters = {counters.visited, counters.evaluated, counters.split, counters.merged, 0, 0};
  if (!unchanged) {
    out.counters.entered = missing_from(keys_now_, keys_before_);
    out.counters.left = first ? 0 : missing_from(keys_before_, keys_now_);
  }
  return out;
}

}  // namespace plumbline
