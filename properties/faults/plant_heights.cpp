// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faults for O2. The mesh is the terrain's own surface, heights are eighths of a metre: all that was not
// planted is exactly 0.
#include <algorithm>
#include <cmath>
#include <limits>

#include "properties/faults/measured_faults.h"
#include "properties/faults/sound_meshes.h"

namespace plumbline::faults {
namespace {

constexpr double kRelief_m = 64;

struct Scene {
  Terrain terrain;
  Mesh mesh;

  explicit Scene(Random& random)
      : terrain(random_terrain(4 + static_cast<int>(random.below(14)), random.below(2) == 0 ? 1 : 30,
                               kRelief_m, random)),
        mesh(reference_mesh(terrain)) {}
  int inner(Random& random) const {
    return 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(terrain.columns - 2)));
  }
  double cell_m2() const { return terrain.spacing_m * terrain.spacing_m; }
  double all_m2() const { return terrain.width_m() * terrain.depth_m(); }
  Vec2 plan(int i, int j) const { return {i * terrain.spacing_m, j * terrain.spacing_m}; }
};

/// Oracle O2's own rounding bound, for heights of twice the relief.
bool near(double value, double wanted) {
  return std::fabs(value - wanted) <= oracle::kVerticalRoundingFactor * 0x1p-53 * 2 * kRelief_m;
}

bool same(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }

/// One inner vertex moved up or down: a pyramid of error over its six triangles, three cells in area.
std::optional<Tally> move_vertex(const Judges& judges, Random& random, bool ulp) {
  Scene scene(random);
  const int i = scene.inner(random), j = scene.inner(random);
  double& z = scene.mesh.positions[scene.terrain.index(i, j)].z;
  const double before = z;
  if (ulp) {
    z = std::nextafter(z, std::numeric_limits<double>::infinity());
  } else {
    const double move_m = std::ldexp(1, static_cast<int>(random.below(9)) - 3);
    z += random.below(2) == 0 ? move_m : -move_m;
  }
  const double moved_m = std::fabs(z - before);
  const oracle::VerticalError error = judges.vertical(scene.mesh, scene.terrain);
  const double share = 3 * scene.cell_m2() / scene.all_m2();
  // Over a triangle, a linear function that is h at one corner and 0 at the others has mean h/3, mean square
  // h²/6.
  const bool size = ulp ? error.max == moved_m && error.certain_max == moved_m
                        : near(error.max, moved_m) && near(error.certain_max, moved_m) &&
                              near(error.mean, moved_m * share / 3) &&
                              near(error.rms, moved_m * std::sqrt(share / 6));
  const bool place = same(error.at, scene.plan(i, j)) && same(error.certain_at, scene.plan(i, j));
  return tally(false, error.max > 0, size, place, false);
}

/// A block of vertices from another time: all of it is wrong by the same height.
std::optional<Tally> stale_block(const Judges& judges, Random& random) {
  Scene scene(random);
  const auto range = [&] {
    const int a = scene.inner(random), b = scene.inner(random);
    return std::pair{std::min(a, b), std::max(a, b)};
  };
  const auto [west, east] = range();
  const auto [south, north] = range();
  const double move_m = std::ldexp(1, static_cast<int>(random.below(6)) - 2);
  for (int j = south; j <= north; ++j) {
    for (int i = west; i <= east; ++i) scene.mesh.positions[scene.terrain.index(i, j)].z += move_m;
  }
  const oracle::VerticalError error = judges.vertical(scene.mesh, scene.terrain);
  const Vec2 low = scene.plan(west, south), high = scene.plan(east, north);
  const bool place =
      error.at.x >= low.x && error.at.x <= high.x && error.at.y >= low.y && error.at.y <= high.y;
  return tally(false, error.max > 0, near(error.max, move_m) && near(error.certain_max, move_m), place,
               false);
}

