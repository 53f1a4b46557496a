// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/trajectory.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "scenarios/terrain_source.h"
#include "support.h"

namespace plumbline {
namespace {

using test::input_error;
using testing::HasSubstr;

constexpr int kWidthPx = 640;
constexpr int kHeightPx = 360;

Terrain generated(const std::string& generator, int size = 65) {
  TerrainSource source;
  source.id = "t";
  source.generator = generator;
  source.size = size;
  return load_terrain(source);
}

std::vector<Camera> fly(const TrajectorySpec& spec, const Terrain& terrain) {
  return make_trajectory(spec, terrain, 60, kWidthPx, kHeightPx);
}

TrajectorySpec script(const std::string& kind, int frames = 12) {
  TrajectorySpec spec;
  spec.id = kind;
  spec.kind = kind;
  if (kind == "poses") {
    spec.poses = {{{100, 100, 5000}, {900, 900, 0}}, {{500, 100, 6000}, {500, 900, 0}}};
  } else {
    spec.frames = frames;
  }
  return spec;
}

double above_ground_m(const Camera& camera, const Terrain& terrain) {
  return camera.position.z - terrain.surface_height_m(camera.position.x, camera.position.y);
}

TEST(Trajectories, EveryKindStaysAboveEveryGround) {
  for (const GeneratorDescription& generator : terrain_generators()) {
    for (const int size : {2, 5, 65}) {
      const Terrain terrain = generated(generator.name, size);
      for (const TrajectoryKind& kind : trajectory_kinds()) {
        const TrajectorySpec spec = script(kind.name, 40);
        const std::vector<Camera> cameras = fly(spec, terrain);
        ASSERT_EQ(cameras.size(), kind.name == "poses" ? 2u : 40u);
        for (const Camera& camera : cameras) {
          ASSERT_GT(above_ground_m(camera, terrain), 0)
              << kind.name << " over " << generator.name << " " << size;
          ASSERT_NEAR(length(camera.forward), 1, 1e-12);
        }
      }
    }
  }
}

const std::map<std::string, std::uint64_t> kGolden{
    {"approach", 0x6c5b505534441177}, {"retreat", 0x86db3bd9fe4a3f9f},  {"orbit", 0x70b4681f59ff8150},
    {"skim", 0x1d9b8cb1453cb879},     {"spin", 0xb3a2b7255eb84be6},     {"nadir", 0x8666943e97e27b9f},
    {"teleport", 0x7316e8686d310235}, {"two_ways", 0x668d5669c82898c7}, {"hover", 0xb536374f4f1876a6},
    {"poses", 0x2c77eaf7643abcb9},
};

TEST(Trajectories, SameBitsWithEveryCompilerAndBuild) {
  const Terrain terrain = generated("fbm");
  for (const TrajectoryKind& kind : trajectory_kinds()) {
    test::BitHash hash;
    for (const Camera& camera : fly(script(kind.name), terrain)) {
      hash.add(camera.position);
      hash.add(camera.forward);
      hash.add(camera.up);
      hash.add(camera.kappa_px);
    }
    EXPECT_TRUE(kGolden.contains(kind.name)) << kind.name << " has no golden hash";
    EXPECT_EQ(hash.value(), kGolden.contains(kind.name) ? kGolden.at(kind.name) : 0)
        << kind.name << std::hex << " gives 0x" << hash.value();
  }
}

TEST(Trajectories, OneFrameIsEnough) {
  const Terrain terrain = generated("fbm");
  for (const TrajectoryKind& kind : trajectory_kinds()) {
    if (kind.name != "poses") {
      EXPECT_EQ(fly(script(kind.name, 1), terrain).size(), 1u) << kind.name;
    }
  }
}

TEST(Trajectories, TerrainIsSeen) {
  const Terrain terrain = generated("fbm");
  for (const TrajectoryKind& kind : trajectory_kinds()) {
    int seen = 0;
    const std::vector<Camera> cameras = fly(script(kind.name), terrain);
    for (const Camera& camera : cameras) {
      bool any = false;
      for (int j = 0; j < terrain.rows && !any; ++j) {
        for (int i = 0; i < terrain.columns && !any; ++i) any = camera.sees(terrain.point(i, j));
      }
      seen += any ? 1 : 0;
    }
    EXPECT_EQ(seen, static_cast<int>(cameras.size())) << kind.name;
  }
}

TEST(Trajectories, RetreatIsApproachBackwards) {
  const Terrain terrain = generated("ridged");
  std::vector<Camera> approach = fly(script("approach"), terrain);
  const std::vector<Camera> retreat = fly(script("retreat"), terrain);
  std::reverse(approach.begin(), approach.end());
  for (std::size_t f = 0; f < approach.size(); ++f) {
    EXPECT_EQ(approach[f].position, retreat[f].position);
    EXPECT_EQ(approach[f].forward, retreat[f].forward);
  }
}

TEST(Trajectories, ApproachComesNearer) {
  const Terrain terrain = generated("plane");
  const Vec3 middle{terrain.width_m() / 2, terrain.depth_m() / 2, 0};
  double previous_m = INFINITY;
  for (const Camera& camera : fly(script("approach"), terrain)) {
    EXPECT_LT(length(camera.position - middle), previous_m);
    previous_m = length(camera.position - middle);
  }
  EXPECT_LT(previous_m, 0.1 * terrain.width_m());
}

TEST(Trajectories, OrbitKeepsRadiusAndElevation) {
  const Terrain terrain = generated("fbm");
  TrajectorySpec spec = script("orbit");
  spec.distance_m = 700;
  spec.height_m = 50;
  const std::vector<Camera> cameras = fly(spec, terrain);
  for (const Camera& camera : cameras) {
    const double x = camera.position.x - terrain.width_m() / 2;
    const double y = camera.position.y - terrain.depth_m() / 2;
    EXPECT_NEAR(std::sqrt(x * x + y * y), 700, 1e-9);
    EXPECT_EQ(camera.position.z, cameras[0].position.z);
    EXPECT_GE(above_ground_m(camera, terrain), 50 - 1e-9);
  }
}

TEST(Trajectories, SkimFollowsTheGround) {
  const Terrain terrain = generated("ridged");
  TrajectorySpec spec = script("skim");
  spec.height_m = 20;
  for (const Camera& camera : fly(spec, terrain)) EXPECT_NEAR(above_ground_m(camera, terrain), 20, 1e-9);
}

TEST(Trajectories, SpinTurnsOnTheSpot) {
  const std::vector<Camera> cameras = fly(script("spin", 4), generated("fbm"));
  for (const Camera& camera : cameras) EXPECT_EQ(camera.position, cameras[0].position);
  EXPECT_NEAR(cameras[0].forward.x, -cameras[2].forward.x, 1e-12);
  EXPECT_NEAR(cameras[1].forward.y, -cameras[3].forward.y, 1e-12);
  EXPECT_GT(cameras[1].forward.y, 0.9);
}

TEST(Trajectories, NadirLooksStraightDown) {
  const std::vector<Camera> cameras = fly(script("nadir"), generated("fbm"));
  for (const Camera& camera : cameras) EXPECT_EQ(camera.forward, (Vec3{0, 0, -1}));
  EXPECT_NE(cameras.front().position.x, cameras.back().position.x);
}

TEST(Trajectories, TeleportHoldsAndJumps) {
  const Terrain terrain = generated("fbm");
  const std::vector<Camera> cameras = fly(script("teleport"), terrain);
  for (std::size_t f = 1; f < cameras.size(); ++f) {
    const Vec3 way = cameras[f].position - cameras[f - 1].position;
    const double plan_m = std::sqrt(way.x * way.x + way.y * way.y);
    if (f % 4 != 0) {
      EXPECT_EQ(plan_m, 0);
    } else {
      EXPECT_GE(plan_m, 0.4 * terrain.width_m() - 1e-9);
    }
  }
  TrajectorySpec other = script("teleport");
  other.seed = 2;
  EXPECT_NE(fly(other, terrain)[0].position, cameras[0].position);
}

// What the jitter is named after: the picture's middle moves by at most so many pixels a side.
TEST(Trajectories, HoverMovesByLessThanItsJitter) {
  const Terrain terrain = generated("fbm");
  TrajectorySpec spec = script("hover", 50);
  spec.jitter_px = 0.25;
  const Vec3 middle{terrain.width_m() / 2, terrain.depth_m() / 2,
                    terrain.surface_height_m(terrain.width_m() / 2, terrain.depth_m() / 2)};
  double largest_px = 0;
  for (const Camera& camera : fly(spec, terrain)) {
    const Vec2 p = camera.project(middle);
    largest_px = std::max({largest_px, std::fabs(p.x - kWidthPx / 2.0), std::fabs(p.y - kHeightPx / 2.0)});
  }
  EXPECT_LE(largest_px,
            0.26);  // the shift is a length in space: perspective bends it by the jitter's own square
  EXPECT_GT(largest_px, 0.2);
}

TEST(Trajectories, TwoWaysHoldsOnePoseTwice) {
  const Terrain terrain = generated("fbm");
  for (const int frames : {8, 15, 16, 40}) {
    const std::vector<Camera> cameras = fly(script("two_ways", frames), terrain);
    ASSERT_EQ(cameras.size(), static_cast<std::size_t>(frames));
    const Camera& held = cameras.back();
    std::vector<int> visits;  // runs of frames at the pose
    bool there = false;
    for (const Camera& camera : cameras) {
      const bool now = camera.position == held.position && camera.forward == held.forward;
      if (now && !there) visits.push_back(0);
      if (now) ++visits.back();
      there = now;
    }
    ASSERT_EQ(visits.size(), 2u) << frames;
    EXPECT_EQ(visits[0], 3);
    EXPECT_GE(visits[1], 3);
    // From afar first, then from near.
    EXPECT_GT(length(cameras.front().position - held.position), 0.2 * terrain.width_m());
  }
}

TEST(Trajectories, TeleportHoldsAsLongAsAsked) {
  const Terrain terrain = generated("fbm");
  TrajectorySpec spec = script("teleport", 24);
  spec.hold_frames = 8;
  const std::vector<Camera> cameras = fly(spec, terrain);
  for (std::size_t f = 1; f < cameras.size(); ++f) {
    EXPECT_EQ(cameras[f].position == cameras[f - 1].position, f % 8 != 0) << f;
  }
}

TEST(Trajectories, GivenPoses) {
  const Terrain terrain = generated("plane");
  TrajectorySpec spec = script("poses");
  EXPECT_EQ(fly(spec, terrain)[1].position, (Vec3{500, 100, 6000}));
  spec.poses[1].position.z = -1;
  EXPECT_EQ(input_error([&] { (void)fly(spec, terrain); }),
            "trajectory 'poses': pose 1 at (500, 100, -1) is not above the ground, which lies at 0 m there; "
            "raise it");
  spec.poses[1].position.z = 0;
  EXPECT_THAT(input_error([&] { (void)fly(spec, terrain); }), HasSubstr("is not above the ground"));
  spec.poses[1].position = {-10, 100, -1};
  EXPECT_EQ(fly(spec, terrain).size(), 2u) << "beside the terrain there is no ground";
  spec.poses[1].position.z = std::nan("");
  EXPECT_THAT(input_error([&] { (void)fly(spec, terrain); }),
              HasSubstr("'poses': pose 1: camera: a coordinate is not"));
  spec.poses[1].position = spec.poses[1].look_at;
  EXPECT_THAT(input_error([&] { (void)fly(spec, terrain); }), HasSubstr("pose 1"));
}

TEST(Trajectories, BadScripts) {
  const Terrain terrain = generated("plane", 5);
  const auto message = [&](auto change) {
    TrajectorySpec spec = script("orbit");
    spec.id = "x";
    change(spec);
    return input_error([&] { (void)fly(spec, terrain); });
  };
  EXPECT_EQ(message([](TrajectorySpec& s) { s.kind = "orbti"; }),
            "trajectory 'x': unknown kind 'orbti'; did you mean 'orbit'?");
  EXPECT_EQ(message([](TrajectorySpec& s) { s.frames = 0; }), "trajectory 'x': 0 frames; give 1 to 100000");
  EXPECT_EQ(message([](TrajectorySpec& s) { s.frames = 100'001; }),
            "trajectory 'x': 100001 frames; give 1 to 100000");
  EXPECT_EQ(message([](TrajectorySpec& s) { s.height_m = -1; }),
            "trajectory 'x': height_m is -1; give 0 or more");
  EXPECT_EQ(message([](TrajectorySpec& s) { s.hold_frames = -1; }),
            "trajectory 'x': hold_frames is -1; give 1 or more");
  EXPECT_EQ(message([](TrajectorySpec& s) { s.distance_m = INFINITY; }),
            "trajectory 'x': distance_m is inf; give 0 or more");
  EXPECT_EQ(message([](TrajectorySpec& s) {
              s.kind = "poses";
              s.frames = 0;
            }),
            "trajectory 'x': 0 poses; give 1 to 100000");
  EXPECT_THAT(input_error([&] { (void)make_trajectory(script("orbit"), terrain, 180, 640, 360); }),
              HasSubstr("field of view 180"));
  EXPECT_THAT(input_error([&] { (void)make_trajectory(script("orbit"), terrain, 60, 0, 360); }),
              HasSubstr("viewport side 0"));
}

}  // namespace
}  // namespace plumbline
