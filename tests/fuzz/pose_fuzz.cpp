// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>

#include "scenarios/pose.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto pose = fuzz::accepted([&] { return parse_pose(text); });
  if (!pose) return 0;
  fuzz::require(parse_pose(pose_text(*pose)) == *pose, "what is printed reads back");
  const Camera camera = camera_of(*pose);
  constexpr double kFewRoundings = 1e-12;
  const auto close = [](double a, double b) { return std::fabs(a - b) <= kFewRoundings; };
  fuzz::require(close(length(camera.forward), 1) && close(length(camera.up), 1) &&
                    close(dot(camera.forward, camera.up), 0),
                "forward and up are unit and upright");
  fuzz::require(std::isfinite(camera.kappa_px) && camera.kappa_px > 0, "kappa is positive and finite");
  return 0;
}
