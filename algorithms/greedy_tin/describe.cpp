// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// greedy_tin: near the fewest triangles that a scene needs. Role: the floor that `excess` is measured from
// (METHODS, reference methods; ORACLES O4).
//
// Source: M. Garland, P. S. Heckbert, "Fast Polygonal Approximation of Terrains and Height Fields",
// CMU-CS-95-181, 1995: greedy insertion, a heap of each triangle's worst sample, rescans of changed triangles
// only. The error is weighted to pixels (scene.h). Promises and departures: README.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "algorithms/greedy_tin/delaunay.h"
#include "algorithms/greedy_tin/scene.h"
#include "algorithms/mutant.h"
#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using greedy_tin::Delaunay;
using greedy_tin::Sample;
using greedy_tin::Scene;
using greedy_tin::Worst;

/// Bounds are met with this much to spare, relative to τ: they are made of a few dozen rounded operations.
constexpr double kSpareShare = 0x1p-30;

class GreedyTin final : public LodMethod {
 public:
  GreedyTin(bool between_samples, std::size_t most_triangles)
      : between_samples_(between_samples), most_triangles_(most_triangles) {}

  void prepare(const Terrain& terrain) override { terrain_ = &terrain; }
  void update(const Camera& camera, LodFrame& frame) override;
  void reset() override {}  // nothing is kept from frame to frame
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    auto copy = std::make_unique<GreedyTin>(between_samples_, most_triangles_);
    copy->terrain_ = terrain_;
    copy->set_threshold_px(threshold_px());
    return copy;
  }

 private:
  /// A sample that waits to be inserted, for one triangle's sake.
  struct Candidate {
    Worst worst;
    std::uint32_t triangle = 0;
    std::uint32_t version = 0;  ///< of the triangle; an older one is void
  };
  /// Order of the heap: the worst first; equal ones are the same sample, seen from two triangles.
  static bool later(const Candidate& a, const Candidate& b) {
    if (PLUMBLINE_MUTANT(gt_least_error_first)) return a.worst.before(b.worst);
    return b.worst.before(a.worst);
  }

  void offer(const Worst& worst, std::uint32_t triangle);
  void scan(const Delaunay& network, std::uint32_t triangle, double limit_px);
  void write(const Delaunay& network, LodFrame& frame);

  const Terrain* terrain_ = nullptr;
  bool between_samples_ = true;
  std::size_t most_triangles_ = 0;
  Scene scene_;
  std::vector<Candidate> heap_;
  std::vector<std::uint32_t> versions_;       ///< by triangle
  std::vector<std::uint32_t> vertex_number_;  ///< by sample
};

void GreedyTin::offer(const Worst& worst, std::uint32_t triangle) {
  heap_.push_back({worst, triangle, versions_[triangle]});
  std::push_heap(heap_.begin(), heap_.end(), later);
}

void GreedyTin::scan(const Delaunay& network, std::uint32_t triangle, double limit_px) {
  if (triangle >= versions_.size()) versions_.resize(triangle + 1, 0);
  ++versions_[triangle];
  const Worst worst = scene_.worst_sample(make_facet(*terrain_, network.corners(triangle)));
  if (worst.error_px > limit_px) offer(worst, triangle);
}

