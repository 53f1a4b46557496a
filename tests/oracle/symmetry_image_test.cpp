// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The figures of image error and of economy under the moves of symmetry.h. Scenes stand around the origin, so
// that a symmetry is a change of signs and names: then every figure of a pixel has the same bits. Only sums
// over a mirrored picture run the other way along each row.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "oracle/economy.h"
#include "oracle/image.h"
#include "oracle/likeness.h"
#include "properties/faults/faults.h"
#include "tests/oracle/image_scenes.h"
#include "tests/oracle/symmetry.h"

namespace plumbline::oracle {
namespace {

using plumbline::test::Move;
using test::Compared;
namespace support = plumbline::test;

constexpr int kWidth = 64, kHeight = 48;

/// A row's sum of up to 64 values in another order: 64 roundings of it, and as many of the sum of rows.
constexpr double kSumRounding = 0x1p-45;

struct Scene {
  Mesh reference, mesh, before;  ///< `before`: the mesh of the frame before
  std::vector<Camera> cameras;
};

/// A rugged ground of 16 m cells around the origin, a coarser mesh of it with a fault of the catalogue or a
/// few holes, and cameras around it.
Scene make_scene(std::uint64_t seed) {
  Random random(seed, "scene");
  Terrain terrain = test::rugged(17, 16, 60, seed);
  for (double& z : terrain.heights_m) z = support::dyadic(z);
  Scene scene{reference_mesh(terrain), test::coarse_mesh(terrain, 2), test::coarse_mesh(terrain, 4), {}};
  const auto& kinds = faults::fault_kinds();
  const auto fault = faults::plant(kinds[seed % kinds.size()].name, scene.mesh, full_domain(terrain), random);
  if (fault) scene.mesh = fault->mesh;
  if (seed % 3 == 0) {
    for (int k = 0; k < 5; ++k) {
      scene.mesh.triangles.erase(scene.mesh.triangles.begin() +
                                 static_cast<std::ptrdiff_t>(random.below(scene.mesh.triangles.size())));
    }
  }
  for (Vec3& p : scene.mesh.positions) {
    if (std::isfinite(p.x + p.y + p.z)) p = support::dyadic(p);
  }
  Move centre;
  centre.shift = {-terrain.width_m() / 2, -terrain.depth_m() / 2, 0};
  for (Mesh* mesh : {&scene.reference, &scene.mesh, &scene.before}) *mesh = centre(*mesh);
  scene.cameras = test::many_cameras(terrain, kWidth, kHeight);
  for (Camera& camera : scene.cameras) {
    camera = centre(camera);
    camera.position = support::dyadic(camera.position);
  }
  return scene;
}

void expect_same(const PixelFigure& one, const PixelFigure& two, double rounding,
                 const std::string& context) {
  EXPECT_EQ(one.max, two.max) << context;
  EXPECT_EQ(one.p999, two.p999) << context;
  EXPECT_EQ(one.p99, two.p99) << context;
  EXPECT_EQ(one.count, two.count) << context;
  EXPECT_NEAR(one.rms, two.rms, rounding * one.rms) << context;
  EXPECT_NEAR(one.mean, two.mean, rounding * one.mean) << context;
}

struct Everything {
  Compared compared;
  PixelFigure pop;
  double area_error = 0;
  std::vector<std::uint8_t> removable;
  Slack slack;
};

Everything everything(const RayDevice& device, const Camera& camera, const Mesh& reference, const Mesh& mesh,
                      const Mesh& before) {
  const RaySurface a(device, reference), b(device, mesh), old(device, before);
  Everything all;
  all.compared.reference_hits = a.look(camera);
  all.compared.mesh_hits = b.look(camera);
  all.compared.error =
      image_error(camera, a, all.compared.reference_hits, b, all.compared.mesh_hits, 1, &all.compared.maps);
  all.pop = pop(camera, b, all.compared.mesh_hits, old);
  all.area_error = projected_area_error(all.compared.reference_hits, all.compared.mesh_hits);
  all.slack = measure_slack(camera, a, all.compared.reference_hits, b, 1, &all.removable);
  return all;
}

/// `scaled`: the parallax's mean depth was summed in the same order.
void expect_same(const Everything& one, const Everything& two, bool mirrored, const std::string& context) {
  const ImageError &a = one.compared.error, &b = two.compared.error;
  const double rounding = mirrored ? kSumRounding : 0;
  expect_same(a.displacement_px, b.displacement_px, rounding, context + ", displacement");
  expect_same(a.depth_rel, b.depth_rel, rounding, context + ", depth");
  expect_same(one.pop, two.pop, rounding, context + ", pop");
  // The moved camera of the parallax stands aside by a share of the mean depth: that is such a sum.
  EXPECT_NEAR(a.parallax_px.max, b.parallax_px.max, rounding * a.parallax_px.max) << context;
  EXPECT_NEAR(a.parallax_px.p99, b.parallax_px.p99, rounding * a.parallax_px.p99) << context;
  EXPECT_NEAR(a.parallax_px.mean, b.parallax_px.mean, 2 * rounding * a.parallax_px.mean) << context;
  EXPECT_EQ(a.parallax_px.count, b.parallax_px.count) << context;
  EXPECT_EQ(a.over_threshold, b.over_threshold) << context;
  EXPECT_EQ(a.uncovered_px, b.uncovered_px) << context;
  EXPECT_EQ(a.silhouette_pixels, b.silhouette_pixels) << context;
  EXPECT_EQ(a.silhouette_max_px, b.silhouette_max_px) << context;
  EXPECT_EQ(one.area_error, two.area_error) << context;
  EXPECT_EQ(one.slack.vertices, two.slack.vertices) << context;
  EXPECT_EQ(one.slack.removable, two.slack.removable) << context;
  EXPECT_EQ(one.slack.in_view, two.slack.in_view) << context;
  EXPECT_EQ(one.slack.removable_in_view, two.slack.removable_in_view) << context;
  EXPECT_EQ(one.slack.not_judged, two.slack.not_judged) << context;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kScenes = 2;
#else
constexpr std::uint64_t kScenes = 26;
#endif

TEST(SymmetryImage, EightSymmetriesChangeNoFigure) {
  const RayDevice device;
  std::size_t judged = 0, uncovered = 0, silhouettes = 0, removable = 0, popped = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = make_scene(seed);
    for (const Camera& camera : scene.cameras) {
      const Everything before = everything(device, camera, scene.reference, scene.mesh, scene.before);
      const ImageError& error = before.compared.error;
      judged += error.displacement_px.count;
      uncovered += error.uncovered_px;
      silhouettes += error.silhouette_pixels;
      removable += before.slack.removable_in_view;
      popped += before.pop.max > 0;
      for (int number = 1; number < 8; ++number) {
        const Move move = support::symmetry(number);
        const Everything after =
            everything(device, move(camera), move(scene.reference), move(scene.mesh), move(scene.before));
        const std::string context = "seed " + std::to_string(seed) + ", " + move.name();
        expect_same(before, after, move.mirrors(), context);
        EXPECT_EQ(before.removable, after.removable) << context << ": the same vertices";
        // Pixel by pixel: the picture itself, or the mirrored one.
        const auto& one = before.compared.maps.displacement_px;
        const auto& two = after.compared.maps.displacement_px;
        std::size_t unlike = 0;
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const float p = one.at(x, y), q = two.at(move.mirrors() ? kWidth - 1 - x : x, y);
            unlike += p == q || (std::isnan(p) && std::isnan(q)) ? 0U : 1U;
          }
        }
        EXPECT_EQ(unlike, 0U) << context;
      }
      ASSERT_FALSE(HasFailure());
    }
  }
  EXPECT_GT(judged, kScenes * 1000);
  EXPECT_GT(uncovered, kScenes);
  EXPECT_GT(silhouettes, kScenes);
  EXPECT_GT(removable, kScenes);
  EXPECT_GT(popped, kScenes);
}

