// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "algorithms/mutant.h"
#include "algorithms/vertex_tree/stars.h"
#include "algorithms/vertex_tree/vertex_tree.h"
#include "scenarios/error.h"
#include "scenarios/portable_math.h"

namespace plumbline::vertex_tree {
namespace {

constexpr double kSqrt3 = 1.7320508075688772;

/// A candidate edge; the shortest first, equal ones by identifiers, so that the order is the mesh's alone.
struct Candidate {
  double length2;
  std::uint32_t low, high;
  friend bool operator<(const Candidate& a, const Candidate& b) {  // priority_queue keeps the greatest on top
    return std::tie(b.length2, b.low, b.high) < std::tie(a.length2, a.low, a.high);
  }
};

/// The cone around the axis that holds directions up to (angle to `other.axis`) + (other's half angle).
double cos_reaching(Vec3 axis, const NormalCone& other) {
  const double c = dot(axis, other.axis);
  const double s = std::sqrt(std::max(0.0, 1 - c * c));
  const double sin_half = std::sqrt(std::max(0.0, 1 - other.cos_half * other.cos_half));
  if (c <= -other.cos_half) return -1;  // the angles' sum reaches 180 degrees
  return std::max(-1.0, c * other.cos_half - s * sin_half);
}

class Builder {
 public:
  Builder(const Mesh& mesh, const BuildSettings& settings, const std::vector<std::uint8_t>& lines)
      : settings_(settings), now_(mesh.triangles), live_(mesh.triangles.size()) {
    const std::size_t n = mesh.positions.size();
    tree_.originals = n;
    tree_.positions = mesh.positions;
    tree_.triangles = mesh.triangles;
    tree_.parent.assign(n, kNone);
    tree_.radii_m.assign(n, 0.0);
    lines_ = lines.empty() ? std::vector<std::uint8_t>(n, 0) : lines;
    const double cos_limit = exact_cos(settings.normal_angle_deg * kRadiansPerDegree);
    cos_limit_ = cos_limit;
    stars_.resize(n);
    for (std::uint32_t t = 0; t < now_.size(); ++t) {
      for (const auto v : now_[t]) stars_[v].push_back(t);
    }
    refused_.resize(n);
    mark_.assign(n, 0);
    find_borders();
    leaf_cones();
  }

  VertexTree run() {
    for (const auto& t : now_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = t[k], b = t[(k + 1) % 3];
        // An inner edge comes once from each side; its border-less half is enough.
        if (a < b || (border_[a] && border_[b] && shared(a, b) == 1)) push(a, b);
      }
    }
    while (!queue_.empty() && live_ > settings_.least_triangles) {
      const auto [length2, a, b] = queue_.top();
      queue_.pop();
      if (tree_.parent[a] != kNone || tree_.parent[b] != kNone) continue;
      Vec3 p = (tree_.positions[a] + tree_.positions[b]) * 0.5;
      if (PLUMBLINE_MUTANT(m5_stale_height)) p.z = tree_.positions[a].z;
      if (safe(a, b, p)) {
        collapse(a, b, p);
      } else {
        refused_[a].push_back(b);
        refused_[b].push_back(a);
      }
    }
    whole_ball();
    return std::move(tree_);
  }

 private:
  void push(std::uint32_t a, std::uint32_t b) {
    const Vec3 d = tree_.positions[a] - tree_.positions[b];
    queue_.push({dot(d, d), std::min(a, b), std::max(a, b)});
  }

  std::size_t shared(std::uint32_t a, std::uint32_t b) const {
    std::size_t count = 0;
    for (const auto t : stars_[a]) count += has_corner(now_[t], b) ? 1 : 0;
    return count;
  }

  // A vertex is on the border iff some neighbour leaves its fan without another entering.
  void find_borders() {
    border_.assign(stars_.size(), 0);
    for (std::uint32_t v = 0; v < stars_.size(); ++v) {
      for (const auto t : stars_[v]) {
        const auto [from, to] = others(now_[t], v);
        mark_[from] ^= 1;
        mark_[to] ^= 1;
      }
      for (const auto t : stars_[v]) {
        for (const auto u : others(now_[t], v)) {
          if (mark_[u] == 1) border_[v] = 1;
        }
      }
      for (const auto t : stars_[v]) {
        for (const auto u : others(now_[t], v)) mark_[u] = 0;
      }
    }
  }

