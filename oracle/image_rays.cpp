// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Single rays: Embree proposes, doubles decide.
//
// Embree holds a tree of boxes in single precision and never sees a triangle. A ray's walk through the tree
// comes upon boxes; each one's triangle is decided in double (image_view.h), and the nearest so far shortens
// the ray. What can go wrong is that rounding makes the walk miss a box; so boxes are widened by more than
// all of Embree's rounding can come to. In the tree's units (the mesh fits into [−1, 1]³, rays start inside
// [−2, 2]³ and are followed for less than 8 units) there are: the ray's start and direction rounded to float,
// 2⁻²³ + 8·2⁻²⁴; the corners' rounding, 2⁻²⁴; the walk's own (box − start) × (1 / direction), at most 2⁻²²
// × 8. Together less than 2⁻¹⁸, which is kWiden: 15 cm on a terrain of 80 km. The result is therefore the
// same for every instruction set and tree.
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>
#include <xmmintrin.h>

#include "oracle/image_surface.h"
#include "scenarios/error.h"

namespace plumbline::oracle {
namespace {

/// Boxes are widened on every side by this, in the tree's units (see the head of this file).
constexpr double kWiden = 0x1p-18;
/// A hit shortens the ray to this much behind it (tree's units, and relative): more than the rounding of its
/// length.
constexpr double kBehind = 0x1p-16;

/// Embree and its helpers may leave flush-to-zero switched on; the rest of the program needs its subnormals.
class KeepControlRegister {
 public:
  KeepControlRegister() : saved_(_mm_getcsr()) {}
  ~KeepControlRegister() { _mm_setcsr(saved_); }
  KeepControlRegister(const KeepControlRegister&) = delete;
  KeepControlRegister& operator=(const KeepControlRegister&) = delete;

 private:
  unsigned saved_;
};

bool machine_runs(const std::string& isa) {
  if (isa == "sse2") return __builtin_cpu_supports("sse2") != 0;
  if (isa == "sse4.2") return __builtin_cpu_supports("sse4.2") != 0;
  if (isa == "avx") return __builtin_cpu_supports("avx") != 0;
  if (isa == "avx2") return __builtin_cpu_supports("avx2") != 0;
  if (isa == "avx512")
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  throw InputError(fmt::format(
      "Embree: instruction set '{}' is not known; use sse2, sse4.2, avx, avx2 or avx512, or leave it out",
      isa));
}

double component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

struct RayDevice::State {
  RTCDevice device = nullptr;
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

RayDevice::RayDevice(const std::string& isa) : state_(std::make_unique<State>()) {
  if (!isa.empty() && !machine_runs(isa)) {
    throw InputError(
        fmt::format("Embree: this machine does not run '{}'; leave the instruction set out", isa));
  }
  const KeepControlRegister keep;
  // No "threads=": with TBB that would limit the threads of the whole program.
  state_->device = rtcNewDevice(isa.empty() ? "" : fmt::format("isa={}", isa).c_str());
  if (state_->device == nullptr) {
    throw std::runtime_error(
        fmt::format("Embree: no device (error {})", static_cast<int>(rtcGetDeviceError(nullptr))));
  }
}

RayDevice::~RayDevice() = default;

struct RayTree::Scene {
  const Mesh* mesh = nullptr;
  const std::vector<std::uint8_t>* usable = nullptr;
  RTCScene scene = nullptr;
  Vec3 middle;       ///< of the mesh's bounding box; the tree's origin
  double scale = 1;  ///< tree's units per metre, a power of two
  bool empty = true;

  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }
  [[nodiscard]] bool uses(std::size_t t) const { return usable->empty() || (*usable)[t] != 0; }
};

namespace {

/// One ray's way through the tree. Embree hands `context` to the call-back; it is the first member, so the
/// rest follows.
struct Walk {
  RTCIntersectContext context;
  const Mesh* mesh;
  const View* view;
  double x, y;           ///< the ray (x, y, 1) in the camera's frame
  double start_depth;    ///< depth at which Embree's ray starts
  double units_a_depth;  ///< length of Embree's ray per metre of depth
  RayHit best;
};

void decide(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& walk = *reinterpret_cast<Walk*>(arguments->context);
  const auto& v = walk.mesh->triangles[arguments->primID];
  const auto& p = walk.mesh->positions;
  const EdgeFunctions edges(walk.view->local(p[v[0]]), walk.view->local(p[v[1]]), walk.view->local(p[v[2]]));
  const double depth = edges.depth_at(walk.x, walk.y);
  if (!(depth > 0)) return;
  RayHit& best = walk.best;
  if (depth < best.depth_m || (depth == best.depth_m && arguments->primID < best.triangle)) {
    best = {arguments->primID, depth};
    auto* ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    const double reach = (depth - walk.start_depth) * walk.units_a_depth * (1 + kBehind) + kBehind;
    ray->ray.tfar = std::min(ray->ray.tfar, static_cast<float>(reach));
    ray->hit.geomID = 0;
    ray->hit.primID = arguments->primID;
  }
}

}  // namespace

RayTree::RayTree(const RayDevice& device, const Mesh& mesh, const std::vector<std::uint8_t>& usable)
    : scene_(std::make_unique<Scene>()) {
  Scene& s = *scene_;
  s.mesh = &mesh;
  s.usable = &usable;
  Vec3 low, high;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!s.uses(t)) continue;
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Vec3 p = mesh.positions[v];
      if (s.empty) low = high = p;
      s.empty = false;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  if (s.empty) return;
  // Halved before the sum, so that no finite mesh overflows.
  s.middle = low * 0.5 + high * 0.5;
  const Vec3 half = high * 0.5 - low * 0.5;
  const double reach = std::max({half.x, half.y, half.z});
  int exponent = 0;
  std::frexp(reach, &exponent);
  s.scale = reach > 0 ? std::ldexp(1.0, -std::max(exponent, -1000)) : 1;

