// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "oracle/finding.h"
#include "scenarios/mesh.h"

namespace plumbline::oracle {

/// How a finding's picture is drawn.
struct FindingScene {
  const Mesh& mesh;
  const PlanDomain& domain;  ///< drawn as a dashed outline; may be empty
  std::span<const Finding> findings;
  bool oblique = false;       ///< a second view, from the south and above, heights drawn larger
  std::string_view note{};    ///< the line under the picture; empty: the first finding's own words
  bool numbers = true;        ///< vertices of the findings carry their indices
  double height_scale = 1.5;  ///< of the second view
};

/// A small SVG (no script, no outer file; its own light ground, so that dark pages show it as well): the mesh
/// in plan, witnesses and places of the findings marked. Triangles with a bad index or a corner that is not
/// finite are drawn by what is left of them. The same scene gives the same bytes.
std::string finding_picture(const FindingScene& scene);

}  // namespace plumbline::oracle
