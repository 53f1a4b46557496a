// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What fuzzing and its seeds brought to light, each by its smallest input; more in tests/fuzz/crashers.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/camera.h"
#include "scenarios/mesh_file/mesh_file.h"
#include "scenarios/point_table.h"
#include "scenarios/random.h"
#include "scenarios/suite.h"
#include "scenarios/toml_reader.h"
#include "support.h"

namespace plumbline {
namespace {

using test::input_error;
using ::testing::HasSubstr;

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  for (std::size_t k = 0; k < times; ++k) out += text;
  return out;
}

std::string toml_message(const std::string& text) {
  return input_error([&] { (void)parse_toml(text, "f.toml"); });
}

// toml++ made and destroyed a table for each part of a key, by recursion: the stack ended.
TEST(HostileInput, TomlKeysOfManyPartsAreRefused) {
  const std::string parts = repeated("a.", 100'000) + "a";
  EXPECT_THAT(toml_message("b = 1\n" + parts + " = 1\n"), HasSubstr("f.toml:2: nests"));
  EXPECT_THAT(toml_message("[" + parts + "]\n"), HasSubstr("f.toml:1: nests"));
  EXPECT_THAT(toml_message("[[" + parts + "]]\n"), HasSubstr("f.toml:1: nests"));
  EXPECT_THAT(toml_message("b = {" + parts + " = 1}\n"), HasSubstr("nests"));
  // Some in the header, some in the key, some in each table inside.
  const std::string some = repeated("a.", 30) + "a";
  EXPECT_THAT(toml_message("[" + some + "]\n" + repeated(some + " = [{", 4) + "b = 1" + repeated("}]", 4)),
              HasSubstr("f.toml:2: nests"));
  EXPECT_THAT(toml_message("b = " + repeated("[", 100'000) + repeated("]", 100'000)), HasSubstr("nests"));
  // A string that ends in one or two quotes of its own does not hide what follows.
  EXPECT_THAT(toml_message("b = {c = \"\"\"x\"\"\"\"\", " + parts + " = 1}\n"), HasSubstr("nests"));
  EXPECT_THAT(toml_message("b = {c = '''x'''', " + parts + " = 1}\n"), HasSubstr("nests"));
}

TEST(HostileInput, TomlOfManyDotsElsewhereIsRead) {
  const std::string dots = repeated(".[{", 1000);
  const TomlTable file =
      parse_toml("# " + dots + "\na = \"" + dots + "\\\"" + dots + "\"\nb = '" + dots +
                     "\\'\nc = \"\"\"\n\"" + dots + "\"\"\" # " + dots + "\nd = [" + repeated("1.5, ", 1000) +
                     "\n1.5]\ne = '''" + dots + "'''\nf = ''\n" + repeated("[[t]]\nx.y = 1.5\n", 1000),
                 "f.toml");
  EXPECT_EQ(file.at("a").text(), dots + "\"" + dots);
  EXPECT_EQ(file.at("b").text(), dots + "\\");
  EXPECT_EQ(file.at("d").array().size(), 1001u);
  EXPECT_EQ(file.tables("t").size(), 1000u);
  EXPECT_EQ(parse_toml(repeated("a.", 100) + "a = 1\n", "f.toml").entries().size(), 1u);
}

// The refusal printed the nest, by recursion: the stack ended.
TEST(HostileInput, GltfNestsAreNamedNotPrinted) {
  const std::string begin = R"({"asset":{"version":"2.0"},"nodes":[{}],"scenes":[{}],"scene":)";
  const auto message = [](const std::string& text) {
    return input_error([&] { (void)parse_mesh(text, "a.gltf"); });
  };
  EXPECT_THAT(message(begin + repeated("[", 200'000) + repeated("]", 200'000) + "}"),
              HasSubstr("array is not a whole number"));
  EXPECT_THAT(message(begin + repeated("{\"a\":", 200'000) + "1" + repeated("}", 200'000) + "}"),
              HasSubstr("object is not a whole number"));
}

// Of each index of a strip come three corners: they were paid for once.
TEST(HostileInput, GltfStripsShownOftenAreRefused) {
  // 64 indices of one byte in base64, all 0 1 2 3 again and again, named by many primitives.
  const std::string indices = repeated("AAECAwABAgMA", 7);  // 63 bytes
  const auto scene = [&](std::size_t times) {
    const std::string primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5})";
    return R"({"asset":{"version":"2.0"},"accessors":[{"bufferView":0,"componentType":5121,"count":4,"type":"VEC3"},)"
           R"({"bufferView":0,"componentType":5121,"count":60,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":63}],)"
           R"("buffers":[{"byteLength":63,"uri":"data:;base64,)" +
           indices + R"("}],"nodes":[)" + repeated(R"({"mesh":0},)", times) +
           R"({"mesh":0}],"meshes":[{"primitives":[)" + repeated(primitive + ",", 99) + primitive + "]}]}";
  };
  const std::string few = scene(2), many = scene(40);
  const MeshFile mesh = parse_mesh(few, "a.gltf");
  EXPECT_GT(mesh.corners.size(), 0u);
  EXPECT_LE(mesh.corners.size() + mesh.positions.size(), 16 * (few.size() + 63));
  EXPECT_THAT(input_error([&] { (void)parse_mesh(many, "a.gltf"); }), HasSubstr("shows its data too often"));
}

