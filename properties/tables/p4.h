// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "properties/tables/stage.h"
#include "scenarios/mesh.h"

namespace plumbline::tables {

/// A mesh in the paper's instrument's stead.
struct MeshStandIn {
  std::string id;
  std::string origin;  ///< what it is, in a few words
  Mesh mesh;
};

/// P4: the vertex tree (M5), paper 004: its instrument of 86 802 triangles, brought to 5 381 and flown down
/// the ladder.
struct P4Settings {
  std::vector<MeshStandIn> meshes;
  double least_share = 5381.0 / 86802.0;  ///< of a mesh's triangles: where building ends
};

/// A trial a contour rule: a variant of vertex_tree.
struct P4View {
  std::string name;
  std::string variant;
};
const std::vector<P4View>& p4_views();
/// The table with the paper's figures, and no trial yet.
Table p4_table();
/// One mesh under one contour rule. Throws InputError for a mesh that vertex_tree cannot take.
Trial p4_trial(const Table& table, const P4Settings& settings, const MeshStandIn& stand_in,
               const P4View& view, const Workshop& workshop);
/// Steps of a trial, for the progress line.
std::size_t p4_steps();

/// A mesh from a file, triangulated, equal corners made one, cut open where it is no manifold. Throws
/// InputError as read_mesh_file.
MeshStandIn load_mesh_stand_in(const std::string& path);

}  // namespace plumbline::tables
