// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "oracle/finding.h"
#include "scenarios/camera.h"
#include "scenarios/mesh.h"

namespace plumbline::oracle {

/// How many of each finding; complete, whatever cap a list has. A T-vertex with a gap counts under both
/// t_junction and crack (it is one finding in the list): the definitions of ORACLES O1 name it in both.
struct ConformityCounts {
  std::size_t crack = 0, t_junction = 0, fold_over = 0, degenerate = 0, hole = 0, overlap = 0, outline = 0,
              non_manifold = 0, duplicate = 0, non_finite = 0, bad_index = 0, unused_vertex = 0;
  friend bool operator==(const ConformityCounts&, const ConformityCounts&) = default;
  /// All together; 0: sound.
  [[nodiscard]] std::size_t total() const;
};

/// A triangle's edge, in its direction.
struct LooseEdge {
  std::uint32_t from = 0, to = 0;  ///< vertices
  std::uint32_t triangle = 0;
};

/// What check_conformity found: how many of each, and each with its place.
struct ConformityReport {
  ConformityCounts counts;
  std::vector<Finding> findings;       ///< sorted by code, then place (x, y, z), then witnesses
  double largest_gap_m = 0;            ///< over cracks
  std::size_t left_over_edges = 0;     ///< edges that found no twin by index: what geometry had to look at
  std::size_t exact_orientations = 0;  ///< triangles whose orientation double could not tell
  /// Edges that no other triangle has the other way, by index, in order of triangle. Nothing if triangles
  /// were set aside.
  std::optional<std::vector<LooseEdge>> loose_edges;
  [[nodiscard]] bool clean() const { return counts.total() == 0; }
};

/// O1: decides exactly whether the mesh covers the domain once, edge to edge and at equal heights (ORACLES
/// O1). No tolerance: every decision is made by exact predicates on the given doubles. Figures that only
/// describe a finding (area, gap) are rounded. Linear in triangles for meshes that match by index; geometry
/// sees the left-overs alone.
ConformityReport check_conformity(const Mesh& mesh, const PlanDomain& domain);

/// The same for a mesh that promises no outline: wherever it ends, it ends. Holes are regions that its cover
/// encloses; there is no finding `outline`.
ConformityReport check_conformity_without_outline(const Mesh& mesh);

}  // namespace plumbline::oracle
