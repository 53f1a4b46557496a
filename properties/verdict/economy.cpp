// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/verdict/economy.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace plumbline::verdict {
namespace {

/// (p99, triangles), by rising p99; of equal ones the fewest triangles.
using Curve = std::vector<std::pair<double, double>>;
/// Terrain, trajectory, frame.
using Scene = std::tuple<std::string, std::string, int>;

Scene scene_of(const RunVerdict& run, const FrameVerdict& frame) {
  return {run.terrain, run.trajectory, frame.index};
}

/// Triangles at `p99_px`; 0 outside of the curve.
double needed_at(const Curve& curve, double p99_px) {
  const auto above = std::lower_bound(curve.begin(), curve.end(), std::pair{p99_px, 0.0});
  if (above == curve.end()) return 0;
  if (above->first == p99_px) return above->second;
  if (above == curve.begin()) return 0;
  const auto& [near_px, near_triangles] = *(above - 1);
  const auto& [far_px, far_triangles] = *above;
  if (!(near_px > 0)) return 0;  // no error at all: not on a falling curve
  const double share = (1 / p99_px - 1 / far_px) / (1 / near_px - 1 / far_px);
  return far_triangles + share * (near_triangles - far_triangles);
}

}  // namespace

void add_excess(SuiteVerdict& suite, const std::string& yardstick) {
  std::map<Scene, Curve> curves;
  for (const RunVerdict& run : suite.runs) {
    if (run.method != yardstick || run.subject != Subject::terrain) continue;
    for (const FrameVerdict& frame : run.frames) {
      if (frame.image.displacement_px.count == 0) continue;
      curves[scene_of(run, frame)].emplace_back(frame.image.displacement_px.p99,
                                                static_cast<double>(frame.triangles));
    }
  }
  if (curves.empty()) return;
  suite.yardstick = yardstick;
  for (auto& scene_and_curve : curves) {
    Curve& curve = scene_and_curve.second;
    std::sort(curve.begin(), curve.end());
  }
  for (RunVerdict& run : suite.runs) {
    if (run.method == yardstick || run.subject != Subject::terrain) continue;
    for (FrameVerdict& frame : run.frames) {
      const auto found = curves.find(scene_of(run, frame));
      if (found == curves.end() || frame.image.displacement_px.count == 0) continue;
      frame.economy.needed = needed_at(found->second, frame.image.displacement_px.p99);
    }
    run.summary = summarize(run.frames);
  }
}

}  // namespace plumbline::verdict
