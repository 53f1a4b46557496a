// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace plumbline {

/// One octave of gradient noise (Perlin, "Improving Noise", SIGGRAPH 2002: quintic fade) over a size × size
/// grid, evaluated a row at a time: gradients of the two lattice rows around it are kept, so that sampling
/// costs no hashing. Each octave's lattice is shifted by a seeded part of a cell, or the zeros at lattice
/// points would coincide.
class NoiseOctave {
 public:
  /// `cells`: lattice cells across the grid, > 0. `number`: of the octave, a stream of the seed.
  NoiseOctave(std::uint64_t seed, int number, int size, double cells);

  /// Noise of row j, roughly in [-1, 1], mean 0, into `out` (size values).
  void row(int j, std::vector<double>& out);

 private:
  struct Gradient {
    double x, y;
  };
  void fill(std::vector<Gradient>& gradients, std::int64_t lattice_row) const;

  // A sample's place in its lattice cell; the same for every row.
  struct Column {
    std::int32_t cell;
    double s, fade;
  };
  std::uint64_t seed_;
  double cells_per_sample_;
  double offset_y_;
  std::vector<Column> columns_;
  std::int64_t lattice_row_ = -1;  // lattice coordinates are never negative
  std::vector<Gradient> below_, above_;
};

/// The octaves from `cells` cells across down to two samples a cell (at least one octave), each twice as
/// fine.
std::vector<NoiseOctave> noise_octaves(std::uint64_t seed, int size, double cells);

}  // namespace plumbline
