// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/image_plan_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plumbline::oracle {
namespace {

/// A cell with more triangles than this becomes a grid. Around 4 tests a look-up are as quick as one more
/// step down.
constexpr std::uint32_t kCrowd = 8;
/// Triangles that meet in one point share its cell however fine: stop somewhere.
constexpr int kMaxDepth = 6;
constexpr std::uint32_t kMaxTopSide = 2048;
constexpr std::uint32_t kMaxFinerSide = 32;
/// A cell's rectangle is widened by this share of the mesh's coordinates before a triangle is ruled out by
/// it: some 2²⁰ roundings' worth, still far below a cell's size.
constexpr double kCellSlack = 0x1p-32;
/// Entries a triangle: a grid is made coarser until its boxes need no more, and no cell is refined once the
/// whole index holds that many. So memory is linear in triangles, even where all of them overlap.
constexpr double kEntriesTop = 12, kEntriesFiner = 5, kEntriesWhole = 40;

/// Vertices with more edges than this are not searched for twins, so that the search stays linear.
constexpr std::size_t kMostMatched = 64;

/// Height over a point that lies on the edge between a and b: the same for (b, a), and in a mirrored plan.
double height_on_edge(Vec3 a, Vec3 b, Vec2 p) {
  if (b.z < a.z) std::swap(a, b);  // equal heights: either gives that height
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double share = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
  return a.z + std::clamp(share, 0.0, 1.0) * (b.z - a.z);
}

bool usable_triangle(std::span<const std::uint8_t> usable, std::size_t t) {
  return usable.empty() || usable[t] != 0;
}

/// Whether the triangle (its bounding box is known to meet the rectangle) may reach into the rectangle.
bool may_reach(Vec2 a, Vec2 b, Vec2 c, Vec2 low, Vec2 high) {
  if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < 0) std::swap(b, c);
  const auto beside = [&](Vec2 from, Vec2 to) {  // the rectangle's corner furthest to the left of the edge
    const Vec2 corner{to.y > from.y ? low.x : high.x, to.x > from.x ? high.y : low.y};
    return (to.x - from.x) * (corner.y - from.y) - (to.y - from.y) * (corner.x - from.x) < 0;
  };
  return !(beside(a, b) || beside(b, c) || beside(c, a));
}

bool meets(Vec2 a, Vec2 b, Vec2 low, Vec2 high) {
  if (std::max(a.x, b.x) < low.x || std::min(a.x, b.x) > high.x) return false;
  if (std::max(a.y, b.y) < low.y || std::min(a.y, b.y) > high.y) return false;
  const double s0 = edge_value(a, b, low);
  const double s1 = edge_value(a, b, high);
  const double s2 = edge_value(a, b, {low.x, high.y});
  const double s3 = edge_value(a, b, {high.x, low.y});
  return !((s0 > 0 && s1 > 0 && s2 > 0 && s3 > 0) || (s0 < 0 && s1 < 0 && s2 < 0 && s3 < 0));
}

}  // namespace

