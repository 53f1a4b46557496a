// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Flights around a scene of objects. Distances follow from what the picture shows: methods for objects
// choose by an object's size on the screen, so each flight says through which sizes it goes, whatever the
// viewport.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/portable_math.h"
#include "scenarios/random.h"
#include "scenarios/trajectory.h"

namespace plumbline {
namespace {

using Poses = std::vector<CameraPose>;

// Sizes on the screen, pixels, of the ball around one object. The vertex tree's ladder has its rungs at 100
// to 300 px times τ: a flight from kFarPx to kNearPx crosses them all up to τ = 2.
constexpr double kFarPx = 60;
constexpr double kNearPx = 640;
constexpr double kRoundPx = 180;  // between two rungs: what changes on the round is the contour
constexpr double kRungPx = 200;   // on a rung: the least motion crosses it

/// To the camera: before the front, from the right and above; askew, so that no ray runs along an axis.
Vec3 front() { return normalized({0.2, -1, 0.35}); }

struct Scene {
  const TrajectorySpec& spec;
  const ObjectScene& objects;
  double kappa_px;

  /// The foremost copy: from before it, no other copy stands in the camera's way.
  Vec3 target;

  /// From the middle of an object, so that it shows as `size_px`; beyond its ball.
  [[nodiscard]] double distance_m(double size_px) const {
    const double tangent = 2 * kappa_px / size_px;
    return objects.object_radius_m * std::sqrt(1 + tangent * tangent);
  }
  /// The inverse. Requires: distance_m > the object's radius.
  [[nodiscard]] double size_px(double distance_m) const {
    const double r = objects.object_radius_m;
    return 2 * kappa_px * r / std::sqrt(distance_m * distance_m - r * r);
  }
  /// The distance that the suite gives or, without one, where an object shows as `size_px`.
  [[nodiscard]] double distance_or(double size_px) const {
    return spec.distance_radii > 0 ? spec.distance_radii * objects.object_radius_m : distance_m(size_px);
  }
  /// Before the foremost copy.
  [[nodiscard]] CameraPose before(double distance) const { return {target + front() * distance, target}; }
  /// Around the scene: so far from its edge as if an object stood there.
  [[nodiscard]] CameraPose around(Vec3 direction, double distance) const {
    const double beyond_m = objects.radius_m - objects.object_radius_m;
    return {objects.center + direction * (beyond_m + distance), objects.center};
  }
  [[nodiscard]] double progress(int frame) const {
    return spec.frames > 1 ? static_cast<double>(frame) / (spec.frames - 1) : 0.0;
  }
};

Poses fly_approach(const Scene& scene) {
  const double near_m = scene.distance_m(kNearPx), far_m = scene.distance_or(kFarPx);
  if (!(far_m > near_m)) {
    throw InputError(fmt::format(
        "trajectory '{}': distance_radii is {}, nearer than the flight's near end at {}; give more",
        scene.spec.id, scene.spec.distance_radii, near_m / scene.objects.object_radius_m));
  }
  const double far_px = scene.size_px(far_m);
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double size_px = far_px + (kNearPx - far_px) * scene.progress(f);
    poses.push_back(scene.before(scene.distance_m(size_px)));
  }
  return poses;
}

Poses fly_retreat(const Scene& scene) {
  Poses poses = fly_approach(scene);
  std::reverse(poses.begin(), poses.end());
  return poses;
}

Poses fly_orbit(const Scene& scene) {
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double angle = 2 * kPi * f / scene.spec.frames;
    const Vec3 direction = normalized({exact_cos(angle), exact_sin(angle), 0.35});
    poses.push_back(scene.around(direction, scene.distance_or(kRoundPx)));
  }
  return poses;
}

/// On the spot; the scene leaves the picture and comes back.
Poses fly_spin(const Scene& scene) {
  const CameraPose stand = scene.before(scene.distance_or(kRoundPx));
  const Vec3 ahead = stand.look_at - stand.position;
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double c = exact_cos(2 * kPi * f / scene.spec.frames),
                 s = exact_sin(2 * kPi * f / scene.spec.frames);
    const Vec3 turned{c * ahead.x - s * ahead.y, s * ahead.x + c * ahead.y, ahead.z};
    poses.push_back({stand.position, stand.position + turned});
  }
  return poses;
}

Vec3 random_direction(Random& random) {
  for (;;) {
    const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
    const Vec3 p{x, y, z};
    const double square = dot(p, p);
    if (square > 0.01 && square <= 1) return normalized(p);
  }
}

Poses fly_teleport(const Scene& scene) {
  Random random(scene.spec.seed, "teleport");
  const int held = scene.spec.hold_frames > 0 ? scene.spec.hold_frames : 4;
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    if (f % held != 0) {
      poses.push_back(CameraPose(poses.back()));
      continue;
    }
    const Vec3 direction = random_direction(random);
    // By turns far and near: a cut that stays on one rung asks nothing.
    const bool far = (f / held) % 2 == 0;
    const double size_px = far ? random.between(kFarPx, 190.0) : random.between(210.0, kNearPx);
    poses.push_back(scene.around(direction, scene.distance_m(size_px)));
  }
  return poses;
}

