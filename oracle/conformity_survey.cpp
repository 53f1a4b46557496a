// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Station 1 of check_conformity: every vertex and triangle once.
#include <cmath>

#include "oracle/conformity_parts.h"
#include "oracle/predicates.h"

namespace plumbline::oracle::detail {
namespace {

bool is_finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
Vec2 plan(const Vec3& p) { return {p.x, p.y}; }

}  // namespace

Survey survey(const Mesh& mesh) {
  Survey found;
  const auto vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (!is_finite(mesh.positions[v])) found.non_finite.push_back(v);
  }
  std::vector<std::uint8_t> broken(found.non_finite.empty() ? 0 : vertex_count);
  for (const std::uint32_t v : found.non_finite) broken[v] = 1;

  std::vector<std::uint8_t> used(vertex_count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const auto id = static_cast<std::uint32_t>(t);
    if (a >= vertex_count || b >= vertex_count || c >= vertex_count) {
      found.bad_index.push_back(id);
      for (const std::uint32_t v : {a, b, c}) {
        if (v < vertex_count) used[v] = 1;
      }
      continue;
    }
    used[a] = used[b] = used[c] = 1;
    if (!broken.empty() && (broken[a] | broken[b] | broken[c]) != 0) {
      found.touching_non_finite.push_back(id);
      continue;
    }
    const Sign sign = orientation(plan(mesh.positions[a]), plan(mesh.positions[b]), plan(mesh.positions[c]));
    if (sign.by != DecidedBy::double_filter) ++found.exact_orientations;
    if (sign.value > 0) continue;
    if (sign.value < 0) {
      found.negative.push_back(id);
    } else if (a == b || b == c || c == a) {
      found.repeated.push_back(id);
    } else {
      found.collinear.push_back(id);
    }
  }
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (used[v] == 0 && (broken.empty() || broken[v] == 0)) found.unused.push_back(v);
  }
  return found;
}

}  // namespace plumbline::oracle::detail
