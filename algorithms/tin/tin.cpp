// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/tin/tin.h"

#include <algorithm>

namespace plumbline::tin {

Tin grid_tin(const Terrain& terrain) { return {reference_mesh(terrain), {}}; }

Adjacency::Adjacency(const Tin& tin) {
  const std::size_t vertices = tin.mesh.positions.size();
  first_triangle_.assign(vertices + 1, 0);
  for (const auto& t : tin.mesh.triangles) {
    for (const std::uint32_t v : t) ++first_triangle_[v + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) first_triangle_[v + 1] += first_triangle_[v];
  triangles_.resize(first_triangle_.back());
  std::vector<std::uint32_t> next(first_triangle_.begin(), first_triangle_.end() - 1);
  for (std::size_t t = 0; t < tin.mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : tin.mesh.triangles[t]) triangles_[next[v]++] = static_cast<std::uint32_t>(t);
  }

  std::vector<Edge> sides;
  sides.reserve(3 * tin.mesh.triangles.size());
  for (const auto& t : tin.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t u = t[k];
      const std::uint32_t v = t[(k + 1) % 3];
      sides.push_back({std::min(u, v), std::max(u, v)});
    }
  }
  std::sort(sides.begin(), sides.end());
  border_vertex_.assign(vertices, 0);
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k + 1;
    while (end < sides.size() && sides[end] == sides[k]) ++end;
    const bool border = end - k == 1;
    edges_.push_back(sides[k]);
    border_.push_back(border ? 1 : 0);
    road_.push_back(std::binary_search(tin.roads.begin(), tin.roads.end(), sides[k]) ? 1 : 0);
    if (border) border_vertex_[sides[k][0]] = border_vertex_[sides[k][1]] = 1;
    k = end;
  }

  first_edge_.assign(vertices + 1, 0);
  for (const Edge& e : edges_) {
    for (const std::uint32_t v : e) ++first_edge_[v + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) first_edge_[v + 1] += first_edge_[v];
  edges_at_.resize(first_edge_.back());
  next.assign(first_edge_.begin(), first_edge_.end() - 1);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    for (const std::uint32_t v : edges_[e]) edges_at_[next[v]++] = static_cast<std::uint32_t>(e);
  }
}

bool Adjacency::joined_on_border(std::uint32_t u, std::uint32_t v) const {
  if (border_vertex_[u] == 0 || border_vertex_[v] == 0) return false;
  const Edge wanted{std::min(u, v), std::max(u, v)};
  const auto at_u = edges_at(u);
  return std::any_of(at_u.begin(), at_u.end(),
                     [&](std::uint32_t e) { return border_[e] != 0 && edges_[e] == wanted; });
}

}  // namespace plumbline::tin
