// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/haar_quadtree/dual_mesh.h"

#include "algorithms/mutant.h"

namespace plumbline::haar_quadtree {
namespace {

using Slot = Cut::Slot;

/// Corners of a cell, in the order of its children.
enum Corner : Slot { south_west = 0, south_east = 1, north_west = 2, north_east = 3 };

class Walk {
 public:
  /// `next` has room for all triangles.
  Walk(const Cut& cut, std::array<std::uint32_t, 3>* next) : cut_(cut), next_(next) {}
  [[nodiscard]] const std::array<std::uint32_t, 3>* end() const { return next_; }

  void patches(const Forest& forest) {
    const auto across = static_cast<Slot>(forest.patches_x());
    const auto along = static_cast<Slot>(forest.patches_y());
    for (Slot b = 0; b < along; ++b) {
      for (Slot a = 0; a < across; ++a) {
        const Slot here = b * across + a;
        const bool east = a + 1 < across;
        const bool north = b + 1 < along;
        cell(here);
        if (east) side_by_side(here, here + 1);
        if (north && !(PLUMBLINE_MUTANT(m1_patch_border_skipped) && !east))
          one_above_other(here, here + across);
        if (east && north) corner(here, here + 1, here + across, here + across + 1);
      }
    }
  }

 private:
  /// The part of a cell that lies towards a corner: its child there, or itself where it is not split.
  [[nodiscard]] Slot towards(Slot cell, Corner corner) const {
    return cut_.is_root(cell) ? cell : cut_.children(cell) + corner;
  }

  /// All corners strictly inside a cell.
  void cell(Slot slot) {
    if (cut_.is_root(slot)) return;
    const Slot c = cut_.children(slot);
    for (Slot k = 0; k < 4; ++k) cell(c + k);
    side_by_side(c + south_west, c + south_east);
    side_by_side(c + north_west, c + north_east);
    one_above_other(c + south_west, c + north_west);
    one_above_other(c + south_east, c + north_east);
    corner(c + south_west, c + south_east, c + north_west, c + north_east);
  }

  /// All corners strictly inside the common edge of two cells.
  void side_by_side(Slot west, Slot east) {
    if (cut_.is_root(west) && cut_.is_root(east)) return;
    const Slot sw = towards(west, south_east);
    const Slot nw = towards(west, north_east);
    const Slot se = towards(east, south_west);
    const Slot ne = towards(east, north_west);
    side_by_side(sw, se);
    side_by_side(nw, ne);
    corner(sw, se, nw, ne);
  }

  void one_above_other(Slot south, Slot north) {
    if (cut_.is_root(south) && cut_.is_root(north)) return;
    const Slot sw = towards(south, north_west);
    const Slot se = towards(south, north_east);
    const Slot nw = towards(north, south_west);
    const Slot ne = towards(north, south_east);
    one_above_other(sw, nw);
    one_above_other(se, ne);
    corner(sw, se, nw, ne);
  }

  /// The root on the way down to a corner.
  [[nodiscard]] std::uint32_t vertex_at(Slot cell, Corner corner) const {
    if (PLUMBLINE_MUTANT(m1_neighbour_one_level_down) && !cut_.is_root(cell)) corner = Corner(3 - corner);
    while (!cut_.is_root(cell)) cell = cut_.children(cell) + corner;
    return cut_.vertex(cell);
  }

  /// The point where four cells (some of them perhaps the same) meet.
  void corner(Slot sw, Slot se, Slot nw, Slot ne) {
    const std::uint32_t a = vertex_at(sw, north_east);
    const std::uint32_t b = vertex_at(se, north_west);
    const std::uint32_t c = vertex_at(ne, south_west);
    const std::uint32_t d = vertex_at(nw, south_east);
    if (PLUMBLINE_MUTANT(m1_diagonal_swapped) && a != b && b != c && c != d && d != a) {
      *next_++ = {a, b, d};
      *next_++ = {b, c, d};
      return;
    }
    if (PLUMBLINE_MUTANT(m1_fan_triangle_dropped) && c == d && a != b && b != c) return;
    if (a != b && b != c) *next_++ = {a, b, c};
    if (PLUMBLINE_MUTANT(m1_wrong_winding) && c != d && d != a) {
      *next_++ = {a, d, c};
      return;
    }
    if (c != d && d != a) *next_++ = {a, c, d};
  }

  const Cut& cut_;
  std::array<std::uint32_t, 3>* next_;
};

}  // namespace

void triangulate(const Forest& forest, const Cut& cut, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  // A plane triangulation has fewer than twice as many triangles as vertices.
  triangles.resize(2 * cut.roots(forest.patches()));
  Walk walk(cut, triangles.data());
  walk.patches(forest);
  triangles.resize(static_cast<std::size_t>(walk.end() - triangles.data()));
}

void collapse_full_triangulation(const Forest& forest, const Cut& cut,
                                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  triangles.clear();
  const int leaf = forest.leaf_level();
  const auto vertex_of = [&](int i, int j) {
    auto slot = static_cast<Slot>((j >> leaf) * forest.patches_x() + (i >> leaf));
    for (int below = leaf - 1; !cut.is_root(slot); --below) {
      slot = cut.children(slot) + static_cast<Slot>((i >> below & 1) + 2 * (j >> below & 1));
    }
    return cut.vertex(slot);
  };
  const auto keep = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) triangles.push_back({a, b, c});
  };
  for (int j = 0; j + 1 < forest.rows(leaf); ++j) {
    for (int i = 0; i + 1 < forest.columns(leaf); ++i) {
      const std::uint32_t a = vertex_of(i, j);
      const std::uint32_t b = vertex_of(i + 1, j);
      const std::uint32_t c = vertex_of(i + 1, j + 1);
      const std::uint32_t d = vertex_of(i, j + 1);
      keep(a, b, c);
      keep(a, c, d);
    }
  }
}

}  // namespace plumbline::haar_quadtree
