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
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/isolated_quadtree/frustum.h"
#include "algorithms/isolated_quadtree/tile_grid.h"
#include "algorithms/mutant.h"

namespace plumbline {
namespace {

using isolated_quadtree::Frustum;
using isolated_quadtree::Node;
using isolated_quadtree::Settings;
using isolated_quadtree::TileGrid;

constexpr std::uint32_t kNone = 0xffffffffu;

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
      vertex_.assign(across_ * across_, kNone);
    }
    camera_ = &camera;
    frame_ = &frame;
    divide_tiles_in_sight();
    announced_.clear();
    if (settings_.split_both_sides) {
      for (TileInSight& tile : tiles_) announce(tile);
    }
    borders_.clear();
    for (TileInSight& tile : tiles_) draw(tile);
    frame.counters.tiles = tiles_.size();
    frame.counters.drawn = nodes_.size();
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
  /// A part of one of the frame's lists.
  struct Span {
    std::size_t begin = 0, end = 0;
  };
  struct TileInSight {
    int a = 0, b = 0;
    Span nodes;        ///< of nodes_: what division left to draw
    Span north, west;  ///< of announced_
    Span south, east;  ///< of borders_
  };
  /// The k-th sample of a tile's border from its south or west end, and its vertex.
  struct BorderVertex {
    int k = 0;
    std::uint32_t vertex = kNone;
  };
  /// A line of samples on the tile in hand: from (i, j) along (di, dj).
  struct Line {
    int i = 0, j = 0, di = 0, dj = 0;
  };

  /// Isolated division (§1.2), tile by tile from the north-west, row by row.
  void divide_tiles_in_sight() {
    const Terrain& terrain = grid_->terrain();
    const Frustum frustum(*camera_);
    tiles_.clear();
    nodes_.clear();
    place_.assign(grid_->tile_count(), kNone);
    for (int b = grid_->tiles_y() - 1; b >= 0; --b) {
      for (int a = 0; a < grid_->tiles_x(); ++a) {
        const Node square = grid_->tile(a, b);
        const Vec2 low{square.i * terrain.spacing_m, std::max(square.j, 0) * terrain.spacing_m};
        const int last_column = terrain.columns - (PLUMBLINE_MUTANT(m3_tile_border_off_by_one) ? 0 : 1);
        const Vec2 high{std::min(square.i + square.side, last_column) * terrain.spacing_m,
                        (square.j + square.side) * terrain.spacing_m};
        if (PLUMBLINE_MUTANT(m3_cull_box_flat) &&
            frustum.excludes({low.x, low.y, grid_->lowest_m(a, b)}, {high.x, high.y, grid_->lowest_m(a, b)}))
          continue;
        if (frustum.excludes({low.x, low.y, grid_->lowest_m(a, b)}, {high.x, high.y, grid_->highest_m(a, b)}))
          continue;
        frame_->domain.add_rectangle(low, high);
        place_[grid_->tile_index(a, b)] = static_cast<std::uint32_t>(tiles_.size());
        TileInSight tile{.a = a, .b = b, .nodes = {}, .north = {}, .west = {}, .south = {}, .east = {}};
        tile.nodes.begin = nodes_.size();
        divide(square);
        tile.nodes.end = nodes_.size();
        tiles_.push_back(tile);
      }
    }
  }

  /// Each node decides alone. A node with no-data always splits; no-data is never drawn.
  void divide(Node node) {
    if (!grid_->holds_ground(node)) return;
    ++frame_->counters.visited;
    if (node.side > 2 &&
        (!(PLUMBLINE_MUTANT(m3_no_data_test_missing) || grid_->whole(node)) || splits(node))) {
      ++frame_->counters.split;
      const int h = node.half();
      divide({node.i, node.j + h, h});
      divide({node.i + h, node.j + h, h});
      divide({node.i, node.j, h});
      divide({node.i + h, node.j, h});
      return;
    }
    nodes_.push_back(node);
  }

