// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/mesh_file/mesh_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string message(std::string_view bytes, std::string_view name) {
  try {
    parse_mesh(bytes, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <class T>
void put(std::string& out, T value, bool big = false) {
  char copy[sizeof(T)];
  std::memcpy(copy, &value, sizeof(T));
  if (big) std::reverse(copy, copy + sizeof(T));
  out.append(copy, sizeof(T));
}

constexpr double kFine = 500000.0000001;  // no float

void expect_one_triangle(const MeshFile& mesh, double last_z) {
  EXPECT_THAT(mesh.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, last_z}));
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.ends, ElementsAre(3));
}

TEST(MeshFile, PlyKeepsDoublesInEveryCoding) {
  expect_one_triangle(
      parse_mesh(
          "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty double x\nproperty double y\n"
          "property double z\nproperty uchar red\nelement face 1\nproperty list uchar int vertex_indices\n"
          "end_header\n0 0 0 9\n1 0 0 9\n0 1 500000.0000001 9\n3 0 1 2\n",
          "a.ply"),
      kFine);
  for (const bool big : {false, true}) {
    std::string bytes =
        std::string("ply\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 1\nproperty list uchar int vertex_index\nend_header\n";
    for (const double x : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, kFine}) put(bytes, x, big);
    put(bytes, std::uint8_t{3});
    for (const std::int32_t i : {0, 1, 2}) put(bytes, i, big);
    expect_one_triangle(parse_mesh(bytes, "a.ply"), kFine);
    for (std::size_t cut = 0; cut < bytes.size(); ++cut)
      EXPECT_NE(message(bytes.substr(0, cut), "a.ply"), "") << "cut at byte " << cut;
  }
}

TEST(MeshFile, ObjCountsFromOneAndBackwards) {
  expect_one_triangle(
      parse_mesh("# c\nv 0 0 0\nv 1 0 0\nvn 0 0 1\nv 0 1 500000.0000001 1.0\nf 1/1/1 -2//1 3\n", "a.OBJ"),
      kFine);
}

TEST(MeshFile, Off) {
  expect_one_triangle(
      parse_mesh("OFF # c\n3 1 0\n0 0 0\n1 0 0\n0 1 500000.0000001\n3 0 1 2 255 0 0\n", "a.off"), kFine);
}

TEST(MeshFile, StlWeldsEqualCornersInBothForms) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 2.5\nendloop\nendfacet\n";
  expect_one_triangle(parse_mesh("solid a b\n" + facet + "endsolid a b\n", "a.stl"), 2.5);
  const MeshFile two = parse_mesh("solid\n" + facet + facet + "endsolid\n", "a.stl");
  EXPECT_EQ(two.positions.size(), 3u);
  EXPECT_EQ(two.polygons(), 2u);
  std::string bytes("solid, but binary");
  bytes.resize(80);
  put(bytes, std::uint32_t{1});
  for (const float x : {0.f, 0.f, 1.f, 0.f, -0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 2.5f}) put(bytes, x);
  bytes += "\0\0";
  bytes.resize(84 + 50);
  expect_one_triangle(parse_mesh(bytes, "a.stl"), 2.5);
}

TEST(MeshFile, PlyAndObjNormalsWhereEveryVertexHasOne) {
  const std::string vertices =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float x\nproperty float y\n"
      "property float z\nproperty float ny\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const MeshFile with = parse_mesh(
      vertices + "property float nz\n" + faces + "0.5 0 0 0 0.25 1\n0 1 0 0 0 1\n0 0 1 2 0 -1\n3 0 1 2\n",
      "a.ply");
  expect_one_triangle(with, 2);
  EXPECT_EQ(with.normals, (std::vector<Vec3>{{0.5, 0.25, 1}, {0, 0, 1}, {0, 0, -1}}));
  const MeshFile without =
      parse_mesh(vertices + faces + "0.5 0 0 0 0.25\n0 1 0 0 0\n0 0 1 2 0\n3 0 1 2\n", "a.ply");
  expect_one_triangle(without, 2);
  EXPECT_TRUE(without.normals.empty());

  const auto obj = [](const std::string& polygons) {
    return parse_mesh(
               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nvn 0 0 1\nvn 0 1 0\nvn 0 0 1\n" + polygons,
               "a.obj")
        .normals;
  };
  const Vec3 up{0, 0, 1}, north{0, 1, 0};
  EXPECT_EQ(obj("f 1//1 2//2 3//1\nf 1/7/1 3//3 4//-2\n"), (std::vector<Vec3>{up, north, up, north, {}}))
      << "by value: 3 has normals 1 and 3, which are equal; the last vertex is not used";
  EXPECT_TRUE(obj("f 1//1 2//2 3//1\nf 1//1 3//2 4//1\n").empty()) << "two normals for vertex 3";
  EXPECT_TRUE(obj("f 1//1 2//2 3\n").empty());
  EXPECT_TRUE(obj("f 1//1 2//2 3//4\n").empty());
  EXPECT_TRUE(obj("f 1//1 2//2 3//-4\n").empty());
  EXPECT_TRUE(obj("f 1//1 2//2 3//x\n").empty());
  EXPECT_TRUE(obj("f 1 2 3\n").empty());
}

