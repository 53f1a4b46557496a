// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Image error against scenes with an answer in closed form, at several resolutions: where a pixel's figure is
// known, at every pixel; where a figure of the whole picture is, it converges with the order that the theory
// of sampling gives it (2 for means of smooth functions, 1 for maxima, counts and areas), within a bound that
// is derived beside each. Figures in pixels are divided by the picture's height, so that they are one figure
// of the scene whatever the resolution.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "image_scenes.h"

namespace plumbline::oracle {
namespace {

using namespace test;

constexpr std::array kHeights_px{48, 96, 192, 384};
constexpr double kFov_deg = 60;
constexpr double kCameraHeight_m = 1000;
/// A value known in closed form, computed here in another order: some thousand roundings.
constexpr double kRounding = 0x1p-40;
/// Maps are of floats.
constexpr double kFloat = 0x1p-22;

Camera above(int height_px) {
  return make_camera({0, 0, kCameraHeight_m}, {0, 0, 0}, kFov_deg, height_px * 4 / 3, height_px);
}

/// A square of 8 km around the origin at height z = lift + slope · x.
Mesh sheet(double lift_m, double slope = 0) {
  constexpr double a = 4000;
  const auto z = [&](double x) { return lift_m + slope * x; };
  return {{{-a, -a, z(-a)}, {a, -a, z(a)}, {a, a, z(a)}, {-a, a, z(-a)}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Tangents of a pixel's ray to the right and up.
struct Ray {
  double u, v;
};
Ray ray_of(const Camera& camera, int x, int y) {
  return {(x + 0.5 - camera.width_px * 0.5) / camera.kappa_px,
          (camera.height_px * 0.5 - y - 0.5) / camera.kappa_px};
}

/// Checks each pixel's displacement against `expected(u, v)`, in pixels.
template <class Expected>
void expect_pixels(const Camera& camera, const Compared& c, Expected expected) {
  std::size_t wrong = 0;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const Ray r = ray_of(camera, x, y);
      const double px = expected(r.u, r.v);
      wrong += std::fabs(c.maps.displacement_px.at(x, y) - px) <= px * kFloat + 1e-6 ? 0U : 1U;
    }
  }
  EXPECT_EQ(wrong, 0U) << "of " << camera.width_px * camera.height_px << " pixels";
}

/// Errors at successive resolutions, each twice as fine: below bound · (pixel)^order, and shrinking so.
void expect_order(const std::vector<double>& errors, double order, double bound, const char* figure) {
  ASSERT_EQ(errors.size(), kHeights_px.size());
  for (std::size_t k = 0; k < errors.size(); ++k) {
    EXPECT_LE(std::fabs(errors[k]), bound * std::pow(1.0 / kHeights_px[k], order))
        << figure << " at " << kHeights_px[k];
  }
}
/// The same, and the observed order from the first to the last is what it should be, within a quarter.
void expect_exact_order(const std::vector<double>& errors, double order, double bound, const char* figure) {
  expect_order(errors, order, bound, figure);
  const double halvings = static_cast<double>(errors.size() - 1);
  EXPECT_NEAR(std::log2(std::fabs(errors.front() / errors.back())) / halvings, order, 0.25) << figure;
}

const double kTangent = 0.5 / (above(48).kappa_px / 48);  ///< of half the field of view, upwards
const double kAspect = 4.0 / 3;

TEST(ImageConvergence, LiftedPlaneFromAbove) {
  // Mesh h above the ground, camera H above it: displacement r·h/(H − h) at r px from the middle. Mean r over
  // a rectangle of half sides a, b with diagonal d: d/3 + a²/(6b)·ln((b + d)/a) + b²/(6a)·ln((a + d)/b).
  const double lift_m = 20, factor = lift_m / (kCameraHeight_m - lift_m);
  const double a = kAspect / 2, b = 0.5, d = std::sqrt(a * a + b * b);
  const double mean =
      factor * (d / 3 + a * a / (6 * b) * std::log((b + d) / a) + b * b / (6 * a) * std::log((a + d) / b));
  const double rms = factor * std::sqrt((a * a + b * b) / 3);
  std::vector<double> of_mean, of_rms, of_max;
  for (const int height : kHeights_px) {
    const Camera camera = above(height);
    const Compared c = compare(camera, sheet(0), sheet(lift_m));
    expect_pixels(camera, c,
                  [&](double u, double v) { return camera.kappa_px * std::sqrt(u * u + v * v) * factor; });
    const PixelFigure& px = c.error.displacement_px;
    EXPECT_EQ(px.count, static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(height));
    of_mean.push_back(px.mean / height - mean);
    of_rms.push_back(px.rms / height - rms);
    of_max.push_back(px.max / height - factor * d);
    EXPECT_LT(of_max.back(), 0) << "no pixel's centre is farther out than the corner";
  }
  // Midpoint rule: p²/24 · mean of ∂xx + ∂yy = 1/r, whose mean over the rectangle is below 2π·d / (4ab) ≈ 4.
  expect_exact_order(of_mean, 2, factor * 4 / 24, "mean");
  // Mean of x² by midpoints is low by p²/12 on each axis: of the rms, p²/12 / rms(r).
  expect_exact_order(of_rms, 2, factor / 12 / std::sqrt((a * a + b * b) / 3) * 1.01, "rms");
  expect_exact_order(of_max, 1, factor * std::sqrt(0.5) * 1.01, "max: half a pixel's diagonal");
}

TEST(ImageConvergence, TiltedPlaneFromAbove) {
  // Mesh z = s·x over the ground: S = H·(u, v), S′ at height s·u·H, depth H·(1 − s·u): displacement
  // κ·√(u² + v²)·|s·u / (1 − s·u)|. The same ray meets the mesh at depth H / (1 + s·u), so that the parallax
  // is κ·0.01·|s·u| and the depths differ by |s·u| / (1 + s·u).
  const double slope = 0.1;
  const double u_max = kTangent * kAspect, v_max = kTangent;
  const double sup =
      std::sqrt(u_max * u_max + v_max * v_max) * slope * u_max / (1 - slope * u_max) / (2 * kTangent);
  std::vector<double> of_max, of_parallax, of_depth;
  for (const int height : kHeights_px) {
    const Camera camera = above(height);
    const Compared c = compare(camera, sheet(0), sheet(0, slope));
    expect_pixels(camera, c, [&](double u, double v) {
      return camera.kappa_px * std::sqrt(u * u + v * v) * std::fabs(slope * u / (1 - slope * u));
    });
    of_max.push_back(c.error.displacement_px.max / height - sup);
    // Known to the rounding at every resolution: |u| is linear on either side of an even number of columns.
    const double w = camera.width_px;
    EXPECT_NEAR(c.error.parallax_px.mean, 0.01 * slope * w / 4, w * kRounding);
    EXPECT_NEAR(c.error.parallax_px.rms, 0.01 * slope * std::sqrt((w * w - 1) / 12), w * kRounding);
    EXPECT_NEAR(c.error.parallax_px.max, 0.01 * slope * (w - 1) / 2, w * kRounding);
    of_parallax.push_back(c.error.parallax_px.max / height - 0.01 * slope * kAspect / 2);
    const double west = slope * u_max;  // there the mesh lies lowest, and the depths differ most
    of_depth.push_back(c.error.depth_rel.max - west / (1 - west));
  }
  // Half a pixel's diagonal times the steepest slope, at the corner: u + v parts of r·su/(1 − su), below
  // 2·s·r_max·(1 + …) ≤ 0.5 of a pixel for these numbers, and a half for the bend of it.
  expect_exact_order(of_max, 1, 0.5, "max");
  expect_exact_order(of_parallax, 1, 0.01 * slope * 0.5 * 1.01, "parallax: half a column");
  expect_exact_order(of_depth, 1, slope * 2 * kTangent * 0.5 * 1.25, "depth: half a column of s·u/(1 − s·u)");
}

TEST(ImageConvergence, AStepFromAbove) {
  // Ground at 0 west and at h east of a wall under the camera; the mesh is flat. West nothing is displaced;
  // east S stands h high, S′ below it: r·h/H. Above τ: what lies outside the half circle of τ·H/h.
  const double step_m = 50, factor = step_m / kCameraHeight_m;
  constexpr double a = 4000;
  const Mesh step{{{-a, -a, 0},
                   {0, -a, 0},
                   {0, a, 0},
                   {-a, a, 0},
                   {0, -a, step_m},
                   {a, -a, step_m},
                   {a, a, step_m},
                   {0, a, step_m}},
                  {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {1, 4, 7}, {1, 7, 2}}};
  constexpr double kRadius = 0.4;  // of the circle, in picture heights: inside the picture
  const double share = 0.5 * (1 - 3.141592653589793 * kRadius * kRadius / kAspect);
  std::vector<double> of_share, of_max;
  for (const int height : kHeights_px) {
    const Camera camera = above(height);
    const Compared c = compare(camera, step, sheet(0), kRadius * height * factor);
    expect_pixels(camera, c, [&](double u, double v) {
      return u < 0 ? 0 : camera.kappa_px * std::sqrt(u * u + v * v) * factor;
    });
    of_share.push_back(c.error.over_threshold - share);
    of_max.push_back(c.error.displacement_px.max / height - factor * std::sqrt(kAspect * kAspect + 1) / 2);
    EXPECT_NEAR(c.error.depth_rel.max, step_m / (kCameraHeight_m - step_m), kRounding);
    EXPECT_NEAR(c.error.depth_rel.mean, 0.5 * step_m / (kCameraHeight_m - step_m), kRounding) << "half of it";
  }
  // Only pixels that the half circle passes through can be told wrongly: at most π·r·√2 + 2 rows of them.
  expect_order(of_share, 1, (3.15 * kRadius * 1.42 + 2) / kAspect, "share above the threshold");
  expect_exact_order(of_max, 1, factor * std::sqrt(0.5) * 1.01, "max");
}

TEST(ImageConvergence, ACapFromAbove) {
  // A paraboloid z = c·(R² − ρ²) on flat ground, under the camera: S = (ρ, 0), S′ at z: κ·(ρ/H)·z/(H − z).
  // The mesh interpolates it on a lattice of d: at most c·d²/2 too low (the middle of a right triangle's
  // longest side), which shows as less than twice its share of H − z.
  constexpr double kRadius_m = 400, kTop_m = 100, c = kTop_m / (kRadius_m * kRadius_m);
  const auto displacement = [&](double rho_m) {  // in tangents
    const double z = std::max(0.0, c * (kRadius_m * kRadius_m - rho_m * rho_m));
    return rho_m / kCameraHeight_m * z / (kCameraHeight_m - z);
  };
  double sup = 0;  // by dense search; its maximum is flat, so a step of 2⁻⁸ m leaves less than 10⁻⁹ of it
  for (double rho = 0; rho < kRadius_m; rho += 0x1p-8) sup = std::max(sup, displacement(rho));
  std::vector<double> errors;
  int lattice = 16;
  for (const int height : kHeights_px) {
    const Camera camera = above(height);
    const double d = 1024.0 / lattice;
    Mesh cap = reference_mesh(terrain_of(lattice + 1, lattice + 1, d, [&](int i, int j) {
      const double x = i * d - 512, y = j * d - 512;
      return c * (kRadius_m * kRadius_m - x * x - y * y);  // below ground outside, where nothing is asked
    }));
    for (Vec3& p : cap.positions) p = p - Vec3{512, 512, 0};
    const Compared compared = compare(camera, sheet(0), cap);
    double worst = 0, greatest = 0;
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const Ray r = ray_of(camera, x, y);
        const double rho = kCameraHeight_m * std::sqrt(r.u * r.u + r.v * r.v);
        if (rho > kRadius_m - 2 * d) continue;
        const double px = compared.maps.displacement_px.at(x, y);
        worst = std::max(worst, std::fabs(px / camera.kappa_px - displacement(rho)));
        greatest = std::max(greatest, px / camera.kappa_px);
      }
    }
    // d(disp)/dz = (ρ/H)·H/(H − z)² ≤ (R/H)·H/(H − top)²; times c·d²/2.
    const double sag_m = c * d * d / 2;
    const double per_m = kRadius_m / ((kCameraHeight_m - kTop_m) * (kCameraHeight_m - kTop_m));
    EXPECT_LE(worst, sag_m * per_m + kFloat) << height;
    EXPECT_GE(worst, sag_m * per_m / 100) << height << ": the facets must be seen";
    errors.push_back(greatest - sup);
    lattice *= 2;
  }
  // Two errors of second order: the facets' sag, as above, with d = 64 m · 48/height; and, since at its
  // maximum a function is flat, half its bend (in tangents 6·c·ρ < 1 at ρ = R/√3) times the square of half a
  // pixel's diagonal, p/√2 with p = 2·kTangent/height.
  const double sag =
      c * 64 * 64 / 2 * 48 * 48 * kRadius_m / ((kCameraHeight_m - kTop_m) * (kCameraHeight_m - kTop_m));
  const double bend = 0.5 * 0.5 * 4 * kTangent * kTangent;
  expect_order(errors, 2, sag + bend, "max of the cap");
}

/// A wall 100 m away whose top edge rises from `left` to `right` (heights over the horizon), 200 m wide.
Mesh wall(double left_m, double right_m) {
  return {{{-100, 100, -200}, {100, 100, -200}, {100, 100, right_m}, {-100, 100, left_m}},
          {{0, 1, 2}, {0, 2, 3}}};
}

TEST(ImageConvergence, AWallAgainstTheSky) {
  // Two walls whose top edges run parallel, δ one below the other at distance D: a strip of height κ·δ/D px
  // across the picture. Silhouettes differ in its pixels. Inside the picture a pixel is κ·δ/D·cos(slope) off
  // at most; at its right side, where the foot of that way lies beside the picture, κ·δ/D.
  const double slope = 0.3, lower_m = 12, distance_m = 100;
  std::vector<double> of_count, of_distance;
  for (const int height : kHeights_px) {
    const Camera camera = make_camera({0, 0, 0}, {0, 100, 0}, kFov_deg, height * 4 / 3, height);
    const auto top = [&](double x, double drop) { return slope * x - drop; };
    const Compared c =
        compare(camera, wall(top(-100, 0), top(100, 0)), wall(top(-100, lower_m), top(100, lower_m)));
    const double strip_px = camera.kappa_px * lower_m / distance_m;
    of_count.push_back(static_cast<double>(c.error.silhouette_pixels) /
                           (camera.width_px * double{1} * height) -
                       strip_px / height);
    of_distance.push_back((c.error.silhouette_max_px - strip_px) / height);
    const Compared back =
        compare(camera, wall(top(-100, lower_m), top(100, lower_m)), wall(top(-100, 0), top(100, 0)));
    EXPECT_EQ(back.error.silhouette_pixels, c.error.silhouette_pixels);
    EXPECT_EQ(back.error.silhouette_max_px, c.error.silhouette_max_px);
  }
  // In each column the strip's rows are counted within one.
  expect_order(of_count, 1, 1, "pixels of the strip");
  expect_order(of_distance, 1, 1, "distance of silhouettes: so many rows");
}

TEST(ImageConvergence, AHoleFromAbove) {
  // A square of side a left out around the point under the camera: uncovered is (a·κ/H)² px.
  const double side_m = 300, h = side_m / 2;
  constexpr double a = 4000;
  Mesh holed;
  for (const double r : {a, h})
    holed.positions.insert(holed.positions.end(), {{-r, -r, 0}, {r, -r, 0}, {r, r, 0}, {-r, r, 0}});
  holed.triangles = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const double share =
      side_m * side_m / (kCameraHeight_m * kCameraHeight_m * 4 * kTangent * kTangent * kAspect);
  std::vector<double> of_share;
  for (const int height : kHeights_px) {
    const Camera camera = above(height);
    const Compared c = compare(camera, sheet(0), holed);
    const double pixels = camera.width_px * double{1} * height;
    of_share.push_back(static_cast<double>(c.error.uncovered_px) / pixels - share);
    EXPECT_EQ(c.error.displacement_px.count + c.error.uncovered_px, static_cast<std::size_t>(pixels));
    EXPECT_EQ(c.error.displacement_px.max, 0);
  }
  // The four sides, each pixel of them told wrongly at worst.
  const double side = side_m / (kCameraHeight_m * 2 * kTangent);
  expect_order(of_share, 1, 4 * side / kAspect, "uncovered");
}

TEST(ImageConvergence, PopOfALiftedPlane) {
  // From the ground to h above it in one frame, seen from H: r·h/H, at every pixel's r.
  const RayDevice device;
  const double lift_m = 30;
  const double rms = lift_m / kCameraHeight_m * std::sqrt((kAspect * kAspect + 1) / 12);
  std::vector<double> of_rms;
  for (const int height : kHeights_px) {
    const Camera camera = above(height);
    const Mesh low = sheet(0), high = sheet(lift_m);
    const RaySurface now(device, high), before(device, low);
    const PixelFigure px = pop(camera, now, now.look(camera), before);
    of_rms.push_back(px.rms / height - rms);
    const double corner =
        std::sqrt((camera.width_px - 1.0) * (camera.width_px - 1.0) + (height - 1.0) * (height - 1.0)) / 2;
    EXPECT_NEAR(px.max, corner * lift_m / kCameraHeight_m, corner * kRounding);
  }
  expect_exact_order(of_rms, 2,
                     lift_m / kCameraHeight_m / 12 / std::sqrt((kAspect * kAspect + 1) / 12) * 1.01, "rms");
}

}  // namespace
}  // namespace plumbline::oracle
