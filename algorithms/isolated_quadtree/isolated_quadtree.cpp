// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// M3, isolated division of a tiled quadtree.
// Zhang, Yao: "LOD algorithm of terrain based on conservative screen error and isolated division of quadtree"
// (in Chinese), 2013. Implemented here: tiles with conservative geometric errors (bottom-up), the screen
// error with and without its cosine, isolated division of the visible tiles in row-major order, crack removal
// inside tiles (split points) and between them (split points or height averaging against the upper and left
// neighbour). Promises: METHODS M3.C1–C5. Departures, with reasons: a node is drawn as a fan of eight
// triangles over its nine samples (the paper shows no drawing; its 8.7 triangles a node confirm it); ΔZ is
// absolute. "Upper" is north, "left" is west, so short tiles stand at the east and south.
#include "algorithms/isolated_quadtree/isolated_quadtree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "algorithms/isolated_quadtree/tile_grid.h"

namespace plumbline {
namespace {

using isolated_quadtree::Node;
using isolated_quadtree::Settings;
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

constexpr std::uint32_t kNoVertex = 0xffffffffu;

class IsolatedQuadtree final : public LodMethod {
 public:
  explicit IsolatedQuadtree(const Settings& settings) : settings_(settings) {}

  void prepare(const Terrain& terrain) override {
    int side = settings_.tile_samples - 1;
    const int longest = std::max(terrain.columns, terrain.rows) - 1;
    while (side / 2 >= longest && side > 2) side /= 2;  // one tile is enough
    grid_ = std::make_shared<const TileGrid>(terrain, side);
    vertex_.clear();
  }

  void update(const Camera& camera, LodFrame& frame) override {
    frame.clear();
    frame.counters.nodes = grid_->node_count();
    if (vertex_.empty()) {
      across_ = static_cast<std::size_t>(grid_->tile_side() + 1);
      vertex_.assign(across_ * across_, kNoVertex);
      mark_.assign(across_ * across_, 0);
      south_.resize(across_ * grid_->tile_count());
      east_.resize(south_.size());
    }
    camera_ = &camera;
    frame_ = &frame;
    visible_.assign(grid_->tile_count(), 0);
    if (settings_.split_both_sides) announce_borders();
    for (int b = grid_->tiles_y() - 1; b >= 0; --b) {
      for (int a = 0; a < grid_->tiles_x(); ++a) draw_tile(a, b);
    }
    camera_ = nullptr;
    frame_ = nullptr;
  }

  void reset() override {}

  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    auto copy = std::make_unique<IsolatedQuadtree>(settings_);
    copy->grid_ = grid_;
    copy->set_threshold_px(threshold_px());
    return copy;
  }

 private:
  struct Rectangle {
    Vec2 low, high;
  };
  /// Where a tile has data, in plan.
  [[nodiscard]] Rectangle ground(int a, int b) const {
    const Terrain& terrain = grid_->terrain();
    const Node tile = grid_->tile(a, b);
    return {{tile.i * terrain.spacing_m, std::max(tile.j, 0) * terrain.spacing_m},
            {std::min(tile.i + tile.side, terrain.columns - 1) * terrain.spacing_m,
             (tile.j + tile.side) * terrain.spacing_m}};
  }
  [[nodiscard]] bool in_sight(int a, int b) const {
    const Rectangle plan = ground(a, b);
    return !outside_frustum(*camera_, {plan.low.x, plan.low.y, grid_->lowest_m(a, b)},
                            {plan.high.x, plan.high.y, grid_->highest_m(a, b)});
  }

  void draw_tile(int a, int b) {
    if (!in_sight(a, b)) return;
    tile_ = grid_->tile(a, b);
    ++frame_->counters.tiles;
    const Rectangle plan = ground(a, b);
    frame_->domain.add_rectangle(plan.low, plan.high);

    drawn_.clear();
    divide(tile_);
    if (settings_.split_both_sides) take_announced(a, b);
    adapt_to_neighbours(a, b);
    for (const Node& node : drawn_) draw(node);
    frame_->counters.drawn += drawn_.size();

    // What the lower and the right neighbour will adapt to.
    const std::size_t mine = grid_->tile_index(a, b);
    visible_[mine] = 1;
    for (int k = 0; k <= tile_.side; ++k) {
      south_[mine * across_ + static_cast<std::size_t>(k)] = vertex_[slot(tile_.i + k, tile_.j)];
      east_[mine * across_ + static_cast<std::size_t>(k)] = vertex_[slot(tile_.i + tile_.side, tile_.j + k)];
    }
    clear_marks();
  }

  void clear_marks() {
    for (const std::size_t used : marked_) {
      mark_[used] = 0;
      vertex_[used] = kNoVertex;
    }
    marked_.clear();
  }

