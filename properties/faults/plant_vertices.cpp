// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Faults that move, break or merge vertices.
#include <cmath>
#include <limits>
#include <set>

#include "properties/faults/planting.h"

namespace plumbline::faults {

using oracle::FindingCode;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double step_m(Step step) { return step == Step::millimetre ? 0.001 : 1.0; }

/// Is p strictly inside triangle t of the sound mesh?
bool strictly_inside(const Planting& p, std::uint32_t t, Vec2 point) {
  const auto& c = p.sound.triangles[t];
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = p.sound.positions[c[at(k)]], &b = p.sound.positions[c[at(k + 1)]];
    if (oracle::orientation({a.x, a.y}, {b.x, b.y}, point).value <= 0) return false;
  }
  return true;
}

}  // namespace

bool detach_upwards(const Planting& p, Step step) {
  const std::uint32_t t = p.any_triangle();
  const int k = p.any_corner();
  const auto corners = p.sound.triangles[t];
  const std::uint32_t v = corners[at(k)];
  if (p.sites.star(v).size() < 2) return false;  // the old vertex would be left unused
  Vec3 lifted = p.sound.positions[v];
  lifted.z = step == Step::ulp ? std::nextafter(lifted.z, kInfinity) : lifted.z + step_m(step);
  if (lifted.z == p.sound.positions[v].z) return false;
  const std::uint32_t copy = p.add_vertex(lifted);
  p.mesh().triangles[t][at(k)] = copy;
  for (const int edge : {k, k + 2}) {  // the edges of t that meet the corner
    const std::uint32_t other = p.sites.beyond(t, edge % 3);
    if (other == kNobody) continue;
    const std::uint32_t far_end = corners[at(edge == k ? k + 1 : k + 2)];
    p.expect(FindingCode::crack, "height_mismatch", {copy, far_end}, {t, other});
  }
  return !p.fault.expected.empty();
}

bool detach_inwards(const Planting& p, Step step) {
  const std::uint32_t t = p.any_triangle();
  const int k = p.any_corner();
  const auto corners = p.sound.triangles[t];
  const std::uint32_t v = corners[at(k)];
  if (p.sites.beyond(t, k) == kNobody || p.sites.beyond(t, (k + 2) % 3) == kNobody) return false;
  for (const std::uint32_t c : corners) {
    if (!p.sites.alone(c)) return false;
  }
  Vec3 moved = p.sound.positions[v];
  const Vec3 a = p.sound.positions[corners[at(k + 1)]], b = p.sound.positions[corners[at(k + 2)]];
  const Vec2 inwards{(a.x - moved.x) + (b.x - moved.x), (a.y - moved.y) + (b.y - moved.y)};
  if (step == Step::ulp) {
    const auto nudge = [](double from, double direction) {
      return direction == 0 ? from : std::nextafter(from, direction > 0 ? kInfinity : -kInfinity);
    };
    moved.x = nudge(moved.x, inwards.x);
    moved.y = nudge(moved.y, inwards.y);
  } else {
    const double length_m = std::sqrt(inwards.x * inwards.x + inwards.y * inwards.y);
    moved.x += inwards.x / length_m * step_m(step);
    moved.y += inwards.y / length_m * step_m(step);
  }
  if (!strictly_inside(p, t, {moved.x, moved.y})) return false;
  const std::uint32_t copy = p.add_vertex(moved);
  p.mesh().triangles[t][at(k)] = copy;
  p.expect(FindingCode::hole, "", {copy, v, corners[at(k + 1)], corners[at(k + 2)]}, {t});
  return true;
}

bool move_softly(const Planting& p) {
  const std::uint32_t v = p.any_vertex();
  if (!p.sites.alone(v) || !p.sites.interior(v)) return false;
  Vec3& moved = p.mesh().positions[v];
  const Vec3& towards = p.sound.positions[p.sites.link(v).begin()->first];
  const double share = p.random.between(0.05, 0.5);
  moved = moved + (towards - moved) * share;
  moved.x += p.random.between(-1, 1);
  return moved != p.sound.positions[v] && p.star_is_sound(v);
}

