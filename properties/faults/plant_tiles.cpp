// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faults of terrain tiles against their format.
#include <algorithm>
#include <cmath>
#include <string>

#include "properties/faults/measured_faults.h"
#include "properties/faults/sound_tiles.h"

namespace plumbline::faults {
namespace {

/// The finding that a fault must cause, alone.
struct TileFault {
  std::string kind;
  std::vector<std::uint32_t> vertices, triangles;
  double size_m = -1;  ///< of gap_m; -1: it has none
};

using PlantTile = TileFault (*)(SoundTile&, Random&);

std::optional<Tally> trial(const Judges& judges, Random& random, PlantTile plant) {
  SoundTile tile = random_tile(random);
  const TileFault fault = plant(tile, random);
  bool reported = false, size = false, place = false, elsewhere = false;
  for (const oracle::TileFinding& found : judges.tile(tile.tile, tile.bounds)) {
    const oracle::Finding& finding = found.finding;
    if (reported || finding.code != oracle::FindingCode::tile_encoding || finding.kind != fault.kind) {
      elsewhere = true;
      continue;
    }
    reported = true;
    // The ball's farthest vertex is found in doubles, some thousands of kilometres from the origin.
    size = fault.size_m < 0 || std::fabs(finding.gap_m - fault.size_m) < 1e-6;
    const auto names = [](const auto& all, const auto& wanted) {
      return std::all_of(wanted.begin(), wanted.end(), [&all](std::uint32_t i) {
        return std::find(all.begin(), all.end(), i) != all.end();
      });
    };
    place = names(finding.vertices, fault.vertices) && names(finding.triangles, fault.triangles) &&
            (fault.size_m >= 0 || finding.vertices.size() == fault.vertices.size());
  }
  return tally(false, reported, size, place, elsewhere);
}

std::uint32_t number(const SoundTile& t, int column, int row) {
  return static_cast<std::uint32_t>(row * t.columns + column);
}
int inner(int count, Random& random) {
  return 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(count - 2)));
}
std::uint32_t inner_vertex(const SoundTile& t, Random& random) {
  return number(t, inner(t.columns, random), inner(t.rows, random));
}
/// On side 0 to 3 (west, south, east, north), but in no corner.
std::uint32_t side_vertex(const SoundTile& t, std::size_t side, Random& random) {
  if (side % 2 == 0) return number(t, side == 0 ? 0 : t.columns - 1, inner(t.rows, random));
  return number(t, inner(t.columns, random), side == 1 ? 0 : t.rows - 1);
}

/// The one triangle at the south-eastern or the north-western corner.
TileFault drop_corner(SoundTile& t, Random& random) {
  const bool east = random.below(2) == 0;
  const std::uint32_t corner = east ? number(t, t.columns - 1, 0) : number(t, 0, t.rows - 1);
  const auto gone = std::find_if(t.tile.triangles.begin(), t.tile.triangles.end(), [&](const auto& c) {
    return std::find(c.begin(), c.end(), corner) != c.end();
  });
  TileFault fault{"corner_missing", {}, {}};
  for (const std::uint32_t v : *gone) {
    if (v != corner) fault.vertices.push_back(v);
  }
  std::sort(fault.vertices.begin(), fault.vertices.end());
  t.tile.triangles.erase(gone);
  return fault;
}

TileFault leave_border(SoundTile& t, Random& random) {
  const std::size_t side = random.below(4);
  const std::uint32_t v = side_vertex(t, side, random);
  (side % 2 == 0 ? t.tile.u : t.tile.v)[v] += side < 2 ? 1 : -1;
  list_edges(t.tile);
  const std::uint32_t step = side % 2 == 0 ? static_cast<std::uint32_t>(t.columns) : 1u;
  return {"off_border", {v - step, v, v + step}, {}};
}

TileFault forget_listed(SoundTile& t, Random& random) {
  const std::size_t side = random.below(4);
  const std::uint32_t v = side_vertex(t, side, random);
  std::erase(t.tile.edges[side], v);
  return {"edge_list", {v}, {}};
}

TileFault list_stranger(SoundTile& t, Random& random) {
  const std::uint32_t v = inner_vertex(t, random);
  t.tile.edges[random.below(4)].push_back(v);
  return {"edge_list", {v}, {}};
}

TileFault break_index(SoundTile& t, Random& random) {
  const auto triangle = static_cast<std::uint32_t>(random.below(t.tile.triangles.size()));
  auto& corners = t.tile.triangles[triangle];
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(3)), corners.end());
  corners[0] = static_cast<std::uint32_t>(t.tile.vertices() + random.below(9));
  return {"index", {corners[1], corners[2]}, {triangle}};
}

TileFault leave_range(SoundTile& t, Random& random) {
  const std::uint32_t v = inner_vertex(t, random);
  t.tile.height[v] = random.below(2) == 0 ? -1 : kTileSteps + 1;
  return {"range", {v}, {}};
}

TileFault turn_range(SoundTile& t, Random& /*random*/) {
  std::swap(t.tile.min_height_m, t.tile.max_height_m);
  return {"height_range", {}, {}};
}

TileFault shrink_ball(SoundTile& t, Random& random) {
  const double by_m = random.between(100, 1000);  // well beyond what a lattice cell excuses
  t.tile.sphere_radius_m -= by_m;
  return {"sphere", {t.farthest}, {}, by_m};
}

TileFault lose_center(SoundTile& t, Random& random) {
  t.tile.center = t.tile.center * random.between(0, 0.5);
  return {"center", {}, {}};
}

TileFault break_normal(SoundTile& t, Random& random) {
  const auto v = static_cast<std::uint32_t>(random.below(t.tile.vertices()));
  t.tile.normals[v] = random.below(2) == 0 ? Vec3{} : -t.tile.normals[v];
  return {"normal", {v}, {}};
}

TileFault append_bytes(SoundTile& t, Random& random) {
  t.tile.trailing_bytes = 1 + random.below(99);
  return {"trailing", {}, {}};
}

std::optional<Tally> sound(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  const SoundTile tile = random_tile(random);
  return tally(true, !judges.tile(tile.tile, tile.bounds).empty(), false, false, false);
}

}  // namespace

std::vector<MeasuredFault> tile_faults() {
  constexpr auto kTile = "tile format";
  const auto entry = [](std::string_view name, std::string_view what, PlantTile plant) {
    return MeasuredFault{kTile, name, what, false,
                         [plant](const Judges& judges, Random& random, const MakeSolid&) {
                           return trial(judges, random, plant);
                         }};
  };
  return {
      entry("tile_corner_missing", "the triangle at a corner left out: the corner, and the cut's ends",
            drop_corner),
      entry("tile_off_border", "a vertex of a side one step inside: the chain of its two edges",
            leave_border),
      entry("tile_edge_unlisted", "a side's list forgets a vertex", forget_listed),
      entry("tile_edge_stranger", "a side's list names a vertex from the inside", list_stranger),
      entry("tile_index_bad", "a triangle that names a vertex which is not there", break_index),
      entry("tile_out_of_range", "a height outside 0 to 32767", leave_range),
      entry("tile_range_turned", "a header whose least height is above its greatest", turn_range),
      entry("tile_ball_too_small", "a ball that leaves vertices out: by how much", shrink_ball),
      entry("tile_center_elsewhere", "a center deep in the Earth", lose_center),
      entry("tile_normal_bad", "a normal of no length, or into the ground", break_normal),
      entry("tile_trailing_bytes", "bytes that belong to nothing", append_bytes),
      {kTile, "tile_sound", "irregular columns and rows, rough ground: nothing", true, sound},
  };
}

}  // namespace plumbline::faults