TEST(SymmetryImage, ScalesToTheBit) {
  const RayDevice device;
  for (std::uint64_t seed = 0; seed < kScenes / 2; ++seed) {
    const Scene scene = make_scene(seed);
    for (const Camera& camera : scene.cameras) {
      const Everything before = everything(device, camera, scene.reference, scene.mesh, scene.before);
      for (const double scale : {0x1p-12, 0x1p12}) {
        Move move;
        move.scale = scale;
        const Everything after =
            everything(device, move(camera), move(scene.reference), move(scene.mesh), move(scene.before));
        expect_same(before, after, false, "seed " + std::to_string(seed) + ", " + move.name());
        EXPECT_EQ(before.removable, after.removable);
      }
      ASSERT_FALSE(HasFailure());
    }
  }
}

TEST(SymmetryImage, OrderOfTrianglesAndVertices) {
  const RayDevice device;
  std::size_t in_order = 0, slack_judged = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = make_scene(seed);
    Random random(seed, "order");
    const support::Shuffled reference = support::shuffled(scene.reference, random);
    const support::Shuffled mesh = support::shuffled(scene.mesh, random);
    const support::Shuffled old = support::shuffled(scene.before, random);
    for (const Camera& camera : scene.cameras) {
      const Everything before = everything(device, camera, scene.reference, scene.mesh, scene.before);
      const Everything after = everything(device, camera, reference.mesh, mesh.mesh, old.mesh);
      expect_same(before, after, false, "seed " + std::to_string(seed));
      in_order += before.compared.error.displacement_px.count;
      for (std::size_t v = 0; v < mesh.vertex.size(); ++v) {
        EXPECT_EQ(before.removable[v], after.removable[mesh.vertex[v]]) << seed;
        slack_judged += before.removable[v];
      }
    }
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(in_order, kScenes * 1000);
  EXPECT_GT(slack_judged, kScenes);
}

