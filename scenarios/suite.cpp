// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/suite.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/expected_file.h"
#include "scenarios/gate_reader.h"
#include "scenarios/nearest.h"
#include "scenarios/source_reader.h"
#include "scenarios/toml_reader.h"

namespace plumbline {
namespace {

constexpr std::size_t kLongestId = 64;  // four of them and a folder must fit a file name
constexpr std::size_t kMostRuns = 100'000;
constexpr double kLargestThresholdPx = 1e6;

std::string read_id(const TomlTable& table, bool with_variant) {
  const TomlValue& value = table.at("id");
  const std::string& id = value.text();
  const auto allowed = [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-' || (with_variant && c == ':');
  };
  if (id.empty() || id.size() > kLongestId || !std::all_of(id.begin(), id.end(), allowed)) {
    value.fail(fmt::format("is \"{}\"; use 1 to {} of the characters A-Z a-z 0-9 _ . -{}", one_line(id, 80),
                           kLongestId, with_variant ? " :" : ""));
  }
  return id;
}

// Looked up in sets, here and below: a file may name a hundred thousand.
void refuse_second(const TomlTable& table, std::set<std::string>& taken, const std::string& id) {
  if (!taken.insert(id).second) table.at("id").fail(fmt::format("repeats \"{}\"; give each its own id", id));
}

MethodSpec read_method(const TomlTable& table) {
  table.allow_only({"id", "thresholds_px", "options", "subjects", "trajectories"});
  MethodSpec method;
  method.id = read_id(table, true);
  const TomlValue& thresholds = table.at("thresholds_px");
  std::set<double> taken;
  for (const TomlValue& element : thresholds.array()) {
    const double threshold_px = element.positive();
    if (threshold_px > kLargestThresholdPx)
      element.fail(fmt::format("is {}; give at most 1e6 pixels", threshold_px));
    if (!taken.insert(threshold_px).second) {
      element.fail(fmt::format("repeats {}; name each threshold once", threshold_px));
    }
    method.thresholds_px.push_back(threshold_px);
  }
  if (method.thresholds_px.empty()) thresholds.fail("is empty; give at least one number above 0");
  if (const TomlValue* options = table.find("options")) {
    for (const auto& [key, value] : options->table().entries()) {
      if (value.is_boolean()) {
        method.options[key] = value.boolean();
      } else if (value.is_number()) {
        method.options[key] = value.number();
      } else {
        method.options[key] = value.text();
      }
    }
  }
  return method;
}

// The ids that `key` lists: each one of `known`.
std::vector<std::string> read_chosen(const TomlTable& table, const char* key,
                                     const std::set<std::string>& known) {
  std::vector<std::string> chosen;
  const TomlValue* value = table.find(key);
  if (value == nullptr) return chosen;
  for (const TomlValue& element : value->array()) {
    const std::string& id = element.text();
    if (known.count(id) == 0) {
      element.fail(fmt::format("names \"{}\", which the suite does not have; did you mean \"{}\"?",
                               one_line(id, 80), nearest_name(id, {known.begin(), known.end()})));
    }
    chosen.push_back(id);
  }
  if (chosen.empty()) value->fail("is empty; name at least one, or leave it out for all");
  return chosen;
}

// Ids may hold dots, and a run's id joins four of them with dots: two runs must not come to share one.
void refuse_equal_run_ids(const Suite& suite, const TomlTable& file) {
  std::size_t thresholds = 0;
  for (const MethodSpec& method : suite.methods) thresholds += method.thresholds_px.size();
  const auto flown_around = [&](Subject subject) {
    return static_cast<std::size_t>(
        std::count_if(suite.trajectories.begin(), suite.trajectories.end(),
                      [&](const TrajectorySpec& trajectory) { return trajectory.around == subject; }));
  };
  const std::size_t flights = suite.terrains.size() * flown_around(Subject::terrain) +
                              suite.meshes.size() * flown_around(Subject::mesh);
  const std::size_t runs = flights * thresholds;
  if (runs > kMostRuns) file.fail(fmt::format("the suite asks for {} runs; keep to {}", runs, kMostRuns));
  std::set<std::string> ids;
  const auto take = [&](const std::string& subject_id, Subject subject) {
    for (const TrajectorySpec& trajectory : suite.trajectories) {
      if (trajectory.around != subject) continue;
      for (const MethodSpec& method : suite.methods) {
        for (const double threshold_px : method.thresholds_px) {
          const std::string id = run_id(subject_id, trajectory.id, method.id, threshold_px);
          if (!ids.insert(id).second) {
            file.fail(fmt::format("two runs would be called \"{}\"; leave dots out of the ids", id));
          }
        }
      }
    }
  };
  for (const TerrainSource& terrain : suite.terrains) take(terrain.id, Subject::terrain);
  for (const MeshSource& mesh : suite.meshes) take(mesh.id, Subject::mesh);
}

// Every subject is flown around, and every trajectory has something to fly around: nothing is left out
// silently.
void refuse_idle(const Suite& suite, const TomlTable& file) {
  const auto flown = [&](Subject subject) {
    return std::any_of(suite.trajectories.begin(), suite.trajectories.end(),
                       [&](const TrajectorySpec& trajectory) { return trajectory.around == subject; });
  };
  if (!suite.terrains.empty() && !flown(Subject::terrain))
    file.fail("no trajectory flies over the terrains; add a [[trajectory]] with around = \"terrain\"");
  if (!suite.meshes.empty() && !flown(Subject::mesh))
    file.fail("no trajectory flies around the meshes; add a [[trajectory]] with around = \"mesh\"");
  for (const TrajectorySpec& trajectory : suite.trajectories) {
    const bool mesh = trajectory.around == Subject::mesh;
    if (mesh ? suite.meshes.empty() : suite.terrains.empty()) {
      file.fail(fmt::format("trajectory '{}' flies around a {}, and the suite has none; add a [[{}]]",
                            trajectory.id, mesh ? "mesh" : "terrain", mesh ? "mesh" : "terrain"));
    }
  }
}

Suite read_suite(const TomlTable& file, const std::filesystem::path& path) {
  file.allow_only({"suite", "terrain", "mesh", "trajectory", "method", "gate"});
  Suite suite;
  suite.path = path;

  const TomlTable& head = file.at("suite").table();
  head.allow_only({"name", "viewport", "fov_y_deg", "yardstick", "slack_every"});
  suite.name = head.at("name").text();
  if (suite.name.empty() || suite.name.size() > 200 || one_line(suite.name) != suite.name) {
    head.at("name").fail("must be 1 to 200 bytes on one line; shorten it");
  }
  if (const TomlValue* viewport = head.find("viewport")) {
    const auto& sides = viewport->array();
    if (sides.size() != 2)
      viewport->fail(fmt::format("has {} elements; give [width, height] in pixels", sides.size()));
    suite.width_px = static_cast<int>(sides[0].integer_in(1, 16384));
    suite.height_px = static_cast<int>(sides[1].integer_in(1, 16384));
  }
  if (const TomlValue* fov = head.find("fov_y_deg")) {
    suite.fov_y_deg = fov->positive();
    if (!(suite.fov_y_deg < 180)) fov->fail(fmt::format("is {}; give degrees below 180", suite.fov_y_deg));
  }

  if (const TomlValue* yardstick = head.find("yardstick")) suite.yardstick = yardstick->text();
  suite.slack_every = static_cast<int>(head.integer_or("slack_every", 1, kMostFrames, suite.slack_every));

  std::set<std::string> subjects, flights, methods;  // the ids of each
  for (const TomlTable* table : file.tables("terrain")) {
    const std::string id = read_id(*table, false);
    refuse_second(*table, subjects, id);
    suite.terrains.push_back(read_terrain_source(*table, path.parent_path()));
  }
  for (const TomlTable* table : file.tables("mesh")) {
    const std::string id = read_id(*table, false);
    refuse_second(*table, subjects, id);
    suite.meshes.push_back(read_mesh_source(*table, path.parent_path()));
  }
  const bool meshes_only = suite.terrains.empty() && !suite.meshes.empty();
  const Subject around = meshes_only ? Subject::mesh : Subject::terrain;
  for (const TomlTable* table : file.tables("trajectory")) {
    const std::string id = read_id(*table, false);
    refuse_second(*table, flights, id);
    suite.trajectories.push_back(read_trajectory(*table, around));
  }
  for (const TomlTable* table : file.tables("method")) {
    MethodSpec method = read_method(*table);
    method.subjects = read_chosen(*table, "subjects", subjects);
    method.trajectories = read_chosen(*table, "trajectories", flights);
    refuse_second(*table, methods, method.id);
    suite.methods.push_back(std::move(method));
  }
  if (const TomlValue* yardstick = head.find("yardstick");
      yardstick != nullptr && methods.count(suite.yardstick) == 0) {
    yardstick->fail(fmt::format(
        "is \"{}\", which is no [[method]] of the suite; did you mean \"{}\"?", one_line(suite.yardstick, 80),
        nearest_name(suite.yardstick, std::vector<std::string>(methods.begin(), methods.end()))));
  }
  if (suite.terrains.empty() && suite.meshes.empty())
    file.fail("the suite has no terrain; add a [[terrain]], or a [[mesh]]");
  if (suite.trajectories.empty()) file.fail("the suite has no trajectory; add a [[trajectory]]");
  if (suite.methods.empty()) file.fail("the suite has no method; add a [[method]]");
  refuse_idle(suite, file);
  refuse_equal_run_ids(suite, file);

  if (const TomlValue* gate = file.find("gate")) {
    suite.gates = read_gates(gate->table(), methods);
    if (const TomlValue* expected = gate->table().find(kExpectedKey))
      suite.expected = read_expected(path.parent_path() / expected->text(), suite);
  }
  return suite;
}

}  // namespace

std::string run_id(const std::string& subject, const std::string& trajectory, const std::string& method,
                   double threshold_px) {
  std::string name = method;
  std::replace(name.begin(), name.end(), ':', '-');
  return fmt::format("{}.{}.{}.{}", subject, trajectory, name, threshold_px);
}

Suite load_suite(const std::filesystem::path& path) { return read_suite(read_toml(path), path); }

Suite parse_suite(std::string_view text, const std::filesystem::path& path) {
  return read_suite(parse_toml(text, path.string()), path);
}

}  // namespace plumbline