  /// e_s = κ·e_n·cos β / d > τ (§1.3.2), multiplied out: no root, no division. With cos β = way·f̂ / d the
  /// test is κ·e_n·(way·f̂) > τ·d².
  [[nodiscard]] bool splits(Node node) const {
    ++frame_->counters.evaluated;
    const TileGrid::Record& record = grid_->record(node);
    if (PLUMBLINE_MUTANT(m3_single_level)) return record.error_m > 0;
    const double spacing_m = grid_->terrain().spacing_m;
    const Vec3 center{(node.i + node.half()) * spacing_m, (node.j + node.half()) * spacing_m,
                      record.center_m};
    const Vec3 way = center - camera_->position;
    const double squared_m2 = dot(way, way);
    if (squared_m2 == 0) return true;
    const double scaled_error = camera_->kappa_px * record.error_m;
    if (!settings_.with_cosine) {
      if (PLUMBLINE_MUTANT(m3_distance_squared)) return scaled_error > threshold_px() * squared_m2;
      return scaled_error * scaled_error > threshold_px() * threshold_px() * squared_m2;
    }
    const double depth_m = dot(way, camera_->forward);
    return depth_m > 0 && scaled_error * depth_m > threshold_px() * squared_m2;
  }

  /// `repaired`: what a tile will draw on its north and west border, for the neighbours that are drawn before
  /// it. They take it as split points; so each side has all vertices of both, and nothing is left to average.
  void announce(TileInSight& tile) {
    const Node square = grid_->tile(tile.a, tile.b);
    const auto list = [&](bool north) {
      const Span span{announced_.size(), 0};
      for (std::size_t n = tile.nodes.begin; n < tile.nodes.end; ++n) {
        const Node& node = nodes_[n];
        if (north ? node.j + node.side != square.j + square.side : node.i != square.i) continue;
        for (int s = 0; s <= node.side; s += node.half()) {
          const int i = north ? node.i + s : node.i;
          const int j = north ? node.j + node.side : node.j + s;
          if (grid_->has_data(i, j)) announced_.push_back(north ? i - square.i : j - square.j);
        }
      }
      return Span{span.begin, announced_.size()};
    };
    tile.north = list(true);
    if (!PLUMBLINE_MUTANT(m3_west_not_announced)) tile.west = list(false);
  }

  void draw(TileInSight& tile) {
    tile_ = grid_->tile(tile.a, tile.b);
    const Line north{tile_.i, tile_.j + tile_.side, 1, 0}, south{tile_.i, tile_.j, 1, 0};
    const Line west{tile_.i, tile_.j, 0, 1}, east{tile_.i + tile_.side, tile_.j, 0, 1};

    // Vertices of the neighbours that are drawn already: the corners, which all draw, and whole borders.
    const TileInSight* upper = seen(tile.a, tile.b + 1);
    const TileInSight* left = seen(tile.a - 1, tile.b);
    if (const TileInSight* t = seen(tile.a - 1, tile.b + 1)) share(north, 0, borders_[t->south.end - 1]);
    if (const TileInSight* t = seen(tile.a + 1, tile.b + 1)) {
      share(north, tile_.side, borders_[t->south.begin]);
    }
    if (upper != nullptr && !PLUMBLINE_MUTANT(m3_border_not_shared)) share(north, upper->south);
    if (left != nullptr) share(west, left->east);

    for (std::size_t n = tile.nodes.begin; n < tile.nodes.end; ++n) use(nodes_[n]);
    if (const TileInSight* lower = seen(tile.a, tile.b - 1)) use(south, lower->north);
    if (const TileInSight* right = seen(tile.a + 1, tile.b)) use(east, right->west);
    if (upper != nullptr && !PLUMBLINE_MUTANT(m3_upper_not_averaged)) average(north, upper->south);
    if (left != nullptr) average(west, left->east);

    for (std::size_t n = tile.nodes.begin; n < tile.nodes.end; ++n) draw(nodes_[n]);

    tile.south = list_border(south, borders_);
    tile.east = list_border(east, borders_);
    if (PLUMBLINE_MUTANT(m3_tile_left_stale)) used_.clear();
    for (const std::size_t slot : used_) vertex_[slot] = kNone;
    used_.clear();
  }

