// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Station 3 of check_conformity, entered only if something looked wrong: triangles that later stations must
// not see as they are, so that one cause makes one finding.
#include <algorithm>
#include <bit>
#include <numeric>

#include "oracle/conformity_parts.h"
#include "oracle/plan_weld.h"

namespace plumbline::oracle::detail {

std::vector<std::uint32_t> weld_all(const Mesh& mesh, bool use_height) {
  std::vector<std::uint32_t> id(mesh.positions.size());
  PointTable table(mesh.positions.size());
  for (std::size_t v = 0; v < id.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    id[v] = table.number({p.x, p.y, use_height ? p.z : 0.0});
  }
  return id;
}

std::vector<Duplicate> find_duplicates(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                                       std::span<const std::uint32_t> negative) {
  const std::vector<std::uint32_t> place = weld_all(mesh, true);
  struct Key {
    std::array<std::uint32_t, 3> corners;
    bool clockwise;
    std::uint32_t triangle;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  keys.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if ((treatment[t] & kLeftOut) != 0) continue;
    const auto& c = mesh.triangles[t];
    std::array<std::uint32_t, 3> corners{place[c[0]], place[c[1]], place[c[2]]};
    std::sort(corners.begin(), corners.end());
    keys.push_back({corners, false, static_cast<std::uint32_t>(t)});
  }
  std::vector<bool> clockwise(mesh.triangles.size());
  for (const std::uint32_t t : negative) clockwise[t] = true;
  for (Key& key : keys) key.clockwise = clockwise[key.triangle];
  std::sort(keys.begin(), keys.end());
  std::vector<Duplicate> duplicates;
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t j = i + 1;
    for (; j < keys.size() && keys[j].corners == keys[i].corners; ++j) {
      duplicates.push_back({keys[j].triangle, keys[i].triangle});
    }
    i = j;
  }
  std::sort(duplicates.begin(), duplicates.end(),
            [](const Duplicate& a, const Duplicate& b) { return a.extra < b.extra; });
  return duplicates;
}

std::vector<bool> find_turned(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                              std::span<const std::uint32_t> negative) {
  const std::vector<std::uint32_t> place = weld_all(mesh, false);
  struct Use {
    std::uint32_t low, high;  // places
    bool downwards;           // from high to low
    std::uint32_t group;      // index into `negative`, or kNone: a counter-clockwise triangle
    auto operator<=>(const Use&) const = default;
  };
  // Only edges between places that a negative triangle touches can be shared with one.
  std::vector<bool> touched(mesh.positions.size());
  std::vector<std::uint32_t> rank(mesh.triangles.size(), kNone);
  for (std::uint32_t i = 0; i < negative.size(); ++i) {
    rank[negative[i]] = i;
    for (const std::uint32_t v : mesh.triangles[negative[i]]) touched[place[v]] = true;
  }
  std::vector<Use> uses;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if ((treatment[t] & (kLeftOut | kSilent)) != 0) continue;
    const auto& corners = mesh.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = place[corners[static_cast<std::size_t>(k)]];
      const std::uint32_t v = place[corners[static_cast<std::size_t>((k + 1) % 3)]];
      if (touched[u] && touched[v]) uses.push_back({std::min(u, v), std::max(u, v), u > v, rank[t]});
    }
  }
  std::sort(uses.begin(), uses.end());

  // Groups: negative triangles that meet in opposite directions, as neighbours of one patch do.
  std::vector<std::uint32_t> parent(negative.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<std::array<std::size_t, 2>> ballots(negative.size(), {0, 0});  // turned, folded
  for (const bool voting : {false, true}) {
    for (std::size_t i = 0; i < uses.size();) {
      std::size_t end = i;
      std::array<std::size_t, 2> neighbours{0, 0};       // counter-clockwise ones, by direction
      std::array<std::uint32_t, 2> first{kNone, kNone};  // a negative one in each direction
      for (; end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high; ++end) {
        const Use& use = uses[end];
        if (use.group == kNone) {
          ++neighbours[use.downwards];
        } else if (first[use.downwards] == kNone) {
          first[use.downwards] = use.group;
        }
      }
      if (!voting && first[0] != kNone && first[1] != kNone) {
        for (std::size_t k = i; k < end; ++k) {
          if (uses[k].group != kNone) parent[root(uses[k].group)] = root(first[0]);
        }
      }
      if (voting) {
        for (std::size_t k = i; k < end; ++k) {
          if (uses[k].group == kNone) continue;
          auto& ballot = ballots[root(uses[k].group)];
          ballot[0] += neighbours[uses[k].downwards];
          ballot[1] += neighbours[!uses[k].downwards];
        }
      }
      i = end;
    }
  }
  std::vector<bool> turned(negative.size());
  for (std::uint32_t i = 0; i < negative.size(); ++i) {
    const auto& ballot = ballots[root(i)];
    turned[i] = ballot[0] >= ballot[1];
  }
  return turned;
}

}  // namespace plumbline::oracle::detail
