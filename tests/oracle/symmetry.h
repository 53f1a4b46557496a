// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "scenarios/camera.h"
#include "scenarios/mesh.h"
#include "scenarios/random.h"
#include "scenarios/terrain.h"

/// What must not change a verdict: the eight symmetries of the grid, scaling by powers of two, shifts by
/// exactly representable vectors, other orders. Each moves a whole scene (mesh, domain, terrain, camera)
/// without a rounding, provided that its coordinates are multiples of 2⁻²⁰ of moderate size (`dyadic`).
namespace plumbline::test {

/// Coordinates that every move below carries exactly.
inline double dyadic(double c) { return std::floor(c * 0x1p20 + 0.5) * 0x1p-20; }
inline Vec3 dyadic(Vec3 p) { return {dyadic(p.x), dyadic(p.y), dyadic(p.z)}; }

/// p → scale · (symmetry of p) + shift.
struct Move {
  bool transpose = false, flip_x = false, flip_y = false;
  double scale = 1;
  Vec3 shift{};

  [[nodiscard]] bool mirrors() const { return transpose ^ flip_x ^ flip_y; }
  /// Direction, without the shift.
  [[nodiscard]] Vec3 turned(Vec3 p) const {
    if (transpose) std::swap(p.x, p.y);
    return {flip_x ? -p.x : p.x, flip_y ? -p.y : p.y, p.z};
  }
  [[nodiscard]] Vec3 operator()(Vec3 p) const { return turned(p) * scale + shift; }
  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    const Vec3 q = (*this)(Vec3{p.x, p.y, 0});
    return {q.x + 0.0, q.y + 0.0};
  }
  [[nodiscard]] std::string name() const {
    return std::string(transpose ? "transposed " : "") + (flip_x ? "x flipped " : "") +
           (flip_y ? "y flipped " : "") + "scale " + std::to_string(scale) + " shift " +
           std::to_string(shift.x) + ", " + std::to_string(shift.y) + ", " + std::to_string(shift.z);
  }

  [[nodiscard]] Mesh operator()(Mesh mesh) const {
    for (Vec3& p : mesh.positions) p = (*this)(p);
    if (mirrors()) {
      for (auto& c : mesh.triangles) std::swap(c[1], c[2]);
    }
    return mesh;
  }
  [[nodiscard]] PlanDomain operator()(PlanDomain domain) const {
    for (auto& loop : domain.loops) {
      for (Vec2& p : loop) p = (*this)(p);
      if (mirrors()) std::reverse(loop.begin(), loop.end());
    }
    return domain;
  }
  /// A mirrored camera keeps forward and up; its right is the mirrored left, so its picture is the mirrored
  /// picture.
  [[nodiscard]] Camera operator()(Camera camera) const {
    camera.position = (*this)(camera.position);
    camera.forward = turned(camera.forward);
    camera.up = turned(camera.up);
    return camera;
  }
};

inline Move symmetry(int number) { return {(number & 1) != 0, (number & 2) != 0, (number & 4) != 0}; }

/// A symmetry that maps the terrain's own rectangle to one that begins at the origin again.
inline Move symmetry_of(int number, const Terrain& terrain) {
  Move move = symmetry(number);
  const double w = move.transpose ? terrain.depth_m() : terrain.width_m();
  const double d = move.transpose ? terrain.width_m() : terrain.depth_m();
  move.shift = {move.flip_x ? w : 0, move.flip_y ? d : 0, 0};
  return move;
}

/// The terrain moved along: by a `symmetry_of` it, or a scale, or a shift of heights.
inline Terrain moved(const Terrain& terrain, const Move& move) {
  Terrain result = terrain;
  if (move.transpose) std::swap(result.columns, result.rows);
  result.spacing_m = terrain.spacing_m * move.scale;
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      int u = move.transpose ? j : i, v = move.transpose ? i : j;
      if (move.flip_x) u = result.columns - 1 - u;
      if (move.flip_y) v = result.rows - 1 - v;
      result.heights_m[result.index(u, v)] = terrain.z(i, j) * move.scale + move.shift.z;
    }
  }
  return result;
}

/// The same mesh, told in another order: triangles, vertices, and the corner that each triangle begins with.
struct Shuffled {
  Mesh mesh;
  std::vector<std::uint32_t> vertex;    ///< where each old vertex went
  std::vector<std::uint32_t> triangle;  ///< where each old triangle went
};

inline std::vector<std::uint32_t> random_order(std::size_t count, Random& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

inline Shuffled shuffled(const Mesh& mesh, Random& random) {
  Shuffled s{mesh, random_order(mesh.positions.size(), random), random_order(mesh.triangles.size(), random)};
  for (std::size_t v = 0; v < s.vertex.size(); ++v) s.mesh.positions[s.vertex[v]] = mesh.positions[v];
  for (std::size_t t = 0; t < s.triangle.size(); ++t) {
    auto corners = mesh.triangles[t];
    for (auto& c : corners) c = c < s.vertex.size() ? s.vertex[c] : c;
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                corners.end());
    s.mesh.triangles[s.triangle[t]] = corners;
  }
  return s;
}

/// The four ways a fault can face, in plan.
inline constexpr std::array<const char*, 4> kDirections{"+x", "-x", "+y", "-y"};
/// The direction a vector mostly points to; both of a diagonal's.
inline std::vector<std::size_t> directions(Vec2 v) {
  std::vector<std::size_t> all;
  if (v.x == 0 && v.y == 0) return all;
  if (std::fabs(v.x) >= std::fabs(v.y)) all.push_back(v.x > 0 ? 0 : 1);
  if (std::fabs(v.y) >= std::fabs(v.x)) all.push_back(v.y > 0 ? 2 : 3);
  return all;
}

}  // namespace plumbline::test