PlanIndex::Sides PlanIndex::find_sides(const Mesh& mesh, std::span<const std::uint32_t> members) {
  // Half-edges in buckets of their smaller vertex.
  std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (const std::uint32_t t : members) {
      const auto& v = mesh.triangles[t];
      for (std::uint32_t k = 0; k < 3; ++k) visit(t, k, v[k], v[(k + 1) % 3]);
    }
  };
  for_each_edge([&](std::uint32_t, std::uint32_t, std::uint32_t from, std::uint32_t to) {
    ++first[std::min(from, to) + 1];
  });
  for (std::size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];
  struct HalfEdge {
    std::uint32_t triangle;
    std::uint32_t number : 2, rising : 1;  ///< from corner `number` to the next; whether to the larger vertex
    std::uint32_t larger;
  };
  std::vector<HalfEdge> edges(3 * members.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for_each_edge([&](std::uint32_t t, std::uint32_t k, std::uint32_t from, std::uint32_t to) {
    edges[next[std::min(from, to)]++] = {t, k & 3U, from < to ? 1U : 0U, std::max(from, to)};
  });

  Sides sides(mesh.triangles.size(), 0);
  for (const std::uint32_t t : members) {
    const auto& v = mesh.triangles[t];
    const Vec3& a = mesh.positions[v[0]];
    if (!(edge_value(plan(a), plan(mesh.positions[v[1]]), plan(mesh.positions[v[2]])) > 0))
      sides[t] |= kNotPositive;
  }
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    const auto bucket = std::span(edges).subspan(first[v], first[v + 1] - first[v]);
    for (const HalfEdge& edge : bucket) {
      int same = 0;
      int twins = 0;
      if (bucket.size() <= kMostMatched) {
        for (const HalfEdge& other : bucket) {
          if (other.larger != edge.larger) continue;
          (other.rising == edge.rising ? same : twins) += 1;
        }
      }
      if (same != 1 || twins != 1) sides[edge.triangle] |= static_cast<std::uint8_t>(1U << edge.number);
    }
  }
  return sides;
}

bool PlanIndex::covered_once(const Mesh& mesh, const Sides& sides, std::span<const std::uint32_t> run,
                             Vec2 low, Vec2 high) {
  std::size_t over_centre = 0;
  const Vec2 centre{low.x * 0.5 + high.x * 0.5, low.y * 0.5 + high.y * 0.5};
  for (const std::uint32_t t : run) {
    if ((sides[t] & kNotPositive) != 0) return false;
    const auto& v = mesh.triangles[t];
    const Vec2 a = plan(mesh.positions[v[0]]);
    const Vec2 b = plan(mesh.positions[v[1]]);
    const Vec2 c = plan(mesh.positions[v[2]]);
    const double least =
        std::min({edge_value(a, b, centre), edge_value(b, c, centre), edge_value(c, a, centre)});
    if (least == 0) return false;
    over_centre += least > 0 ? 1U : 0U;
    if ((sides[t] & 1U) != 0 && meets(a, b, low, high)) return false;
    if ((sides[t] & 2U) != 0 && meets(b, c, low, high)) return false;
    if ((sides[t] & 4U) != 0 && meets(c, a, low, high)) return false;
  }
  return over_centre == 1;
}

std::optional<double> height_on_rim(const Vec3& a, const Vec3& b, const Vec3& c, Vec2 p, double ea,
                                    double eb) {
  for (const Vec3* corner : {&a, &b, &c}) {
    if (corner->x == p.x && corner->y == p.y) return corner->z;
  }
  if (ea == 0) return height_on_edge(b, c, p);
  return eb == 0 ? height_on_edge(c, a, p) : height_on_edge(a, b, p);
}

PlanIndex::PlanIndex(const Mesh& mesh, std::span<const std::uint8_t> usable) {
  std::vector<std::uint32_t> members;
  members.reserve(mesh.triangles.size());
  bool first = true;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!usable_triangle(usable, t)) continue;
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Vec3& p = mesh.positions[v];
      if (first) low_ = high_ = plan(p);
      first = false;
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    members.push_back(static_cast<std::uint32_t>(t));
  }
  if (members.empty()) return;
  alone_.assign(mesh.triangles.size(), 1);
  used_ = members.size();
  const double wanted = std::sqrt(static_cast<double>(members.size()) / 2);
  const auto side = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, static_cast<double>(kMaxTopSide)));
  const Sides sides = find_sides(mesh, members);
  add_grid(mesh, sides, members, low_, high_, 0, fitting_side(mesh, members, low_, high_, side, kEntriesTop));
}

