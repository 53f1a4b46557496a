// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// M3, isolated division of a tiled quadtree.
// Zhang, Yao: "LOD algorithm of terrain based on conservative screen error and isolated division of quadtree"
// (in Chinese), 2013. Implemented here: tiles with conservative geometric errors (bottom-up), the screen
// error with and without its cosine, isolated division of the visible tiles in row-major order, crack removal
// inside tiles (split points) and between them (split points or height averaging against the upper and left
// neighbour). Promises: METHODS M3.C1–C5. Departures, with reasons: a node is drawn as a fan of eight
// triangles over its nine samples (the paper shows no drawing; its 8.7 triangles a node confirm it); ΔZ is
// absolute. "Upper" is north, "left" is west.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "algorithms/isolated_quadtree/tile_grid.h"
#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using isolated_quadtree::Node;
using isolated_quadtree::TileGrid;

/// Whether the box lies wholly on the outer side of one plane of the frustum.
bool outside_frustum(const Camera& camera, Vec3 low, Vec3 high) {
  const double tan_x = camera.width_px * 0.5 / camera.kappa_px;
  const double tan_y = camera.height_px * 0.5 / camera.kappa_px;
  std::array<int, 5> outside{};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 v =
        Vec3{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z} -
        camera.position;
    const double depth = dot(v, camera.forward);
    const double x = dot(v, camera.right());
    const double y = dot(v, camera.up);
    outside[0] += x > depth * tan_x ? 1 : 0;
    outside[1] += -x > depth * tan_x ? 1 : 0;
    outside[2] += y > depth * tan_y ? 1 : 0;
    outside[3] += -y > depth * tan_y ? 1 : 0;
    outside[4] += depth <= 0 ? 1 : 0;
  }
  return std::find(outside.begin(), outside.end(), 8) != outside.end();
}

/// Which samples of a tile's south and east border are drawn: what its lower and right neighbours adapt to.
struct Border {
  std::vector<std::uint8_t> south, east;
  bool visible = false;
};

class IsolatedQuadtree final : public LodMethod {
 public:
  IsolatedQuadtree(int tile_size, bool with_cosine) : tile_size_(tile_size), with_cosine_(with_cosine) {}

  void prepare(const Terrain& terrain) override {
    int side = tile_size_ - 1;
    const int longest = std::max(terrain.columns, terrain.rows) - 1;
    while (side / 2 >= longest && side > 2) side /= 2;  // one tile is enough
    grid_ = std::make_shared<const TileGrid>(terrain, side);
    vertex_.clear();
  }

  void update(const Camera& camera, LodFrame& frame) override {
    frame.clear();
    const Terrain& terrain = grid_->terrain();
    if (vertex_.empty()) {
      vertex_.resize(terrain.heights_m.size());
      stamp_.assign(terrain.heights_m.size(), 0);
      const auto across = static_cast<std::size_t>(grid_->tile_side() + 1);
      mark_.assign(across * across, 0);
    }
    ++now_;
    camera_ = &camera;
    frame_ = &frame;
    borders_.assign(static_cast<std::size_t>(grid_->tiles_x()) * static_cast<std::size_t>(grid_->tiles_y()),
                    {});
    for (int b = grid_->tiles_y() - 1; b >= 0; --b) {
      for (int a = 0; a < grid_->tiles_x(); ++a) draw_tile(a, b);
    }
    camera_ = nullptr;
    frame_ = nullptr;
  }

