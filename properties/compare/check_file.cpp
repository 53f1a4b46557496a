// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/compare/check_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::compare {
namespace {

/// Statements of a check about a declared bound: which answer is the bad one. A member not listed here is
/// neither good nor bad.
constexpr std::array<std::pair<std::string_view, bool>, 5> kBadAnswers{
    {{"at_samples", false}, {"certain", false}, {"everywhere", false}, {"holds", false}, {"broken", true}}};
/// States of a seam, from good to bad, by how they begin.
constexpr std::array<std::string_view, 3> kSeamStates{"watertight", "covered", "open"};

Reading answer(std::string path, std::string_view key, bool value) {
  Reading reading = text_reading(std::move(path), value ? "true" : "false");
  const auto* known = std::ranges::find(kBadAnswers, key, &std::pair<std::string_view, bool>::first);
  if (known != kBadAnswers.end()) reading.rank = value == known->second ? 1 : 0;
  return reading;
}

/// Takes every number below `object` as a figure of `subject` and every string as a setting.
void walk(const Json& object, const std::string& prefix, const std::string& setting_prefix, Subject& subject,
          std::vector<Reading>& settings, const Place& place) {
  for (const auto& [key, value] : object.items()) {
    const std::string path = prefix + key;
    if (key == "camera") {  // where it was looked from is no figure
      settings.push_back(text_reading(setting_prefix + path, plain_text(value)));
    } else if (value.is_number() || value.is_null()) {
      Reading reading = read_number(value, path, place);
      reading.direction = verdict::figure_direction(path);
      reading.counted = value.is_number_integer();
      subject.readings.push_back(std::move(reading));
    } else if (value.is_boolean()) {
      subject.readings.push_back(answer(path, key, value.get<bool>()));
    } else if (value.is_string()) {
      settings.push_back(text_reading(setting_prefix + path, value.get<std::string>()));
    } else if (value.is_object()) {
      walk(value, path + ".", setting_prefix, subject, settings, place);  // as deep as the reader allows
    }
  }
}

/// Meshes by a name that does not depend on the folder they were checked in. Tiles have theirs from their
/// place in the grid: level, column, row.
class MeshNames {
 public:
  MeshNames(const Json& meshes, const Place& place) {
    for (const Json& mesh : meshes) files_.push_back(text_at(mesh, "file", place));
    std::vector<bool> is_tile;
    std::optional<std::string> common;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      const auto format = meshes[k].find("format");
      is_tile.push_back(format != meshes[k].end() && *format == "quantized-mesh");
      if (is_tile.back()) continue;
      const std::string& file = files_[k];
      if (!common) common = file.substr(0, file.rfind('/') + 1);
      std::string& folder = *common;
      while (!file.starts_with(folder))
        folder.resize(folder.size() < 2 ? 0 : folder.rfind('/', folder.size() - 2) + 1);
    }
    std::map<std::string, int> seen;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      const std::string& file = files_[k];
      std::string name = is_tile[k] ? file : file.substr(common->size());
      const int times = ++seen[name];
      if (times > 1) name += fmt::format(" ({})", times);
      by_file_.try_emplace(file, name);
      names_.push_back(std::move(name));
    }
  }
  [[nodiscard]] const std::string& operator[](std::size_t mesh) const { return names_[mesh]; }

  /// The mesh that `key` names, by its index or its file; empty if it names none.
  [[nodiscard]] std::string named(const Json& object, const char* key, const Place& place) const {
    const auto value = object.find(key);
    if (value == object.end() || value->is_null()) return {};
    if (value->is_number_unsigned()) {
      const auto index = value->get<std::uint64_t>();
      if (index >= names_.size())
        place.fail(fmt::format("names mesh {}, and there are {}; write it anew", index, names_.size()));
      return names_[static_cast<std::size_t>(index)];
    }
    const std::string file = text_at(object, key, place);
    const auto known = by_file_.find(file);
    return known == by_file_.end() ? file : known->second;
  }

 private:
  std::vector<std::string> files_, names_;
  std::map<std::string, std::string> by_file_;
};

FindingReading read_finding(const Json& json, const MeshNames& names, const Place& place) {
  FindingReading finding;
  const auto code = json.find("code");
  if (code == json.end() || !code->is_number_integer()) place.fail("has no \"code\"; write it anew");
  finding.code = code->get<int>();
  if (json.contains("name")) finding.name = text_at(json, "name", place);
  if (json.contains("kind")) finding.kind = text_at(json, "kind", place);
  if (json.contains("severity")) finding.hazard = text_at(json, "severity", place) == "hazard";
  finding.mesh = names.named(json, "mesh", place);
  if (const std::string other = names.named(json, "other_mesh", place); !other.empty())
    finding.mesh += " | " + other;
  if (const auto at = json.find("at"); at != json.end() && at->is_array()) {
    for (std::size_t k = 0; k < std::min(at->size(), finding.at.size()); ++k) {
      const Reading coordinate = read_number((*at)[k], "at", place);
      // A place that is no number is null; it must equal itself to be found again.
      finding.at[k] = coordinate.kind == Reading::Kind::number ? coordinate.value
                                                               : std::numeric_limits<double>::infinity();
    }
  }
  return finding;
}

}  // namespace

