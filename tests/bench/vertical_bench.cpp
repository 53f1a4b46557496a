// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// O2 against its floor: what it costs to visit every sample once through the triangles, for the greatest |dz|
// at samples alone. O2 answers more (RMS, mean, everything between samples, both diagonals); the ratio says
// what that costs. Floor and O2 take turns, so that a drifting clock speed hits both; medians are printed.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "oracle/shape.h"
#include "oracle/vertical.h"
#include "scenarios/random.h"

namespace {

using namespace plumbline;

/// Midpoint displacement with falling amplitude: a fractal of 2ⁿ + 1 samples a side.
Terrain fractal_terrain(int levels, double spacing_m, double amplitude_m, double fall) {
  const int cells = 1 << levels;
  Terrain terrain{"fractal", cells + 1, cells + 1, spacing_m, {}};
  terrain.heights_m.assign(static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 1), 0.0);
  const auto noise = [&](int i, int j, double amplitude) {
    return amplitude * (static_cast<double>(lattice_hash(7, i, j) >> 11) * 0x1p-52 - 1);
  };
  auto& z = terrain.heights_m;
  for (const int j : {0, cells}) {
    for (const int i : {0, cells}) z[terrain.index(i, j)] = noise(i, j, amplitude_m);
  }
  double amplitude = amplitude_m;
  for (int step = cells; step > 1; step /= 2, amplitude *= fall) {
    const int half = step / 2;
    for (int j = half; j < cells; j += step) {
      for (int i = half; i < cells; i += step) {
        z[terrain.index(i, j)] = 0.25 * (terrain.z(i - half, j - half) + terrain.z(i + half, j - half) +
                                         terrain.z(i - half, j + half) + terrain.z(i + half, j + half)) +
                                 noise(i, j, amplitude);
      }
    }
    for (int j = 0; j <= cells; j += half) {
      for (int i = (j / half % 2 == 0) ? half : 0; i <= cells; i += step) {
        const bool along_x = j / half % 2 == 0;
        const int di = along_x ? half : 0, dj = along_x ? 0 : half;
        z[terrain.index(i, j)] =
            0.5 * (terrain.z(i - di, j - dj) + terrain.z(i + di, j + dj)) + noise(i, j, 0.7 * amplitude);
      }
    }
  }
  return terrain;
}

/// Right triangles halved at the middle of the longest side wherever the sample there is further than a bound
/// from the side (Evans, Kirkpatrick & Townsend, Right-triangulated irregular networks, 2001): a conforming
/// adaptive mesh.
class RightTriangles {
 public:
  explicit RightTriangles(const Terrain& terrain) : terrain_(terrain), error_(terrain.heights_m.size(), 0.0) {
    const int n = terrain.columns - 1;
    // From the finest level up, so that a split's error covers those it forces.
    for (int depth = deepest(); depth >= 0; --depth) {
      gather({0, 0}, {n, n}, {n, 0}, depth);
      gather({n, n}, {0, 0}, {0, n}, depth);
    }
  }

  [[nodiscard]] Mesh mesh(double bound_m) const {
    Mesh mesh;
    std::vector<std::uint32_t> number(error_.size(), ~0u);
    const int n = terrain_.columns - 1;
    emit(mesh, number, {0, 0}, {n, n}, {n, 0}, bound_m);
    emit(mesh, number, {n, n}, {0, 0}, {0, n}, bound_m);
    return mesh;
  }

  [[nodiscard]] Mesh mesh_of_about(std::size_t triangles) const {
    double low = 0, high = 1e6;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (mesh(middle).triangles.size() > triangles ? low : high) = middle;
    }
    return mesh(high);
  }

 private:
  struct Node {
    int i, j;
  };
  [[nodiscard]] int deepest() const {
    int depth = -1;
    for (int n = terrain_.columns - 1; n > 1; n /= 2) depth += 2;
    return depth;
  }
  // a, b: ends of the longest side; c: the right angle; counter-clockwise with c to the right of a → b.
  void gather(Node a, Node b, Node c, int depth) {
    const Node m{(a.i + b.i) / 2, (a.j + b.j) / 2};
    if (depth > 0) {
      gather(c, a, m, depth - 1);
      gather(b, c, m, depth - 1);
      return;
    }
    if (std::abs(a.i - c.i) + std::abs(a.j - c.j) < 2 && std::abs(a.i - b.i) < 2 && std::abs(a.j - b.j) < 2)
      return;
    double& error = error_[terrain_.index(m.i, m.j)];
    const double own = std::fabs(0.5 * (terrain_.z(a.i, a.j) + terrain_.z(b.i, b.j)) - terrain_.z(m.i, m.j));
    const Node left{(a.i + c.i) / 2, (a.j + c.j) / 2}, right{(b.i + c.i) / 2, (b.j + c.j) / 2};
    const bool finest = std::abs(a.i - c.i) < 2 && std::abs(a.j - c.j) < 2;
    error = std::max({error, own, finest ? 0.0 : error_[terrain_.index(left.i, left.j)],
                      finest ? 0.0 : error_[terrain_.index(right.i, right.j)]});
  }
  void emit(Mesh& mesh, std::vector<std::uint32_t>& number, Node a, Node b, Node c, double bound_m) const {
    const Node m{(a.i + b.i) / 2, (a.j + b.j) / 2};
    const bool splits = std::abs(a.i - b.i) + std::abs(a.j - b.j) > 1 &&
                        (std::abs(a.i - b.i) != 1 || std::abs(a.j - b.j) != 1) &&
                        error_[terrain_.index(m.i, m.j)] > bound_m;
    if (splits) {
      emit(mesh, number, c, a, m, bound_m);
      emit(mesh, number, b, c, m, bound_m);
      return;
    }
    std::array<std::uint32_t, 3> triangle{};
    std::size_t k = 0;
    for (const Node v : {a, c, b}) {
      std::uint32_t& index = number[terrain_.index(v.i, v.j)];
      if (index == ~0u) {
        index = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(terrain_.point(v.i, v.j));
      }
      triangle[k++] = index;
    }
    mesh.triangles.push_back(triangle);
  }

  const Terrain& terrain_;
  std::vector<double> error_;
};

