// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/compare_report.h"
#include "reports/digest.h"
#include "reports/escape.h"
#include "reports/json_text.h"
#include "reports/markdown_table.h"
#include "scenarios/error.h"

namespace plumbline::reports {
namespace {

using verdict::Change;
using verdict::Comparison;
using verdict::Difference;

constexpr std::size_t kLongestCell = 160, kLongestValue = 48;
constexpr int kFewDigits = 4, kAllDigits = 17;

std::string number(double value, int digits) {
  if (value == std::floor(value) && std::fabs(value) < 1e15) return fmt::format("{:.0f}", value);
  return digits >= kAllDigits ? fmt::format("{}", value) : fmt::format("{:.{}g}", value, digits);
}

struct Cells {
  std::string before, after, change;
};

/// Two numbers with as few digits as tell them apart.
Cells number_cells(double before, double after) {
  int digits = kFewDigits;
  while (digits < kAllDigits && number(before, digits) == number(after, digits)) ++digits;
  Cells cells{number(before, digits), number(after, digits), ""};
  const double change = after - before;
  const bool whole = before == std::floor(before) && after == std::floor(after);
  if (whole || before == 0) {
    cells.change = fmt::format("{}{}", change > 0 ? "+" : "", number(change, 3));
  } else {
    cells.change = fmt::format("{:+.3g} %", 100 * change / std::fabs(before));
  }
  return cells;
}

Cells cells_of(const Difference& one) {
  if (one.before && one.after) {
    Cells cells = number_cells(*one.before, *one.after);
    if (!one.note.empty()) cells.change = one.note;
    return cells;
  }
  return {one.before ? number(*one.before, kFewDigits) : one_line(one.before_text, kLongestValue),
          one.after ? number(*one.after, kFewDigits) : one_line(one.after_text, kLongestValue), one.note};
}

std::string headline(const Comparison& comparison) {
  const std::string noun = comparison.schema == "plumbline.results/1" ? "run" : "mesh or seam";
  const std::string nouns = comparison.schema == "plumbline.results/1" ? "runs" : "meshes and seams";
  return fmt::format("{} worse, {} better, {} changed, {} the same in {} {}", comparison.count(Change::worse),
                     comparison.count(Change::better), comparison.count(Change::changed), comparison.same,
                     comparison.subjects, comparison.subjects == 1 ? noun : nouns);
}

std::vector<std::string> remarks(const Comparison& comparison) {
  std::vector<std::string> out = comparison.notes;
  if (comparison.within_tolerance > 0)
    out.push_back(fmt::format("{} of the same are equal within {} only", comparison.within_tolerance,
                              comparison.tolerance));
  return out;
}

/// A code span, in which GitHub sees no tag, no mention, no link; a bar would end the cell even there.
std::string code(const std::string& text) {
  if (text.empty()) return {};
  std::string out;
  for (const char c : valid_utf8(one_line(text, kLongestCell))) {
    if (c == '|') {
      out += "¦";
    } else {
      out += c == '`' ? '\'' : c;
    }
  }
  return "`" + out + "`";
}

/// Bare where there is nothing that could be markup.
std::string inert(const std::string& text) {
  const bool plain = std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' ||
           c == '.' || c == '+' || c == '-' || c == '%';
  });
  return plain || text == "—" ? text : code(text);
}

constexpr const char* kHead = "| | where | what | old | new | change |\n|:-|:-|:-|-:|-:|-:|\n";

std::string md_row(const Difference& one) {
  const Cells cells = cells_of(one);
  const bool loud = one.change == Change::worse;
  return fmt::format("| {}{}{} | {} | {} | {} | {} | {} |\n", loud ? "**" : "", change_name(one.change),
                     loud ? "**" : "", code(one.where), code(one.what), inert(cells.before),
                     inert(cells.after), inert(cells.change));
}

}  // namespace

std::string compare_text(const Comparison& comparison) {
  std::string out = fmt::format("{}: {}\n", comparison.word(), headline(comparison));
  for (const std::string& remark : remarks(comparison)) out += one_line(remark) + "\n";
  if (comparison.differences.empty()) return out;
  const std::span<const Difference> all(comparison.differences);
  const auto shown = all.first(std::min(all.size(), kRowsForPeople));
  constexpr std::size_t kTextColumns = 3;
  MarkdownTable table({"", "where", "what", "old", "new", "change"}, kTextColumns);
  for (const Difference& one : shown) {
    const Cells cells = cells_of(one);
    std::vector<std::string> row{
        std::string(change_name(one.change)), one.where, one.what, cells.before, cells.after, cells.change};
    for (std::string& cell : row) cell = markdown_cell(one_line(cell, kLongestCell));
    table.row(std::move(row));
  }
  out += "\n" + table.text();
  if (shown.size() < all.size())
    out += fmt::format("… and {} more; --json FILE lists all\n", all.size() - shown.size());
  return out;
}

std::string compare_md(const Comparison& comparison) {
  std::string out = fmt::format("### plumbline: {}\n\n{}.\n", comparison.word(), headline(comparison));
  constexpr std::size_t kRemarksShown = 5;
  const std::vector<std::string> said = remarks(comparison);
  for (const std::string& remark : std::span(said).first(std::min(said.size(), kRemarksShown)))
    out += fmt::format("\n{}.\n", inert(remark));
  const std::span<const Difference> all(comparison.differences);
  if (all.empty()) return out;
  const std::size_t open = std::min(all.size(), kRowsOpen);
  out += "\n";
  out += kHead;
  for (const Difference& one : all.first(open)) out += md_row(one);
  if (open == all.size()) return out;
  out += fmt::format("\n<details><summary>{} more</summary>\n\n{}", all.size() - open, kHead);
  constexpr std::size_t kForTheEnd = 100;
  std::size_t shown = open;
  for (; shown < all.size(); ++shown) {
    const std::string row = md_row(all[shown]);
    if (out.size() + row.size() + kForTheEnd > kCommentBytes) break;
    out += row;
  }
  if (shown < all.size()) out += fmt::format("\n… and {} more that do not fit here.\n", all.size() - shown);
  return out + "\n</details>\n";
}

}  // namespace plumbline::reports
