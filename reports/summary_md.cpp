// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/digest.h"
#include "reports/escape.h"
#include "reports/markdown_table.h"
#include "reports/quantile.h"
#include "reports/report.h"

namespace plumbline::reports {
namespace {

constexpr std::size_t kFailedGatesShown = 10;
constexpr std::size_t kSurprisesShown = 20;
constexpr std::size_t kOffendersShown = 8;

std::string place(Vec3 at) { return fmt::format("{:.1f}, {:.1f}, {:.1f}", at.x, at.y, at.z); }

/// Method × finding; findings that occur nowhere are named below instead of filling columns of zeros.
std::string matrix(const verdict::SuiteVerdict& verdict) {
  const std::vector<MethodDigest> methods = digest_methods(verdict);
  std::vector<FindingColumn> shown;
  std::vector<std::string> absent;
  for (const FindingColumn& column : finding_columns()) {
    const bool occurs =
        std::ranges::any_of(methods, [&](const MethodDigest& m) { return m.conformity.*column.count > 0; });
    const bool asked = verdict.runs.empty() || std::ranges::any_of(verdict.runs, [&](const auto& run) {
                         return verdict::was_asked(run.subject, column.name);
                       });
    if (occurs) {
      shown.push_back(column);
    } else if (asked) {
      absent.emplace_back(column.name);
    }
  }
  std::vector<std::string> head{"method", "verdict", "frames"};
  for (const FindingColumn& column : shown) head.emplace_back(column.name);
  head.insert(head.end(), {"visible cracks", "gates failed"});
  MarkdownTable table(std::move(head), 2);
  for (const MethodDigest& method : methods) {
    std::vector<std::string> cells{markdown_cell(method.method), method.sound() ? "sound" : "not sound",
                                   std::to_string(method.frames)};
    for (const FindingColumn& column : shown)
      cells.push_back(std::to_string(method.conformity.*column.count));
    cells.push_back(std::to_string(method.visible_cracks));
    cells.push_back(fmt::format("{} of {}", method.failed_gates, method.gates));
    table.row(std::move(cells));
  }
  std::string out = table.text();
  if (!absent.empty()) out += fmt::format("\nNowhere: {}.\n", fmt::join(absent, ", "));
  return out;
}

/// One line for each failed gate and method, with the run that is furthest beyond its limit.
std::string failed_gates(const verdict::SuiteVerdict& verdict) {
  struct Failure {
    std::string gate, method;
    std::size_t failed = 0, runs = 0;
    const verdict::GateVerdict* worst = nullptr;
  };
  std::map<std::string_view, std::string> method_of;
  for (const verdict::RunVerdict& run : verdict.runs) method_of[run.id] = run.method;
  std::vector<Failure> failures;
  for (const verdict::GateVerdict& gate : verdict.gates) {
    if (gate.expected) continue;  // surprises() shows these
    const std::string& method = method_of[gate.run];
    auto known = std::ranges::find_if(failures, [&](const Failure& failure) {
      return failure.gate == gate.name && failure.method == method;
    });
    if (known == failures.end()) {
      Failure fresh;
      fresh.gate = gate.name;
      fresh.method = method;
      known = failures.insert(failures.end(), std::move(fresh));
    }
    ++known->runs;
    if (gate.pass) continue;
    ++known->failed;
    const bool least_counts = gate.limit.starts_with('>');
    if (known->worst == nullptr || std::isnan(gate.value) ||
        (least_counts ? gate.value < known->worst->value : gate.value > known->worst->value))
      known->worst = &gate;
  }
  std::erase_if(failures, [](const Failure& failure) { return failure.failed == 0; });
  if (failures.empty()) return {};
  MarkdownTable table({"failed gate", "method", "worst run", "limit", "value", "runs failed"}, 4);
  for (const Failure& failure : std::span(failures).first(std::min(failures.size(), kFailedGatesShown)))
    table.row({markdown_cell(failure.gate), markdown_cell(failure.method), markdown_cell(failure.worst->run),
               markdown_cell(failure.worst->limit), short_number(failure.worst->value),
               fmt::format("{} of {}", failure.failed, failure.runs)});
  std::string out = "\n## Failed gates\n\n" + table.text();
  if (failures.size() > kFailedGatesShown)
    out += fmt::format("\n… and {} more, in junit.xml.\n", failures.size() - kFailedGatesShown);
  return out;
}

/// Expectations that do not hold, each with what was expected and found.
std::string surprises(const verdict::SuiteVerdict& verdict) {
  std::string out;
  std::size_t count = 0;
  for (const verdict::GateVerdict& gate : verdict.gates) {
    if (!gate.expected || gate.pass || ++count > kSurprisesShown) continue;
    out += fmt::format("- {}: {}\n", markdown_cell(gate.run), markdown_cell(gate.note));
  }
  if (count == 0) return {};
  if (count > kSurprisesShown)
    out += fmt::format("\n… and {} more, in junit.xml.\n", count - kSurprisesShown);
  return "\n## Not as expected\n\n" + out;
}

std::string offenders(const verdict::SuiteVerdict& verdict) {
  MarkdownTable table({"finding", "run", "frame", "at x, y, z (m)", "gap (m)", "gap (px)", "area (m²)"}, 2);
  const std::vector<LocatedFinding> worst = worst_findings(verdict);
  for (const LocatedFinding& found : std::span(worst).first(std::min(worst.size(), kOffendersShown))) {
    const oracle::Finding& finding = *found.finding;
    const bool visible = finding.visibility == oracle::Visibility::visible;
    table.row({fmt::format("{} {}{}", static_cast<int>(finding.code), oracle::finding_name(finding.code),
                           visible ? ", visible" : ""),
               markdown_cell(found.run->id), std::to_string(found.frame->index), place(finding.at),
               short_number(std::fabs(finding.gap_m)), short_number(std::fabs(finding.gap_px)),
               short_number(finding.area_m2)});
  }
  return table.empty() ? std::string() : "\n## Worst offenders\n\n" + table.text();
}

/// Method × threshold over all terrains and trajectories.
std::string economy(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing) {
  struct Row {
    std::string method;
    double threshold_px = 0, triangles = 0, p99_px = 0, max_px = 0;
    std::size_t frames = 0, judged_px = 0;
    std::vector<double> update_ms;
  };
  std::map<std::string_view, const verdict::RunTiming*> clocks;
  for (const verdict::RunTiming& run : timing.runs) clocks[run.run] = &run;
  std::vector<Row> rows;
  for (const verdict::RunVerdict& run : verdict.runs) {
    if (run.subject == Subject::mesh) continue;  // objects() shows these
    auto row = std::ranges::find_if(rows, [&](const Row& known) {
      return known.method == run.method && known.threshold_px == run.threshold_px;
    });
    if (row == rows.end()) {
      Row fresh;
      fresh.method = run.method;
      fresh.threshold_px = run.threshold_px;
      row = rows.insert(rows.end(), std::move(fresh));
    }
    const verdict::RunSummary& summary = run.summary;
    row->triangles += summary.triangles * static_cast<double>(summary.frames);
    row->frames += summary.frames;
    row->judged_px += summary.image.displacement_px.count;
    row->p99_px = std::max(row->p99_px, summary.image.displacement_px.p99);
    row->max_px = std::max(row->max_px, summary.image.displacement_px.max);
    if (const auto clock = clocks.find(run.id); clock != clocks.end())
      row->update_ms.insert(row->update_ms.end(), clock->second->update_ms.begin(),
                            clock->second->update_ms.end());
  }
  MarkdownTable table({"method", "τ (px)", "triangles, mean", "p99 displacement, worst (px)", "max (px)",
                       "update, median (ms)", "p95 (ms)"},
                      1);
  for (const Row& row : rows) {
    const bool timed = !row.update_ms.empty();
    table.row({markdown_cell(row.method), short_number(row.threshold_px),
               row.frames == 0 ? "—" : fmt::format("{:.0f}", row.triangles / static_cast<double>(row.frames)),
               row.judged_px == 0 ? "—" : short_number(row.p99_px),
               row.judged_px == 0 ? "—" : short_number(row.max_px),
               timed ? short_number(quantile(row.update_ms, 0.5)) : "—",
               timed ? short_number(quantile(row.update_ms, 0.95)) : "—"});
  }
  return table.empty() ? std::string() : "\n## Speed and accuracy\n\n" + table.text();
}

/// O4 over all terrains and flights: what each method draws beside what the yardstick needs at the same
/// error.
std::string spending(const verdict::SuiteVerdict& verdict) {
  struct Row {
    std::string method;
    double threshold_px = 0;
    verdict::EconomySummary all;
    std::size_t frames = 0;
  };
  std::vector<Row> rows;
  for (const verdict::RunVerdict& run : verdict.runs) {
    if (run.subject == Subject::mesh) continue;
    auto row = std::ranges::find_if(rows, [&](const Row& known) {
      return known.method == run.method && known.threshold_px == run.threshold_px;
    });
    if (row == rows.end()) {
      Row fresh;
      fresh.method = run.method;
      fresh.threshold_px = run.threshold_px;
      row = rows.insert(rows.end(), std::move(fresh));
    }
    const verdict::EconomySummary& one = run.summary.economy;
    row->frames += run.summary.frames;
    row->all.excess_frames += one.excess_frames;
    row->all.drawn += one.drawn;
    row->all.needed += one.needed;
    row->all.slack_frames += one.slack_frames;
    row->all.slack.vertices += one.slack.vertices;
    row->all.slack.removable += one.slack.removable;
    row->all.slack.in_view += one.slack.in_view;
    row->all.slack.removable_in_view += one.slack.removable_in_view;
  }
  MarkdownTable table(
      {"method", "τ (px)", "excess", "frames compared", "of", "slack (share)", "in the picture"}, 1);
  for (const Row& row : rows) {
    const verdict::EconomySummary& all = row.all;
    table.row({markdown_cell(row.method), short_number(row.threshold_px),
               all.excess_frames == 0 ? "—" : short_number(all.drawn / all.needed),
               std::to_string(all.excess_frames), std::to_string(row.frames),
               all.slack_frames == 0 ? "—" : short_number(all.slack.share()),
               all.slack_frames == 0 ? "—" : short_number(all.slack.share_in_view())});
  }
  if (table.empty()) return {};
  const std::string yardstick =
      verdict.yardstick.empty()
          ? std::string("No yardstick flew.")
          : fmt::format("Excess is over {} at the same camera and measured p99 displacement.",
                        markdown_cell(verdict.yardstick));
  return "\n## Economy\n\n" + yardstick + "\n\n" + table.text();
}

/// Mesh × method × threshold over all flights: objects have no plan, so silhouettes and parallax take the
/// place of displacement.
std::string objects(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing) {
  struct Row {
    std::string mesh, method;
    double threshold_px = 0, triangles = 0, silhouette_px = 0, parallax_px = 0, depth_rel = 0,
           hausdorff_m = 0, normal_deg = 0;
    std::size_t compared = 0;
    std::size_t frames = 0, judged_px = 0, full = 0;
    std::vector<double> update_ms;
  };
  std::map<std::string_view, const verdict::RunTiming*> clocks;
  for (const verdict::RunTiming& run : timing.runs) clocks[run.run] = &run;
  std::vector<Row> rows;
  for (const verdict::RunVerdict& run : verdict.runs) {
    if (run.subject != Subject::mesh) continue;
    auto row = std::ranges::find_if(rows, [&](const Row& known) {
      return known.mesh == run.terrain && known.method == run.method &&
             known.threshold_px == run.threshold_px;
    });
    if (row == rows.end()) {
      Row fresh;
      fresh.mesh = run.terrain;
      fresh.method = run.method;
      fresh.threshold_px = run.threshold_px;
      const auto facts = std::ranges::find(verdict.meshes, run.terrain, &verdict::MeshFacts::id);
      if (facts != verdict.meshes.end()) fresh.full = facts->triangles;
      row = rows.insert(rows.end(), std::move(fresh));
    }
    const verdict::RunSummary& summary = run.summary;
    row->triangles += summary.triangles * static_cast<double>(summary.frames);
    row->frames += summary.frames;
    row->judged_px += summary.image.depth_rel.count + summary.image.silhouette_pixels;
    row->silhouette_px = std::max(row->silhouette_px, summary.image.silhouette_max_px);
    row->parallax_px = std::max(row->parallax_px, summary.image.parallax_px.p99);
    row->depth_rel = std::max(row->depth_rel, summary.image.depth_rel.p99);
    row->compared += summary.space.frames;
    row->hausdorff_m = std::max(row->hausdorff_m, summary.space.hausdorff_m.most_m);
    row->normal_deg = std::max(row->normal_deg, summary.space.normal_mean_deg);
    if (const auto clock = clocks.find(run.id); clock != clocks.end())
      row->update_ms.insert(row->update_ms.end(), clock->second->update_ms.begin(),
                            clock->second->update_ms.end());
  }
  MarkdownTable table({"mesh", "method", "τ (px)", "triangles, mean", "of", "silhouette, worst (px)",
                       "p99 parallax, worst (px)", "p99 depth, worst (share)", "Hausdorff, at most (m)",
                       "normals, mean (°)", "update, median (ms)"},
                      2);
  for (const Row& row : rows) {
    const bool judged = row.judged_px > 0;
    table.row({markdown_cell(row.mesh), markdown_cell(row.method), short_number(row.threshold_px),
               row.frames == 0 ? "—" : fmt::format("{:.0f}", row.triangles / static_cast<double>(row.frames)),
               std::to_string(row.full), judged ? short_number(row.silhouette_px) : "—",
               judged ? short_number(row.parallax_px) : "—", judged ? short_number(row.depth_rel) : "—",
               row.compared > 0 ? short_number(row.hausdorff_m) : "—",
               row.compared > 0 ? short_number(row.normal_deg) : "—",
               row.update_ms.empty() ? "—" : short_number(quantile(row.update_ms, 0.5))});
  }
  return table.empty() ? std::string() : "\n## Objects\n\n" + table.text();
}

/// O5 over all terrains, flights and thresholds of a method.
std::string stability(const verdict::SuiteVerdict& verdict) {
  std::vector<std::string> methods;
  std::map<std::string, verdict::StabilitySummary> worst;
  for (const verdict::RunVerdict& run : verdict.runs) {
    if (!worst.contains(run.method)) methods.push_back(run.method);
    verdict::StabilitySummary& all = worst[run.method];
    const verdict::StabilitySummary& one = run.summary.stability;
    all.cuts += one.cuts;
    all.recovery_frames = std::max(all.recovery_frames, one.recovery_frames);
    all.unrecovered += one.unrecovered;
    all.lag_frames = std::max(all.lag_frames, one.lag_frames);
    all.unsettled += one.unsettled;
    all.toggles += one.toggles;
    all.jitter_vertices = std::max(all.jitter_vertices, one.jitter_vertices);
    all.jitter_px = std::max(all.jitter_px, one.jitter_px);
    all.path_share = std::max(all.path_share, one.path_share);
    all.path_px = std::max(all.path_px, one.path_px);
    all.revisits += one.revisits;
    all.revisit_share = std::max(all.revisit_share, one.revisit_share);
  }
  MarkdownTable table(
      {"method", "toggles", "0.01 px: vertices", "0.01 px: pop (px)", "cuts", "frames until under τ", "never",
       "frames until as fresh", "never", "differs from fresh (share)", "(px)", "on coming back (share)"},
      1);
  for (const std::string& method : methods) {
    const verdict::StabilitySummary& all = worst[method];
    const auto after_cut = [&](double value) {
      return all.cuts == 0 ? std::string("—") : short_number(value);
    };
    table.row({markdown_cell(method), std::to_string(all.toggles), std::to_string(all.jitter_vertices),
               short_number(all.jitter_px), std::to_string(all.cuts), after_cut(all.recovery_frames),
               after_cut(static_cast<double>(all.unrecovered)), after_cut(all.lag_frames),
               after_cut(static_cast<double>(all.unsettled)), short_number(all.path_share),
               short_number(all.path_px), all.revisits == 0 ? "—" : short_number(all.revisit_share)});
  }
  return table.empty() ? std::string() : "\n## Stability\n\n" + table.text();
}

/// One line: the table is in report.html, and `plumbline selftest` prints a longer one.
std::string trust(const verdict::SelftestScore& score) {
  if (score.kinds.empty()) return {};
  const verdict::KindScore all = score.total();
  return fmt::format(
      "\n## Can the oracles be believed?\n\n{}: {} faults planted, {} of {} findings at their places, {} "
      "misplaced, {} false alarms; {} on {} clean meshes.\n",
      score.perfect() ? "Yes" : "NO", score.planted(), all.found, all.expected, all.misplaced,
      all.false_alarms, score.clean_false_alarms, score.clean_meshes);
}

}  // namespace

std::string summary_md(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing) {
  const VerdictWords words = verdict_in_words(verdict);
  std::string out = fmt::format("# {}: {}\n\n{}.\n", markdown_cell(verdict.suite),
                                verdict.pass() ? "pass" : "FAIL", markdown_cell(words.headline));
  if (!words.sentences.empty()) out += '\n';
  for (const std::string& sentence : words.sentences) out += fmt::format("- {}\n", markdown_cell(sentence));
  out += "\n## Findings\n\n" + matrix(verdict) + failed_gates(verdict) + surprises(verdict) +
         offenders(verdict) + economy(verdict, timing) + spending(verdict) + objects(verdict, timing) +
         stability(verdict) + trust(verdict.selftest);
  return out;
}

}  // namespace plumbline::reports
