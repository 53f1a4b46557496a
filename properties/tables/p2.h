// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "properties/tables/stage.h"

namespace plumbline::tables {

/// P2: isolated division (M3), paper 002, tables 1 and 2.
struct P2Settings {
  MethodUse whole{"isolated_quadtree", {{"tile_size", 1025.0}}};  ///< table 1: one tile
  int whole_size = 1025;
  double whole_triangles = 7226;  ///< fitted to: ε = 4

  MethodUse tiled{"isolated_quadtree", {{"tile_size", 257.0}}};  ///< table 2
  int tiled_size = 4097;
  double tiled_triangles = 84611;                  ///< fitted to: frame 1, one way
  double tiled_tiles = 129;                        ///< and the other
  MethodUse dependent{"restricted_quadtree", {}};  ///< "node-dependent division"
};

/// Table 1. A trial a view. The count is met at more than one distance: nearby, what lies behind the camera
/// or aside counts for little.
struct P2View {
  View view;
  bool near = false;  ///< the least distance that draws the count, else the greatest
};
const std::vector<P2View>& p2_views();
Table p2_table1(const P2Settings& settings, const Picture& picture);
inline constexpr std::size_t kP2Table1Steps = 3;
Trial p2_trial1(const Table& table, const P2Settings& settings, const Terrain& terrain, const P2View& view,
                const Workshop& workshop);

/// Table 2 twice: "P2.2a" at the terrain's own relief, the first camera placed by frame 1's visible tiles;
/// "P2.2b" from the same places, relief fitted to frame 1's triangles. A trial a way to move back.
struct Retreat {
  std::string name;
  bool along_sight = true;  ///< else level, at a constant height
};
const std::vector<Retreat>& p2_retreats();
enum class Relief { own, fitted };
Table p2_table2(const P2Settings& settings, const Picture& picture, Relief relief);

/// Where the first camera sees the wanted number of tiles.
Fit p2_fit_distance(const P2Settings& settings, const Terrain& terrain, const LodMethod& method,
                    const Workshop& workshop);
/// The factor on heights with which the first camera, that far away, draws the wanted number of triangles.
Fit p2_fit_relief(const P2Settings& settings, const Terrain& terrain, double distance_m,
                  const Workshop& workshop);
Terrain with_relief(const Terrain& terrain, double factor);
/// Steps of the progress, for both tables of a stand-in: two fits and a trial for each retreat and table.
inline constexpr std::size_t kP2Table2Steps = 6;
/// The six snapshots. `fits`: what led here; kept in the trial.
Trial p2_trial2(const Table& table, const Terrain& terrain, const LodMethod& method, const Retreat& retreat,
                double distance_m, const std::vector<Fit>& fits, const Workshop& workshop);

/// What the paper says of preprocessing, for Timing::paper.
inline constexpr const char* kTable1Preprocessing = "91.251 s";
inline constexpr const char* kTable2Preprocessing = "10.698 s, or 610.698 s if a 6 was lost";
inline constexpr const char* kDependentPreprocessing = "not done after 10 h";

}  // namespace plumbline::tables
