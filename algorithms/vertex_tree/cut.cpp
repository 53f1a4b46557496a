// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/vertex_tree/cut.h"

#include "algorithms/mutant.h"
#include "algorithms/vertex_tree/stars.h"

namespace plumbline::vertex_tree {

Cut::Cut(std::shared_ptr<const VertexTree> tree)
    : tree_(std::move(tree)),
      now_(tree_->triangles),
      live_(now_.size(), 1),
      present_(tree_->nodes(), 0),
      stars_(tree_->nodes()),
      greatest_(tree_->nodes(), 0),
      least_(tree_->nodes(), kNone),
      live_count_(now_.size()) {
  const auto originals = static_cast<std::uint32_t>(tree_->originals);
  for (std::uint32_t t = 0; t < now_.size(); ++t) {
    for (const auto v : now_[t]) stars_[v].push_back(t);
  }
  for (std::uint32_t v = 0; v < originals; ++v) present_[v] = 1;
  for (std::uint32_t v = 0; v < originals; ++v) look_around(v);
}

// M and m of v from its star.
void Cut::look_around(std::uint32_t v) {
  const std::uint32_t partner = tree_->partner(v);
  std::uint32_t greatest = 0, least = kNone;
  for (const auto t : stars_[v]) {
    for (const auto u : now_[t]) {
      if (u == v) continue;
      greatest = std::max(greatest, u);
      if (u != partner || PLUMBLINE_MUTANT(m5_single_level)) least = std::min(least, tree_->parent[u]);
    }
  }
  greatest_[v] = greatest;
  least_[v] = least;
}

void Cut::collapse(std::uint32_t p) {
  const auto& [a, b] = tree_->children[p - tree_->originals];
  const auto& gone = tree_->removed[p - tree_->originals];
  for (const auto t : gone) {
    if (t == kNone) continue;
    for (const auto c : now_[t]) {
      if (c != a && c != b) take_out(stars_[c], t);
    }
    live_[t] = 0;
    --live_count_;
  }
  // The children keep their own stars as they are: the split that undoes this meets the same neighbours
  // (docs/proofs/m5_identifiers.md).
  auto& star = stars_[p];
  star.clear();
  for (const auto v : {a, b}) {
    for (const auto t : stars_[v]) {
      if (t == gone[0] || t == gone[1]) continue;
      replace_corner(now_[t], v, p);
      star.push_back(t);
    }
    present_[v] = 0;
  }
  present_[p] = 1;
  look_around(p);
  for (const auto t : star) {
    for (const auto c : others(now_[t], p)) {
      greatest_[c] = std::max(greatest_[c], p);  // p is greater than the children it replaces
      if (least_[c] == p) look_around(c);        // otherwise another neighbour's parent is the least
    }
  }
}

void Cut::split(std::uint32_t p) {
  const auto& [a, b] = tree_->children[p - tree_->originals];
  const auto& gone = tree_->removed[p - tree_->originals];
  for (const auto v : {a, b}) {
    for (const auto t : stars_[v]) {
      if (t != gone[0] && t != gone[1]) replace_corner(now_[t], p, v);
    }
    present_[v] = 1;
  }
  present_[p] = 0;
  for (const auto t : gone) {
    if (t == kNone) continue;
    if (PLUMBLINE_MUTANT(m5_second_triangle_lost) && t == gone[1]) continue;
    live_[t] = 1;
    ++live_count_;
    for (const auto c : now_[t]) {
      if (c != a && c != b) stars_[c].push_back(t);
    }
  }
  look_around(a);
  look_around(b);
  for (const auto v : {a, b}) {
    for (const auto t : stars_[v]) {
      for (const auto c : others(now_[t], v)) {
        if (c == a || c == b) continue;
        least_[c] = std::min(least_[c], p);     // p's own parent was greater than p
        if (greatest_[c] == p) look_around(c);  // otherwise another neighbour is the greatest
      }
    }
  }
}

std::size_t Cut::force_split(std::uint32_t p) {
  // Whoever is in the way has a greater identifier, so the chain ends.
  std::size_t splits = 0;
  std::vector<std::uint32_t> chain{p};
  while (!chain.empty()) {
    const std::uint32_t v = chain.back();
    if (may_split(v) || PLUMBLINE_MUTANT(m5_split_not_forced)) {
      split(v);
      ++splits;
      chain.pop_back();
    } else {
      chain.push_back(greatest_[v]);
    }
  }
  return splits;
}

std::size_t Cut::coarsen(std::size_t triangles, const std::function<bool(std::uint32_t)>& held) {
  // One pass suffices: what stands in the way of a node has a lesser identifier.
  std::size_t collapses = 0;
  for (auto p = static_cast<std::uint32_t>(tree_->originals); p < tree_->nodes(); ++p) {
    if (live_count_ <= triangles) break;
    const auto& [a, b] = tree_->children[p - tree_->originals];
    const bool may =
        PLUMBLINE_MUTANT(m5_identifier_test_missing) ? present_[a] && present_[b] : may_collapse(p);
    if (!may || (held && held(p))) continue;
    collapse(p);
    ++collapses;
  }
  return collapses;
}

std::size_t Cut::refine(std::size_t triangles) {
  std::size_t splits = 0;
  for (auto p = static_cast<std::uint32_t>(tree_->nodes()); p-- > tree_->originals;) {
    if (!present_[p]) continue;
    const std::size_t more = tree_->removed[p - tree_->originals][1] == kNone ? 1 : 2;
    if (live_count_ + more > triangles + (PLUMBLINE_MUTANT(m5_refines_too_far) ? 8 : 0)) break;
    split(p);
    ++splits;
  }
  return splits;
}

void Cut::extract(Mesh& mesh, std::vector<std::uint64_t>& keys) const {
  mesh.clear();
  keys.clear();
  std::vector<std::uint32_t> place(tree_->nodes(), 0);
  for (std::uint32_t v = 0; v < tree_->nodes(); ++v) {
    if (!present_[v] || stars_[v].empty()) continue;
    place[v] = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(tree_->positions[v]);
    keys.push_back(v);
  }
  mesh.triangles.reserve(live_count_);
  for (std::size_t t = 0; t < now_.size(); ++t) {
    if (live_[t]) mesh.triangles.push_back({place[now_[t][0]], place[now_[t][1]], place[now_[t][2]]});
  }
}

}  // namespace plumbline::vertex_tree
