// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scenarios/vec.h"

namespace plumbline::ring_tin {

/// Table 1: outer distances, and tolerances "by pixel"; as option texts.
inline constexpr const char* kRingsTable1 = "100 250 500 1000 2000";
inline constexpr const char* kDeltaTable1 = "0 1 1.2 1.3 1.5";

/// Nested squares around the viewpoint's plan position (§1, Fig. 1b) with what each level may deviate.
struct Rings {
  std::vector<double> half_size_m{100, 250, 500, 1000, 2000};  ///< D_0 < D_1 < …; Table 1
  std::vector<double> delta_px{0, 1, 1.2, 1.3, 1.5};           ///< δ_i; as many
  bool mean_distance = false;  ///< d_i the ring's mean distance (the text) instead of D_i (Table 1)

  [[nodiscard]] int levels() const { return static_cast<int>(half_size_m.size()); }
  /// The first ring that holds p (Chebyshev distance); beyond all: the last level.
  [[nodiscard]] int level(Vec2 viewpoint, Vec2 p) const {
    return level_at(std::max(std::abs(p.x - viewpoint.x), std::abs(p.y - viewpoint.y)));
  }
  [[nodiscard]] int level_at(double distance_m) const {
    int level = 0;
    while (level + 1 < levels() && distance_m > half_size_m[static_cast<std::size_t>(level)]) ++level;
    return level;
  }
  /// Δh_i = δ_i·τ·d_i/f, metres (eq. 1 turned round), f the focal length in pixels.
  [[nodiscard]] double tolerance_m(int level, double threshold_px, double focal_px) const {
    const auto i = static_cast<std::size_t>(level);
    const double inner = i == 0 ? 0 : half_size_m[i - 1];
    const double distance_m = mean_distance ? (inner + half_size_m[i]) / 2 : half_size_m[i];
    return delta_px[i] * threshold_px * distance_m / focal_px;
  }
  friend bool operator==(const Rings&, const Rings&) = default;
};

}  // namespace plumbline::ring_tin