TEST(MeshFile, SaysItsFormat) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n";
  EXPECT_EQ(parse_mesh(ply, "a").format, "PLY");
  EXPECT_EQ(parse_mesh("# nothing\n", "a.obj").format, "OBJ");
  EXPECT_EQ(parse_mesh("OFF 0 0 0", "a").format, "OFF");
  EXPECT_EQ(parse_mesh("solid\nendsolid\n", "a.stl").format, "STL");
  EXPECT_EQ(parse_mesh(std::string(84, '\0'), "a.stl").format, "STL");
}

TEST(MeshFile, StlOfManyVerticesIsTheLattice) {
  constexpr std::uint32_t n = 300;
  std::string bytes(80, ' ');
  put(bytes, 2 * n * n);
  for (std::uint32_t f = 0; f < 2 * n * n; ++f) {
    const std::uint32_t i = f / 2 % n, j = f / 2 / n;
    bytes += std::string(12, '\0');
    for (const auto& [x, y] :
         f % 2 == 0 ? std::array<std::array<std::uint32_t, 2>, 3>{{{i, j}, {i + 1, j}, {i, j + 1}}}
                    : std::array<std::array<std::uint32_t, 2>, 3>{{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}}) {
      put(bytes, static_cast<float>(x));
      put(bytes, static_cast<float>(y));
      put(bytes, x == 0 ? -0.F : 0.F);
    }
    bytes += std::string(2, '\0');
  }
  const MeshFile mesh = parse_mesh(bytes, "a.stl");
  EXPECT_EQ(mesh.positions.size(), (n + 1) * (n + 1));
  for (std::size_t k = 0; k < mesh.corners.size(); ++k) {
    float x = 0;
    std::memcpy(&x, bytes.data() + 84 + 50 * (k / 3) + 12 + 12 * (k % 3), sizeof x);
    ASSERT_EQ(mesh.positions[mesh.corners[k]].x, static_cast<double>(x));
  }
}

TEST(MeshFile, BadInputIsOneClearLine) {
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex ";
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(message(ply + "999999999999999999" + xyz + "end_header\n0 0 0\n", "a.ply"),
              HasSubstr("the file ends"));
  EXPECT_THAT(message(ply + "-1" + xyz + "end_header\n", "a.ply"), HasSubstr("negative"));
  EXPECT_THAT(message(ply + "1\nproperty float x\nend_header\n0\n", "a.ply"), HasSubstr("no x, y and z"));
  EXPECT_THAT(message(ply + "1" + xyz, "a.ply"), HasSubstr("end_header"));
  EXPECT_THAT(message("v 0 0 0\nf 1 2 3\n", "a.obj"),
              HasSubstr("a.obj:2: a polygon names vertex 1 (from 0), of 1"));
  EXPECT_THAT(message("v 0 zero 0\n", "a.obj"), HasSubstr("a.obj:1: 'zero' is not a number"));
  EXPECT_THAT(message("OFF\n4000000000 1 0\n0 0 0\n", "a.off"), HasSubstr("the file ends"));
  EXPECT_THAT(message("NOFF\n", "a.off"), HasSubstr("'NOFF' is not OFF"));
  EXPECT_THAT(message(std::string(84, '\xff'), "a.stl"), HasSubstr("4294967295 facets"));
  EXPECT_THAT(message("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n", "a.stl"),
              HasSubstr("1 vertices instead of 3"));
  EXPECT_THAT(message("PK", "a.zip"), HasSubstr("PLY, OBJ, OFF, STL, glTF and .terrain"));
  EXPECT_THAT(message("", "a.ply"), HasSubstr("a.ply: the file is empty"));
  EXPECT_THROW(read_mesh_file("/no/such/file.ply"), InputError);
  EXPECT_THROW(read_mesh_file("/dev/zero"), InputError);
}

double area_in_plan(const Mesh& mesh, bool& all_upright) {
  double sum = 0;
  all_upright = true;
  for (const auto& t : mesh.triangles) {
    const double z =
        cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]).z;
    all_upright = all_upright && z > 0;
    sum += z / 2;
  }
  return sum;
}

TEST(MeshFile, PolygonsBecomeNMinusTwoTriangles) {
  // An L, which no fan from its first corner covers, and a square; areas 3 and 1.
  const Mesh mesh = triangulate(
      parse_mesh("v 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\n"
                 "v 3 1 0\nf 1 2 3 4 5 6\nf 7 8 9 10\nf 1 2\n",
                 "a.obj"));
  EXPECT_EQ(mesh.triangles.size(), 4u + 2u);
  bool all_upright = false;
  EXPECT_EQ(area_in_plan(mesh, all_upright), 4);
  EXPECT_TRUE(all_upright);
}

}  // namespace
}  // namespace plumbline
