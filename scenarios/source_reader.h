// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "scenarios/mesh_source.h"
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

/// Reads a `[[mesh]]`: id, exactly one of file, generator, and at (places of copies), scale; relative paths
/// start at `folder`. Throws InputError for any other key, a wrong type or range.
MeshSource read_mesh_source(const TomlTable& table, const std::filesystem::path& folder);

/// Reads a `[[trajectory]]`: id, kind, around ("terrain", "mesh"; absent: `around`), and the keys that the
/// kind takes there (trajectory_kinds(), trajectory_kinds_around_mesh()).
TrajectorySpec read_trajectory(const TomlTable& table, Subject around = Subject::terrain);

/// Reads an array of `{ position = [x,y,z], look_at = [x,y,z] }`, metres.
std::vector<CameraPose> read_poses(const TomlValue& value);

}  // namespace plumbline
