// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/selftest/subjects.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "algorithms/registry.h"
#include "oracle/conformity.h"
#include "properties/faults/faults.h"
#include "scenarios/camera.h"

namespace plumbline::selftest {
namespace {

using faults::Surface;

/// A frame of a method over rough ground from a random camera.
Surface frame_of(const std::string& id, int side, Random& random) {
  constexpr double kSpacing_m = 10, kRelief_m = 12;
  const Terrain terrain = faults::random_terrain(side, kSpacing_m, kRelief_m, random);
  const auto method = make_method(id);
  method->prepare(terrain);
  method->set_threshold_px(random.between(2, 40));
  const double width_m = terrain.width_m();
  const Vec3 eye{random.between(0, width_m), random.between(0, width_m), random.between(20, 200)};
  LodFrame frame;
  method->update(make_camera(eye, {width_m / 2 + 0.5, width_m / 2 + 0.5, 0}, 60, 320, 200), frame);
  return {frame.mesh, frame.domain};
}

/// Methods whose frames count as clean meshes: those that promise soundness and keep it (docs/claims.md).
/// Whatever is found on them is a false alarm.
constexpr std::array<std::string_view, 7> kCleanMethods{"full",
                                                        "full:alternating",
                                                        "greedy_tin",
                                                        "ring_tin:guarded",
                                                        "restricted_quadtree",
                                                        "block_bintree:repaired",
                                                        "isolated_quadtree:repaired"};

/// Of the other methods only sound frames: what a published method leaves unsound is no fault of an oracle.
std::optional<Surface> usable_frame_of(const std::string& id, Random& random) {
  constexpr int kSide = 33;
  Surface surface = frame_of(id, kSide, random);
  const bool promised = std::find(kCleanMethods.begin(), kCleanMethods.end(), id) != kCleanMethods.end();
  if (!promised && !oracle::check_conformity(surface.mesh, surface.domain).clean()) return std::nullopt;
  return surface;
}

}  // namespace

const std::vector<Subject>& fault_subjects() {
  static const std::vector<Subject> list = [] {
    std::vector<Subject> all{
        {"a grid", [](Random& r) { return faults::random_grid(4 + static_cast<int>(r.below(8)), r); }},
        {"a grid in random order",
         [](Random& r) {
           return faults::shuffled(faults::random_grid(4 + static_cast<int>(r.below(8)), r), r);
         }},
        {"bisected triangles", [](Random& r) { return faults::random_bintree(4, r); }},
        {"a grid with a seam",
         [](Random& r) {
           Surface s = faults::random_grid(9, r);
           if (auto seam = faults::plant("block_seam", s.mesh, s.domain, r)) s.mesh = std::move(seam->mesh);
           return s;
         }},
    };
    for (const MethodDescription& method : registered_methods()) {
      for (const VariantDescription& variant : method.variants) {
        const std::string id = variant.name.empty() ? method.id : method.id + ":" + variant.name;
        all.push_back({id, [id](Random& r) { return usable_frame_of(id, r); }});
      }
    }
    return all;
  }();
  return list;
}

Mesh random_solid(Random& random) {
  Mesh mesh = faults::pebble(3 + static_cast<int>(random.below(4)), random.between(1, 20), random);
  static const std::vector<std::string> makers = [] {
    std::vector<std::string> ids{""};  // nobody's method
    for (const MethodDescription& method : registered_methods()) {
      if (method.takes_objects) ids.push_back(method.id);
    }
    return ids;
  }();
  const std::string& id = makers[random.below(makers.size())];
  if (id.empty()) return mesh;
  const auto method = make_method(id);
  method->prepare_objects({mesh});
  method->set_threshold_px(random.between(1, 60));
  LodFrame frame;
  method->update(make_camera({80, 10, 30}, {0, 0, 0}, 60, 320, 200), frame);
  // A mesh that was simplified away is no place for a fault.
  constexpr std::size_t kLeastTriangles = 40;
  return frame.mesh.triangles.size() < kLeastTriangles ? mesh : frame.mesh;
}

Surface clean_mesh(std::size_t number, Random& random) {
  constexpr std::size_t kOneMethodIn = 40;
  if (number % kOneMethodIn == 0) {
    const std::string_view id = kCleanMethods[number / kOneMethodIn % kCleanMethods.size()];
    return frame_of(std::string(id), 9, random);
  }
  const Surface surface = number % 2 == 0
                              ? faults::random_grid(2 + static_cast<int>(random.below(7)), random)
                              : faults::random_bintree(1 + static_cast<int>(random.below(3)), random);
  return random.below(2) == 0 ? surface : faults::shuffled(surface, random);
}

}  // namespace plumbline::selftest