std::uint32_t PlanIndex::fitting_side(const Mesh& mesh, std::span<const std::uint32_t> members, Vec2 low,
                                      Vec2 high, std::uint32_t side, double entries) {
  const double width = high.x - low.x;
  const double height = high.y - low.y;
  for (; side > 1; side /= 2) {
    double needed = 0;
    for (const std::uint32_t t : members) {
      const auto& v = mesh.triangles[t];
      const auto [x0, x1] =
          std::minmax({mesh.positions[v[0]].x, mesh.positions[v[1]].x, mesh.positions[v[2]].x});
      const auto [y0, y1] =
          std::minmax({mesh.positions[v[0]].y, mesh.positions[v[1]].y, mesh.positions[v[2]].y});
      const double across = width > 0 ? (std::min(x1, high.x) - std::max(x0, low.x)) / width * side : 0;
      const double along = height > 0 ? (std::min(y1, high.y) - std::max(y0, low.y)) / height * side : 0;
      needed += (across + 1) * (along + 1);
    }
    if (needed <= entries * static_cast<double>(members.size())) break;
  }
  return side;
}

void PlanIndex::add_grid(const Mesh& mesh, const Sides& sides, std::span<const std::uint32_t> members,
                         Vec2 low, Vec2 high, int depth, std::uint32_t side) {
  Grid grid;
  grid.low = low;
  grid.columns = grid.rows = side;
  const double width = high.x - low.x;
  const double height = high.y - low.y;
  // A flat extent has one column or row; so has one so small that its reciprocal overflows.
  if (!(width > 0) || !std::isfinite(side / width)) grid.columns = 1;
  if (!(height > 0) || !std::isfinite(side / height)) grid.rows = 1;
  grid.cells_per_m_x = grid.columns > 1 ? grid.columns / width : 0;
  grid.cells_per_m_y = grid.rows > 1 ? grid.rows / height : 0;
  grid.first_cell = cells_.size();
  const double cell_x = width / grid.columns;
  const double cell_y = height / grid.rows;
  const double slack_x = (std::fabs(low_.x) + std::fabs(high_.x)) * kCellSlack;
  const double slack_y = (std::fabs(low_.y) + std::fabs(high_.y)) * kCellSlack;
  const std::size_t cell_count = static_cast<std::size_t>(grid.columns) * grid.rows;
  cells_.resize(grid.first_cell + cell_count);
  grids_.push_back(grid);

  const auto for_each_cell = [&](std::uint32_t t, auto&& visit) {
    const auto& corners = mesh.triangles[t];
    const Vec2 a = plan(mesh.positions[corners[0]]);
    const Vec2 b = plan(mesh.positions[corners[1]]);
    const Vec2 c = plan(mesh.positions[corners[2]]);
    // A member reaches into this grid's rectangle; outside of it the cell numbers are clamped.
    const std::uint32_t x0 = grid.column(std::min({a.x, b.x, c.x}));
    const std::uint32_t x1 = grid.column(std::max({a.x, b.x, c.x}));
    const std::uint32_t y0 = grid.row(std::min({a.y, b.y, c.y}));
    const std::uint32_t y1 = grid.row(std::max({a.y, b.y, c.y}));
    const bool few = x0 == x1 || y0 == y1;
    for (std::uint32_t y = y0; y <= y1; ++y) {
      for (std::uint32_t x = x0; x <= x1; ++x) {
        const Vec2 cell_low{low.x + cell_x * x - slack_x, low.y + cell_y * y - slack_y};
        const Vec2 cell_high{low.x + cell_x * (x + 1) + slack_x, low.y + cell_y * (y + 1) + slack_y};
        if (few || may_reach(a, b, c, cell_low, cell_high))
          visit(grid.first_cell + x + std::size_t{y} * grid.columns);
      }
    }
  };
  // Counting sort, triangles ascending in each cell.
  std::vector<std::uint32_t> counts(cell_count + 1, 0);
  for (const std::uint32_t t : members) {
    for_each_cell(t, [&](std::size_t cell) { ++counts[cell - grid.first_cell + 1]; });
  }
  for (std::size_t i = 0; i < cell_count; ++i) counts[i + 1] += counts[i];
  std::vector<std::uint32_t> sorted(counts[cell_count]);
  std::vector<std::uint32_t> next(counts.begin(), counts.end() - 1);
  for (const std::uint32_t t : members) {
    for_each_cell(t, [&](std::size_t cell) { sorted[next[cell - grid.first_cell]++] = t; });
  }
  for (std::size_t i = 0; i < cell_count; ++i) {
    const std::uint32_t count = counts[i + 1] - counts[i];
    const std::span<const std::uint32_t> run = std::span(sorted).subspan(counts[i], count);
    if (count > kCrowd && depth < kMaxDepth &&
        static_cast<double>(triangles_.size()) < kEntriesWhole * static_cast<double>(used_)) {
      const auto x = static_cast<double>(i % grid.columns);
      const auto y = static_cast<double>(i / grid.columns);
      const Vec2 finer_low{low.x + cell_x * x, low.y + cell_y * y};
      const Vec2 finer_high{low.x + cell_x * (x + 1), low.y + cell_y * (y + 1)};
      const double wanted =
          std::clamp(std::sqrt(static_cast<double>(count)), 2.0, static_cast<double>(kMaxFinerSide));
      const std::uint32_t finer =
          fitting_side(mesh, run, finer_low, finer_high, static_cast<std::uint32_t>(wanted), kEntriesFiner);
      if (finer > 1) {
        cells_[grid.first_cell + i] = {static_cast<std::uint32_t>(grids_.size()), kFiner};
        add_grid(mesh, sides, run, finer_low, finer_high, depth + 1, finer);
        continue;
      }
    }
    cells_[grid.first_cell + i] = {static_cast<std::uint32_t>(triangles_.size()), count};
    triangles_.insert(triangles_.end(), run.begin(), run.end());
    const auto x = static_cast<double>(i % grid.columns);
    const auto y = static_cast<double>(i / grid.columns);
    const Vec2 cell_low{low.x + cell_x * x - slack_x, low.y + cell_y * y - slack_y};
    const Vec2 cell_high{low.x + cell_x * (x + 1) + slack_x, low.y + cell_y * (y + 1) + slack_y};
    if (!covered_once(mesh, sides, run, cell_low, cell_high)) {
      for (const std::uint32_t t : run) alone_[t] = 0;
    }
  }
}

