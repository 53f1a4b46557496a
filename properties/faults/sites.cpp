// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/faults/sites.h"

namespace plumbline::faults {

Sites::Sites(const Mesh& mesh) : mesh_(mesh), place_(mesh.positions.size()), star_(mesh.positions.size()) {
  std::map<std::pair<double, double>, std::uint32_t> places;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    const auto next = static_cast<std::uint32_t>(places.size());
    place_[v] = places.try_emplace({p.x, p.y}, next).first->second;
  }
  population_.assign(places.size(), 0);
  for (const std::uint32_t p : place_) ++population_[p];
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = mesh.triangles[t][at(k)], v = mesh.triangles[t][at(k + 1)];
      star_[u].push_back(t);
      on_edge_[{place_[u], place_[v]}] = t;
    }
  }
}

std::uint32_t Sites::triangle_on(std::uint32_t from, std::uint32_t to) const {
  const auto it = on_edge_.find({place_[from], place_[to]});
  return it == on_edge_.end() ? kNobody : it->second;
}

std::uint32_t Sites::beyond(std::uint32_t t, int k) const {
  const auto& c = mesh_.triangles[t];
  return triangle_on(c[at(k + 1)], c[at(k)]);
}

std::map<std::uint32_t, std::uint32_t> Sites::link(std::uint32_t v) const {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const std::uint32_t t : star_[v]) {
    const auto& c = mesh_.triangles[t];
    for (int k = 0; k < 3; ++k) {
      if (c[at(k)] == v) next[c[at(k + 1)]] = c[at(k + 2)];
    }
  }
  return next;
}

bool Sites::interior(std::uint32_t v) const {
  if (star_[v].empty()) return false;
  const auto next = link(v);
  for (const auto& [x, y] : next) {
    if (!next.contains(y)) return false;
  }
  return true;
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> Sites::border_neighbours(std::uint32_t v) const {
  std::uint32_t before = kNobody, after = kNobody;
  for (const auto& [x, y] : link(v)) {
    if (triangle_on(x, v) == kNobody) {  // v → x runs along the border
      if (after != kNobody) return std::nullopt;
      after = x;
    }
    if (triangle_on(v, y) == kNobody) {
      if (before != kNobody) return std::nullopt;
      before = y;
    }
  }
  if (before == kNobody || after == kNobody) return std::nullopt;
  return std::pair{before, after};
}

}  // namespace plumbline::faults
