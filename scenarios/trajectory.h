// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "scenarios/camera.h"
#include "scenarios/terrain.h"

namespace plumbline {

struct CameraPose {
  Vec3 position;
  Vec3 look_at;
};

/// A scripted flight. Lengths left at 0 take a default from the terrain's extent, so that one script suits every
/// terrain; positions are given as fractions of the extent where the kind says so.
struct TrajectorySpec {
  std::string id;
  std::string kind;   ///< approach, retreat, orbit, skim, spin, nadir, teleport, hover, poses
  int frames = 0;     ///< absent for `poses`: one frame a pose
  double height_m = 0;      ///< above the ground below the camera
  double distance_m = 0;    ///< approach, retreat: length of the way; orbit: radius
  double jitter_px = 0;     ///< hover: amplitude of the motion, as it shows in the picture's middle
  std::uint64_t seed = 1;   ///< teleport, hover
  std::vector<CameraPose> poses;
};

/// The cameras of a flight over a terrain, one a frame. Throws InputError for an unknown kind, no frames, or a pose
/// below the reference surface (a camera inside the ground sees nothing that could be judged).
std::vector<Camera> make_trajectory(const TrajectorySpec& spec, const Terrain& terrain, double fov_y_deg,
                                    int width_px, int height_px);

struct TrajectoryKind {
  std::string name;
  std::string summary;
};
const std::vector<TrajectoryKind>& trajectory_kinds();

}  // namespace plumbline