  const KeepControlRegister keep;
  s.scene = rtcNewScene(device.state().device);
  rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device.state().device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(mesh.triangles.size()));
  rtcSetGeometryUserData(geometry, &s);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* arguments) {
        const auto& of = *static_cast<const Scene*>(arguments->geometryUserPtr);
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        std::array<float, 3> box_low{kInfinity, kInfinity, kInfinity};
        std::array<float, 3> box_high{-kInfinity, -kInfinity, -kInfinity};  // empty boxes are left out
        if (of.uses(arguments->primID)) {
          for (const std::uint32_t v : of.mesh->triangles[arguments->primID]) {
            const Vec3 p = (of.mesh->positions[v] - of.middle) * of.scale;
            for (int axis = 0; axis < 3; ++axis) {
              const auto k = static_cast<std::size_t>(axis);
              box_low[k] = std::min(box_low[k], static_cast<float>(component(p, axis) - kWiden));
              box_high[k] = std::max(box_high[k], static_cast<float>(component(p, axis) + kWiden));
            }
          }
        }
        *arguments->bounds_o = {box_low[0],  box_low[1],  box_low[2],  0,
                                box_high[0], box_high[1], box_high[2], 0};
      },
      nullptr);
  rtcSetGeometryIntersectFunction(geometry, decide);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(s.scene, geometry, 0);
  rtcReleaseGeometry(geometry);
  // Isolated: while it waits for the build this thread must not take up another frame's task, which might
  // wait for it.
  oneapi::tbb::this_task_arena::isolate([&] { rtcCommitScene(s.scene); });
  if (rtcGetDeviceError(device.state().device) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree: could not build a tree of rays (out of memory?)");
  }
}

RayTree::~RayTree() = default;

RayHit RayTree::first_hit(const View& view, double x_px, double y_px) const {
  const Scene& s = *scene_;
  Walk walk{};
  walk.best = RayHit{};
  if (s.empty) return walk.best;
  walk.mesh = s.mesh;
  walk.view = &view;
  walk.x = view.ray_x(x_px);
  walk.y = view.ray_y(y_px);
  const Vec3 origin = (view.position - s.middle) * s.scale;
  const Vec3 way = (view.forward + view.right * walk.x + view.up * walk.y) * s.scale;
  // Enter the box [−2, 2]³ in double: a camera far away would cost the float ray its precision.
  double enter = 0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double o = component(origin, axis);
    const double w = component(way, axis);
    if (w == 0) {
      if (std::fabs(o) > 2) return walk.best;
      continue;
    }
    const double t0 = (-2 - o) / w;
    const double t1 = (2 - o) / w;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (!(enter <= leave)) return walk.best;
  walk.start_depth = enter;
  walk.units_a_depth = length(way);
  const Vec3 start = origin + way * enter;
  const Vec3 unit = way * (1 / walk.units_a_depth);

  rtcInitIntersectContext(&walk.context);
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start.x);
  ray.ray.org_y = static_cast<float>(start.y);
  ray.ray.org_z = static_cast<float>(start.z);
  ray.ray.dir_x = static_cast<float>(unit.x);
  ray.ray.dir_y = static_cast<float>(unit.y);
  ray.ray.dir_z = static_cast<float>(unit.z);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = 0xffffffffu;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  const KeepControlRegister keep;
  rtcIntersect1(s.scene, &walk.context, &ray);
  return walk.best;
}

}  // namespace plumbline::oracle
