// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/terrain_source.h"

namespace plumbline {

/// The generated terrain that `source` asks for, before z_scale: size × size samples (default 257), spacing_m
/// (default 30 m), heights in [0, relief]. From integer hashes of lattice points (random.h) and plain double
/// arithmetic alone, so the same on every machine. Throws InputError for an unknown generator or a number out
/// of its range.
Terrain generate_terrain(const TerrainSource& source);

}  // namespace plumbline
