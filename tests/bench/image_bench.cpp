// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// O3 at 1280 × 720 against its floor: bare Embree packets for the rays that the definitions ask for, one a
// pixel for the primary hits of the reference and of the mesh, one for the vertical look-up of each point
// seen on the mesh and, for the pop, on the previous frame's mesh. Embree's triangles in float, ROBUST,
// packets of 16 (8 without AVX-512) in 4 × 4 (4 × 2) tiles, coherent, flush-to-zero on: as quick as it goes.
// The trees' builds are not counted, in the floor's favour; what the oracle builds for a frame's mesh (its
// index for vertical look-ups) is.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include "oracle/image.h"
#include "scenarios/camera.h"
#include "scenarios/random.h"
#include "scenarios/terrain.h"

namespace {

using namespace plumbline;
using oracle::PixelHits;
using oracle::RayDevice;
using oracle::RaySurface;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kSide = 1025;
constexpr double kSpacingM = 30;
constexpr double kRoughness = 0.55;  ///< amplitude of an octave to that of the one before
constexpr double kReliefM = 1500;
constexpr std::size_t kMeshTriangles = 20000;

/// Midpoint displacement: T2 of docs, a fractal of 2 097 152 triangles.
Terrain fractal() {
  Terrain terrain;
  terrain.columns = terrain.rows = kSide;
  terrain.spacing_m = kSpacingM;
  terrain.heights_m.assign(static_cast<std::size_t>(kSide) * kSide, 0);
  const auto noise = [](int i, int j) {
    return static_cast<double>(lattice_hash(1, i, j) >> 11) * 0x1p-52 - 1;
  };
  const auto at = [&](int i, int j) -> double& { return terrain.heights_m[terrain.index(i, j)]; };
  double amplitude = kReliefM;
  for (int step = kSide - 1; step > 1; step /= 2, amplitude *= kRoughness) {
    const int half = step / 2;
    for (int j = 0; j < kSide; j += half) {
      for (int i = 0; i < kSide; i += half) {
        const bool odd_i = i % step != 0;
        const bool odd_j = j % step != 0;
        if (!odd_i && !odd_j) continue;
        const int i0 = odd_i ? i - half : i;
        const int i1 = odd_i ? i + half : i;
        const int j0 = odd_j ? j - half : j;
        const int j1 = odd_j ? j + half : j;
        at(i, j) = (at(i0, j0) + at(i1, j0) + at(i0, j1) + at(i1, j1)) / 4 + amplitude * noise(i, j) / 2;
      }
    }
  }
  return terrain;
}

/// A conforming right-triangle mesh by longest-edge bisection, fine where the error looks large from an eye:
/// what a view-dependent method makes. A sample is in the mesh if its error asks for it or a finer sample
/// needs it as a corner.
class Bisection {
 public:
  Bisection(const Terrain& terrain, Vec3 eye, std::size_t wanted) : terrain_(terrain) {
    double low = 0;
    double high = 1;
    for (int step = 0; step < 20; ++step) {  // the threshold that gives about as many triangles as wanted
      const double threshold = (low + high) / 2;
      build(eye, threshold);
      (mesh_.triangles.size() > wanted ? low : high) = threshold;
    }
    build(eye, high);
  }
  Mesh take() { return std::move(mesh_); }

