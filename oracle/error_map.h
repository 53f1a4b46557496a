// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "scenarios/mesh.h"
#include "scenarios/raster.h"
#include "scenarios/terrain.h"

namespace plumbline::oracle {

/// A picture of z_mesh − z_terrain. Sampled at the pixels' centres: to look at, not to judge by; figures come
/// from vertical_error.
struct ErrorMap {
  Raster error_m;  ///< rows from the north; NaN where nothing is judged
  Vec2 low, high;  ///< what it covers, metres in the terrain's local frame
};

/// Covers the box that mesh and terrain have in common, `longest_px` pixels along its longer side, pixels
/// square where a sample's step is `step` wide and high (any unit; {1, 1}: as the terrain says). Where
/// triangles overlap the error of the greatest size is shown (of equals the positive one), so that their
/// order does not matter. Skipped are the triangles that vertical_error skips. Empty if there is nothing in
/// common. `has_data`: as for vertical_error_where_data. Requires: longest_px > 0.
///
/// Time: linear in triangles + pixels covered.
ErrorMap vertical_error_map(const Mesh& mesh, const Terrain& terrain, std::span<const std::uint8_t> has_data,
                            int longest_px, Vec2 step = {1, 1});

}  // namespace plumbline::oracle
