// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "algorithms/vertex_tree/stars.h"
#include "scenarios/error.h"

namespace plumbline::vertex_tree {
namespace {

struct Side {
  std::uint32_t low, high, triangle;
  bool forward;  // runs from low to high in its triangle
};

void require_edges(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t end = first;
    while (end < sides.size() && sides[end].low == sides[first].low && sides[end].high == sides[first].high)
      ++end;
    const Vec3 p = mesh.positions[sides[first].low], q = mesh.positions[sides[first].high];
    const auto place = [&] {
      return fmt::format("edge {}-{} from ({}, {}, {}) to ({}, {}, {})", sides[first].low, sides[first].high,
                         p.x, p.y, p.z, q.x, q.y, q.z);
    };
    if (end - first > 2) {
      throw InputError(
          fmt::format("mesh is not manifold: {} belongs to {} triangles, of which an edge has two "
                      "at most; separate the sheets that meet there",
                      place(), end - first));
    }
    if (end - first == 2 && sides[first].forward == sides[first + 1].forward) {
      throw InputError(
          fmt::format("mesh is not oriented: triangles {} and {} run the same way along {}; turn "
                      "one of them",
                      sides[first].triangle, sides[first + 1].triangle, place()));
    }
    first = end;
  }
}

// With sound edges a vertex's triangles form fans; it may have one.
void require_single_fans(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> stars(mesh.positions.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const auto v : mesh.triangles[t]) stars[v].push_back(t);
  }
  std::vector<std::array<std::uint32_t, 2>> links;
  for (std::uint32_t v = 0; v < stars.size(); ++v) {
    links.clear();
    for (const auto t : stars[v]) links.push_back(others(mesh.triangles[t], v));
    if (links.empty()) continue;
    // Walk back to a border, if there is one, then forward; what is not met belongs to another fan.
    std::uint32_t start = links[0][0];
    for (std::size_t steps = 0; steps < links.size(); ++steps) {
      const auto before =
          std::find_if(links.begin(), links.end(), [&](const auto& l) { return l[1] == start; });
      if (before == links.end()) break;
      start = (*before)[0];
    }
    std::size_t met = 0;
    for (std::uint32_t at = start; met < links.size(); ++met) {
      const auto next = std::find_if(links.begin(), links.end(), [&](const auto& l) { return l[0] == at; });
      if (next == links.end()) break;
      at = (*next)[1];
      if (at == start) {
        ++met;
        break;
      }
    }
    if (met < links.size()) {
      const Vec3 p = mesh.positions[v];
      throw InputError(
          fmt::format("mesh is not manifold: vertex {} at ({}, {}, {}) joins two fans of triangles, "
                      "the second at edge {}-{}; give each fan a vertex of its own",
                      v, p.x, p.y, p.z, v, links.back()[0]));
    }
  }
}

}  // namespace

void require_manifold(const Mesh& mesh) {
  if (mesh.triangles.empty()) throw InputError("mesh has no triangles");
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError(fmt::format("mesh vertex {} has a coordinate that is not finite", v));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (std::max({a, b, c}) >= mesh.positions.size())
      throw InputError(fmt::format("mesh triangle {} names vertex {}, of {} vertices", t, std::max({a, b, c}),
                                   mesh.positions.size()));
    if (a == b || b == c || c == a)
      throw InputError(fmt::format("mesh triangle {} names vertex {} twice", t, a == b ? a : c));
  }
  require_edges(mesh);
  require_single_fans(mesh);
}

}  // namespace plumbline::vertex_tree