/// One cell split by its other diagonal: an error that a reader of the samples may argue away.
std::optional<Tally> other_diagonal(const Judges& judges, Random& random) {
  Scene scene(random);
  const auto cells = static_cast<std::uint64_t>(scene.terrain.columns - 1);
  const int i = static_cast<int>(random.below(cells)), j = static_cast<int>(random.below(cells));
  const auto corner = [&](int u, int v) {
    return static_cast<std::uint32_t>(scene.terrain.index(i + u, j + v));
  };
  const auto z = [&](int u, int v) { return scene.terrain.z(i + u, j + v); };
  const double gap_m = std::fabs(z(0, 0) + z(1, 1) - z(1, 0) - z(0, 1)) / 2;
  if (gap_m == 0) return std::nullopt;
  const std::size_t first = 2 * (static_cast<std::size_t>(j) * cells + static_cast<std::size_t>(i));
  scene.mesh.triangles[first] = {corner(0, 0), corner(1, 0), corner(0, 1)};
  scene.mesh.triangles[first + 1] = {corner(1, 0), corner(1, 1), corner(0, 1)};
  const oracle::VerticalError error = judges.vertical(scene.mesh, scene.terrain);
  const Vec2 centre = (scene.plan(i, j) + scene.plan(i + 1, j + 1)) * 0.5;
  return tally(false, error.max > 0, near(error.max, gap_m), same(error.at, centre), error.certain_max > 0);
}

std::optional<Tally> as_it_is(const Judges& judges, Random& random) {
  const Scene scene(random);
  const oracle::VerticalError error = judges.vertical(scene.mesh, scene.terrain);
  return tally(true, error.max > 0 || error.rms > 0 || error.mean > 0, false, false,
               error.certain_max > 0 || error.area_m2 == 0);
}

/// On a plane it does not matter how a cell is split.
std::optional<Tally> other_diagonals_of_a_plane(const Judges& judges, Random& random) {
  Scene scene(random);
  const double east_m = static_cast<double>(random.below(8)) / 8,
               north_m = static_cast<double>(random.below(8)) / 8;
  const auto cells = static_cast<std::uint32_t>(scene.terrain.columns - 1);
  for (int j = 0; j < scene.terrain.rows; ++j) {
    for (int i = 0; i < scene.terrain.columns; ++i)
      scene.terrain.heights_m[scene.terrain.index(i, j)] = i * east_m + j * north_m;
  }
  scene.mesh = reference_mesh(scene.terrain);
  for (std::uint32_t cell = 0; cell < cells * cells; ++cell) {
    if (random.below(2) == 0) continue;
    const std::uint32_t a = cell / cells * (cells + 1) + cell % cells, b = a + 1, d = a + cells + 1;
    scene.mesh.triangles[2 * cell] = {a, b, d};
    scene.mesh.triangles[2 * cell + 1] = {b, d + 1, d};
  }
  const oracle::VerticalError error = judges.vertical(scene.mesh, scene.terrain);
  return tally(true, error.max > 0, false, false, error.certain_max > 0);
}

/// None of these needs a closed mesh.
template <std::optional<Tally> (*plant)(const Judges&, Random&)>
std::optional<Tally> trial(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  return plant(judges, random);
}

}  // namespace

std::vector<MeasuredFault> height_faults() {
  constexpr auto kOracle = "O2 vertical error";
  return {
      {kOracle, "vertex_moved", "an inner vertex up or down by 1/8 to 32 m: max, mean, RMS and place", false,
       [](const Judges& j, Random& r, const MakeSolid&) { return move_vertex(j, r, false); }},
      {kOracle, "vertex_moved_ulp", "the same, up by one ulp: max and place, to the bit", false,
       [](const Judges& j, Random& r, const MakeSolid&) { return move_vertex(j, r, true); }},
      {kOracle, "block_stale", "a rectangle of vertices too high by 1/4 to 8 m", false, trial<stale_block>},
      {kOracle, "diagonal_swapped", "a cell split the other way: max, but nothing certain", false,
       trial<other_diagonal>},
      {kOracle, "as_it_is", "the terrain's own surface: exactly 0", true, trial<as_it_is>},
      {kOracle, "plane_split_otherwise", "a plane, its cells split either way: exactly 0", true,
       trial<other_diagonals_of_a_plane>},
  };
}

}  // namespace plumbline::faults
