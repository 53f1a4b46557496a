// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of the vertex tree share: small random meshes and the slow oracle of the paper's
// definition 1.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "algorithms/vertex_tree/cut.h"
#include "scenarios/portable_math.h"
#include "scenarios/random.h"

namespace plumbline::vertex_tree {

/// A (columns × rows)-cell patch with random heights and diagonals; `wrapped` closes it to a bumpy torus.
inline Mesh random_mesh(Random& random) {
  const bool wrapped = random.below(2) == 0;
  const auto columns = static_cast<std::uint32_t>(3 + random.below(5));
  const auto rows = static_cast<std::uint32_t>(3 + random.below(5));
  const double bump = random.between(0, 0.5);
  const std::uint32_t across = wrapped ? columns : columns + 1, up = wrapped ? rows : rows + 1;
  Mesh mesh;
  for (std::uint32_t j = 0; j < up; ++j) {
    for (std::uint32_t i = 0; i < across; ++i) {
      const double d = bump * random.unit();
      if (wrapped) {
        const double a = 2 * kPi * i / columns, b = 2 * kPi * j / rows, r = 3 + (1 + d) * exact_cos(b);
        mesh.positions.push_back({r * exact_cos(a), r * exact_sin(a), (1 + d) * exact_sin(b)});
      } else {
        mesh.positions.push_back({i + 0.3 * random.unit(), j + 0.3 * random.unit(), d});
      }
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const auto at = [&](std::uint32_t x, std::uint32_t y) { return (y % up) * across + x % across; };
      const auto a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (random.below(2) == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

/// Triangles with their corners, turned so that the least comes first: comparable whatever they were made by.
using Star = std::map<std::uint32_t, std::array<std::uint32_t, 3>>;

inline std::array<std::uint32_t, 3> turned(std::array<std::uint32_t, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// All non-degenerate triangles with a corner at one of `at`, when exactly `present` nodes are: climbs the
/// tree from the full mesh's corners; nothing of Cut is used.
inline Star star_by_climbing(const VertexTree& tree, const std::vector<std::uint8_t>& present,
                             const std::vector<std::uint32_t>& at) {
  Star star;
  for (std::uint32_t t = 0; t < tree.triangles.size(); ++t) {
    auto corners = tree.triangles[t];
    bool near = false;
    for (auto& v : corners) {
      while (!present[v]) v = tree.parent[v];
      near = near || std::find(at.begin(), at.end(), v) != at.end();
    }
    const bool flat = corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    if (near && !flat) star[t] = turned(corners);
  }
  return star;
}

/// The star that each collapse met when the tree was built (definition 1: the boundary, and how it hangs
/// together). Index: identifier − originals.
struct BuildStars {
  std::vector<Star> before, after;

  explicit BuildStars(const VertexTree& tree) {
    std::vector<std::uint8_t> present(tree.nodes(), 0);
    std::fill_n(present.begin(), tree.originals, std::uint8_t{1});
    for (std::size_t k = 0; k < tree.made(); ++k) {
      const auto [a, b] = tree.children[k];
      const auto p = static_cast<std::uint32_t>(tree.originals + k);
      before.push_back(star_by_climbing(tree, present, {a, b}));
      present[a] = present[b] = 0;
      present[p] = 1;
      after.push_back(star_by_climbing(tree, present, {p}));
    }
  }
};

inline Star star_of(const Cut& cut, const std::vector<std::uint32_t>& at) {
  Star star;
  for (const auto v : at) {
    for (const auto t : cut.star(v)) star[t] = turned(cut.corners(t));
  }
  return star;
}

inline std::vector<std::uint8_t> present_nodes(const Cut& cut) {
  std::vector<std::uint8_t> present(cut.tree().nodes());
  for (std::uint32_t v = 0; v < present.size(); ++v) present[v] = cut.present(v) ? 1 : 0;
  return present;
}

/// Everything a cut holds, in an order of its own: equal iff the cuts are.
struct Snapshot {
  Mesh mesh;
  std::vector<std::uint64_t> keys;
  std::vector<std::array<std::uint32_t, 2>> pairs;  // (M, m)
  std::vector<Star> stars;

  explicit Snapshot(const Cut& cut) {
    cut.extract(mesh, keys);
    for (const auto key : keys) {
      const auto v = static_cast<std::uint32_t>(key);
      pairs.push_back({cut.greatest_neighbour(v), cut.least_parent(v)});
      stars.push_back(star_of(cut, {v}));
    }
  }
  friend bool operator==(const Snapshot& a, const Snapshot& b) {
    return a.mesh.positions == b.mesh.positions && a.mesh.triangles == b.mesh.triangles && a.keys == b.keys &&
           a.pairs == b.pairs && a.stars == b.stars;
  }
};

}  // namespace plumbline::vertex_tree
