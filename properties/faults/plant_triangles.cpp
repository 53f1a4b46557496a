// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Faults that add, remove or turn single triangles.
#include <algorithm>

#include "properties/faults/planting.h"

namespace plumbline::faults {

using oracle::FindingCode;

bool drop_triangle(const Planting& p) {
  const std::uint32_t t = p.any_triangle();
  const auto corners = p.sound.triangles[t];
  for (const std::uint32_t c : corners) {
    if (!p.sites.alone(c) || p.sites.star(c).size() < 2) return false;  // or a vertex would be left unused
  }
  bool at_border = false;
  for (int k = 0; k < 3; ++k) at_border |= p.sites.beyond(t, k) == kNobody;
  p.mesh().triangles.erase(p.mesh().triangles.begin() + t);
  const std::vector<std::uint32_t> witnesses(corners.begin(), corners.end());
  if (at_border) {
    p.expect(FindingCode::outline, "missing", witnesses, {});
  } else {
    p.expect(FindingCode::hole, "", witnesses, {});
  }
  return true;
}

bool double_triangle(const Planting& p) {
  const std::uint32_t t = p.any_triangle();
  auto corners = p.sound.triangles[t];
  std::rotate(corners.begin(), corners.begin() + p.any_corner(), corners.end());
  const std::uint32_t copy = p.add_triangle(corners[0], corners[1], corners[2]);
  p.expect(FindingCode::duplicate, "", {corners.begin(), corners.end()}, {t, copy});
  return true;
}

bool flip_triangle(const Planting& p) {
  const std::uint32_t t = p.any_triangle();
  const int k = p.any_corner();
  std::swap(p.mesh().triangles[t][at(k)], p.mesh().triangles[t][at(k + 1)]);
  p.expect(FindingCode::fold_over, "reversed", {}, {t});
  return true;
}

bool flatten_triangle(const Planting& p) {
  const std::uint32_t v = p.any_vertex();
  const auto link = p.sites.link(v);
  for (const auto& [a, unused_a] : link) {
    for (const auto& [b, unused_b] : link) {
      if (!oracle::inside_segment(p.plan(a), p.plan(b), p.plan(v))) continue;
      const std::uint32_t flat = p.add_triangle(a, v, b);
      p.expect(FindingCode::degenerate, "collinear", {a, v, b}, {flat});
      return true;
    }
  }
  return false;
}

bool cover_triangle(const Planting& p) {
  const std::uint32_t t = p.any_triangle();
  const auto& corners = p.sound.triangles[t];
  const Vec3 a = p.sound.positions[corners[0]];
  const Vec3 ab = p.sound.positions[corners[1]] - a, ac = p.sound.positions[corners[2]] - a;
  // Barycentric corners well inside, counter-clockwise like the triangle.
  const std::uint32_t first = p.add_vertex(a + ab * 0.25 + ac * 0.25);
  const std::uint32_t second = p.add_vertex(a + ab * 0.5 + ac * 0.25);
  const std::uint32_t third = p.add_vertex(a + ab * 0.25 + ac * 0.5);
  for (const std::uint32_t v : {first, second, third}) {
    for (int k = 0; k < 3; ++k) {
      if (p.turn(corners[at(k)], corners[at(k + 1)], v) <= 0) return false;  // rounded out of a tiny triangle
    }
  }
  if (p.turn(first, second, third) <= 0) return false;
  const std::uint32_t extra = p.add_triangle(first, second, third);
  p.expect(FindingCode::overlap, "", {first, second, third}, {extra});
  return true;
}

bool break_index(const Planting& p) {
  const std::uint32_t t = p.any_triangle();
  for (const std::uint32_t c : p.sound.triangles[t]) {
    if (p.sites.star(c).size() < 2) return false;
  }
  const auto count = static_cast<std::uint32_t>(p.sound.positions.size());
  p.mesh().triangles[t][at(p.any_corner())] = p.random.below(2) == 0 ? count : kNobody;
  p.expect(FindingCode::bad_index, "", {}, {t});
  return true;
}

}  // namespace plumbline::faults
