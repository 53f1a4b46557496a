// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, the mesh of the scene moved by a symmetry of the grid is the
// mesh moved by it, as a set of triangles: the eight symmetries of the square (of which a rectangle keeps
// eight too, with sides exchanged). A method whose root diagonal or tile order picks a direction cannot keep
// all of them; where it does not promise them, the share that differs is a measurement. Source: METHODS
// M3.S5, ORACLES "Invariance".

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

/// First mirrored in x, in y, then x and y exchanged.
struct Symmetry {
  const char* name;
  bool mirror_x, mirror_y, exchange;
};
constexpr std::array<Symmetry, 7> kSymmetries{{
    // The four (with the identity) that keep the direction of a cell's diagonal …
    {"transpose", false, false, true},
    {"half_turn", true, true, false},
    {"antitranspose", true, true, true},
    // … and the four that turn it.
    {"mirror_x", true, false, false},
    {"mirror_y", false, true, false},
    {"quarter_turn", false, true, true},
    {"three_quarter_turn", true, false, true},
}};

Vec3 turned(Vec3 v, const Symmetry& s) {
  const Vec3 m{s.mirror_x ? -v.x : v.x, s.mirror_y ? -v.y : v.y, v.z};
  return s.exchange ? Vec3{m.y, m.x, m.z} : m;
}

Vec3 moved(Vec3 p, const Symmetry& s, const Terrain& terrain) {
  const Vec3 m{s.mirror_x ? terrain.width_m() - p.x : p.x, s.mirror_y ? terrain.depth_m() - p.y : p.y, p.z};
  return s.exchange ? Vec3{m.y, m.x, m.z} : m;
}

Terrain moved(const Terrain& terrain, const Symmetry& s) {
  Terrain result = terrain;
  if (s.exchange) std::swap(result.columns, result.rows);
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const int a = s.mirror_x ? terrain.columns - 1 - i : i;
      const int b = s.mirror_y ? terrain.rows - 1 - j : j;
      result.heights_m[s.exchange ? result.index(b, a) : result.index(a, b)] = terrain.z(i, j);
    }
  }
  return result;
}

/// The camera's axes are turned with it (a mirror makes its picture a mirror image); rebuilding it from a
/// pose would choose another up direction where it looks straight down.
Camera moved(Camera camera, const Symmetry& s, const Terrain& terrain) {
  camera.position = moved(camera.position, s, terrain);
  camera.forward = turned(camera.forward, s);
  camera.up = turned(camera.up, s);
  return camera;
}

using Corner = std::array<double, 3>;
using TriangleSet = std::vector<std::array<Corner, 3>>;

TriangleSet triangle_set(const Mesh& mesh) {
  TriangleSet set;
  set.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.positions.at(triangle[k]);
      corners[k] = {p.x, p.y, p.z};
    }
    std::sort(corners.begin(), corners.end());
    set.push_back(corners);
  }
  std::sort(set.begin(), set.end());
  return set;
}

LawOutcome check(const LawInput& input) {
  const std::vector<Camera> flight = cameras(input);
  const LodFrame frame = fly(*prepared_method(input), flight);
  if (frame.mesh.triangles.empty()) return vacuous("nothing was drawn");

  LawOutcome outcome = held();
  for (const Symmetry& symmetry : kSymmetries) {
    LawInput image = input;
    image.terrain = moved(input.terrain, symmetry);
    std::vector<Camera> image_flight;
    for (const Camera& camera : flight) image_flight.push_back(moved(camera, symmetry, input.terrain));
    const LodFrame got = fly(*prepared_method(image), image_flight);

    Mesh expected = frame.mesh;
    for (Vec3& p : expected.positions) p = moved(p, symmetry, input.terrain);
    const TriangleSet want = triangle_set(expected);
    const TriangleSet have = triangle_set(got.mesh);
    const bool same = want == have;
    outcome.parts.push_back({symmetry.name, same});
    if (same || outcome.kind == LawOutcome::Kind::violated) continue;

    // Where the two first differ, told in the moved scene.
    const auto [w, h] = std::mismatch(want.begin(), want.end(), have.begin(), have.end());
    const Corner at = w != want.end() ? (*w)[0] : (*h)[0];
    outcome.kind = LawOutcome::Kind::violated;
    outcome.what =
        fmt::format("{}: {} triangles moved, {} in the moved scene; they differ from ({}, {}, {}) on",
                    symmetry.name, want.size(), have.size(), at[0], at[1], at[2]);
    outcome.finding = law_finding(symmetry.name, {at[0], at[1], at[2]});
  }
  return outcome;
}

}  // namespace

Law law_symmetric() {
  return {
      .id = "symmetric",
      .statement =
          "for every terrain, flight and threshold, the mesh commutes with the eight symmetries of the grid",
      .source = "METHODS M3.S5; ORACLES, Invariance",
      .applies = [](const MethodChoice&) { return true; },
      .promised = [](const MethodChoice& choice) { return choice.promises(Promise::symmetric); },
      .check = check};
}

}  // namespace plumbline::properties
