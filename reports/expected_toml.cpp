// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "reports/json_text.h"
#include "reports/report.h"
#include "scenarios/error.h"

namespace plumbline::reports {
namespace {

/// JSON's escapes are TOML's, but for DEL and the escaped slash, which JSON need not write.
std::string toml_string(std::string_view text) {
  std::string out = Json(valid_utf8(one_line(text, 190))).dump();
  for (std::size_t at = 0; (at = out.find('\x7f', at)) != std::string::npos;) out.replace(at, 1, "\\u007F");
  return out;
}

}  // namespace

std::string expected_toml(const verdict::SuiteVerdict& verdict) {
  std::string entries, silent;
  std::set<std::pair<std::string, std::string>> taken;
  for (const verdict::GateVerdict& gate : verdict.gates) {
    const bool kept = gate.expected ? !gate.needless : !gate.pass;
    if (!kept || !taken.insert({gate.run, gate.figure}).second) continue;
    if (!std::isfinite(gate.value)) {
      silent += fmt::format("# {} of {}: nothing was measured, which cannot be expected.\n",
                            one_line(gate.figure), one_line(gate.run));
      continue;
    }
    const std::string why = gate.expected ? gate.why : fmt::format("fails {}", gate.name);
    entries += fmt::format("  {{ run = {}, figure = {}, value = {}, why = {} }},\n", toml_string(gate.run),
                           toml_string(gate.figure), number_text(gate.value), toml_string(why));
  }
  return fmt::format(
      "# What is known to fail in the suite {}. A run that is given this file is red when one of these "
      "figures "
      "changes,\n# in either direction; docs/suites.md says more. Written by plumbline run --write-expected, "
      "which keeps the reasons.\n{}expected = [\n{}]\n",
      toml_string(verdict.suite), silent, entries);
}

}  // namespace plumbline::reports
