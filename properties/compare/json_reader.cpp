// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/compare/json_reader.h"

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::compare {
namespace {

constexpr std::size_t kDeepest = 64;
constexpr std::size_t kDepthOfFrames = 3;  // root, "runs", a run

/// FNV-1a over the values of a JSON text, so that blanks do not count.
class ValueHash {
 public:
  void add(char kind, std::uint64_t bits) {
    add_byte(static_cast<unsigned char>(kind));
    for (int shift = 0; shift < 64; shift += 8) add_byte(static_cast<unsigned char>(bits >> shift & 0xffU));
  }
  void add(char kind, std::string_view text) {
    add(kind, std::uint64_t{text.size()});
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3U; }
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// Builds the tree as the parser goes. nlohmann's own builder has no bound on depth, and would keep every
/// frame.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(std::string file) : file_(std::move(file)) {}

  bool null() override { return put('n', 0, nullptr); }
  bool boolean(bool value) override { return put('b', value ? 1 : 0, value); }
  // 1, 1.0 and 1e0 are one value, so all numbers are hashed as doubles.
  bool number_integer(number_integer_t value) override {
    return put('d', std::bit_cast<std::uint64_t>(static_cast<double>(value)), value);
  }
  bool number_unsigned(number_unsigned_t value) override {
    return put('d', std::bit_cast<std::uint64_t>(static_cast<double>(value)), value);
  }
  bool number_float(number_float_t value, const string_t&) override {
    return put('d', std::bit_cast<std::uint64_t>(value), value);
  }
  bool string(string_t& value) override {
    if (skipping()) {
      hash_.add('s', value);
    } else {
      insert(std::move(value));
    }
    return true;
  }
  bool binary(binary_t&) override { return false; }  // no JSON text has one

  bool start_object(std::size_t) override { return open('{', Json::object()); }
  bool end_object() override { return close('}'); }
  bool start_array(std::size_t) override { return open('[', Json::array()); }
  bool end_array() override { return close(']'); }
  bool key(string_t& name) override {
    if (skipping()) {
      hash_.add('k', name);
    } else {
      if (stack_.size() == 1) top_key_ = name;
      key_ = std::move(name);
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& why) override {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: …": the number is the library's own.
    const std::string_view text = why.what();
    const std::size_t end = text.find("] ");
    const std::string_view words = end == std::string_view::npos ? text : text.substr(end + 2);
    const bool early = words.find("unexpected end of input") != std::string_view::npos ||
                       words.find("missing closing quote") != std::string_view::npos;
    throw InputError(
        early ? fmt::format("{}: ends in the middle, after {} bytes; write it anew", file_, position)
              : fmt::format("{}: not valid JSON: {}; give a result file", file_, one_line(words, 160)));
  }

  Json take() { return std::move(root_); }

 private:
  [[nodiscard]] bool skipping() const { return skipped_ > 0; }

  template <class Value>
  bool put(char kind, std::uint64_t bits, Value value) {
    if (skipping()) {
      hash_.add(kind, bits);
    } else {
      insert(value);
    }
    return true;
  }

  bool open(char kind, Json container) {
    if (stack_.size() + skipped_ >= kDeepest)
      throw InputError(fmt::format("{}: nests deeper than {} levels; give a result file", file_, kDeepest));
    if (skipping()) {
      hash_.add(kind, 0);
      ++skipped_;
    } else if (kind == '[' && stack_.size() == kDepthOfFrames && top_key_ == "runs" && key_ == "frames") {
      hash_ = {};
      skipped_ = 1;
    } else {
      stack_.push_back(insert(std::move(container)));
    }
    return true;
  }
  bool close(char kind) {
    if (!skipping()) {
      stack_.pop_back();
    } else if (--skipped_ == 0) {
      insert(hash_.value());
    } else {
      hash_.add(kind, 0);
    }
    return true;
  }

  template <class Value>
  Json* insert(Value&& value) {
    if (stack_.empty()) {
      root_ = std::forward<Value>(value);
      return &root_;
    }
    Json& parent = *stack_.back();
    if (parent.is_array()) {
      parent.push_back(std::forward<Value>(value));
      return &parent.back();
    }
    Json& member = parent[key_];
    member = std::forward<Value>(value);  // the last of equal keys stays
    return &member;
  }

  std::string file_, key_, top_key_;
  Json root_;
  // Parents are not touched while a child is open, so these stay valid.
  std::vector<Json*> stack_;
  std::size_t skipped_ = 0;
  ValueHash hash_;
};

}  // namespace

Json read_json(std::string_view text, const std::string& file) {
  Builder builder(one_line(file));
  Json::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

}  // namespace plumbline::compare