 private:
  static int step_of(int i, int j) {
    const int both = i | j;
    return both & -both;
  }
  void build(Vec3 eye, double threshold) {
    active_.assign(terrain_.heights_m.size(), 0);
    numbers_.assign(terrain_.heights_m.size(), 0xffffffffu);
    mesh_.clear();
    const int n = kSide - 1;
    for (const int i : {0, n}) {
      for (const int j : {0, n}) active_[terrain_.index(i, j)] = 1;
    }
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        if ((i == 0 || i == n) && (j == 0 || j == n)) continue;
        const double size_m = step_of(i, j) * terrain_.spacing_m;
        const double distance_m = std::max(length(terrain_.point(i, j) - eye), size_m);
        if ((error(i, j) + 0.02 * size_m) / distance_m > threshold) activate(i, j);
      }
    }
    add({n, 0}, {n, n}, {0, 0});
    add({0, n}, {0, 0}, {n, n});
  }
  [[nodiscard]] double error(int i, int j) const {
    const int s = step_of(i, j);
    const bool x = (i & s) != 0;
    const bool y = (j & s) != 0;
    if (x && y) {
      // The longest edge runs between the two corners that are not apexes (see activate).
      const bool rising = ((((i - s) / (2 * s)) ^ ((j - s) / (2 * s))) & 1) == 0;
      const int dy = rising ? s : -s;
      return std::fabs(terrain_.z(i, j) - (terrain_.z(i - s, j - dy) + terrain_.z(i + s, j + dy)) / 2);
    }
    const int dx = x ? s : 0;
    const int dy = y ? s : 0;
    return std::fabs(terrain_.z(i, j) - (terrain_.z(i - dx, j - dy) + terrain_.z(i + dx, j + dy)) / 2);
  }
  /// A sample is the middle of a longest edge; the triangles on its two sides must be there, that is, their
  /// apexes.
  void activate(int i, int j) {
    if (i < 0 || j < 0 || i >= kSide || j >= kSide || active_[terrain_.index(i, j)] != 0) return;
    active_[terrain_.index(i, j)] = 1;
    const int s = step_of(i, j);
    const bool x = (i & s) != 0;
    const bool y = (j & s) != 0;
    if (x && y) {
      for (const int a : {i - s, i + s}) {
        for (const int b : {j - s, j + s}) {
          if ((((a / (2 * s)) ^ (b / (2 * s))) & 1) != 0) activate(a, b);
        }
      }
    } else {
      const int dx = x ? 0 : s;
      const int dy = y ? 0 : s;
      activate(i - dx, j - dy);
      activate(i + dx, j + dy);
    }
  }
  using Place = std::array<int, 2>;
  std::uint32_t number(Place p) {
    std::uint32_t& n = numbers_[terrain_.index(p[0], p[1])];
    if (n == 0xffffffffu) {
      n = static_cast<std::uint32_t>(mesh_.positions.size());
      mesh_.positions.push_back(terrain_.point(p[0], p[1]));
    }
    return n;
  }
  void add(Place apex, Place left, Place right) {
    const Place middle{(left[0] + right[0]) / 2, (left[1] + right[1]) / 2};
    const bool finest = std::abs(left[0] - right[0]) < 2 && std::abs(left[1] - right[1]) < 2;
    if (finest || active_[terrain_.index(middle[0], middle[1])] == 0) {
      mesh_.triangles.push_back({number(apex), number(left), number(right)});
      return;
    }
    add(middle, apex, left);
    add(middle, right, apex);
  }

  const Terrain& terrain_;
  std::vector<std::uint8_t> active_;
  std::vector<std::uint32_t> numbers_;
  Mesh mesh_;
};

