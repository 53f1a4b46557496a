// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/faults/sound_meshes.h"

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace plumbline::faults {
namespace {

constexpr double kRelief_m = 30;

/// Fisher and Yates.
std::vector<std::uint32_t> random_order(std::size_t count, Random& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
  return order;
}

}  // namespace

Surface random_grid(int n, Random& random) {
  Surface s;
  const double spacing_m = random.below(2) == 0 ? 1 : random.between(0.5, 40);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i)
      s.mesh.positions.push_back({i * spacing_m, j * spacing_m, random.between(0, kRelief_m)});
  }
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * n + i), d = a + static_cast<std::uint32_t>(n);
      const std::uint32_t b = a + 1, c = d + 1;
      if (random.below(2) == 0) {
        s.mesh.triangles.insert(s.mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        s.mesh.triangles.insert(s.mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  s.domain.add_rectangle({0, 0}, {(n - 1) * spacing_m, (n - 1) * spacing_m});
  return s;
}

Surface random_bintree(int levels, Random& random) {
  using Lattice = std::pair<int, int>;
  struct Half {
    Lattice apex, left, right;  // counter-clockwise; left–right is the hypotenuse
  };
  const int size = 1 << levels;
  std::vector<Half> leaves{{{size, 0}, {size, size}, {0, 0}}, {{0, size}, {0, 0}, {size, size}}};
  const auto middle = [](Lattice a, Lattice b) {
    return Lattice{(a.first + b.first) / 2, (a.second + b.second) / 2};
  };
  const auto can_split = [](const Half& h) {
    return (h.left.first + h.right.first) % 2 == 0 && (h.left.second + h.right.second) % 2 == 0;
  };
  const auto split = [&](std::size_t i) {
    const Half h = leaves[i];
    const Lattice m = middle(h.left, h.right);
    leaves[i] = {m, h.apex, h.left};
    leaves.push_back({m, h.right, h.apex});
  };
  for (int step = 0; step < 6 * size; ++step) {
    const std::size_t i = random.below(leaves.size());
    if (can_split(leaves[i])) split(i);
  }
  for (bool changed = true; changed;) {
    changed = false;
    std::set<Lattice> used;
    for (const Half& h : leaves) used.insert({h.apex, h.left, h.right});
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Half h = leaves[i];
      for (const auto& [a, b] : {std::pair{h.apex, h.left}, {h.left, h.right}, {h.right, h.apex}}) {
        if ((a.first + b.first) % 2 != 0 || (a.second + b.second) % 2 != 0 || !used.contains(middle(a, b)))
          continue;
        split(i);
        changed = true;
        break;
      }
    }
  }
  Surface s;
  std::map<Lattice, std::uint32_t> index;
  for (const Half& h : leaves) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Lattice p = std::array{h.apex, h.left, h.right}[k];
      const auto [it, is_new] = index.try_emplace(p, static_cast<std::uint32_t>(index.size()));
      if (is_new) {
        s.mesh.positions.push_back(
            {static_cast<double>(p.first), static_cast<double>(p.second), random.between(0, kRelief_m)});
      }
      corners[k] = it->second;
    }
    s.mesh.triangles.push_back(corners);
  }
  s.domain.add_rectangle({0, 0}, {static_cast<double>(size), static_cast<double>(size)});
  return s;
}

Surface shuffled(const Surface& surface, Random& random) {
  Surface other;
  other.domain = surface.domain;
  const auto place = random_order(surface.mesh.positions.size(), random);
  other.mesh.positions.resize(place.size());
  for (std::size_t v = 0; v < place.size(); ++v) other.mesh.positions[place[v]] = surface.mesh.positions[v];
  for (const std::uint32_t t : random_order(surface.mesh.triangles.size(), random)) {
    const auto& corners = surface.mesh.triangles[t];
    const std::size_t first = random.below(3);
    other.mesh.triangles.push_back(
        {place[corners[first]], place[corners[(first + 1) % 3]], place[corners[(first + 2) % 3]]});
  }
  return other;
}

Terrain random_terrain(int side, double spacing_m, double relief_m, Random& random) {
  Terrain terrain;
  terrain.columns = terrain.rows = side;
  terrain.spacing_m = spacing_m;
  const auto steps = static_cast<std::uint64_t>(relief_m * 8);
  for (int k = 0; k < side * side; ++k)
    terrain.heights_m.push_back(static_cast<double>(random.below(steps)) / 8);
  return terrain;
}

Mesh box(int n, double size_m) {
  Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> seen;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [at, is_new] = seen.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) {
      const auto coordinate = [&](int k) { return (2.0 * k - n) / (2.0 * n) * size_m; };
      mesh.positions.push_back({coordinate(p[0]), coordinate(p[1]), coordinate(p[2])});
    }
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int cell = 0; cell < n * n; ++cell) {
        const auto corner = [&](int u, int v) {
          std::array<int, 3> p{};
          p[axis] = side;
          p[(axis + 1) % 3] = cell % n + u;
          p[(axis + 2) % 3] = cell / n + v;
          return vertex(p);
        };
        std::array<std::uint32_t, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        if (side == 0) std::swap(q[1], q[3]);  // outwards on both sides
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
      }
    }
  }
  return mesh;
}

Mesh pebble(int n, double radius_m, Random& random) {
  Mesh mesh = box(n, 2);
  for (Vec3& p : mesh.positions) {
    const double roughness = random.between(0.9, 1);
    p = p * (radius_m * roughness / std::sqrt(dot(p, p)));
  }
  return mesh;
}

}  // namespace plumbline::faults
