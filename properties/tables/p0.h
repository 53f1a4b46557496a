// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "properties/tables/stage.h"

namespace plumbline::tables {

/// P0: ATL (M1) against QUADTin, paper 000, figures 6–8.
struct P0Settings {
  int size = 513;  ///< samples a side; M1 takes one less
  MethodUse atl{"haar_quadtree", {{"patch_size", 128.0}, {"cull", false}}};
  MethodUse quadtin{"restricted_quadtree", {}};
  std::array<double, 3> atl_triangles{38530, 20569, 6983};  ///< fitted to; figures 6b, 7a, 8a
  /// Besides the terrains of all tables: the paper's was made from a map.
  std::vector<StandInSource> more_stand_ins;
};

/// A view and how far away it is, in widths of the terrain.
struct P0View {
  View view;
  double widths = 1;
};
const std::vector<P0View>& p0_views();

/// The table with the paper's figures, and no trial yet.
Table p0_table(const Picture& picture);
/// Figures that take work, per trial: steps of the progress.
inline constexpr std::size_t kP0Steps = 9;
/// One trial over one terrain.
Trial p0_trial(const Table& table, const P0Settings& settings, const Terrain& terrain, const P0View& view,
               const Workshop& workshop);

}  // namespace plumbline::tables
