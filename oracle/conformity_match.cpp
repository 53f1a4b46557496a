// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Station 2 of check_conformity: directed edges meet their twins by index. Edges are bucketed by their
// smaller vertex (a counting sort), since in a sound mesh a bucket holds about six; nothing is hashed.
#include <algorithm>
#include <limits>

#include "oracle/conformity_parts.h"
#include "scenarios/error.h"

namespace plumbline::oracle::detail {
namespace {

/// A bucket's entry: the larger vertex, and in the lowest bit whether the edge runs towards the smaller one.
using Entry = std::uint32_t;

/// Buckets of up to this many entries are sorted by insertion: fans are rare, and this is their usual size.
constexpr std::size_t kSmallBucket = 24;

template <typename Visit>
void each_edge(const Mesh& mesh, std::span<const std::uint8_t> treatment, Visit&& visit) {
  if (treatment.empty()) {
    for (const auto& [a, b, c] : mesh.triangles) {
      visit(a, b);
      visit(b, c);
      visit(c, a);
    }
    return;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if ((treatment[t] & kLeftOut) != 0) continue;
    const auto [a, b, c] = corners_of(mesh, treatment, t);
    visit(a, b);
    visit(b, c);
    visit(c, a);
  }
}

void sort_bucket(Entry* first, Entry* last) {
  if (static_cast<std::size_t>(last - first) > kSmallBucket) {
    std::sort(first, last);
    return;
  }
  for (Entry* i = first + (first != last); i < last; ++i) {
    const Entry value = *i;
    Entry* hole = i;
    for (; hole > first && hole[-1] > value; --hole) *hole = hole[-1];
    *hole = value;
  }
}

/// An edge with more uses one way than the other.
struct Surplus {
  std::uint32_t from = 0, to = 0;
  std::uint32_t count = 0;
  bool operator<(const Surplus& other) const {
    return from != other.from ? from < other.from : to < other.to;
  }
};

/// Finds the triangles of surplus edges: the first `count` uses of each, in order of triangle.
std::vector<EdgeUse> locate(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                            std::vector<Surplus>& surplus) {
  std::vector<EdgeUse> uses;
  if (surplus.empty()) return uses;
  std::sort(surplus.begin(), surplus.end());
  constexpr std::uint32_t kNowhere = kNone;
  std::vector<std::uint32_t> first_from(mesh.positions.size(), kNowhere);
  for (std::uint32_t i = 0; i < surplus.size(); ++i) {
    if (first_from[surplus[i].from] == kNowhere) first_from[surplus[i].from] = i;
  }
  const auto try_edge = [&](std::uint32_t from, std::uint32_t to, std::size_t t) {
    const std::uint32_t start = first_from[from];
    if (start == kNowhere) return;
    auto it = surplus.begin() + start;
    if (it->to != to) {  // usually one edge leaves a border vertex; a fan's hub may have many
      it = std::lower_bound(it, surplus.end(), Surplus{from, to, 0});
      if (it == surplus.end() || it->from != from || it->to != to) return;
    }
    if (it->count == 0) return;
    --it->count;
    const bool silent = !treatment.empty() && (treatment[t] & kSilent) != 0;
    uses.push_back({from, to, static_cast<std::uint32_t>(t), silent});
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!treatment.empty() && (treatment[t] & kLeftOut) != 0) continue;
    const auto [a, b, c] = corners_of(mesh, treatment, t);
    try_edge(a, b, t);
    try_edge(b, c, t);
    try_edge(c, a, t);
  }
  return uses;
}

}  // namespace

IndexMatch match_by_index(const Mesh& mesh, std::span<const std::uint8_t> treatment) {
  const std::size_t vertex_count = mesh.positions.size();
  if (vertex_count > std::numeric_limits<Entry>::max() / 2 ||
      mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max() / 3) {
    throw InputError("the mesh has more than 2^31 vertices or 2^32 edges; check it in parts");
  }
  // starts[v + 1] is first the count of bucket v, then the place of its next entry, in the end its end.
  std::vector<std::uint32_t> starts(vertex_count + 2, 0);
  each_edge(mesh, treatment, [&](std::uint32_t u, std::uint32_t v) { ++starts[std::min(u, v) + 2]; });
  for (std::size_t v = 2; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<Entry> entries(starts.back());
  each_edge(mesh, treatment, [&](std::uint32_t u, std::uint32_t v) {
    entries[starts[std::min(u, v) + 1]++] = std::max(u, v) << 1 | static_cast<Entry>(u > v);
  });

  IndexMatch result;
  std::vector<Surplus> surplus;
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    Entry* first = entries.data() + starts[v];
    Entry* const last = entries.data() + starts[v + 1];
    sort_bucket(first, last);
    while (first != last) {
      if (first + 1 != last && first[1] == (first[0] | 1) && first[0] != first[1] &&
          (first + 2 == last || first[2] != first[1])) {
        first += 2;  // one use each way
        continue;
      }
      const std::uint32_t other = *first >> 1;
      std::uint32_t uses[2] = {0, 0};
      for (; first != last && *first >> 1 == other; ++first) ++uses[*first & 1];
      if (uses[0] > 1 || uses[1] > 1) result.crowded.push_back({v, other});
      if (uses[0] > uses[1]) surplus.push_back({v, other, uses[0] - uses[1]});
      if (uses[1] > uses[0]) surplus.push_back({other, v, uses[1] - uses[0]});
    }
  }
  result.left_over = locate(mesh, treatment, surplus);
  return result;
}

std::vector<EdgeUse> uses_of(const Mesh& mesh, std::span<const std::uint8_t> treatment,
                             std::span<const VertexPair> edges) {
  std::vector<Surplus> both_ways;
  for (const VertexPair& edge : edges) {
    both_ways.push_back({edge.from, edge.to, kNone});
    both_ways.push_back({edge.to, edge.from, kNone});
  }
  return locate(mesh, treatment, both_ways);
}

}  // namespace plumbline::oracle::detail
