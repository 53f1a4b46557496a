// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/digest.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace plumbline::reports {
namespace {

using Counts = oracle::ConformityCounts;

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

MethodDigest& entry(std::vector<MethodDigest>& methods, const std::string& method) {
  const auto found = std::ranges::find(methods, method, &MethodDigest::method);
  if (found != methods.end()) return *found;
  methods.emplace_back().method = method;
  return methods.back();
}

/// "block_bintree: 12 cracks (3 visible, the largest 2.1 px), 40 t_junction"
std::string method_sentence(const MethodDigest& method) {
  std::vector<std::string> parts;
  for (const FindingColumn& column : finding_columns()) {
    const std::size_t count = method.conformity.*column.count;
    if (count == 0) continue;
    std::string part = fmt::format("{} {}", count, column.name);
    if (column.count == &Counts::crack) {
      part += method.visible_cracks == 0
                  ? fmt::format(" (none visible, gaps up to {} m)", short_number(method.largest_gap_m))
                  : fmt::format(" ({} visible, gaps up to {} px)", method.visible_cracks,
                                short_number(method.largest_gap_px));
    }
    parts.push_back(std::move(part));
  }
  return fmt::format("{}: {}", method.method, fmt::join(parts, ", "));
}

/// Larger is worse.
auto badness(const oracle::Finding& finding) {
  return std::tuple(finding.visibility == oracle::Visibility::visible, std::fabs(finding.gap_px),
                    std::fabs(finding.gap_m), finding.area_m2);
}

}  // namespace

const std::vector<FindingColumn>& finding_columns() {
  static const std::vector<FindingColumn> columns{
      {"crack", &Counts::crack},         {"t_junction", &Counts::t_junction},
      {"fold_over", &Counts::fold_over}, {"degenerate", &Counts::degenerate},
      {"hole", &Counts::hole},           {"overlap", &Counts::overlap},
      {"outline", &Counts::outline},     {"non_manifold", &Counts::non_manifold},
      {"duplicate", &Counts::duplicate}, {"non_finite", &Counts::non_finite},
      {"bad_index", &Counts::bad_index}, {"unused_vertex", &Counts::unused_vertex},
  };
  return columns;
}

std::vector<MethodDigest> digest_methods(const verdict::SuiteVerdict& verdict) {
  std::vector<MethodDigest> methods;
  std::map<std::string_view, const verdict::RunVerdict*> by_id;
  for (const verdict::RunVerdict& run : verdict.runs) {
    by_id[run.id] = &run;
    MethodDigest& method = entry(methods, run.method);
    method.frames += run.summary.frames;
    for (const FindingColumn& column : finding_columns())
      method.conformity.*column.count += run.summary.conformity.*column.count;
    method.visible_cracks += run.summary.visible_cracks;
    method.largest_gap_px = std::max(method.largest_gap_px, run.summary.largest_gap_px);
    method.largest_gap_m = std::max(method.largest_gap_m, run.summary.largest_gap_m);
  }
  for (const verdict::GateVerdict& gate : verdict.gates) {
    const auto run = by_id.find(gate.run);
    if (run == by_id.end()) continue;
    MethodDigest& method = entry(methods, run->second->method);
    ++method.gates;
    if (!gate.pass) ++method.failed_gates;
  }
  return methods;
}

VerdictWords verdict_in_words(const verdict::SuiteVerdict& verdict) {
  const std::vector<MethodDigest> methods = digest_methods(verdict);
  const auto sound = std::ranges::count_if(methods, &MethodDigest::sound);
  const auto failed = std::ranges::count_if(verdict.gates, [](const auto& gate) { return !gate.pass; });
  VerdictWords words;
  words.headline = methods.empty() ? "No run was finished"
                                   : fmt::format("{} of {} sound", sound,
                                                 counted(methods.size(), "method is", "methods are"));
  if (methods.size() == 1 && sound == 1) words.headline = fmt::format("{} is sound", methods[0].method);
  if (methods.size() == 1 && sound == 0) words.headline = fmt::format("{} is not sound", methods[0].method);
  if (verdict.gates.empty()) {
    words.headline += "; no gate was judged";
  } else if (failed == 0) {
    words.headline += verdict.gates.size() == 1 ? "; the one gate holds"
                                                : fmt::format("; all {} gates hold", verdict.gates.size());
  } else {
    words.headline +=
        fmt::format("; {} of {} failed", failed, counted(verdict.gates.size(), "gate", "gates"));
  }
  const auto foreseen =
      std::ranges::count_if(verdict.gates, [](const auto& gate) { return gate.expected && gate.pass; });
  if (foreseen > 0)
    words.headline += fmt::format("; {} as expected",
                                  counted(static_cast<std::size_t>(foreseen), "figure is", "figures are"));
  if (verdict.interrupted)
    words.sentences.emplace_back("Interrupted: only the runs that were finished are here.");
  if (!verdict.selftest.kinds.empty() && !verdict.selftest.perfect()) {
    const verdict::KindScore all = verdict.selftest.total();
    words.sentences.push_back(fmt::format(
        "The oracles failed their own test: {} of {} planted findings found, {} misplaced, {} false "
        "alarms. Believe nothing below.",
        all.found, all.expected, all.misplaced, all.false_alarms + verdict.selftest.clean_false_alarms));
  }
  for (const std::string& why : verdict.vacuous)
    words.sentences.push_back("Nothing judged (finding 110): " + why);
  for (const MethodDigest& method : methods)
    if (method.conformity.total() > 0) words.sentences.push_back(method_sentence(method));
  return words;
}

std::vector<LocatedFinding> worst_findings(const verdict::SuiteVerdict& verdict) {
  std::vector<MethodDigest> order = digest_methods(verdict);
  std::map<std::pair<std::ptrdiff_t, oracle::FindingCode>, LocatedFinding> worst;
  for (const verdict::RunVerdict& run : verdict.runs) {
    const auto rank = std::ranges::find(order, run.method, &MethodDigest::method) - order.begin();
    for (const verdict::FrameVerdict& frame : run.frames)
      for (const oracle::Finding& finding : frame.findings) {
        LocatedFinding& kept = worst[{rank, finding.code}];
        if (kept.finding == nullptr || badness(finding) > badness(*kept.finding))
          kept = {&run, &frame, &finding};
      }
  }
  std::vector<LocatedFinding> out;
  for (const auto& [key, found] : worst) out.push_back(found);
  std::ranges::stable_sort(out, [](const LocatedFinding& a, const LocatedFinding& b) {
    return badness(*a.finding) > badness(*b.finding);
  });
  return out;
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return "—";
  if (value == 0) return "0";
  // Whole numbers that a reader may want to check are not rounded.
  if (value == std::floor(value) && std::fabs(value) < 1e7) return fmt::format("{:.0f}", value);
  if (std::fabs(value) >= 1000 && std::fabs(value) < 1e7) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, digits);
}

}  // namespace plumbline::reports