void Place::fail(std::string_view what) const {
  throw InputError(part.empty() ? fmt::format("{}: {}", file, what)
                                : fmt::format("{}: {} {}", file, part, what));
}

namespace {

const Json& member(const Json& object, const char* key, const Place& place) {
  if (!object.is_object()) place.fail("is no object; write the file anew");
  const auto found = object.find(key);
  if (found == object.end()) place.fail(fmt::format("has no \"{}\"; write the file anew", key));
  return *found;
}

[[noreturn]] void refuse(const Json& value, std::string_view key, const char* wanted, const Place& place) {
  place.fail(fmt::format("has \"{}\" of type {}, where {} belongs; write the file anew", one_line(key, 80),
                         value.type_name(), wanted));
}

}  // namespace

std::string text_at(const Json& object, const char* key, const Place& place) {
  const Json& value = member(object, key, place);
  if (!value.is_string()) refuse(value, key, "a string", place);
  return value.get<std::string>();
}

bool truth_at(const Json& object, const char* key, const Place& place) {
  const Json& value = member(object, key, place);
  if (!value.is_boolean()) refuse(value, key, "true or false", place);
  return value.get<bool>();
}

const Json& object_at(const Json& object, const char* key, const Place& place) {
  const Json& value = member(object, key, place);
  if (!value.is_object()) refuse(value, key, "an object", place);
  return value;
}

const Json& array_at(const Json& object, const char* key, const Place& place) {
  const Json& value = member(object, key, place);
  if (!value.is_array()) refuse(value, key, "a list", place);
  return value;
}

Reading read_number(const Json& value, std::string path, const Place& place) {
  if (!value.is_number() && !value.is_null()) refuse(value, path, "a number", place);
  Reading reading;
  reading.path = std::move(path);
  if (value.is_null()) return reading;
  reading.kind = Reading::Kind::number;
  reading.value = value.get<double>();
  return reading;
}

Reading text_reading(std::string path, std::string text) {
  Reading reading;
  reading.path = std::move(path);
  reading.kind = Reading::Kind::text;
  reading.text = std::move(text);
  return reading;
}

std::string plain_text(const Json& value) {
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

ResultFile read_check(const Json& root, const Place& place) {
  ResultFile file;
  const std::string verdict = text_at(root, "verdict", place);
  if (verdict != "sound" && verdict != "faulty")
    place.fail(fmt::format("has the verdict \"{}\", which is neither \"sound\" nor \"faulty\"; write it anew",
                           one_line(verdict, 80)));
  file.verdicts.push_back(text_reading("verdict", verdict));
  file.verdicts.back().rank = verdict == "sound" ? 0 : 1;

  const Json& meshes = array_at(root, "meshes", place);
  const Place mesh_place{place.file, "one of \"meshes\""};
  const MeshNames names(meshes, mesh_place);
  Json whole = Json::object();
  for (const auto& [key, value] : root.items()) {
    // The headline is the verdict and the counts again, in words.
    if (key != "schema" && key != "verdict" && key != "headline") {
      whole[key] = value.is_array() ? Json::array() : value;
    }
  }
  Subject& all = file.subjects.emplace_back();
  walk(whole, "", "", all, file.settings, place);
  file.counts_by_code = whole.contains("findings_by_code") && whole["findings_by_code"].is_object();
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    Subject subject;
    subject.id = names[m];
    Json figures = meshes[m];
    figures.erase("file");
    walk(figures, "", subject.id + ": ", subject, file.settings, mesh_place);
    file.subjects.push_back(std::move(subject));
  }
  if (root.contains("seams")) {
    const Place here{place.file, "one of \"seams\""};
    for (const Json& seam : array_at(root, "seams", place)) {
      Subject subject;
      if (!seam.is_object()) here.fail("is no object; write the file anew");
      subject.id = names.named(seam, "mesh", here) + " | " + names.named(seam, "other_mesh", here);
      Json figures = seam;
      for (const char* key : {"mesh", "other_mesh", "state"}) figures.erase(key);
      if (seam.contains("state")) {
        Reading state = text_reading("state", text_at(seam, "state", here));
        const auto* known = std::ranges::find_if(
            kSeamStates, [&](std::string_view name) { return state.text.starts_with(name); });
        if (known != kSeamStates.end()) state.rank = static_cast<int>(known - kSeamStates.begin());
        subject.readings.push_back(std::move(state));
      }
      walk(figures, "", subject.id + ": ", subject, file.settings, here);
      file.subjects.push_back(std::move(subject));
    }
  }
  const Json& findings = array_at(root, "findings", place);
  const Place here{place.file, "one of \"findings\""};
  for (const Json& finding : findings) {
    if (!finding.is_object()) here.fail("is no object; write the file anew");
    file.findings.push_back(read_finding(finding, names, here));
  }
  if (const auto total = root.find("findings_total"); total != root.end() && total->is_number())
    file.findings_complete = total->get<double>() <= static_cast<double>(findings.size());
  return file;
}

}  // namespace plumbline::compare
