// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reports/json_text.h"
#include "scenarios/mesh.h"

namespace plumbline::reports {

/// Triangles of one material.
struct GlbPart {
  std::string material;                  ///< its name
  std::array<double, 3> colour{};        ///< base colour, linear RGB, [0, 1]
  std::vector<std::uint32_t> triangles;  ///< indices into the mesh's triangles
};

/// A binary glTF 2.0 file of one node that shows the mesh, a primitive a part, both sides drawn, flat shaded
/// (no normals). The mesh's z is up; its axes are turned to glTF's (x, z, −y) by the root's matrix, which is
/// exact. Positions are 32-bit floats from the node's translation: coordinates whose differences from it need
/// at most 24 bits are kept exactly, others to 2⁻²⁴ of the parts' extent. `extras` (an object) goes to the
/// node. Triangles with a bad index or a corner that is not finite, vertices that no part uses and parts
/// without triangles are left out; empty if nothing is left. Same model, same bytes. Source: glTF 2.0
/// specification (Khronos Group, 2021), sections 3.6, 3.7 and 4.4.
std::string glb_bytes(const std::string& name, const Mesh& mesh, const std::vector<GlbPart>& parts,
                      const Json& extras = Json::object());

}  // namespace plumbline::reports
