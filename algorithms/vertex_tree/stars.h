// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "scenarios/mesh.h"

namespace plumbline::vertex_tree {

/// Throws InputError unless `mesh` is an oriented manifold, with or without border, of finite positions.
void require_manifold(const Mesh& mesh);

/// The other two corners of a triangle at corner `v`, in its direction of turn.
inline std::array<std::uint32_t, 2> others(const std::array<std::uint32_t, 3>& t, std::uint32_t v) {
  if (t[0] == v) return {t[1], t[2]};
  if (t[1] == v) return {t[2], t[0]};
  return {t[0], t[1]};
}

inline bool has_corner(const std::array<std::uint32_t, 3>& t, std::uint32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

inline void replace_corner(std::array<std::uint32_t, 3>& t, std::uint32_t from, std::uint32_t to) {
  for (auto& corner : t) {
    if (corner == from) corner = to;
  }
}

/// Takes `value` out of a list whose order means nothing.
inline void take_out(std::vector<std::uint32_t>& list, std::uint32_t value) {
  const auto at = std::find(list.begin(), list.end(), value);
  *at = list.back();
  list.pop_back();
}

}  // namespace plumbline::vertex_tree
