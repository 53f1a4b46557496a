// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/lod_method.h"
#include "oracle/image.h"
#include "properties/harness/flight.h"
#include "properties/verdict/verdict.h"

namespace plumbline {

/// Which frame of which run to draw.
struct PictureOrder {
  std::string run;
  double threshold_px = 0;
  int frame = 0;
  const TerrainStage* stage = nullptr;
  const std::vector<Camera>* cameras = nullptr;
  std::function<std::unique_ptr<LodMethod>()> new_flyer;
};

/// Flies the run again up to the frame (a method may remember earlier ones) and draws what it then shows.
verdict::FramePictures draw(const PictureOrder& order, const oracle::RayDevice& device);

}  // namespace plumbline