  /// A tile of this frame; null if it is out of sight or does not exist.
  [[nodiscard]] const TileInSight* seen(int a, int b) const {
    if (a < 0 || a >= grid_->tiles_x() || b < 0 || b >= grid_->tiles_y()) return nullptr;
    const std::uint32_t place = place_[grid_->tile_index(a, b)];
    return place == kNone ? nullptr : &tiles_[place];
  }

  /// VN becomes ours too, as vertices where we draw them and as split points where we do not (§1.4).
  void share(Line border, Span theirs) {
    for (std::size_t n = theirs.begin; n < theirs.end; ++n) share(border, borders_[n].k, borders_[n]);
  }
  void share(Line border, int k, BorderVertex theirs) {
    const std::size_t here = slot(border.i + k * border.di, border.j + k * border.dj);
    if (vertex_[here] == kNone) used_.push_back(here);
    vertex_[here] = theirs.vertex;
  }

  /// Makes a vertex of a sample, if it is none yet. `grain` as TileGrid::height_m has it.
  void use(int i, int j, int grain) {
    const std::size_t here = slot(i, j);
    if (vertex_[here] != kNone) return;
    const Terrain& terrain = grid_->terrain();
    vertex_[here] = static_cast<std::uint32_t>(frame_->mesh.positions.size());
    used_.push_back(here);
    frame_->mesh.positions.push_back(
        {i * terrain.spacing_m, j * terrain.spacing_m, grid_->height_m(i, j, grain)});
    frame_->vertex_keys.push_back(terrain.index(i, j));
  }
  void use(Node node) {
    const int h = node.half();
    const bool whole = grid_->whole(node);
    for (int dj = 0; dj <= 2; ++dj) {
      for (int di = 0; di <= 2; ++di) {
        const int i = node.i + di * h;
        const int j = node.j + dj * h;
        if (whole || grid_->has_data(i, j)) use(i, j, h);
      }
    }
  }
  void use(Line border, Span announced) {
    for (std::size_t n = announced.begin; n < announced.end; ++n) {
      use(border.i + announced_[n] * border.di, border.j + announced_[n] * border.dj, 1);
    }
  }

  /// Height averaging (§1.4): each of VC∖VN takes the height interpolated between the nearest VN on either
  /// side, in this frame only. `theirs` is in order along the border.
  void average(Line border, Span theirs) {
    const Terrain& terrain = grid_->terrain();
    const auto stored_m = [&](int k) {
      return terrain.z(border.i + k * border.di, border.j + k * border.dj);
    };
    ours_.clear();
    list_border(border, ours_);
    std::size_t next = theirs.begin;
    for (const BorderVertex& mine : ours_) {
      while (next < theirs.end && borders_[next].k < mine.k) ++next;
      if (next == theirs.begin || next == theirs.end || borders_[next].k == mine.k) continue;
      const int before = borders_[next - 1].k, after = borders_[next].k;
      const double z0 = stored_m(before), z1 = stored_m(after);
      const int along = PLUMBLINE_MUTANT(m3_average_from_wrong_end) ? after - mine.k : mine.k - before;
      frame_->mesh.positions[mine.vertex].z = z0 + (z1 - z0) * along / (after - before);
    }
  }

  /// Appends the vertices on a border of the tile in hand, in order.
  Span list_border(Line border, std::vector<BorderVertex>& out) const {
    const std::size_t begin = out.size();
    const bool whole = has_data(border, 0) && has_data(border, tile_.side);
    append(border, 0, out);
    list_between(border, 0, tile_.side, whole, out);
    append(border, tile_.side, out);
    return {begin, out.size()};
  }
  /// Vertices are dyadic: where a stretch's middle is none, nothing finer in it is, unless it is no-data.
  /// `whole`: there is none of that here.
  void list_between(Line border, int from, int to, bool whole, std::vector<BorderVertex>& out) const {
    if (to - from < 2) return;
    // No-data is all beyond one of the ends.
    if (!whole && !has_data(border, from) && !has_data(border, to)) return;
    const int middle = (from + to) / 2;
    if (vertex(border, middle) == kNone && (whole || has_data(border, middle))) return;
    list_between(border, from, middle, whole, out);
    append(border, middle, out);
    list_between(border, middle, to, whole, out);
  }
  void append(Line border, int k, std::vector<BorderVertex>& out) const {
    const std::uint32_t there = vertex(border, k);
    if (there != kNone) out.push_back({k, there});
  }
  [[nodiscard]] std::uint32_t vertex(Line border, int k) const {
    return vertex_[slot(border.i + k * border.di, border.j + k * border.dj)];
  }
  [[nodiscard]] bool has_data(Line border, int k) const {
    return grid_->has_data(border.i + k * border.di, border.j + k * border.dj);
  }

