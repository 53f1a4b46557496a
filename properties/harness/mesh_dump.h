// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "scenarios/mesh.h"

namespace plumbline {

/// A mesh as binary little-endian PLY: double x, y, z; int indices (CONTRACT "Output folder"). Exact to the
/// bit.
std::string to_ply(const Mesh& mesh);

/// Writes `<folder>/<run>/<frame>.ply`, frame as five digits.
void dump_mesh(const std::filesystem::path& folder, const std::string& run, int frame, const Mesh& mesh);

}  // namespace plumbline