/// The floor: each triangle's samples by rows, the greatest |dz| at samples. Corners on samples.
double greatest_at_samples(const Mesh& mesh, const Terrain& terrain) {
  double greatest = 0;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& v = mesh.positions[triangle[k]];
      p[k] = {v.x / terrain.spacing_m, v.y / terrain.spacing_m, v.z};
    }
    std::sort(p.begin(), p.end(), [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    const double by_x =
        ((p[1].z - p[0].z) * (p[2].y - p[0].y) - (p[2].z - p[0].z) * (p[1].y - p[0].y)) / area;
    const double by_y =
        ((p[1].x - p[0].x) * (p[2].z - p[0].z) - (p[2].x - p[0].x) * (p[1].z - p[0].z)) / area;
    const double long_slope = (p[2].x - p[0].x) / (p[2].y - p[0].y);
    for (int j = static_cast<int>(p[0].y); j <= static_cast<int>(p[2].y); ++j) {
      const double on_long = p[0].x + (j - p[0].y) * long_slope;
      const Vec3& low = j < p[1].y || p[1].y == p[2].y ? p[0] : p[1];
      const Vec3& high = j < p[1].y || p[1].y == p[2].y ? p[1] : p[2];
      const double on_short = low.x + (j - low.y) * ((high.x - low.x) / (high.y - low.y));
      const int first = static_cast<int>(std::min(on_long, on_short) + (1 - 1e-9));
      const int last = static_cast<int>(std::max(on_long, on_short) + 1e-9);
      const double* const heights = terrain.heights_m.data() + terrain.index(0, j);
      const double row_height = p[0].z + by_y * (j - p[0].y) - by_x * p[0].x;
      for (int i = first; i <= last; ++i) {
        const double size = std::fabs((by_x * i + row_height) - heights[i]);
        greatest = greatest < size ? size : greatest;
      }
    }
  }
  return greatest;
}

/// Processor time of this thread: what a busy machine does beside it does not count.
double thread_milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// The same work on each of `threads` threads at once; processor time per thread.
double milliseconds(int threads, const std::function<void()>& work) {
  std::vector<double> spent(static_cast<std::size_t>(threads));
  std::vector<std::thread> pool;
  for (double& mine : spent) {
    pool.emplace_back([&] {
      const double start = thread_milliseconds();
      work();
      mine = thread_milliseconds() - start;
    });
  }
  for (std::thread& thread : pool) thread.join();
  double sum = 0;
  for (const double each : spent) sum += each;
  return sum / threads;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

std::atomic<double> sink;

void compare(const char* name, const Mesh& mesh, const Terrain& terrain, int rounds) {
  const oracle::VerticalError error = oracle::vertical_error(mesh, terrain);
  fmt::print("{}: {} triangles on {} x {} samples\n", name, mesh.triangles.size(), terrain.columns,
             terrain.rows);
  fmt::print("  at samples {:.6f} m; O2: max {:.6f} m, certain {:.6f} m, rms {:.6f} m, mean {:.6f} m\n",
             greatest_at_samples(mesh, terrain), error.max, error.certain_max, error.rms, error.mean);
  for (const int threads : {1, 2}) {
    std::vector<double> floor_ms, ours_ms;
    for (int round = 0; round < rounds; ++round) {
      floor_ms.push_back(milliseconds(threads, [&] { sink = greatest_at_samples(mesh, terrain); }));
      ours_ms.push_back(milliseconds(threads, [&] { sink = oracle::vertical_error(mesh, terrain).max; }));
    }
    fmt::print("  {} thread{}, a frame each: floor {:.2f} ms, O2 {:.2f} ms, ratio {:.2f}\n", threads,
               threads == 1 ? "" : "s", median(floor_ms), median(ours_ms),
               median(ours_ms) / median(floor_ms));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string option = argc > 1 ? argv[1] : "";
  const bool large = option == "--large";  // adds a 4097 x 4097 terrain
  const bool brief = option == "--brief";  // the 20 000-triangle mesh alone
  {
    const Terrain terrain = fractal_terrain(10, 30, 800, 0.52);
    const RightTriangles right_triangles(terrain);
    compare("right triangles", right_triangles.mesh_of_about(20000), terrain, 31);
    if (brief) return 0;
    compare("right triangles, fine", right_triangles.mesh_of_about(217000), terrain, 15);
    const Mesh full = reference_mesh(terrain);
    compare("full mesh", full, terrain, 5);
    std::vector<double> shape_ms;
    for (int round = 0; round < 7; ++round) {
      shape_ms.push_back(milliseconds(1, [&] { sink = oracle::shape(full).mean_quality; }));
    }
    fmt::print("shape of the full mesh: {:.1f} ms\n", median(shape_ms));
  }
  if (large) {
    const Terrain terrain = fractal_terrain(12, 30, 800, 0.52);
    compare("right triangles, large", RightTriangles(terrain).mesh_of_about(377000), terrain, 5);
  }
  return 0;
}
