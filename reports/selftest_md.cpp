// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "reports/escape.h"
#include "reports/markdown_table.h"
#include "reports/report.h"

namespace plumbline::reports {
namespace {

std::vector<std::string> counts(const verdict::KindScore& score) {
  return {std::to_string(score.faults), std::to_string(score.expected), std::to_string(score.found),
          std::to_string(score.misplaced), std::to_string(score.false_alarms)};
}

void add_row(MarkdownTable& table, std::vector<std::string> head, const verdict::KindScore& score) {
  for (std::string& count : counts(score)) head.push_back(std::move(count));
  table.row(std::move(head));
}

}  // namespace

std::string selftest_md(const verdict::SelftestScore& score) {
  const verdict::KindScore all = score.total();
  std::string out = fmt::format(
      "# Can the oracles be believed? {}\n\n{} faults planted (seed {}), {} findings expected: {} found at "
      "their places, {} misplaced, {} false alarms; {} on {} clean meshes.\n\n",
      score.perfect() ? "pass" : "FAIL", score.planted(), score.seed, all.expected, all.found, all.misplaced,
      all.false_alarms, score.clean_false_alarms, score.clean_meshes);
  MarkdownTable oracles({"oracle", "planted", "expected", "found", "misplaced", "false alarms"}, 1);
  for (const std::string& oracle : score.oracles()) add_row(oracles, {oracle}, score.total(oracle));
  out += oracles.text();
  MarkdownTable kinds(
      {"oracle", "fault", "what it is", "planted", "expected", "found", "misplaced", "false alarms"}, 3);
  for (const verdict::KindScore& kind : score.kinds)
    add_row(kinds, {kind.oracle.substr(0, kind.oracle.find(' ')), kind.kind, markdown_cell(kind.what)}, kind);
  out += "\n" + kinds.text();
  MarkdownTable makers({"O1: meshes of", "planted"}, 1);
  for (const verdict::MakerScore& maker : score.makers)
    makers.row({markdown_cell(maker.name), std::to_string(maker.faults)});
  return out + "\n" + makers.text();
}

}  // namespace plumbline::reports
