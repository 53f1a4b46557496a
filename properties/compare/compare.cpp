// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::compare {
namespace {

using verdict::Change;
using verdict::Comparison;
using verdict::Difference;
using verdict::Matter;

/// Counts of findings (conformity's stand alone, or in its group) come before measures, whose weight is a
/// relative change of at most 2.
constexpr double kCountsFirst = 1e9;
constexpr const char* kNothing = "—";

Difference difference(Change change, Matter matter, std::string where, std::string what) {
  Difference out;
  out.change = change;
  out.matter = matter;
  out.where = std::move(where);
  out.what = std::move(what);
  return out;
}

/// Number of occurrences of each key, in either file.
template <class Key>
using Tally = std::map<Key, std::pair<std::size_t, std::size_t>>;

class Comparer {
 public:
  Comparer(const ResultFile& before, const ResultFile& after, double tolerance)
      : before_(before), after_(after) {
    out_.schema = after.schema;
    out_.before = before.name;
    out_.after = after.name;
    out_.tolerance = tolerance;
  }

  Comparison compare() {
    compare_readings(before_.verdicts, after_.verdicts, "", Matter::verdict);
    compare_readings(before_.settings, after_.settings, "", Matter::setting);
    compare_subjects();
    compare_gates();
    compare_vacuous();
    compare_findings();
    std::ranges::stable_sort(out_.differences, [](const Difference& a, const Difference& b) {
      return std::tuple(a.change, a.matter, -a.weight) < std::tuple(b.change, b.matter, -b.weight);
    });
    return std::move(out_);
  }

 private:
  Difference& add(Difference one) { return out_.differences.emplace_back(std::move(one)); }

  /// `before` or `after` is null where a file does not have it.
  void compare_reading(const Reading* before, const Reading* after, const std::string& where, Matter matter) {
    static const Reading kAbsent;
    const Reading& a = before == nullptr ? kAbsent : *before;
    const Reading& b = after == nullptr ? kAbsent : *after;
    const std::string& path = before == nullptr ? b.path : a.path;
    if (a.kind == Reading::Kind::not_judged && b.kind == Reading::Kind::not_judged) return;
    if (a.kind == b.kind && (a.kind == Reading::Kind::text ? a.text == b.text : a.value == b.value)) {
      ++out_.same;
      return;
    }
    if (a.kind != Reading::Kind::text && b.kind != Reading::Kind::text) {
      if (is_close(a, b)) {
        ++out_.same;
        ++out_.within_tolerance;
        return;
      }
      const verdict::Direction direction = before == nullptr ? b.direction : a.direction;
      Difference& one =
          add(difference(verdict::figure_change(direction, a.value, b.value), matter, where, path));
      if (!std::isnan(a.value)) one.before = a.value;
      if (!std::isnan(b.value)) one.after = b.value;
      one.before_text = one.after_text = "not judged";
      one.weight = weight(a, b, direction);
      return;
    }
    Change change = Change::changed;
    if (a.rank >= 0 && b.rank >= 0 && a.rank != b.rank)
      change = b.rank > a.rank ? Change::worse : Change::better;
    Difference& one = add(difference(change, matter, where, path));
    one.before_text = words(a);
    one.after_text = words(b);
  }

  [[nodiscard]] bool is_close(const Reading& a, const Reading& b) const {
    if (out_.tolerance == 0 || (a.counted && b.counted)) return false;
    return std::fabs(a.value - b.value) <= out_.tolerance * std::max(std::fabs(a.value), std::fabs(b.value));
  }
  static double weight(const Reading& a, const Reading& b, verdict::Direction direction) {
    if (std::isnan(a.value) || std::isnan(b.value)) return 2 * kCountsFirst;
    const double change = std::fabs(b.value - a.value);
    const bool finding = a.path.find('.') == std::string::npos || a.path.starts_with("conformity.");
    if (finding && a.counted && b.counted && direction != verdict::Direction::neither)
      return kCountsFirst + change;
    return change / std::max(std::fabs(a.value), std::fabs(b.value));
  }
  static std::string words(const Reading& reading) {
    if (reading.kind == Reading::Kind::text) return reading.text;
    return reading.kind == Reading::Kind::number ? fmt::format("{}", reading.value) : kNothing;
  }

  void compare_readings(const std::vector<Reading>& before, const std::vector<Reading>& after,
                        const std::string& where, Matter matter) {
    std::map<std::string_view, const Reading*> left;
    for (const Reading& reading : after) left[reading.path] = &reading;
    for (const Reading& reading : before) {
      const auto other = left.find(reading.path);
      const Reading* found = other == left.end() ? nullptr : other->second;
      if (found != nullptr) left.erase(other);
      if (found != nullptr || !is_gone(reading.path, matter)) compare_reading(&reading, found, where, matter);
    }
    for (const Reading& reading : after) {
      if (left.count(reading.path) > 0 && !is_gone(reading.path, matter))
        compare_reading(nullptr, &reading, where, matter);
    }
  }

  /// A figure that one of the files has nowhere, which is one change, not one a run.
  [[nodiscard]] bool is_gone(const std::string& path, Matter matter) const {
    return matter == Matter::figure && one_sided_.count(path) > 0;
  }

