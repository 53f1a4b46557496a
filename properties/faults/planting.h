// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/predicates.h"
#include "properties/faults/faults.h"
#include "properties/faults/sites.h"

namespace plumbline::faults {

/// One attempt at one random place. `mesh` starts as a copy of the sound mesh. False: this place does not do.
struct Planting {
  const Mesh& sound;
  const Sites& sites;
  Random& random;
  PlantedFault& fault;

  Mesh& mesh() const { return fault.mesh; }
  std::uint32_t any_triangle() const {
    return static_cast<std::uint32_t>(random.below(sound.triangles.size()));
  }
  std::uint32_t any_vertex() const {
    return static_cast<std::uint32_t>(random.below(sound.positions.size()));
  }
  int any_corner() const { return static_cast<int>(random.below(3)); }
  std::uint32_t add_vertex(Vec3 p) const {
    fault.mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(fault.mesh.positions.size() - 1);
  }
  std::uint32_t add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    fault.mesh.triangles.push_back({a, b, c});
    return static_cast<std::uint32_t>(fault.mesh.triangles.size() - 1);
  }
  void expect(oracle::FindingCode code, std::string kind, std::vector<std::uint32_t> vertices,
              std::vector<std::uint32_t> triangles) const {
    fault.expected.push_back({code, std::move(kind), std::move(vertices), std::move(triangles)});
  }
  Vec2 plan(std::uint32_t v) const { return {fault.mesh.positions[v].x, fault.mesh.positions[v].y}; }
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return oracle::orientation(plan(a), plan(b), plan(c)).value;
  }
  /// Are all triangles that name v counter-clockwise in the faulty mesh?
  bool star_is_sound(std::uint32_t v) const {
    for (const std::uint32_t t : sites.star(v)) {
      const auto& c = fault.mesh.triangles[t];
      if (turn(c[0], c[1], c[2]) <= 0) return false;
    }
    return true;
  }
};

// Each is one entry or a family of entries of the catalogue; see faults.cpp for what they are.
enum class Step { ulp, millimetre, metre };
bool detach_upwards(const Planting&, Step);
bool detach_inwards(const Planting&, Step);
bool move_softly(const Planting&);
bool move_over_neighbour(const Planting&);
bool merge_vertices(const Planting&);
bool break_vertex(const Planting&);
bool leave_vertex(const Planting&);
bool shift_border(const Planting&, bool outwards);
bool slide_border(const Planting&);

bool drop_triangle(const Planting&);
bool double_triangle(const Planting&);
bool flip_triangle(const Planting&);
bool flatten_triangle(const Planting&);
bool cover_triangle(const Planting&);
bool break_index(const Planting&);

enum class SplitHeight { flat, ulp, metre };
bool split_edge(const Planting&, SplitHeight);
bool coarsen_one_side(const Planting&);
bool cut_patch(const Planting&, bool stale);

}  // namespace plumbline::faults
