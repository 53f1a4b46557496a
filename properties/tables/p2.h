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

/// Table 1. A trial a view.
const std::vector<View>& p2_views();
Table p2_table1(const P2Settings& settings, const Picture& picture);
inline constexpr std::size_t kP2Table1Steps = 3;
Trial p2_trial1(const Table& table, const P2Settings& settings, const Terrain& terrain, const View& view,
                const Workshop& workshop);

/// Table 2, fitted to frame 1's triangles ("P2.2a") or to its visible tiles ("P2.2b"). A trial a way to move
/// back.
enum class Table2Fit { triangles, tiles };
struct Retreat {
  std::string name;
  bool along_sight = true;  ///< else level, at a constant height
};
const std::vector<Retreat>& p2_retreats();
Table p2_table2(const P2Settings& settings, const Picture& picture, Table2Fit fit);
inline constexpr std::size_t kP2Table2Steps = 2;
Trial p2_trial2(const Table& table, const P2Settings& settings, const Terrain& terrain,
                const LodMethod& prepared_method, const Retreat& retreat, Table2Fit fit,
                const Workshop& workshop);

/// What the paper says of preprocessing, for Timing::paper.
inline constexpr const char* kTable1Preprocessing = "91.251 s";
inline constexpr const char* kTable2Preprocessing = "10.698 s, or 610.698 s if a 6 was lost";
inline constexpr const char* kDependentPreprocessing = "not done after 10 h";

}  // namespace plumbline::tables
