// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same two meshes with the same seam, in every format: the same findings, as far as the format's
// precision goes.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/check/check.h"
#include "tests/properties/corpus_parts.h"
#include "tests/scenarios/support.h"

namespace plumbline {
namespace {

using oracle::FindingCode;
using ::testing::HasSubstr;
using verdict::CheckFinding;
using verdict::CheckVerdict;
using verdict::SeamState;

/// 8 × 8 m each, whole numbers: single precision and a lattice of half metres hold them. The eastern one has
/// two vertices on the border that the western one lacks, one metre above its edges.
struct Neighbours {
  Mesh west = test::sheet_between(0, {{0, 0}, {8, 0}}, 8, {{0, 0}, {4, 4}, {8, 0}}, 2);
  Mesh east = test::sheet_between(8, {{0, 0}, {2, 3}, {4, 4}, {6, 3}, {8, 0}}, 16, {{0, 0}, {8, 0}}, 2);
};

struct Format {
  std::string name, ending;
  std::string (*bytes)(const Mesh& mesh);
  bool y_up = false;
};

const std::vector<Format>& formats() {
  using test::PlyEncoding;
  static const std::vector<Format> all{
      {"ply_ascii_float", "ply", [](const Mesh& m) { return test::ply_bytes<float>(m, PlyEncoding::ascii); }},
      {"ply_ascii_double", "ply",
       [](const Mesh& m) { return test::ply_bytes<double>(m, PlyEncoding::ascii); }},
      {"ply_little_float", "ply",
       [](const Mesh& m) { return test::ply_bytes<float>(m, PlyEncoding::little); }},
      {"ply_little_double", "ply",
       [](const Mesh& m) { return test::ply_bytes<double>(m, PlyEncoding::little); }},
      {"ply_big_float", "ply", [](const Mesh& m) { return test::ply_bytes<float>(m, PlyEncoding::big); }},
      {"ply_big_double", "ply", [](const Mesh& m) { return test::ply_bytes<double>(m, PlyEncoding::big); }},
      {"obj", "obj", [](const Mesh& m) { return test::obj_bytes(m); }},
      {"off", "off", [](const Mesh& m) { return test::off_bytes(m); }},
      {"stl_ascii", "stl", [](const Mesh& m) { return test::stl_text(m); }},
      {"stl_binary", "stl", [](const Mesh& m) { return test::stl_binary(m); }},
      {"glb", "glb", [](const Mesh& m) { return test::Gltf(m, false).glb(); }, true},
      {"glb_quantized", "glb",
       [](const Mesh& m) {
         return test::Gltf(m, true, {4, 2, 1}, 0.5).glb();
       },
       true},
      {"gltf_data_uri", "gltf", [](const Mesh& m) { return test::Gltf(m, false).gltf(); }, true},
  };
  return all;
}

CheckVerdict judged(const std::vector<std::filesystem::path>& inputs) {
  CheckRequest request;
  request.inputs = inputs;
  request.pictures = false;
  return check(request).verdict;
}

class CheckFormats : public testing::TestWithParam<Format> {};

TEST_P(CheckFormats, SameSeamSameFindings) {
  const test::TemporaryFolder folder;
  const Neighbours pair;
  const Format& format = GetParam();
  const CheckVerdict verdict = judged({folder.write("west." + format.ending, format.bytes(pair.west)),
                                       folder.write("east." + format.ending, format.bytes(pair.east))});
  EXPECT_FALSE(verdict.sound);
  ASSERT_EQ(verdict.meshes.size(), 2u);
  EXPECT_EQ(verdict.meshes[0].name, "west." + format.ending);
  EXPECT_EQ(verdict.meshes[0].triangles, pair.west.triangles.size());
  EXPECT_EQ(verdict.meshes[1].vertices, pair.east.positions.size()) << "corners of equal coordinates are one";
  EXPECT_TRUE(verdict.meshes[0].terrain);
  ASSERT_EQ(verdict.seams.size(), 1u);
  const verdict::SeamVerdict& seam = verdict.seams[0];
  EXPECT_EQ(seam.state, SeamState::open);
  EXPECT_EQ(seam.t_junctions, 2u);
  EXPECT_EQ(seam.cracks, 2u);
  EXPECT_EQ(seam.length_m, 8);
  EXPECT_EQ(seam.largest_gap_m, -1);
  EXPECT_EQ(seam.mean_gap_m, -0.5);
  EXPECT_EQ(seam.least_skirt_m, 0);
  EXPECT_EQ(seam.least_skirt_other_m, 1);
  ASSERT_EQ(verdict.findings.size(), 2u);
  const Vec3 first{8, 2, 3}, second{8, 6, 3};
  for (std::size_t k = 0; k < 2; ++k) {
    const CheckFinding& found = verdict.findings[k];
    EXPECT_EQ(found.finding.code, FindingCode::crack);
    EXPECT_EQ(found.finding.kind, "t_vertex");
    EXPECT_EQ(found.finding.gap_m, -1);
    EXPECT_EQ(found.mesh, 1u) << "the vertex is the eastern mesh's";
    const Vec3 place = k == 0 ? first : second;
    EXPECT_EQ(found.finding.at, place);
    EXPECT_EQ(found.at, format.y_up ? test::as_gltf(place) : place) << "in the file's own axes";
  }
  EXPECT_EQ(verdict.conformity, (oracle::ConformityCounts{2, 2}));
  EXPECT_EQ(
      std::count_if(verdict.notes.begin(), verdict.notes.end(),
                    [](const auto& note) { return note.find("up is taken to be y") != std::string::npos; }),
      format.y_up ? 1 : 0);
}

TEST_P(CheckFormats, SoundTwinIsSound) {
  const test::TemporaryFolder folder;
  Neighbours pair;
  pair.west = test::sheet_between(0, {{0, 0}, {8, 0}}, 8, {{0, 0}, {2, 3}, {4, 4}, {6, 3}, {8, 0}}, 2);
  const Format& format = GetParam();
  const CheckVerdict verdict = judged({folder.write("west." + format.ending, format.bytes(pair.west)),
                                       folder.write("east." + format.ending, format.bytes(pair.east))});
  EXPECT_TRUE(verdict.sound);
  EXPECT_TRUE(verdict.findings.empty());
  ASSERT_EQ(verdict.seams.size(), 1u);
  EXPECT_EQ(verdict.seams[0].state, SeamState::watertight);
}

INSTANTIATE_TEST_SUITE_P(All, CheckFormats, testing::ValuesIn(formats()),
                         [](const auto& format) { return format.param.name; });

TEST(CheckFormatsTogether, OneMeshPly_TheOtherObj) {
  const test::TemporaryFolder folder;
  const Neighbours pair;
  const CheckVerdict verdict = judged({folder.write("west.ply", formats()[2].bytes(pair.west)),
                                       folder.write("east.obj", test::obj_bytes(pair.east))});
  ASSERT_EQ(verdict.seams.size(), 1u);
  EXPECT_EQ(verdict.seams[0].largest_gap_m, -1);
}

/// On a tile's lattice halves have no place; the same seam, as near as it can be written.
TEST(CheckFormatsTogether, QuantizedMesh) {
  const test::TemporaryFolder folder;
  const TileGrid grid;
  const TileAddress west{10, 1066, 766}, east{10, 1067, 766};
  constexpr double kEnd = kTileSteps;
  const double second =
      4 * (kEnd - 24000) / (kEnd - 16000);  // the western edge's height at the second vertex
  folder.write("10/1066/766.terrain",
               encode_quantized_mesh(test::fan_tile(
                   grid, west, {{0, 0, 0}, {kEnd, 0, 0}, {kEnd, 16000, 4}, {kEnd, kEnd, 0}, {0, kEnd, 0}})));
  folder.write("10/1067/766.terrain", encode_quantized_mesh(test::fan_tile(grid, east,
                                                                           {{0, 0, 0},
                                                                            {kEnd, 0, 0},
                                                                            {kEnd, kEnd, 0},
                                                                            {0, kEnd, 0},
                                                                            {0, 24000, 3},
                                                                            {0, 16000, 4},
                                                                            {0, 8000, 3}})));
  const CheckVerdict verdict = judged({folder.path()});
  EXPECT_FALSE(verdict.sound);
  ASSERT_EQ(verdict.seams.size(), 1u);
  const verdict::SeamVerdict& seam = verdict.seams[0];
  EXPECT_EQ(seam.t_junctions, 2u);
  EXPECT_EQ(seam.cracks, 2u);
  EXPECT_EQ(seam.largest_gap_m, -1);
  ASSERT_EQ(verdict.findings.size(), 2u);
  EXPECT_NEAR(verdict.findings[1].finding.gap_m, second - 3, 1e-9);
  EXPECT_EQ(verdict.findings[0].finding.kind, "t_vertex");
  EXPECT_EQ(verdict.meshes[verdict.findings[0].mesh].file, "10/1067/766.terrain");
  EXPECT_THAT(verdict.notes, testing::Contains(HasSubstr("layer.json")));
}

/// Survey coordinates: a millimetre at five million metres is within doubles, and lost in single precision.
TEST(CheckFormatsTogether, CoordinatesStayDoubleWhereTheFileHasThem) {
  const test::TemporaryFolder folder;
  Neighbours pair;
  pair.west = test::sheet_between(0, {{0, 0}, {8, 0}}, 8, {{0, 0}, {2, 3}, {4, 4}, {6, 3}, {8, 0}}, 2);
  for (Mesh* mesh : {&pair.west, &pair.east})
    for (Vec3& p : mesh->positions) p = p + Vec3{500'000, 5'200'000, 4096};
  for (Vec3& p : pair.east.positions) {
    if (p.y == 5'200'002) p.z += 0x1p-13;
  }
  const auto verdict_of = [&](auto real) {
    using Real = decltype(real);
    return judged({folder.write("west.ply", test::ply_bytes<Real>(pair.west, test::PlyEncoding::little)),
                   folder.write("east.ply", test::ply_bytes<Real>(pair.east, test::PlyEncoding::little))});
  };
  const CheckVerdict fine = verdict_of(double{});
  EXPECT_FALSE(fine.sound);
  ASSERT_EQ(fine.seams.size(), 1u);
  EXPECT_EQ(fine.seams[0].largest_gap_m, -0x1p-13);
  EXPECT_TRUE(verdict_of(float{}).sound);
}

}  // namespace
}  // namespace plumbline
