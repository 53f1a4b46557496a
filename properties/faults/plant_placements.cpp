// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that lie wrongly over their terrain: samples of rough ground, all moved as a wrong program moves
// them. Heights are eighths of a metre, and steps are ten metres, so that what is put right again is exact
// but for a rounding.
#include <cmath>
#include <functional>

#include "properties/faults/measured_faults.h"
#include "properties/faults/sound_meshes.h"

namespace plumbline::faults {
namespace {

using oracle::Misplacement;
using Kind = oracle::MisplacementKind;

constexpr double kStep_m = 10, kRelief_m = 64;
constexpr std::size_t kVertices = 200;

/// What was done to the mesh, and what has to be said of it.
struct Fault {
  std::function<Vec3(Vec3)> done;
  Kind kind;
  std::function<bool(const Misplacement&)> remedy = [](const Misplacement&) { return true; };
};

using MakeFault = Fault (*)(const Terrain&, Random&);

std::vector<Vec3> samples(const Terrain& terrain, Random& random) {
  std::vector<Vec3> out;
  const auto side = static_cast<std::uint64_t>(terrain.columns);
  for (std::size_t k = 0; k < kVertices; ++k) {
    const int i = static_cast<int>(random.below(side)), j = static_cast<int>(random.below(side));
    out.push_back({i * kStep_m, j * kStep_m, terrain.z(i, j)});
  }
  return out;
}

Terrain ground(Random& random) {
  return random_terrain(24 + static_cast<int>(random.below(24)), kStep_m, kRelief_m, random);
}

std::optional<Tally> trial(const Judges& judges, Random& random, MakeFault make) {
  const Terrain terrain = ground(random);
  std::vector<Vec3> vertices = samples(terrain, random);
  const Fault fault = make(terrain, random);
  for (Vec3& p : vertices) p = fault.done(p);
  const std::optional<Misplacement> found = judges.placement(vertices, terrain);
  if (!found) return tally(false, false, false, false, false);
  const bool rms = found->rms_m <= 1e-9 * found->given_rms_m && found->given_rms_m > 0;
  return tally(false, true, rms, found->kind == fault.kind && fault.remedy(*found), false);
}

/// One of the seven symmetries of the square, and the one that undoes it.
Fault turn(const Terrain& terrain, Random& random) {
  const double last = terrain.width_m();
  switch (random.below(7)) {
    case 0:
      return {[last](Vec3 p) { return Vec3{p.x, last - p.y, p.z}; }, Kind::rows_flipped};
    case 1:
      return {[last](Vec3 p) { return Vec3{last - p.x, p.y, p.z}; }, Kind::columns_flipped};
    case 2:
      return {[last](Vec3 p) { return Vec3{last - p.x, last - p.y, p.z}; }, Kind::rotated_180};
    case 3:
      return {[last](Vec3 p) { return Vec3{last - p.y, last - p.x, p.z}; }, Kind::transposed};
    case 4:
      return {[](Vec3 p) { return Vec3{p.y, p.x, p.z}; }, Kind::anti_transposed};
    case 5:
      return {[last](Vec3 p) { return Vec3{p.y, last - p.x, p.z}; }, Kind::rotated_90};
    default:
      return {[last](Vec3 p) { return Vec3{last - p.y, p.x, p.z}; }, Kind::rotated_270};
  }
}

Fault lift(const Terrain& /*terrain*/, Random& random) {
  const double by_m = (random.below(2) == 0 ? 1 : -1) * random.between(kRelief_m, 10 * kRelief_m);
  return {[by_m](Vec3 p) {
            return Vec3{p.x, p.y, p.z + by_m};
          },
          Kind::height_offset,
          [by_m](const Misplacement& m) { return std::fabs(m.offset_m + by_m) < 1e-9 * std::fabs(by_m); }};
}

Fault stretch_heights(const Terrain& /*terrain*/, Random& random) {
  const double factors[] = {0.3048, 1 / 0.3048, 2, 2.5, 0.25};
  const double factor = factors[random.below(5)];
  return {[factor](Vec3 p) {
            return Vec3{p.x, p.y, p.z * factor};
          },
          Kind::height_factor,
          [factor](const Misplacement& m) { return std::fabs(m.factor * factor - 1) < 1e-9; }};
}

Fault spread(const Terrain& terrain, Random& random) {
  const double n = terrain.columns, factor = random.below(2) == 0 ? n / (n - 1) : (n - 1) / n;
  return {[factor](Vec3 p) {
            return Vec3{p.x * factor, p.y * factor, p.z};
          },
          Kind::cells_for_samples,
          [factor](const Misplacement& m) { return std::fabs(m.factor * factor - 1) < 1e-9; }};
}

/// By halves of a sample; not so far that half the mesh lies beside the terrain.
Fault shift(const Terrain& /*terrain*/, Random& random) {
  Vec2 by;
  while (by == Vec2{})
    by = {static_cast<double>(random.below(13)) / 2 - 3, static_cast<double>(random.below(13)) / 2 - 3};
  return {[by](Vec3 p) {
            return Vec3{p.x + by.x * kStep_m, p.y + by.y * kStep_m, p.z};
          },
          Kind::shifted,
          [by](const Misplacement& m) {
            return m.shift == Vec2{-by.x, -by.y};
          }};
}

/// Where it belongs, each vertex off by as much as a fair simplifier errs: nothing is said.
std::optional<Tally> in_place(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  const Terrain terrain = ground(random);
  std::vector<Vec3> vertices = samples(terrain, random);
  const double error_m = random.below(2) == 0 ? 0 : random.between(0, kRelief_m);
  for (Vec3& p : vertices) p.z += random.between(-error_m, error_m);
  return tally(true, judges.placement(vertices, terrain).has_value(), false, false, false);
}

}  // namespace

std::vector<MeasuredFault> placed_faults() {
  constexpr auto kPlacement = "placement";
  const auto entry = [](std::string_view name, std::string_view what, MakeFault make) {
    return MeasuredFault{kPlacement, name, what, false,
                         [make](const Judges& judges, Random& random, const MakeSolid&) {
                           return trial(judges, random, make);
                         }};
  };
  return {
      entry("placed_turned", "one of the seven symmetries of the grid: the one that undoes it", turn),
      entry("placed_lifted", "all heights off by a constant: that constant", lift),
      entry("placed_in_feet", "all heights times a constant: its inverse", stretch_heights),
      entry("placed_cells_for_samples", "one step in n too many, or too few", spread),
      entry("placed_shifted", "by half or whole samples: back by as many", shift),
      {kPlacement, "placed_right", "where it belongs, exact or with errors of its own: nothing", true,
       in_place},
  };
}

}  // namespace plumbline::faults
