// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/atlas/case_file.h"

#include <bit>

#include <fmt/format.h>

#include "scenarios/toml_reader.h"
#include "scenarios/whole_file.h"

namespace plumbline::properties {
namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The first of the stored fields that differs; empty if none does.
std::string difference_of(const LawOutcome& got, const LawOutcome& stored) {
  if (got.kind != stored.kind) {
    return fmt::format("outcome is {}, stored is {}", outcome_name(got.kind), outcome_name(stored.kind));
  }
  if (got.finding.has_value() != stored.finding.has_value()) {
    return got.finding ? "a finding, where none is stored" : "no finding, where one is stored";
  }
  if (got.finding) {
    const oracle::Finding& g = *got.finding;
    const oracle::Finding& s = *stored.finding;
    if (g.code != s.code) {
      return fmt::format("finding {}, stored is {}", static_cast<int>(g.code), static_cast<int>(s.code));
    }
    if (g.kind != s.kind) return fmt::format("finding of kind '{}', stored is '{}'", g.kind, s.kind);
    if (!same_bits(g.at.x, s.at.x) || !same_bits(g.at.y, s.at.y) || !same_bits(g.at.z, s.at.z)) {
      return fmt::format("finding at ({}, {}, {}), stored is ({}, {}, {})", g.at.x, g.at.y, g.at.z, s.at.x,
                         s.at.y, s.at.z);
    }
    if (!same_bits(g.gap_m, s.gap_m)) return fmt::format("gap of {} m, stored is {} m", g.gap_m, s.gap_m);
  }
  if (got.what != stored.what) return fmt::format("'{}', stored is '{}'", got.what, stored.what);
  return {};
}

}  // namespace

void write_case(const std::filesystem::path& path, const Case& c) { write_whole_file(path, case_text(c)); }

Case parse_case(std::string_view text, const std::string& name) {
  return parse_case(
      text, name,
      {[](const std::string& id) { find_law(id); }, [](const std::string& id) { find_method(id); }});
}

Case load_case(const std::filesystem::path& path) { return parse_case(read_toml_text(path), path.string()); }

ReplayResult replay(const Case& c) {
  ReplayResult result;
  result.outcome = judge(find_law(c.law), c.input);
  result.difference = difference_of(result.outcome, c.expected);
  result.confirmed = result.difference.empty();
  return result;
}

}  // namespace plumbline::properties