  /// `repaired`: divides every tile beforehand, and keeps what it will draw on its north and west border for
  /// the neighbours that come first. They take it as split points; so each side has all vertices of both,
  /// and nothing is left to average.
  void announce_borders() {
    const Counters before = frame_->counters;
    north_marks_.assign(across_ * grid_->tile_count(), 0);
    west_marks_.assign(across_ * grid_->tile_count(), 0);
    for (int b = 0; b < grid_->tiles_y(); ++b) {
      for (int a = 0; a < grid_->tiles_x(); ++a) {
        if (!in_sight(a, b)) continue;
        tile_ = grid_->tile(a, b);
        drawn_.clear();
        divide(tile_);
        const std::size_t mine = grid_->tile_index(a, b) * across_;
        for (int k = 0; k <= tile_.side; ++k) {
          north_marks_[mine + static_cast<std::size_t>(k)] = mark_[slot(tile_.i + k, tile_.j + tile_.side)];
          west_marks_[mine + static_cast<std::size_t>(k)] = mark_[slot(tile_.i, tile_.j + k)];
        }
        clear_marks();
      }
    }
    frame_->counters = before;  // the second division counts
  }

  void take_announced(int a, int b) {
    for (int k = 0; k <= tile_.side; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (b > 0 && north_marks_[grid_->tile_index(a, b - 1) * across_ + at] != 0) {
        set_mark(tile_.i + k, tile_.j);
      }
      if (a + 1 < grid_->tiles_x() && west_marks_[grid_->tile_index(a + 1, b) * across_ + at] != 0) {
        set_mark(tile_.i + tile_.side, tile_.j + k);
      }
    }
  }

  /// Isolated division (§2.3): each node decides alone. A node with no-data always splits; no-data is never
  /// drawn.
  void divide(Node node) {
    if (!grid_->holds_ground(node)) return;
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
    const int h = node.half();
    drawn_.push_back(node);
    for (int dj = 0; dj <= 2; ++dj) {
      for (int di = 0; di <= 2; ++di) {
        const int i = node.i + di * h;
        const int j = node.j + dj * h;
        if (whole || grid_->has_data(i, j)) set_mark(i, j);
      }
    }
  }

  /// e_s = κ·e_n·cos β / d > τ (§2.2), multiplied out: no root, no division. With cos β = way·f̂ / d the test
  /// is κ·e_n·(way·f̂) > τ·d².
  [[nodiscard]] bool splits(Node node) const {
    ++frame_->counters.evaluated;
    const TileGrid::Record& record = grid_->record(node);
    const double spacing_m = grid_->terrain().spacing_m;
    const Vec3 center{(node.i + node.half()) * spacing_m, (node.j + node.half()) * spacing_m,
                      record.center_m};
    const Vec3 way = center - camera_->position;
    const double squared_m2 = dot(way, way);
    if (squared_m2 == 0) return true;
    const double scaled_error = camera_->kappa_px * record.error_m;
    if (!settings_.with_cosine) {
      return scaled_error * scaled_error > threshold_px() * threshold_px() * squared_m2;
    }
    const double depth_m = dot(way, camera_->forward);
    return depth_m > 0 && scaled_error * depth_m > threshold_px() * squared_m2;
  }

  /// Towards the upper and the left tile (§2.4): what only they draw becomes our split point; what only we
  /// draw takes the height interpolated on their edge. Heights are adapted for this frame alone.
  void adapt_to_neighbours(int a, int b) {
    north_m_.assign(across_, kAsStored);
    west_m_.assign(across_, kAsStored);
    const auto at_north = [this](int k) { return std::array{tile_.i + k, tile_.j + tile_.side}; };
    const auto at_west = [this](int k) { return std::array{tile_.i, tile_.j + k}; };
    // Diagonal neighbours share a corner, which everybody draws at its stored height.
    if (const std::uint32_t* south = drawn_by(south_, a - 1, b + 1))
      share(tile_.i, tile_.j + tile_.side, south[tile_.side]);
    if (const std::uint32_t* south = drawn_by(south_, a + 1, b + 1)) {
      share(tile_.i + tile_.side, tile_.j + tile_.side, south[0]);
    }
    if (const std::uint32_t* south = drawn_by(south_, a, b + 1)) adapt(south, north_m_, at_north);
    if (const std::uint32_t* east = drawn_by(east_, a - 1, b)) adapt(east, west_m_, at_west);
  }

  /// The border of a neighbour that is drawn in this frame already; null if there is none.
  [[nodiscard]] const std::uint32_t* drawn_by(const std::vector<std::uint32_t>& borders, int a, int b) const {
    if (a < 0 || a >= grid_->tiles_x() || b >= grid_->tiles_y()) return nullptr;
    const std::size_t tile = grid_->tile_index(a, b);
    return visible_[tile] != 0 ? borders.data() + tile * across_ : nullptr;
  }

  /// Takes over a neighbour's vertex.
  void share(int i, int j, std::uint32_t vertex) {
    if (vertex == kNoVertex) return;
    set_mark(i, j);
    vertex_[slot(i, j)] = vertex;
  }

