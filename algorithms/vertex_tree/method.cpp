// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/vertex_tree/method.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/mutant.h"

namespace plumbline::vertex_tree {

double screen_size_px(const Camera& camera, Vec3 center, double radius_m) {
  const Vec3 to = center - camera.position;
  const double free2 = dot(to, to) - radius_m * radius_m;
  if (PLUMBLINE_MUTANT(m5_distance_squared)) return 2 * camera.kappa_px * radius_m / std::max(free2, 1.0);
  if (!(free2 > 0)) return std::numeric_limits<double>::infinity();
  return 2 * camera.kappa_px * radius_m / std::sqrt(free2);
}

std::size_t ladder_triangles(double size_px, double scale, std::size_t full) {
  static constexpr std::array<std::pair<double, std::size_t>, 5> kRungs{
      {{300, 100}, {250, 80}, {200, 60}, {150, 40}, {100, 20}}};
  for (const auto& [rung_px, percent] : kRungs) {
    if (size_px > rung_px * (PLUMBLINE_MUTANT(m5_threshold_ignored) ? 1 : scale)) return full * percent / 100;
  }
  return full / 10;
}

bool may_be_contour(const VertexTree& tree, std::uint32_t p, Vec3 eye) {
  const NormalCone& cone = tree.cones[p - tree.originals];
  const Vec3 to = tree.positions[p] - eye;
  const double distance = length(to);
  if (!(distance > tree.radii_m[p]) || cone.cos_half <= 0) return true;
  const double sin_view = tree.radii_m[p] / distance;
  const double cos_view = std::sqrt(std::max(0.0, 1 - sin_view * sin_view));
  const double sin_half = std::sqrt(std::max(0.0, 1 - cone.cos_half * cone.cos_half));
  // The axes stand within (half angle + view's half angle) of a right angle.
  if (cone.cos_half * cos_view - sin_half * sin_view <= 0) return true;  // that sum reaches 90 degrees
  if (PLUMBLINE_MUTANT(m5_contour_inverted)) {
    return std::fabs(dot(cone.axis, to)) > (sin_half * cos_view + cone.cos_half * sin_view) * distance;
  }
  return std::fabs(dot(cone.axis, to)) <= (sin_half * cos_view + cone.cos_half * sin_view) * distance;
}

void Object::update(const Camera& camera, double scale, Counters& counters) {
  const VertexTree& tree = cut_.tree();
  counters.nodes += tree.nodes();
  if (camera.outside_view_cone(tree.center, tree.radius_m)) return;
  ++counters.evaluated;
  const std::size_t target =
      ladder_triangles(screen_size_px(camera, tree.center, tree.radius_m), scale, tree.triangles.size());
  const auto contour = [&](std::uint32_t p) {
    ++counters.visited;
    return may_be_contour(tree, p, camera.position);
  };
  if (contour_ == ContourRule::restore) {
    // A split's made children may be contour nodes themselves: they have lesser identifiers.
    for (auto p = static_cast<std::uint32_t>(tree.nodes()); p-- > tree.originals;) {
      if (cut_.present(p) && contour(p)) counters.split += cut_.force_split(p);
    }
  }
  if (contour_ == ContourRule::none) {
    counters.merged += cut_.coarsen(target);
  } else {
    counters.merged += cut_.coarsen(target, contour);
  }
  // Where nodes were held, the last collapse may have taken two triangles where one was left to take, and an
  // earlier one may be undone within the target: now, or the next frame would.
  if (!PLUMBLINE_MUTANT(m5_refine_forgotten)) counters.split += cut_.refine(target);
}

void VertexTreeMethod::prepare(const Terrain& terrain) {
  // The border keeps its four lines, so that the promised plan region stays covered; corners stay.
  std::vector<std::uint8_t> lines(terrain.heights_m.size(), 0);
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const int line = (i == 0 ? 1 : 0) + (i == terrain.columns - 1 ? 2 : 0) + (j == 0 ? 4 : 0) +
                       (j == terrain.rows - 1 ? 8 : 0);
      lines[terrain.index(i, j)] = static_cast<std::uint8_t>(line);
    }
  }
  trees_ = {std::make_shared<const VertexTree>(build_tree(reference_mesh(terrain), settings_.build, lines))};
  domain_ = full_domain(terrain);
  reset();
}

void VertexTreeMethod::prepare_objects(const std::vector<Mesh>& objects) {
  trees_.clear();
  for (const Mesh& mesh : objects)
    trees_.push_back(std::make_shared<const VertexTree>(build_tree(mesh, settings_.build)));
  domain_.clear();
  reset();
}

void VertexTreeMethod::reset() {
  if (PLUMBLINE_MUTANT(m5_reset_forgotten) && !objects_.empty()) return;
  objects_.clear();
  for (const auto& tree : trees_) objects_.emplace_back(tree, settings_.contour);
}

void VertexTreeMethod::update(const Camera& camera, LodFrame& frame) {
  frame.clear();
  frame.domain = domain_;
  Mesh part;
  std::vector<std::uint64_t> keys;
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    objects_[o].update(camera, threshold_px(), frame.counters);
    objects_[o].cut().extract(part, keys);
    const auto base = static_cast<std::uint32_t>(frame.mesh.positions.size());
    frame.mesh.positions.insert(frame.mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const auto& [a, b, c] : part.triangles)
      frame.mesh.triangles.push_back({base + a, base + b, base + c});
    for (const auto key : keys) frame.vertex_keys.push_back((std::uint64_t{o} << 32) + key);
  }
}

std::unique_ptr<LodMethod> VertexTreeMethod::clone() const {
  auto copy = std::make_unique<VertexTreeMethod>(*this);
  if (!PLUMBLINE_MUTANT(m5_clone_shares_state)) copy->reset();
  return copy;
}

}  // namespace plumbline::vertex_tree
