// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/toml_reader.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "scenarios/error.h"
#include "scenarios/nearest.h"

namespace plumbline {
namespace {

constexpr std::uintmax_t kLargestFileBytes = std::uintmax_t{64} << 20;
constexpr std::size_t kDeepestNesting = 128;  // toml++ bounds brackets, not the parts of a dotted key
constexpr std::int64_t kLargestExactInteger = std::int64_t{1} << 53;  // doubles hold all integers up to here

/// How deep tables and arrays nest where the text is TOML; behind its first mistake it may be anything. Dots
/// of a key and brackets count, those in strings and comments do not.
class NestingScanner {
 public:
  NestingScanner(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void refuse_deep() {
    bool line_begins = true;  // nothing but blanks on the line so far
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c == '\n') {
        ++line_;
        dots_ = 0;
        if (open_.empty()) header_line_ = false;
        line_begins = true;
        continue;
      }
      if (c == ' ' || c == '\t') continue;
      if (c == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (c == '"' || c == '\'') {
        skip_string(c);
      } else if (c == '.') {
        ++(header_line_ ? header_ : dots_);
      } else if (c == ',') {
        dots_ = 0;
      } else if (c == '[' || c == '{') {
        if (line_begins && open_.empty()) {
          header_line_ = true;
          header_ = 0;
        }
        open_.push_back(dots_);
        below_ += dots_ + 1;
        dots_ = 0;
      } else if ((c == ']' || c == '}') && !open_.empty()) {
        dots_ = open_.back();
        below_ -= dots_ + 1;
        open_.pop_back();
      }
      line_begins = false;
      if (header_ + below_ + dots_ > kDeepestNesting)
        throw InputError(fmt::format("{}:{}: nests tables and arrays deeper than {}; write it flatter",
                                     one_line(file_), line_, kDeepestNesting));
    }
  }

 private:
  /// Behind the closing quotes, or at the end of a line that does not close them.
  void skip_string(char quote) {
    const auto quotes = [&] {
      std::size_t n = 0;
      while (at_ + n < text_.size() && text_[at_ + n] == quote) ++n;
      return n;
    };
    const bool many_lines = quotes() >= 2;
    if (many_lines) at_ += 2;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n' && !many_lines) return;
      if (c == '\n') ++line_;
      if (c == quote && !many_lines) {
        ++at_;
        return;
      }
      if (c == quote && quotes() >= 3) {  // two more may belong to the string
        at_ += std::min<std::size_t>(quotes(), 5);
        return;
      }
      at_ += c == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n' ? 2 : 1;
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 1, dots_ = 0, header_ = 0, below_ = 0;
  std::vector<std::size_t> open_;  // by bracket: the dots of the key before it
  bool header_line_ = false;
};

}  // namespace

// From toml++'s tree to ours.
class TomlBuilder {
 public:
  explicit TomlBuilder(const std::string& file) : file_(std::make_shared<const std::string>(file)) {}

  TomlTable table(const toml::table& source, std::string name, const std::string& path) const {
    TomlTable table;
    table.file_ = file_;
    table.name_ = std::move(name);
    table.line_ = line(source);
    for (const auto& [key, node] : source) {
      const std::string name_of_key(key.str());
      const auto place = std::make_shared<const TomlValue::Place>(
          TomlValue::Place{file_, fmt::format("'{}' in {}", one_line(name_of_key, 80), table.name_)});
      const std::string below = path.empty() ? name_of_key : path + "." + name_of_key;
      table.entries_.emplace_back(name_of_key, value(node, place, one_line(below, 120)));
      table.entries_.back().second.line_ = static_cast<int>(key.source().begin.line);
      table.entries_.back().second.column_ = static_cast<int>(key.source().begin.column);
    }
    // toml++ sorts by key; a file's author thinks in the order written.
    std::stable_sort(table.entries_.begin(), table.entries_.end(), [](const auto& a, const auto& b) {
      return std::pair(a.second.line_, a.second.column_) < std::pair(b.second.line_, b.second.column_);
    });
    return table;
  }