void GreedyTin::update(const Camera& camera, LodFrame& frame) {
  frame.clear();
  const Terrain& terrain = *terrain_;
  const double limit_px = threshold_px() * (1 - kSpareShare);
  scene_.look(terrain, camera);
  Delaunay network(terrain.columns, terrain.rows);
  for (const int j : {0, terrain.rows - 1}) {
    for (const int i : {0, terrain.columns - 1}) scene_.add_vertex(terrain.index(i, j));
  }
  heap_.clear();
  versions_.clear();
  std::vector<std::uint32_t> changed,
      unbounded;  // `unbounded`: changed since they were looked at between samples
  for (std::uint32_t t = 0; t < network.triangle_count(); ++t) {
    scan(network, t, limit_px);
    unbounded.push_back(t);
  }
  const auto room = [&] { return most_triangles_ == 0 || network.triangle_count() + 2 <= most_triangles_; };
  while (room()) {
    if (heap_.empty()) {
      if (!between_samples_ || unbounded.empty()) break;
      std::sort(unbounded.begin(), unbounded.end());
      unbounded.erase(std::unique(unbounded.begin(), unbounded.end()), unbounded.end());
      for (const std::uint32_t t : unbounded) {
        const Worst worst = scene_.worst_piece(make_facet(terrain, network.corners(t)), limit_px);
        if (worst.error_px > limit_px && !PLUMBLINE_MUTANT(gt_between_samples_not_seen)) offer(worst, t);
      }
      unbounded.clear();
      continue;
    }
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Candidate next = heap_.back();
    heap_.pop_back();
    if (next.version != versions_[next.triangle]) continue;
    // A sample beside the triangle may leave it as it is: look again.
    if (between_samples_) unbounded.push_back(next.triangle);
    if (scene_.is_vertex(next.worst.sample)) continue;
    const auto columns = static_cast<std::size_t>(terrain.columns);
    scene_.add_vertex(next.worst.sample);
    network.insert(
        {static_cast<int>(next.worst.sample % columns), static_cast<int>(next.worst.sample / columns)},
        next.triangle, changed);
    ++frame.counters.split;
    for (const std::uint32_t t : changed) {
      scan(network, t, limit_px);
      if (between_samples_) unbounded.push_back(t);
    }
  }
  frame.counters.visited = scene_.samples_scanned;
  frame.counters.evaluated = scene_.samples_scanned + scene_.pieces_bounded;
  write(network, frame);
}

void GreedyTin::write(const Delaunay& network, LodFrame& frame) {
  const Terrain& terrain = *terrain_;
  frame.domain = full_domain(terrain);
  vertex_number_.resize(terrain.heights_m.size());
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const std::size_t s = terrain.index(i, j);
      if (!scene_.is_vertex(s)) continue;
      vertex_number_[s] = static_cast<std::uint32_t>(frame.mesh.positions.size());
      frame.mesh.positions.push_back(terrain.point(i, j));
      frame.vertex_keys.push_back(s);
    }
  }
  for (std::uint32_t t = 0; t < network.triangle_count(); ++t) {
    const std::array<Sample, 3> at = network.corners(t);
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = vertex_number_[terrain.index(at[k].i, at[k].j)];
    frame.mesh.triangles.push_back(corners);
  }
  std::sort(frame.mesh.triangles.begin(), frame.mesh.triangles.end());
}

std::size_t whole_triangles(double number) {
  if (!(number >= 0 && number <= 4e9) || number != std::floor(number) || number == 1) {
    throw InputError(fmt::format(
        "greedy_tin: max_triangles = {} is no such number; give 0 (no limit) or a whole number from 2 to "
        "4000000000",
        number));
  }
  return static_cast<std::size_t>(number);
}

}  // namespace

MethodDescription describe_greedy_tin() {
  using enum Promise;
  return {
      .id = "greedy_tin",
      .title = "View-dependent greedy insertion of samples, Delaunay",
      .citation =
          "M. Garland, P. S. Heckbert, \"Fast Polygonal Approximation of Terrains and Height Fields\", "
          "CMU-CS-95-181, 1995",
      .section = "reference",
      .variants = {{"",
                    "the error in pixels kept under the threshold at every point of the picture",
                    {conforming, covers_domain, idempotent, path_independent, screen_error_within_tau}},
                   {"samples",
                    "kept at the samples in the picture only, as is usual",
                    {conforming, covers_domain, monotone_in_tau, idempotent, path_independent}}},
      .options = {{"max_triangles", "stop at so many triangles, whatever the error; 0: no limit", 0.0}},
      .claims = {},
      .make =
          [](std::string_view variant, const Options& options) {
            return std::make_unique<GreedyTin>(variant != "samples",
                                               whole_triangles(option_number(options, "max_triangles", 0.0)));
          },
  };
}

}  // namespace plumbline
