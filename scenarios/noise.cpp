// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/noise.h"

#include <cmath>
#include <utility>

#include "scenarios/random.h"

namespace plumbline {
namespace {

// 6t⁵ − 15t⁴ + 10t³: first and second derivative vanish at 0 and 1.
double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// [-1, 1), a multiple of 2⁻³¹, from half a hash.
double signed_unit(std::uint32_t bits) { return static_cast<double>(bits) * 0x1p-31 - 1; }

}  // namespace

NoiseOctave::NoiseOctave(std::uint64_t seed, int number, int size, double cells)
    : cells_per_sample_(cells / (size - 1)) {
  Random random(seed, "noise");
  for (int skip = 0; skip < number; ++skip) random.bits();
  seed_ = random.bits();
  Random shifts(seed_);
  const double offset_x = shifts.unit();
  offset_y_ = shifts.unit();
  columns_.reserve(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) {
    const double u = i * cells_per_sample_ + offset_x;
    const double cell = std::floor(u);
    columns_.push_back({static_cast<std::int32_t>(cell), u - cell, fade(u - cell)});
  }
  below_.resize(static_cast<std::size_t>(columns_.back().cell) + 2);
  above_.resize(below_.size());
}

void NoiseOctave::fill(std::vector<Gradient>& gradients, std::int64_t lattice_row) const {
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    const std::uint64_t hash = lattice_hash(seed_, static_cast<std::int64_t>(i), lattice_row);
    gradients[i] = {signed_unit(static_cast<std::uint32_t>(hash)),
                    signed_unit(static_cast<std::uint32_t>(hash >> 32))};
  }
}

void NoiseOctave::row(int j, std::vector<double>& out) {
  const double v = j * cells_per_sample_ + offset_y_;
  const double cell = std::floor(v);
  const auto lattice_row = static_cast<std::int64_t>(cell);
  if (lattice_row != lattice_row_) {
    if (lattice_row == lattice_row_ + 1 && lattice_row_ >= 0) {
      std::swap(below_, above_);
    } else {
      fill(below_, lattice_row);
    }
    fill(above_, lattice_row + 1);
    lattice_row_ = lattice_row;
  }
  const double t = v - cell;
  const double fade_t = fade(t);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    const auto k = static_cast<std::size_t>(column.cell);
    const double s = column.s;
    const double n00 = below_[k].x * s + below_[k].y * t;
    const double n10 = below_[k + 1].x * (s - 1) + below_[k + 1].y * t;
    const double n01 = above_[k].x * s + above_[k].y * (t - 1);
    const double n11 = above_[k + 1].x * (s - 1) + above_[k + 1].y * (t - 1);
    const double south = n00 + column.fade * (n10 - n00);
    const double north = n01 + column.fade * (n11 - n01);
    out[i] = south + fade_t * (north - south);
  }
}

std::vector<NoiseOctave> noise_octaves(std::uint64_t seed, int size, double cells) {
  std::vector<NoiseOctave> octaves;
  for (double c = cells; octaves.empty() || 2 * c <= size - 1; c *= 2) {
    octaves.emplace_back(seed, static_cast<int>(octaves.size()), size, c);
  }
  return octaves;
}

}  // namespace plumbline
