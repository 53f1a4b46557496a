// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "properties/check/examination.h"

namespace plumbline::checking {

/// Where a camera looks: everything in metres, x east, y north, z up.
struct Stage {
  /// From a vertex of a subject to the stage; empty: the frame of the check times its unit.
  std::function<Vec3(const Subject&, std::uint32_t vertex)> place;
  std::optional<Mesh> reference;  ///< the DEM's own surface
};

void against_terrain(Examination& exam, Stage& stage, std::vector<verdict::CheckFinding>& findings,
                     verdict::CheckPictures& pictures);
void against_camera(Examination& exam, const Stage& stage, std::vector<verdict::CheckFinding>& findings,
                    verdict::CheckPictures& pictures);

}  // namespace plumbline::checking
