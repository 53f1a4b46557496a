// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "scenarios/camera.h"

namespace plumbline {

/// Where a camera stands, what it looks at, and its picture.
struct Pose {
  Vec3 position, look_at;  ///< metres, local frame
  double fov_y_deg = 60;
  int width_px = 1280, height_px = 720;
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// Reads a command line's `x,y,z:x,y,z[:fov_y_deg[:WxH]]` (position : look-at; CONTRACT "POSE"). Throws
/// InputError, one line with the part that is wrong, for another form and for what make_camera refuses.
Pose parse_pose(std::string_view text);

/// The whole form of it; reads back to the same bits.
std::string pose_text(const Pose& pose);

/// The camera of the pose; throws as make_camera does.
Camera camera_of(const Pose& pose);

}  // namespace plumbline
