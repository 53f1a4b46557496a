// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faults for O3 and O4: level ground, where each pixel's answer is known in closed form.
#include <algorithm>
#include <array>
#include <cmath>

#include "properties/faults/measured_faults.h"
#include "properties/faults/sound_meshes.h"

namespace plumbline::faults {
namespace {

constexpr int kSide = 17;
constexpr double kSpacing_m = 10;
constexpr int kWidth_px = 96, kHeight_px = 72;

/// Relative: what a displacement of a pixel loses by a dozen roundings on coordinates some thousand times the
/// figure.
constexpr double kPictureRounding = 1e-9;
/// A pixel whose ray meets an edge more closely than this (share of the triangle's height) could be counted
/// on either side: such a scene is drawn anew.
constexpr double kTooCloseToTell = 1e-9;

Terrain level_ground() {
  Terrain terrain;
  terrain.columns = terrain.rows = kSide;
  terrain.spacing_m = kSpacing_m;
  terrain.heights_m.assign(static_cast<std::size_t>(kSide) * kSide, 0.0);
  return terrain;
}

int inner(Random& random) { return 1 + static_cast<int>(random.below(kSide - 2)); }

/// Looks straight down from somewhere above the middle; the whole picture shows ground.
Camera from_above(Random& random) {
  const double x = 80 + random.between(-5, 5), y = 80 + random.between(-5, 5), z = random.between(80, 110);
  return make_camera({x, y, z}, {x, y, 0}, 60, kWidth_px, kHeight_px);
}

/// Where a pixel's ray meets the ground.
Vec2 ground_at(const Camera& camera, int px, int py) {
  const Vec3 ray = camera.ray_direction(px + 0.5, py + 0.5);
  const double t = -camera.position.z / ray.z;
  return {camera.position.x + ray.x * t, camera.position.y + ray.y * t};
}

double cross2(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Barycentric coordinates of p, the least of them; negative outside.
double depth_inside(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  const double all = cross2(b - a, c - a);
  return std::min({cross2(b - p, c - p) / all, cross2(c - p, a - p) / all, cross2(a - p, b - p) / all});
}

/// A block of vertices lifted by h under a camera straight above: a point of it at distance r from the foot
/// of the camera, at height H, shows κ r (1/(H − h) − 1/H) further out.
std::optional<Tally> lifted_block(const Judges& judges, Random& random) {
  const Terrain terrain = level_ground();
  const Mesh reference = reference_mesh(terrain);
  Mesh mesh = reference;
  const int west = 1 + static_cast<int>(random.below(10)), south = 1 + static_cast<int>(random.below(10));
  const int east = west + 2 + static_cast<int>(random.below(4)),
            north = south + 2 + static_cast<int>(random.below(4));
  const double lift_m = random.between(0.5, 8);
  for (int j = south; j <= north; ++j) {
    for (int i = west; i <= east; ++i) mesh.positions[terrain.index(i, j)].z = lift_m;
  }
  const Camera camera = from_above(random);
  const PictureVerdict verdict = judges.picture(camera, reference, mesh, 1);
  const auto within = [&](Vec2 p, double margin_cells) {
    return p.x > (west - margin_cells) * kSpacing_m && p.x < (east + margin_cells) * kSpacing_m &&
           p.y > (south - margin_cells) * kSpacing_m && p.y < (north + margin_cells) * kSpacing_m;
  };
  double largest_px = 0;
  bool reported = false, size = true, place = true, elsewhere = false;
  std::size_t judged = 0;
  for (int py = 0; py < kHeight_px; ++py) {
    for (int px = 0; px < kWidth_px; ++px) {
      const Vec2 p = ground_at(camera, px, py);
      const double shown_px = verdict.displacement_px.at(px, py);
      const Vec2 aside = p - Vec2{camera.position.x, camera.position.y};
      const double r = std::sqrt(aside.x * aside.x + aside.y * aside.y);
      const double h = camera.position.z;
      const double wanted_px = camera.kappa_px * r * (1 / (h - lift_m) - 1 / h);
      if (within(p, 0)) {
        ++judged;
        largest_px = std::max(largest_px, wanted_px);
        // The map holds floats.
        if (std::fabs(shown_px - wanted_px) > wanted_px * 0x1p-23 + kPictureRounding) place = false;
        if (shown_px > 0) reported = true;
      } else if (!within(p, 1) && shown_px > kPictureRounding) {
        elsewhere = true;
      }
    }
  }
  if (judged == 0) return std::nullopt;
  // The slopes around it are lower than the block, but may stand further out: up to a cell.
  const double beyond_px = camera.kappa_px * std::sqrt(2.0) * kSpacing_m *
                           (1 / (camera.position.z - lift_m) - 1 / camera.position.z);
  const double max_px = verdict.error.displacement_px.max;
  size = max_px >= largest_px * (1 - kPictureRounding) && max_px <= largest_px + beyond_px;
  return tally(false, reported, size, place, elsewhere);
}

/// A triangle that is missing: its pixels have nothing over them, and see the sky.
std::optional<Tally> missing_triangle(const Judges& judges, Random& random) {
  const Mesh reference = reference_mesh(level_ground());
  Mesh mesh = reference;
  const std::size_t t = random.below(mesh.triangles.size());
  const auto corners = mesh.triangles[t];
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
  const Camera camera = from_above(random);
  const auto plan = [&](std::size_t k) {
    const Vec3 p = reference.positions[corners[k]];
    return Vec2{p.x, p.y};
  };
  std::size_t missing = 0;
  for (int py = 0; py < kHeight_px; ++py) {
    for (int px = 0; px < kWidth_px; ++px) {
      const double depth = depth_inside(ground_at(camera, px, py), plan(0), plan(1), plan(2));
      if (std::fabs(depth) < kTooCloseToTell) return std::nullopt;
      if (depth > 0) ++missing;
    }
  }
  if (missing == 0) return std::nullopt;
  const oracle::ImageError error = judges.picture(camera, reference, mesh, 1).error;
  return tally(false, error.uncovered_px > 0,
               error.uncovered_px == missing && error.silhouette_pixels == missing, true,
               error.displacement_px.max > kPictureRounding);
}

/// A vertex that stands up against the sky: the pixels that its six triangles cover above the ground's own
/// outline, counted by projecting them.
std::optional<Tally> peak_in_the_sky(const Judges& judges, Random& random) {
  const Terrain terrain = level_ground();
  const Mesh reference = reference_mesh(terrain);
  Mesh mesh = reference;
  const auto peak = static_cast<std::uint32_t>(terrain.index(inner(random), inner(random)));
  mesh.positions[peak].z = random.between(30, 60);
  const Camera camera = make_camera({80 + random.between(-20, 20), random.between(-120, -60), 12},
                                    {80 + random.between(-5, 5), 80, 10}, 60, kWidth_px, kHeight_px);
  std::vector<std::array<Vec2, 3>> shown;
  for (const auto& corners : mesh.triangles) {
    if (std::find(corners.begin(), corners.end(), peak) == corners.end()) continue;
    std::array<Vec2, 3> picture;
    for (std::size_t k = 0; k < 3; ++k) picture[k] = camera.project(mesh.positions[corners[k]]);
    if (std::fabs(cross2(picture[1] - picture[0], picture[2] - picture[0])) < kTooCloseToTell)
      return std::nullopt;
    shown.push_back(picture);
  }
  std::size_t in_the_sky = 0;
  for (int py = 0; py < kHeight_px; ++py) {
    for (int px = 0; px < kWidth_px; ++px) {
      const Vec3 ray = camera.ray_direction(px + 0.5, py + 0.5);
      if (ray.z < 0) {
        const Vec2 p = ground_at(camera, px, py);
        const double inside_m = std::min({p.x, p.y, terrain.width_m() - p.x, terrain.depth_m() - p.y});
        if (std::fabs(inside_m) < kTooCloseToTell) return std::nullopt;
        if (inside_m > 0) continue;
      }
      double depth = -1;
      for (const auto& [a, b, c] : shown) {
        const double inside = depth_inside({px + 0.5, py + 0.5}, a, b, c);
        if (std::fabs(inside) < kTooCloseToTell) return std::nullopt;
        depth = std::max(depth, inside);
      }
      if (depth > 0) ++in_the_sky;
    }
  }
  if (in_the_sky == 0) return std::nullopt;
  const oracle::ImageError error = judges.picture(camera, reference, mesh, 1).error;
  return tally(false, error.silhouette_pixels > 0, error.silhouette_pixels == in_the_sky,
               error.silhouette_max_px >= 1, error.uncovered_px > 0);
}

std::optional<Tally> same_picture(const Judges& judges, Random& random) {
  const Mesh reference = reference_mesh(random_terrain(kSide, kSpacing_m, 8, random));
  const oracle::ImageError error = judges.picture(from_above(random), reference, reference, 1).error;
  return tally(true, error.displacement_px.max > 0 || error.parallax_px.max > 0 || error.depth_rel.max > 0,
               false, false,
               error.uncovered_px > 0 || error.silhouette_pixels > 0 || error.displacement_px.count == 0);
}

/// Level ground from aside, all of it in the picture.
Camera from_aside(Random& random) {
  return make_camera({80 + random.between(-20, 20), -130, 180}, {80, 80, 0}, 60, kWidth_px, kHeight_px);
}

/// A peak of the terrain, met by one vertex alone: that vertex is no slack, and flat ground beside it is.
std::optional<Tally> needed_vertex(const Judges& judges, Random& random) {
  Terrain terrain = level_ground();
  const int i = inner(random), j = inner(random);
  terrain.heights_m[terrain.index(i, j)] = random.between(15, 30);
  const Mesh mesh = reference_mesh(terrain);
  const SlackVerdict verdict = judges.slack(from_aside(random), mesh, mesh, 0.5);
  bool elsewhere = false;
  for (int b = 1; b + 1 < kSide; ++b) {
    for (int a = 1; a + 1 < kSide; ++a) {
      if (std::abs(a - i) <= 1 && std::abs(b - j) <= 1) continue;
      if (verdict.removable[terrain.index(a, b)] == 0) elsewhere = true;
    }
  }
  return tally(false, verdict.removable[terrain.index(i, j)] == 0, true, true, elsewhere);
}

std::optional<Tally> nothing_needed(const Judges& judges, Random& random) {
  const Mesh mesh = reference_mesh(level_ground());
  const SlackVerdict verdict = judges.slack(from_aside(random), mesh, mesh, 0.5);
  // All but the four corners.
  return tally(true, verdict.slack.removable + 4 != verdict.slack.vertices, false, false,
               verdict.slack.not_judged > 0);
}

/// None of these needs a closed mesh.
template <std::optional<Tally> (*plant)(const Judges&, Random&)>
std::optional<Tally> trial(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  return plant(judges, random);
}

}  // namespace

std::vector<MeasuredFault> picture_faults() {
  constexpr auto kImage = "O3 image error", kEconomy = "O4 economy";
  return {
      {kImage, "block_lifted", "a block 1/2 to 8 m too high, from straight above: every pixel of it", false,
       trial<lifted_block>},
      {kImage, "triangle_missing", "its pixels are uncovered and see the sky, counted", false,
       trial<missing_triangle>},
      {kImage, "peak_in_the_sky", "a vertex above the horizon: silhouette pixels, counted", false,
       trial<peak_in_the_sky>},
      {kImage, "same_picture", "the reference itself: exactly 0", true, trial<same_picture>},
      {kEconomy, "vertex_needed", "a peak with one vertex, amid flat ground: no slack", false,
       trial<needed_vertex>},
      {kEconomy, "plane", "level ground: all but the corners is slack", true, trial<nothing_needed>},
  };
}

}  // namespace plumbline::faults