bool move_over_neighbour(const Planting& p) {
  const std::uint32_t v = p.any_vertex();
  if (!p.sites.alone(v) || !p.sites.interior(v)) return false;
  const auto link = p.sites.link(v);
  auto it = link.begin();
  std::advance(it, static_cast<std::ptrdiff_t>(p.random.below(link.size())));
  const Vec3 a = p.sound.positions[it->first], b = p.sound.positions[it->second];
  Vec3& moved = p.mesh().positions[v];
  const double over = p.random.between(1.1, 1.9);
  moved = moved + ((a + b) * 0.5 - moved) * over;
  for (const std::uint32_t t : p.sites.star(v)) {
    const auto& c = p.mesh().triangles[t];
    const int turn = p.turn(c[0], c[1], c[2]);
    if (turn == 0) return false;
    if (turn < 0) p.expect(FindingCode::fold_over, "folded", {v}, {t});
  }
  return !p.fault.expected.empty();
}

bool merge_vertices(const Planting& p) {
  const std::uint32_t t = p.any_triangle();
  const int k = p.any_corner();
  const std::uint32_t keep = p.sound.triangles[t][at(k)], gone = p.sound.triangles[t][at(k + 1)];
  const std::uint32_t other = p.sites.beyond(t, k);
  if (other == kNobody || !p.sites.alone(keep) || !p.sites.alone(gone) || !p.sites.interior(gone))
    return false;
  // More than two common neighbours would make a fin of what is left between them.
  std::set<std::uint32_t> around;
  for (const auto& [x, y] : p.sites.link(keep)) around.insert({x, y});
  std::size_t common = 0;
  for (const auto& [x, y] : p.sites.link(gone)) common += around.contains(x);
  if (common != 2) return false;
  for (auto& corners : p.mesh().triangles) {
    for (std::uint32_t& c : corners) {
      if (c == gone) c = keep;
    }
  }
  for (const std::uint32_t near : p.sites.star(gone)) {
    const auto& c = p.mesh().triangles[near];
    if (near != t && near != other && p.turn(c[0], c[1], c[2]) <= 0) return false;
  }
  p.mesh().positions.erase(p.mesh().positions.begin() + gone);
  for (auto& corners : p.mesh().triangles) {
    for (std::uint32_t& c : corners) c -= c > gone;
  }
  for (const std::uint32_t flat : {t, other}) p.expect(FindingCode::degenerate, "repeated_index", {}, {flat});
  return true;
}

bool break_vertex(const Planting& p) {
  const std::uint32_t v = p.any_vertex();
  if (p.sites.star(v).empty()) return false;
  constexpr double kBroken[] = {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity};
  Vec3& vertex = p.mesh().positions[v];
  (p.random.below(2) == 0   ? vertex.z
   : p.random.below(2) == 0 ? vertex.x
                            : vertex.y) = kBroken[p.random.below(3)];
  p.expect(FindingCode::non_finite, "", {v}, p.sites.star(v));
  return true;
}

bool leave_vertex(const Planting& p) {
  const Vec3 beside = p.sound.positions[p.any_vertex()];
  const std::uint32_t v = p.add_vertex({beside.x, beside.y, beside.z + p.random.between(-1, 1)});
  p.expect(FindingCode::unused_vertex, "", {v}, {});
  return true;
}

bool shift_border(const Planting& p, bool outwards) {
  const std::uint32_t v = p.any_vertex();
  const auto border = p.sites.border_neighbours(v);
  if (!border || !p.sites.alone(v)) return false;
  const auto [before, after] = *border;
  if (!p.sites.alone(before) || !p.sites.alone(after) || p.turn(before, v, after) != 0) return false;
  const Vec3 along = p.sound.positions[after] - p.sound.positions[before];
  const double share = (outwards ? -1 : 1) * p.random.between(0.01, 0.2);  // inside lies to the left
  Vec3& moved = p.mesh().positions[v];
  moved.x -= along.y * share;
  moved.y += along.x * share;
  if (p.turn(before, v, after) != (outwards ? 1 : -1) || !p.star_is_sound(v)) return false;
  p.expect(FindingCode::outline, outwards ? "extra" : "missing", {before, v, after}, {});
  return true;
}

bool slide_border(const Planting& p) {
  const std::uint32_t v = p.any_vertex();
  const auto border = p.sites.border_neighbours(v);
  if (!border || !p.sites.alone(v)) return false;
  const auto [before, after] = *border;
  Vec3& moved = p.mesh().positions[v];
  const bool straight = p.turn(before, v, after) == 0;
  moved = moved + (p.sound.positions[after] - moved) * p.random.between(0.1, 0.6);
  return straight && oracle::inside_segment(p.plan(before), p.plan(after), p.plan(v)) && p.star_is_sound(v);
}

}  // namespace plumbline::faults
