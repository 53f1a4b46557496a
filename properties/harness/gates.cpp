// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/harness/gates.h"

#include <algorithm>
#include <map>
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

}  // namespace

std::vector<verdict::GateVerdict> judge_gates(const std::vector<GateSpec>& gates,
                                              const std::vector<verdict::RunVerdict>& runs) {
  std::vector<verdict::GateVerdict> out;
  for (const verdict::RunVerdict& run : runs) {
    for (const GateSpec& gate : gates) {
      if (!gate.method.empty() && gate.method != run.method) continue;
      const bool replaced =
          gate.method.empty() && std::any_of(gates.begin(), gates.end(), [&](const GateSpec& other) {
            return other.method == run.method && other.figure == gate.figure;
          });
      if (replaced) continue;
      const double limit = gate.times_tau ? gate.bound * run.threshold_px : gate.bound;
      verdict::GateVerdict judged;
      judged.name = gate.method.empty() ? gate.text : fmt::format("{}: {}", gate.method, gate.text);
      judged.run = run.id;
      judged.limit = gate.times_tau ? fmt::format("{} {} tau ({} px)", gate.comparison, gate.bound, limit)
                                    : fmt::format("{} {}", gate.comparison, limit);
      judged.value = verdict::figure_value(run.summary, gate.figure);
      judged.pass = holds(judged.value, gate.comparison, limit);
      out.push_back(std::move(judged));
    }
  }
  return out;
}

std::vector<std::string> find_vacuous(const std::vector<verdict::RunVerdict>& runs) {
  std::vector<std::string> out;
  if (runs.empty()) out.emplace_back("no run: nothing was judged");
  // Mean triangles of each threshold, by what else the run was made of.
  std::map<std::string, std::vector<const verdict::RunVerdict*>> families;
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
    if (summary.image.displacement_px.count == 0)
      out.push_back(fmt::format("{}: no pixel to measure", run.id));
    if (!(summary.vertical_m.area_m2 > 0)) out.push_back(fmt::format("{}: no area to measure", run.id));
    families[run.method].push_back(&run);
  }
  for (const auto& [method, members] : families) {
    const MethodChoice choice = find_method(method);
    if (choice.promises(Promise::threshold_blind)) continue;
    const std::size_t triangles = members.front()->summary.triangles_min;
    const auto same_count = [triangles](const verdict::RunVerdict* run) {
      return run->summary.triangles_min == triangles && run->summary.triangles_max == triangles;
    };
    const std::size_t judged_frames = members.front()->summary.frames * members.size();
    if (judged_frames > 1 && std::all_of(members.begin(), members.end(), same_count)) {
      out.push_back(fmt::format("{}: one level of detail: {} triangles in every frame at every threshold",
                                method, triangles));
    }
  }
  return out;
}

}  // namespace plumbline
