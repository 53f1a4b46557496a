// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/haar_quadtree/dual_mesh.h"

namespace plumbline::haar_quadtree {
namespace {

enum Corner { south_west = 0, south_east = 1, north_west = 2, north_east = 3 };

class Walk {
 public:
  Walk(const Cut& cut, const std::vector<std::uint32_t>& vertex_of,
       std::vector<std::array<std::uint32_t, 3>>& triangles)
      : cut_(cut), vertex_of_(vertex_of), triangles_(triangles) {}

  void forest() {
    const Forest& forest = cut_.forest();
    for (int b = 0; b < forest.patches_y(); ++b) {
      for (int a = 0; a < forest.patches_x(); ++a) {
        const bool east = a + 1 < forest.patches_x();
        const bool north = b + 1 < forest.patches_y();
        cell({0, a, b});
        if (east) side_by_side({0, a, b}, {0, a + 1, b});
        if (north) one_above_other({0, a, b}, {0, a, b + 1});
        if (east && north) corner({0, a, b}, {0, a + 1, b}, {0, a, b + 1}, {0, a + 1, b + 1});
      }
    }
  }

 private:
  /// The part of a cell that lies towards a corner: its child there, or itself where it is not split.
  [[nodiscard]] Node towards(Node cell, Corner corner) const {
    return cut_.is_split(cell) ? children(cell)[corner] : cell;
  }

  /// All corners strictly inside a cell.
  void cell(Node node) {
    if (!cut_.is_split(node)) return;
    const std::array<Node, 4> c = children(node);
    for (const Node& child : c) cell(child);
    side_by_side(c[south_west], c[south_east]);
    side_by_side(c[north_west], c[north_east]);
    one_above_other(c[south_west], c[north_west]);
    one_above_other(c[south_east], c[north_east]);
    corner(c[south_west], c[south_east], c[north_west], c[north_east]);
  }

  /// All corners strictly inside the common edge of two cells.
  void side_by_side(Node west, Node east) {
    if (!cut_.is_split(west) && !cut_.is_split(east)) return;
    const Node sw = towards(west, south_east);
    const Node nw = towards(west, north_east);
    const Node se = towards(east, south_west);
    const Node ne = towards(east, north_west);
    side_by_side(sw, se);
    side_by_side(nw, ne);
    corner(sw, se, nw, ne);
  }

  void one_above_other(Node south, Node north) {
    if (!cut_.is_split(south) && !cut_.is_split(north)) return;
    const Node sw = towards(south, north_west);
    const Node se = towards(south, north_east);
    const Node nw = towards(north, south_west);
    const Node ne = towards(north, south_east);
    one_above_other(sw, nw);
    one_above_other(se, ne);
    corner(sw, se, nw, ne);
  }

  /// The point where four cells (some of them perhaps the same) meet.
  void corner(Node sw, Node se, Node nw, Node ne) {
    while (cut_.is_split(sw)) sw = children(sw)[north_east];
    while (cut_.is_split(se)) se = children(se)[north_west];
    while (cut_.is_split(nw)) nw = children(nw)[south_east];
    while (cut_.is_split(ne)) ne = children(ne)[south_west];
    const std::uint32_t a = vertex(sw);
    const std::uint32_t b = vertex(se);
    const std::uint32_t c = vertex(ne);
    const std::uint32_t d = vertex(nw);
    if (a != b && b != c) triangles_.push_back({a, b, c});
    if (c != d && d != a) triangles_.push_back({a, c, d});
  }

  [[nodiscard]] std::uint32_t vertex(Node root) const { return vertex_of_[cut_.forest().index(root)]; }

  const Cut& cut_;
  const std::vector<std::uint32_t>& vertex_of_;
  std::vector<std::array<std::uint32_t, 3>>& triangles_;
};

}  // namespace

void triangulate(const Cut& cut, const std::vector<std::uint32_t>& vertex_of,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  triangles.clear();
  Walk(cut, vertex_of, triangles).forest();
}

void collapse_full_triangulation(const Cut& cut, const std::vector<std::uint32_t>& vertex_of,
                                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  triangles.clear();
  const Forest& forest = cut.forest();
  const int leaf = forest.leaf_level();
  const auto root_of = [&](int i, int j) {
    Node node{0, i >> leaf, j >> leaf};
    while (cut.is_split(node)) {
      const int below = leaf - node.level - 1;
      node = {node.level + 1, i >> below, j >> below};
    }
    return vertex_of[forest.index(node)];
  };
  const auto keep = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) triangles.push_back({a, b, c});
  };
  for (int j = 0; j + 1 < forest.rows(leaf); ++j) {
    for (int i = 0; i + 1 < forest.columns(leaf); ++i) {
      const std::uint32_t a = root_of(i, j);
      const std::uint32_t b = root_of(i + 1, j);
      const std::uint32_t c = root_of(i + 1, j + 1);
      const std::uint32_t d = root_of(i, j + 1);
      keep(a, b, c);
      keep(a, c, d);
    }
  }
}

}  // namespace plumbline::haar_quadtree
