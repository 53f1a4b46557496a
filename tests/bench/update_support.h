// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "algorithms/registry.h"
#include "scenarios/random.h"

/// What the benchmarks of methods share: a terrain, a short flight, and how an update is timed on it.
namespace plumbline::bench {

inline constexpr std::size_t kTriangles = 20000;  ///< budget of a frame

/// Midpoint displacement on side × side samples, 30 m apart: the roughness halves from level to level, as
/// fractal terrain does. Requires: side = 2ⁿ+1.
inline Terrain fractal_terrain(int side) {
  Terrain out;
  out.id = "fractal";
  out.columns = out.rows = side;
  out.spacing_m = 30;
  out.heights_m.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0);
  const auto noise = [](int i, int j) {
    return static_cast<double>(lattice_hash(7, i, j) >> 40) * 0x1p-23 - 1;
  };
  double relief_m = 1.5 * (side - 1);
  for (int h = (side - 1) / 2; h >= 1; h /= 2, relief_m *= 0.5) {
    const auto z = [&](int i, int j) -> double& { return out.heights_m[out.index(i, j)]; };
    for (int j = 0; j < side; j += h) {
      for (int i = 0; i < side; i += h) {
        const bool i_odd = i / h % 2 != 0, j_odd = j / h % 2 != 0;
        if (!i_odd && !j_odd) continue;
        const int a = i_odd ? h : 0, b = j_odd ? h : 0;
        z(i, j) = (z(i - a, j - b) + z(i + a, j + b)) / 2 + relief_m * noise(i, j);
      }
    }
  }
  return out;
}

/// Eight frames forward over the terrain, a thousandth of its side each: coherent frames, as a flight has
/// them. The way and the view scale with the terrain.
inline std::vector<Camera> short_flight(const Terrain& terrain) {
  const double side_m = (terrain.columns - 1) * terrain.spacing_m;
  std::vector<Camera> out;
  for (int k = 0; k < 8; ++k) {
    const double step_m = 0.001 * k * side_m;
    out.push_back(make_camera({-0.065 * side_m + step_m, -0.065 * side_m + step_m, 0.13 * side_m},
                              {0.5 * side_m + step_m, 0.5 * side_m + step_m, 0}, 60, 1280, 720));
  }
  return out;
}

template <class Call>
double least_seconds(int repetitions, Call&& call) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repetitions; ++k) {
    const auto start = std::chrono::steady_clock::now();
    call();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

/// The threshold at which a first frame has kTriangles triangles, but for a hundredth, by bisection.
inline double threshold_for_budget(LodMethod& method, const Camera& camera) {
  double low = 1e-3, high = 1e3;
  LodFrame frame;
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    method.set_threshold_px(middle);
    method.reset();
    method.update(camera, frame);
    const std::size_t triangles = frame.mesh.triangles.size();
    if (triangles <= kTriangles && triangles >= kTriangles - kTriangles / 100) return middle;
    (triangles > kTriangles ? low : high) = middle;
  }
  return high;
}

struct UpdateCost {
  double update_s = 0;  ///< one coherent frame
  double copy_s = 0;    ///< copying its mesh once, positions and indices
  double triangles = 0;
};

/// Flies the way forth and back, so that every frame is a small step from the one before. Of many
/// repetitions the least counts, since other programs can only add to it; one thread. Requires: prepared,
/// threshold set.
inline UpdateCost time_updates(LodMethod& method, const std::vector<Camera>& flight, int repetitions) {
  std::vector<Camera> there_and_back = flight;
  there_and_back.insert(there_and_back.end(), flight.rbegin(), flight.rend());
  LodFrame frame;
  method.reset();
  for (const Camera& camera : there_and_back) method.update(camera, frame);
  UpdateCost out;
  out.update_s = least_seconds(repetitions, [&] {
    for (const Camera& camera : there_and_back) {
      method.update(camera, frame);
      benchmark::DoNotOptimize(frame.mesh.triangles.data());
    }
  });
  Mesh copy;
  for (const Camera& camera : there_and_back) {
    method.update(camera, frame);
    out.triangles += static_cast<double>(frame.mesh.triangles.size());
    out.copy_s += least_seconds(repetitions, [&] {
      copy = frame.mesh;
      benchmark::DoNotOptimize(copy.triangles.data());
      benchmark::ClobberMemory();
    });
  }
  const auto frames = static_cast<double>(there_and_back.size());
  return {out.update_s / frames, out.copy_s / frames, out.triangles / frames};
}

/// greedy_tin makes each frame anew from the terrain's corners, by far the slowest: once is enough.
inline int repetitions_of(const std::string& id, int repetitions) {
  return find_method(id).method->id == "greedy_tin" ? 1 : repetitions;
}

/// Methods and variants whose update can cost something: not those that hand out one mesh per threshold, made
/// in minutes on the larger terrains; the full grid stays, as the floor. Nor those that simplify whole
/// objects by their size on the screen, and ring_tin, whose rings set its triangles: both have benchmarks of
/// their own.
inline std::vector<std::string> all_method_ids() {
  std::vector<std::string> out;
  for (const MethodDescription& method : registered_methods()) {
    for (const VariantDescription& variant : method.variants) {
      const MethodChoice choice{&method, &variant};
      if (choice.promises(Promise::camera_blind) && !choice.promises(Promise::threshold_blind)) continue;
      if (method.takes_objects || method.id == "ring_tin") continue;
      out.push_back(variant.name.empty() ? method.id : method.id + ":" + variant.name);
    }
  }
  return out;
}

}  // namespace plumbline::bench
