// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/compare/result_file.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "properties/compare/check_file.h"
#include "properties/compare/json_reader.h"
#include "properties/verdict/verdict.h"
#include "scenarios/error.h"
#include "scenarios/nearest.h"

namespace plumbline::compare {
namespace {

constexpr std::uintmax_t kLargestFileBytes = std::uintmax_t{512} << 20;

/// Figures in pixels that count pixels.
constexpr std::array<std::string_view, 2> kPixelCounts{"displacement_px.uncovered_px",
                                                       "silhouette_px.pixels"};

bool counts_things(const verdict::Figure& figure) {
  return figure.unit == "count" || figure.unit == "frames" ||
         std::ranges::find(kPixelCounts, figure.path) != kPixelCounts.end();
}

/// What a figure's path names in a summary; null if the file does not have it.
const Json* find_figure(const Json& summary, std::string_view path) {
  const std::size_t dot = path.find('.');
  const std::string group(dot == std::string_view::npos ? std::string_view("conformity")
                                                        : path.substr(0, dot));
  if (const auto found = summary.find(group); found != summary.end() && found->is_object()) {
    const std::string member(dot == std::string_view::npos ? path : path.substr(dot + 1));
    if (const auto inner = found->find(member); inner != found->end()) return &*inner;
  }
  const auto alone = summary.find(std::string(path));
  return dot == std::string_view::npos && alone != summary.end() ? &*alone : nullptr;
}

Subject read_run(const Json& run, const Place& place) {
  Subject subject;
  subject.id = text_at(run, "id", place);
  const Place here{place.file, fmt::format("run \"{}\"", one_line(subject.id, 120))};
  const Json& summary = object_at(run, "summary", here);
  for (const verdict::Figure& figure : verdict::figures()) {
    const Json* value = find_figure(summary, figure.path);
    if (value == nullptr) continue;
    Reading reading = read_number(*value, std::string(figure.path), here);
    reading.direction = verdict::figure_direction(figure.path);
    reading.counted = counts_things(figure);
    subject.readings.push_back(std::move(reading));
  }
  if (subject.readings.empty()) here.fail("has no figure in its summary; write the file anew");
  if (const Json* frames = find_figure(summary, "frames")) {
    Reading reading = read_number(*frames, "frames", here);
    reading.counted = true;
    subject.readings.push_back(std::move(reading));
  }
  if (const auto frames = run.find("frames"); frames != run.end() && frames->is_number_unsigned())
    subject.frames = frames->get<std::uint64_t>();
  return subject;
}

GateReading read_gate(const Json& gate, const Place& place) {
  return {text_at(gate, "run", place), text_at(gate, "name", place), text_at(gate, "limit", place),
          truth_at(gate, "pass", place)};
}

Reading verdict_reading(std::string path, bool good, const char* when_good, const char* when_bad) {
  Reading reading = text_reading(std::move(path), good ? when_good : when_bad);
  reading.rank = good ? 0 : 1;
  return reading;
}

ResultFile read_results(const Json& root, const Place& place) {
  ResultFile file;
  file.verdicts.push_back(verdict_reading("verdict", truth_at(root, "pass", place), "pass", "fail"));
  if (root.contains("interrupted"))
    file.verdicts.push_back(
        verdict_reading("finished", !truth_at(root, "interrupted", place), "finished", "interrupted"));
  if (root.contains("selftest"))
    file.verdicts.push_back(verdict_reading("the oracles' own test",
                                            truth_at(object_at(root, "selftest", place), "pass", place),
                                            "pass", "fail"));
  for (const char* key : {"suite", "yardstick", "viewport", "fov_y_deg"}) {
    if (const auto value = root.find(key); value != root.end())
      file.settings.push_back(text_reading(key, plain_text(*value)));
  }
  for (const char* key : {"terrains", "meshes"}) {
    if (!root.contains(key)) continue;
    for (const Json& ground : array_at(root, key, place)) {
      const Place here{place.file, fmt::format("one of \"{}\"", key)};
      const std::string id = text_at(ground, "id", here);
      for (const auto& [fact, value] : ground.items())
        file.settings.push_back(text_reading(fmt::format("{} of {}", fact, id), plain_text(value)));
    }
  }
  std::set<std::string> ids;
  for (const Json& run : array_at(root, "runs", place)) {
    file.subjects.push_back(read_run(run, Place{place.file, "one of \"runs\""}));
    const std::string& id = file.subjects.back().id;
    if (!ids.insert(id).second)
      place.fail(fmt::format("has two runs called \"{}\"; write it anew", one_line(id, 120)));
  }
  for (const Json& gate : array_at(root, "gates", place))
    file.gates.push_back(read_gate(gate, Place{place.file, "one of \"gates\""}));
  if (root.contains("vacuous")) {
    for (const Json& line : array_at(root, "vacuous", place)) {
      if (!line.is_string()) place.fail("\"vacuous\" holds something other than strings; write it anew");
      file.vacuous.push_back(line.get<std::string>());
    }
  }
  return file;
}

}  // namespace

ResultFile parse_result(std::string_view text, const std::string& name) {
  const Json root = read_json(text, name);
  const Place place{one_line(name), ""};
  if (!root.is_object() || !root.contains("schema"))
    place.fail("has no \"schema\"; give a results.json, or what plumbline check --json wrote");
  const std::string schema = text_at(root, "schema", place);
  ResultFile file;
  if (schema == kResultsSchema) {
    file = read_results(root, place);
  } else if (schema == kCheckSchema) {
    file = read_check(root, place);
  } else {
    place.fail(fmt::format("has the schema \"{}\"; give a file of \"{}\" or \"{}\"", one_line(schema, 80),
                           kResultsSchema, kCheckSchema));
  }
  file.name = name;
  file.schema = schema;
  return file;
}

ResultFile read_result_file(const std::filesystem::path& path) {
  const Place place{one_line(path.string()), ""};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) place.fail("no such file; check the path");
  if (!std::filesystem::is_regular_file(status)) place.fail("not a regular file; give a result file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) place.fail(fmt::format("cannot be read: {}", error.message()));
  if (size > kLargestFileBytes) place.fail("larger than 512 MiB; compare suites of fewer runs");
  std::ifstream stream(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(size)))
    place.fail("cannot be read; check its permissions");
  return parse_result(text, path.string());
}

}  // namespace plumbline::compare