  void reset() override {}

  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    auto copy = std::make_unique<IsolatedQuadtree>(tile_size_, with_cosine_);
    copy->grid_ = grid_;
    copy->set_threshold_px(threshold_px());
    return copy;
  }

 private:
  [[nodiscard]] Border& border(int a, int b) {
    return borders_[static_cast<std::size_t>(b) * static_cast<std::size_t>(grid_->tiles_x()) +
                    static_cast<std::size_t>(a)];
  }

  void draw_tile(int a, int b) {
    const Terrain& terrain = grid_->terrain();
    tile_ = grid_->tile(a, b);
    const Vec2 low{tile_.i * terrain.spacing_m, tile_.j * terrain.spacing_m};
    const Vec2 high{std::min(tile_.i + tile_.side, terrain.columns - 1) * terrain.spacing_m,
                    std::min(tile_.j + tile_.side, terrain.rows - 1) * terrain.spacing_m};
    if (outside_frustum(*camera_, {low.x, low.y, grid_->lowest_m(a, b)},
                        {high.x, high.y, grid_->highest_m(a, b)})) {
      return;
    }
    ++frame_->counters.tiles;
    frame_->domain.add_rectangle(low, high);

    drawn_.clear();
    divide(tile_);
    adapt_to_neighbours(a, b);
    for (const Node& node : drawn_) draw(node);
    frame_->counters.drawn += drawn_.size();

    Border& mine = border(a, b);
    mine.visible = true;
    mine.south.resize(static_cast<std::size_t>(tile_.side + 1));
    mine.east.resize(mine.south.size());
    for (int k = 0; k <= tile_.side; ++k) {
      mine.south[static_cast<std::size_t>(k)] = mark(tile_.i + k, tile_.j);
      mine.east[static_cast<std::size_t>(k)] = mark(tile_.i + tile_.side, tile_.j + k);
    }
    for (const std::size_t slot : marked_) mark_[slot] = 0;
    marked_.clear();
  }

  /// Isolated division (§2.3): each node decides alone. A node with no-data always splits; no-data is never
  /// drawn.
  void divide(Node node) {
    const Terrain& terrain = grid_->terrain();
    if (node.i + 1 >= terrain.columns || node.j + 1 >= terrain.rows) return;  // no triangle of data in it
    ++frame_->counters.visited;
    const bool whole = grid_->whole(node);
    if (node.side > 2 && (!whole || splits(node))) {
      ++frame_->counters.split;
      const int h = node.half();
      divide({node.i, node.j + h, h});
      divide({node.i + h, node.j + h, h});
      divide({node.i, node.j, h});
      divide({node.i + h, node.j, h});
      return;
    }
    drawn_.push_back(node);
    const int h = node.half();
    for (int dj = 0; dj <= 2; ++dj) {
      for (int di = 0; di <= 2; ++di) {
        const int i = node.i + di * h;
        const int j = node.j + dj * h;
        if (grid_->has_data(i, j) && (whole || grid_->has_data(node.i + h, node.j + h))) set_mark(i, j);
      }
    }
  }

  /// e_s = κ·e_n·cos β / d > τ (§2.2).
  [[nodiscard]] bool splits(Node node) const {
    ++frame_->counters.evaluated;
    const Vec3 way = grid_->terrain().point(node.i + node.half(), node.j + node.half()) - camera_->position;
    const double distance_m = length(way);
    if (distance_m == 0) return true;
    const double error_px = camera_->kappa_px * grid_->error_m(node) / distance_m;
    if (!with_cosine_) return error_px > threshold_px();
    const double cosine = dot(way, camera_->forward) / distance_m;
    return cosine > 0 && error_px * cosine > threshold_px();
  }

  /// Towards the upper and the left tile (§2.4): what only they draw becomes our split point; what only we
  /// draw takes the height interpolated on their edge. Heights are adapted for this frame alone.
  void adapt_to_neighbours(int a, int b) {
    const auto across = static_cast<std::size_t>(tile_.side + 1);
    north_m_.assign(across, kAsStored);
    west_m_.assign(across, kAsStored);
    if (b + 1 < grid_->tiles_y() && border(a, b + 1).visible) {
      adapt(border(a, b + 1).south, north_m_, [this](int k) {
        return std::array{tile_.i + k, tile_.j + tile_.side};
      });
    }
    if (a > 0 && border(a - 1, b).visible) {
      adapt(border(a - 1, b).east, west_m_, [this](int k) { return std::array{tile_.i, tile_.j + k}; });
    }
  }

  template <class Place>
  void adapt(const std::vector<std::uint8_t>& theirs, std::vector<double>& adapted_m, Place place) {
    int before = -1;
    for (int k = 0; k <= tile_.side; ++k) {
      if (theirs[static_cast<std::size_t>(k)] == 0) continue;
      const auto [i1, j1] = place(k);
      for (int between = before + 1; before >= 0 && between < k; ++between) {
        const auto [i, j] = place(between);
        if (mark(i, j) == 0) continue;
        const auto [i0, j0] = place(before);
        const double z0 = grid_->terrain().z(i0, j0);
        const double z1 = grid_->terrain().z(i1, j1);
        adapted_m[static_cast<std::size_t>(between)] = z0 + (z1 - z0) * (between - before) / (k - before);
      }
      set_mark(i1, j1);
      before = k;
    }
  }

  /// The fan around the node's centre: its eight rim samples and every split point between them.
  void draw(Node node) {
    const int h = node.half();
    if (!grid_->has_data(node.i + h, node.j + h)) return;
    const std::uint32_t center = vertex(node.i + h, node.j + h);
    const std::array<std::array<int, 2>, 9> rim{
        {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {0, 0}}};
    for (std::size_t k = 0; k < 8; ++k) {
      const int i0 = node.i + rim[k][0] * h;
      const int j0 = node.j + rim[k][1] * h;
      const int i1 = node.i + rim[k + 1][0] * h;
      const int j1 = node.j + rim[k + 1][1] * h;
      if (grid_->has_data(i0, j0) && grid_->has_data(i1, j1)) draw_edge(center, i0, j0, i1, j1);
    }
  }

  /// Split points are dyadic: where an edge's midpoint is not drawn, nothing finer on it is.
  void draw_edge(std::uint32_t center, int i0, int j0, int i1, int j1) {
    const int i = (i0 + i1) / 2;
    const int j = (j0 + j1) / 2;
    if (std::max(std::abs(i1 - i0), std::abs(j1 - j0)) > 1 && mark(i, j) != 0) {
      draw_edge(center, i0, j0, i, j);
      draw_edge(center, i, j, i1, j1);
      return;
    }
    const std::uint32_t from = vertex(i0, j0);
    const std::uint32_t to = vertex(i1, j1);
    frame_->mesh.triangles.push_back({center, from, to});
  }

  std::uint32_t vertex(int i, int j) {
    const std::size_t sample = grid_->terrain().index(i, j);
    if (stamp_[sample] != now_) {
      stamp_[sample] = now_;
      vertex_[sample] = static_cast<std::uint32_t>(frame_->mesh.positions.size());
      Vec3 p = grid_->terrain().point(i, j);
      double adapted_m = kAsStored;
      if (j == tile_.j + tile_.side) adapted_m = north_m_[static_cast<std::size_t>(i - tile_.i)];
      if (i == tile_.i && adapted_m == kAsStored) adapted_m = west_m_[static_cast<std::size_t>(j - tile_.j)];
      if (adapted_m != kAsStored) p.z = adapted_m;
      frame_->mesh.positions.push_back(p);
      frame_->vertex_keys.push_back(sample);
    }
    return vertex_[sample];
  }

  [[nodiscard]] std::size_t mark_slot(int i, int j) const {
    return static_cast<std::size_t>(j - tile_.j) * static_cast<std::size_t>(tile_.side + 1) +
           static_cast<std::size_t>(i - tile_.i);
  }
  [[nodiscard]] std::uint8_t mark(int i, int j) const { return mark_[mark_slot(i, j)]; }
  void set_mark(int i, int j) {
    std::uint8_t& cell = mark_[mark_slot(i, j)];
    if (cell == 0) marked_.push_back(mark_slot(i, j));
    cell = 1;
  }

  static constexpr double kAsStored = std::numeric_limits<double>::infinity();

  int tile_size_;
  bool with_cosine_;
  std::shared_ptr<const TileGrid> grid_;
  std::vector<std::uint32_t> vertex_, stamp_;  ///< by sample: its vertex in the frame `stamp_` names
  std::uint32_t now_ = 0;
  std::vector<Border> borders_;
  // Of the tile in hand:
  Node tile_;
  std::vector<Node> drawn_;
  std::vector<std::uint8_t> mark_;  ///< drawn samples
  std::vector<std::size_t> marked_;
  std::vector<double> north_m_, west_m_;  ///< adapted heights along the border, or kAsStored
  const Camera* camera_ = nullptr;
  LodFrame* frame_ = nullptr;
};

