// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes in suites, and flights around them.
#include "scenarios/mesh_source.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "scenarios/suite.h"
#include "support.h"

namespace plumbline {
namespace {

using test::input_error;
using testing::AllOf;
using testing::HasSubstr;

constexpr char kCube[] =
    "OFF\n8 6 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

const std::string kSuite = R"([suite]
name = "o"
[[mesh]]
id = "cubes"
file = "cube.off"
at = [[0, 0, 0], [10, 0, 0]]
scale = 0.5
[[trajectory]]
id = "in"
kind = "approach"
frames = 12
[[method]]
id = "vertex_tree"
thresholds_px = [1]
)";

class MeshSuite : public testing::Test {
 protected:
  MeshSuite() { folder_.write("cube.off", kCube); }
  Suite load(const std::string& text) { return load_suite(folder_.write("s.toml", text)); }
  std::string complaint(const std::string& from, const std::string& to) {
    std::string text = kSuite;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return input_error([&] { (void)load(text); });
  }
  ObjectScene cubes() { return load_objects(load(kSuite).meshes.at(0)); }
  test::TemporaryFolder folder_;
};

TEST_F(MeshSuite, AMeshIsReadAndItsCopiesArePlaced) {
  const Suite suite = load(kSuite);
  EXPECT_TRUE(suite.terrains.empty());
  ASSERT_EQ(suite.meshes.size(), 1u);
  EXPECT_EQ(suite.meshes[0].file, folder_.path() / "cube.off") << "relative to the suite file";
  EXPECT_EQ(suite.trajectories.at(0).around, Subject::mesh) << "there is nothing else to fly around";
  const ObjectScene scene = cubes();
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[1].triangles.size(), 12u);
  EXPECT_EQ(scene.objects[1].positions[0], (Vec3{10, 0, 0}));
  EXPECT_EQ(scene.objects[1].positions[6], (Vec3{11, 1, 1}));
  EXPECT_EQ(scene.whole.triangles.size(), 24u);
  EXPECT_EQ(scene.whole.triangles[12][0], scene.objects[1].triangles[0][0] + 8);
  EXPECT_EQ(scene.center, (Vec3{5.5, 0.5, 0.5}));
  EXPECT_EQ(scene.object_radius_m, std::sqrt(0.75));
  EXPECT_EQ(scene.radius_m, std::sqrt(5.5 * 5.5 + 0.5));
}

TEST_F(MeshSuite, WrongEntriesAreRefusedByLineAndNearestKey) {
  EXPECT_THAT(complaint("scale =", "scael ="), AllOf(HasSubstr("s.toml:7"), HasSubstr("scale")));
  EXPECT_THAT(complaint("file = \"cube.off\"", "generator = \"instrumnt\""),
              AllOf(HasSubstr("s.toml:5"), HasSubstr("instrument")));
  EXPECT_THAT(complaint("file = \"cube.off\"\n", ""), HasSubstr("exactly one of 'file', 'generator'"));
  EXPECT_THAT(complaint("[10, 0, 0]", "[10, 0]"), HasSubstr("s.toml:6"));
  EXPECT_THAT(complaint("scale = 0.5", "scale = -1"), HasSubstr("s.toml:7"));
  EXPECT_THAT(complaint("at = [[0, 0, 0], [10, 0, 0]]", "at = []"), HasSubstr("0 places"));
  EXPECT_THAT(complaint("\"approach\"", "\"skim\""), HasSubstr("flies over terrains only"));
  EXPECT_THAT(complaint("frames = 12", "frames = 12\nheight_m = 3"), HasSubstr("around a mesh"));
  EXPECT_THAT(complaint("frames = 12", "frames = 12\ndistance_radii = 0.5"), HasSubstr("more than 1"));
  EXPECT_THAT(complaint("frames = 12", "frames = 12\naround = \"terrain\""),
              HasSubstr("no trajectory flies around the meshes"));
  EXPECT_THAT(complaint("frames = 12", "frames = 12\naround = \"messh\""),
              HasSubstr("did you mean \"mesh\""));
}

