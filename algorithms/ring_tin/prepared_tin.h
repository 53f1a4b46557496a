// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "algorithms/ring_tin/collapse_map.h"
#include "algorithms/ring_tin/vertex_levels.h"
#include "algorithms/tin/tin.h"
#include "scenarios/mesh.h"
#include "scenarios/terrain.h"

namespace plumbline::ring_tin {

/// Everything that depends on the TIN alone; shared by all flights.
struct PreparedTin {
  tin::Tin tin;
  tin::Adjacency adjacency;
  Prices prices;
  PlanCells cells;
  PlanDomain domain;

  /// Prices every edge. `domain`: what the TIN covers.
  PreparedTin(tin::Tin network, PlanDomain covered);
  /// With prices that are known already.
  PreparedTin(tin::Tin network, PlanDomain covered, Prices known);
};

/// Which of a terrain's samples (or surveyed points) become points of the TIN.
struct PointChoice {
  double share = 1;  ///< of the samples that are kept: drawn one by one; the terrain's corners always are
  std::uint64_t seed = 1;
};

/// The TIN of a terrain: every sample on its reference triangulation, or, thinned or with roads, the
/// (constrained) Delaunay triangulation of what is kept and of the roads' corners, draped on the terrain. A
/// terrain of surveyed points gives these and, of the samples, those on its border.
/// Covers the terrain's rectangle. Throws InputError for a road corner off the terrain, or as delaunay_tin.
tin::Tin terrain_tin(const Terrain& terrain, const PointChoice& points);

/// A number that changes with anything terrain_tin looks at.
std::uint64_t fingerprint(const Terrain& terrain, const PointChoice& points);

/// Writes a prepared TIN to an SQLite file, whole or not at all: tables vertex (x, y, z), triangle (a, b, c),
/// edge (a, b, road, error_m, start), and `source` with the fingerprint. Throws InputError if it cannot.
void store(const std::filesystem::path& path, const PreparedTin& prepared, std::uint64_t source);

/// Opens what `store` wrote: the same doubles, bit for bit. Throws InputError, one line, for a file that is
/// no such database, is damaged, or was prepared from another source.
PreparedTin open_stored(const std::filesystem::path& path, std::uint64_t source, PlanDomain covered);

}  // namespace plumbline::ring_tin