  void leaf_cones() {
    cones_.resize(stars_.size());
    for (std::uint32_t v = 0; v < stars_.size(); ++v) cones_[v] = cone_of(v, nullptr, nullptr);
  }

  NormalCone cone_of(std::uint32_t v, const NormalCone* a, const NormalCone* b) const {
    Vec3 sum{};
    for (const auto t : stars_[v]) sum = sum + normal(now_[t]);
    const double size = length(sum);
    if (!(size > 0)) return {{0, 0, 1}, -1};
    NormalCone cone{sum * (1 / size), 1};
    for (const auto t : stars_[v]) {
      const Vec3 n = normal(now_[t]);
      const double l = length(n);
      if (l > 0) cone.cos_half = std::min(cone.cos_half, dot(cone.axis, n) / l);
    }
    for (const auto* child : {a, b}) {
      if (PLUMBLINE_MUTANT(m5_cone_without_children)) break;
      if (child != nullptr) cone.cos_half = std::min(cone.cos_half, cos_reaching(cone.axis, *child));
    }
    return cone;
  }

  Vec3 normal(const std::array<std::uint32_t, 3>& t) const {
    const Vec3 p = tree_.positions[t[0]];
    return cross(tree_.positions[t[1]] - p, tree_.positions[t[2]] - p);
  }

  // Link condition (Dey et al.), the border closed by one more vertex: the mesh stays manifold.
  bool keeps_manifold(std::uint32_t a, std::uint32_t b) {
    std::array<std::uint32_t, 2> tips{kNone, kNone};
    std::size_t both = 0;
    for (const auto t : stars_[a]) {
      const auto [u, w] = others(now_[t], a);
      if (u == b || w == b) {
        if (both < 2) tips[both] = u == b ? w : u;
        ++both;
      }
    }
    if (both == 0 || both > 2) return false;
    if (both == 2 && border_[a] && border_[b]) return false;
    if (both == 1 && stars_[a].size() == 1 && stars_[b].size() == 1) return false;
    for (const auto t : stars_[a]) {
      for (const auto u : others(now_[t], a)) mark_[u] = 1;
    }
    std::size_t common = 0;
    bool lid = false;  // a tip-tip edge seen from both a and b
    for (const auto t : stars_[b]) {
      const auto pair = others(now_[t], b);
      for (const auto u : pair) {
        if (u != a && mark_[u] == 1) {
          mark_[u] = 2;
          ++common;
        }
      }
      if (both == 2 && (pair == tips || (pair[0] == tips[1] && pair[1] == tips[0]))) lid = true;
    }
    for (const auto t : stars_[a]) {
      for (const auto u : others(now_[t], a)) mark_[u] = 0;
    }
    return common == both && !lid;
  }

  bool keeps_shape(std::uint32_t v, std::uint32_t other, Vec3 p) const {
    for (const auto t : stars_[v]) {
      if (has_corner(now_[t], other)) continue;
      const auto [u, w] = others(now_[t], v);
      const Vec3 pu = tree_.positions[u], pw = tree_.positions[w], pv = tree_.positions[v];
      const Vec3 before = cross(pu - pv, pw - pv), after = cross(pu - p, pw - p);
      const double area2 = length(after);
      const double sides = dot(pu - p, pu - p) + dot(pw - p, pw - p) + dot(pu - pw, pu - pw);
      if (!(2 * kSqrt3 * area2 > settings_.least_quality * sides) &&
          !PLUMBLINE_MUTANT(m5_quality_limit_dropped)) {
        return false;
      }
      // A triangle without area has no normal to turn.
      const double was = length(before);
      if (PLUMBLINE_MUTANT(m5_normal_limit_dropped)) continue;
      if (was > 0 && !(dot(before, after) > cos_limit_ * was * area2)) return false;
    }
    return true;
  }

  bool safe(std::uint32_t a, std::uint32_t b, Vec3 p) {
    if (lines_[a] != lines_[b] && !PLUMBLINE_MUTANT(m5_border_lines_forgotten)) return false;
    return keeps_shape(a, b, p) && keeps_shape(b, a, p) && keeps_manifold(a, b);
  }

