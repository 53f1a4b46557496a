// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "properties/faults/sound_meshes.h"

namespace plumbline::faults {

/// One use of an edge that two meshes share.
struct SeamEdge {
  std::array<Vec3, 2> at;               ///< its ends, the first mesh to its left
  std::uint32_t first = 0, second = 0;  ///< triangles of the two meshes
};

/// A sound mesh cut in two along edges: each half has vertices of its own.
struct Halves {
  Mesh first, second;
  std::vector<SeamEdge> seam;
};

/// Cuts beside a random line, which may leave either half in several parts. Nothing if one half is empty.
std::optional<Halves> cut_in_two(const Surface& surface, Random& random);

}  // namespace plumbline::faults