/// Embree alone: float triangles.
class BareScene {
 public:
  BareScene(RTCDevice device, const Mesh& mesh, Vec3 origin) : scene_(rtcNewScene(device)) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
    for (const Vec3& p : mesh.positions) {
      for (const double x : {p.x - origin.x, p.y - origin.y, p.z - origin.z}) *v++ = static_cast<float>(x);
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
  ~BareScene() { rtcReleaseScene(scene_); }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;
  [[nodiscard]] RTCScene scene() const { return scene_; }

 private:
  RTCScene scene_;
};

constexpr int kTile = 4;

/// Casts one ray a pixel, in 4 × 4 tiles: make(pixel, origin, direction) says which. Returns the hits'
/// depths.
template <typename Make>
std::size_t cast(const BareScene& scene, bool wide, std::vector<float>& depth, Make&& make) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  std::size_t rays = 0;
  const auto packet = [&]<typename Packet, int N>(Packet& p, std::integral_constant<int, N>, int x0, int y0) {
    alignas(64) std::array<int, N> valid{};
    for (int k = 0; k < N; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const std::size_t pixel =
          static_cast<std::size_t>(y0 + k / kTile) * kWidth + static_cast<std::size_t>(x0 + k % kTile);
      std::array<float, 6> ray{};
      valid[i] = make(pixel, ray) ? -1 : 0;
      rays += valid[i] != 0 ? 1U : 0U;
      p.ray.org_x[i] = ray[0];
      p.ray.org_y[i] = ray[1];
      p.ray.org_z[i] = ray[2];
      p.ray.dir_x[i] = ray[3];
      p.ray.dir_y[i] = ray[4];
      p.ray.dir_z[i] = ray[5];
      p.ray.tnear[i] = 0;
      p.ray.tfar[i] = std::numeric_limits<float>::infinity();
      p.ray.time[i] = 0;
      p.ray.mask[i] = 0xffffffffu;
      p.ray.flags[i] = 0;
      p.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      p.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    if constexpr (N == 16) {
      rtcIntersect16(valid.data(), scene.scene(), &context, &p);
    } else {
      rtcIntersect8(valid.data(), scene.scene(), &context, &p);
    }
    for (int k = 0; k < N; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const std::size_t pixel =
          static_cast<std::size_t>(y0 + k / kTile) * kWidth + static_cast<std::size_t>(x0 + k % kTile);
      depth[pixel] =
          valid[i] != 0 && p.hit.geomID[i] == 0 ? p.ray.tfar[i] : std::numeric_limits<float>::infinity();
    }
  };
  for (int y = 0; y < kHeight; y += wide ? 4 : 2) {
    for (int x = 0; x < kWidth; x += kTile) {
      if (wide) {
        alignas(64) RTCRayHit16 p;
        packet(p, std::integral_constant<int, 16>{}, x, y);
      } else {
        alignas(32) RTCRayHit8 p;
        packet(p, std::integral_constant<int, 8>{}, x, y);
      }
    }
  }
  return rays;
}

struct Bench {
  Terrain terrain = fractal();
  Vec3 middle{terrain.width_m() / 2, terrain.depth_m() / 2, 0};
  Mesh reference = reference_mesh(terrain);
  Mesh mesh, before;
  Camera camera;
  RTCDevice bare_device = rtcNewDevice(nullptr);
  bool wide = rtcGetDeviceProperty(bare_device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;

  explicit Bench(Vec3 eye, Vec3 at) : camera(make_camera(eye, at, 60, kWidth, kHeight)) {
    mesh = Bisection(terrain, eye, kMeshTriangles).take();
    before = Bisection(terrain, eye + Vec3{40, -60, 10}, kMeshTriangles).take();
  }
  ~Bench() { rtcReleaseDevice(bare_device); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
};

struct BareScenes {
  BareScene reference, mesh, before;
  explicit BareScenes(const Bench& b)
      : reference(b.bare_device, b.reference, b.middle),
        mesh(b.bare_device, b.mesh, b.middle),
        before(b.bare_device, b.before, b.middle) {}
};

/// The floor: the rays of one frame, nothing else.
std::size_t bare_frame(const Bench& b, const BareScenes& scenes, std::vector<float>& depth_reference,
                       std::vector<float>& depth_mesh, std::vector<float>& height) {
  const Camera& camera = b.camera;
  const Vec3 right = camera.right();
  const Vec3 eye = camera.position - b.middle;
  const std::array<float, 3> from{static_cast<float>(eye.x), static_cast<float>(eye.y),
                                  static_cast<float>(eye.z)};
  const auto direction = [&](std::size_t pixel) {
    const double x = (static_cast<double>(pixel % kWidth) + 0.5 - kWidth * 0.5) / camera.kappa_px;
    const double y = (static_cast<double>(pixel / kWidth) + 0.5 - kHeight * 0.5) / camera.kappa_px;
    return camera.forward + right * x - camera.up * y;
  };
  const auto primary = [&](std::size_t pixel, std::array<float, 6>& ray) {
    const Vec3 d = direction(pixel);
    ray = {
        from[0], from[1], from[2], static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
    return true;
  };
  const auto vertical = [&](const std::vector<float>& depth) {
    return [&](std::size_t pixel, std::array<float, 6>& ray) {
      if (!(depth[pixel] < std::numeric_limits<float>::infinity())) return false;
      const Vec3 p = eye + direction(pixel) * static_cast<double>(depth[pixel]);
      ray = {static_cast<float>(p.x), static_cast<float>(p.y), 1e5F, 0, 0, -1};
      return true;
    };
  };
  std::size_t rays = cast(scenes.reference, b.wide, depth_reference, primary);
  rays += cast(scenes.mesh, b.wide, depth_mesh, primary);
  rays += cast(scenes.mesh, b.wide, height, vertical(depth_reference));
  rays += cast(scenes.before, b.wide, height, vertical(depth_mesh));
  return rays;
}

/// The oracle: every figure of one frame, a fresh surface for the frame's mesh; the previous frame's has its
/// index.
double oracle_frame(const Bench& b, const RayDevice& device, const RaySurface& reference,
                    const RaySurface& before) {
  const RaySurface mesh(device, b.mesh);
  const PixelHits reference_hits = reference.look(b.camera);
  const PixelHits mesh_hits = mesh.look(b.camera);
  const oracle::ImageError error = image_error(b.camera, reference, reference_hits, mesh, mesh_hits, 1.0);
  const oracle::PixelFigure popped = pop(b.camera, mesh, mesh_hits, before);
  return error.displacement_px.p99 + popped.p99;
}

/// Seconds a frame: of the clock on the wall, and of the processors' time (what other programs on the machine
/// take does not count there). Least of several calls, one frame a thread and call.
struct Seconds {
  double wall = std::numeric_limits<double>::infinity();
  double processor = std::numeric_limits<double>::infinity();
};
template <typename Call>
Seconds seconds_a_frame(int threads, Call&& call) {
  constexpr int kRepeats = 7;
  Seconds least;
  for (int r = 0; r < kRepeats; ++r) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor_start = std::clock();
    std::vector<std::thread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back([&call, t] { call(t); });
    call(0);
    for (std::thread& other : others) other.join();
    const double processor = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    least.wall = std::min(least.wall, wall / threads);
    least.processor = std::min(least.processor, processor / threads);
  }
  return least;
}

template <typename Call>
void print_part(const char* name, Call&& call) {
  fmt::print("  {:<42} {:7.1f} ms\n", name, 1e3 * seconds_a_frame(1, [&](int) { call(); }).processor);
}

void run(const char* name, const Bench& b) {
  const BareScenes scenes(b);
  const RayDevice device;
  const RaySurface reference(device, b.reference);
  const RaySurface before(device, b.before);
  const std::size_t pixels = std::size_t{kWidth} * kHeight;
  std::array<std::vector<float>, 6> depth;
  for (auto& d : depth) d.resize(pixels);
  fmt::print("{}: reference {} triangles, mesh {}; {} x {}, packets of {}\n", name,
             b.reference.triangles.size(), b.mesh.triangles.size(), kWidth, kHeight, b.wide ? 16 : 8);
  std::size_t rays = 0;
  std::array<double, 2> sums{};
  for (const int threads : {1, 2}) {
    const Seconds bare = seconds_a_frame(threads, [&](int t) {
      const unsigned saved = _mm_getcsr();
      _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
      _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
      const auto k = static_cast<std::size_t>(t) * 3;
      const std::size_t count = bare_frame(b, scenes, depth[k], depth[k + 1], depth[k + 2]);
      if (t == 0) rays = count;
      _mm_setcsr(saved);
    });
    const Seconds ours = seconds_a_frame(threads, [&](int t) {
      sums[static_cast<std::size_t>(t)] = oracle_frame(b, device, reference, before);
    });
    const double mega = static_cast<double>(rays) * 1e-6;
    fmt::print(
        "  {} thread(s): bare Embree {:.1f} ms a frame ({:.1f} Mrays/s), oracle {:.1f} ms, ratio {:.2f}; ",
        threads, bare.wall * 1e3, mega / bare.wall, ours.wall * 1e3, bare.wall / ours.wall);
    fmt::print("processor time {:.1f} and {:.1f} ms, ratio {:.2f}\n", bare.processor * 1e3,
               ours.processor * 1e3, bare.processor / ours.processor);
  }
  const PixelHits reference_hits = reference.look(b.camera);
  const RaySurface mesh(device, b.mesh);
  const PixelHits mesh_hits = mesh.look(b.camera);
  print_part("look at the reference", [&] { static_cast<void>(reference.look(b.camera)); });
  print_part("look at the mesh", [&] { static_cast<void>(mesh.look(b.camera)); });
  print_part("index of the mesh", [&] { static_cast<void>(RaySurface(device, b.mesh).height_at({0, 0})); });
  print_part("image error", [&] {
    static_cast<void>(image_error(b.camera, reference, reference_hits, mesh, mesh_hits, 1.0));
  });
  print_part("pop", [&] { static_cast<void>(pop(b.camera, mesh, mesh_hits, before)); });
}

}  // namespace

int main() {
  const double extent = (kSide - 1) * kSpacingM;
  {
    const Bench bench({0.5 * extent, -0.05 * extent, 6000}, {0.5 * extent, 0.4 * extent, 0});
    run("oblique", bench);
  }
  {
    const Bench bench({0.1 * extent, 0.1 * extent, 2600}, {0.9 * extent, 0.9 * extent, 500});
    run("horizon", bench);
  }
  {
    const Bench bench({0.5 * extent, 0.5 * extent, 1.2 * extent}, {0.5 * extent, 0.5 * extent, 0});
    run("straight down", bench);
  }
  return 0;
}
