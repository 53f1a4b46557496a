// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// greedy_tin: its bound at samples and between them, by brute force; conformity; the fewest triangles.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/greedy_tin/delaunay.h"
#include "algorithms/registry.h"
#include "lattice.h"
#include "oracle/conformity.h"
#include "oracle/image.h"
#include "oracle/vertical.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using lattice::any_camera;

LodFrame update(const Terrain& terrain, const Camera& camera, double threshold_px,
                const std::string& id = "greedy_tin", const Options& options = {}) {
  const auto method = make_method(id, options);
  method->prepare(terrain);
  method->set_threshold_px(threshold_px);
  LodFrame frame;
  method->update(camera, frame);
  return frame;
}

/// The greatest displacement over points of the picture: `per_cell` × `per_cell` points a cell, a sample
/// among them. Heights of the network by search; nothing of the method's own code.
double displaced_px(const Terrain& terrain, const Camera& camera, const LodFrame& frame, int per_cell) {
  double worst = 0;
  const double s = terrain.spacing_m;
  for (const auto& t : frame.mesh.triangles) {
    const Vec3 a = frame.mesh.positions[t[0]], b = frame.mesh.positions[t[1]], c = frame.mesh.positions[t[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const auto grid = [&](double metres) { return static_cast<int>(std::floor(metres / s * per_cell)); };
    for (int y = grid(std::min({a.y, b.y, c.y})); y <= grid(std::max({a.y, b.y, c.y})); ++y) {
      for (int x = grid(std::min({a.x, b.x, c.x})); x <= grid(std::max({a.x, b.x, c.x})); ++x) {
        const double px = x * s / per_cell, py = y * s / per_cell;
        const double v = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const double w = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (v < 0 || w < 0 || v + w > 1) continue;
        const Vec3 on{px, py, terrain.surface_height_m(px, py)};
        if (!camera.sees(on)) continue;
        const Vec3 off{px, py, a.z + v * (b.z - a.z) + w * (c.z - a.z)};
        if (!(camera.depth(off) > 0)) return std::numeric_limits<double>::infinity();
        const Vec2 p = camera.project(on), q = camera.project(off);
        worst = std::max(worst, std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y)));
      }
    }
  }
  return worst;
}

constexpr double kRounding = 1e-9;  // relative: interpolation here and there

TEST(GreedyTin, NoPointOfThePictureIsDisplacedByMoreThanTheThreshold) {
  Random random(3);
  int coarse = 0;
  for (int k = 0; k < 60; ++k) {
    const Terrain terrain = lattice::rough(25, 17, static_cast<std::uint64_t>(k), random.between(1, 30), 2);
    const Camera camera = any_camera(random, terrain);
    const double threshold_px = random.between(0.5, 40);
    const LodFrame frame = update(terrain, camera, threshold_px);
    EXPECT_LE(displaced_px(terrain, camera, frame, 8), threshold_px * (1 + kRounding)) << k;
    if (frame.mesh.triangles.size() < 24 * 16) ++coarse;
  }
  EXPECT_GT(coarse, 20) << "most meshes are nearly complete: nothing was tried";
}

TEST(GreedyTin, AtSamplesOnlyTheBoundHoldsThereAndNotBetween) {
  Random random(4);
  int above_between = 0;
  for (int k = 0; k < 60; ++k) {
    const Terrain terrain = lattice::rough(25, 17, static_cast<std::uint64_t>(k), random.between(1, 30), 2);
    const Camera camera = any_camera(random, terrain);
    const double threshold_px = random.between(0.5, 40);
    const LodFrame frame = update(terrain, camera, threshold_px, "greedy_tin:samples");
    EXPECT_LE(displaced_px(terrain, camera, frame, 1), threshold_px * (1 + kRounding)) << k;
    if (displaced_px(terrain, camera, frame, 8) > threshold_px * (1 + kRounding)) ++above_between;
  }
  EXPECT_GT(above_between, 10);
}

TEST(GreedyTin, HoldsForCamerasOnAndUnderTheGround) {
  Random random(5);
  const oracle::RayDevice device;
  for (int k = 0; k < 30; ++k) {
    const Terrain terrain = lattice::rough(17, 17, static_cast<std::uint64_t>(k), 20);
    const double x = random.between(1, 15), y = random.between(1, 15);
    const Vec3 eye{x, y, terrain.surface_height_m(x, y) + (k % 3 - 1) * 0.01};
    const Camera camera = make_camera(eye, {8, 8, eye.z - random.between(0.1, 9)}, 70, 160, 120);
    const double threshold_px = random.between(0.5, 10);
    const LodFrame frame = update(terrain, camera, threshold_px);
    const Mesh full = reference_mesh(terrain);
    const oracle::RaySurface reference(device, full), mesh(device, frame.mesh);
    const oracle::ImageError error =
        oracle::image_error(camera, reference, reference.look(camera), mesh, mesh.look(camera), threshold_px);
    EXPECT_LE(error.displacement_px.max, threshold_px * (1 + kRounding)) << k;
    EXPECT_EQ(error.uncovered_px, 0U);
    EXPECT_EQ(lattice::look_at(terrain, frame).double_area, lattice::double_area(terrain));
  }
}

TEST(GreedyTin, ConformsAndCovers) {
  Random random(6);
  for (int k = 0; k < 40; ++k) {
    const Terrain terrain = lattice::rough(33, k % 2 == 0 ? 33 : 14, static_cast<std::uint64_t>(k), 20, 0.1);
    const LodFrame frame = update(terrain, any_camera(random, terrain), random.between(0.5, 30));
    const lattice::Faults faults = lattice::look_at(terrain, frame);
    EXPECT_EQ(faults.t_junctions, 0);
    EXPECT_EQ(faults.turned, 0);
    EXPECT_EQ(faults.doubled, 0);
    EXPECT_EQ(faults.inner_border, 0);
    EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
    EXPECT_TRUE(oracle::check_conformity(frame.mesh, frame.domain).clean());
  }
}