TEST(SymmetryImage, AnExactShiftMovesFiguresByRoundingsAlone) {
  // S is worked out in world coordinates, rounded where the scene stands: an ulp of 2¹² m is 2⁻⁴¹ m there,
  // which the nearest point in view (beyond a metre) shows as 2⁻⁴¹ κ px, and a grazing look multiplies. A
  // pixel within such an ulp of a border may change sides, so counts of pixels are compared up to a few.
  const RayDevice device;
  constexpr double kShiftRounding_px = 0x1p-20;
  std::size_t judged = 0;
  for (std::uint64_t seed = 0; seed < kScenes / 2; ++seed) {
    const Scene scene = make_scene(seed);
    Move move;
    move.shift = {2048, -1024, 512};
    for (std::size_t k = 0; k < 2; ++k) {  // from above and oblique: no look along the ground
      Camera camera = scene.cameras[k];
      camera.position = camera.position + Vec3{0.375, 0.71875, 0};  // no ray at a vertex or along an edge
      const Everything before = everything(device, camera, scene.reference, scene.mesh, scene.before);
      const Everything after =
          everything(device, move(camera), move(scene.reference), move(scene.mesh), move(scene.before));
      const ImageError &a = before.compared.error, &b = after.compared.error;
      EXPECT_NEAR(a.displacement_px.max, b.displacement_px.max, kShiftRounding_px);
      EXPECT_NEAR(a.displacement_px.mean, b.displacement_px.mean, kShiftRounding_px);
      EXPECT_NEAR(a.parallax_px.max, b.parallax_px.max, kShiftRounding_px);
      EXPECT_EQ(a.silhouette_pixels, b.silhouette_pixels) << "rays are decided in the camera's frame";
      EXPECT_EQ(a.silhouette_max_px, b.silhouette_max_px);
      EXPECT_EQ(a.depth_rel.max, b.depth_rel.max);
      EXPECT_EQ(a.uncovered_px, b.uncovered_px);
      EXPECT_EQ(before.slack.removable, after.slack.removable);
      judged += a.displacement_px.count;
    }
  }
  EXPECT_GT(judged, kScenes * 500);
}

TEST(SymmetryImage, FindingsAreLocatedAlike) {
  const RayDevice device;
  std::size_t visible = 0;
  for (std::uint64_t seed = 0; seed < kScenes / 2; ++seed) {
    const Scene scene = make_scene(seed);
    for (const Camera& camera : scene.cameras) {
      std::vector<Finding> findings;
      for (const Vec3 p : scene.mesh.positions) {
        if (!std::isfinite(p.x + p.y + p.z)) continue;
        findings.emplace_back();
        findings.back().at = p;
        findings.back().gap_m = 0.5;
      }
      const std::vector<Finding> bare = findings;
      locate_in_picture(camera, RaySurface(device, scene.mesh), findings);
      for (int number = 1; number < 8; ++number) {
        const Move move = support::symmetry(number);
        std::vector<Finding> moved = bare;
        for (Finding& f : moved) f.at = move(f.at);
        const Mesh mesh = move(scene.mesh);
        locate_in_picture(move(camera), RaySurface(device, mesh), moved);
        for (std::size_t i = 0; i < moved.size(); ++i) {
          EXPECT_EQ(findings[i].visibility, moved[i].visibility) << move.name();
          EXPECT_EQ(findings[i].gap_px, moved[i].gap_px) << move.name();
          visible += moved[i].visibility == Visibility::visible;
        }
      }
      ASSERT_FALSE(HasFailure());
    }
  }
  EXPECT_GT(visible, kScenes * 100);
}

}  // namespace
}  // namespace plumbline::oracle