  static bool has_group(const std::set<std::string, std::less<>>& paths, std::string_view path) {
    for (std::size_t dot = path.find('.'); dot != std::string_view::npos; dot = path.find('.', dot + 1))
      if (paths.count(path.substr(0, dot)) > 0) return true;
    return false;
  }

  void find_one_sided_figures() {
    Tally<std::string> paths;
    std::set<std::string, std::less<>> silent_before, silent_after;  // null somewhere, alone or as a group
    std::set<std::string, std::less<>> judged;
    const auto take = [&](const ResultFile& file, auto& silent, auto side) {
      for (const Subject& subject : file.subjects) {
        for (const Reading& reading : subject.readings) {
          ++(paths[reading.path].*side);
          (reading.kind == Reading::Kind::not_judged ? silent : judged).insert(reading.path);
        }
      }
    };
    using Counts = std::pair<std::size_t, std::size_t>;
    take(before_, silent_before, &Counts::first);
    take(after_, silent_after, &Counts::second);
    for (const auto& [path, times] : paths) {
      if (times.first > 0 && times.second > 0) continue;
      // Nothing to tell; or a whole group that was not judged there, so that none of its figures stands.
      if (judged.count(path) == 0 || has_group(times.first > 0 ? silent_after : silent_before, path))
        continue;
      one_sided_.insert(path);
      Difference& one = add(difference(Change::changed, Matter::setting, "", path));
      one.before_text = times.first > 0 ? "is told" : kNothing;
      one.after_text = times.second > 0 ? "is told" : kNothing;
    }
  }

  void compare_subjects() {
    if (!before_.subjects.empty() && !after_.subjects.empty()) find_one_sided_figures();
    std::map<std::pair<std::string_view, std::size_t>, const Subject*> left;  // id, how often it came before
    std::map<std::string_view, std::size_t> times_before, times_after;
    for (const Subject& subject : after_.subjects) left[{subject.id, times_after[subject.id]++}] = &subject;
    for (const Subject& subject : before_.subjects) {
      const auto other = left.find({subject.id, times_before[subject.id]++});
      if (other == left.end()) {
        Difference& one = add(difference(Change::worse, Matter::run, subject.id, noun(subject.id)));
        one.before_text = "judged";
        one.after_text = "gone";
        lost_.insert(subject.id);
        continue;
      }
      compare_subject(subject, *other->second);
      left.erase(other);
    }
    times_after.clear();
    for (const Subject& subject : after_.subjects) {
      if (left.count({subject.id, times_after[subject.id]++}) == 0) continue;
      Difference& one = add(difference(Change::changed, Matter::run, subject.id, noun(subject.id)));
      one.before_text = kNothing;
      one.after_text = "new";
      fresh_.insert(subject.id);
    }
  }

  void compare_subject(const Subject& before, const Subject& after) {
    if (!before.id.empty()) ++out_.subjects;
    const std::size_t differences = out_.differences.size();
    compare_readings(before.readings, after.readings, before.id, Matter::figure);
    const bool told = out_.differences.size() > differences;
    if (told || out_.tolerance > 0 || before.frames == 0 || after.frames == 0 ||
        before.frames == after.frames)
      return;
    Difference& one = add(difference(Change::changed, Matter::figure, before.id, "single frames"));
    one.before_text = one.after_text = kNothing;
    one.note = "frames differ, their summary does not";
  }

  [[nodiscard]] std::string noun(const std::string& id) const {
    if (out_.schema == kResultsSchema) return "run";
    return id.find(" | ") == std::string::npos ? "mesh" : "seam";
  }

  void compare_gates() {
    using Key = std::pair<std::string_view, std::string_view>;  // run, name
    std::map<Key, std::vector<const GateReading*>> of_key;      // the first is the last element
    std::set<const GateReading*> left;
    for (auto gate = after_.gates.rbegin(); gate != after_.gates.rend(); ++gate) {
      of_key[{gate->run, gate->name}].push_back(&*gate);
      left.insert(&*gate);
    }
    std::map<std::pair<std::string_view, bool>, std::size_t> gone, fresh;
    for (const GateReading& gate : before_.gates) {
      if (lost_.count(gate.run) > 0) continue;
      const auto other = of_key.find({gate.run, gate.name});
      if (other == of_key.end() || other->second.empty()) {
        ++gone[{gate.name, gate.pass}];
        continue;
      }
      const GateReading& now = *other->second.back();
      other->second.pop_back();
      left.erase(&now);
      if (gate.pass == now.pass) {
        ++out_.same;
        continue;
      }
      Difference& one = add(
          difference(now.pass ? Change::better : Change::worse, Matter::gate, gate.run, "gate " + gate.name));
      one.before_text = gate.pass ? "holds" : "fails";
      one.after_text = now.pass ? "holds" : "fails";
    }
    for (const GateReading& gate : after_.gates) {
      if (left.count(&gate) == 0) continue;
      if (gate.pass) {
        if (fresh_.count(gate.run) == 0) ++fresh[{gate.name, true}];
        continue;
      }
      Difference& one = add(difference(Change::worse, Matter::gate, gate.run, "gate " + gate.name));
      one.before_text = kNothing;
      one.after_text = "fails";
    }
    const auto tell = [&](const auto& gates, bool is_gone) {
      for (const auto& [gate, runs] : gates) {
        Difference& one =
            add(difference(Change::changed, Matter::gate, "", fmt::format("gate {}", gate.first)));
        const std::string state = gate.second ? "holds" : "fails";
        one.before_text = is_gone ? state : kNothing;
        one.after_text = is_gone ? "not asked" : state;
        one.note = runs == 1 ? "1 run" : fmt::format("{} runs", runs);
      }
    };
    tell(gone, true);
    tell(fresh, false);
  }

