// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/trajectory.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/nearest.h"
#include "scenarios/portable_math.h"
#include "scenarios/random.h"

namespace plumbline {
namespace {

using Poses = std::vector<CameraPose>;

// What the flights need to know about the ground and the picture.
struct Scene {
  const TrajectorySpec& spec;
  const Terrain& terrain;
  double kappa_px;
  double width_m = terrain.width_m();
  double depth_m = terrain.depth_m();
  double side_m = std::min(width_m, depth_m);  // L of the defaults

  [[nodiscard]] double ground_m(double x, double y) const { return terrain.surface_height_m(x, y); }
  [[nodiscard]] Vec3 on_ground(double x, double y) const { return {x, y, ground_m(x, y)}; }
  [[nodiscard]] Vec3 above_ground(double x, double y, double height_m) const {
    return {x, y, ground_m(x, y) + height_m};
  }
  [[nodiscard]] Vec3 middle() const { return on_ground(width_m / 2, depth_m / 2); }
  // Nearer than a few samples, a picture shows how single cells are split, and little else.
  [[nodiscard]] double height_or(double share) const {
    return spec.height_m > 0 ? spec.height_m : std::max(share * side_m, 4 * terrain.spacing_m);
  }
  [[nodiscard]] double distance_or(double share) const {
    return spec.distance_m > 0 ? spec.distance_m : share * side_m;
  }
  // Way through the flight, 0 at the first frame, 1 at the last.
  [[nodiscard]] double progress(int frame) const {
    return spec.frames > 1 ? static_cast<double>(frame) / (spec.frames - 1) : 0.0;
  }
};

// A straight way from the south, down to the middle: the steps shorten with the distance, as screen error
// asks.
Poses fly_approach(const Scene& scene) {
  const Vec3 target = scene.middle();
  const double height_m = scene.height_or(0.02);
  const double far_m = scene.distance_or(1.5);
  const double near_m = 0.05 * far_m;
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double left = (1 - scene.progress(f)) * (1 - scene.progress(f));
    const double distance_m = near_m + (far_m - near_m) * left;
    const double x = target.x + 0.2 * distance_m;  // askew, so that no ray runs along a grid line
    const double y = target.y - distance_m;
    const double line_m = target.z + height_m + 0.35 * (distance_m - near_m);
    poses.push_back({{x, y, std::max(line_m, scene.ground_m(x, y) + height_m)}, target});
  }
  return poses;
}

Poses fly_retreat(const Scene& scene) {
  Poses poses = fly_approach(scene);
  std::reverse(poses.begin(), poses.end());
  return poses;
}

// One round at constant elevation, looking at the middle.
Poses fly_orbit(const Scene& scene) {
  const Vec3 target = scene.middle();
  const double radius_m = scene.distance_or(0.6);
  Poses poses;
  double highest_m = target.z;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double angle = 2 * kPi * f / scene.spec.frames;
    const Vec3 p =
        scene.on_ground(target.x + radius_m * exact_cos(angle), target.y + radius_m * exact_sin(angle));
    highest_m = std::max(highest_m, p.z);
    poses.push_back({p, target});
  }
  for (CameraPose& pose : poses) pose.position.z = highest_m + scene.height_or(0.2);
  return poses;
}

// Across the terrain from south-west to north-east at constant height over the ground, looking along it.
Poses fly_skim(const Scene& scene) {
  const double height_m = scene.height_or(0.005);
  const Vec2 from{0.07 * scene.width_m, 0.12 * scene.depth_m};
  const Vec2 to{0.9 * scene.width_m, 0.84 * scene.depth_m};
  const Vec2 way = to - from;
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const Vec2 p = from + way * scene.progress(f);
    const Vec2 ahead = p + way * 0.1;
    poses.push_back(
        {scene.above_ground(p.x, p.y, height_m), scene.above_ground(ahead.x, ahead.y, height_m / 2)});
  }
  return poses;
}

// A full turn above the middle, looking a little down.
Poses fly_spin(const Scene& scene) {
  const Vec3 target = scene.middle();
  const Vec3 position{target.x, target.y, target.z + scene.height_or(0.06)};
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double angle = 2 * kPi * f / scene.spec.frames;
    const Vec3 direction{exact_cos(angle), exact_sin(angle), -0.2};
    poses.push_back({position, position + scene.side_m * direction});
  }
  return poses;
}

// The diagonal of skim, high up, looking straight down.
Poses fly_nadir(const Scene& scene) {
  const double z_m = scene.terrain.highest_m() + scene.height_or(0.4);
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double t = scene.progress(f);
    const Vec3 below = scene.on_ground((0.25 + 0.5 * t) * scene.width_m, (0.3 + 0.4 * t) * scene.depth_m);
    poses.push_back({{below.x, below.y, z_m}, below});
  }
  return poses;
}