std::span<const std::uint32_t> PlanIndex::candidates(Vec2 p) const {
  if (grids_.empty() || !(p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y)) return {};
  std::size_t number = 0;
  while (true) {
    const Grid& grid = grids_[number];
    const Cell& cell = cells_[grid.first_cell + grid.column(p.x) + std::size_t{grid.row(p.y)} * grid.columns];
    if (cell.count != kFiner) return std::span(triangles_).subspan(cell.first, cell.count);
    number = cell.first;
  }
}

std::optional<double> PlanIndex::top(const Mesh& mesh, Vec2 p, Cursor& cursor) const {
  const auto height_of = [&](std::uint32_t t) {
    const auto& v = mesh.triangles[t];
    return height_over(mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]], p);
  };
  if (cursor.triangle != Cursor::kNone && alone_[cursor.triangle] != 0) {
    if (const auto height = height_of(cursor.triangle)) return height;
  }
  std::optional<double> best;
  for (const std::uint32_t t : candidates(p)) {
    const auto height = height_of(t);
    if (!height || (best && !(*height > *best))) continue;
    best = height;
    cursor.triangle = t;
    if (alone_[t] != 0) break;
  }
  return best;
}

std::optional<double> PlanIndex::nearest(const Mesh& mesh, Vec2 p, double height_m) const {
  std::optional<double> best;
  for (const std::uint32_t t : candidates(p)) {
    const auto& v = mesh.triangles[t];
    const auto height = height_over(mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]], p);
    if (!height) continue;
    const double gap = std::fabs(*height - height_m);
    if (!best || gap < std::fabs(*best - height_m) ||
        (gap == std::fabs(*best - height_m) && *height > *best)) {
      best = height;
    }
  }
  return best;
}

}  // namespace plumbline::oracle
