// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/soundness.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scenarios/instrument.h"

namespace plumbline::oracle {
namespace {

Mesh tetrahedron() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

TEST(Soundness, ClosedOpenAndShippedMeshesAreClean) {
  EXPECT_TRUE(check_soundness(tetrahedron()).clean());
  Mesh open = tetrahedron();
  open.triangles.pop_back();
  EXPECT_TRUE(check_soundness(open).clean());
  EXPECT_TRUE(check_soundness(instrument_mesh()).clean());
}

TEST(Soundness, EachPlantedFaultIsFoundAtItsPlaceAndNothingElse) {
  struct Fault {
    const char* name;
    void (*plant)(Mesh&);
    ConformityCounts counts;
    FindingCode code;
    const char* kind;
  };
  const auto counts = [](std::size_t ConformityCounts::*count) {
    ConformityCounts one;
    one.*count = 1;
    return one;
  };
  using Counts = ConformityCounts;
  const Fault faults[] = {
      {"bad index",
       [](Mesh& m) {
         m.triangles.push_back({0, 1, 9});
       },
       counts(&Counts::bad_index), FindingCode::bad_index, ""},
      {"not finite",
       [](Mesh& m) {
         m.positions.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
         m.triangles.push_back({0, 1, 4});
       },
       counts(&Counts::non_finite), FindingCode::non_finite, ""},
      {"vertex named twice",
       [](Mesh& m) {
         m.triangles.push_back({0, 1, 1});
       },
       counts(&Counts::degenerate), FindingCode::degenerate, "repeated_vertex"},
      {"no area, exactly",
       [](Mesh& m) {
         for (const double t : {1.0, 2.0, 3.0}) m.positions.push_back({0.1 * t + 5, 5, 5});
         m.positions[4] = {5, 5, 5}, m.positions[5] = {6, 7, 8}, m.positions[6] = {7, 9, 11};
         m.triangles.push_back({4, 5, 6});
       },
       counts(&Counts::degenerate), FindingCode::degenerate, ""},
      {"two the same way",
       [](Mesh& m) {
         m.triangles.pop_back();
         m.triangles.pop_back();
         m.positions.push_back({2, 2, 2});
         m.triangles.push_back({1, 3, 4});
         m.triangles[1] = {0, 1, 3};
       },
       counts(&Counts::non_manifold), FindingCode::non_manifold, "orientation"},
      {"two fans at a vertex",
       [](Mesh& m) {
         for (const Vec3 p : {Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) m.positions.push_back(p);
         m.triangles.push_back({0, 4, 5});
       },
       {},
       FindingCode::non_manifold,
       "vertex"},
      {"unused",
       [](Mesh& m) {
         m.positions.push_back({3, 3, 3});
       },
       counts(&Counts::unused_vertex), FindingCode::unused_vertex, ""},
  };
  for (const Fault& fault : faults) {
    Mesh mesh = tetrahedron();
    fault.plant(mesh);
    ConformityCounts wanted = fault.counts;
    if (fault.code == FindingCode::non_manifold && wanted.non_manifold == 0) {
      wanted.non_manifold = 1;
      wanted.unused_vertex = 1;  // the plant's spare vertex
    }
    const ConformityReport report = check_soundness(mesh);
    EXPECT_EQ(report.counts, wanted) << fault.name;
    ASSERT_FALSE(report.findings.empty()) << fault.name;
    const Finding& first = report.findings.front();
    EXPECT_EQ(first.code, fault.code) << fault.name;
    EXPECT_EQ(first.kind, fault.kind) << fault.name;
  }
}

TEST(Soundness, ATriangleDoubledIsADuplicateAndCrowdsItsEdges) {
  Mesh mesh = tetrahedron();
  mesh.triangles.push_back(mesh.triangles[0]);
  const ConformityReport report = check_soundness(mesh);
  EXPECT_EQ(report.counts.duplicate, 1u);
  EXPECT_EQ(report.counts.non_manifold, 3u);
}

TEST(Soundness, OneUlpMakesTheDifferenceBetweenAreaAndNone) {
  Mesh mesh;
  mesh.positions = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(check_soundness(mesh).counts.degenerate, 1u);
  mesh.positions[2].z = std::nextafter(3.0, 4.0);
  EXPECT_TRUE(check_soundness(mesh).clean());
}

}  // namespace
}  // namespace plumbline::oracle