// Cuts between far-away poses; each is held for some frames, so that what a method forgets or keeps shows.
Poses fly_teleport(const Scene& scene) {
  const int held = scene.spec.hold_frames > 0 ? scene.spec.hold_frames : 4;
  Random random(scene.spec.seed, "teleport");
  const auto draw = [&] { return Vec2{random.unit() * scene.width_m, random.unit() * scene.depth_m}; };
  // A point at least `apart_m` from `other`; two far corners always are, so a last resort exists.
  const auto draw_away_from = [&](Vec2 other, double apart_m) {
    for (int tries = 0; tries < 64; ++tries) {
      const Vec2 p = draw();
      const Vec2 d = p - other;
      if (d.x * d.x + d.y * d.y >= apart_m * apart_m) return p;
    }
    return Vec2{other.x < scene.width_m / 2 ? scene.width_m : 0,
                other.y < scene.depth_m / 2 ? scene.depth_m : 0};
  };
  Poses poses;
  Vec2 stand = draw();
  for (int f = 0; f < scene.spec.frames; ++f) {
    if (f % held != 0) {
      poses.push_back(CameraPose(poses.back()));
      continue;
    }
    stand = draw_away_from(stand, 0.4 * scene.side_m);
    const Vec2 seen = draw_away_from(stand, 0.25 * scene.side_m);
    const double height_m = random.between(0.02, 0.4) * scene.side_m;
    poses.push_back({scene.above_ground(stand.x, stand.y, height_m), scene.on_ground(seen.x, seen.y)});
  }
  return poses;
}

// One pose reached from afar and above, held, left for a place near the ground, and reached again from there.
Poses fly_two_ways(const Scene& scene) {
  const int held = scene.spec.hold_frames > 0 ? scene.spec.hold_frames : 3;
  const double way_m = scene.distance_or(0.5);
  const Vec3 target = scene.middle();
  const CameraPose pose{scene.above_ground(target.x - 0.07 * scene.side_m, target.y - 0.3 * scene.side_m,
                                           scene.height_or(0.08)),
                        target};
  // Askew, so that no ray runs along a grid line.
  const Vec3 afar = pose.position + Vec3{-0.3 * way_m, -0.9 * way_m, 0.6 * way_m};
  const double near_y = pose.position.y + 0.2 * way_m;
  const Vec3 near = scene.above_ground(pose.position.x + 0.06 * way_m, near_y, 0.5 * scene.height_or(0.08));
  const auto on_way = [&](Vec3 from, double t) {
    Vec3 p = from + (pose.position - from) * t;
    p.z = std::max(p.z, scene.ground_m(p.x, p.y) + 0.25 * scene.height_or(0.08));
    return CameraPose{p, target};
  };
  const int steps = std::max(1, (scene.spec.frames - 2 * held) / 3);
  Poses poses;
  for (int k = 0; k < steps; ++k) poses.push_back(on_way(afar, static_cast<double>(k) / steps));
  poses.insert(poses.end(), static_cast<std::size_t>(held), pose);
  for (int k = 1; k <= steps; ++k) poses.push_back(on_way(near, 1 - static_cast<double>(k) / steps));
  for (int k = 1; k < steps; ++k) poses.push_back(on_way(near, static_cast<double>(k) / steps));
  poses.resize(static_cast<std::size_t>(scene.spec.frames), pose);  // the rest holds the pose again
  return poses;
}

// Trembles on the spot: the camera and its aim shift together across the view, by what shows as jitter_px.
Poses fly_hover(const Scene& scene) {
  Random random(scene.spec.seed, "hover");
  const double jitter_px = scene.spec.jitter_px > 0 ? scene.spec.jitter_px : 0.5;
  const Vec3 target = scene.middle();
  const Vec3 position = scene.above_ground(target.x + 0.1 * scene.side_m, target.y - 0.35 * scene.side_m,
                                           scene.height_or(0.08));
  const double amplitude_m = jitter_px / scene.kappa_px * length(target - position);
  const Vec3 aside = normalized(cross(target - position, {0, 0, 1}));
  Poses poses;
  for (int f = 0; f < scene.spec.frames; ++f) {
    const double across_m = random.between(-amplitude_m, amplitude_m);
    const double up_m = random.between(-amplitude_m, amplitude_m);
    const Vec3 shift = aside * across_m + Vec3{0, 0, up_m};
    CameraPose pose{position + shift, target + shift};
    // Only a jitter as large as the height itself could dip into the ground.
    const double least_m = scene.ground_m(pose.position.x, pose.position.y) + 0.1 * scene.height_or(0.08);
    pose.position.z = std::max(pose.position.z, least_m);
    poses.push_back(pose);
  }
  return poses;
}

