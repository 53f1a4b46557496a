// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/faults/halves.h"

#include <algorithm>
#include <utility>

#include "properties/faults/sites.h"

namespace plumbline::faults {
namespace {

/// The given triangles with the vertices that they use, in order of first use.
Mesh part(const Mesh& whole, const std::vector<std::uint32_t>& triangles) {
  Mesh out;
  std::vector<std::uint32_t> number(whole.positions.size(), kNobody);
  for (const std::uint32_t t : triangles) {
    auto corners = whole.triangles[t];
    for (std::uint32_t& v : corners) {
      if (number[v] == kNobody) {
        number[v] = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(whole.positions[v]);
      }
      v = number[v];
    }
    out.triangles.push_back(corners);
  }
  return out;
}

using Key = std::array<double, 6>;
Key key(const Vec3& a, const Vec3& b) { return {a.x, a.y, a.z, b.x, b.y, b.z}; }

std::vector<std::pair<Key, std::uint32_t>> edges_of(const Mesh& mesh) {
  std::vector<std::pair<Key, std::uint32_t>> out;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    for (int k = 0; k < 3; ++k)
      out.emplace_back(key(mesh.positions[c[at(k)]], mesh.positions[c[at(k + 1)]]), t);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::optional<Halves> cut_in_two(const Surface& surface, Random& random) {
  const Mesh& mesh = surface.mesh;
  const double x = random.between(-1, 1), y = random.between(-1, 1);
  const auto along = [&](std::uint32_t t) {
    double sum = 0;
    for (const std::uint32_t v : mesh.triangles[t]) sum += x * mesh.positions[v].x + y * mesh.positions[v].y;
    return sum;
  };
  const double limit = along(static_cast<std::uint32_t>(random.below(mesh.triangles.size())));
  std::array<std::vector<std::uint32_t>, 2> sides;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sides[along(t) < limit ? 0 : 1].push_back(t);
  if (sides[0].empty() || sides[1].empty()) return std::nullopt;
  Halves halves{part(mesh, sides[0]), part(mesh, sides[1]), {}};
  const auto second = edges_of(halves.second);
  for (const auto& [edge, t] : edges_of(halves.first)) {
    const Key back{edge[3], edge[4], edge[5], edge[0], edge[1], edge[2]};
    const auto found = std::lower_bound(second.begin(), second.end(), std::pair{back, 0u});
    if (found == second.end() || found->first != back) continue;
    halves.seam.push_back({{{{edge[0], edge[1], edge[2]}, {edge[3], edge[4], edge[5]}}}, t, found->second});
  }
  if (halves.seam.empty()) return std::nullopt;
  return halves;
}

}  // namespace plumbline::faults
