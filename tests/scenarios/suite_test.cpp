// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/suite.h"

#include <set>
#include <string>

#include "support.h"

namespace plumbline {
namespace {

using test::input_error;

const std::filesystem::path kSuites = std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenarios/suites";

// A suite that loads; the tests change one line of it.
const std::string kGood = R"(# line 1
[suite]
name = "test"
viewport = [320, 180]
fov_y_deg = 50.5

[[terrain]]
id = "real"
file = "dem/a.tif"
size = 513
fit = "crop"
holes = "fill"
z_scale = 2

[[terrain]]
id = "made"
generator = "fbm"
seed = 9
size = 65
spacing_m = 12.5
relief_m = 300

[[terrain]]
id = "typed"
samples = [[1, 2, 3], [4, 5, 6]]
spacing_m = 10

[[trajectory]]
id = "round"
kind = "orbit"
frames = 8
height_m = 100
distance_m = 2000

[[trajectory]]
id = "given"
kind = "poses"
poses = [{ position = [1, 2, 300], look_at = [4.5, 5, 6] }]

[[method]]
id = "full"
thresholds_px = [1]

[[method]]
id = "block_bintree:tri_cull"
thresholds_px = [0.5, 2]
options = { blocks = 4, culling = true, mode = "far" }

[gate]
crack = 0
displacement_px.p99 = "<= 1.5 tau"
"pop_px.max" = " <  0.5 "

[gate.full]
vertical_m.max = "== 0"

[gate."block_bintree:tri_cull"]
triangles = ">= 2"
)";

class SuiteFile : public testing::Test {
 protected:
  Suite load(const std::string& text) { return load_suite(folder_.write("s.toml", text)); }
  /// The complaint after replacing `from` by `to` in the good suite, without the folder's name.
  std::string complaint(const std::string& from, const std::string& to) {
    std::string text = kGood;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::string message = input_error([&] { (void)load(text); });
    const std::string folder = folder_.path().string() + "/";
    EXPECT_EQ(message.substr(0, folder.size()), folder) << message;
    return message.substr(std::min(folder.size(), message.size()));
  }
  test::TemporaryFolder folder_;
};

TEST_F(SuiteFile, EverythingIsRead) {
  const Suite suite = load(kGood);
  EXPECT_EQ(suite.name, "test");
  EXPECT_EQ(suite.path, folder_.path() / "s.toml");
  EXPECT_EQ(suite.width_px, 320);
  EXPECT_EQ(suite.height_px, 180);
  EXPECT_EQ(suite.fov_y_deg, 50.5);
  ASSERT_EQ(suite.terrains.size(), 3u);
  EXPECT_EQ(suite.terrains[0].file, folder_.path() / "dem/a.tif") << "relative to the suite file";
  EXPECT_EQ(suite.terrains[0].size, 513);
  EXPECT_EQ(suite.terrains[0].fit, FitRule::crop);
  EXPECT_EQ(suite.terrains[0].holes, HolePolicy::fill);
  EXPECT_EQ(suite.terrains[0].z_scale, 2);
  EXPECT_EQ(suite.terrains[1].generator, "fbm");
  EXPECT_EQ(suite.terrains[1].seed, 9u);
  EXPECT_EQ(suite.terrains[1].spacing_m, 12.5);
  EXPECT_EQ(suite.terrains[1].relief_m, 300);
  EXPECT_EQ(suite.terrains[2].samples, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(suite.terrains[2].columns, 3);
  EXPECT_EQ(suite.terrains[2].rows, 2);
  ASSERT_EQ(suite.trajectories.size(), 2u);
  EXPECT_EQ(suite.trajectories[0].kind, "orbit");
  EXPECT_EQ(suite.trajectories[0].frames, 8);
  EXPECT_EQ(suite.trajectories[0].height_m, 100);
  EXPECT_EQ(suite.trajectories[0].distance_m, 2000);
  EXPECT_EQ(suite.trajectories[1].poses.at(0).look_at, (Vec3{4.5, 5, 6}));
  ASSERT_EQ(suite.methods.size(), 2u);
  EXPECT_EQ(suite.methods[1].id, "block_bintree:tri_cull");
  EXPECT_EQ(suite.methods[1].thresholds_px, (std::vector<double>{0.5, 2}));
  EXPECT_EQ(std::get<double>(suite.methods[1].options.at("blocks")), 4);
  EXPECT_EQ(std::get<bool>(suite.methods[1].options.at("culling")), true);
  EXPECT_EQ(std::get<std::string>(suite.methods[1].options.at("mode")), "far");
}

TEST_F(SuiteFile, GatesAreRead) {
  const Suite suite = load(kGood);
  ASSERT_EQ(suite.gates.size(), 5u);
  const auto texts = [&] {
    std::vector<std::string> all;
    for (const GateSpec& gate : suite.gates) all.push_back(gate.method + "|" + gate.text);
    return all;
  }();
  EXPECT_EQ(texts,
            (std::vector<std::string>{"|crack == 0", "|displacement_px.p99 <= 1.5 tau", "|pop_px.max < 0.5",
                                      "full|vertical_m.max == 0", "block_bintree:tri_cull|triangles >= 2"}));
  EXPECT_EQ(suite.gates[1].figure, "displacement_px.p99");
  EXPECT_EQ(suite.gates[1].comparison, "<=");
  EXPECT_EQ(suite.gates[1].bound, 1.5);
  EXPECT_TRUE(suite.gates[1].times_tau);
  EXPECT_FALSE(suite.gates[2].times_tau);
}

TEST_F(SuiteFile, NativeSizeIsNoSize) {
  std::string text = kGood;
  text.replace(text.find("size = 513\nfit = \"crop\""), 23, "size = \"native\"");
  EXPECT_FALSE(load(text).terrains[0].size.has_value());
}

TEST_F(SuiteFile, ComplaintsNameLineKeyAndMending) {
  const struct {
    const char *from, *to, *message;
  } cases[] = {
      {"viewport", "viewprot", "s.toml:4: unknown key 'viewprot' in [suite]; did you mean 'viewport'?"},
      {"[[method]]\nid = \"full\"", "[[metod]]\nid = \"full\"",
       "s.toml:40: unknown key 'metod' in the top level; did you mean 'method'?"},
      {"relief_m = 300", "constraint = \"roads\"",
       "s.toml:21: unknown key 'constraint' in [[terrain]]; did you mean 'constraints'?"},
      {"seed = 9", "sede = 9", "s.toml:18: unknown key 'sede' in [[terrain]]; did you mean 'seed'?"},
      {"name = \"test\"", "", "s.toml:2: [suite] has no 'name'; add one"},
      {"[320, 180]", "[320]",
       "s.toml:4: 'viewport' in [suite] has 1 elements; give [width, height] in pixels"},
      {"[320, 180]", "[0, 180]", "s.toml:4: 'viewport' in [suite] is 0; give an integer from 1 to 16384"},
      {"50.5", "180", "s.toml:5: 'fov_y_deg' in [suite] is 180; give degrees below 180"},
      {"id = \"made\"", "id = \"real\"",
       "s.toml:16: 'id' in [[terrain]] repeats \"real\"; give each its own id"},
      {"id = \"made\"", "id = \"a/b\"",
       "s.toml:16: 'id' in [[terrain]] is \"a/b\"; use 1 to 64 of the characters A-Z a-z 0-9 _ . -"},
      {"id = \"round\"", "id = 3",
       "s.toml:29: 'id' in [[trajectory]] is an integer; give a string in quotes"},
      {"\"fbm\"", "\"fmb\"", "s.toml:17: 'generator' in [[terrain]] is \"fmb\"; did you mean \"fbm\"?"},
      {"generator = \"fbm\"", "",
       "s.toml:15: [[terrain]] needs exactly one of 'file', 'points', 'generator', 'samples'"},
      {"seed = 9", "file = \"x\"",
       "s.toml:15: [[terrain]] needs exactly one of 'file', 'points', 'generator', 'samples'"},
      {"seed = 9", "holes = \"crop\"",
       "s.toml:18: 'holes' in [[terrain]] does not apply to a generator; leave it out"},
      {"z_scale = 2", "seed = 2", "s.toml:13: 'seed' in [[terrain]] does not apply to a file; leave it out"},
      {"z_scale = 2", "spacing_m = 2",
       "s.toml:13: 'spacing_m' in [[terrain]] contradicts fit = \"crop\", which keeps the raster's own; "
       "leave one out"},
      {"size = 65", "size = 16386",
       "s.toml:19: 'size' in [[terrain]] is 16386; give an integer from 2 to 16385"},
      {"size = 65", "size = \"native\"", "s.toml:19: 'size' in [[terrain]] is \"native\"; give an integer"},
      {"size = 513", "", "s.toml:11: 'fit' in [[terrain]] needs a size; say how many samples to keep"},
      {"\"fill\"", "\"fil\"", "s.toml:12: 'holes' in [[terrain]] is \"fil\"; did you mean \"fill\"?"},
      {"[4, 5, 6]]", "[4, 5]]",
       "s.toml:25: 'samples' in [[terrain]] has rows of 3 and 2 samples; make all rows equal"},
      {"[4, 5, 6]]", "[4, 5, nan]]",
       "s.toml:25: 'samples' in [[terrain]] is not finite; give a finite number"},
      {"spacing_m = 12.5", "spacing_m = 0",
       "s.toml:20: 'spacing_m' in [[terrain]] is 0; give a number from 1e-06 to 1000000"},
      {"\"orbit\"", "\"orbt\"", "s.toml:30: 'kind' in [[trajectory]] is \"orbt\"; did you mean \"orbit\"?"},
      {"frames = 8", "frames = 0",
       "s.toml:31: 'frames' in [[trajectory]] is 0; give an integer from 1 to 100000"},
      {"frames = 8", "", "s.toml:28: [[trajectory]] has no 'frames'; add one"},
      {"height_m = 100", "jitter_px = 1",
       "s.toml:32: 'jitter_px' in [[trajectory]] does not apply to kind \"orbit\"; leave it out"},
      {"height_m = 100", "height_m = -1",
       "s.toml:32: 'height_m' in [[trajectory]] is -1; give a number above 0"},
      {"look_at = [4.5, 5, 6]", "look_at = [4.5, 5]",
       "s.toml:38: 'look_at' in [[trajectory.poses]] has 2 elements; give 3 numbers"},
      {"look_at =", "lookat =",
       "s.toml:38: unknown key 'lookat' in [[trajectory.poses]]; did you mean 'look_at'?"},
      {"[1]", "[0]", "s.toml:42: 'thresholds_px' in [[method]] is 0; give a number above 0"},
      {"[1]", "[inf]", "s.toml:42: 'thresholds_px' in [[method]] is not finite; give a finite number"},
      {"[1]", "[]", "s.toml:42: 'thresholds_px' in [[method]] is empty; give at least one number above 0"},
      {"[1]", "[1, 1.0]", "s.toml:42: 'thresholds_px' in [[method]] repeats 1; name each threshold once"},
      {"crack = 0", "crak = 0", "s.toml:50: 'crak' in [gate] limits no known figure; did you mean 'crack'?"},
      {"displacement_px.p99", "displacement_px.p98",
       "s.toml:51: 'p98' in [gate.displacement_px] limits no known figure; did you mean "
       "'displacement_px.p99'?"},
      {"<= 1.5 tau", "1.5 tau",
       "s.toml:51: 'p99' in [gate.displacement_px] is \"1.5 tau\"; give a limit like 0, \"< 0.5\" or \"<= 1 "
       "tau\""},
      {"<= 1.5 tau", "<= 1.5 taus",
       "s.toml:51: 'p99' in [gate.displacement_px] is \"<= 1.5 taus\"; give a limit like 0, \"< 0.5\" or "
       "\"<= 1 tau\""},
      {"<= 1.5 tau", "<= inf",
       "s.toml:51: 'p99' in [gate.displacement_px] is \"<= inf\"; give a limit like 0, \"< 0.5\" or \"<= 1 "
       "tau\""},
      {"crack = 0", "crack = true",
       "s.toml:50: 'crack' in [gate] is neither number nor string; give a limit like 0 or \"<= 1 tau\""},
      {"\"pop_px.max\"", "crack", "s.toml:52: not valid TOML: "},
      {"\"pop_px.max\" = \" <  0.5 \"", "\"displacement_px.p99\" = 1",
       "s.toml:52: 'displacement_px.p99' in [gate] is limited twice; keep one of the limits"},
      {"[gate.full]", "[gate.fool]",
       "s.toml:54: 'fool' in [gate] names no method of this suite; did you mean 'full'?"},
  };
  for (const auto& c : cases) {
    EXPECT_THAT(complaint(c.from, c.to), testing::StartsWith(c.message)) << c.from << " -> " << c.to;
  }
}

TEST_F(SuiteFile, EmptyListsAndMissingTables) {
  EXPECT_THAT(input_error([&] { (void)load(""); }), testing::HasSubstr("has no 'suite'; add one"));
  EXPECT_THAT(input_error([&] { (void)load("[suite]\nname = \"x\"\n"); }),
              testing::HasSubstr("add a [[terrain]]"));
  EXPECT_THAT(input_error([&] { (void)load("terrain = []\n[suite]\nname = \"x\"\n"); }),
              testing::HasSubstr("add a [[terrain]]"));
  EXPECT_THAT(input_error([&] { (void)load_suite(folder_.path() / "none.toml"); }),
              testing::HasSubstr("no such file; check the path"));
}

TEST_F(SuiteFile, RunIdsStayDistinct) {
  const std::string head = "[suite]\nname = \"x\"\n[[method]]\nid = \"full\"\nthresholds_px = [1]\n";
  const auto terrain = [](const std::string& id) {
    return "[[terrain]]\ngenerator = \"plane\"\nid = \"" + id + "\"\n";
  };
  const auto flight = [](const std::string& id) {
    return "[[trajectory]]\nkind = \"spin\"\nframes = 1\nid = \"" + id + "\"\n";
  };
  EXPECT_THAT(
      input_error([&] { (void)load(head + terrain("a.b") + terrain("a") + flight("c") + flight("b.c")); }),
      testing::HasSubstr("two runs would be called \"a.b.c.full.1\""));
}

TEST(ShippedSuites, LoadAndCoverWhatTheyPromise) {
  const Suite suite = load_suite(kSuites / "default.toml");
  std::set<std::string> kinds;
  for (const TrajectorySpec& trajectory : suite.trajectories) {
    if (trajectory.around == Subject::mesh) continue;
    kinds.insert(trajectory.kind);
    for (const TerrainSource& source : suite.terrains) {
      const Terrain terrain = load_terrain(source);
      EXPECT_EQ(make_trajectory(trajectory, terrain, suite.fov_y_deg, suite.width_px, suite.height_px).size(),
                static_cast<std::size_t>(trajectory.frames));
    }
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"approach", "hover", "nadir", "orbit", "retreat", "skim", "spin",
                                          "teleport", "two_ways"}));
  EXPECT_FALSE(suite.terrains.at(0).file.empty()) << "the first terrain is real";
  std::set<std::string> methods;
  for (const MethodSpec& method : suite.methods) methods.insert(method.id);
  EXPECT_EQ(methods,
            (std::set<std::string>{"block_bintree", "edge_collapse", "full", "full:alternating", "greedy_tin",
                                   "haar_quadtree", "haar_quadtree:morph", "isolated_quadtree",
                                   "isolated_quadtree:no_cos", "meshopt", "restricted_quadtree", "ring_tin",
                                   "ring_tin:guarded", "vertex_tree", "vertex_tree:no_contour"}));
  EXPECT_EQ(suite.meshes.at(0).id, "instrument");
  EXPECT_FALSE(suite.gates.empty());

  const Suite steep = load_suite(kSuites / "steep.toml");
  EXPECT_FALSE(steep.gates.empty());

  const Suite smoke = load_suite(kSuites / "smoke.toml");
  for (const TerrainSource& source : smoke.terrains)
    EXPECT_TRUE(source.file.empty()) << "needs no other file";
}

}  // namespace
}  // namespace plumbline
