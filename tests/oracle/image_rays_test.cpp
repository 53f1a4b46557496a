// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hits: three routes to the same bits (scan conversion, Embree's candidates, brute force), whatever
// instruction set Embree is limited to; and Embree's own single-precision triangles as a witness that shares
// no line with them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include <embree3/rtcore.h>
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include "image_scenes.h"
#include "scenarios/error.h"

namespace plumbline::oracle {
namespace {

using namespace test;

std::vector<std::string> runnable_isas() {
  std::vector<std::string> isas;
  for (const char* isa : {"", "sse2", "sse4.2", "avx", "avx2", "avx512"}) {
    try {
      const RayDevice device(isa);
      isas.emplace_back(isa);
    } catch (const InputError&) {  // a machine without it
    }
  }
  return isas;
}

/// The picture's hits, asked for one ray at a time.
PixelHits look_by_single_rays(const RaySurface& surface, const Camera& camera) {
  PixelHits hits;
  hits.width = camera.width_px;
  hits.height = camera.height_px;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const RayHit hit = surface.first_hit(camera, x + 0.5, y + 0.5);
      hits.triangle.push_back(hit.triangle);
      hits.depth_m.push_back(hit.depth_m);
    }
  }
  return hits;
}

std::size_t seen_pixels(const PixelHits& hits) {
  return hits.triangle.size() -
         static_cast<std::size_t>(std::count(hits.triangle.begin(), hits.triangle.end(), PixelHits::kNoHit));
}

TEST(ImageRays, ScanConversionEqualsBruteForceInEveryPixel) {
  const RayDevice device;
  for (const Terrain& terrain : {rugged(33, 30, 800, 1), stepped(33, 10, 25), rugged(17, 0.001, 0.05, 2)}) {
    const Mesh mesh = reference_mesh(terrain);
    const RaySurface surface(device, mesh);
    for (const Camera& camera : many_cameras(terrain, 97, 61)) {
      EXPECT_TRUE(same_hits(surface.look(camera), look_by_brute_force(mesh, camera)));
    }
  }
}

TEST(ImageRays, SingleRaysEqualScanConversionForEveryInstructionSet) {
  const std::vector<std::string> isas = runnable_isas();
  ASSERT_GE(isas.size(), 2U);  // "" and sse2: every x86-64
  std::size_t seen = 0;
  for (const std::string& isa : isas) {
    const RayDevice device(isa);
    for (const Terrain& terrain : {rugged(129, 30, 2500, 3), stepped(65, 10, 25)}) {
      const Mesh mesh = reference_mesh(terrain);
      const RaySurface surface(device, mesh);
      for (const Camera& camera : many_cameras(terrain, 128, 72)) {
        const PixelHits hits = surface.look(camera);
        seen += seen_pixels(hits);
        EXPECT_TRUE(same_hits(hits, look_by_single_rays(surface, camera))) << "isa " << isa;
      }
    }
  }
  EXPECT_GT(seen, 100000U);
}

