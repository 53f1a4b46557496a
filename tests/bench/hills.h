// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "scenarios/random.h"
#include "scenarios/terrain.h"

namespace plumbline::bench {

/// Samples a side: 2 097 152 triangles as a full mesh.
inline constexpr int kSide = 1025;

/// Hills of several sizes with a little noise: integer lattice noise, bilinear.
inline Terrain hills() {
  Terrain terrain;
  terrain.columns = terrain.rows = kSide;
  terrain.spacing_m = 1;
  terrain.heights_m.resize(static_cast<std::size_t>(kSide) * kSide);
  const auto noise = [](std::uint64_t octave, int i, int j) {
    return static_cast<double>(lattice_hash(octave, i, j) >> 11) * 0x1p-53;
  };
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      double z = 0;
      for (int cell = 256; cell >= 1; cell /= 2) {
        const int a = i / cell, b = j / cell;
        const double u = static_cast<double>(i % cell) / cell, v = static_cast<double>(j % cell) / cell;
        const auto octave = static_cast<std::uint64_t>(cell);
        const double low = noise(octave, a, b) * (1 - u) + noise(octave, a + 1, b) * u;
        const double high = noise(octave, a, b + 1) * (1 - u) + noise(octave, a + 1, b + 1) * u;
        z += cell * 0.4 * (low * (1 - v) + high * v);
      }
      terrain.heights_m[terrain.index(i, j)] = z;
    }
  }
  return terrain;
}

}  // namespace plumbline::bench
