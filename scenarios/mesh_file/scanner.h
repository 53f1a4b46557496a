// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline::mesh_file {

/// Words of a text, with the line for messages.
class Scanner {
 public:
  Scanner(std::string_view text, std::string_view name, char comment = '\0', std::size_t line = 1)
      : rest_(text), name_(name), comment_(comment), line_(line) {}

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}:{}: {}", one_line(name_), line_, one_line(what)));
  }
  /// The next word; empty at the end of the text.
  std::string_view word() {
    while (skip_blanks(), !rest_.empty() && rest_.front() == '\n') next_line();
    return word_on_line();
  }
  /// The next word of this line; empty at its end.
  std::string_view word_on_line() {
    skip_blanks();
    std::size_t n = 0;
    while (n < rest_.size() && !blank(rest_[n]) && rest_[n] != '\n') ++n;
    const auto found = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return found;
  }
  void skip_line() {
    while (!rest_.empty() && rest_.front() != '\n') rest_.remove_prefix(1);
    if (!rest_.empty()) next_line();
  }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] std::size_t line() const { return line_; }

  double number(std::string_view w) const {
    double value = 0;
    const auto digits = !w.empty() && w.front() == '+' ? w.substr(1) : w;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (w.empty() || error != std::errc{} || end != digits.data() + digits.size())
      fail(w.empty() ? std::string("the file ends where a number should be")
                     : fmt::format("'{}' is not a number", w));
    return value;
  }
  std::int64_t integer(std::string_view w) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (w.empty() || error != std::errc{} || end != w.data() + w.size())
      fail(w.empty() ? std::string("the file ends where a whole number should be")
                     : fmt::format("'{}' is not a whole number", w));
    return value;
  }
  /// A vertex's index below `count`.
  std::uint32_t index(std::int64_t value, std::size_t count) const {
    if (value < 0 || static_cast<std::uint64_t>(value) >= count)
      fail(fmt::format("a polygon names vertex {} (from 0), of {} vertices", value, count));
    return static_cast<std::uint32_t>(value);
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
  void skip_blanks() {
    while (!rest_.empty() && blank(rest_.front())) rest_.remove_prefix(1);
    if (comment_ != '\0' && !rest_.empty() && rest_.front() == comment_) {
      while (!rest_.empty() && rest_.front() != '\n') rest_.remove_prefix(1);
    }
  }
  void next_line() {
    rest_.remove_prefix(1);
    ++line_;
  }

  std::string_view rest_, name_;
  char comment_;
  std::size_t line_;
};

MeshFile parse_ply(std::string_view bytes, std::string_view name);
MeshFile parse_obj(std::string_view bytes, std::string_view name);
MeshFile parse_off(std::string_view bytes, std::string_view name);
MeshFile parse_stl_text(std::string_view bytes, std::string_view name);
MeshFile parse_stl_binary(std::string_view bytes, std::string_view name);
/// `folder`: where buffers in files of their own lie; none: they are refused.
MeshFile parse_gltf(std::string_view bytes, std::string_view name,
                    const std::optional<std::filesystem::path>& folder);

}  // namespace plumbline::mesh_file
