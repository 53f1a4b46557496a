// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/mesh_source.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/instrument.h"
#include "scenarios/mesh_file/mesh_file.h"
#include "scenarios/nearest.h"

namespace plumbline {
namespace {

struct Ball {
  Vec3 center;
  double radius_m = 0;
};

/// Around the middle of the box of all corners of triangles.
Ball ball_around(const Mesh& mesh) {
  Vec3 low = mesh.positions[mesh.triangles.front()[0]], high = low;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      const Vec3& p = mesh.positions[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  Ball ball{(low + high) * 0.5, 0};
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle)
      ball.radius_m = std::max(ball.radius_m, length(mesh.positions[v] - ball.center));
  }
  return ball;
}

Mesh read_mesh(const MeshSource& source) {
  if (!source.file.empty()) {
    Mesh mesh = triangulate(read_mesh_file(source.file));
    // glTF doubles vertices along every crease; as read, nothing would be closed.
    const std::string suffix = source.file.extension().string();
    if (source.cut_to_manifold || suffix == ".glb" || suffix == ".gltf") mesh = welded(mesh);
    return source.cut_to_manifold ? cut_to_manifold(mesh) : mesh;
  }
  std::vector<std::string> names;
  for (const MeshGenerator& known : mesh_generators()) {
    if (known.name == source.generator) return known.make();
    names.push_back(known.name);
  }
  throw InputError(unknown_name("generator", source.generator, names));
}

bool in_reach(Vec3 p) {
  return std::fabs(p.x) <= kFarthestM && std::fabs(p.y) <= kFarthestM && std::fabs(p.z) <= kFarthestM;
}

}  // namespace

ObjectScene load_objects(const MeshSource& source) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("mesh '{}': {}", source.id, what));
  };
  Mesh mesh;
  try {
    mesh = read_mesh(source);
  } catch (const InputError& error) {
    refuse(error.what());
  }
  if (mesh.triangles.empty()) refuse("has no triangle; give a mesh with some");
  std::vector<Vec3> places = source.at;
  if (places.empty()) places.emplace_back();
  if (places.size() > kMostCopies || mesh.triangles.size() > kMostTriangles / places.size()) {
    refuse(fmt::format("{} triangles in {} places; keep to {} in {}", mesh.triangles.size(), places.size(),
                       kMostTriangles, kMostCopies));
  }

  ObjectScene scene;
  scene.id = source.id;
  for (const Vec3& place : places) {
    Mesh& object = scene.objects.emplace_back(mesh);
    for (std::size_t v = 0; v < object.positions.size(); ++v) {
      Vec3& p = object.positions[v];
      p = p * source.scale + place;
      if (!in_reach(p)) {
        refuse(fmt::format("vertex {} would stand at ({}, {}, {}) m; keep to {} m", v, p.x, p.y, p.z,
                           kFarthestM));
      }
    }
    const auto base = static_cast<std::uint32_t>(scene.whole.positions.size());
    scene.whole.positions.insert(scene.whole.positions.end(), object.positions.begin(),
                                 object.positions.end());
    for (const auto& [a, b, c] : object.triangles) {
      if (std::max({a, b, c}) >= object.positions.size())
        refuse(fmt::format("a triangle names vertex {} of {}", std::max({a, b, c}), object.positions.size()));
      scene.whole.triangles.push_back({base + a, base + b, base + c});
    }
  }
  for (const Mesh& object : scene.objects) scene.centers.push_back(ball_around(object).center);
  scene.object_radius_m = ball_around(scene.objects.front()).radius_m;
  if (!(scene.object_radius_m > 0)) refuse("all its vertices are one point; give a mesh with an extent");
  const Ball ball = ball_around(scene.whole);
  scene.center = ball.center;
  scene.radius_m = std::max(ball.radius_m, scene.object_radius_m);
  return scene;
}

const std::vector<MeshGenerator>& mesh_generators() {
  static const std::vector<MeshGenerator> all{
      {"instrument", "a measuring instrument of 86 802 triangles, 2 m wide, its front towards -y",
       instrument_mesh},
  };
  return all;
}

}  // namespace plumbline
