// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "scenarios/camera.h"
#include "scenarios/mesh_source.h"
#include "scenarios/terrain.h"

namespace plumbline {

/// Where the camera stands and what it looks at, metres in the local frame.
struct CameraPose {
  Vec3 position;
  Vec3 look_at;
  friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// What is flown over, or around, and judged.
enum class Subject { terrain, mesh };

/// The longest flight that a suite may ask for.
inline constexpr int kMostFrames = 100'000;

/// A scripted flight. Lengths left at 0 take a default from L, the lesser side of the terrain's extent, so
/// that one script suits every terrain. Below, the ground is the reference surface; each kind is told in
/// trajectory_kinds().
struct TrajectorySpec {
  std::string id;
  Subject around = Subject::terrain;
  std::string kind;  ///< approach, retreat, orbit, skim, spin, nadir, teleport, two_ways, hover, poses
  int frames = 0;    ///< absent for `poses`: one frame a pose
  /// approach, retreat: above the ground at the near end (0.02 L); two_ways: at the pose held (0.08 L); skim
  /// (0.005 L), spin (0.06 L), hover (0.08 L): above the ground below; orbit: above the highest ground on the
  /// way (0.2 L); nadir: above the highest sample (0.4 L). Defaults are never below four sample spacings.
  double height_m = 0;
  double distance_m = 0;  ///< approach, retreat: length of the way (1.5 L); orbit: radius (0.6 L); two_ways:
                          ///< length of each way (0.5 L)
  /// Around a mesh: in radii of the ball around one object; approach, retreat, two_ways: of the far end, and
  /// spin, hover: of the camera, from the foremost copy's middle; orbit: the same beyond the scene's edge. 0:
  /// as the kind tells (trajectory_kinds_around_mesh()).
  double distance_radii = 0;
  double jitter_px = 0;    ///< hover: amplitude of the motion, as it shows in the picture's middle (0.5 px)
  int hold_frames = 0;     ///< teleport, two_ways: frames that a pose is held (4; 3)
  std::uint64_t seed = 1;  ///< teleport, hover
  std::vector<CameraPose> poses;
  friend bool operator==(const TrajectorySpec&, const TrajectorySpec&) = default;
};

/// The cameras of a flight over a terrain, one a frame; the same bits on every machine. Throws InputError for
/// an unknown kind, frames outside [1, kMostFrames], a length that is negative or not finite, or a given pose
/// that is not above the reference surface (a camera inside the ground sees nothing that could be judged).
std::vector<Camera> make_trajectory(const TrajectorySpec& spec, const Terrain& terrain, double fov_y_deg,
                                    int width_px, int height_px);

/// The same around a scene of objects. Distances follow from the size on the screen of the ball around one
/// object. Throws InputError as above, and for a distance within that ball.
std::vector<Camera> make_trajectory(const TrajectorySpec& spec, const ObjectScene& objects, double fov_y_deg,
                                    int width_px, int height_px);

/// What every flight asks of its script, and the cameras of its poses; throw InputError as make_trajectory.
void check_script(const TrajectorySpec& spec);
std::vector<Camera> cameras_at(const TrajectorySpec& spec, const std::vector<CameraPose>& poses,
                               double fov_y_deg, int width_px, int height_px);

/// A kind of flight, as a suite names it.
struct TrajectoryKind {
  std::string name;
  std::string summary;
  std::vector<std::string> keys;  ///< of a suite file that apply to it, besides id and kind
};
/// In the order in which they are listed: over terrains, and around meshes.
const std::vector<TrajectoryKind>& trajectory_kinds();
const std::vector<TrajectoryKind>& trajectory_kinds_around_mesh();

}  // namespace plumbline