// Coordinates chosen so that the hash runs through one value for all: each point passed by all before it.
TEST(HostileInput, PointsThatShareASlotAreParted) {
  const auto step = [](std::uint64_t h) {
    h *= 0x9e3779b97f4a7c15;
    return h ^ h >> 29U;
  };
  PointTable table;
  constexpr std::uint32_t kPoints = 100'000;
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    const double x = 1 + k;
    const Vec3 p{x, std::bit_cast<double>(step(std::bit_cast<std::uint64_t>(x)) ^ 0x1234567U), 0};
    ASSERT_EQ(table.number(p), k);
    ASSERT_EQ(table.number(p), k);
  }
  EXPECT_GE(table.salts(), 1u) << "the points were meant to meet";
  EXPECT_LE(table.salts(), 2u) << "and one other hash to part them";
  PointTable plain;
  for (std::uint32_t k = 0; k < kPoints; ++k)
    ASSERT_EQ(plain.number({0.1 * (k % 317), 0.1 * (k / 317), 0}), k);
  EXPECT_EQ(plain.salts(), 0u);
}

/// As paper 004 has it: the first corner that is an ear, searched anew each time.
std::vector<std::array<std::uint32_t, 3>> plain_ears(const std::vector<Vec2>& p) {
  const auto turn = [](Vec2 a, Vec2 b, Vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  std::vector<std::uint32_t> left(p.size());
  for (std::uint32_t k = 0; k < left.size(); ++k) left[k] = k;
  std::vector<std::array<std::uint32_t, 3>> out;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t ear = n;
    for (std::size_t k = 0; k < n && ear == n; ++k) {
      const Vec2 a = p[left[(k + n - 1) % n]], b = p[left[k]], c = p[left[(k + 1) % n]];
      bool empty = turn(a, b, c) > 0;
      for (std::size_t m = 0; m < n; ++m) {
        const Vec2 q = p[left[m]];
        const bool own = m == k || m == (k + 1) % n || m == (k + n - 1) % n;
        empty = empty && (own || !(turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0));
      }
      if (empty) ear = k;
    }
    if (ear == n) ear = 1;
    out.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  out.push_back({left[0], left[1], left[2]});
  return out;
}

MeshFile polygon(const std::vector<Vec2>& corners) {
  MeshFile file;
  for (const Vec2 p : corners) {
    file.corners.push_back(static_cast<std::uint32_t>(file.positions.size()));
    file.positions.push_back({p.x, p.y, 0});
  }
  file.ends.push_back(corners.size());
  return file;
}

TEST(HostileInput, EarsAreThoseOfThePlainSearch) {
  std::size_t concave = 0;
  for (std::uint64_t trial = 0; trial < 400; ++trial) {
    Random random(7, fmt::format("ears {}", trial));
    const std::size_t corners = 4 + random.below(20);
    const std::uint64_t lattice = 3 + random.below(30);
    std::vector<Vec2> p;
    for (std::size_t k = 0; k < corners; ++k)
      p.push_back({static_cast<double>(random.below(lattice)), static_cast<double>(random.below(lattice))});
    double twice_area = 0;  // the plain search works counter-clockwise, as the reader's plan does
    for (std::size_t k = 0; k < corners; ++k)
      twice_area += p[k].x * p[(k + 1) % corners].y - p[k].y * p[(k + 1) % corners].x;
    if (twice_area < 0) std::reverse(p.begin(), p.end());
    bool convex = true;
    for (std::size_t k = 0; k < corners; ++k) {
      const Vec2 a = p[k], b = p[(k + 1) % corners], c = p[(k + 2) % corners];
      convex = convex && (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
    }
    if (convex || twice_area == 0) continue;
    ++concave;
    EXPECT_EQ(triangulate(polygon(p)).triangles, plain_ears(p)) << "trial " << trial;
  }
  EXPECT_GT(concave, 300u);
}

// Two spirals of 2048 corners, one inside the other: the search for ears was cubic, a minute under a
// sanitizer.
TEST(HostileInput, LongestConcavePolygonIsCut) {
  std::vector<Vec2> p;
  Vec2 way{1, 0};  // turned step by step: no sine
  constexpr std::size_t kHalf = 2048;
  for (std::size_t k = 0; k < kHalf; ++k) {
    p.push_back(way * (10 + 0.02 * static_cast<double>(k)));
    way = {way.x - 0.02 * way.y, way.y + 0.02 * way.x};
    way = way * (1 / std::sqrt(way.x * way.x + way.y * way.y));
  }
  for (std::size_t k = kHalf; k-- > 0;) {
    const Vec2 outer = p[k];
    p.push_back(outer * (1 - 1 / std::sqrt(outer.x * outer.x + outer.y * outer.y)));
  }
  std::vector<Vec2> back(p.rbegin(), p.rend());
  for (const auto& corners : {p, back}) {
    const Mesh mesh = triangulate(polygon(corners));
    ASSERT_EQ(mesh.triangles.size(), corners.size() - 2);
    double twice_sum = 0, twice_area = 0;
    for (const auto& [a, b, c] : mesh.triangles)
      twice_sum += cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 a = corners[k], b = corners[(k + 1) % corners.size()];
      twice_area += a.x * b.y - a.y * b.x;
    }
    EXPECT_NEAR(twice_sum / twice_area, 1, 1e-9);
  }
}

// A direction whose square underflows: up was not a number.
TEST(HostileInput, CamerasOfAnyFiniteWayAreUpright) {
  constexpr double kTiny = 5e-324, kFewRoundings = 1e-12;
  for (const Vec3 way : {Vec3{1e-200, 0, -1}, Vec3{0, kTiny, 1}, Vec3{kTiny, 0, 0}, Vec3{0, 0, -3e-162},
                         Vec3{3e-162, 1e-200, -2e-162}, Vec3{1e300, -1e300, 1e300}, Vec3{1e308, 0, 1}}) {
    const Camera camera = make_camera({0, 0, 0}, way, 60, 640, 360);
    EXPECT_NEAR(length(camera.forward), 1, kFewRoundings);
    EXPECT_NEAR(length(camera.up), 1, kFewRoundings);
    EXPECT_NEAR(dot(camera.forward, camera.up), 0, kFewRoundings);
    const double longest = std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)});
    const Vec3 scaled{way.x / longest, way.y / longest, way.z / longest};
    EXPECT_NEAR(dot(camera.forward, normalized(scaled)), 1, kFewRoundings);
  }
  EXPECT_THAT(input_error([] {
                (void)make_camera({-1e308, 0, 0}, {1e308, 0, 0}, 60, 640, 360);
              }),
              HasSubstr("too far"));
  EXPECT_THAT(input_error([] {
                (void)make_camera({0, 0, 0}, {0, 1, 0}, kTiny, 640, 360);
              }),
              HasSubstr("too narrow"));
}

TEST(HostileInput, SuiteFromMemoryIsTheFileS) {
  const std::filesystem::path path =
      std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenarios/suites/smoke.toml";
  EXPECT_EQ(parse_suite(read_toml_text(path), path), load_suite(path));
}

}  // namespace
}  // namespace plumbline
