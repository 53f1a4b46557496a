// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Faults between the two sides of an edge: refinement that one side did not hear of, patches out of date.
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "properties/faults/planting.h"

namespace plumbline::faults {

using oracle::FindingCode;

namespace {

/// The T-vertex `v` on the edge between `a` and `b` of triangle `host`.
void expect_t_vertex(const Planting& p, std::uint32_t v, std::uint32_t a, std::uint32_t b,
                     std::uint32_t host) {
  const auto& at_vertex = p.mesh().positions;
  const bool flat = oracle::height_gap(at_vertex[a], at_vertex[b], at_vertex[v]).sign == 0;
  p.expect(flat ? FindingCode::t_junction : FindingCode::crack, "t_vertex", {v, a, b}, {host});
}

/// Cuts ears off a simple counter-clockwise polygon. False if it has no triangulation into counter-clockwise
/// ears that starts with a lowest-numbered ear each time (collinear corners can stand in the way).
bool cut_ears(const Planting& p, std::vector<std::uint32_t> polygon,
              std::vector<std::array<std::uint32_t, 3>>& ears) {
  while (polygon.size() >= 3) {
    bool cut = false;
    for (std::size_t i = 0; i < polygon.size() && !cut; ++i) {
      const std::uint32_t a = polygon[(i + polygon.size() - 1) % polygon.size()], b = polygon[i];
      const std::uint32_t c = polygon[(i + 1) % polygon.size()];
      if (p.turn(a, b, c) <= 0) continue;
      bool empty = true;
      for (const std::uint32_t v : polygon) {
        if (v == a || v == b || v == c) continue;
        empty &= !(p.turn(a, b, v) >= 0 && p.turn(b, c, v) >= 0 && p.turn(c, a, v) >= 0);
      }
      if (!empty) continue;
      ears.push_back({a, b, c});
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
      cut = true;
    }
    if (!cut) return false;
  }
  return true;
}

}  // namespace

bool split_edge(const Planting& p, SplitHeight height) {
  const std::uint32_t t = p.any_triangle();
  const int k = p.any_corner();
  const auto corners = p.sound.triangles[t];
  const std::uint32_t a = corners[at(k)], b = corners[at(k + 1)], c = corners[at(k + 2)];
  const std::uint32_t other = p.sites.beyond(t, k);
  if (other == kNobody || !p.sites.alone(a) || !p.sites.alone(b)) return false;
  const Vec3 pa = p.sound.positions[a], pb = p.sound.positions[b];
  Vec3 middle{pa.x + (pb.x - pa.x) * 0.5, pa.y + (pb.y - pa.y) * 0.5, pa.z + (pb.z - pa.z) * 0.5};
  if (!oracle::inside_segment({pa.x, pa.y}, {pb.x, pb.y}, {middle.x, middle.y})) return false;
  if (height == SplitHeight::ulp)
    middle.z = std::nextafter(middle.z, std::numeric_limits<double>::infinity());
  if (height == SplitHeight::metre) middle.z += p.random.below(2) == 0 ? 1 : -1;
  if ((oracle::height_gap(pa, pb, middle).sign == 0) != (height == SplitHeight::flat)) return false;
  const std::uint32_t v = p.add_vertex(middle);
  p.mesh().triangles[t] = {a, v, c};
  p.add_triangle(v, b, c);
  const bool sound_halves = p.turn(a, v, c) > 0 && p.turn(v, b, c) > 0;
  expect_t_vertex(p, v, a, b, other);
  return sound_halves;
}

bool coarsen_one_side(const Planting& p) {
  const std::uint32_t v = p.any_vertex();
  if (!p.sites.alone(v) || !p.sites.interior(v)) return false;
  const auto link = p.sites.link(v);
  for (const auto& [c, unused_c] : link) {
    for (const auto& [a, unused_a] : link) {
      if (!p.sites.alone(a) || !p.sites.alone(c)) continue;
      if (!oracle::inside_segment(p.plan(a), p.plan(c), p.plan(v))) continue;
      // Round the link from c to a: the side to the left of a → c.
      std::vector<std::uint32_t> polygon{c};
      while (polygon.back() != a) polygon.push_back(link.at(polygon.back()));
      std::vector<std::array<std::uint32_t, 3>> ears;
      if (polygon.size() < 3 || !cut_ears(p, polygon, ears)) continue;
      std::vector<std::array<std::uint32_t, 3>> kept;
      const std::set<std::uint32_t> side(polygon.begin(), polygon.end());
      for (const auto& corners : p.sound.triangles) {
        bool of_fan = false;
        for (int k = 0; k < 3; ++k) {
          of_fan |= corners[at(k)] == v && corners[at(k + 1)] != a && side.contains(corners[at(k + 1)]) &&
                    corners[at(k + 2)] != c && side.contains(corners[at(k + 2)]);
        }
        if (!of_fan) kept.push_back(corners);
      }
      p.mesh().triangles = std::move(kept);
      std::uint32_t host = kNobody;
      for (const auto& ear : ears) {
        const std::uint32_t t = p.add_triangle(ear[0], ear[1], ear[2]);
        for (int k = 0; k < 3; ++k) {
          if (ear[at(k)] == a && ear[at(k + 1)] == c) host = t;
        }
      }
      if (host == kNobody) return false;
      expect_t_vertex(p, v, a, c, host);
      return true;
    }
  }
  return false;
}

bool cut_patch(const Planting& p, bool stale) {
  const Vec3 one = p.sound.positions[p.any_vertex()], two = p.sound.positions[p.any_vertex()];
  std::set<std::uint32_t> patch;
  for (std::uint32_t t = 0; t < p.sound.triangles.size(); ++t) {
    const auto& c = p.sound.triangles[t];
    const Vec3 sum = p.sound.positions[c[0]] + p.sound.positions[c[1]] + p.sound.positions[c[2]];
    const double x = sum.x / 3, y = sum.y / 3;
    if (x > std::fmin(one.x, two.x) && x < std::fmax(one.x, two.x) && y > std::fmin(one.y, two.y) &&
        y < std::fmax(one.y, two.y)) {
      patch.insert(t);
    }
  }
  const double shift_m = stale ? p.random.between(0.25, 2) : 0;
  std::map<std::uint32_t, std::uint32_t> copies;
  for (const std::uint32_t t : patch) {
    for (std::uint32_t& c : p.mesh().triangles[t]) {
      if (!copies.contains(c)) {
        Vec3 moved = p.sound.positions[c];
        moved.z += shift_m;
        if (stale && moved.z == p.sound.positions[c].z) return false;
        const auto& star = p.sites.star(c);
        bool shared = false;
        for (const std::uint32_t near : star) shared |= !patch.contains(near);
        if (shared) {
          copies[c] = p.add_vertex(moved);
        } else {
          p.mesh().positions[c] = moved;
          copies[c] = c;
        }
      }
      c = copies.at(c);
    }
  }
  bool cut = false;
  for (const std::uint32_t t : patch) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t other = p.sites.beyond(t, k);
      if (other == kNobody || patch.contains(other)) continue;
      cut = true;
      const auto& c = p.mesh().triangles[t];
      if (stale) p.expect(FindingCode::crack, "height_mismatch", {c[at(k)], c[at(k + 1)]}, {t, other});
    }
  }
  return cut;
}

}  // namespace plumbline::faults
