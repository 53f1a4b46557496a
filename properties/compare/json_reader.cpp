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

/// FNV-1a over bytes.
class Hash {
 public:
  void add(std::uint64_t bits) {
    for (int shift = 0; shift < 64; shift += 8) add_byte(static_cast<unsigned char>(bits >> shift & 0xffU));
  }
  void add(std::string_view text) {
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3U; }
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// A hash of a JSON value that depends on neither blanks nor the order of keys.
class ValueHash {
 public:
  void key(std::string_view name) {
    Hash hash;
    hash.add(name);
    levels_.back().key = hash.value();
  }
  void scalar(char kind, std::uint64_t bits) {
    Hash hash;
    hash.add(std::uint64_t{static_cast<unsigned char>(kind)});
    hash.add(bits);
    add(hash.value());
  }
  void text(std::string_view value) {
    Hash hash;
    hash.add(value);
    scalar('s', hash.value());
  }
  void open(bool object) {
    levels_.emplace_back();
    levels_.back().object = object;
  }
  /// The hash of the whole when its last container closes, else 0.
  std::uint64_t close() {
    const Level level = levels_.back();
    levels_.pop_back();
    const std::uint64_t hash = level.object ? level.sum : level.list.value();
    if (levels_.empty()) return hash;
    scalar(level.object ? '{' : '[', hash);
    return 0;
  }
  [[nodiscard]] std::size_t depth() const { return levels_.size(); }

 private:
  struct Level {
    bool object = false;
    std::uint64_t key = 0, sum = 0;  // of an object: members are added, which has no order
    Hash list;                       // of an array
  };
  void add(std::uint64_t value) {
    Level& level = levels_.back();
    if (!level.object) {
      level.list.add(value);
      return;
    }
    Hash member;
    member.add(level.key);
    member.add(value);
    level.sum += member.value();
  }
  std::vector<Level> levels_;
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
      hash_.text(value);
    } else {
      insert(std::move(value));
    }
    return true;
  }
  bool binary(binary_t&) override { return false; }  // no JSON text has one

  bool start_object(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (skipping()) {
      hash_.key(name);
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
  [[nodiscard]] bool skipping() const { return hash_.depth() > 0; }

  template <class Value>
  bool put(char kind, std::uint64_t bits, Value value) {
    if (skipping()) {
      hash_.scalar(kind, bits);
    } else {
      insert(value);
    }
    return true;
  }

  bool open(bool object) {
    if (stack_.size() + hash_.depth() >= kDeepest)
      throw InputError(fmt::format("{}: nests deeper than {} levels; give a result file", file_, kDeepest));
    const bool frames = !object && stack_.size() == kDepthOfFrames && top_key_ == "runs" && key_ == "frames";
    if (skipping() || frames) {
      hash_.open(object);
    } else {
      stack_.push_back(insert(object ? Json::object() : Json::array()));
    }
    return true;
  }
  bool close() {
    if (!skipping()) {
      stack_.pop_back();
      return true;
    }
    const std::uint64_t hash = hash_.close();
    if (!skipping()) insert(hash);
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
  ValueHash hash_;
};

}  // namespace

Json read_json(std::string_view text, const std::string& file) {
  Builder builder(one_line(file));
  Json::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

}  // namespace plumbline::compare
