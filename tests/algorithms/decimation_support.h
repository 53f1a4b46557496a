// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "lattice.h"
#include "scenarios/error.h"

// What the tests of the view-independent methods share.
namespace plumbline::decimation_support {

inline LodFrame update(LodMethod& method, double threshold_px) {
  LodFrame frame;
  method.set_threshold_px(threshold_px);
  method.update(make_camera({1, 1, 50}, {1, 1, 0}, 90, 640, 480), frame);
  return frame;
}

inline std::unique_ptr<LodMethod> prepared(const std::string& id, const Terrain& terrain,
                                           const Options& options = {}) {
  auto method = make_method(id, options);
  method->prepare(terrain);
  return method;
}

/// Directed edges of one triangle, without a partner that runs the other way: the border, as pairs of keys.
inline std::set<std::pair<std::uint64_t, std::uint64_t>> border_of(const LodFrame& frame) {
  std::set<std::pair<std::uint64_t, std::uint64_t>> all, border;
  for (const auto& t : frame.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      all.emplace(frame.vertex_keys[t[k]], frame.vertex_keys[t[(k + 1) % 3]]);
  }
  for (const auto& [a, b] : all) {
    if (!all.contains({b, a})) border.emplace(a, b);
  }
  return border;
}

inline LodFrame full_frame(const Terrain& terrain) { return update(*prepared("full", terrain), 1); }

/// Two threads ask clones for the same meshes, in opposite orders.
inline std::pair<std::vector<LodFrame>, std::vector<LodFrame>> two_flyers(const LodMethod& method) {
  const std::vector<double> thresholds = {1, 2, 4, 8};
  std::vector<LodFrame> up(thresholds.size()), down(thresholds.size());
  const auto a = method.clone(), b = method.clone();
  std::thread other([&] {
    for (std::size_t k = thresholds.size(); k-- > 0;) down[k] = update(*b, thresholds[k]);
  });
  for (std::size_t k = 0; k < thresholds.size(); ++k) up[k] = update(*a, thresholds[k]);
  other.join();
  return {std::move(up), std::move(down)};
}

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A closed box of n × n × n cells a side of `size_m`, outward oriented.
inline Mesh box(int n, double size_m) {
  Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> seen;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [at, is_new] = seen.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) mesh.positions.push_back(Vec3{1.0 * p[0], 1.0 * p[1], 1.0 * p[2]} * (size_m / n));
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int u, int v) {
            std::array<int, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            return vertex(p);
          };
          const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side == n) {
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
          } else {
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({a, d, c});
          }
        }
      }
    }
  }
  return mesh;
}

}  // namespace plumbline::decimation_support
