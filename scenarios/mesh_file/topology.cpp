// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What files leave open: vertices that are one, and vertices that should be several.
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "scenarios/mesh_file/mesh_file.h"
#include "scenarios/point_table.h"

namespace plumbline {

Mesh welded(const Mesh& mesh) {
  std::vector<std::uint32_t> first(mesh.positions.size()), of_number;
  PointTable table(mesh.positions.size());
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    const std::uint32_t number = table.number(mesh.positions[v]);
    if (number == of_number.size()) of_number.push_back(v);
    first[v] = of_number[number];
  }
  Mesh out;
  constexpr std::uint32_t kNew = 0xffffffff;
  std::vector<std::uint32_t> index(mesh.positions.size(), kNew);
  for (auto t : mesh.triangles) {
    for (std::uint32_t& v : t) v = first[v];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::uint32_t& v : t) {
      if (index[v] == kNew) {
        index[v] = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(mesh.positions[v]);
      }
      v = index[v];
    }
    out.triangles.push_back(t);
  }
  return out;
}

Mesh cut_to_manifold(const Mesh& mesh) {
  // Corner 3t + k is the k-th of triangle t. Corners that a sound edge joins are one vertex.
  struct HalfEdge {
    std::array<std::uint32_t, 2> ends;  // ascending
    std::size_t corner;                 // where it starts
    bool upwards;
  };
  const auto next = [](std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  std::vector<HalfEdge> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      edges.push_back({{std::min(a, b), std::max(a, b)}, 3 * t + k, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::pair(a.ends, a.corner) < std::pair(b.ends, b.corner);
  });
  std::vector<std::size_t> joined(edges.size());
  std::iota(joined.begin(), joined.end(), std::size_t{0});
  const auto root = [&](std::size_t c) {
    while (joined[c] != c) c = joined[c] = joined[joined[c]];
    return c;
  };
  // The least corner stands for all: a result that does not depend on the order of joining.
  const auto join = [&](std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    joined[std::max(a, b)] = std::min(a, b);
  };
  for (std::size_t e = 0, end = 0; e < edges.size(); e = end) {
    while (end < edges.size() && edges[end].ends == edges[e].ends) ++end;
    if (end - e != 2 || edges[e].upwards == edges[e + 1].upwards) continue;
    join(edges[e].corner, next(edges[e + 1].corner));
    join(next(edges[e].corner), edges[e + 1].corner);
  }
  Mesh out;
  constexpr std::uint32_t kNew = 0xffffffff;
  std::vector<std::uint32_t> index(edges.size(), kNew);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> now{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& v = index[root(3 * t + k)];
      if (v == kNew) {
        v = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(mesh.positions[mesh.triangles[t][k]]);
      }
      now[k] = v;
    }
    out.triangles.push_back(now);
  }
  return out;
}

}  // namespace plumbline
