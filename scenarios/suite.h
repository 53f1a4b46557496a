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

/// One entry of an expectation file (expected_file.h): what a figure is known to be, whatever the gates ask.
struct Expectation {
  std::string run;  ///< a run's id as results name it; '*' stands for any text
  GateSpec limit;   ///< its `method` is empty: the run says it
  std::string why;  ///< the reason, for reports: "M4.S1: steep ground"
  friend bool operator==(const Expectation&, const Expectation&) = default;
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
  std::vector<Expectation> expected;  ///< each replaces the gates on its figure for its runs
  friend bool operator==(const Suite&, const Suite&) = default;
};

/// What a run is called in every result: "crags.orbit.block_bintree-repaired.8". It names folders, so it
/// holds no ':', which some file systems refuse.
std::string run_id(const std::string& subject, const std::string& trajectory, const std::string& method,
                   double threshold_px);

/// Reads a suite file (TOML, CONTRACT "Suite file"). Throws InputError naming file, line and the nearest
/// known key for an unknown key, a wrong type, a duplicate id, a threshold that is not positive and finite,
/// an empty list, and for whatever read_expected refuses in the file that `[gate] expected` names.
Suite load_suite(const std::filesystem::path& path);
/// The same from memory; `path` stands for the file in complaints, and paths inside are relative to it.
Suite parse_suite(std::string_view text, const std::filesystem::path& path);

}  // namespace plumbline
