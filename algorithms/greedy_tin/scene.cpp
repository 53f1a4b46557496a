// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/greedy_tin/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/mutant.h"

namespace plumbline::greedy_tin {
namespace {

/// A displaced point behind the camera, or nearly in its plane: as if it lay at this share of the point's
/// depth. Orders such samples; it is far above any threshold.
constexpr double kNearestShare = 0x1p-10;

/// A quotient is less than another without dividing: room for the rounding of either side.
constexpr double kSurelyLess = 1 - 0x1p-48;

/// Which columns a triangle covers, cells; wider than the rounding of one division of grid numbers.
constexpr double kRoundingCells = 1e-9;

/// Columns between which the triangle lies in the strip of rows [south, north].
struct Extent {
  double west = std::numeric_limits<double>::infinity(), east = -std::numeric_limits<double>::infinity();
};
Extent extent(const std::array<Sample, 3>& corners, int south, int north) {
  Extent out;
  for (std::size_t k = 0; k < 3; ++k) {
    Sample a = corners[k], b = corners[(k + 1) % 3];
    if (a.j > b.j) std::swap(a, b);
    if (b.j < south || a.j > north) continue;
    for (const int row : {std::max(a.j, south), std::min(b.j, north)}) {
      const double column =
          a.j == b.j ? a.i : a.i + static_cast<double>(row - a.j) * (b.i - a.i) / (b.j - a.j);
      out.west = std::min(out.west, column);
      out.east = std::max(out.east, column);
    }
    if (a.j == b.j) {
      out.west = std::min<double>(out.west, b.i);
      out.east = std::max<double>(out.east, b.i);
    }
  }
  return out;
}

}  // namespace

Facet make_facet(const Terrain& terrain, const std::array<Sample, 3>& corners) {
  const auto [a, b, c] = corners;
  const double bi = b.i - a.i, bj = b.j - a.j, ci = c.i - a.i, cj = c.j - a.j;
  const double double_area = bi * cj - bj * ci;  // > 0
  const double za = terrain.z(a.i, a.j);
  const double zb = terrain.z(b.i, b.j) - za, zc = terrain.z(c.i, c.j) - za;
  return {corners, za, (zb * cj - zc * bj) / double_area, (zc * bi - zb * ci) / double_area};
}

void Scene::look(const Terrain& terrain, const Camera& camera) {
  terrain_ = &terrain;
  samples_scanned = pieces_bounded = 0;
  kappa_px_ = camera.kappa_px;
  tangent_x_ = camera.width_px * 0.5 / camera.kappa_px;
  tangent_y_ = camera.height_px * 0.5 / camera.kappa_px;
  const Vec3 right = camera.right();
  u_x_ = right.z;
  u_y_ = camera.up.z;
  u_d_ = camera.forward.z;
  greatest_weight_px_ = 0;
  for (const double x : {-tangent_x_, tangent_x_}) {
    for (const double y : {-tangent_y_, tangent_y_}) {
      const double a = u_x_ - u_d_ * x, b = u_y_ - u_d_ * y;
      greatest_weight_px_ = std::max(greatest_weight_px_, kappa_px_ * std::sqrt(a * a + b * b));
    }
  }
  const std::size_t count = terrain.heights_m.size();
  seen_.resize(count);
  scanned_.resize(count);
  sides_.resize(count);
  vertex_.assign(count, 0);
  sample_range_.assign(static_cast<std::size_t>(terrain.rows), {terrain.columns, 0});
  cell_range_.assign(static_cast<std::size_t>(terrain.rows - 1), {terrain.columns, 0});
  for (int j = 0; j < terrain.rows; ++j) {
    Range& range = sample_range_[static_cast<std::size_t>(j)];
    for (int i = 0; i < terrain.columns; ++i) {
      const std::size_t s = terrain.index(i, j);
      const Vec3 v = terrain.point(i, j) - camera.position;
      Seen& seen = seen_[s];
      seen = {dot(v, right), dot(v, camera.up), dot(v, camera.forward)};
      scanned_[s] = {terrain.heights_m[s], seen.depth_m, 0};
      const double half_width = tangent_x_ * seen.depth_m, half_height = tangent_y_ * seen.depth_m;
      sides_[s] = static_cast<std::uint8_t>((seen.x < -half_width ? 1 : 0) | (seen.x > half_width ? 2 : 0) |
                                            (seen.y < -half_height ? 4 : 0) | (seen.y > half_height ? 8 : 0));
      if (sides_[s] != 0 || !(seen.depth_m > 0)) continue;
      scanned_[s].weight_px = weight_px(seen.x, seen.y, seen.depth_m);
      range = {std::min(range.begin, i), i + 1};
    }
  }
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    Range& range = cell_range_[static_cast<std::size_t>(j)];
    for (int i = 0; i + 1 < terrain.columns; ++i) {
      const std::size_t s = terrain.index(i, j), n = terrain.index(i, j + 1);
      if ((sides_[s] & sides_[s + 1] & sides_[n] & sides_[n + 1]) != 0) continue;
      range = {std::min(range.begin, i), i + 1};
    }
  }
}

