// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "scenarios/terrain_source.h"
#include "scenarios/toml_reader.h"
#include "scenarios/trajectory.h"

namespace plumbline {

/// Reads a `[[terrain]]` (of a suite) or `[terrain]` (of a case file): id, exactly one of file, generator,
/// samples, and the keys that apply to it:
///   file: size ("native" or samples a side), fit, holes, spacing_m, z_scale; relative paths start at
///   `folder` generator: seed, size, spacing_m, relief_m, z_scale samples: rows from the south, each an array
///   of equal length; size, fit, spacing_m, z_scale
/// Throws InputError for any other key, a wrong type or range.
TerrainSource read_terrain_source(const TomlTable& table, const std::filesystem::path& folder);

/// Reads a `[[trajectory]]`: id, kind, and the keys that the kind takes (trajectory_kinds()).
TrajectorySpec read_trajectory(const TomlTable& table);

/// Reads an array of `{ position = [x,y,z], look_at = [x,y,z] }`, metres.
std::vector<CameraPose> read_poses(const TomlValue& value);

}  // namespace plumbline