Poses given_poses(const Scene& scene) {
  const auto& poses = scene.spec.poses;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vec3 p = poses[k].position;
    const bool over_terrain = p.x >= 0 && p.y >= 0 && p.x <= scene.width_m && p.y <= scene.depth_m;
    if (!over_terrain) continue;  // beside it there is no ground to be in
    const double ground_m = scene.ground_m(p.x, p.y);
    if (!(p.z > ground_m)) {
      throw InputError(
          fmt::format("trajectory '{}': pose {} at ({}, {}, {}) is not above the ground, which lies at {} m "
                      "there; raise it",
                      scene.spec.id, k, p.x, p.y, p.z, ground_m));
    }
  }
  return poses;
}

struct Flight {
  TrajectoryKind kind;
  Poses (*fly)(const Scene&);
};

const std::vector<Flight>& flights() {
  static const std::vector<Flight> all{
      {{"approach",
        "from afar straight down to the middle, steps shortening",
        {"frames", "height_m", "distance_m"}},
       fly_approach},
      {{"retreat", "approach backwards", {"frames", "height_m", "distance_m"}}, fly_retreat},
      {{"orbit",
        "one round at constant elevation, looking at the middle",
        {"frames", "height_m", "distance_m"}},
       fly_orbit},
      {{"skim", "low across the terrain, following the ground, looking along it", {"frames", "height_m"}},
       fly_skim},
      {{"spin", "a full turn on the spot above the middle", {"frames", "height_m"}}, fly_spin},
      {{"nadir", "across the terrain, looking straight down", {"frames", "height_m"}}, fly_nadir},
      {{"teleport",
        "cuts to seeded far-away poses, each held for some frames",
        {"frames", "hold_frames", "seed"}},
       fly_teleport},
      {{"two_ways",
        "one pose reached from afar, held, and reached again from near",
        {"frames", "height_m", "distance_m", "hold_frames"}},
       fly_two_ways},
      {{"hover", "trembles by less than a pixel", {"frames", "height_m", "jitter_px", "seed"}}, fly_hover},
      {{"poses", "the poses given, one a frame", {"poses"}}, given_poses},
  };
  return all;
}

}  // namespace

void check_script(const TrajectorySpec& spec) {
  const bool poses = spec.kind == "poses";
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("trajectory '{}': {}", spec.id, what));
  };
  const auto check_length = [&](double value, std::string_view name) {
    if (!(value >= 0) || !std::isfinite(value)) refuse(fmt::format("{} is {}; give 0 or more", name, value));
  };
  check_length(spec.height_m, "height_m");
  check_length(spec.distance_m, "distance_m");
  check_length(spec.jitter_px, "jitter_px");
  if (spec.hold_frames < 0) refuse(fmt::format("hold_frames is {}; give 1 or more", spec.hold_frames));
  const auto count = poses ? static_cast<std::int64_t>(spec.poses.size()) : spec.frames;
  if (count < 1 || count > kMostFrames) {
    refuse(fmt::format("{} {}; give 1 to {}", count, poses ? "poses" : "frames", kMostFrames));
  }
  if (poses && spec.frames != 0 && spec.frames != count) {
    refuse(fmt::format("frames is {} for {} poses; leave it out", spec.frames, count));
  }
}

std::vector<Camera> cameras_at(const TrajectorySpec& spec, const std::vector<CameraPose>& poses,
                               double fov_y_deg, int width_px, int height_px) {
  std::vector<Camera> cameras;
  for (const CameraPose& pose : poses) {
    try {
      cameras.push_back(make_camera(pose.position, pose.look_at, fov_y_deg, width_px, height_px));
    } catch (const InputError& error) {
      throw InputError(fmt::format("trajectory '{}': pose {}: {}", spec.id, cameras.size(), error.what()));
    }
  }
  return cameras;
}

std::vector<Camera> make_trajectory(const TrajectorySpec& spec, const Terrain& terrain, double fov_y_deg,
                                    int width_px, int height_px) {
  const auto& all = flights();
  const auto flight =
      std::find_if(all.begin(), all.end(), [&](const Flight& f) { return f.kind.name == spec.kind; });
  if (flight == all.end()) {
    std::vector<std::string> names;
    for (const TrajectoryKind& kind : trajectory_kinds()) names.push_back(kind.name);
    throw InputError(fmt::format("trajectory '{}': {}", spec.id, unknown_name("kind", spec.kind, names)));
  }
  check_script(spec);
  // κ depends on the picture alone; this camera also checks the picture before any pose is made.
  const double kappa_px = make_camera({0, 0, 1}, {0, 1, 0}, fov_y_deg, width_px, height_px).kappa_px;
  const Scene scene{spec, terrain, kappa_px};
  return cameras_at(spec, flight->fly(scene), fov_y_deg, width_px, height_px);
}

const std::vector<TrajectoryKind>& trajectory_kinds() {
  static const std::vector<TrajectoryKind> kinds = [] {
    std::vector<TrajectoryKind> list;
    for (const Flight& flight : flights()) list.push_back(flight.kind);
    return list;
  }();
  return kinds;
}

}  // namespace plumbline
