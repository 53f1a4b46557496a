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

std::optional<Surface> sound_frame_of(const std::string& id, Random& random) {
  constexpr int kSide = 33;
  Surface surface = frame_of(id, kSide, random);
  if (!oracle::check_conformity(surface.mesh, surface.domain).clean()) return std::nullopt;
  return surface;
}

/// Methods whose frames make up the clean meshes: those that promise soundness and keep it (docs/claims.md).
constexpr std::array<std::string_view, 6> kCleanMethods{
    "full", "full:alternating", "greedy_tin", "restricted_quadtree", "haar_quadtree", "ring_tin:guarded"};

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
        all.push_back({id, [id](Random& r) { return sound_frame_of(id, r); }});
      }
    }
    return all;
  }();
  return list;
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