  /// The fan around the node's centre: its eight rim samples and every split point between them, once around
  /// from the south-west corner.
  void draw(Node node) {
    const int h = node.half();
    const auto step = static_cast<std::ptrdiff_t>(across_);
    const auto first = static_cast<std::ptrdiff_t>(slot(node.i, node.j));
    center_ = vertex_[static_cast<std::size_t>(first + h * (1 + step))];
    const std::array<std::ptrdiff_t, 8> strides{1, 1, step, step, -1, -1, -step, -step};
    std::ptrdiff_t at = first;
    last_ = vertex_[static_cast<std::size_t>(at)];
    if (grid_->whole(node)) {
      for (const std::ptrdiff_t stride : strides) {
        draw_edge(at, stride, h);
        at += h * stride;
      }
      return;
    }
    for (const std::ptrdiff_t stride : strides) {  // a smallest node over the border: only what has data
      const std::uint32_t next = vertex_[static_cast<std::size_t>(at + stride)];
      if (last_ != kNone && next != kNone) frame_->mesh.triangles.push_back({center_, last_, next});
      last_ = next;
      at += stride;
    }
  }

  /// From slot `at`, where `last_` stands, `steps` strides on. Split points are dyadic: where an edge's
  /// middle is no vertex, nothing finer on it is.
  void draw_edge(std::ptrdiff_t at, std::ptrdiff_t stride, int steps) {
    const int half = PLUMBLINE_MUTANT(m3_split_point_dropped) && steps == 2 ? 0 : steps / 2;
    if (half > 0 && vertex_[static_cast<std::size_t>(at + half * stride)] != kNone) {
      draw_edge(at, stride, half);
      draw_edge(at + half * stride, stride, half);
      return;
    }
    const std::uint32_t next = vertex_[static_cast<std::size_t>(at + steps * stride)];
    if (PLUMBLINE_MUTANT(m3_wrong_winding) && stride == -1) {
      frame_->mesh.triangles.push_back({center_, next, last_});
    } else {
      frame_->mesh.triangles.push_back({center_, last_, next});
    }
    last_ = next;
  }

  /// Where a sample of the tile in hand stands in vertex_.
  [[nodiscard]] std::size_t slot(int i, int j) const {
    return static_cast<std::size_t>(j - tile_.j) * across_ + static_cast<std::size_t>(i - tile_.i);
  }

  Settings settings_;
  std::shared_ptr<const TileGrid> grid_;
  std::size_t across_ = 0;  ///< samples along a tile's border
  // Of the frame in hand:
  std::vector<TileInSight> tiles_;     ///< in the order of drawing
  std::vector<std::uint32_t> place_;   ///< by tile: its place in tiles_, or kNone
  std::vector<Node> nodes_;            ///< to draw, tile by tile
  std::vector<int> announced_;         ///< `repaired`: samples on north and west borders
  std::vector<BorderVertex> borders_;  ///< on south and east borders, in order along each
  const Camera* camera_ = nullptr;
  LodFrame* frame_ = nullptr;
  // Of the tile in hand:
  Node tile_;
  std::vector<std::uint32_t> vertex_;  ///< by sample of the tile: its vertex, or kNone
  std::vector<std::size_t> used_;      ///< slots of vertex_ that are not kNone
  std::vector<BorderVertex> ours_;
  std::uint32_t center_ = 0, last_ = 0;  ///< vertices of the fan in hand
};

}  // namespace

std::unique_ptr<LodMethod> make_isolated_quadtree(const isolated_quadtree::Settings& settings) {
  return std::make_unique<IsolatedQuadtree>(settings);
}

}  // namespace plumbline
