// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scenarios/mesh.h"

/// Who is whose neighbour in a sound mesh: what a fault needs to know to find a place for itself. Written for
/// clarity, not speed, and shares nothing with the oracle but the predicates.
namespace plumbline::faults {

inline constexpr std::uint32_t kNobody = 0xffffffffu;
inline constexpr std::uint32_t at(int k) { return static_cast<std::uint32_t>(k % 3); }

class Sites {
 public:
  explicit Sites(const Mesh& mesh);

  /// Vertices at the same plan point share a place.
  [[nodiscard]] std::uint32_t place(std::uint32_t v) const { return place_[v]; }
  /// Is v the only vertex at its place?
  [[nodiscard]] bool alone(std::uint32_t v) const { return population_[place_[v]] == 1; }
  /// The triangle with the directed edge from → to, by place; kNobody if none.
  [[nodiscard]] std::uint32_t triangle_on(std::uint32_t from, std::uint32_t to) const;
  /// The triangle beyond edge k of triangle t.
  [[nodiscard]] std::uint32_t beyond(std::uint32_t t, int k) const;
  /// Triangles that name v, in order.
  [[nodiscard]] const std::vector<std::uint32_t>& star(std::uint32_t v) const { return star_[v]; }
  /// For each triangle (v, x, y) of v's star: x and y.
  [[nodiscard]] std::map<std::uint32_t, std::uint32_t> link(std::uint32_t v) const;
  /// Does the star close around v?
  [[nodiscard]] bool interior(std::uint32_t v) const;
  /// v's neighbours on the mesh's border, before and after it; nothing if v is not on the border exactly
  /// once.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> border_neighbours(
      std::uint32_t v) const;

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> place_, population_;
  std::vector<std::vector<std::uint32_t>> star_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> on_edge_;
};

}  // namespace plumbline::faults
