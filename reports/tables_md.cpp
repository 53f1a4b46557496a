// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/escape.h"
#include "reports/markdown_table.h"
#include "reports/tables_report.h"

namespace plumbline::reports {
namespace {

using tables::Agreement;
using tables::Figure;
using tables::Fit;
using tables::StandIn;
using tables::Table;
using tables::Trial;

constexpr const char* kNothing = "–";

/// As printed, with the doubt where there is one: "4.6 (misprint)".
std::string printed(const Figure& figure) {
  if (figure.printed.empty()) return kNothing;
  switch (figure.agreement()) {
    case Agreement::misprint:
      return figure.printed + " (misprint)";
    case Agreement::truncated:
      return figure.printed + " (cut off)";
    case Agreement::rounded:
    case Agreement::not_checked:
      break;
  }
  return figure.printed;
}

std::string number(const std::optional<double>& value, int decimals) {
  return value ? tables::figure_text(*value, decimals) : kNothing;
}

std::string name(const Figure& figure) {
  return figure.unit.empty() ? figure.name : fmt::format("{} ({})", figure.name, figure.unit);
}

/// Paper beside ours over one terrain: two columns a view, figure and ratio to the paper's.
std::string side_by_side(const Table& table, const StandIn& stand_in) {
  std::vector<const Trial*> trials;
  std::vector<std::string> head{"row", "figure", "ours is", "paper", "recomputed"};
  for (const Trial& trial : table.trials) {
    if (trial.terrain != stand_in.id) continue;
    trials.push_back(&trial);
    head.push_back(markdown_cell(trial.view));
    head.emplace_back("ours/paper");
  }
  MarkdownTable out(std::move(head), 3);
  const std::string* row_before = nullptr;
  for (std::size_t k = 0; k < table.figures.size(); ++k) {
    const Figure& figure = table.figures[k];
    const bool same_row = row_before != nullptr && *row_before == figure.row;
    row_before = &figure.row;
    std::vector<std::string> cells{same_row ? "" : markdown_cell(figure.row), markdown_cell(name(figure)),
                                   std::string(kind_name(figure.kind)), markdown_cell(printed(figure)),
                                   number(figure.recomputed, figure.decimals)};
    for (const Trial* trial : trials) {
      cells.push_back(number(trial->ours.at(k), figure.decimals));
      cells.push_back(number(ratio(figure, trial->ours.at(k)), 3));
    }
    out.row(std::move(cells));
  }
  return out.text();
}

bool same(const std::vector<Fit>& a, const std::vector<Fit>& b) {
  return std::ranges::equal(a, b, [](const Fit& x, const Fit& y) {
    return x.parameter == y.parameter && x.row == y.row && x.name == y.name && x.value == y.value;
  });
}

/// A line a fit; trials of one terrain that share their fits share the lines.
std::string fits(const Table& table) {
  MarkdownTable out({"terrain", "view", "fitted", "to", "value", "wanted", "reached"}, 4);
  for (std::size_t t = 0; t < table.trials.size(); ++t) {
    const Trial& trial = table.trials[t];
    const auto shares = [&](const Trial& other) {
      return other.terrain == trial.terrain && same(other.fits, trial.fits);
    };
    const auto before = table.trials.begin() + static_cast<std::ptrdiff_t>(t);
    if (std::any_of(table.trials.begin(), before, shares)) continue;
    const bool alone = std::count_if(table.trials.begin(), table.trials.end(), shares) == 1;
    for (const Fit& fit : trial.fits) {
      out.row({markdown_cell(trial.terrain), alone ? markdown_cell(trial.view) : "all",
               markdown_cell(fit.parameter), markdown_cell(fmt::format("{}, {}", fit.row, fit.name)),
               fmt::format("{:.6g} {}", fit.value, fit.unit), tables::figure_text(fit.wanted, 0),
               tables::figure_text(fit.reached, 0)});
    }
  }
  return out.text();
}

std::string section(const Table& table) {
  std::string out = fmt::format("## {}: {}\n\n{}.\n\n", table.id, table.title, table.source);
  for (const std::string& line : table.protocol) out += fmt::format("- {}\n", line);
  for (const StandIn& stand_in : table.stand_ins) {
    if (stand_in.triangles > 0) {
      out +=
          fmt::format("\n### {}: {} triangles\n\n({})\n\n", stand_in.id, stand_in.triangles, stand_in.origin);
      out += side_by_side(table, stand_in);
      continue;
    }
    out += fmt::format("\n### {}: {} × {} samples, {:.6g} m apart, {:.0f} to {:.0f} m\n\n({})\n\n",
                       stand_in.id, stand_in.columns, stand_in.rows, stand_in.spacing_m, stand_in.lowest_m,
                       stand_in.highest_m, stand_in.origin);
    out += side_by_side(table, stand_in);
  }
  out += "\nFitted:\n\n" + fits(table) + "\n";
  for (const std::string& line : table.notes) out += fmt::format("- {}\n", line);
  return out;
}

}  // namespace

std::string tables_md(std::span<const tables::Table> tables) {
  std::string out =
      "# The papers' tables, side by side with ours\n\n"
      "None of the papers' terrains was published: ours are stand-ins. *fitted*: a parameter was chosen to "
      "meet "
      "this figure; *predicted*: came out, and the paper has a figure to hold it against; *derived*: "
      "computed "
      "from other figures; *measured*: the paper has none. Ratios are to the recomputed figure where there "
      "is "
      "one.\n";
  for (const Table& table : tables) out += "\n" + section(table);
  return out;
}

std::string tables_timing_md(const tables::Timings& timings) {
  MarkdownTable out({"table", "terrain", "what", "paper", "ours (s)", "all threads (s)", "peak memory (MB)"},
                    4);
  for (const tables::Timing& entry : timings.entries) {
    out.row({markdown_cell(entry.table), markdown_cell(entry.terrain), markdown_cell(entry.what),
             entry.paper.empty() ? kNothing : markdown_cell(entry.paper), fmt::format("{:.3f}", entry.wall_s),
             fmt::format("{:.3f}", entry.cpu_s),
             entry.peak_mb > 0 ? fmt::format("{:.0f}", entry.peak_mb) : kNothing});
  }
  std::string text = out.empty() ? std::string() : "## Preprocessing\n\n" + out.text() + "\n";
  text += fmt::format("{:.1f} s in all with {} jobs on {}; the program's peak memory was {:.0f} MB.\n",
                      timings.total_s, timings.jobs, timings.machine, timings.process_peak_mb);
  return text;
}

}  // namespace plumbline::reports
