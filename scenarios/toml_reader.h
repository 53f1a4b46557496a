// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// Strict reading of TOML for suite and case files. Every complaint is an InputError of one line, which
/// begins with "file:line: " and says what to write instead. toml++ parses; none of it shows here.
namespace plumbline {

class TomlTable;

/// A value with the place where it stands. Getters throw InputError if the value is of another type.
class TomlValue {
 public:
  using Array = std::vector<TomlValue>;

  [[nodiscard]] bool is_boolean() const { return std::holds_alternative<bool>(value_); }
  [[nodiscard]] bool is_integer() const { return std::holds_alternative<std::int64_t>(value_); }
  /// A float or an integer.
  [[nodiscard]] bool is_number() const { return is_integer() || std::holds_alternative<double>(value_); }
  [[nodiscard]] bool is_text() const { return std::holds_alternative<std::string>(value_); }
  [[nodiscard]] bool is_array() const { return std::holds_alternative<Array>(value_); }
  [[nodiscard]] bool is_table() const {
    return std::holds_alternative<std::shared_ptr<const TomlTable>>(value_);
  }

  [[nodiscard]] bool boolean() const;
  /// Finite; integers beyond 2⁵³ are refused rather than rounded.
  [[nodiscard]] double number() const;
  /// A finite number in [least, greatest].
  [[nodiscard]] double number_in(double least, double greatest) const;
  /// A finite number > 0.
  [[nodiscard]] double positive() const;
  [[nodiscard]] std::int64_t integer_in(std::int64_t least, std::int64_t greatest) const;
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] const Array& array() const;
  [[nodiscard]] const TomlTable& table() const;
  /// An array of exactly `count` finite numbers: a point, a viewport.
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;

  [[nodiscard]] int line() const { return line_; }
  /// "file:line: 'key' in [[table]] <what>", thrown as InputError: a complaint about this value.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  friend class TomlBuilder;
  /// Shared by a key's value and the elements below it.
  struct Place {
    std::shared_ptr<const std::string> file;
    std::string name;  ///< "'size' in [[terrain]]"
  };
  [[nodiscard]] std::string kind() const;

  std::variant<bool, std::int64_t, double, std::string, Array, std::shared_ptr<const TomlTable>> value_;
  std::shared_ptr<const Place> place_;
  int line_ = 0;
  int column_ = 0;  // of a key
};

/// A table: `[x]`, one of `[[x]]`, an inline one, or the whole file. Entries keep the file's order.
class TomlTable {
 public:
  /// "[[terrain]]"; "the top level" for the whole file.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<std::pair<std::string, TomlValue>>& entries() const { return entries_; }

  /// Throws InputError naming the first key that is none of `known`, its line and the nearest known key.
  void allow_only(const std::vector<std::string>& known) const;

  /// Null if absent.
  [[nodiscard]] const TomlValue* find(std::string_view key) const;
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Throws InputError if absent.
  [[nodiscard]] const TomlValue& at(std::string_view key) const;
  /// The tables of `[[key]]`; empty if absent. A single `[key]` is an error.
  [[nodiscard]] std::vector<const TomlTable*> tables(std::string_view key) const;

  [[nodiscard]] double number_or(std::string_view key, double fallback) const;
  [[nodiscard]] bool boolean_or(std::string_view key, bool fallback) const;
  [[nodiscard]] std::string text_or(std::string_view key, const std::string& fallback) const;
  [[nodiscard]] std::int64_t integer_or(std::string_view key, std::int64_t least, std::int64_t greatest,
                                        std::int64_t fallback) const;

  [[nodiscard]] int line() const { return line_; }
  /// "file:line: <what>", thrown as InputError: a complaint about the table.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  friend class TomlBuilder;
  std::shared_ptr<const std::string> file_;
  std::string name_;
  int line_ = 0;
  std::vector<std::pair<std::string, TomlValue>> entries_;
};

/// Parses `text`; `file` is the name used in complaints.
TomlTable parse_toml(std::string_view text, const std::string& file);

/// The bytes of a file of at most 64 MiB. Throws InputError if it cannot be read.
std::string read_toml_text(const std::filesystem::path& path);

/// Reads and parses a file of at most 64 MiB. Throws InputError if it cannot be read or is not TOML 1.0.
TomlTable read_toml(const std::filesystem::path& path);

}  // namespace plumbline
