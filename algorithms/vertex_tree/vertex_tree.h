// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline::vertex_tree {

/// No node; as a parent's identifier it stands for +∞ (METHODS M5, run time).
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Limits of a safe collapse, and where building ends (paper, steps 3 and 4).
struct BuildSettings {
  double normal_angle_deg = 45;  ///< a surviving triangle's normal turns by less than this; 0 < … ≤ 180
  double least_quality = 0.1;    ///< and its quality 4·√3·area/(l0²+l1²+l2²) stays over this; [0, 1)
  std::size_t least_triangles = 0;  ///< building ends at this many triangles or fewer
};

/// All directions within an angle of a unit axis.
struct NormalCone {
  Vec3 axis;
  double cos_half = -1;  ///< −1: every direction
};

/// The vertex tree (paper, step 2): what building recorded, shared by all flyers. A node's index is its
/// identifier: 0 … originals−1 are the mesh's vertices, each collapse makes the next one.
struct VertexTree {
  std::size_t originals = 0;
  std::vector<Vec3> positions;                          ///< per node, metres
  std::vector<std::uint32_t> parent;                    ///< per node; kNone at a root
  std::vector<std::array<std::uint32_t, 2>> children;   ///< per made node (index: id − originals)
  std::vector<std::array<std::uint32_t, 2>> removed;    ///< PAT: per made node; second kNone on a border
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< the full mesh's
  std::vector<NormalCone> cones;                        ///< per made node: normals in its reach
  std::vector<double> radii_m;                          ///< per node: ball around all it stands for
  Vec3 center;                                          ///< of the whole object's ball
  double radius_m = 0;

  [[nodiscard]] std::size_t made() const { return children.size(); }
  [[nodiscard]] std::size_t nodes() const { return positions.size(); }
  [[nodiscard]] std::uint32_t partner(std::uint32_t v) const {
    if (parent[v] == kNone) return kNone;
    const auto& pair = children[parent[v] - originals];
    return pair[0] == v ? pair[1] : pair[0];
  }
};

/// Quality of a triangle by Guéziec (paper, equation 2): 1 equilateral, 0 degenerate.
double quality(Vec3 a, Vec3 b, Vec3 c);

/// Builds the tree. Vertices of equal, non-zero `line` lie on a line that must keep its place (a terrain's
/// border): only edges whose ends have the same `line` collapse. `lines` may be empty: all free.
/// Throws InputError if a limit is out of range, an index is out of range, a position is not finite, an edge
/// has more than two triangles or two that run the same way, or a vertex joins two fans; the message names
/// the first such place.
VertexTree build_tree(const Mesh& mesh, const BuildSettings& settings,
                      const std::vector<std::uint8_t>& lines = {});

}  // namespace plumbline::vertex_tree
