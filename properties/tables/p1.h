// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "properties/tables/p1_points.h"
#include "properties/tables/stage.h"

namespace plumbline::tables {

/// P1: the TIN in nested rings (M2), paper 001, tables 1 and 2.
struct P1Settings {
  int size = kP1Size;                    ///< samples a side of a stand-in
  std::vector<PointSet> sets = kP1Sets;  ///< the first is fitted to
};

/// A trial a reading of the method: the viewer stands in the middle in all.
struct P1View {
  std::string name;
  ring_tin::Variant variant;
  int depth_cap = 6;
};
const std::vector<P1View>& p1_views();
/// The table with the paper's figures, and no trial yet.
Table p1_table(const P1Settings& settings);
/// The fit, and a row each.
std::size_t p1_steps(const P1Settings& settings);
Trial p1_trial(const Table& table, const P1Settings& settings, const Terrain& terrain, const P1View& view,
               const Workshop& workshop);

}  // namespace plumbline::tables
