// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/greedy_tin/delaunay.h"
#include "scenarios/camera.h"
#include "scenarios/terrain.h"

// How far the picture shows a point of the terrain displaced. In the camera's frame (right, up, forward) the
// point is S = (X, Y, D), the vertical u = (u_x, u_y, u_d), and the network passes δ above S. Then
//   ‖π(S + δu) − π(S)‖ = κ·|δ|·g / (D + δ·u_d),   g = ‖(u_x − u_d·X/D, u_y − u_d·Y/D)‖
// exactly. g is a convex function of the picture's point, so over a region of the picture it is greatest at a
// corner; on a piece of the plan where terrain and network are both flat, δ and D are linear. Hence
//   κ · max|δ| · max g / min(D + δ·u_d),   each over the piece's corners, bounds the piece.

namespace plumbline::greedy_tin {

/// A triangle of the network as a function on the grid.
struct Facet {
  std::array<Sample, 3> corners;
  double z0_m = 0, east_m = 0, north_m = 0;  ///< height at corners[0], and its change per cell
  [[nodiscard]] double z(double i, double j) const {
    return z0_m + east_m * (i - corners[0].i) + north_m * (j - corners[0].j);
  }
};
Facet make_facet(const Terrain& terrain, const std::array<Sample, 3>& corners);

/// Where an error is largest, and which sample to add for it.
struct Worst {
  double error_px = 0;
  std::size_t sample = 0;
  [[nodiscard]] bool before(const Worst& other) const {
    return error_px != other.error_px ? error_px > other.error_px : sample < other.sample;
  }
};

/// The terrain as one camera sees it.
class Scene {
 public:
  /// Work, added up.
  std::uint64_t samples_scanned = 0, pieces_bounded = 0;

  void look(const Terrain& terrain, const Camera& camera);
  void add_vertex(std::size_t sample) {
    vertex_[sample] = 1;
    scanned_[sample].weight_px = 0;
  }
  [[nodiscard]] bool is_vertex(std::size_t sample) const { return vertex_[sample] != 0; }
  /// The greatest displacement, pixels, of a sample in the picture that the facet covers and that is no
  /// vertex.
  Worst worst_sample(const Facet& facet);
  /// A bound for every point of the terrain in the picture that the facet covers, pixels; +∞ where the facet
  /// passes through the camera's plane. If it is above `enough_px`, `sample` is one to add.
  Worst worst_piece(const Facet& facet, double enough_px);

 private:
  struct Seen {
    double x = 0, y = 0, depth_m = 0;  ///< metres in the camera's frame
  };
  /// What a scan reads, side by side.
  struct Scanned {
    double z_m = 0, depth_m = 0;
    double weight_px = 0;  ///< κ·g; 0: a vertex, or outside of the picture
  };
  struct Range {
    int begin = 0, end = 0;
  };
  struct Corner;
  struct Half;
  [[nodiscard]] double weight_px(double x, double y, double depth_m) const;
  void bound_half(const Facet& facet, int i, int j, bool upper, double enough_px, Worst& worst);

  const Terrain* terrain_ = nullptr;
  double kappa_px_ = 0, tangent_x_ = 0, tangent_y_ = 0;
  double greatest_weight_px_ = 0;  ///< κ·g at the picture's corners
  double u_x_ = 0, u_y_ = 0, u_d_ = 0;
  std::vector<Seen> seen_;            ///< by sample
  std::vector<Scanned> scanned_;      ///< by sample
  std::vector<std::uint8_t> sides_;   ///< by sample: outside of which sides of the picture
  std::vector<std::uint8_t> vertex_;  ///< by sample
  std::vector<Range> sample_range_;   ///< by row: columns with weight
  std::vector<Range> cell_range_;     ///< by row of cells: columns of cells that may reach into the picture
};

}  // namespace plumbline::greedy_tin
