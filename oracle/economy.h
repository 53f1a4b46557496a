// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "oracle/image.h"
#include "scenarios/camera.h"

namespace plumbline::oracle {

/// O4's slack (ORACLES O4): how many of a mesh's vertices a scene does not need.
///
/// A vertex is *removable* if it can be taken out, alone, without any pixel going over τ: its star is filled
/// with triangles between its neighbours, and no pixel in it that was at most at τ comes over it, nor does
/// one that was over it get worse. The star is filled by cutting ears, of those that are positively oriented
/// and hold no other neighbour the one of the best quality in plan first, of equally good ones that with the
/// highest tip. So the figure is a lower bound: another filling might do where this one does not.
///
/// Not judged, and counted as kept: vertices whose star is no disc in plan (a triangle turned over, an edge
/// with a third triangle, a fan that comes round twice) or has more than kLargestStar neighbours, and those
/// on the outline, unless they lie inside a straight stretch of it.
struct Slack {
  static constexpr std::size_t kLargestStar = 128;  ///< cutting ears takes the cube of this
  std::size_t vertices = 0;
  std::size_t removable = 0;
  std::size_t in_view = 0;            ///< vertices with a pixel in their star
  std::size_t removable_in_view = 0;  ///< of these
  std::size_t not_judged = 0;         ///< for their star's sake
  /// Of all vertices, and of those in view; 0 where there are none.
  [[nodiscard]] double share() const { return ratio(removable, vertices); }
  [[nodiscard]] double share_in_view() const { return ratio(removable_in_view, in_view); }

 private:
  static double ratio(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
  }
};

/// Measures the slack of `mesh` against `reference` as the pixels of `reference_hits` see it. Displacements
/// are O3's, in double. A pixel belongs to the one triangle that its vertical look-up finds. `removable`, if
/// asked for, gets 1 for each vertex that is. Deterministic; one thread. Throws std::invalid_argument if the
/// hits are not of the camera's size.
Slack measure_slack(const Camera& camera, const RaySurface& reference, const PixelHits& reference_hits,
                    const RaySurface& mesh, double threshold_px,
                    std::vector<std::uint8_t>* removable = nullptr);

}  // namespace plumbline::oracle
