// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/pose.h"

#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t n = text.find(at);
    parts.push_back(text.substr(0, n));
    if (n == std::string_view::npos) return parts;
    text.remove_prefix(n + 1);
  }
}

[[noreturn]] void fail(std::string_view text, std::string_view what) {
  throw InputError(fmt::format("camera '{}': {}; give x,y,z:x,y,z[:fov_y_deg[:WxH]], position and look-at",
                               one_line(text, 120), what));
}

/// All of `part` as a number.
template <class Number>
Number number(std::string_view text, std::string_view part, std::string_view name) {
  Number value{};
  const auto digits = part.starts_with('+') ? part.substr(1) : part;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || part.starts_with("+-"))
    fail(text, fmt::format("its {} '{}' is no number", name, one_line(part, 40)));
  return value;
}

Vec3 point(std::string_view text, std::string_view part, std::string_view name) {
  const auto xyz = split(part, ',');
  if (xyz.size() != 3) fail(text, fmt::format("its {} '{}' is not three numbers", name, one_line(part, 40)));
  return {number<double>(text, xyz[0], name), number<double>(text, xyz[1], name),
          number<double>(text, xyz[2], name)};
}

}  // namespace

Pose parse_pose(std::string_view text) {
  const auto parts = split(text, ':');
  if (parts.size() < 2 || parts.size() > 4)
    fail(text, fmt::format("has {} part{} instead of 2 to 4", parts.size(), parts.size() == 1 ? "" : "s"));
  Pose pose;
  pose.position = point(text, parts[0], "position");
  pose.look_at = point(text, parts[1], "look-at");
  if (parts.size() > 2) pose.fov_y_deg = number<double>(text, parts[2], "field of view");
  if (parts.size() > 3) {
    const auto sides = split(parts[3], 'x');
    if (sides.size() != 2) fail(text, fmt::format("its viewport '{}' is not WxH", one_line(parts[3], 40)));
    pose.width_px = number<int>(text, sides[0], "width");
    pose.height_px = number<int>(text, sides[1], "height");
  }
  try {
    camera_of(pose);
  } catch (const InputError& error) {
    throw InputError(fmt::format("'{}': {}", one_line(text, 120), error.what()));
  }
  return pose;
}

std::string pose_text(const Pose& pose) {
  return fmt::format("{},{},{}:{},{},{}:{}:{}x{}", pose.position.x, pose.position.y, pose.position.z,
                     pose.look_at.x, pose.look_at.y, pose.look_at.z, pose.fov_y_deg, pose.width_px,
                     pose.height_px);
}

Camera camera_of(const Pose& pose) {
  return make_camera(pose.position, pose.look_at, pose.fov_y_deg, pose.width_px, pose.height_px);
}

}  // namespace plumbline
