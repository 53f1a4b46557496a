// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scenarios/mesh_source.h"
#include "scenarios/terrain_source.h"
#include "scenarios/trajectory.h"

namespace plumbline {

/// A method's option as the suite file gives it.
using OptionValue = std::variant<bool, double, std::string>;
using Options = std::map<std::string, OptionValue>;  // ordered: options are printed

/// One `[[method]]`: `id` may carry a variant ("block_bintree:tri_cull").
struct MethodSpec {
  std::string id;
  std::vector<double> thresholds_px;  ///< each > 0
  Options options;
  std::vector<std::string> subjects{};      ///< terrains and meshes it flies over; empty: all that it takes
  std::vector<std::string> trajectories{};  ///< flights it takes part in; empty: all
  friend bool operator==(const MethodSpec&, const MethodSpec&) = default;
};

/// One limit of `[gate]`: the figure's path in a run's summary ("crack", "displacement_px.p99") against a
/// bound.
struct GateSpec {
  std::string figure;
  std::string method;      ///< empty: every method
  std::string comparison;  ///< "<=", "<", "==", ">=", ">"
  double bound = 0;
  bool times_tau = false;  ///< bound is a multiple of the run's threshold
  std::string text;        ///< as written, for reports: "displacement_px.p99 <= 1 tau"
  friend bool operator==(const GateSpec&, const GateSpec&) = default;
};

/// A suite file, read and checked.
struct Suite {
  std::string name;
  std::filesystem::path path;  ///< where it was read from; not part of any result
  int width_px = 1280;
  int height_px = 720;
  double fov_y_deg = 60;
  /// The method that says how many triangles a scene needs; without a run of it nothing is said.
  std::string yardstick = "greedy_tin";
  int slack_every = 4;                  ///< slack is measured in frames 0, this, twice this, …
  std::vector<TerrainSource> terrains;  ///< terrains or meshes may be absent, not both
  std::vector<MeshSource> meshes;
  std::vector<TrajectorySpec> trajectories;
  std::vector<MethodSpec> methods;
  std::vector<GateSpec> gates;
  friend bool operator==(const Suite&, const Suite&) = default;
};

/// Reads a suite file (TOML, CONTRACT "Suite file"). Throws InputError naming file, line and the nearest
/// known key for an unknown key, a wrong type, a duplicate id, a threshold that is not positive and finite,
/// an empty list.
Suite load_suite(const std::filesystem::path& path);
/// The same from memory; `path` stands for the file in complaints, and paths inside are relative to it.
Suite parse_suite(std::string_view text, const std::filesystem::path& path);

}  // namespace plumbline
