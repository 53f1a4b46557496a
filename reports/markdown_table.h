// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace plumbline::reports {

/// A Markdown table whose columns also line up on a terminal. Numbers stand to the right, the first
/// `text_columns` left.
class MarkdownTable {
 public:
  MarkdownTable(std::vector<std::string> head, std::size_t text_columns) : text_columns_(text_columns) {
    row(std::move(head));
  }
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  [[nodiscard]] bool empty() const { return rows_.size() < 2; }

  [[nodiscard]] std::string text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 3);
    for (const auto& cells : rows_)
      for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], columns_of(cells[c]));
    std::string out = line(rows_.front(), widths) + rule(widths);
    for (std::size_t r = 1; r < rows_.size(); ++r) out += line(rows_[r], widths);
    return out;
  }

 private:
  /// Characters, not bytes: every byte of UTF-8 but the continuing ones begins one.
  static std::size_t columns_of(const std::string& cell) {
    return static_cast<std::size_t>(
        std::ranges::count_if(cell, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  }
  [[nodiscard]] std::string line(const std::vector<std::string>& cells,
                                 const std::vector<std::size_t>& widths) const {
    std::string out = "|";
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::string pad(widths[c] - columns_of(cells[c]), ' ');
      out += c < text_columns_ ? " " + cells[c] + pad + " |" : " " + pad + cells[c] + " |";
    }
    return out + "\n";
  }
  [[nodiscard]] std::string rule(const std::vector<std::size_t>& widths) const {
    std::string out = "|";
    for (std::size_t c = 0; c < widths.size(); ++c)
      out += c < text_columns_ ? ":" + std::string(widths[c] + 1, '-') + "|"
                               : std::string(widths[c] + 1, '-') + ":|";
    return out + "\n";
  }

  std::size_t text_columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace plumbline::reports