 private:
  static int line(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

  TomlValue value(const toml::node& node, const std::shared_ptr<const TomlValue::Place>& place,
                  const std::string& path) const {
    TomlValue value;
    value.place_ = place;
    value.line_ = line(node);
    if (const auto* array = node.as_array()) {
      TomlValue::Array elements;
      elements.reserve(array->size());
      for (const toml::node& element : *array) {
        if (const auto* inner = element.as_table()) {
          TomlValue of_table;
          of_table.place_ = place;
          of_table.line_ = line(element);
          of_table.value_ = std::make_shared<const TomlTable>(table(*inner, "[[" + path + "]]", path));
          elements.push_back(std::move(of_table));
        } else {
          elements.push_back(this->value(element, place, path));
        }
      }
      value.value_ = std::move(elements);
    } else if (const auto* inner = node.as_table()) {
      value.value_ = std::make_shared<const TomlTable>(table(*inner, "[" + path + "]", path));
    } else if (const auto* boolean = node.as_boolean()) {
      value.value_ = boolean->get();
    } else if (const auto* integer = node.as_integer()) {
      value.value_ = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
      value.value_ = number->get();
    } else if (const auto* text = node.as_string()) {
      value.value_ = text->get();
    } else {
      value.fail("is a date or time; no key takes one");
    }
    return value;
  }

  std::shared_ptr<const std::string> file_;
};

std::string TomlValue::kind() const {
  if (is_boolean()) return "a boolean";
  if (is_integer()) return "an integer";
  if (is_number()) return "a number";
  if (is_text()) return "a string";
  return is_array() ? "an array" : "a table";
}

void TomlValue::fail(std::string_view what) const {
  throw InputError(fmt::format("{}:{}: {} {}", *place_->file, line_, place_->name, what));
}

bool TomlValue::boolean() const {
  if (const bool* value = std::get_if<bool>(&value_)) return *value;
  fail(fmt::format("is {}; give true or false", kind()));
}

double TomlValue::number() const {
  if (const double* value = std::get_if<double>(&value_)) {
    if (!std::isfinite(*value)) fail("is not finite; give a finite number");
    return *value;
  }
  if (const std::int64_t* value = std::get_if<std::int64_t>(&value_)) {
    if (*value > kLargestExactInteger || *value < -kLargestExactInteger)
      fail("is beyond 2^53; give a smaller number");
    return static_cast<double>(*value);
  }
  fail(fmt::format("is {}; give a number", kind()));
}

double TomlValue::number_in(double least, double greatest) const {
  const double value = number();
  if (!(value >= least && value <= greatest)) {
    fail(fmt::format("is {}; give a number from {} to {}", value, least, greatest));
  }
  return value;
}

double TomlValue::positive() const {
  const double value = number();
  if (!(value > 0)) fail(fmt::format("is {}; give a number above 0", value));
  return value;
}

std::int64_t TomlValue::integer_in(std::int64_t least, std::int64_t greatest) const {
  const std::int64_t* value = std::get_if<std::int64_t>(&value_);
  if (value == nullptr) fail(fmt::format("is {}; give an integer from {} to {}", kind(), least, greatest));
  if (*value < least || *value > greatest) {
    fail(fmt::format("is {}; give an integer from {} to {}", *value, least, greatest));
  }
  return *value;
}

const std::string& TomlValue::text() const {
  if (const std::string* value = std::get_if<std::string>(&value_)) return *value;
  fail(fmt::format("is {}; give a string in quotes", kind()));
}

const TomlValue::Array& TomlValue::array() const {
  if (const Array* value = std::get_if<Array>(&value_)) return *value;
  fail(fmt::format("is {}; give an array in brackets", kind()));
}

const TomlTable& TomlValue::table() const {
  if (const auto* value = std::get_if<std::shared_ptr<const TomlTable>>(&value_)) return **value;
  fail(fmt::format("is {}; give a table", kind()));
}

std::vector<double> TomlValue::numbers(std::size_t count) const {
  const Array* elements = std::get_if<Array>(&value_);
  if (elements == nullptr) fail(fmt::format("is {}; give an array of {} numbers", kind(), count));
  if (elements->size() != count)
    fail(fmt::format("has {} elements; give {} numbers", elements->size(), count));
  std::vector<double> values;
  values.reserve(count);
  for (const TomlValue& element : *elements) values.push_back(element.number());
  return values;
}

void TomlTable::fail(std::string_view what) const {
  throw InputError(fmt::format("{}:{}: {}", *file_, line_, what));
}

void TomlTable::allow_only(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : entries_) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    throw InputError(fmt::format("{}:{}: unknown key '{}' in {}; did you mean '{}'?", *file_, value.line(),
                                 one_line(key, 80), name_, nearest_name(key, known)));
  }
}

const TomlValue* TomlTable::find(std::string_view key) const {
  for (const auto& [name, value] : entries_) {
    if (name == key) return &value;
  }
  return nullptr;
}

const TomlValue& TomlTable::at(std::string_view key) const {
  if (const TomlValue* value = find(key)) return *value;
  fail(fmt::format("{} has no '{}'; add one", name_, key));
}

std::vector<const TomlTable*> TomlTable::tables(std::string_view key) const {
  std::vector<const TomlTable*> tables;
  const TomlValue* value = find(key);
  if (value == nullptr) return tables;
  if (value->is_table()) value->fail(fmt::format("is a single table; write [[{}]]", key));
  for (const TomlValue& element : value->array()) tables.push_back(&element.table());
  return tables;
}

double TomlTable::number_or(std::string_view key, double fallback) const {
  const TomlValue* value = find(key);
  return value == nullptr ? fallback : value->number();
}

bool TomlTable::boolean_or(std::string_view key, bool fallback) const {
  const TomlValue* value = find(key);
  return value == nullptr ? fallback : value->boolean();
}

std::string TomlTable::text_or(std::string_view key, const std::string& fallback) const {
  const TomlValue* value = find(key);
  return value == nullptr ? fallback : value->text();
}

std::int64_t TomlTable::integer_or(std::string_view key, std::int64_t least, std::int64_t greatest,
                                   std::int64_t fallback) const {
  const TomlValue* value = find(key);
  return value == nullptr ? fallback : value->integer_in(least, greatest);
}

TomlTable parse_toml(std::string_view text, const std::string& file) {
  NestingScanner(text, file).refuse_deep();
  const TomlBuilder builder(one_line(file));
  try {
    return builder.table(toml::parse(text, file), "the top level", "");
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", one_line(file), error.source().begin.line,
                                 one_line(error.description(), 200)));
  }
}

std::string read_toml_text(const std::filesystem::path& path) {
  const std::string name = one_line(path.string());
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw InputError(fmt::format("{}: no such file; check the path", name));
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(fmt::format("{}: not a regular file; give a TOML file", name));
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", name, error.message()));
  if (size > kLargestFileBytes)
    throw InputError(fmt::format("{}: larger than 64 MiB; put samples in a raster", name));
  std::ifstream stream(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(size))) {
    throw InputError(fmt::format("{}: cannot be read; check its permissions", name));
  }
  return text;
}

TomlTable read_toml(const std::filesystem::path& path) {
  return parse_toml(read_toml_text(path), path.string());
}

}  // namespace plumbline
