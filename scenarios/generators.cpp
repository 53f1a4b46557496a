// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/generators.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/nearest.h"
#include "scenarios/noise.h"
#include "scenarios/portable_math.h"
#include "scenarios/random.h"

namespace plumbline {
namespace {

// What a generator fills: heights in metres, or, where it says so, any range, which `stretch` then fits to
// the relief.
struct Canvas {
  Terrain& terrain;
  std::uint64_t seed;
  double relief_m;

  [[nodiscard]] int size() const { return terrain.columns; }
  double& z(int i, int j) { return terrain.heights_m[terrain.index(i, j)]; }

  /// Maps the range of heights linearly onto [0, relief].
  void stretch() {
    const double low = terrain.lowest_m();
    const double range = terrain.highest_m() - low;
    for (double& height : terrain.heights_m) height = range > 0 ? (height - low) / range * relief_m : 0;
  }
};

constexpr double kGain = 0.5;         // amplitude from octave to octave: all are equally steep
constexpr double kCellsAcross = 2.5;  // of the broadest octave

double smooth_step(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

void plane(Canvas& canvas) {
  std::fill(canvas.terrain.heights_m.begin(), canvas.terrain.heights_m.end(), 0.0);
}

// Rises two parts east to one part north. Slopes are multiples of 2⁻²⁰ m a sample, so every height is exact
// and the samples lie exactly in one plane.
void tilted_plane(Canvas& canvas) {
  const double step_m = std::floor(canvas.relief_m / (3.0 * (canvas.size() - 1)) * 0x1p20) * 0x1p-20;
  for (int j = 0; j < canvas.size(); ++j) {
    for (int i = 0; i < canvas.size(); ++i) canvas.z(i, j) = (2 * i + j) * step_m;
  }
}

// From west to east: a plain, a step of half the relief within one cell, a terrace, a ramp of the other half.
// North of the middle the step runs diagonally, along and across the cells' diagonals.
void cliff(Canvas& canvas) {
  const int n = canvas.size() - 1;
  for (int j = 0; j <= n; ++j) {
    const int edge = n / 4 + std::max(0, j - n / 2) / 2;
    for (int i = 0; i <= n; ++i) {
      const double ramp = std::clamp((static_cast<double>(i) / n - 0.6) / 0.25, 0.0, 1.0);
      canvas.z(i, j) = canvas.relief_m / 2 * ((i > edge ? 1 : 0) + ramp);
    }
  }
}

// Four waves across each way.
void sine(Canvas& canvas) {
  const int n = canvas.size() - 1;
  std::vector<double> wave;
  for (int i = 0; i <= n; ++i) wave.push_back(exact_sin(8 * kPi * i / n));
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const auto u = static_cast<std::size_t>(i);
      const auto v = static_cast<std::size_t>(j);
      canvas.z(i, j) = canvas.relief_m / 2 * (1 + wave[u] * wave[v]);
    }
  }
}

// Sum of octaves, each half as broad and kGain as high (Mandelbrot's fractional Brownian surface by noise
// synthesis: Musgrave, Kolb & Mace, SIGGRAPH 1989).
void sum_octaves(Canvas& canvas) {
  const int size = canvas.size();
  std::vector<double> noise(static_cast<std::size_t>(size));
  double amplitude = 1;
  for (NoiseOctave& octave : noise_octaves(canvas.seed, size, kCellsAcross)) {
    for (int j = 0; j < size; ++j) {
      octave.row(j, noise);
      double* row = &canvas.z(0, j);
      for (int i = 0; i < size; ++i) row[i] += amplitude * noise[static_cast<std::size_t>(i)];
    }
    amplitude *= kGain;
  }
}

void fbm(Canvas& canvas) {
  sum_octaves(canvas);
  canvas.stretch();
}

// Ridged multifractal (Musgrave, in Ebert et al., Texturing & Modeling, 1994): noise folded at 0 makes
// crests, and an octave counts as much as the crest below it is high, so that valleys stay smooth.
void ridged(Canvas& canvas) {
  const int size = canvas.size();
  const auto width = static_cast<std::size_t>(size);
  std::vector<NoiseOctave> octaves = noise_octaves(canvas.seed, size, kCellsAcross);
  std::vector<double> noise(width), weight(width);
  for (int j = 0; j < size; ++j) {
    std::fill(weight.begin(), weight.end(), 1.0);
    double amplitude = 1;
    for (NoiseOctave& octave : octaves) {
      octave.row(j, noise);
      double* row = &canvas.z(0, j);
      for (std::size_t i = 0; i < width; ++i) {
        const double crest = std::max(0.0, 1 - 1.5 * std::fabs(noise[i]));
        const double signal = crest * crest * weight[i];
        row[i] += amplitude * signal;
        weight[i] = std::min(1.0, 2 * signal);
      }
      amplitude *= kGain;
    }
  }
  canvas.stretch();
}

// A rough plateau with a meandering valley of two steep walls and a terrace between them.
void canyon(Canvas& canvas) {
  sum_octaves(canvas);
  canvas.stretch();
  const int size = canvas.size();
  const double n = size - 1;
  std::vector<double> meander(static_cast<std::size_t>(size));
  NoiseOctave(canvas.seed, 63, size, 3).row(0, meander);  // octave numbers of the plateau stay below 15
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const double river = n * (0.5 + 0.3 * meander[static_cast<std::size_t>(i)]);
      const double aside = std::fabs(j - river) / n;  // share of the extent
      const double wall = 0.5 * smooth_step((aside - 0.02) / 0.02) + 0.5 * smooth_step((aside - 0.08) / 0.02);
      canvas.z(i, j) = canvas.z(i, j) * 0.25 * wall + 0.75 * canvas.relief_m * wall;
    }
  }
}

