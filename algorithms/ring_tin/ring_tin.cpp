// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ring_tin: a TIN simplified by edge collapse inside nested square rings around the viewpoint.
//
// Paper: Yu, Zuo & Li, "A view-dependent dynamic multi-resolution terrain model of TIN" (in Chinese; METHODS
// M2). Here: section 1 (rings), 2.1 (error of an edge), 2.2 (tolerances, equation 1), 3.1 (simplification),
// 3.2 (refinement: a tree is reset and simplified again), 4 (the database, rings that change at any moment).
//
// Promises (variants say which they keep): conforming (M2.C4, "no crossing, overlapping triangles"), which
// `published` and `fixpoint` break and `guarded` keeps by docs/proofs/m2_guarded_never_folds.md; turning on
// the spot changes nothing (M2.C2). Not promised: that the path does not show (M2.S4).
//
// Departures and choices: README.md. Units: metres, pixels. Levels: 0 is the finest ring.
#include "algorithms/ring_tin/ring_tin.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "algorithms/mutant.h"

namespace plumbline::ring_tin {

RingTin::Flight::Flight(const PreparedTin& prepared, int depth_cap)
    : map(prepared.tin, prepared.adjacency, prepared.prices, depth_cap),
      levels(prepared.cells, prepared.tin.mesh.positions),
      touched(prepared.tin.mesh.positions.size(), 0) {}

void RingTin::prepare(const Terrain& terrain) {
  PlanDomain covered = full_domain(terrain);
  if (settings_.database.empty()) {
    prepare_tin(terrain_tin(terrain, settings_.points), std::move(covered));
    return;
  }
  const std::uint64_t source = fingerprint(terrain, settings_.points);
  if (!std::filesystem::exists(settings_.database)) {
    store(settings_.database, PreparedTin(terrain_tin(terrain, settings_.points), covered), source);
  }
  adopt(std::make_shared<const PreparedTin>(open_stored(settings_.database, source, std::move(covered))));
}

void RingTin::prepare_tin(tin::Tin network, PlanDomain covered) {
  adopt(std::make_shared<const PreparedTin>(std::move(network), std::move(covered)));
}

void RingTin::adopt(std::shared_ptr<const PreparedTin> prepared) {
  flight_.reset();  // refers to what was prepared before
  prepared_ = std::move(prepared);
  reset();
}

void RingTin::reset() {
  if (PLUMBLINE_MUTANT(m2_reset_forgotten) && flight_) return;
  flight_ = std::make_unique<Flight>(*prepared_, settings_.depth_cap);
}

std::unique_ptr<LodMethod> RingTin::clone() const {
  auto copy = std::make_unique<RingTin>(settings_);
  copy->set_threshold_px(threshold_px());
  if (prepared_) copy->adopt(prepared_);
  return copy;
}

void RingTin::update(const Camera& camera, LodFrame& frame) {
  Flight& f = *flight_;
  f.statistics = {};
  const std::uint64_t evaluated_before = f.map.evaluated();
  const Vec2 viewpoint{camera.position.x, camera.position.y};

  const Rings& rings = settings_.rings;
  const double focal_px = settings_.focal_px > 0 ? settings_.focal_px : camera.kappa_px;
  std::vector<double> tolerances_m;
  for (int i = 0; i < rings.levels(); ++i) {
    const int ring = PLUMBLINE_MUTANT(m2_tolerance_of_next_ring) ? std::min(i + 1, rings.levels() - 1) : i;
    tolerances_m.push_back(rings.tolerance_m(ring, threshold_px(), focal_px));
  }
  // Before the first frame every vertex is at level 0: nothing there ever collapsed.
  const bool all_anew = !f.tolerances_m.empty() && (f.tolerances_m != tolerances_m || f.rings != rings);
  f.rings = rings;
  f.tolerances_m = std::move(tolerances_m);

  if (settings_.leave_whole_trees) {
    earlier_level_.resize(f.touched.size());
    for (std::size_t v = 0; v < f.touched.size(); ++v) {
      earlier_level_[v] = static_cast<std::uint8_t>(f.levels.level(static_cast<std::uint32_t>(v)));
    }
  }
  std::vector<std::uint32_t> touched;
  const std::uint64_t visited = f.levels.move(viewpoint, rings, touched);
  if (all_anew) {
    touched.resize(f.touched.size());
    for (std::size_t v = 0; v < touched.size(); ++v) touched[v] = static_cast<std::uint32_t>(v);
  }
  f.statistics.changed = touched.size();

  // §3.2: trees in which a collapse is too coarse for its start's new level return to zero.
  std::vector<std::uint32_t> restored;
  for (const std::uint32_t v : touched) {
    if (asks_reset(v)) f.map.reset_tree(v, restored);
  }
  if (settings_.variant == Variant::guarded && !PLUMBLINE_MUTANT(m2_folds_not_mended)) {
    f.map.mend_folds(restored);
  }
  f.statistics.vertices_reset = restored.size();
  f.statistics.trees_reset = f.map.take_trees_reset();
  if (!PLUMBLINE_MUTANT(m2_restored_not_simplified)) {
    touched.insert(touched.end(), restored.begin(), restored.end());
  }

  // §3.1 for what changed.
  for (const std::uint32_t v : touched) f.touched[v] = 1;
  if (settings_.variant == Variant::fixpoint) {
    repeat(touched);
  } else {
    scan(touched);
  }
  for (const std::uint32_t v : touched) f.touched[v] = 0;
  f.map.forget_changed();

  emit(frame);
  frame.counters.visited = visited + f.statistics.candidates;
  frame.counters.evaluated = f.map.evaluated() - evaluated_before;
  frame.counters.split = f.statistics.vertices_reset;
  frame.counters.merged = f.statistics.collapses;
  frame.counters.nodes = f.touched.size() + prepared_->adjacency.edges().size();
}

bool RingTin::asks_reset(std::uint32_t v) const {
  const Flight& f = *flight_;
  const std::uint32_t edge = f.map.removed_by(v);
  if (edge == CollapseMap::kNone || PLUMBLINE_MUTANT(m2_trees_never_reset)) return false;
  if (!(f.map.error_m(edge) > f.tolerances_m[static_cast<std::size_t>(f.levels.level(v))])) return false;
  if (!settings_.leave_whole_trees) return true;
  std::vector<std::uint32_t> tree;
  f.map.members(v, tree);
  return !std::all_of(tree.begin(), tree.end(), [&](std::uint32_t member) {
    return earlier_level_[member] == earlier_level_[v] && f.levels.level(member) == f.levels.level(v);
  });
}

/// Collapses the edge if all that §3.1 asks holds.
bool RingTin::try_collapse(std::uint32_t edge) {
  Flight& f = *flight_;
  const double error_m = f.map.price(edge);
  const auto level = static_cast<std::size_t>(f.levels.level(f.map.start(edge)));
  if (PLUMBLINE_MUTANT(m2_single_level)) return false;
  if (!(error_m < f.tolerances_m[level])) return false;
  const CollapseMap::Refusal refusal = f.map.refusal(edge, settings_.variant == Variant::guarded);
  f.statistics.qualifying += refusal != CollapseMap::Refusal::border ? 1 : 0;
  switch (refusal) {
    case CollapseMap::Refusal::none:
      f.map.collapse(edge);
      ++f.statistics.collapses;
      return true;
    case CollapseMap::Refusal::depth:
      ++f.statistics.refused_depth;
      return false;
    case CollapseMap::Refusal::road:
      ++f.statistics.refused_road;
      return false;
    case CollapseMap::Refusal::fold:
      ++f.statistics.refused_fold;
      return false;
    case CollapseMap::Refusal::border:
      return false;
  }
  return false;
}

/// One pass over the active edges at the touched vertices, by index. A collapse makes no edge active, so all
/// that can come up is listed at the start.
void RingTin::scan(const std::vector<std::uint32_t>& touched) {
  Flight& f = *flight_;
  std::vector<std::uint32_t> edges;
  for (const std::uint32_t v : touched) {
    if (f.map.is_live(v)) f.map.edges_at(v, edges);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const std::uint32_t e : edges) {
    if (!f.map.is_active(e)) continue;
    ++f.statistics.candidates;
    f.map.price(e);  // turns the edge: its level is that of its start
    if (f.touched[f.map.start(e)] != 0) try_collapse(e);
  }
}

/// Until no edge qualifies, the least error first. Before the touched vertices changed none did, and what an
/// edge is judged by is its two stars, its level and the depth of its trees: so edges at touched vertices and
/// at vertices whose stars changed are all that can qualify.
void RingTin::repeat(const std::vector<std::uint32_t>& touched) {
  Flight& f = *flight_;
  using Waiting = std::pair<double, std::uint32_t>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
  std::vector<std::uint32_t> edges;
  const auto enqueue_at = [&](const std::vector<std::uint32_t>& vertices) {
    edges.clear();
    for (const std::uint32_t v : vertices) {
      if (f.map.is_live(v)) f.map.edges_at(v, edges);
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const std::uint32_t e : edges) queue.emplace(f.map.price(e), e);
  };
  std::vector<std::uint32_t> all = f.map.take_changed();
  all.insert(all.end(), touched.begin(), touched.end());
  enqueue_at(all);
  while (!queue.empty()) {
    const auto [error_m, e] = queue.top();
    queue.pop();
    // A price that changed since was queued again.
    if (!f.map.is_active(e) || f.map.price(e) != error_m) continue;
    ++f.statistics.candidates;
    if (try_collapse(e)) enqueue_at(f.map.take_changed());
  }
}

std::uint64_t RingTin::count_refused(CollapseMap::Refusal refusal) {
  Flight& f = *flight_;
  std::uint64_t count = 0;
  for (std::uint32_t e = 0; e < prepared_->adjacency.edges().size(); ++e) {
    if (!f.map.is_active(e)) continue;
    const double error_m = f.map.price(e);
    const auto level = static_cast<std::size_t>(f.levels.level(f.map.start(e)));
    if (!(error_m < f.tolerances_m[level])) continue;
    count += f.map.refusal(e, settings_.variant == Variant::guarded) == refusal ? 1 : 0;
  }
  return count;
}

/// The image of the full TIN. Vertices are numbered by rising index in the full TIN, which is their key.
void RingTin::emit(LodFrame& frame) {
  frame.clear();
  const std::vector<std::uint32_t>& rep = flight_->map.reps();
  const tin::Tin& full = prepared_->tin;
  number_.assign(rep.size(), 0);
  for (const auto& t : full.mesh.triangles) {
    const std::uint32_t a = rep[t[0]];
    const std::uint32_t b = rep[t[1]];
    const std::uint32_t c = rep[t[2]];
    if (a == b || b == c || c == a) continue;
    frame.mesh.triangles.push_back({a, b, c});
    number_[a] = number_[b] = number_[c] = 1;
  }
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < rep.size(); ++v) {
    if (number_[v] == 0) continue;
    number_[v] = next++;
    frame.mesh.positions.push_back(full.mesh.positions[v]);
    frame.vertex_keys.push_back(v);
  }
  for (auto& t : frame.mesh.triangles) t = {number_[t[0]], number_[t[1]], number_[t[2]]};
  frame.domain = prepared_->domain;
}

}  // namespace plumbline::ring_tin
