// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/harness/gates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "properties/verdict/comparison.h"
#include "scenarios/expected_file.h"

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

/// Whether the gate is for this run: its own method's, or a general one that the method does not replace.
bool asks(const GateSpec& gate, const std::vector<GateSpec>& gates, const verdict::RunVerdict& run) {
  if (!gate.method.empty() && gate.method != run.method) return false;
  const bool replaced =
      gate.method.empty() && std::any_of(gates.begin(), gates.end(), [&](const GateSpec& other) {
        return other.method == run.method && other.figure == gate.figure;
      });
  return !replaced && is_about(run.summary, gate.figure);
}

/// All but the name.
verdict::GateVerdict judge(const GateSpec& gate, const verdict::RunVerdict& run) {
  const double limit = gate.times_tau ? gate.bound * run.threshold_px : gate.bound;
  verdict::GateVerdict judged;
  judged.run = run.id;
  judged.limit = gate.times_tau ? fmt::format("{} {} tau ({} px)", gate.comparison, gate.bound, limit)
                                : fmt::format("{} {}", gate.comparison, limit);
  judged.value = verdict::figure_value(run.summary, gate.figure);
  judged.pass = holds(judged.value, gate.comparison, limit);
  judged.figure = gate.figure;
  if (!was_judged(run.summary, gate.figure)) {
    judged.value = std::numeric_limits<double>::quiet_NaN();
    judged.pass = false;
  }
  return judged;
}

/// "211 crack", "displacement_px.p99 of 2.5", ">= 1 crack"
std::string expected_words(const GateSpec& limit) {
  const std::string bound =
      fmt::format("{}{}{}{}", limit.comparison == "==" ? "" : limit.comparison,
                  limit.comparison == "==" ? "" : " ", limit.bound, limit.times_tau ? " tau" : "");
  return limit.figure.find('.') == std::string::npos ? fmt::format("{} {}", bound, limit.figure)
                                                     : fmt::format("{} of {}", limit.figure, bound);
}

std::string expected_name(const Expectation& one) {
  return fmt::format("expected: {} ({})", one.limit.figure, one.why);
}

verdict::GateVerdict judge_expected(const Expectation& one, const std::vector<GateSpec>& gates,
                                    const verdict::RunVerdict& run) {
  verdict::GateVerdict judged = judge(one.limit, run);
  judged.name = expected_name(one);
  judged.expected = true;
  judged.why = one.why;
  std::string replaced;  // what was asked before anything was expected
  bool any = false, all_hold = true;
  for (const GateSpec& gate : gates) {
    if (gate.figure != one.limit.figure || !asks(gate, gates, run)) continue;
    any = true;
    all_hold = all_hold && judge(gate, run).pass;
    replaced = gate.text;
  }
  judged.needless = any && all_hold;
  if (!is_about(run.summary, one.limit.figure)) {
    judged.value = std::numeric_limits<double>::quiet_NaN();
    judged.pass = false;
  }
  if (judged.pass) return judged;
  const std::string head = fmt::format("expected {} ({})", expected_words(one.limit), one.why);
  if (std::isnan(judged.value)) {
    judged.note = head + ", and nothing was measured: remove the expectation, or see why";
    return judged;
  }
  const double limit = one.limit.times_tau ? one.limit.bound * run.threshold_px : one.limit.bound;
  const verdict::Change change =
      verdict::figure_change(verdict::figure_direction(one.limit.figure), limit, judged.value);
  judged.note = fmt::format("{}, found {}: ", head, judged.value);
  if (judged.needless) {
    judged.note += fmt::format("\"{}\" holds now, remove the expectation", replaced);
  } else if (change == verdict::Change::worse) {
    judged.note += "worse";
  } else {
    judged.note += fmt::format("{}? update the expectation", verdict::change_name(change));
  }
  return judged;
}

verdict::GateVerdict expected_of_no_run(const Expectation& one) {
  verdict::GateVerdict judged;
  judged.name = expected_name(one);
  judged.run = one.run;
  judged.limit =
      fmt::format("{} {}{}", one.limit.comparison, one.limit.bound, one.limit.times_tau ? " tau" : "");
  judged.value = std::numeric_limits<double>::quiet_NaN();
  judged.figure = one.limit.figure;
  judged.expected = true;
  judged.why = one.why;
  judged.note = fmt::format("expected {} ({}) of a run that was not flown: remove the expectation",
                            expected_words(one.limit), one.why);
  return judged;
}

/// For each run what is expected of it, in the file's order.
std::vector<std::vector<const Expectation*>> sort_by_run(const std::vector<Expectation>& expected,
                                                         const std::vector<verdict::RunVerdict>& runs) {
  std::map<std::string_view, std::vector<const Expectation*>> by_name;
  std::vector<const Expectation*> patterns;
  for (const Expectation& one : expected) {
    if (one.run.find('*') == std::string::npos) {
      by_name[one.run].push_back(&one);
    } else {
      patterns.push_back(&one);
    }
  }
  std::vector<std::vector<const Expectation*>> out(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (const auto named = by_name.find(runs[r].id); named != by_name.end()) out[r] = named->second;
    for (const Expectation* pattern : patterns) {
      if (run_matches(pattern->run, runs[r].id)) out[r].push_back(pattern);
    }
    std::sort(out[r].begin(), out[r].end());  // all of one vector: addresses are its order
  }
  return out;
}

}  // namespace

std::vector<verdict::GateVerdict> judge_gates(const std::vector<GateSpec>& asked,
                                              const std::vector<verdict::RunVerdict>& runs,
                                              const std::vector<Expectation>& expected) {
  const std::vector<GateSpec> gates = asked.empty() ? default_gates(runs) : asked;
  const std::vector<std::vector<const Expectation*>> expected_of = sort_by_run(expected, runs);
  std::vector<verdict::GateVerdict> out;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const verdict::RunVerdict& run = runs[r];
    for (const GateSpec& gate : gates) {
      const bool stood_in_for =
          std::any_of(expected_of[r].begin(), expected_of[r].end(),
                      [&](const auto* one) { return one->limit.figure == gate.figure; });
      if (stood_in_for || !asks(gate, gates, run)) continue;
      verdict::GateVerdict judged = judge(gate, run);
      judged.name = gate.method.empty() ? gate.text : fmt::format("{}: {}", gate.method, gate.text);
      out.push_back(std::move(judged));
    }
    for (const Expectation* one : expected_of[r]) out.push_back(judge_expected(*one, gates, run));
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
    verdict::GateVerdict idle;
    idle.name = gate.method.empty() ? gate.text : fmt::format("{}: {}", gate.method, gate.text);
    idle.run = first->id;
    idle.limit = fmt::format("{} {}", gate.comparison, gate.bound);
    idle.value = std::numeric_limits<double>::quiet_NaN();
    idle.figure = gate.figure;
    out.push_back(std::move(idle));
  }
  std::set<const Expectation*> used;
  for (const auto& of_run : expected_of) used.insert(of_run.begin(), of_run.end());
  for (const Expectation& one : expected) {
    if (used.count(&one) == 0) out.push_back(expected_of_no_run(one));
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
    const MethodChoice choice = find_method(method);
    if (choice.promises(Promise::threshold_blind)) continue;
    if (choice.promises(Promise::camera_blind))
      continue;  // one level a threshold, and there may be one threshold
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