  void collapse(std::uint32_t a, std::uint32_t b, Vec3 position) {
    const auto p = static_cast<std::uint32_t>(tree_.positions.size());
    tree_.positions.push_back(position);
    tree_.parent.push_back(kNone);
    tree_.parent[a] = tree_.parent[b] = p;
    tree_.children.push_back({a, b});
    std::array<std::uint32_t, 2> gone{kNone, kNone};
    std::size_t count = 0;
    std::vector<std::uint32_t> star;
    star.reserve(stars_[a].size() + stars_[b].size());
    for (const auto t : stars_[a]) {
      if (has_corner(now_[t], b)) {
        gone[count++] = t;
        for (const auto c : now_[t]) {
          if (c != a && c != b) take_out(stars_[c], t);
        }
      } else {
        replace_corner(now_[t], a, p);
        star.push_back(t);
      }
    }
    for (const auto t : stars_[b]) {
      if (t == gone[0] || t == gone[1]) continue;
      replace_corner(now_[t], b, p);
      star.push_back(t);
    }
    live_ -= count;
    tree_.removed.push_back(gone);
    double radius = std::max(tree_.radii_m[a] + length(tree_.positions[a] - position),
                             tree_.radii_m[b] + length(tree_.positions[b] - position));
    stars_[a] = {};
    stars_[b] = {};
    stars_.push_back(std::move(star));
    border_.push_back(border_[a] | border_[b]);
    lines_.push_back(lines_[a]);
    mark_.push_back(0);
    refused_[a] = {};
    refused_[b] = {};
    refused_.emplace_back();
    // Price the edges at p; edges of its ring that were refused may be safe now.
    ring_.clear();
    for (const auto t : stars_[p]) {
      for (const auto c : others(now_[t], p)) {
        if (mark_[c] == 0) ring_.push_back(c);
        mark_[c] = 1;
      }
    }
    for (const auto c : ring_) {
      mark_[c] = 0;
      push(p, c);
      if (!PLUMBLINE_MUTANT(m5_ball_without_ring)) {
        radius = std::max(radius, length(tree_.positions[c] - position));
      }
      for (const auto other : refused_[c]) {
        if (tree_.parent[other] != kNone) continue;
        auto& back = refused_[other];
        const auto at = std::find(back.begin(), back.end(), c);
        if (at != back.end()) back.erase(at);
        push(c, other);
      }
      refused_[c].clear();
    }
    tree_.radii_m.push_back(radius);
    const NormalCone cone = cone_of(p, &cones_[a], &cones_[b]);
    cones_.push_back(cone);
    tree_.cones.push_back(cone);
  }

  void whole_ball() {
    Vec3 low = tree_.positions[tree_.triangles[0][0]], high = low;
    for (const auto& t : tree_.triangles) {
      for (const auto v : t) {
        const Vec3 p = tree_.positions[v];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
    tree_.center = (low + high) * 0.5;
    for (const auto& t : tree_.triangles) {
      for (const auto v : t)
        tree_.radius_m = std::max(tree_.radius_m, length(tree_.positions[v] - tree_.center));
    }
  }

  BuildSettings settings_;
  double cos_limit_ = 0;
  VertexTree tree_;
  std::vector<std::array<std::uint32_t, 3>> now_;    // the triangles' present corners
  std::vector<std::vector<std::uint32_t>> stars_;    // CAT while building
  std::vector<std::vector<std::uint32_t>> refused_;  // far ends of edges that were not safe when tried
  std::vector<std::uint8_t> border_, lines_, mark_;
  std::vector<NormalCone> cones_;
  std::vector<std::uint32_t> ring_;
  std::priority_queue<Candidate> queue_;
  std::size_t live_;
};

}  // namespace

double quality(Vec3 a, Vec3 b, Vec3 c) {
  const double sides = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
  return sides > 0 ? 2 * kSqrt3 * length(cross(b - a, c - a)) / sides : 0;
}

VertexTree build_tree(const Mesh& mesh, const BuildSettings& settings,
                      const std::vector<std::uint8_t>& lines) {
  if (!(settings.normal_angle_deg > 0 && settings.normal_angle_deg <= 180))
    throw InputError(
        fmt::format("vertex_tree: normal_angle_deg = {} is not inside (0, 180]", settings.normal_angle_deg));
  if (!(settings.least_quality >= 0 && settings.least_quality < 1))
    throw InputError(
        fmt::format("vertex_tree: least_quality = {} is not inside [0, 1)", settings.least_quality));
  if (mesh.positions.size() > kNone / 2)
    throw InputError(
        fmt::format("mesh has {} vertices; vertex_tree takes {}", mesh.positions.size(), kNone / 2));
  require_manifold(mesh);
  return Builder(mesh, settings, lines).run();
}

}  // namespace plumbline::vertex_tree
