// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/glb.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/check_report.h"
#include "scenarios/mesh_file/mesh_file.h"
#include "tests/reports/sample_check.h"

namespace plumbline::reports {
namespace {

constexpr std::array<double, 3> kRed{1, 0, 0}, kGrey{0.5, 0.5, 0.5};

std::uint32_t word_at(const std::string& glb, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= std::uint32_t{static_cast<unsigned char>(glb.at(at + k))} << (8 * k);
  return value;
}

Json document_of(const std::string& glb) { return Json::parse(glb.substr(20, word_at(glb, 12))); }

/// The triangles that our own reader finds, with glTF's axes turned back to z up, in the order of the parts.
std::vector<std::array<Vec3, 3>> read_back(const std::string& glb) {
  const Mesh mesh = triangulate(parse_mesh(glb, "spot.glb"));
  std::vector<std::array<Vec3, 3>> out;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.positions[triangle[k]];
      corners[k] = {p.x, -p.z, p.y};
    }
    out.push_back(corners);
  }
  return out;
}

std::array<Vec3, 3> corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

std::vector<std::uint32_t> all_of(const Mesh& mesh) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) out.push_back(t);
  return out;
}

TEST(Glb, ReadsBackBitForBitFarFromTheOrigin) {
  const verdict::CheckSpot spot = sample::check_spot("spot", 0);
  ASSERT_EQ(spot.marked.size(), 2u);
  const auto triangles = read_back(spot_glb({}, spot));
  ASSERT_EQ(triangles.size(), spot.mesh.triangles.size());
  std::vector<std::array<Vec3, 3>> wanted;  // the rest first, then the marked
  for (const std::uint32_t t : all_of(spot.mesh))
    if (std::ranges::find(spot.marked, t) == spot.marked.end()) wanted.push_back(corners_of(spot.mesh, t));
  for (const std::uint32_t t : spot.marked) wanted.push_back(corners_of(spot.mesh, t));
  EXPECT_EQ(triangles, wanted);
}

TEST(Glb, FinerCoordinatesKeepTwentyFourBitsOfTheExtent) {
  Mesh mesh;
  mesh.positions = {
      {4400000.1, 600000.7, 812.3}, {4400300.9, 600000.1, 815.77}, {4400100.3, 600299.9, 990.1}};
  mesh.triangles = {{0, 1, 2}};
  const auto read = read_back(glb_bytes("fine", mesh, {{"m", kGrey, {0}}}));
  ASSERT_EQ(read.size(), 1u);
  const double bound = 301 * std::ldexp(1.0, -24);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(read[0][k].x, mesh.positions[k].x, bound);
    EXPECT_NEAR(read[0][k].y, mesh.positions[k].y, bound);
    EXPECT_NEAR(read[0][k].z, mesh.positions[k].z, bound);
  }
}

TEST(Glb, ContainerIsWhatTheSpecificationSays) {
  const std::string glb = spot_glb({}, sample::check_spot("spot", 0));
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word_at(glb, 4), 2u);
  EXPECT_EQ(word_at(glb, 8), glb.size());
  const std::size_t text = word_at(glb, 12);
  EXPECT_EQ(text % 4, 0u);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  const std::size_t binary = word_at(glb, 20 + text);
  EXPECT_EQ(binary % 4, 0u);
  EXPECT_EQ(glb.substr(24 + text, 4), std::string("BIN\0", 4));
  EXPECT_EQ(glb.size(), 28 + text + binary);

  const Json document = document_of(glb);
  EXPECT_EQ(document["asset"]["version"], "2.0");
  EXPECT_EQ(document["buffers"][0]["byteLength"], binary);
  for (const Json& view : document["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), binary);
  }
}

TEST(Glb, BoundsOfThePositionsAreTheirBounds) {
  const std::string glb = spot_glb({}, sample::check_spot("spot", 0));
  const Json document = document_of(glb);
  const Json& accessor = document["accessors"][0];
  ASSERT_EQ(accessor["type"], "VEC3");
  const std::size_t from =
      28 + word_at(glb, 12) +
      document["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>();
  std::array<float, 3> low{1e30F, 1e30F, 1e30F}, high{-1e30F, -1e30F, -1e30F};
  for (std::size_t i = 0; i < accessor["count"].get<std::size_t>() * 3; ++i) {
    const std::uint32_t bits = word_at(glb, from + 4 * i);
    float value = 0;
    std::memcpy(&value, &bits, 4);
    low[i % 3] = std::min(low[i % 3], value);
    high[i % 3] = std::max(high[i % 3], value);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(accessor["min"][c].get<float>(), low[c]);
    EXPECT_EQ(accessor["max"][c].get<float>(), high[c]);
    EXPECT_LT(high[c] - low[c], 32) << "positions are relative to the node";
  }
}

TEST(Glb, WitnessesHaveAMaterialOfTheirOwn) {
  verdict::CheckVerdict check = sample::tiles_check();
  const Json document = document_of(spot_glb(check, sample::check_spot("01-crack", 0)));
  const Json& primitives = document["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2u);
  EXPECT_NE(primitives[0]["material"], primitives[1]["material"]);
  const Json& red = document["materials"][primitives[1]["material"].get<std::size_t>()];
  EXPECT_EQ(red["name"], "witnesses");
  EXPECT_EQ(red["doubleSided"], true);
  EXPECT_GT(red["pbrMetallicRoughness"]["baseColorFactor"][0], 0.5);
  EXPECT_LT(red["pbrMetallicRoughness"]["baseColorFactor"][1], 0.1);
  const Json& node = document["nodes"][1];
  EXPECT_EQ(node["name"], "01-crack");
  EXPECT_EQ(node["extras"]["code"], 302);
  EXPECT_EQ(node["extras"]["message"], check.findings[0].message);
  EXPECT_EQ(node["extras"]["at"][2], check.findings[0].at.z);
}

TEST(Glb, WhatCannotBeDrawnIsLeftOut) {
  Mesh mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 7}};
  const std::string glb = glb_bytes("part", mesh, {{"a", kGrey, {0, 1, 2}}, {"b", kRed, {1, 2, 99}}});
  const Json document = document_of(glb);
  EXPECT_EQ(document["accessors"][0]["count"], 3) << "the unused vertex is left out";
  EXPECT_EQ(document["meshes"][0]["primitives"].size(), 1u) << "a part without triangles is left out";
  EXPECT_EQ(read_back(glb).size(), 1u);
  EXPECT_EQ(glb_bytes("none", mesh, {{"b", kRed, {1, 2}}}), "");
  EXPECT_EQ(glb_bytes("none", {}, {}), "");
}

TEST(Glb, HugeAndFlatBoxesStayFinite) {
  Mesh mesh;
  mesh.positions = {{-1e308, 5, 0}, {1e308, 5, 0}, {0, 5, 1e-300}};
  mesh.triangles = {{0, 1, 2}};
  const Json document = document_of(glb_bytes("huge", mesh, {{"m", kGrey, {0}}}));
  for (const Json& number : document["nodes"][1]["translation"]) EXPECT_TRUE(number.is_number());
  for (const Json& number : document["accessors"][0]["max"]) EXPECT_TRUE(number.is_number());
}

}  // namespace
}  // namespace plumbline::reports
