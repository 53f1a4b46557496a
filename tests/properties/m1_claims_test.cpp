// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Claims and suspicions of METHODS M1, measured: cost (C3), morphing (C4, S7), the image error (C5, S1, S3,
// S6), averages against samples (C7), orientation (C8), the border (S2), planes (S4), recovery (S5). What is
// a matter of the triangulation alone (C1, C2, C6) is in m1_dual_mesh_test. Figures: docs/claims.md.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "oracle/vertical.h"
#include "properties/atlas/case_file.h"
#include "properties/laws/generators.h"
#include "properties/laws/law.h"
#include "properties/tables/stage.h"
#include "scenarios/terrain_source.h"

namespace plumbline::properties {
namespace {

Terrain ground(const std::string& generator, int size) {
  TerrainSource source;
  source.id = generator;
  source.generator = generator;
  source.size = size;
  return load_terrain(source);
}

std::unique_ptr<LodMethod> prepared(const std::string& id, const Terrain& terrain, double threshold_px,
                                    const Options& options = {}) {
  auto method = make_method(id, options);
  method->prepare(terrain);
  method->set_threshold_px(threshold_px);
  return method;
}

/// Aside of the terrain's south-west corner and above it, looking at its middle; `nearer` > 1 comes closer.
Camera aside(const Terrain& terrain, double nearer = 1, double look_east = 0.5) {
  const double w = terrain.width_m();
  const double top = terrain.highest_m();
  return make_camera({-0.2 * w / nearer, -0.2 * w / nearer, top + 0.3 * w / nearer},
                     {look_east * w, 0.5 * w, top / 2}, 60, 320, 180);
}

/// A first frame, then updates until nothing changes.
void settle(LodMethod& method, const Camera& camera, LodFrame& frame) {
  method.update(camera, frame);
  for (int k = 0; k < 100; ++k) {
    method.update(camera, frame);
    if (frame.counters.split + frame.counters.merged == 0) return;
  }
  FAIL() << "no rest in 100 frames";
}

/// The threshold at which a first frame has about so many triangles, by bisection.
double threshold_for(LodMethod& method, const Camera& camera, std::size_t triangles) {
  double low = 1e-3, high = 1e3;
  LodFrame frame;
  for (int k = 0; k < 40; ++k) {
    const double middle = std::sqrt(low * high);
    method.set_threshold_px(middle);
    method.reset();
    method.update(camera, frame);
    (frame.mesh.triangles.size() > triangles ? low : high) = middle;
  }
  return high;
}

double displaced_px(const Terrain& terrain, const LodMethod& method, const Camera& camera,
                    const LodFrame& frame) {
  static const oracle::RayDevice device;
  const tables::Ground reference(device, terrain, method.reference(terrain));
  return reference.displacement_px(camera, reference.look(camera), frame.mesh).max;
}

TEST(M1Claims, M1_C3_TheCostFollowsTheModel) {
  for (const std::size_t triangles : {1000u, 4000u, 16000u}) {
    double evaluated_small = 0;
    for (const int size : {257, 1025}) {
      const Terrain terrain = ground("fbm", size);
      const auto method = prepared("haar_quadtree", terrain, 1);
      method->set_threshold_px(threshold_for(*method, aside(terrain), triangles));
      method->reset();
      LodFrame frame;
      settle(*method, aside(terrain), frame);
      const Counters& c = frame.counters;
      const auto roots = static_cast<double>(frame.mesh.positions.size());
      const auto visited = static_cast<double>(c.visited), evaluated = static_cast<double>(c.evaluated);
      const auto nodes = static_cast<double>(c.nodes);
      EXPECT_EQ(3 * visited, 4 * roots - 1) << "an identity: one tree, its roots and what is above them";
      EXPECT_LE(evaluated, visited);
      fmt::print("{}^2: {} triangles, visited {:.2f} %, evaluated {:.2f} % of {} nodes\n", size - 1,
                 frame.mesh.triangles.size(), 100 * visited / nodes, 100 * evaluated / nodes, c.nodes);
      if (size == 257) {
        evaluated_small = evaluated;
      } else {
        // Sixteen times the samples and as many triangles: the work stays the model's.
        EXPECT_LT(evaluated, 1.5 * evaluated_small);
      }
    }
  }
}

struct Tally {
  int judged = 0, violated = 0;
  double largest_px = 0, largest_ratio = 0;
};

/// A law over drawn cases; `prepare` may change them or turn them down.
template <class Prepare>
Tally tally(const std::string& law_id, const std::string& method, std::uint64_t cases, Prepare&& prepare) {
  const Law& law = find_law(law_id);
  Tally out;
  for (std::uint64_t k = 0; k < cases; ++k) {
    LawInput input = draw_case(method, 61, k).input;
    if (!prepare(input)) continue;
    const LawOutcome outcome = judge(law, input);
    if (outcome.kind == LawOutcome::Kind::vacuous) continue;
    ++out.judged;
    if (outcome.kind != LawOutcome::Kind::violated) continue;
    ++out.violated;
    out.largest_px = std::max(out.largest_px, outcome.finding->gap_px);
    out.largest_ratio = std::max(out.largest_ratio, outcome.finding->gap_px / input.threshold_px);
  }
  return out;
}

TEST(M1Claims, M1_C4_S7_MergingIsSeenWhereTheParentIsInMidMorph) {
  const Tally t = tally("continuous_in_camera", "haar_quadtree:morph", 20000, [](LawInput&) { return true; });
  fmt::print("merging moved the surface in {} of {} trials, at most by {:.3g} tau\n", t.violated, t.judged,
             t.largest_ratio);
  EXPECT_GT(t.judged, 500);
  EXPECT_GT(t.violated, 0);
  EXPECT_GT(t.judged, 2 * t.violated);
  // Without a morph to be in the middle of, the jump is to α = 0: errors are not nested, so a child can
  // outlast its parent's threshold, and λ cures nothing.
  const Tally narrow = tally("continuous_in_camera", "haar_quadtree:morph", 20000, [](LawInput& input) {
    input.options["lambda"] = 1 + 0x1p-40;
    return true;
  });
  fmt::print("with lambda = 1 + 2^-40: {} of {}\n", narrow.violated, narrow.judged);
  EXPECT_GT(narrow.violated, 0);
}

TEST(M1Claims, M1_C5_S1_TheImageErrorExceedsTau) {
  const Tally t = tally("screen_error_within_tau", "haar_quadtree", 20000, [](LawInput& input) {
    input.options["cull"] = false;
    return true;
  });
  fmt::print("drawn cases, nothing culled: {} of {} over tau, at most {:.4g} tau\n", t.violated, t.judged,
             t.largest_ratio);
  EXPECT_GT(t.violated, 0);
  for (const char* generator : {"tilted_plane", "sine", "fbm", "ridged", "canyon", "cliff"}) {
    const Terrain terrain = ground(generator, 257);
    double largest = 0;
    for (const double threshold_px : {1.0, 4.0}) {
      const auto method = prepared("haar_quadtree", terrain, threshold_px, {{"cull", false}});
      LodFrame frame;
      settle(*method, aside(terrain), frame);
      const double ratio = displaced_px(terrain, *method, aside(terrain), frame) / threshold_px;
      fmt::print("{}, tau {} px: displaced by at most {:.2f} tau, {} triangles\n", generator, threshold_px,
                 ratio, frame.mesh.triangles.size());
      largest = std::max(largest, ratio);
    }
    if (std::string(generator) == "fbm" || std::string(generator) == "ridged") {
      EXPECT_GT(largest, 1.5) << generator;
    }
  }
}

/// The same cut, each inner node at its mean, on the surface at the same place, or moved onto the sample to
/// the north-east of its place.
TEST(M1Claims, M1_C7_AveragesAgainstSamples) {
  int smaller_rms = 0, smaller_max = 0, smaller_than_subsampled = 0, all = 0;
  for (const char* generator : {"sine", "fbm", "ridged", "canyon", "island"}) {
    const Terrain terrain = ground(generator, 257);
    for (const double threshold_px : {0.25, 0.5, 1.0, 2.0}) {
      const auto method = prepared("haar_quadtree", terrain, threshold_px, {{"cull", false}});
      LodFrame frame;
      method->update(aside(terrain), frame);
      const oracle::VerticalError averaged = oracle::vertical_error(frame.mesh, terrain);
      for (Vec3& p : frame.mesh.positions) p.z = terrain.surface_height_m(p.x, p.y);
      const oracle::VerticalError sampled = oracle::vertical_error(frame.mesh, terrain);
      for (Vec3& p : frame.mesh.positions) {
        p = terrain.point(static_cast<int>(std::ceil(p.x / terrain.spacing_m)),
                          static_cast<int>(std::ceil(p.y / terrain.spacing_m)));
      }
      const oracle::VerticalError subsampled = oracle::vertical_error(frame.mesh, terrain);
      fmt::print(
          "{}, tau {}: rms {:.3f} m averaged, {:.3f} on the surface, {:.3f} at samples; max {:.1f}, "
          "{:.1f}, {:.1f} m\n",
          generator, threshold_px, averaged.rms, sampled.rms, subsampled.rms, averaged.max, sampled.max,
          subsampled.max);
      smaller_rms += averaged.rms < sampled.rms ? 1 : 0;
      smaller_max += averaged.max < sampled.max ? 1 : 0;
      smaller_than_subsampled += averaged.rms < subsampled.rms ? 1 : 0;
      ++all;
    }
  }
  fmt::print("of {}: the smaller rms in {} (against samples: {}), the smaller maximum in {}\n", all,
             smaller_rms, smaller_than_subsampled, smaller_max);
  EXPECT_EQ(all, 20);
  EXPECT_GT(smaller_rms, 0);
  EXPECT_LT(smaller_rms, all);
}

/// Where the camera looks acts through culling alone; only the direction to the node enters the error.
TEST(M1Claims, M1_C8_TurningTheCameraChangesTheMeshThroughCullingAlone) {
  const Terrain terrain = ground("fbm", 129);
  for (const bool cull : {false, true}) {
    const auto method = prepared("haar_quadtree", terrain, 2, {{"cull", cull}});
    LodFrame ahead, turned;
    method->update(aside(terrain), ahead);
    method->reset();
    method->update(aside(terrain, 1, -1.5), turned);
    EXPECT_EQ(ahead.mesh.positions == turned.mesh.positions && ahead.mesh.triangles == turned.mesh.triangles,
              !cull);
  }
}

TEST(M1Claims, M1_S2_TheBorderRecedesByHalfACell) {
  const Terrain terrain = ground("fbm", 257);
  const double side_m = 255 * terrain.spacing_m;
  double recession_m = 0;
  for (const double threshold_px : {0.125, 0.5, 2.0, 4.0}) {
    const auto method = prepared("haar_quadtree", terrain, threshold_px, {{"cull", false}});
    LodFrame frame;
    method->update(aside(terrain), frame);
    double area_m2 = 0;
    for (const auto& [a, b, c] : frame.mesh.triangles) {
      const Vec3 u = frame.mesh.positions[b] - frame.mesh.positions[a];
      const Vec3 v = frame.mesh.positions[c] - frame.mesh.positions[a];
      area_m2 += (u.x * v.y - u.y * v.x) / 2;
    }
    recession_m = 0;
    for (std::size_t k = 0; k < frame.vertex_keys.size(); ++k) {
      // Keys run from coarse levels to fine ones, 4^l nodes a level.
      int level = 0;
      std::uint64_t first = 0;
      for (std::uint64_t nodes = 1; frame.vertex_keys[k] >= first + nodes; ++level, nodes *= 4)
        first += nodes;
      const double half_m = ((256 >> level) - 1) / 2.0 * terrain.spacing_m;
      const Vec3& p = frame.mesh.positions[k];
      const double to_border_m = std::min({p.x, p.y, side_m - p.x, side_m - p.y});
      if (to_border_m <= half_m) recession_m = std::max(recession_m, to_border_m);
    }
    fmt::print("tau {} px: the border is up to {} m inside of {} m, {:.2f} % of the area is not drawn\n",
               threshold_px, recession_m, side_m, 100 * (1 - area_m2 / (side_m * side_m)));
  }
  EXPECT_GT(recession_m, 1000);
}

TEST(M1Claims, M1_S4_ATiltedPlaneIsRefined) {
  Terrain terrain = ground("plane", 257);
  for (int j = 0; j < 257; ++j) {
    for (int i = 0; i < 257; ++i) terrain.heights_m[terrain.index(i, j)] = 0.25 * i * terrain.spacing_m;
  }
  LodFrame haar, restricted;
  prepared("haar_quadtree", terrain, 1)->update(aside(terrain), haar);
  prepared("restricted_quadtree", terrain, 1)->update(aside(terrain), restricted);
  fmt::print("a plane of slope 1/4, 256^2, tau 1 px: {} triangles, restricted_quadtree {}\n",
             haar.mesh.triangles.size(), restricted.mesh.triangles.size());
  EXPECT_LE(restricted.mesh.triangles.size(), 4u);
  EXPECT_GT(haar.mesh.triangles.size(), 50 * restricted.mesh.triangles.size());
}

TEST(M1Claims, M1_S5_FramesUntilTheErrorIsBackAfterATeleport) {
  const Terrain terrain = ground("fbm", 257);
  const double threshold_px = 2;
  const auto method = prepared("haar_quadtree", terrain, threshold_px);
  LodFrame frame, fresh;
  settle(*method, aside(terrain, 0.02), frame);
  const Camera near = aside(terrain, 3);
  const auto rested = method->clone();
  rested->update(near, fresh);
  const double at_rest_px = displaced_px(terrain, *method, near, fresh);
  int frames = 0;
  double after_px = 0;
  for (; frames < 20; ++frames) {
    method->update(near, frame);
    after_px = displaced_px(terrain, *method, near, frame);
    fmt::print("frame {}: {} triangles, displaced by {:.1f} px ({:.1f} px in a first frame)\n", frames + 1,
               frame.mesh.triangles.size(), after_px, at_rest_px);
    if (frame.counters.split == 0) break;
  }
  EXPECT_GE(frames, 4);
  EXPECT_LE(frames, 8 + 1) << "one level a frame, 8 levels";
  // And it does not come back to what a first frame shows: going down stops at a root whose own error is
  // small, whatever lies below it; only the bottom-up pass sees that.
  EXPECT_GT(after_px, at_rest_px);
}

TEST(M1Claims, M1_S6_CulledSubtreesReachIntoThePicture) {
  int worse = 0, judged = 0;
  double largest = 0;
  const Law& law = find_law("screen_error_within_tau");
  for (std::uint64_t k = 0; k < 20000; ++k) {
    LawInput input = draw_case("haar_quadtree", 62, k).input;
    if (input.poses.size() != 1) continue;
    input.options["cull"] = false;
    if (judge(law, input).kind != LawOutcome::Kind::held) continue;
    ++judged;
    input.options["cull"] = true;
    const LawOutcome culled = judge(law, input);
    if (culled.kind != LawOutcome::Kind::violated) continue;
    ++worse;
    largest = std::max(largest, culled.finding->gap_px / input.threshold_px);
  }
  fmt::print("held without culling and over tau with it: {} of {}, at most {:.3g} tau\n", worse, judged,
             largest);
  EXPECT_GT(judged, 500);
  EXPECT_GT(worse, 0);
}

TEST(M1Claims, M1_TheAtlasHoldsASuspicionEach) {
  const std::filesystem::path atlas = std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "properties" / "atlas";
  for (const char* file :
       {"m1_c5_3x5.toml", "m1_s2_5x5.toml", "m1_s3_5x5.toml", "m1_s6_5x3.toml", "m1_s7_9x9.toml"}) {
    const ReplayResult result = replay(load_case(atlas / file));
    EXPECT_TRUE(result.confirmed) << file << ": " << result.difference;
    EXPECT_EQ(result.outcome.kind, LawOutcome::Kind::violated) << file;
  }
}

}  // namespace
}  // namespace plumbline::properties
