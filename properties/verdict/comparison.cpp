// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/verdict/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "properties/verdict/verdict.h"

namespace plumbline::verdict {
namespace {

constexpr std::array<std::string_view, 3> kDescribe{"triangles", "triangles_max", "stability.cuts"};
constexpr std::array<std::string_view, 1> kLessIsWorse{"shape.min_quality"};

/// Of checks: last words of paths whose growth is bad whatever they stand in.
constexpr std::array<std::string_view, 34> kBadWords{"max",
                                                     "certain_max",
                                                     "rms",
                                                     "mean",
                                                     "p999",
                                                     "p99",
                                                     "over_threshold",
                                                     "uncovered_px",
                                                     "samples_max_m",
                                                     "slivers",
                                                     "t_junctions",
                                                     "cracks",
                                                     "crack",
                                                     "t_junction",
                                                     "largest_gap_m",
                                                     "mean_gap_m",
                                                     "mean_abs_gap_m",
                                                     "least_skirt_m",
                                                     "least_skirt_other_m",
                                                     "normal_max_deg",
                                                     "normal_mean_deg",
                                                     "turned_share",
                                                     "self_intersections",
                                                     "visible_findings",
                                                     "findings_total",
                                                     "tile_faults",
                                                     "pixels",
                                                     "faulty",
                                                     "broken",
                                                     "open",
                                                     "sufficient_skirt_m",
                                                     "samples_max",
                                                     "least",
                                                     "most"};

template <std::size_t Size>
bool is_one_of(std::string_view word, const std::array<std::string_view, Size>& words) {
  return std::ranges::find(words, word) != words.end();
}

bool is_about_findings(const Difference& one) {
  if (one.matter == Matter::finding || one.matter == Matter::vacuous) return true;
  // A set that was sound, or a mesh that was judged: without them a list of findings is short for nothing.
  if (one.matter == Matter::verdict || one.matter == Matter::run) return one.change == Change::worse;
  if (one.matter != Matter::figure) return false;
  if (one.what.starts_with("conformity.") || one.what.starts_with(kFindingsByCode) ||
      one.what == "findings_total" || one.what == "tile_faults")
    return true;
  const auto known = figures();
  const auto figure = std::ranges::find(known, one.what, &Figure::path);
  return figure != known.end() && figure->unit == "count" && one.what.find('.') == std::string::npos &&
         figure_direction(one.what) != Direction::neither;
}

}  // namespace

Direction figure_direction(std::string_view path) {
  constexpr std::string_view kGroup = "conformity.";  // of checks; a run's counts stand alone
  if (path.starts_with(kGroup)) path.remove_prefix(kGroup.size());
  if (path.starts_with(kFindingsByCode)) return Direction::more_is_worse;
  if (is_one_of(path, kLessIsWorse)) return Direction::less_is_worse;
  if (is_one_of(path, kDescribe)) return Direction::neither;
  const auto known = figures();
  if (std::ranges::find(known, path, &Figure::path) != known.end()) return Direction::more_is_worse;
  const std::string_view last = path.substr(path.rfind('.') + 1);
  if (last == "min_quality" || last == "mean_quality" || last == "least_angle_deg")
    return Direction::less_is_worse;
  return is_one_of(last, kBadWords) ? Direction::more_is_worse : Direction::neither;
}

std::string_view change_name(Change change) {
  switch (change) {
    case Change::worse:
      return "worse";
    case Change::better:
      return "better";
    case Change::changed:
      return "changed";
  }
  return "changed";
}

Change figure_change(Direction direction, double before, double after) {
  if (std::isnan(after)) return Change::worse;
  if (std::isnan(before) || direction == Direction::neither) return Change::changed;
  const double more = std::fabs(after) - std::fabs(before);
  if (more == 0 || std::isnan(more)) return Change::changed;
  return (more > 0) == (direction == Direction::more_is_worse) ? Change::worse : Change::better;
}

std::string_view matter_name(Matter matter) {
  switch (matter) {
    case Matter::verdict:
      return "verdict";
    case Matter::run:
      return "run";
    case Matter::gate:
      return "gate";
    case Matter::vacuous:
      return "vacuous";
    case Matter::finding:
      return "finding";
    case Matter::figure:
      return "figure";
    case Matter::setting:
      return "setting";
  }
  return "figure";
}

std::size_t Comparison::count(Change change) const {
  return static_cast<std::size_t>(std::ranges::count(differences, change, &Difference::change));
}

std::string_view Comparison::word() const {
  if (differences.empty()) return "unchanged";
  if (count(Change::worse) > 0) return "worse";
  return count(Change::better) > 0 ? "better" : "changed";
}

Comparison findings_only(Comparison comparison) {
  std::erase_if(comparison.differences, [](const Difference& one) { return !is_about_findings(one); });
  comparison.notes.emplace_back("findings and their counts only: other differences are left out");
  return comparison;
}

}  // namespace plumbline::verdict
