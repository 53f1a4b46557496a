// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/verdict/paper_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace plumbline::tables {
namespace {

/// Digits after the point of a printed decimal.
int decimals_of(std::string_view printed) {
  const std::size_t point = printed.find('.');
  return point == std::string_view::npos ? 0 : static_cast<int>(printed.size() - point) - 1;
}

double power_of_ten(int exponent) {
  double power = 1;
  for (int k = 0; k < exponent; ++k) power *= 10;
  return power;
}

}  // namespace

std::string_view kind_name(Kind kind) {
  switch (kind) {
    case Kind::fitted:
      return "fitted";
    case Kind::predicted:
      return "predicted";
    case Kind::derived:
      return "derived";
    case Kind::measured:
      return "measured";
  }
  return "";
}

std::string_view agreement_name(Agreement agreement) {
  switch (agreement) {
    case Agreement::not_checked:
      return "not checked";
    case Agreement::rounded:
      return "rounded";
    case Agreement::truncated:
      return "truncated";
    case Agreement::misprint:
      return "misprint";
  }
  return "";
}

double printed_number(std::string_view printed) {
  double digits = 0;
  int decimals = 0, seen = 0;
  bool point = false;
  for (const char c : printed) {
    if (c == ' ' && !point) continue;
    if (c == '.' && !point) {
      point = true;
    } else if (c >= '0' && c <= '9') {
      digits = digits * 10 + (c - '0');
      decimals += point ? 1 : 0;
      ++seen;
    } else {
      throw std::invalid_argument(fmt::format("not a printed figure: '{}'", printed));
    }
  }
  if (seen == 0) throw std::invalid_argument(fmt::format("not a printed figure: '{}'", printed));
  return digits / power_of_ten(decimals);
}

Agreement agreement_of(std::string_view printed, double recomputed) {
  const double scale = power_of_ten(decimals_of(printed));
  const double shown = std::floor(printed_number(printed) * scale + 0.5);
  const double exact = recomputed * scale;
  if (shown == std::floor(exact + 0.5)) return Agreement::rounded;
  return shown == std::floor(exact) ? Agreement::truncated : Agreement::misprint;
}

std::string figure_text(double value, int decimals) {
  const std::string plain = fmt::format("{:.{}f}", value, decimals);
  const std::size_t start = plain.starts_with('-') ? 1 : 0;
  const std::size_t whole = std::min(plain.find('.'), plain.size());
  std::string text = plain.substr(0, start);
  for (std::size_t k = start; k < plain.size(); ++k) {
    if (k > start && k < whole && (whole - k) % 3 == 0) text += ' ';
    text += plain[k];
  }
  return text;
}

Agreement Figure::agreement() const {
  return printed.empty() || !recomputed ? Agreement::not_checked : agreement_of(printed, *recomputed);
}

std::optional<double> Figure::paper() const {
  if (recomputed) return recomputed;
  if (!printed.empty()) return printed_number(printed);
  return std::nullopt;
}

StandIn describe_stand_in(const Terrain& terrain, std::string origin) {
  return {terrain.id,         std::move(origin),  0, terrain.columns, terrain.rows, terrain.spacing_m,
          terrain.lowest_m(), terrain.highest_m()};
}

std::optional<double> ratio(const Figure& figure, const std::optional<double>& ours) {
  const std::optional<double> paper = figure.paper();
  if (!paper || !ours || *paper == 0) return std::nullopt;
  return *ours / *paper;
}

}  // namespace plumbline::tables