double Scene::weight_px(double x, double y, double depth_m) const {
  const double a = u_x_ - u_d_ * (x / depth_m), b = u_y_ - u_d_ * (y / depth_m);
  return kappa_px_ * std::sqrt(a * a + b * b);
}

Worst Scene::worst_sample(const Facet& facet) {
  Worst worst;
  const auto& c = facet.corners;
  const int south = std::min({c[0].j, c[1].j, c[2].j}), north = std::max({c[0].j, c[1].j, c[2].j});
  for (int j = south; j <= north; ++j) {
    const Range range = sample_range_[static_cast<std::size_t>(j)];
    if (range.begin >= range.end) continue;
    const Extent columns = extent(c, j, j);
    const int begin = std::max(range.begin, static_cast<int>(std::ceil(columns.west - kRoundingCells)));
    const int end = std::min(range.end, static_cast<int>(std::floor(columns.east + kRoundingCells)) + 1);
    if (begin >= end) continue;
    samples_scanned += static_cast<std::uint64_t>(end - begin);
    for (int i = begin; i < end; ++i) {
      const std::size_t s = terrain_->index(i, j);
      const Scanned& at = scanned_[s];
      const double delta_m = facet.z(i, j) - at.z_m;
      const double reach = std::fabs(delta_m) * at.weight_px;
      const double depth_m = std::max(at.depth_m + delta_m * u_d_, at.depth_m * kNearestShare);
      if (reach <= worst.error_px * depth_m * kSurelyLess || reach == 0) continue;
      const Worst here{reach / depth_m, s};
      if (here.before(worst)) worst = here;
    }
  }
  return worst;
}

/// A corner of the part of a half cell under a facet.
struct Scene::Corner {
  double i = 0, j = 0;
};

Worst Scene::worst_piece(const Facet& facet, double enough_px) {
  Worst worst;
  const auto& c = facet.corners;
  const int south = std::min({c[0].j, c[1].j, c[2].j}), north = std::max({c[0].j, c[1].j, c[2].j});
  for (int j = south; j < north; ++j) {
    const Range range = cell_range_[static_cast<std::size_t>(j)];
    if (range.begin >= range.end) continue;
    const Extent columns = extent(c, j, j + 1);
    const int begin = std::max(range.begin, static_cast<int>(std::floor(columns.west - kRoundingCells)));
    const int end = std::min(range.end, static_cast<int>(std::ceil(columns.east + kRoundingCells)));
    for (int i = begin; i < end; ++i) {
      bound_half(facet, i, j, false, enough_px, worst);
      bound_half(facet, i, j, true, enough_px, worst);
    }
  }
  return worst;
}

