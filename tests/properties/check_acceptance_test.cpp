// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The acceptance list of `plumbline check`: what users complained about in public (tests/data/check/README.md
// has their words), each as the smallest files with that defect, the verdict that would have helped, and a
// near twin without it. PLUMBLINE_WRITE_GOLDEN=1 writes the files anew.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/check/check.h"
#include "reports/check_report.h"
#include "scenarios/error.h"
#include "scenarios/whole_file.h"
#include "tests/properties/acceptance_corpus.h"

namespace plumbline {
namespace {

using oracle::FindingCode;
using oracle::Severity;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;
using verdict::CheckFinding;
using verdict::CheckVerdict;
using verdict::SeamState;
namespace fs = std::filesystem;

const fs::path kData = fs::path(PLUMBLINE_SOURCE_DIR) / "tests/data/check";

/// What is given to `plumbline check`: a file, a folder of tiles, or all meshes of a folder.
CheckRequest request(const std::string& name) {
  CheckRequest out;
  out.pictures = false;
  const fs::path path = kData / name;
  if (!fs::is_directory(path) || fs::exists(path / "layer.json")) {
    out.inputs = {path};
    return out;
  }
  for (const auto& file : fs::directory_iterator(path)) out.inputs.push_back(file.path());
  std::sort(out.inputs.begin(), out.inputs.end());
  return out;
}

CheckVerdict judged(const CheckRequest& asked) { return check(asked).verdict; }
CheckVerdict judged(const std::string& name) { return judged(request(name)); }

/// What the terminal shows, in one line.
std::string said(const CheckVerdict& verdict) {
  std::string text = reports::check_text(verdict), out;
  for (const char c : text) {
    if ((c == ' ' || c == '\n') && !out.empty() && out.back() == ' ') continue;
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

const CheckFinding* find(const CheckVerdict& verdict, FindingCode code, std::string_view kind = {}) {
  for (const CheckFinding& found : verdict.findings) {
    if (found.finding.code == code && (kind.empty() || found.finding.kind == kind)) return &found;
  }
  return nullptr;
}

std::string file(const CheckVerdict& verdict, std::uint32_t mesh) {
  return mesh < verdict.meshes.size() ? fs::path(verdict.meshes[mesh].file).filename().string() : "none";
}

std::set<std::string> kinds(const CheckVerdict& verdict) {
  std::set<std::string> out;
  for (const CheckFinding& found : verdict.findings)
    out.insert(std::string(oracle::finding_name(found.finding.code)) +
               (found.finding.kind.empty() ? "" : ":" + found.finding.kind));
  return out;
}

void expect_clean(const CheckVerdict& verdict) {
  EXPECT_TRUE(verdict.sound) << said(verdict);
  EXPECT_THAT(kinds(verdict), testing::IsEmpty()) << said(verdict);
  EXPECT_EQ(verdict.conformity.total(), 0u);
}

/// The only seam.
const verdict::SeamVerdict& seam(const CheckVerdict& verdict) {
  EXPECT_EQ(verdict.seams.size(), 1u);
  return verdict.seams.at(0);
}

TEST(CheckAcceptance, FilesAreWhatTheirGeneratorWrites) {
  const test::Files files = test::acceptance_corpus();
  std::size_t bytes = 0;
  for (const auto& [name, text] : files) {
    if (std::getenv("PLUMBLINE_WRITE_GOLDEN") != nullptr) write_whole_file(kData / name, text);
    ASSERT_TRUE(fs::exists(kData / name)) << name << ": PLUMBLINE_WRITE_GOLDEN=1 writes it";
    EXPECT_EQ(read_whole_file(kData / name, "data"), text) << name << " is not what the generator writes";
    bytes += text.size();
  }
  EXPECT_LT(bytes, 200'000u);
  for (const auto& entry : fs::recursive_directory_iterator(kData)) {
    const std::string name = entry.path().lexically_relative(kData).generic_string();
    if (!entry.is_regular_file() || name == "README.md") continue;
    EXPECT_TRUE(files.contains(name)) << name;
  }
}

TEST(CheckAcceptance, Complaint01_TileCornersAndEdges) {
  const CheckVerdict verdict = judged("01_tile_corners_and_edges/tiles");
  EXPECT_FALSE(verdict.sound);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"1060/780", "corner_missing"}, {"1062/780", "corner_missing"}, {"1062/780", "off_border"},
      {"1064/780", "edge_list"},      {"1066/780", "sphere"},         {"1068/780", "height_range"},
      {"1070/780", "index"}};
  std::vector<std::pair<std::string, std::string>> found;
  for (const CheckFinding& one : verdict.findings) {
    if (one.finding.code != FindingCode::tile_encoding || one.mesh == verdict::kNoMesh) continue;
    EXPECT_EQ(one.finding.severity, Severity::fault) << one.message;
    found.emplace_back(verdict.meshes[one.mesh].file.substr(3, 8), one.finding.kind);
  }
  EXPECT_THAT(found, IsSupersetOf(expected));
  EXPECT_EQ(verdict.meshes.size(), 6u);

  const CheckFinding* corner = find(verdict, FindingCode::tile_encoding, "corner_missing");
  ASSERT_NE(corner, nullptr);
  const TileBounds bounds = TileGrid{}.bounds_deg({10, 1060, 780});
  bool at_corner = false;
  for (const CheckFinding& one : verdict.findings)
    at_corner = at_corner ||
                (one.finding.kind == "corner_missing" && one.at.x == bounds.east && one.at.y == bounds.north);
  EXPECT_TRUE(at_corner) << "the place is the corner, in degrees";

  const CheckFinding* missing = find(verdict, FindingCode::tile_encoding, "missing_tile");
  ASSERT_NE(missing, nullptr);
  EXPECT_THAT(missing->message,
              StartsWith("1 of 7 tiles that layer.json advertises is not there, the first: 10/1072/780"));
  EXPECT_THAT(said(verdict), HasSubstr("103 tile_encoding"));
  expect_clean(judged("01_tile_corners_and_edges/tiles_twin"));
}

TEST(CheckAcceptance, Complaint02_UnsharedBorderVertices) {
  const CheckVerdict verdict = judged("02_unshared_border_vertices/obj");
  EXPECT_FALSE(verdict.sound);
  EXPECT_EQ(verdict.conformity.t_junction, 3u) << "3.0004 and 7 of the east, 6 of the west";
  EXPECT_EQ(verdict.conformity.crack, 0u) << "the border is straight: no vertex leaves it";
  EXPECT_EQ(seam(verdict).state, SeamState::open);
  const CheckFinding* junction = find(verdict, FindingCode::t_junction);
  ASSERT_NE(junction, nullptr);
  EXPECT_EQ(junction->finding.severity, Severity::fault);
  EXPECT_NE(junction->other_mesh, verdict::kNoMesh);
  EXPECT_EQ(junction->at.x, 10);
  EXPECT_THAT(junction->message, AllOf(HasSubstr("east.obj"), HasSubstr("west.obj")));
  const CheckFinding* edge = find(verdict, FindingCode::sliver, "short_edge");
  ASSERT_NE(edge, nullptr);
  EXPECT_EQ(file(verdict, edge->mesh), "east.obj");
  EXPECT_NEAR(verdict.meshes[edge->mesh].shortest_edge_m, 0.0004, 1e-9);
  EXPECT_THAT(said(verdict),
              AllOf(HasSubstr("FAULTY: 1 open seam"), HasSubstr("3 T-junctions at equal heights")));
  expect_clean(judged("02_unshared_border_vertices/obj_twin"));
}

TEST(CheckAcceptance, Complaint03_WallsAtJoints) {
  for (const double sign : {-1.0, 1.0}) {
    const CheckVerdict verdict =
        judged(sign < 0 ? "03_walls_at_joints/tiles" : "03_walls_at_joints/tiles_reversed");
    EXPECT_FALSE(verdict.sound);
    const verdict::SeamVerdict& joint = seam(verdict);
    EXPECT_EQ(file(verdict, joint.mesh), "3115.terrain");
    EXPECT_EQ(verdict.meshes[joint.mesh].file, "12/4266/3115.terrain");
    EXPECT_EQ(verdict.meshes[joint.other_mesh].file, "12/4267/3115.terrain");
    EXPECT_EQ(joint.state, SeamState::open);
    EXPECT_DOUBLE_EQ(joint.largest_gap_m, sign * 4) << "2 m, and half a metre more with each row";
    EXPECT_NEAR(joint.mean_gap_m, sign * 3, 1e-4) << "rows are even to half a step of the lattice";
    EXPECT_NEAR(joint.mean_abs_gap_m, 3, 1e-4);
    const TileBounds east = TileGrid{}.bounds_deg({12, 4267, 3115});
    EXPECT_EQ(joint.largest_at.x, east.west);
    EXPECT_EQ(joint.largest_at.y, east.north);
    EXPECT_DOUBLE_EQ(joint.largest_at.z, sign < 0 ? -64 : -68) << "on the higher side, below the sea";
    const CheckFinding* crack = find(verdict, FindingCode::crack, "height_mismatch");
    ASSERT_NE(crack, nullptr);
    EXPECT_DOUBLE_EQ(crack->finding.gap_m, sign * 4);
    EXPECT_THAT(crack->message, HasSubstr("stands 4 m above"));
    EXPECT_THAT(said(verdict), AllOf(HasSubstr(sign < 0 ? "worst gap -4 m" : "worst gap +4 m"),
                                     HasSubstr("between 12/4266/3115.terrain and 12/4267/3115.terrain")));
  }
  const CheckVerdict twin = judged("03_walls_at_joints/tiles_twin");
  expect_clean(twin);
  EXPECT_EQ(seam(twin).state, SeamState::watertight);
}

TEST(CheckAcceptance, Complaint04_EdgeNormals) {
  CheckRequest asked = request("04_edge_normals/tiles");
  const CheckVerdict verdict = judged(asked);
  EXPECT_TRUE(verdict.sound) << "the surface itself is whole";
  const CheckFinding* normals = find(verdict, FindingCode::border_normal);
  ASSERT_NE(normals, nullptr);
  EXPECT_EQ(verdict.meshes[normals->mesh].file, "12/4266/3115.terrain");
  EXPECT_EQ(verdict.meshes[normals->other_mesh].file, "12/4267/3115.terrain");
  EXPECT_GT(seam(verdict).normal_max_deg, 30);
  EXPECT_EQ(normals->at.x, TileGrid{}.bounds_deg({12, 4267, 3115}).west);
  EXPECT_THAT(normals->message, HasSubstr("degrees at a vertex that both have"));
  asked.strict = true;
  EXPECT_FALSE(judged(asked).sound);
  const CheckVerdict twin = judged("04_edge_normals/tiles_twin");
  expect_clean(twin);
  EXPECT_EQ(seam(twin).normal_max_deg, 0);
}

TEST(CheckAcceptance, Complaint05_GapExceedsTheSkirtBetweenLevels) {
  CheckRequest asked = request("05_gap_exceeds_skirt/tiles");
  const CheckVerdict unstated = judged(asked);
  EXPECT_TRUE(unstated.sound) << "tiles of two levels are not promised to meet without a skirt";
  EXPECT_NE(find(unstated, FindingCode::level_gap), nullptr);
  EXPECT_EQ(unstated.conformity.total(), 0u);
  asked.skirt_m = 5;
  const CheckVerdict verdict = judged(asked);
  EXPECT_FALSE(verdict.sound);
  const CheckFinding* apart = find(verdict, FindingCode::level_gap);
  ASSERT_NE(apart, nullptr);
  EXPECT_THAT(apart->message, AllOf(HasSubstr("9/533/383.terrain"), HasSubstr("2 levels apart")));
  const CheckFinding* crack = find(verdict, FindingCode::crack, "t_vertex");
  ASSERT_NE(crack, nullptr);
  EXPECT_EQ(crack->finding.severity, Severity::fault);
  EXPECT_DOUBLE_EQ(std::fabs(crack->finding.gap_m), 30);
  EXPECT_THAT(crack->message, HasSubstr("a skirt of 30 m below the border of 11/2136/1533.terrain"));
  const auto skirt_of = [&](const std::string& name) {
    for (const verdict::CheckedMesh& mesh : verdict.meshes)
      if (mesh.file == name) return mesh.least_skirt_m;
    return -1.0;
  };
  EXPECT_DOUBLE_EQ(skirt_of("11/2136/1533.terrain"), 30);
  EXPECT_DOUBLE_EQ(skirt_of("9/533/383.terrain"), 12);
  EXPECT_DOUBLE_EQ(skirt_of("11/2136/1534.terrain"), 0);
  EXPECT_THAT(said(verdict), HasSubstr("A skirt of 30 m below every border covers every gap"));

  asked.skirt_m = 30;
  const CheckVerdict deep = judged(asked);
  EXPECT_TRUE(deep.sound) << "30 m reach exactly";
  for (const verdict::SeamVerdict& one : deep.seams) EXPECT_NE(one.state, SeamState::open);

  CheckRequest twin = request("05_gap_exceeds_skirt/tiles_twin");
  twin.skirt_m = 5;
  const CheckVerdict near = judged(twin);
  EXPECT_TRUE(near.sound);
  EXPECT_EQ(find(near, FindingCode::level_gap), nullptr);
  twin.skirt_m = 3.9;
  EXPECT_FALSE(judged(twin).sound);
}

TEST(CheckAcceptance, Complaint05_GapExceedsTheMeshesOwnSkirt) {
  const CheckVerdict verdict = judged("05_gap_exceeds_skirt/skirts");
  EXPECT_FALSE(verdict.sound);
  EXPECT_EQ(seam(verdict).state, SeamState::open);
  EXPECT_DOUBLE_EQ(std::fabs(seam(verdict).largest_gap_m), 5);
  const CheckFinding* crack = find(verdict, FindingCode::crack, "height_mismatch");
  ASSERT_NE(crack, nullptr);
  EXPECT_EQ(crack->at, (Vec3{10, 4, 10}));
  EXPECT_THAT(crack->message, AllOf(HasSubstr("west.ply stands 5 m above"), HasSubstr("a skirt of 5 m")));
  const CheckVerdict twin = judged("05_gap_exceeds_skirt/skirts_twin");
  EXPECT_TRUE(twin.sound);
  EXPECT_EQ(seam(twin).state, SeamState::covered_by_skirt);
  EXPECT_EQ(twin.meshes[1].skirt.least_depth_m, 6);
}

TEST(CheckAcceptance, Complaint06_CliffOrCrackBeforeACamera) {
  const auto seen = [](const std::string& name) {
    CheckRequest asked = request("06_cliff_or_crack/" + name);
    asked.camera = {{26, 4, 9}, {10, 4, 6}, 60, 320, 240};
    return judged(asked);
  };
  const CheckVerdict crack = seen("crack");
  EXPECT_FALSE(crack.sound);
  const CheckFinding* gap = find(crack, FindingCode::crack);
  ASSERT_NE(gap, nullptr);
  EXPECT_EQ(gap->finding.visibility, oracle::Visibility::visible);
  EXPECT_GT(gap->finding.gap_px, 40) << "6 m, 16 m away, 240 pixels in 60 degrees";
  EXPECT_EQ(crack.image->skirt_px, 0u);

  const CheckVerdict cliff = seen("cliff");
  EXPECT_TRUE(cliff.sound) << "no daylight; what shows is a hazard";
  EXPECT_EQ(seam(cliff).state, SeamState::covered_by_skirt);
  const CheckFinding* wall = find(cliff, FindingCode::skirt_visible);
  ASSERT_NE(wall, nullptr);
  EXPECT_EQ(file(cliff, wall->mesh), "west.off");
  EXPECT_EQ(wall->at.x, 10);
  EXPECT_GT(cliff.image->skirt_px, 1000u);
  EXPECT_THAT(wall->message, HasSubstr("the eye sees a cliff"));

  const CheckVerdict twin = seen("twin");
  expect_clean(twin);
  EXPECT_EQ(twin.image->skirt_px, 0u);
  EXPECT_GT(twin.image->mesh_px, 1000u);
}

TEST(CheckAcceptance, Complaint07_IndependentEdges) {
  const CheckVerdict verdict = judged("07_independent_edges/ply");
  EXPECT_FALSE(verdict.sound);
  EXPECT_EQ(verdict.conformity.t_junction, 2u);
  EXPECT_EQ(verdict.conformity.crack, 2u);
  EXPECT_DOUBLE_EQ(std::fabs(seam(verdict).largest_gap_m), 1);
  EXPECT_DOUBLE_EQ(seam(verdict).mean_abs_gap_m, 0.5) << "two triangles of 4 m by 1 m over 8 m";
  const CheckFinding* crack = find(verdict, FindingCode::crack, "t_vertex");
  ASSERT_NE(crack, nullptr);
  EXPECT_EQ(crack->at, (Vec3{8, 2, 3}));
  EXPECT_EQ(file(verdict, crack->mesh), "east.ply") << "whose vertex it is";
  EXPECT_EQ(file(verdict, crack->other_mesh), "west.ply");
  EXPECT_THAT(crack->message, HasSubstr("at a vertex that"));
  expect_clean(judged("07_independent_edges/ply_twin"));
}

CheckVerdict over(const std::string& mesh, const std::string& dem, std::optional<double> declared_m = {}) {
  CheckRequest asked = request(mesh);
  asked.terrain = kData / dem;
  asked.declared_m = declared_m;
  return judged(asked);
}

TEST(CheckAcceptance, Complaint08_TransposedMatrix) {
  for (const auto& [name, kind, words] :
       {std::tuple("transposed", "transposed", "transposed (rows and columns of the file swapped"),
        std::tuple("rows_flipped", "rows_flipped", "rows are flipped")}) {
    const CheckVerdict verdict =
        over(std::string("08_transposed_matrix/") + name, "08_transposed_matrix/dem.asc");
    EXPECT_FALSE(verdict.sound);
    const CheckFinding* found = find(verdict, FindingCode::misplaced);
    ASSERT_NE(found, nullptr) << name;
    EXPECT_EQ(found->finding.kind, kind);
    EXPECT_EQ(&verdict.findings.front(), found) << "it explains the rest, so it comes first";
    EXPECT_THAT(verdict.terrain->better_match, AllOf(HasSubstr(words), HasSubstr("RMS 0 m instead of")));
    EXPECT_THAT(said(verdict), AllOf(HasSubstr("matches the DEM if"), HasSubstr(words)));
  }
  const CheckVerdict twin = over("08_transposed_matrix/twin", "08_transposed_matrix/dem.asc", 0);
  expect_clean(twin);
  EXPECT_EQ(twin.terrain->vertical_m.max, 0);
}

TEST(CheckAcceptance, Complaint08_ErrorsOfATransposedMatrix) {
  const CheckVerdict verdict =
      over("08_transposed_matrix/refined_elsewhere", "08_transposed_matrix/peak.asc", 25);
  EXPECT_FALSE(verdict.sound);
  EXPECT_DOUBLE_EQ(verdict.terrain->samples_max_m, 40);
  EXPECT_EQ(verdict.terrain->samples_at, (Vec2{30, 70}));
  EXPECT_EQ(find(verdict, FindingCode::misplaced), nullptr) << "the mesh lies right; its refinement does not";
  const CheckFinding* bound = find(verdict, FindingCode::declared_error, "samples");
  ASSERT_NE(bound, nullptr);
  EXPECT_THAT(bound->message, HasSubstr("25 m were declared; at a sample the mesh is 40 m off"));
  const CheckVerdict twin =
      over("08_transposed_matrix/refined_elsewhere_twin", "08_transposed_matrix/peak.asc", 25);
  expect_clean(twin);
}

TEST(CheckAcceptance, Complaint09_FlippedTriangles) {
  const CheckVerdict verdict = judged("09_flipped_triangles/obj");
  EXPECT_FALSE(verdict.sound);
  EXPECT_GT(verdict.conformity.fold_over, 0u);
  EXPECT_GT(verdict.conformity.overlap, 0u);
  const CheckFinding* fold = find(verdict, FindingCode::fold_over, "folded");
  ASSERT_NE(fold, nullptr);
  EXPECT_FALSE(fold->finding.triangles.empty());
  EXPECT_GT(fold->finding.area_m2, 0);
  EXPECT_NE(find(verdict, FindingCode::overlap), nullptr);
  const CheckFinding* thin = find(verdict, FindingCode::sliver, "thin");
  ASSERT_NE(thin, nullptr);
  EXPECT_LT(verdict.meshes[0].shape.min_quality, 0.05);
  expect_clean(judged("09_flipped_triangles/obj_twin"));
}

TEST(CheckAcceptance, Complaint10_DegenerateTriangles) {
  const CheckVerdict verdict = judged("10_degenerate_triangles/off");
  EXPECT_FALSE(verdict.sound);
  EXPECT_THAT(kinds(verdict), IsSupersetOf({"degenerate:collinear", "degenerate:repeated_index", "duplicate",
                                            "non_manifold", "overlap"}));
  EXPECT_EQ(verdict.conformity.degenerate, 2u);
  EXPECT_EQ(verdict.conformity.duplicate, 1u);
  expect_clean(judged("10_degenerate_triangles/off_twin"));
}

TEST(CheckAcceptance, Complaint11_DeclaredError) {
  const std::string folder = "11_declared_error/";
  const CheckVerdict verdict = over(folder + "mesh.ply", folder + "dem.asc", 5);
  EXPECT_FALSE(verdict.sound);
  EXPECT_FALSE(verdict.terrain->declared_at_samples);
  EXPECT_DOUBLE_EQ(verdict.terrain->vertical_m.max, 7.25);
  EXPECT_EQ(verdict.terrain->samples_at, (Vec2{30, 50}));
  const CheckFinding* bound = find(verdict, FindingCode::declared_error, "samples");
  ASSERT_NE(bound, nullptr);
  EXPECT_EQ(bound->at, (Vec3{30, 50, 63}));
  EXPECT_THAT(said(verdict), HasSubstr("the declared 5 m does not hold: 7.25 m at 30, 50"));

  const CheckVerdict between = over(folder + "between.ply", folder + "dem_twin.asc", 5);
  EXPECT_FALSE(between.sound);
  EXPECT_TRUE(between.terrain->declared_at_samples);
  EXPECT_EQ(between.terrain->samples_max_m, 0);
  EXPECT_FALSE(between.terrain->declared_certain);
  EXPECT_NEAR(between.terrain->vertical_m.certain_max, 6.5, 1e-12);
  EXPECT_EQ(between.terrain->certain_at, (Vec2{65, 15}));
  EXPECT_NE(find(between, FindingCode::declared_error, "between"), nullptr);

  const CheckVerdict twin = over(folder + "mesh.ply", folder + "dem_twin.asc", 5);
  expect_clean(twin);
  EXPECT_DOUBLE_EQ(twin.terrain->vertical_m.max, 4.5);
  EXPECT_THAT(said(twin), HasSubstr("the declared 5 m holds"));
}

TEST(CheckAcceptance, Complaint11_DeclaredErrorOfAnObject) {
  const auto against = [](const std::string& mesh) {
    CheckRequest asked = request("11_declared_error/" + mesh);
    asked.reference = kData / "11_declared_error/box_reference.off";
    asked.declared_m = 0.1;
    return judged(asked);
  };
  const CheckVerdict verdict = against("box.off");
  EXPECT_FALSE(verdict.sound);
  ASSERT_TRUE(verdict.reference);
  EXPECT_TRUE(verdict.reference->declared_broken);
  const CheckFinding* bound = find(verdict, FindingCode::declared_error, "reference");
  ASSERT_NE(bound, nullptr);
  EXPECT_GT(bound->finding.distance_m, 0.8);
  const CheckVerdict twin = against("box_twin.off");
  expect_clean(twin);
  EXPECT_TRUE(twin.reference->declared_holds);
}

TEST(CheckAcceptance, Complaint12_SelfIntersections) {
  const CheckVerdict verdict = judged("12_self_intersections/off");
  EXPECT_FALSE(verdict.sound);
  EXPECT_FALSE(verdict.meshes[0].terrain) << "taken for what it is";
  EXPECT_TRUE(verdict.meshes[0].self_intersections_judged);
  EXPECT_GT(verdict.meshes[0].self_intersections, 0u);
  EXPECT_EQ(verdict.conformity.total(), 0u) << "by its indices it is a sound manifold";
  const CheckFinding* cut = find(verdict, FindingCode::self_intersection);
  ASSERT_NE(cut, nullptr);
  EXPECT_EQ(cut->finding.triangles.size(), 2u);
  EXPECT_THAT(cut->message, HasSubstr("cut through each other"));
  expect_clean(judged("12_self_intersections/off_twin"));
}

TEST(CheckAcceptance, Complaint19_LeastSkirt) {
  CheckRequest asked = request("19_least_skirt/tiles");
  asked.skirt_m = 10;
  const CheckVerdict verdict = judged(asked);
  EXPECT_FALSE(verdict.sound) << "10 m are too small";
  std::vector<double> least;
  for (const verdict::CheckedMesh& mesh : verdict.meshes) least.push_back(mesh.least_skirt_m);
  EXPECT_THAT(least, testing::ElementsAre(18.25, 0, 2.75, 3))
      << "by tile: 4266/3114, 4266/3115, 4267/3114, 4267/3115";
  EXPECT_THAT(said(verdict),
              HasSubstr("A skirt of 18.3 m below every border covers every gap between meshes; the worst "
                        "pair is 12/4266/3114.terrain and 12/4266/3115.terrain"));
  asked.skirt_m = 18.25;
  EXPECT_TRUE(judged(asked).sound) << "what was said to suffice suffices";
  asked.skirt_m = 18.2;
  EXPECT_FALSE(judged(asked).sound) << "and less does not";
  asked.skirt_m.reset();
  EXPECT_FALSE(judged(asked).sound);
  expect_clean(judged("19_least_skirt/tiles_twin"));
}

TEST(CheckAcceptance, Complaint20_SplitVerticesOfQuantizedTiles) {
  const CheckVerdict verdict = judged("20_split_vertices/tiles");
  EXPECT_FALSE(verdict.sound);
  const CheckFinding* junction = find(verdict, FindingCode::t_junction);
  ASSERT_NE(junction, nullptr);
  EXPECT_EQ(verdict.meshes[junction->mesh].file, "10/1067/766.terrain") << "has the vertex";
  EXPECT_EQ(verdict.meshes[junction->other_mesh].file, "10/1066/766.terrain") << "lacks it";
  EXPECT_EQ(junction->at.x, TileGrid{}.bounds_deg({10, 1067, 766}).west);
  EXPECT_EQ(verdict.conformity.t_junction, 1u) << "those between levels are nobody's fault";
  const CheckFinding* lattice = find(verdict, FindingCode::slit, "lattice");
  ASSERT_NE(lattice, nullptr);
  EXPECT_EQ(lattice->finding.severity, Severity::hazard);
  EXPECT_THAT(lattice->message, HasSubstr("16383.5"));
  const CheckVerdict twin = judged("20_split_vertices/tiles_twin");
  expect_clean(twin);

  const CheckVerdict rounding = judged("20_split_vertices/rounding");
  EXPECT_TRUE(rounding.sound) << said(rounding);
  const CheckFinding* gap = find(rounding, FindingCode::crack, "quantization");
  ASSERT_NE(gap, nullptr);
  EXPECT_LE(std::fabs(gap->finding.gap_m), seam(rounding).quantum_m);
  EXPECT_THAT(said(rounding), HasSubstr("1 open (1 by no more than the rounding of heights)"));
}

}  // namespace
}  // namespace plumbline