std::unique_ptr<LodMethod> make(std::string_view variant, const Options& options) {
  const double size = option_number(options, "tile_size", 257);
  const double cells = size - 1;
  if (!(cells >= 2 && cells <= (1 << 20)) || cells != std::floor(cells) ||
      !std::has_single_bit(static_cast<unsigned>(cells))) {
    throw InputError(fmt::format(
        "isolated_quadtree: option tile_size = {} is not 2^n+1 with n >= 1; give 3, 5, …, 257", size));
  }
  return std::make_unique<IsolatedQuadtree>(static_cast<int>(size), variant != "no_cos");
}

}  // namespace

MethodDescription describe_isolated_quadtree() {
  using enum Promise;
  return {
      .id = "isolated_quadtree",
      .title = "Isolated division of a tiled quadtree with a conservative screen error",
      .citation =
          "Zhang, Yao: \"LOD algorithm of terrain based on conservative screen error and isolated division "
          "of "
          "quadtree\" (in Chinese), 2013",
      .section = "M3",
      .variants =
          {
              {"",
               "as published: the screen error is multiplied by cos beta",
               {conforming, covers_domain, idempotent, path_independent, exact_at_zero}},
              {"no_cos",
               "the screen error without its cosine, which the paper offers too",
               {conforming, covers_domain, idempotent, path_independent, exact_at_zero}},
          },
      .options = {{"tile_size", "samples along a tile's side, 2^n+1", 257.0}},
      .claims =
          {
              {"M3.C1", "no cracks, inside tiles and between them"},
              {"M3.C2", "a parent's error is never below a child's"},
              {"M3.C3", "the screen error never exceeds tau"},
              {"M3.C4", "isolated division avoids the redundancy of dependent division"},
              {"M3.C5", "about 8.7 triangles a drawn node"},
          },
      .make = make,
  };
}

}  // namespace plumbline
