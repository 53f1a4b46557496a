// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cost of the methods on a fractal terrain of 1025 × 1025 samples, each as a ratio to a floor measured in the
// same run:
//   update   one frame of about 20 000 triangles (`full`: all of them) against copying that frame's mesh once
//   prepare  against one memcpy of the heights
// The least of many repetitions is printed, since other programs can only add to it; one thread.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "algorithms/registry.h"
#include "scenarios/random.h"

namespace plumbline {
namespace {

constexpr int kSide = 1025;
constexpr std::size_t kTriangles = 20000;

// Midpoint displacement: the roughness halves from level to level, as fractal terrain does.
Terrain fractal() {
  Terrain out;
  out.id = "fractal";
  out.columns = out.rows = kSide;
  out.spacing_m = 30;
  out.heights_m.assign(static_cast<std::size_t>(kSide) * kSide, 0.0);
  const auto noise = [](int i, int j) {
    return static_cast<double>(lattice_hash(7, i, j) >> 40) * 0x1p-23 - 1;
  };
  double relief_m = 1500;
  for (int h = (kSide - 1) / 2; h >= 1; h /= 2, relief_m *= 0.5) {
    const auto z = [&](int i, int j) -> double& { return out.heights_m[out.index(i, j)]; };
    for (int j = 0; j < kSide; j += h) {
      for (int i = 0; i < kSide; i += h) {
        const bool i_odd = i / h % 2 != 0, j_odd = j / h % 2 != 0;
        if (!i_odd && !j_odd) continue;
        const int a = i_odd ? h : 0, b = j_odd ? h : 0;
        z(i, j) = (z(i - a, j - b) + z(i + a, j + b)) / 2 + relief_m * noise(i, j);
      }
    }
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

/// The threshold at which a frame has about kTriangles triangles, by bisection.
double threshold_for(LodMethod& method, const Camera& camera) {
  double low = 1e-3, high = 1e3;
  LodFrame frame;
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    method.set_threshold_px(middle);
    method.update(camera, frame);
    (frame.mesh.triangles.size() > kTriangles ? low : high) = middle;
  }
  return high;
}

void run(const std::string& id, const Terrain& terrain) {
  const Camera camera = make_camera({-2000, -2000, 4000}, {15000, 15000, 0}, 60, 1280, 720);
  const auto method = make_method(id);
  std::vector<double> copy(terrain.heights_m.size());
  const double heights_s = least_seconds(21, [&] {
    std::memcpy(copy.data(), terrain.heights_m.data(), copy.size() * sizeof(double));
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
  });
  const double prepare_s = least_seconds(7, [&] { method->prepare(terrain); });

  if (!find_method(id).promises(Promise::threshold_blind)) {
    method->set_threshold_px(threshold_for(*method, camera));
  }
  LodFrame frame;
  const double update_s = least_seconds(101, [&] {
    method->update(camera, frame);
    benchmark::DoNotOptimize(frame.mesh.triangles.data());
  });
  Mesh mesh_copy;
  const double copy_s = least_seconds(101, [&] {
    mesh_copy = frame.mesh;
    benchmark::DoNotOptimize(mesh_copy.triangles.data());
    benchmark::ClobberMemory();
  });
  fmt::print("{:<28}{:>10}{:>11.3f}{:>11.3f}{:>9.1f}{:>12.1f}{:>11.2f}{:>9.1f}\n", id,
             frame.mesh.triangles.size(), update_s * 1e3, copy_s * 1e3, update_s / copy_s, prepare_s * 1e3,
             heights_s * 1e3, prepare_s / heights_s);
}

}  // namespace
}  // namespace plumbline

int main() {
  const plumbline::Terrain terrain = plumbline::fractal();
  fmt::print("{:<28}{:>10}{:>11}{:>11}{:>9}{:>12}{:>11}{:>9}\n", "method", "triangles", "update ms",
             "copy ms", "ratio", "prepare ms", "memcpy ms", "ratio");
  for (const plumbline::MethodDescription& method : plumbline::registered_methods()) {
    for (const plumbline::VariantDescription& variant : method.variants) {
      plumbline::run(variant.name.empty() ? method.id : method.id + ":" + variant.name, terrain);
    }
  }
  return 0;
}
