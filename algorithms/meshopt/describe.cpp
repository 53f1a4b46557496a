// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// meshopt: what an engine's programmer would do today. Role: a reference that knows no camera, simplified
// once to a number of triangles.
//
// Source: meshoptimizer's meshopt_simplify (Kapoulkine), quadric errors after Garland & Heckbert, "Surface
// simplification using quadric error metrics", SIGGRAPH 1997. Promises and departures: README.md.
#include <cstddef>
#include <vector>

#include <meshoptimizer.h>

#include "algorithms/registry.h"
#include "algorithms/simplified/simplified.h"

namespace plumbline {
namespace {

/// Borders locked; no limit on the error but the mesh's extent. meshoptimizer computes in floats and only
/// chooses triangles: positions keep their doubles.
Mesh simplify(const Mesh& full, std::size_t triangles) {
  std::vector<float> positions;
  positions.reserve(3 * full.positions.size());
  // Near the origin, where a float has the most to say.
  const Vec3 origin = full.positions.empty() ? Vec3{} : full.positions.front();
  for (const Vec3 p : full.positions) {
    positions.push_back(static_cast<float>(p.x - origin.x));
    positions.push_back(static_cast<float>(p.y - origin.y));
    positions.push_back(static_cast<float>(p.z - origin.z));
  }
  std::vector<unsigned int> indices;
  indices.reserve(3 * full.triangles.size());
  for (const auto& triangle : full.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  std::vector<unsigned int> left(indices.size());
  constexpr float kAnyError = 1;  // of the mesh's extent
  left.resize(meshopt_simplify(left.data(), indices.data(), indices.size(), positions.data(),
                               full.positions.size(), 3 * sizeof(float), 3 * triangles, kAnyError,
                               meshopt_SimplifyLockBorder, nullptr));
  Mesh out;
  out.positions = full.positions;
  for (std::size_t k = 0; k + 2 < left.size(); k += 3)
    out.triangles.push_back({left[k], left[k + 1], left[k + 2]});
  return out;
}

}  // namespace

MethodDescription describe_meshopt() {
  using enum Promise;
  return {
      .id = "meshopt",
      .title = "meshoptimizer's simplify to a triangle count, view-independent",
      .citation =
          "Kapoulkine, meshoptimizer (meshopt_simplify); Garland & Heckbert, \"Surface simplification using "
          "quadric error metrics\", SIGGRAPH 1997",
      .section = "reference",
      .variants = {{"",
                    "meshopt_simplify, borders locked",
                    {covers_domain, idempotent, path_independent, exact_at_zero, continuous_in_camera}}},
      .options = {simplified::triangles_option()},
      .claims = {},
      .takes_objects = true,
      .make =
          [](std::string_view, const Options& options) {
            return simplified::make_simplified(simplify, simplified::read_settings("meshopt", options));
          },
  };
}

}  // namespace plumbline
