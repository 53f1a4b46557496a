// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace plumbline::reports {

/// Paragraphs for a terminal: broken between words at 100 columns, later lines indented. A word that is
/// longer stays whole.
class WrappedText {
 public:
  static constexpr std::size_t kColumns = 100;

  void line(std::size_t indent, std::string_view text, std::size_t hang = 2) {
    std::string now(indent, ' ');
    std::size_t columns = indent;
    bool first = true;
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t end = std::min(text.find(' ', from), text.size());
      const std::string_view word = text.substr(from, end - from);
      from = end + 1;
      if (word.empty() && !first) continue;
      if (!first && !is_unit(word) && columns + 1 + columns_of(word) > kColumns - room_for_unit(text, from)) {
        out_ += now + '\n';
        now.assign(indent + hang, ' ');
        columns = indent + hang;
        first = true;
      }
      if (!first) now += ' ';
      now += word;
      columns += columns_of(word) + (first ? 0 : 1);
      first = false;
    }
    out_ += now + '\n';
  }
  /// A blank line, then a line that ends what stood before.
  void heading(std::string_view text) {
    out_ += '\n';
    line(0, text);
  }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  /// A unit stays with its number.
  static bool is_unit(std::string_view word) {
    while (!word.empty() && std::string_view(".,;:)").find(word.back()) != std::string_view::npos)
      word.remove_suffix(1);
    return word == "m" || word == "m²" || word == "px" || word == "%";
  }
  static std::size_t room_for_unit(std::string_view text, std::size_t from) {
    if (from >= text.size()) return 0;
    const std::string_view next = text.substr(from, std::min(text.find(' ', from), text.size()) - from);
    return is_unit(next) ? 1 + columns_of(next) : 0;
  }
  /// Every byte of UTF-8 but the continuing ones begins a character.
  static std::size_t columns_of(std::string_view word) {
    return static_cast<std::size_t>(
        std::ranges::count_if(word, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  }

  std::string out_;
};

}  // namespace plumbline::reports
