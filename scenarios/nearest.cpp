// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/nearest.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

constexpr std::size_t kBytesCompared = 64;

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, kBytesCompared);
  b = b.substr(0, kBytesCompared);
  // One row of the dynamic programme: row[j] is the distance of the first i bytes of a to the first j of b.
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  const auto nearer = [&](const std::string& a, const std::string& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  };
  const auto best = std::min_element(candidates.begin(), candidates.end(), nearer);
  return best == candidates.end() ? std::string() : *best;
}

std::string unknown_name(std::string_view what, std::string_view name,
                         const std::vector<std::string>& candidates) {
  std::string message = fmt::format("unknown {} '{}'", what, one_line(name, 80));
  if (!candidates.empty()) message += fmt::format("; did you mean '{}'?", nearest_name(name, candidates));
  return message;
}

}  // namespace plumbline