/// One pose reached from afar, held, left for a near place, and reached again from there.
Poses fly_two_ways(const Scene& scene) {
  const int held = scene.spec.hold_frames > 0 ? scene.spec.hold_frames : 3;
  const double far_m = scene.distance_or(kFarPx), near_m = scene.distance_m(kNearPx);
  const double pose_m = scene.distance_m(kRoundPx);
  if (!(far_m > pose_m)) {
    throw InputError(
        fmt::format("trajectory '{}': distance_radii is {}, nearer than the pose held at {}; give more",
                    scene.spec.id, scene.spec.distance_radii, pose_m / scene.objects.object_radius_m));
  }
  const CameraPose pose = scene.before(pose_m);
  const auto on_way = [&](double end_m, double t) { return scene.before(end_m + (pose_m - end_m) * t); };
  const int steps = std::max(1, (scene.spec.frames - 2 * held) / 3);
  Poses poses;
  for (int k = 0; k < steps; ++k) poses.push_back(on_way(far_m, static_cast<double>(k) / steps));
  poses.insert(poses.end(), static_cast<std::size_t>(held), pose);
  for (int k = 1; k <= steps; ++k) poses.push_back(on_way(near_m, 1 - static_cast<double>(k) / steps));
  for (int k = 1; k < steps; ++k) poses.push_back(on_way(near_m, static_cast<double>(k) / steps));
  poses.resize(static_cast<std::size_t>(scene.spec.frames), pose);  // the rest holds the pose again
  return poses;
}

/// Trembles on a rung, in all three directions: along the view too, where it crosses the rung.
Poses fly_hover(const Scene& scene) {
  Random random(scene.spec.seed, "hover");
  const double jitter_px = scene.spec.jitter_px > 0 ? scene.spec.jitter_px : 0.5;
  const CameraPose stand = scene.before(scene.distance_or(kRungPx));
  const Vec3 ahead = normalized(stand.look_at - stand.position);
  const Vec3 aside = normalized(cross(ahead, {0, 0, 1})), up = cross(aside, ahead);
  const double amplitude_m = jitter_px / scene.kappa_px * length(stand.look_at - stand.position);
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double across_m = random.between(-amplitude_m, amplitude_m);
    const double up_m = random.between(-amplitude_m, amplitude_m);
    const double along_m = random.between(-amplitude_m, amplitude_m);
    const Vec3 shift = aside * across_m + up * up_m + ahead * along_m;
    poses.push_back({stand.position + shift, stand.look_at + shift});
  }
  return poses;
}

Poses given_poses(const Scene& scene) { return scene.spec.poses; }

struct Flight {
  TrajectoryKind kind;
  Poses (*fly)(const Scene&);
};

const std::vector<Flight>& flights() {
  static const std::vector<Flight> all{
      {{"approach",
        "from afar, so that an object grows evenly from 60 to 640 px",
        {"frames", "distance_radii"}},
       fly_approach},
      {{"retreat", "approach backwards", {"frames", "distance_radii"}}, fly_retreat},
      {{"orbit", "one round, where an object shows as 180 px", {"frames", "distance_radii"}}, fly_orbit},
      {{"spin",
        "a full turn on the spot: the objects leave the picture and come back",
        {"frames", "distance_radii"}},
       fly_spin},
      {{"teleport",
        "cuts to seeded poses all around, by turns far and near, each held for some frames",
        {"frames", "hold_frames", "seed"}},
       fly_teleport},
      {{"two_ways",
        "one pose reached from afar, held, and reached again from near",
        {"frames", "hold_frames", "distance_radii"}},
       fly_two_ways},
      {{"hover",
        "trembles by less than a pixel where an object shows as 200 px",
        {"frames", "distance_radii", "jitter_px", "seed"}},
       fly_hover},
      {{"poses", "the poses given, one a frame", {"poses"}}, given_poses},
  };
  return all;
}

}  // namespace

std::vector<Camera> make_trajectory(const TrajectorySpec& spec, const ObjectScene& objects, double fov_y_deg,
                                    int width_px, int height_px) {
  const auto& all = flights();
  const auto flight =
      std::find_if(all.begin(), all.end(), [&](const Flight& f) { return f.kind.name == spec.kind; });
  if (flight == all.end()) {
    throw InputError(
        fmt::format("trajectory '{}': kind \"{}\" does not fly around a mesh", spec.id, spec.kind));
  }
  check_script(spec);
  if (!(spec.distance_radii >= 0) || !std::isfinite(spec.distance_radii) ||
      (spec.distance_radii > 0 && spec.distance_radii <= 1)) {
    throw InputError(fmt::format("trajectory '{}': distance_radii is {}; give more than 1, outside the ball",
                                 spec.id, spec.distance_radii));
  }
  const double kappa_px = make_camera({0, 0, 1}, {0, 1, 0}, fov_y_deg, width_px, height_px).kappa_px;
  const Vec3 target = *std::max_element(objects.centers.begin(), objects.centers.end(), [](Vec3 a, Vec3 b) {
    return dot(a, front()) < dot(b, front());
  });  // the first among equals
  const Scene scene{spec, objects, kappa_px, target};
  return cameras_at(spec, flight->fly(scene), fov_y_deg, width_px, height_px);
}

const std::vector<TrajectoryKind>& trajectory_kinds_around_mesh() {
  static const std::vector<TrajectoryKind> kinds = [] {
    std::vector<TrajectoryKind> list;
    for (const Flight& flight : flights()) list.push_back(flight.kind);
    return list;
  }();
  return kinds;
}

}  // namespace plumbline
