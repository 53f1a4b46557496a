// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "properties/verdict/verdict.h"

/// What a reader wants first, drawn from the verdict for summary.md and the head of report.html.
namespace plumbline::reports {

/// One of conformity's counts.
struct FindingColumn {
  std::string_view name;
  std::size_t oracle::ConformityCounts::*count;
};
/// In the order of results.json.
const std::vector<FindingColumn>& finding_columns();

/// What one method left behind over all its runs.
struct MethodDigest {
  std::string method;
  std::size_t frames = 0, gates = 0, failed_gates = 0;
  oracle::ConformityCounts conformity;
  std::size_t visible_cracks = 0;
  double largest_gap_px = 0, largest_gap_m = 0;
  /// No conformity finding in any frame, and at least one frame.
  [[nodiscard]] bool sound() const { return frames > 0 && conformity.total() == 0; }
};
/// In the suite's order.
std::vector<MethodDigest> digest_methods(const verdict::SuiteVerdict& verdict);

/// The verdict in words: a headline ("2 of 3 methods are sound") and one sentence for each thing to look at.
struct VerdictWords {
  std::string headline;
  std::vector<std::string> sentences;
};
VerdictWords verdict_in_words(const verdict::SuiteVerdict& verdict);

/// A listed finding with the run and frame that it comes from.
struct LocatedFinding {
  const verdict::RunVerdict* run = nullptr;
  const verdict::FrameVerdict* frame = nullptr;
  const oracle::Finding* finding = nullptr;
};
/// The worst listed finding of each method and code: visible ones first, then by size in pixels, metres,
/// square metres.
std::vector<LocatedFinding> worst_findings(const verdict::SuiteVerdict& verdict);

/// At most `digits` significant digits, without exponent where that stays short: "0.0123", "1532", "2.5".
std::string short_number(double value, int digits = 3);

}  // namespace plumbline::reports
