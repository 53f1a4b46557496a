// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What readers hand on: any small mesh, before the oracles that `plumbline check` asks first. Input: a byte
// for the number of vertices, three bytes a vertex, three a triangle.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "oracle/conformity.h"
#include "oracle/soundness.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace plumbline;

constexpr std::size_t kMostVertices = 12, kMostTriangles = 16;

/// Mostly a small lattice, where edges meet; the rest is what doubles can be.
double coordinate(std::uint8_t byte) {
  static constexpr std::array<double, 16> kHard{-0.0,
                                                0.5,
                                                1.0 / 3,
                                                0.1,
                                                1e-300,
                                                5e-324,
                                                1e300,
                                                -1e308,
                                                std::numeric_limits<double>::max(),
                                                0x1p53,
                                                4.0 - 0x1p-51,
                                                4.0 + 0x1p-50,
                                                1e17,
                                                -1.0,
                                                std::numeric_limits<double>::infinity(),
                                                std::numeric_limits<double>::quiet_NaN()};
  return byte < 240 ? byte % 8 : kHard[byte - 240u];
}

struct Bytes {
  const std::uint8_t* data;
  std::size_t left;
  std::uint8_t next() { return left == 0 ? std::uint8_t{0} : (--left, *data++); }
};

Mesh mesh_of(Bytes bytes) {
  Mesh mesh;
  const std::size_t vertices = bytes.next() % (kMostVertices + 1);
  for (std::size_t v = 0; v < vertices; ++v) {
    const double x = coordinate(bytes.next()), y = coordinate(bytes.next());
    mesh.positions.push_back({x, y, coordinate(bytes.next())});
  }
  while (bytes.left >= 3 && mesh.triangles.size() < kMostTriangles) {
    // One index in many is one too high.
    const auto index = [&] { return static_cast<std::uint32_t>(bytes.next() % (vertices + 1)); };
    const std::uint32_t a = index(), b = index();
    mesh.triangles.push_back({a, b, index()});
  }
  return mesh;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Mesh mesh = mesh_of({data, size});
  PlanDomain domain;
  domain.add_rectangle({0, 0}, {4, 4});
  const auto plan = oracle::check_conformity(mesh, domain);
  const auto space = oracle::check_soundness(mesh);
  fuzz::require(plan.clean() == plan.findings.empty(), "O1 counts what it lists");
  fuzz::require(space.clean() == space.findings.empty(), "O7 counts what it lists");
  if (plan.clean()) {
    double twice_area = 0;
    for (const auto& [a, b, c] : mesh.triangles)
      twice_area += cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z;
    fuzz::require(std::fabs(twice_area - 32) < 1e-9, "a clean mesh covers the domain once");
  }
  for (auto& [a, b, c] : mesh.triangles) {
    std::swap(a, b);
    std::swap(b, c);
  }
  fuzz::require(oracle::check_conformity(mesh, domain).counts == plan.counts, "O1: corners have no first");
  fuzz::require(oracle::check_soundness(mesh).counts == space.counts, "O7: corners have no first");
  return 0;
}
