// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "oracle/conformity.h"
#include "scenarios/mesh.h"

namespace plumbline::oracle {

/// A height exactly as its file has it: low + (high − low)·step/32767 − drop, metres. A plain height has step
/// 0; a quantized tile gives its range as low and high and the stored integer as step.
struct ExactHeight {
  double low = 0, high = 0;
  std::uint32_t step = 0;
  double drop = 0;  ///< how far below: the foot of a skirt

  static constexpr double kSteps = 32767;
  /// In double; the ends of the range are met exactly.
  [[nodiscard]] double metres() const {
    const double share = step / kSteps;
    return (step == 0 ? low : share == 1 ? high : low * (1 - share) + high * share) - drop;
  }
  [[nodiscard]] bool plain() const { return step == 0 && drop == 0; }
  friend bool operator==(const ExactHeight&, const ExactHeight&) = default;
};

/// One edge of a mesh's border, the surface to its left (seen from above).
struct BorderEdge {
  std::array<Vec2, 2> plan;
  std::array<ExactHeight, 2> height;
  std::array<std::uint32_t, 2> vertices{};  ///< of the mesh
  std::uint32_t triangle = 0;
  bool has_skirt = false;
  std::array<ExactHeight, 2> foot{};  ///< the skirt's lower edge, below the two ends
  std::array<Vec3, 2> normal{};       ///< unit; zero: none
};

/// The border of one mesh: edges that a triangle uses and no other triangle uses the other way. Vertices at
/// one place are taken for one.
struct Border {
  std::vector<BorderEdge> edges;
  Vec2 low, high;  ///< box in plan
};

/// A terrain mesh taken apart.
struct Sheet {
  Mesh surface;                            ///< all positions; the triangles that are no walls
  std::vector<std::uint32_t> triangle_of;  ///< per triangle of `surface`: its index in the mesh
  std::vector<std::uint32_t> walls;        ///< triangles of the mesh with a vertical side
};

/// Takes the walls off: triangles of which two corners stand over one plan point at different heights, and
/// the third elsewhere. Skirts and cliffs are made of them; O1 would call each degenerate. Triangles that are
/// flat in plan otherwise, three corners over three points of a line, hold a border together and stay: O1
/// tells them. So do triangles with a bad index or a corner that is not finite.
Sheet take_walls_off(const Mesh& mesh);

/// The border of the sheet's surface, in order of triangle. `normals`: one a vertex, or none. Where walls of
/// the sheet hang from a border edge (they have it as an edge, and stand along it from end to end), the edge
/// has a skirt down to the straight line between their lowest corners below its ends.
/// `judged`: what check_conformity said of the sheet's surface, if it was asked; spares looking again.
Border border_of(const Mesh& mesh, const Sheet& sheet, std::span<const Vec3> normals,
                 const ConformityReport* judged = nullptr);

}  // namespace plumbline::oracle
