// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "oracle/border.h"
#include "oracle/seams.h"
#include "tests/oracle/symmetry.h"

/// Borders without meshes: what compare_borders and find_slit take, made by hand.
namespace plumbline::test {

/// A vertex of a border, and how far its skirt reaches down; 0: none.
struct Post {
  Vec3 at;
  double skirt_m = 0;
};

inline void set_box(oracle::Border& border) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  border.low = {inf, inf};
  border.high = {-inf, -inf};
  for (const oracle::BorderEdge& edge : border.edges) {
    for (const Vec2 p : edge.plan) {
      border.low = {std::min(border.low.x, p.x), std::min(border.low.y, p.y)};
      border.high = {std::max(border.high.x, p.x), std::max(border.high.y, p.y)};
    }
  }
}

/// A chain of edges, the surface to its left; vertices are numbered along it, triangles as their edges. An
/// edge has a skirt if both of its ends have.
inline oracle::Border chain(const std::vector<Post>& posts) {
  oracle::Border border;
  for (std::uint32_t k = 0; k + 1 < posts.size(); ++k) {
    oracle::BorderEdge edge;
    edge.vertices = {k, k + 1};
    edge.triangle = k;
    edge.has_skirt = posts[k].skirt_m > 0 && posts[k + 1].skirt_m > 0;
    for (const std::uint32_t e : {0u, 1u}) {
      const Post& post = posts[k + e];
      edge.plan[e] = {post.at.x, post.at.y};
      edge.height[e] = {post.at.z, post.at.z, 0, 0};
      if (edge.has_skirt) edge.foot[e] = {post.at.z, post.at.z, 0, post.skirt_m};
    }
    border.edges.push_back(edge);
  }
  set_box(border);
  return border;
}

/// Moves a border; a mirror reverses its edges, so that the surface stays to the left. Only plain heights.
inline oracle::Border moved(oracle::Border border, const Move& move) {
  const auto height = [&](Vec2 plan, const oracle::ExactHeight& h) {
    oracle::ExactHeight out = h;
    out.low = move(Vec3{plan.x, plan.y, h.low}).z;
    out.high = move(Vec3{plan.x, plan.y, h.high}).z;
    out.drop = h.drop * move.scale;
    return out;
  };
  for (oracle::BorderEdge& edge : border.edges) {
    for (std::size_t k = 0; k < 2; ++k) {
      edge.height[k] = height(edge.plan[k], edge.height[k]);
      edge.foot[k] = height(edge.plan[k], edge.foot[k]);
      edge.plan[k] = move(edge.plan[k]);
    }
    if (!move.mirrors()) continue;
    std::swap(edge.plan[0], edge.plan[1]);
    std::swap(edge.height[0], edge.height[1]);
    std::swap(edge.foot[0], edge.foot[1]);
    std::swap(edge.vertices[0], edge.vertices[1]);
    std::swap(edge.normal[0], edge.normal[1]);
  }
  set_box(border);
  return border;
}

}  // namespace plumbline::test