  void compare_vacuous() {
    Tally<std::string> lines;
    for (const std::string& line : before_.vacuous) ++lines[line].first;
    for (const std::string& line : after_.vacuous) ++lines[line].second;
    for (const auto& [line, times] : lines) {
      out_.same += std::min(times.first, times.second);
      if (times.first == times.second) continue;
      Difference& one = add(
          difference(times.second > times.first ? Change::worse : Change::better, Matter::vacuous, "", line));
      one.before_text = times.first > 0 ? "judged nothing" : kNothing;
      one.after_text = times.second > 0 ? "judged nothing" : kNothing;
    }
  }

  void compare_findings() {
    Tally<FindingReading> findings;
    for (const FindingReading& finding : before_.findings) ++findings[finding].first;
    for (const FindingReading& finding : after_.findings) ++findings[finding].second;
    for (const auto& [finding, times] : findings) {
      out_.same += std::min(times.first, times.second);
      if (times.first == times.second) continue;
      const bool more = times.second > times.first;
      // What a file does not list, the other's list cannot tell as new or gone.
      const bool certain = more ? before_.findings_complete : after_.findings_complete;
      const Change change = !certain ? Change::changed : more ? Change::worse : Change::better;
      Difference& one = add(difference(
          change, Matter::finding, finding.mesh,
          fmt::format("{} {}{}{}{} at {}, {}, {}", finding.code, finding.name,
                      finding.kind.empty() ? "" : ": ", finding.kind, finding.hazard ? " (hazard)" : "",
                      finding.at[0], finding.at[1], finding.at[2])));
      const auto state = [](std::size_t number) {
        return number == 0 ? std::string(kNothing) : number == 1 ? "found" : fmt::format("found {}×", number);
      };
      one.before_text = state(times.first);
      one.after_text = state(times.second);
    }
    for (const ResultFile* file : {&before_, &after_}) {
      if (!file->findings_complete) {
        out_.notes.push_back(fmt::format(
            "{} lists its worst findings only: the counts tell what is worse, not the list", file->name));
      }
    }
  }

  const ResultFile& before_;
  const ResultFile& after_;
  Comparison out_;
  std::set<std::string, std::less<>> one_sided_, lost_, fresh_;
};

/// One mesh against one mesh is meant to be compared, whatever the two files are called.
std::string pair_single_meshes(ResultFile& before, const ResultFile& after) {
  constexpr std::size_t kWholeAndMesh = 2;
  if (after.schema != kCheckSchema || before.subjects.size() != kWholeAndMesh ||
      after.subjects.size() != kWholeAndMesh) {
    return {};
  }
  const std::string from = before.subjects[1].id, to = after.subjects[1].id;
  if (from == to) return {};
  before.subjects[1].id = to;
  for (FindingReading& finding : before.findings)
    if (finding.mesh == from) finding.mesh = to;
  for (Reading& setting : before.settings)
    if (setting.path.starts_with(from + ": ")) setting.path.replace(0, from.size(), to);
  return fmt::format("{} before is compared with {} after", from, to);
}

/// A code that one check counted and the other did not find.
void tell_codes_not_found(ResultFile& of, const ResultFile& other) {
  if (!of.counts_by_code || of.subjects.empty() || other.subjects.empty()) return;
  std::set<std::string_view> told;
  for (const Reading& reading : of.subjects.front().readings) told.insert(reading.path);
  std::vector<Reading> missing;
  for (const Reading& reading : other.subjects.front().readings) {
    if (!reading.path.starts_with(verdict::kFindingsByCode) || told.count(reading.path) > 0) continue;
    missing.push_back(reading);
    missing.back().value = 0;
  }
  auto& readings = of.subjects.front().readings;
  readings.insert(readings.end(), missing.begin(), missing.end());
}

}  // namespace

verdict::Comparison compare_results(ResultFile before, ResultFile after, double tolerance) {
  if (before.schema != after.schema) {
    throw InputError(fmt::format("{} is of schema \"{}\", {} of \"{}\"; compare two of one kind",
                                 one_line(before.name), before.schema, one_line(after.name), after.schema));
  }
  const std::string note = pair_single_meshes(before, after);
  tell_codes_not_found(before, after);
  tell_codes_not_found(after, before);
  Comparison comparison = Comparer(before, after, tolerance).compare();
  if (!note.empty()) comparison.notes.insert(comparison.notes.begin(), note);
  return comparison;
}

}  // namespace plumbline::compare
