// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace plumbline::reports {
namespace {

constexpr auto kReplace = Json::error_handler_t::replace;

class Writer {
 public:
  explicit Writer(int expand) : expand_(expand) {}

  void write(const Json& value, int level) {
    if (value.is_object() || value.is_array()) {
      write_container(value, level);
    } else if (value.is_number_float()) {
      out_ += number_text(value.get<double>());
    } else {
      out_ += value.dump(-1, ' ', false, kReplace);
    }
  }

  std::string take() { return std::move(out_) + "\n"; }

 private:
  void write_container(const Json& value, int level) {
    const bool object = value.is_object();
    if (value.empty()) {
      out_ += object ? "{}" : "[]";
      return;
    }
    const bool spread = level <= expand_ && std::any_of(value.begin(), value.end(), [](const Json& member) {
                          return member.is_structured();
                        });
    out_ += object ? '{' : '[';
    bool first = true;
    for (auto member = value.begin(); member != value.end(); ++member) {
      if (!first) out_ += spread ? "," : ", ";
      if (spread) new_line(level + 1);
      if (object) out_ += Json(member.key()).dump(-1, ' ', false, kReplace) + ": ";
      write(*member, level + 1);
      first = false;
    }
    if (spread) new_line(level);
    out_ += object ? '}' : ']';
  }
  void new_line(int level) {
    out_ += '\n';
    out_.append(static_cast<std::size_t>(level) * 2, ' ');
  }

  int expand_;
  std::string out_;
};

}  // namespace

std::string number_text(double value) {
  if (!std::isfinite(value)) return "null";
  if (value == 0) return "0";
  std::array<char, 32> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), result.ptr};
}

std::string json_text(const Json& value, int expand) {
  Writer writer(expand);
  writer.write(value, 0);
  return writer.take();
}

std::string valid_utf8(std::string_view text) {
  return Json::parse(Json(text).dump(-1, ' ', false, kReplace)).get<std::string>();
}

}  // namespace plumbline::reports
