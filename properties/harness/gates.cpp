// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/harness/gates.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace plumbline {
namespace {

bool holds(double value, const std::string& comparison, double limit) {
  if (comparison == "<=") return value <= limit;
  if (comparison == "<") return value < limit;
  if (comparison == ">=") return value >= limit;
  if (comparison == ">") return value > limit;
  return value == limit;
}

/// Whether the run measured anything for this figure; a limit on nothing must not hold (ORACLES, "Never
/// vacuous").
bool was_judged(const verdict::RunSummary& summary, std::string_view figure) {
  const auto of = [figure](std::string_view group) { return figure.substr(0, group.size()) == group; };
  if (of("vertical_m.")) return summary.vertical_m.area_m2 > 0;
  if (figure == "displacement_px.uncovered_px") {
    return summary.image.displacement_px.count + summary.image.uncovered_px > 0;
  }
  if (of("displacement_px.")) return summary.image.displacement_px.count > 0;
  if (of("parallax_px.")) return summary.image.parallax_px.count > 0;
  if (of("depth_rel.")) return summary.image.depth_rel.count > 0;
  if (summary.subject == Subject::mesh && of("silhouette_px.")) {
    return summary.image.depth_rel.count + summary.image.silhouette_pixels > 0;
  }
  if (of("pop_px."))
    return summary.pop_px.count > 0 || summary.frames == 1;  // one frame has nothing to pop from
  return summary.frames > 0;
}

/// Whether a run has what the figure is about: a plan to cover, a cut to recover from, a camera that comes
/// again. A flight without it is not asked.
bool is_about(const verdict::RunSummary& summary, std::string_view figure) {
  if (!verdict::was_asked(summary.subject, figure)) return false;
  if (figure == "stability.revisit_share") return summary.stability.revisits > 0;
  for (const std::string_view after_cut : {"stability.recovery_frames", "stability.unrecovered",
                                           "stability.lag_frames", "stability.unsettled"}) {
    if (figure == after_cut) return summary.stability.cuts > 0;
  }
  return true;
}

/// What holds where a suite asks for nothing: a forgotten gate table must not turn findings green.
std::vector<GateSpec> default_gates(const std::vector<verdict::RunVerdict>& runs) {
  std::vector<GateSpec> gates;
  for (const char* figure : {"crack", "t_junction", "fold_over", "degenerate", "hole", "overlap", "outline",
                             "non_manifold", "duplicate", "non_finite", "bad_index", "unused_vertex"}) {
    // Where every run is about a mesh, plan findings are nobody's.
    if (!runs.empty() && std::none_of(runs.begin(), runs.end(), [&](const verdict::RunVerdict& run) {
          return verdict::was_asked(run.subject, figure);
        })) {
      continue;
    }
    gates.push_back({figure, "", "==", 0, false, fmt::format("{} == 0, by default", figure)});
  }
  return gates;
}

}  // namespace

std::vector<verdict::GateVerdict> judge_gates(const std::vector<GateSpec>& asked,
                                              const std::vector<verdict::RunVerdict>& runs) {
  const std::vector<GateSpec> gates = asked.empty() ? default_gates(runs) : asked;
  std::vector<verdict::GateVerdict> out;
  for (const verdict::RunVerdict& run : runs) {
    for (const GateSpec& gate : gates) {
      if (!gate.method.empty() && gate.method != run.method) continue;
      const bool replaced =
          gate.method.empty() && std::any_of(gates.begin(), gates.end(), [&](const GateSpec& other) {
            return other.method == run.method && other.figure == gate.figure;
          });
      if (replaced || !is_about(run.summary, gate.figure)) continue;
      const double limit = gate.times_tau ? gate.bound * run.threshold_px : gate.bound;
      verdict::GateVerdict judged;
      judged.name = gate.method.empty() ? gate.text : fmt::format("{}: {}", gate.method, gate.text);
      judged.run = run.id;
      judged.limit = gate.times_tau ? fmt::format("{} {} tau ({} px)", gate.comparison, gate.bound, limit)
                                    : fmt::format("{} {}", gate.comparison, limit);
      judged.value = verdict::figure_value(run.summary, gate.figure);
      judged.pass = holds(judged.value, gate.comparison, limit);
      if (!was_judged(run.summary, gate.figure)) {
        judged.value = std::numeric_limits<double>::quiet_NaN();
        judged.pass = false;
      }
      out.push_back(std::move(judged));
    }
  }
  // A gate that no run was asked for has judged nothing, and must not look like one that holds.
  for (const GateSpec& gate : gates) {
    const auto mine = [&](const verdict::RunVerdict& run) {
      return gate.method.empty() || gate.method == run.method;
    };
    const auto first = std::find_if(runs.begin(), runs.end(), mine);
    if (first == runs.end()) continue;
    if (std::any_of(runs.begin(), runs.end(), [&](const verdict::RunVerdict& run) {
          return mine(run) && is_about(run.summary, gate.figure);
        })) {
      continue;
    }
    out.push_back({gate.method.empty() ? gate.text : fmt::format("{}: {}", gate.method, gate.text), first->id,
                   fmt::format("{} {}", gate.comparison, gate.bound),
                   std::numeric_limits<double>::quiet_NaN(), false});
  }
  return out;
}

std::vector<std::string> find_vacuous(const std::vector<verdict::RunVerdict>& runs) {
  std::vector<std::string> out;
  if (runs.empty()) out.emplace_back("no run: nothing was judged");
  std::map<std::string, std::map<std::string, std::vector<const verdict::RunVerdict*>>>
      families;  // method, terrain
  for (const verdict::RunVerdict& run : runs) {
    const verdict::RunSummary& summary = run.summary;
    if (summary.frames == 0) {
      out.push_back(fmt::format("{}: no frame", run.id));
      continue;
    }
    if (summary.triangles_max == 0) {
      out.push_back(fmt::format("{}: no triangle in any frame", run.id));
      continue;
    }
    const bool mesh = run.subject == Subject::mesh;
    if ((mesh ? summary.image.depth_rel : summary.image.displacement_px).count == 0)
      out.push_back(fmt::format("{}: no pixel to measure", run.id));
    if (!mesh && !(summary.vertical_m.area_m2 > 0))
      out.push_back(fmt::format("{}: no area to measure", run.id));
    families[run.method][run.terrain].push_back(&run);
  }
  for (const auto& [method, grounds] : families) {
    if (find_method(method).promises(Promise::threshold_blind)) continue;
    // A flat terrain may need one level; a method that shows one on every terrain of the suite has no levels.
    std::size_t frames = 0;
    const bool one_level = std::all_of(grounds.begin(), grounds.end(), [&](const auto& ground) {
      const std::size_t triangles = ground.second.front()->summary.triangles_min;
      return std::all_of(ground.second.begin(), ground.second.end(), [&](const verdict::RunVerdict* run) {
        frames += run->summary.frames;
        return run->summary.triangles_min == triangles && run->summary.triangles_max == triangles;
      });
    });
    if (one_level && frames > grounds.size()) {
      out.push_back(fmt::format(
          "{}: one level of detail: the same number of triangles in every frame at every threshold", method));
    }
  }
  return out;
}

}  // namespace plumbline