void spike(Canvas& canvas) {
  plane(canvas);
  const int middle = (canvas.size() - 1) / 2;
  canvas.z(middle, middle) = canvas.relief_m;
}

// Neighbours alternate between the lowest and the highest quarter of the relief: nothing can be left out.
void checkerboard(Canvas& canvas) {
  for (int j = 0; j < canvas.size(); ++j) {
    for (int i = 0; i < canvas.size(); ++i) {
      const double unit = static_cast<double>(lattice_hash(canvas.seed, i, j) >> 11) * 0x1p-53;
      canvas.z(i, j) = canvas.relief_m * (0.25 * unit + ((i + j) % 2 != 0 ? 0.75 : 0.0));
    }
  }
}

// Fractal relief sinking towards the border; what lies below sea level is a flat sea at exactly 0.
void island(Canvas& canvas) {
  sum_octaves(canvas);
  canvas.stretch();
  const int n = canvas.size() - 1;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double u = 2.0 * i / n - 1;
      const double v = 2.0 * j / n - 1;
      const double shore = 1 - smooth_step((u * u + v * v) / 0.9);
      canvas.z(i, j) = std::max(0.0, canvas.z(i, j) * shore - 0.12 * canvas.relief_m);
    }
  }
  canvas.stretch();
}

struct Generator {
  GeneratorDescription description;
  void (*fill)(Canvas&);
};

const std::vector<Generator>& generators() {
  static const std::vector<Generator> all{
      {{"plane", "flat, height 0 (relief_m has no effect)"}, plane},
      {{"tilted_plane", "exactly one plane, rising to the north-east"}, tilted_plane},
      {{"cliff", "plain, vertical step, terrace, ramp"}, cliff},
      {{"sine", "four waves across each way"}, sine},
      {{"fbm", "fractal mountains: gradient noise, octaves down to two samples"}, fbm},
      {{"ridged", "ridged multifractal: sharp crests, smooth valleys"}, ridged},
      {{"canyon", "a meandering valley with steep walls in a rough plateau"}, canyon},
      {{"spike", "flat but for one sample in the middle"}, spike},
      {{"checkerboard", "noise alternating from sample to sample (relief: one spacing)"}, checkerboard},
      {{"island", "fractal island in a sea of height 0"}, island},
  };
  return all;
}

}  // namespace

Terrain generate_terrain(const TerrainSource& source) {
  const auto& all = generators();
  const auto generator = std::find_if(
      all.begin(), all.end(), [&](const Generator& g) { return g.description.name == source.generator; });
  if (generator == all.end()) {
    std::vector<std::string> names;
    for (const Generator& known : all) names.push_back(known.description.name);
    throw InputError(
        fmt::format("terrain '{}': {}", source.id, unknown_name("generator", source.generator, names)));
  }
  Terrain terrain;
  terrain.columns = terrain.rows = source.size.value_or(257);
  terrain.spacing_m = source.spacing_m.value_or(30);
  const double extent_m = terrain.width_m();
  const double usual_m =
      source.generator == "checkerboard" ? terrain.spacing_m : 1000 * std::sqrt(extent_m / 7680);
  const double relief_m = source.relief_m.value_or(usual_m);
  if (!(relief_m >= 0 && relief_m <= kHighestM)) {
    throw InputError(
        fmt::format("terrain '{}': relief_m is {}; give 0 to {}", source.id, relief_m, kHighestM));
  }
  const auto side = static_cast<std::size_t>(terrain.columns);
  terrain.heights_m.assign(side * side, 0.0);
  Canvas canvas{terrain, source.seed, relief_m};
  generator->fill(canvas);
  return terrain;
}

const std::vector<GeneratorDescription>& terrain_generators() {
  static const std::vector<GeneratorDescription> descriptions = [] {
    std::vector<GeneratorDescription> list;
    for (const Generator& generator : generators()) list.push_back(generator.description);
    return list;
  }();
  return descriptions;
}

}  // namespace plumbline
