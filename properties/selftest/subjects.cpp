// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/selftest/subjects.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "algorithms/registry.h"
#include "oracle/conformity.h"
#include "oracle/likeness.h"
#include "oracle/soundness.h"
#include "properties/faults/faults.h"
#include "scenarios/camera.h"

namespace plumbline::selftest {
namespace {

using faults::Surface;

/// Rough ground, gently rough ground, or a bowl: on the first some published methods never are sound.
Terrain any_ground(int side, Random& random) {
  constexpr double kSpacing_m = 10, kRough_m = 12, kGentle_m = 2;
  const std::uint64_t which = random.below(3);
  Terrain terrain = faults::random_terrain(side, kSpacing_m, which == 0 ? kRough_m : kGentle_m, random);
  if (which < 2) return terrain;
  const int east = static_cast<int>(random.below(static_cast<std::uint64_t>(side))),
            north = static_cast<int>(random.below(static_cast<std::uint64_t>(side)));
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i)
      terrain.heights_m[terrain.index(i, j)] = ((i - east) * (i - east) + (j - north) * (j - north)) / 8.0;
  }
  return terrain;
}

/// A frame of a method over some ground from a random camera.
Surface frame_of(const std::string& id, int side, Random& random) {
  const Terrain terrain = any_ground(side, random);
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

/// The mesh's own outline: its border, walked. Nothing if the border touches itself.
std::optional<PlanDomain> own_outline(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(t[k], t[(k + 1) % 3]);
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from}) && !next.emplace(from, to).second) return std::nullopt;
  }
  PlanDomain domain;
  while (!next.empty()) {
    domain.loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      domain.loops.back().push_back({mesh.positions[at->first].x, mesh.positions[at->first].y});
      const std::uint32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return domain;
}

/// Of the other methods only sound frames: what a published method leaves unsound is no fault of an oracle.
/// One that only falls short of what it promises to cover is held to what it covers.
std::optional<Surface> usable_frame_of(const std::string& id, Random& random) {
  constexpr int kSide = 33;
  Surface surface = frame_of(id, kSide, random);
  if (std::find(kCleanMethods.begin(), kCleanMethods.end(), id) != kCleanMethods.end()) return surface;
  oracle::ConformityCounts counts = oracle::check_conformity(surface.mesh, surface.domain).counts;
  if (counts.outline > 0) {
    const std::optional<PlanDomain> outline = own_outline(surface.mesh);
    if (!outline || surface.mesh.triangles.empty()) return std::nullopt;
    surface.domain = *outline;
    counts = oracle::check_conformity(surface.mesh, surface.domain).counts;
  }
  if (counts.total() > 0) return std::nullopt;
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
    for (const MethodDescription& method : built_in_methods()) {
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
    for (const MethodDescription& method : built_in_methods()) {
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
  // No place for a fault: a mesh that was simplified away, and one that has a fault already. No method
  // promises that its triangles never pierce each other, and about one in two hundred of these does.
  constexpr std::size_t kLeastTriangles = 40;
  if (frame.mesh.triangles.size() < kLeastTriangles || !oracle::check_soundness(frame.mesh).clean())
    return mesh;
  const auto pairs = oracle::self_intersections(frame.mesh);
  return pairs && pairs->empty() ? frame.mesh : mesh;
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
