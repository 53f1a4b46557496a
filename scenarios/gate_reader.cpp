// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/gate_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/gate_figures.h"
#include "scenarios/nearest.h"

namespace plumbline {
namespace {

std::string_view without_blanks_before(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

// Fills comparison, bound and times_tau from a string like "<= 1.5 tau"; false if it is not one.
bool read_comparison(std::string_view text, GateSpec& gate) {
  text = without_blanks_before(text);
  for (const std::string_view comparison : {"<=", ">=", "==", "<", ">"}) {  // longer ones first
    if (text.substr(0, comparison.size()) == comparison) {
      gate.comparison = comparison;
      break;
    }
  }
  if (gate.comparison.empty()) return false;
  text = without_blanks_before(text.substr(gate.comparison.size()));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), gate.bound);
  if (error != std::errc() || !std::isfinite(gate.bound)) return false;
  text = without_blanks_before(text.substr(static_cast<std::size_t>(end - text.data())));
  gate.times_tau = text.substr(0, 3) == "tau";
  return without_blanks_before(text.substr(gate.times_tau ? 3 : 0)).empty();
}

class GateReader {
 public:
  explicit GateReader(const std::set<std::string>& methods) : methods_(methods) {
    for (const std::string_view figure : kGateFigures) {
      figures_.emplace_back(figure);
      groups_.emplace_back(figure.substr(0, figure.find('.')));
    }
    known_ = figures_;
    known_.emplace_back(kExpectedKey);
  }

  // `prefix`: empty, or the group ("displacement_px.") that `table` stands for.
  void read(const TomlTable& table, const std::string& method, const std::string& prefix) {
    for (const auto& [key, value] : table.entries()) {
      const bool is_group = prefix.empty() && std::find(groups_.begin(), groups_.end(), key) != groups_.end();
      if (key == kExpectedKey && method.empty() && prefix.empty()) continue;  // the suite's reader takes it
      if (!value.is_table()) {
        add(value, method, prefix + key);
      } else if (is_group) {
        read(value.table(), method, key + ".");
      } else if (method.empty() && prefix.empty()) {
        if (methods_.count(key) == 0) {
          value.fail(fmt::format("names no method of this suite; did you mean '{}'?",
                                 nearest_name(key, {methods_.begin(), methods_.end()})));
        }
        read(value.table(), key, "");
      } else {
        value.fail("is a table; give a limit like 0 or \"<= 1 tau\"");
      }
    }
  }

  std::vector<GateSpec> take() { return std::move(gates_); }

 private:
  void add(const TomlValue& value, const std::string& method, const std::string& figure) {
    if (std::find(figures_.begin(), figures_.end(), figure) == figures_.end()) {
      value.fail(fmt::format("limits no known figure; did you mean '{}'?",
                             nearest_name(figure, method.empty() ? known_ : figures_)));
    }
    GateSpec gate = read_limit(value, figure);
    gate.method = method;
    if (!taken_.insert({figure, method}).second) value.fail("is limited twice; keep one of the limits");
    gates_.push_back(std::move(gate));
  }

  const std::set<std::string>& methods_;
  std::vector<std::string> figures_, groups_, known_;
  std::vector<GateSpec> gates_;
  std::set<std::pair<std::string, std::string>> taken_;
};

}  // namespace

std::vector<GateSpec> read_gates(const TomlTable& gate, const std::set<std::string>& methods) {
  GateReader reader(methods);
  reader.read(gate, "", "");
  return reader.take();
}

GateSpec read_limit(const TomlValue& value, const std::string& figure) {
  GateSpec gate;
  gate.figure = figure;
  if (value.is_number()) {
    gate.comparison = "==";
    gate.bound = value.number();
  } else if (!value.is_text()) {
    value.fail("is neither number nor string; give a limit like 0 or \"<= 1 tau\"");
  } else if (!read_comparison(value.text(), gate)) {
    value.fail(
        fmt::format("is \"{}\"; give a limit like 0, \"< 0.5\" or \"<= 1 tau\"", one_line(value.text(), 80)));
  }
  gate.text = fmt::format("{} {} {}{}", figure, gate.comparison, gate.bound, gate.times_tau ? " tau" : "");
  return gate;
}

}  // namespace plumbline