/// Depth of Embree's own first hit on float triangles, ROBUST; infinite where nothing.
class Witness {
 public:
  explicit Witness(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
    for (const Vec3& p : mesh.positions) {
      for (const double x : {p.x, p.y, p.z}) *v++ = static_cast<float>(x);
    }
    auto* t = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) t = std::copy(triangle.begin(), triangle.end(), t);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Witness() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;
  [[nodiscard]] double depth(const Camera& camera, double x_px, double y_px) const {
    const Vec3 way = camera.ray_direction(x_px, y_px);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(camera.position.x);
    ray.ray.org_y = static_cast<float>(camera.position.y);
    ray.ray.org_z = static_cast<float>(camera.position.z);
    ray.ray.dir_x = static_cast<float>(way.x);
    ray.ray.dir_y = static_cast<float>(way.y);
    ray.ray.dir_z = static_cast<float>(way.z);
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = 0xffffffffu;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == 0 ? static_cast<double>(ray.ray.tfar) : std::numeric_limits<double>::infinity();
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

TEST(ImageRays, EmbreesOwnTrianglesBearWitness) {
  // Single precision may turn close calls only: where it disagrees, one of our rays around the pixel's
  // centre, less than 1/32 px off, must see what it sees.
  constexpr double kSameDepth = 1e-3;
  constexpr double kClosePx = 1.0 / 32;
  std::size_t seen = 0;
  std::size_t close_calls = 0;
  const Terrain terrain = rugged(129, 30, 2500, 9);
  const Mesh mesh = reference_mesh(terrain);
  const RayDevice device;
  const RaySurface surface(device, mesh);
  const Witness witness(mesh);
  std::vector<Camera> cameras = many_cameras(terrain, 240, 135);
  cameras.erase(cameras.begin() + 5);  // from afar: a float's share of 10 000 km is more than a cell
  for (const Camera& camera : cameras) {
    const PixelHits hits = surface.look(camera);
    for (int y = 0; y < 135; ++y) {
      for (int x = 0; x < 240; ++x) {
        const double theirs = witness.depth(camera, x + 0.5, y + 0.5);
        const auto agrees = [&](double ours) {
          return theirs == ours || std::fabs(theirs - ours) <= kSameDepth * std::max(theirs, ours);
        };
        const double ours = hits.depth_m[static_cast<std::size_t>(y * 240 + x)];
        seen += ours < std::numeric_limits<double>::infinity() ? 1U : 0U;
        if (agrees(ours)) continue;
        ++close_calls;
        bool close = false;
        for (const double dx : {-kClosePx, 0.0, kClosePx}) {
          for (const double dy : {-kClosePx, 0.0, kClosePx}) {
            close = close || agrees(surface.first_hit(camera, x + 0.5 + dx, y + 0.5 + dy).depth_m);
          }
        }
        EXPECT_TRUE(close) << "pixel " << x << ", " << y << ": " << ours << " m against " << theirs << " m";
      }
    }
  }
  EXPECT_GT(seen, 50000U);
  EXPECT_LT(close_calls, seen / 1000);
}

TEST(ImageRays, RaysAimedAtNodesAndEdgesNeverSlipThrough) {
  // A closed surface seen from above fills the picture; pixel centres are aimed exactly at nodes and edge
  // middles.
  const Terrain terrain = terrain_of(33, 33, 1, [](int i, int j) { return ((i * 5 + j * 3) % 7) * 0.125; });
  const Mesh mesh = reference_mesh(terrain);
  for (const std::string& isa : runnable_isas()) {
    const RayDevice device(isa);
    const RaySurface surface(device, mesh);
    for (const double shift : {0.0, 0.5, 0.25}) {
      const Camera camera = make_camera({16 + shift, 16, 64}, {16 + shift, 16, 0}, 10, 33, 33);
      const PixelHits hits = surface.look(camera);
      EXPECT_EQ(seen_pixels(hits), 33U * 33U);
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3 p = mesh.positions[v];
        if (!camera.sees(p)) continue;
        const Vec2 at = camera.project(p);
        const RayHit hit = surface.first_hit(camera, at.x, at.y);
        ASSERT_NE(hit.triangle, RayHit::kNone);
        EXPECT_NEAR(hit.depth_m, camera.depth(p), 1e-9);
      }
    }
  }
}

TEST(ImageRays, SharedEdgeGoesToTheLeastIndex) {
  // Two triangles share the edge x = 0, straight below the picture's middle column; their depths there are
  // equal.
  Mesh mesh;
  mesh.positions = {{0, -8, 0}, {0, 8, 0}, {-8, 0, 0}, {8, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  const Camera camera = make_camera({0, 0, 8}, {0, 0, 0}, 60, 5, 5);
  const RayDevice device;
  for (const bool swapped : {false, true}) {
    if (swapped) std::swap(mesh.triangles[0], mesh.triangles[1]);
    const RaySurface surface(device, mesh);
    const PixelHits hits = surface.look(camera);
    for (std::size_t y = 0; y < 5; ++y) EXPECT_EQ(hits.triangle[y * 5 + 2], 0U) << y;
    EXPECT_EQ(surface.first_hit(camera, 2.5, 2.5), (RayHit{0, 8}));
  }
}

TEST(ImageRays, DoubledTriangleGoesToTheFirst) {
  Mesh mesh;
  mesh.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 2}, {0, 2, 1}};
  const RayDevice device;
  const RaySurface surface(device, mesh);
  const Camera camera = make_camera({0.3, -1, 3}, {0, 0, 0}, 50, 40, 30);
  const PixelHits hits = surface.look(camera);
  EXPECT_EQ(std::count(hits.triangle.begin(), hits.triangle.end(), 0U), 40 * 30);
  EXPECT_EQ(surface.first_hit(camera, 11.3, 7.9).triangle, 0U);
}

TEST(ImageRays, LimitsOfTheUsualAreHarmless) {
  const RayDevice device;
  const Camera camera = make_camera({0, 0, 10}, {0, 0, 0}, 60, 16, 9);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  Mesh mesh;
  const auto nothing = [&] {
    const RaySurface surface(device, mesh);
    EXPECT_EQ(seen_pixels(surface.look(camera)), 0U);
    EXPECT_EQ(surface.first_hit(camera, 8, 4.5), RayHit{});
    EXPECT_FALSE(surface.height_at({0, 0}).has_value());
  };
  nothing();
  mesh.positions = {{-5, -5, nan}, {5, -5, 0}, {0, 5, 0}, {0, inf, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {1, 2, 4}, {1, 2, 0xffffffffu}};
  nothing();
  mesh.triangles = {{1, 1, 1}, {1, 1, 2}};  // no area
  nothing();
  // A sound triangle among bad ones keeps its number.
  mesh.positions[0].z = 0;
  mesh.triangles = {{1, 2, 3}, {9, 9, 9}, {0, 1, 2}};
  const RaySurface surface(device, mesh);
  EXPECT_EQ(surface.first_hit(camera, 8, 4.5), (RayHit{2, 10}));
  EXPECT_EQ(surface.look(camera).triangle[4 * 16 + 8], 2U);
  EXPECT_EQ(surface.height_at({0, 0}), 0.0);
}

TEST(ImageRays, HugeAndTinyScenesScaleExactly) {
  const RayDevice device;
  const Terrain terrain = rugged(33, 30, 800, 5);
  const Mesh mesh = reference_mesh(terrain);
  const RaySurface surface(device, mesh);
  for (const int power : {-60, -7, 11, 200}) {
    const double scale = std::ldexp(1.0, power);
    Mesh scaled = mesh;
    for (Vec3& p : scaled.positions) p = p * scale;
    const RaySurface other(device, scaled);
    for (Camera camera : many_cameras(terrain, 64, 36)) {
      PixelHits hits = surface.look(camera);
      camera.position = camera.position * scale;
      for (double& depth : hits.depth_m) depth *= scale;
      EXPECT_TRUE(same_hits(hits, other.look(camera))) << power;
      for (std::size_t y = 0; y < 36; y += 5) {
        for (std::size_t x = 0; x < 64; x += 7) {
          const RayHit hit =
              other.first_hit(camera, static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
          EXPECT_EQ(hit.triangle, hits.triangle[y * 64 + x]);
          EXPECT_EQ(hit.depth_m, hits.depth_m[y * 64 + x]);
        }
      }
    }
  }
}

TEST(ImageRays, MirroredSceneGivesTheMirroredPicture) {
  const RayDevice device;
  const Terrain terrain = rugged(33, 32, 700, 6);
  const Mesh mesh = reference_mesh(terrain);
  Mesh mirrored = mesh;
  for (Vec3& p : mirrored.positions) p.x = -p.x;
  for (auto& t : mirrored.triangles) std::swap(t[1], t[2]);
  const RaySurface surface(device, mesh);
  const RaySurface other(device, mirrored);
  // North, level: the camera's axes mirror without rounding.
  const double eye_m = terrain.surface_height_m(500, 40) + 60;
  Camera camera = make_camera({500, 40, eye_m}, {500, 2000, eye_m}, 60, 80, 45);
  const PixelHits hits = surface.look(camera);
  camera.position.x = -camera.position.x;
  const PixelHits mirror = other.look(camera);
  std::size_t same_triangle = 0;
  for (std::size_t y = 0; y < 45; ++y) {
    for (std::size_t x = 0; x < 80; ++x) {
      EXPECT_EQ(hits.depth_m[y * 80 + x], mirror.depth_m[y * 80 + 79 - x]);
      EXPECT_EQ(hits.triangle[y * 80 + x], mirror.triangle[y * 80 + 79 - x]);
      same_triangle += hits.triangle[y * 80 + x] != PixelHits::kNoHit ? 1U : 0U;
    }
  }
  EXPECT_GT(same_triangle, 500U);
}

TEST(ImageRays, ThreadsShareASurface) {
  const RayDevice device;
  const Terrain terrain = rugged(65, 30, 900, 7);
  const Mesh mesh = reference_mesh(terrain);
  const std::vector<Camera> cameras = many_cameras(terrain, 96, 54);
  const RaySurface alone(device, mesh);
  const RaySurface shared(device, mesh);
  std::vector<PixelHits> expected;
  for (const Camera& camera : cameras) expected.push_back(look_by_single_rays(alone, camera));
  std::vector<std::thread> threads;
  std::vector<int> same(4, 0);  // not bool: written from several threads
  for (std::size_t k = 0; k < same.size(); ++k) {
    threads.emplace_back([&, k] {
      bool all = true;
      for (std::size_t i = 0; i < cameras.size(); ++i) {
        all = all && same_hits(look_by_single_rays(shared, cameras[i]), expected[i]) &&
              same_hits(shared.look(cameras[i]), expected[i]);
      }
      same[k] = all ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int all : same) EXPECT_EQ(all, 1);
}

TEST(ImageRays, SubnormalsSurviveEmbree) {
  const unsigned before = _mm_getcsr();
  const RayDevice device;
  const Terrain terrain = rugged(33, 30, 800, 8);
  const Mesh mesh = reference_mesh(terrain);
  const RaySurface surface(device, mesh);
  const Camera camera = many_cameras(terrain, 8, 8).front();
  EXPECT_NE(surface.first_hit(camera, 4, 4).triangle, RayHit::kNone);
  EXPECT_EQ(_mm_getcsr() & 0xffc0U, before & 0xffc0U);  // all but the sticky exception flags
  volatile double least = std::numeric_limits<double>::min();
  EXPECT_GT(least / 4, 0.0);
}

TEST(ImageRays, UnknownInstructionSetIsRefusedInOneLine) {
  for (const char* isa : {"mmx", "AVX2", "avx2,threads=9", "sse"}) {
    try {
      const RayDevice device(isa);
      ADD_FAILURE() << isa;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(isa), std::string::npos);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace plumbline::oracle
