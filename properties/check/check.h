// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "properties/verdict/check_verdict.h"
#include "scenarios/dem.h"

namespace plumbline {

/// What `plumbline check` is asked.
struct CheckRequest {
  /// Mesh files, `.terrain` tiles, or folders of tiles with their layer.json.
  std::vector<std::filesystem::path> inputs;
  enum class Kind { guess, terrain, object };
  Kind kind = Kind::guess;
  enum class Up { guess, x, y, z };
  Up up = Up::guess;
  double unit_m = 1;  ///< metres per unit of the files (glTF: always metres)

  std::filesystem::path terrain;  ///< DEM; empty: none
  std::string placing = "guess";  ///< how meshes lie over it: one of placing_names()
  DemHoles holes = DemHoles::leave_out;
  std::filesystem::path reference;   ///< another mesh; empty: none
  std::optional<double> declared_m;  ///< the maker's bound

  struct Pose {
    Vec3 position, look_at;
    double fov_y_deg = 60;
    int width_px = 1280, height_px = 720;
  };
  std::optional<Pose> camera;
  double threshold_px = 1;

  /// A skirt that the client adds below every border: metres. With `cesium_skirt` CesiumJS's rule, five times
  /// the level's geometric error.
  std::optional<double> skirt_m;
  bool cesium_skirt = false;
  bool strict = false;   ///< hazards make a mesh faulty, too
  bool pictures = true;  ///< make CheckPictures
  int jobs = 0;
};

/// What is found, and what to show of it.
struct CheckOutcome {
  verdict::CheckVerdict verdict;
  verdict::CheckPictures pictures;
};

/// Reads the meshes and judges each, and how they fit together. Throws InputError for what cannot be read.
CheckOutcome check(const CheckRequest& request);

}  // namespace plumbline