TEST_F(MeshSuite, MeshesThatCannotBeUsedAreRefused) {
  const auto load_source = [&](const std::string& name, const std::string& bytes, double scale) {
    MeshSource source;
    source.id = "m";
    source.file = bytes.empty() ? folder_.path() / name : folder_.write(name, bytes);
    source.scale = scale;
    return input_error([&] { (void)load_objects(source); });
  };
  EXPECT_THAT(load_source("gone.off", "", 1), AllOf(HasSubstr("mesh 'm'"), HasSubstr("gone.off")));
  EXPECT_THAT(load_source("none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", 1), HasSubstr("triangle"));
  EXPECT_THAT(load_source("point.off", "OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n", 1),
              HasSubstr("one point"));
  EXPECT_THAT(load_source("far.off", kCube, 1e9), HasSubstr("would stand at"));
}

/// Pixels that the ball around the nearest copy spans.
double size_px(const Camera& camera, const ObjectScene& scene) {
  double most = 0;
  for (const Mesh& object : scene.objects) {
    const Vec3 center = (object.positions[0] + object.positions[6]) * 0.5;
    const double d = length(center - camera.position), r = scene.object_radius_m;
    most = std::max(most, 2 * camera.kappa_px * r / std::sqrt(d * d - r * r));
  }
  return most;
}

TEST_F(MeshSuite, ApproachAndRetreatCrossEveryRungWhateverTheViewport) {
  const ObjectScene scene = cubes();  // two of them: the foremost one is flown at
  TrajectorySpec spec;
  spec.id = "t";
  spec.around = Subject::mesh;
  spec.frames = 12;
  for (const int height_px : {64, 360, 2160}) {
    for (const char* kind : {"approach", "retreat"}) {
      spec.kind = kind;
      const std::vector<Camera> cameras = make_trajectory(spec, scene, 60, 2 * height_px, height_px);
      ASSERT_EQ(cameras.size(), 12u);
      std::set<int> rungs;  // how many of the ladder's rungs lie below
      for (const Camera& camera : cameras) {
        int below = 0;
        for (const double rung_px : {100.0, 150.0, 200.0, 250.0, 300.0})
          below += size_px(camera, scene) > rung_px ? 1 : 0;
        rungs.insert(below);
      }
      EXPECT_EQ(rungs, (std::set<int>{0, 1, 2, 3, 4, 5})) << kind << " at " << height_px;
      const double first = size_px(cameras.front(), scene), last = size_px(cameras.back(), scene);
      EXPECT_EQ(first < last, std::string(kind) == "approach");
    }
  }
}

TEST_F(MeshSuite, EveryKindStaysOutsideTheBallAndIsReproducible) {
  const ObjectScene scene = cubes();
  TrajectorySpec spec;
  spec.id = "t";
  spec.around = Subject::mesh;
  for (const TrajectoryKind& kind : trajectory_kinds_around_mesh()) {
    spec.kind = kind.name;
    spec.frames = kind.name == "poses" ? 0 : 15;
    if (kind.name == "poses") spec.poses.assign(15, {{30, 2, 3}, {0, 0, 0}});
    const std::vector<Camera> cameras = make_trajectory(spec, scene, 60, 320, 180);
    const std::vector<Camera> again = make_trajectory(spec, scene, 60, 320, 180);
    ASSERT_EQ(cameras.size(), 15u) << kind.name;
    for (std::size_t f = 0; f < cameras.size(); ++f) {
      for (const Vec3& center : scene.centers) {
        EXPECT_GE(length(cameras[f].position - center), scene.object_radius_m) << kind.name << " frame " << f;
      }
      EXPECT_EQ(cameras[f].position, again[f].position);
      EXPECT_EQ(cameras[f].forward, again[f].forward);
    }
  }
}

TEST_F(MeshSuite, AFarEndNearerThanTheNearOneIsRefused) {
  const ObjectScene scene = cubes();
  TrajectorySpec spec;
  spec.id = "t";
  spec.kind = "approach";
  spec.around = Subject::mesh;
  spec.frames = 3;
  spec.distance_radii = 1.0001;
  EXPECT_THAT(input_error([&] { (void)make_trajectory(spec, scene, 60, 320, 180); }),
              HasSubstr("distance_radii is 1.0001"));
  spec.kind = "skim";
  EXPECT_THAT(input_error([&] { (void)make_trajectory(spec, scene, 60, 320, 180); }),
              HasSubstr("does not fly around a mesh"));
}

}  // namespace
}  // namespace plumbline