TEST(GreedyTin, AVanishingThresholdGivesTheReferenceSurface) {
  const Terrain terrain = lattice::rough(17, 13, 7, 20);
  // All of it in the picture.
  const Camera camera = make_camera({8, -60, 60}, {8, 6, 5}, 60, 640, 480);
  const LodFrame frame = update(terrain, camera, 1e-9);
  EXPECT_EQ(oracle::vertical_error(frame.mesh, terrain).max, 0);
  EXPECT_EQ(frame.mesh.triangles.size(), 2U * 16U * 12U);
}

TEST(GreedyTin, APlaneTakesTwoTriangles) {
  Terrain terrain = lattice::flat(40, 23, 3);
  for (int j = 0; j < 23; ++j) {
    for (int i = 0; i < 40; ++i) terrain.heights_m[terrain.index(i, j)] = 0.37 * i - 0.11 * j;
  }
  const Camera camera = make_camera({60, -50, 60}, {60, 33, 5}, 60, 640, 480);
  EXPECT_EQ(update(terrain, camera, 0.01).mesh.triangles.size(), 2U);
}

TEST(GreedyTin, FollowsTheCameraNotTheFlight) {
  Random random(8);
  const Terrain terrain = lattice::rough(33, 33, 8, 20);
  const auto method = make_method("greedy_tin");
  method->prepare(terrain);
  method->set_threshold_px(3);
  LodFrame flown;
  for (int k = 0; k < 10; ++k) {
    const Camera camera = any_camera(random, terrain);
    method->update(camera, flown);
    EXPECT_TRUE(lattice::same_mesh(flown, update(terrain, camera, 3))) << k;
    const auto clone = method->clone();
    LodFrame cloned;
    clone->update(camera, cloned);
    EXPECT_TRUE(lattice::same_mesh(flown, cloned)) << k;
  }
}

TEST(GreedyTin, TakesFewerTrianglesThanTheQuadtreeOfTheSameError) {
  Random random(9);
  const Terrain terrain = lattice::rough(65, 65, 9, 20);
  const oracle::RayDevice device;
  const Mesh full = reference_mesh(terrain);
  const oracle::RaySurface reference(device, full);
  for (int k = 0; k < 5; ++k) {
    const Camera camera = any_camera(random, terrain);
    const LodFrame quadtree = update(terrain, camera, 6, "restricted_quadtree", {{"cull", true}});
    const oracle::RaySurface mesh(device, quadtree.mesh);
    const double worst_px =
        oracle::image_error(camera, reference, reference.look(camera), mesh, mesh.look(camera), 6)
            .displacement_px.max;
    ASSERT_GT(worst_px, 0);
    const LodFrame greedy = update(terrain, camera, worst_px);
    EXPECT_LT(greedy.mesh.triangles.size(), quadtree.mesh.triangles.size()) << k;
  }
}

TEST(GreedyTin, StopsAtTheTrianglesAskedFor) {
  const Terrain terrain = lattice::rough(33, 33, 10, 20);
  const Camera camera = make_camera({16, -30, 60}, {16, 16, 5}, 60, 640, 480);
  for (const double most : {2.0, 3.0, 100.0, 101.0}) {
    const std::size_t count =
        update(terrain, camera, 1e-6, "greedy_tin", {{"max_triangles", most}}).mesh.triangles.size();
    EXPECT_LE(count, static_cast<std::size_t>(most));
    EXPECT_GE(count + 1, static_cast<std::size_t>(most));
  }
  for (const double wrong : {-1.0, 1.0, 2.5, 1e10}) {
    EXPECT_THROW(make_method("greedy_tin", {{"max_triangles", wrong}}), InputError);
  }
}

/// Any order of insertion gives the same triangles, ties on the grid included.
TEST(GreedyTin, TheTriangulationIsAFunctionOfTheSamples) {
  std::vector<greedy_tin::Sample> samples;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 7; ++i) {
      if ((i != 0 && i != 6) || (j != 0 && j != 4)) samples.push_back({i, j});
    }
  }
  const auto triangles = [&] {
    greedy_tin::Delaunay network(7, 5);
    std::vector<std::uint32_t> changed;
    for (const greedy_tin::Sample s : samples) network.insert(s, 0, changed);
    std::vector<std::array<int, 3>> out;
    for (std::uint32_t t = 0; t < network.triangle_count(); ++t) {
      const auto c = network.corners(t);
      out.push_back({c[0].j * 7 + c[0].i, c[1].j * 7 + c[1].i, c[2].j * 7 + c[2].i});
    }
    std::sort(out.begin(), out.end());
    return out;
  };
  std::vector<std::array<int, 3>> reference;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 6; ++i) {
      reference.push_back({j * 7 + i, j * 7 + i + 1, (j + 1) * 7 + i + 1});
      reference.push_back({j * 7 + i, (j + 1) * 7 + i + 1, (j + 1) * 7 + i});
    }
  }
  std::sort(reference.begin(), reference.end());
  Random random(11);
  for (int k = 0; k < 20; ++k) {
    for (std::size_t s = samples.size(); s > 1; --s) {
      std::swap(samples[s - 1],
                samples[static_cast<std::size_t>(random.between(0, 1) * static_cast<double>(s))]);
    }
    EXPECT_EQ(triangles(), reference) << k;
  }
}

}  // namespace
}  // namespace plumbline