void Scene::bound_half(const Facet& facet, int i, int j, bool upper, double enough_px, Worst& worst) {
  // South-east half (i,j) (i+1,j) (i+1,j+1), or north-west (i,j) (i+1,j+1) (i,j+1).
  const std::array<Sample, 3> at{Sample{i, j}, upper ? Sample{i + 1, j + 1} : Sample{i + 1, j},
                                 upper ? Sample{i, j + 1} : Sample{i + 1, j + 1}};
  std::array<std::size_t, 3> s{};
  unsigned outside_all = 15, outside_any = 0;
  bool all_vertices = true;
  for (std::size_t k = 0; k < 3; ++k) {
    s[k] = terrain_->index(at[k].i, at[k].j);
    outside_all &= sides_[s[k]];
    outside_any |= sides_[s[k]];
    all_vertices = all_vertices && is_vertex(s[k]);
  }
  // With all three corners it is a triangle of the network (delaunay.h), and met exactly.
  if (outside_all != 0 || all_vertices) return;
  ++pieces_bounded;

  // Most pieces need no closer look: δ over the whole half cell, and the greatest weight of the picture.
  double most_m = 0, least_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const double delta_m = facet.z(at[k].i, at[k].j) - terrain_->heights_m[s[k]];
    most_m = std::max(most_m, std::fabs(delta_m));
    least_m = std::min(least_m, seen_[s[k]].depth_m + delta_m * u_d_);
  }
  if (least_m > 0 && most_m * greatest_weight_px_ <= enough_px * least_m) return;

  // Linear over the half cell: value at `at[0]` and change per cell east and north.
  struct Linear {
    double value, east, north;
    double operator()(double di, double dj) const { return value + east * di + north * dj; }
  };
  const auto linear = [&](auto&& of) {
    const double v0 = of(s[0]), v1 = of(s[1]), v2 = of(s[2]);
    return upper ? Linear{v0, v1 - v2, v2 - v0} : Linear{v0, v1 - v0, v2 - v1};
  };
  const Linear z = linear([&](std::size_t k) { return terrain_->heights_m[k]; });
  const Linear depth = linear([&](std::size_t k) { return seen_[k].depth_m; });
  const Linear x = linear([&](std::size_t k) { return seen_[k].x; });
  const Linear y = linear([&](std::size_t k) { return seen_[k].y; });

  constexpr std::size_t kMost = 12;  // 3 corners, and one more for each of 7 lines that cut
  std::array<Corner, kMost> piece{Corner{0, 0}, Corner{double(at[1].i - i), double(at[1].j - j)},
                                  Corner{double(at[2].i - i), double(at[2].j - j)}};
  std::size_t count = 3;
  std::array<Corner, kMost> kept;
  // Keeps where `side` ≥ 0 (Sutherland–Hodgman).
  const auto clip = [&](const Linear& side) {
    bool cuts = false;
    for (std::size_t k = 0; k < count; ++k) cuts = cuts || side(piece[k].i, piece[k].j) < 0;
    if (!cuts) return;
    std::size_t left = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Corner a = piece[k], b = piece[k + 1 == count ? 0 : k + 1];
      const double va = side(a.i, a.j), vb = side(b.i, b.j);
      if (va >= 0 && left < kMost) kept[left++] = a;
      if ((va >= 0) != (vb >= 0) && left < kMost) {
        const double t = va / (va - vb);
        kept[left++] = {a.i + (b.i - a.i) * t, a.j + (b.j - a.j) * t};
      }
    }
    piece = kept;
    count = left;
  };
  for (std::size_t k = 0; k < 3 && count > 0; ++k) {
    const Sample a = facet.corners[k], b = facet.corners[(k + 1) % 3];
    const double ei = b.i - a.i, ej = b.j - a.j;
    clip({ei * (j - a.j) - ej * (i - a.i), -ej, ei});
  }
  if (outside_any != 0) {
    const auto picture_side = [&](const Linear& of, double sign, double tangent) {
      clip({tangent * depth.value - sign * of.value, tangent * depth.east - sign * of.east,
            tangent * depth.north - sign * of.north});
    };
    if ((outside_any & 1) != 0 && count > 0) picture_side(x, -1, tangent_x_);
    if ((outside_any & 2) != 0 && count > 0) picture_side(x, 1, tangent_x_);
    if ((outside_any & 4) != 0 && count > 0) picture_side(y, -1, tangent_y_);
    if ((outside_any & 8) != 0 && count > 0) picture_side(y, 1, tangent_y_);
  }
  if (count == 0) return;

  double greatest_m = 0, weight = 0, nearest_m = std::numeric_limits<double>::infinity();
  double worst_here = -1;
  Corner worst_at;
  for (std::size_t k = 0; k < count; ++k) {
    const Corner p = piece[k];
    const double delta_m = facet.z(i + p.i, j + p.j) - z(p.i, p.j);
    const double depth_m = depth(p.i, p.j);
    const double here = depth_m > 0
                            ? std::min(weight_px(x(p.i, p.j), y(p.i, p.j), depth_m), greatest_weight_px_)
                            : greatest_weight_px_;
    greatest_m = std::max(greatest_m, std::fabs(delta_m));
    weight = std::max(weight, here);
    nearest_m =
        std::min(nearest_m, depth_m + (PLUMBLINE_MUTANT(gt_displaced_depth_forgotten) ? 0 : delta_m * u_d_));
    if (std::fabs(delta_m) > worst_here) {
      worst_here = std::fabs(delta_m);
      worst_at = p;
    }
  }
  if (greatest_m == 0) return;
  Worst found{nearest_m > 0 ? greatest_m * weight / nearest_m : std::numeric_limits<double>::infinity(), 0};
  if (found.error_px <= enough_px) return;
  // The corner to add: the nearest to where the surfaces are farthest apart.
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_vertex(s[k])) continue;
    const double di = at[k].i - i - worst_at.i, dj = at[k].j - j - worst_at.j;
    if (di * di + dj * dj < least) {
      least = di * di + dj * dj;
      found.sample = s[k];
    }
  }
  if (found.before(worst)) worst = found;
}

}  // namespace plumbline::greedy_tin