  template <class At>
  void adapt(const std::uint32_t* theirs, std::vector<double>& adapted_m, At at) {
    const Terrain& terrain = grid_->terrain();
    int before = -1;
    for (int k = 0; k <= tile_.side; ++k) {
      if (theirs[k] == kNoVertex) continue;
      const auto [i1, j1] = at(k);
      for (int between = before + 1; before >= 0 && between < k; ++between) {
        const auto [i, j] = at(between);
        if (mark_[slot(i, j)] == 0) continue;
        const auto [i0, j0] = at(before);
        const double z0 = terrain.z(i0, j0);
        const double z1 = terrain.z(i1, j1);
        adapted_m[static_cast<std::size_t>(between)] = z0 + (z1 - z0) * (between - before) / (k - before);
      }
      share(i1, j1, theirs[k]);
      before = k;
    }
  }

  /// The fan around the node's centre: its eight rim samples and every split point between them, once around
  /// from the south-west corner.
  void draw(Node node) {
    const int h = node.half();
    center_ = vertex(node.i + h, node.j + h);
    static constexpr std::array<std::array<int, 2>, 9> kRim{
        {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {0, 0}}};
    if (grid_->whole(node)) {
      const std::uint32_t first = vertex(node.i, node.j);
      last_ = first;
      for (std::size_t k = 0; k < 8; ++k) {
        draw_edge(node.i + kRim[k][0] * h, node.j + kRim[k][1] * h, kRim[k + 1][0] - kRim[k][0],
                  kRim[k + 1][1] - kRim[k][1], h);
      }
      return;
    }
    for (std::size_t k = 0; k < 8; ++k) {  // a smallest node over the border: only what has data
      const int i0 = node.i + kRim[k][0];
      const int j0 = node.j + kRim[k][1];
      const int i1 = node.i + kRim[k + 1][0];
      const int j1 = node.j + kRim[k + 1][1];
      if (!grid_->has_data(i0, j0) || !grid_->has_data(i1, j1)) continue;
      last_ = vertex(i0, j0);
      draw_edge(i0, j0, i1 - i0, j1 - j0, 1);
    }
  }

  /// From (i, j), where `last_` stands, `steps` samples on in direction (di, dj). Split points are dyadic:
  /// where an edge's midpoint is not drawn, nothing finer on it is.
  void draw_edge(int i, int j, int di, int dj, int steps) {
    const int half = steps / 2;
    if (half > 0 && mark_[slot(i + half * di, j + half * dj)] != 0) {
      draw_edge(i, j, di, dj, half);
      draw_edge(i + half * di, j + half * dj, di, dj, half);
      return;
    }
    const std::uint32_t next = vertex(i + steps * di, j + steps * dj);
    frame_->mesh.triangles.push_back({center_, last_, next});
    last_ = next;
  }

  std::uint32_t vertex(int i, int j) {
    std::uint32_t& number = vertex_[slot(i, j)];
    if (number == kNoVertex) {
      number = static_cast<std::uint32_t>(frame_->mesh.positions.size());
      Vec3 p = grid_->terrain().point(i, j);
      double adapted_m = kAsStored;
      if (j == tile_.j + tile_.side) adapted_m = north_m_[static_cast<std::size_t>(i - tile_.i)];
      if (i == tile_.i && adapted_m == kAsStored) adapted_m = west_m_[static_cast<std::size_t>(j - tile_.j)];
      if (adapted_m != kAsStored) p.z = adapted_m;
      frame_->mesh.positions.push_back(p);
      frame_->vertex_keys.push_back(grid_->terrain().index(i, j));
    }
    return number;
  }

  /// Where a sample of the tile in hand stands in the tile's arrays.
  [[nodiscard]] std::size_t slot(int i, int j) const {
    return static_cast<std::size_t>(j - tile_.j) * across_ + static_cast<std::size_t>(i - tile_.i);
  }
  void set_mark(int i, int j) {
    const std::size_t here = slot(i, j);
    if (mark_[here] == 0) marked_.push_back(here);
    mark_[here] = 1;
  }

  static constexpr double kAsStored = std::numeric_limits<double>::infinity();

  Settings settings_;
  std::shared_ptr<const TileGrid> grid_;
  std::size_t across_ = 0;                              ///< samples along a tile's border
  std::vector<std::uint32_t> south_, east_;             ///< by tile: its border's vertices, or kNoVertex
  std::vector<std::uint8_t> visible_;                   ///< by tile
  std::vector<std::uint8_t> north_marks_, west_marks_;  ///< `repaired`, by tile: what its border will draw
  // Of the tile in hand:
  Node tile_;
  std::vector<Node> drawn_;
  std::vector<std::uint8_t> mark_;     ///< samples that are drawn
  std::vector<std::uint32_t> vertex_;  ///< their vertices, once they have one
  std::vector<std::size_t> marked_;
  std::uint32_t center_ = 0, last_ = 0;   ///< vertices of the fan in hand
  std::vector<double> north_m_, west_m_;  ///< adapted heights along the border, or kAsStored
  const Camera* camera_ = nullptr;
  LodFrame* frame_ = nullptr;
};

}  // namespace

std::unique_ptr<LodMethod> make_isolated_quadtree(const isolated_quadtree::Settings& settings) {
  return std::make_unique<IsolatedQuadtree>(settings);
}

}  // namespace plumbline
