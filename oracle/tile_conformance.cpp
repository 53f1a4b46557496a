// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/tile_conformance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "oracle/plan_weld.h"
#include "scenarios/portable_math.h"
#include "scenarios/tiles/ecef.h"

namespace plumbline::oracle {
namespace {

using Ids = std::vector<std::uint32_t>;

std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

class TileCheck {
 public:
  explicit TileCheck(const QuantizedMesh& tile) : t_(tile), n_(tile.vertices()) {
    for (std::uint32_t k = 0; k < t_.triangles.size(); ++k) {
      const auto& c = t_.triangles[k];
      if (std::any_of(c.begin(), c.end(), [&](std::uint32_t i) { return i >= n_; }))
        bad_triangles_.push_back(k);
    }
    // Whatever a bad index meant to name may be used.
    used_.assign(n_, bad_triangles_.empty() ? 0 : 1);
    if (bad_triangles_.empty()) {
      for (const auto& triangle : t_.triangles) {
        for (const std::uint32_t i : triangle) used_[i] = 1;
      }
    }
  }

  std::vector<TileFinding> run(const std::optional<TileBounds>& bounds) {
    header();
    indices();
    ranges();
    corners();
    for (const TileSide side : kTileSides) edge_list(side);
    if (bad_triangles_.empty()) off_border();
    for (auto& corner : missing_corners_) out_.push_back(std::move(corner.second));
    // Where the range is upside down, every height is in the wrong place: one cause, one finding.
    if (bounds && header_is_finite_ && t_.min_height_m <= t_.max_height_m) places(*bounds);
    normals(bounds);
    if (t_.trailing_bytes > 0) {
      add("trailing", Severity::hazard, {},
          fmt::format("{} to nothing that the format knows",
                      counted(t_.trailing_bytes, "byte belongs", "bytes belong")));
    }
    std::stable_sort(out_.begin(), out_.end(), [](const TileFinding& a, const TileFinding& b) {
      const auto key = [](const Finding& f) {
        return std::tuple(f.severity == Severity::hazard, std::string_view(f.kind), f.at.x, f.at.y);
      };
      return key(a.finding) < key(b.finding);
    });
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool in_range(std::uint32_t i) const {
    const auto inside = [](std::int32_t x) { return x >= 0 && x <= kTileSteps; };
    return inside(t_.u[i]) && inside(t_.v[i]) && inside(t_.height[i]);
  }
  /// Whether it lies on the line of that side.
  [[nodiscard]] bool on(TileSide side, std::uint32_t i) const {
    const bool along_u = side == TileSide::west || side == TileSide::east;
    const bool far = side == TileSide::east || side == TileSide::north;
    return (along_u ? t_.u[i] : t_.v[i]) == (far ? kTileSteps : 0);
  }
  [[nodiscard]] Vec3 at(std::uint32_t i) const {
    return {static_cast<double>(t_.u[i]), static_cast<double>(t_.v[i]),
            header_is_finite_ ? t_.height_m(i) : 0};
  }

  TileFinding& add(std::string kind, Severity severity, Ids vertices, std::string text) {
    TileFinding found;
    found.finding.code = FindingCode::tile_encoding;
    found.finding.severity = severity;
    found.finding.kind = std::move(kind);
    if (!vertices.empty() && vertices.front() < n_) found.finding.at = at(vertices.front());
    found.finding.vertices = std::move(vertices);
    found.text = std::move(text);
    return out_.emplace_back(std::move(found));
  }

  void header() {
    const std::array<double, 12> numbers{t_.center.x,
                                         t_.center.y,
                                         t_.center.z,
                                         static_cast<double>(t_.min_height_m),
                                         static_cast<double>(t_.max_height_m),
                                         t_.sphere_center.x,
                                         t_.sphere_center.y,
                                         t_.sphere_center.z,
                                         t_.sphere_radius_m,
                                         t_.horizon_occlusion.x,
                                         t_.horizon_occlusion.y,
                                         t_.horizon_occlusion.z};
    header_is_finite_ =
        std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    if (!header_is_finite_) {
      add("height_range", Severity::fault, {}, "the header holds a number that is not finite");
      return;
    }
    if (t_.min_height_m > t_.max_height_m) {
      add("height_range", Severity::fault, {},
          fmt::format("the header's least height {} m is above its greatest, {} m", t_.min_height_m,
                      t_.max_height_m));
      return;
    }
    if (n_ == 0 || t_.min_height_m == t_.max_height_m) return;
    const auto [low, high] = std::minmax_element(t_.height.begin(), t_.height.end());
    if (*low <= 0 && *high >= kTileSteps) return;
    const auto index = static_cast<std::uint32_t>((*low > 0 ? low : high) - t_.height.begin());
    add("height_range", Severity::hazard, {index},
        fmt::format(
            "heights take {} to {} of {} steps between {} and {} m: allowed, and rounded more coarsely "
            "than need be",
            *low, *high, kTileSteps, t_.min_height_m, t_.max_height_m));
  }

  void indices() {
    if (bad_triangles_.empty()) return;
    const std::uint32_t first = bad_triangles_.front();
    Ids good;
    std::uint32_t bad = 0;
    for (const std::uint32_t i : t_.triangles[first]) {
      if (i < n_) {
        good.push_back(i);
      } else {
        bad = i;
      }
    }
    auto& found =
        add("index", Severity::fault, good,
            fmt::format("{} a vertex that is not there; the first, {}, names {} of {}: its code does not "
                        "follow the high-water mark",
                        counted(bad_triangles_.size(), "triangle names", "triangles name"), first, bad, n_));
    found.finding.triangles = bad_triangles_;
  }

  void ranges() {
    Ids out;
    for (std::uint32_t i = 0; i < n_; ++i) {
      if (!in_range(i)) out.push_back(i);
    }
    if (out.empty()) return;
    const std::uint32_t i = out.front();
    auto text = fmt::format("{} outside 0 to {}; the first, {}, has u {}, v {}, height {}",
                            counted(out.size(), "vertex lies", "vertices lie"), kTileSteps, i, t_.u[i],
                            t_.v[i], t_.height[i]);
    add("range", Severity::fault, std::move(out), std::move(text));
  }

  void corners() {
    std::array<bool, 4> there{};
    for (std::uint32_t i = 0; i < n_; ++i) {
      const bool east = on(TileSide::east, i), north = on(TileSide::north, i);
      if (used_[i] != 0 && (east || on(TileSide::west, i)) && (north || on(TileSide::south, i)))
        there[(east ? 1U : 0U) + (north ? 2U : 0U)] = true;
    }
    for (std::size_t k = 0; k < there.size(); ++k) {
      if (there[k]) continue;
      const bool east = k % 2 == 1, north = k >= 2;
      const auto side_u = east ? TileSide::east : TileSide::west;
      const auto side_v = north ? TileSide::north : TileSide::south;
      TileFinding found = std::move(add("corner_missing", Severity::fault, {},
                                        fmt::format("no triangle has a vertex at the {}{} corner",
                                                    tile_side_name(side_v), tile_side_name(side_u))));
      out_.pop_back();
      found.finding.at = {east ? kTileSteps * 1.0 : 0, north ? kTileSteps * 1.0 : 0,
                          header_is_finite_ ? static_cast<double>(t_.min_height_m) : 0};
      missing_corners_.emplace_back(std::pair(side_u, side_v), std::move(found));
    }
  }

  void edge_list(TileSide side) {
    const Ids& list = t_.edges[static_cast<std::size_t>(side)];
    std::vector<std::uint8_t> seen(n_, 0);
    Ids bad, repeated, elsewhere, unlisted;
    for (const std::uint32_t i : list) {
      if (i >= n_) {
        bad.push_back(i);
      } else if (std::exchange(seen[i], 1) != 0) {
        repeated.push_back(i);
      } else if (in_range(i) && !on(side, i)) {
        elsewhere.push_back(i);
      }
    }
    for (std::uint32_t i = 0; i < n_; ++i) {
      if (used_[i] != 0 && seen[i] == 0 && on(side, i) && in_range(i)) unlisted.push_back(i);
    }
    const std::string_view name = tile_side_name(side);
    const auto tell = [&](Ids ids, std::string_view one, std::string_view many) {
      if (ids.empty()) return;
      auto text =
          fmt::format("{} edge list: {}; the first is {}", name, counted(ids.size(), one, many), ids.front());
      add("edge_list", Severity::fault, std::move(ids), std::move(text));
    };
    tell(std::move(bad), "entry names a vertex that is not there",
         "entries name vertices that are not there");
    tell(std::move(repeated), "entry names a vertex again", "entries name vertices again");
    tell(std::move(elsewhere), "listed vertex is not on that side", "listed vertices are not on that side");
    tell(std::move(unlisted), "vertex on that side is not listed", "vertices on that side are not listed");
  }

  void off_border() {
    struct Side {
      std::uint32_t low, high;  // numbers of welded places
      std::uint32_t a, b;       // the tile's own vertices
      std::uint32_t triangle;
    };
    detail::PointTable places(n_);
    Ids place(n_);
    for (std::uint32_t i = 0; i < n_; ++i) {
      place[i] = places.number(
          {static_cast<double>(t_.u[i]), static_cast<double>(t_.v[i]), static_cast<double>(t_.height[i])});
    }
    std::vector<Side> sides;
    sides.reserve(3 * t_.triangles.size());
    for (std::uint32_t k = 0; k < t_.triangles.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = t_.triangles[k][c], b = t_.triangles[k][(c + 1) % 3];
        if (place[a] != place[b])
          sides.push_back({std::min(place[a], place[b]), std::max(place[a], place[b]), a, b, k});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
    });
    std::vector<Side> open;
    for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
      while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high) ++end;
      const Side& s = sides[k];
      const bool border = std::any_of(kTileSides.begin(), kTileSides.end(),
                                      [&](TileSide side) { return on(side, s.a) && on(side, s.b); });
      if (end - k == 1 && !border && in_range(s.a) && in_range(s.b)) open.push_back(s);
    }
    // Chains: edges that share a place, joined under the least one.
    Ids root(places.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto top = [&](std::uint32_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    for (const Side& s : open) {
      const std::uint32_t a = top(s.low), b = top(s.high);
      root[std::max(a, b)] = std::min(a, b);
    }
    std::map<std::uint32_t, std::vector<Side>> chains;
    for (const Side& s : open) chains[top(s.low)].push_back(s);
    for (const auto& [first, chain] : chains) {
      Ids vertices, triangles;
      std::array<bool, 4> touched{};
      for (const Side& s : chain) {
        vertices.insert(vertices.end(), {s.a, s.b});
        triangles.push_back(s.triangle);
        for (const TileSide side : kTileSides)
          touched[static_cast<std::size_t>(side)] =
              touched[static_cast<std::size_t>(side)] || on(side, s.a) || on(side, s.b);
      }
      for (Ids* ids : {&vertices, &triangles}) {
        std::sort(ids->begin(), ids->end());
        ids->erase(std::unique(ids->begin(), ids->end()), ids->end());
      }
      const auto cut =
          std::find_if(missing_corners_.begin(), missing_corners_.end(), [&](const auto& corner) {
            return touched[static_cast<std::size_t>(corner.first.first)] &&
                   touched[static_cast<std::size_t>(corner.first.second)];
          });
      if (cut != missing_corners_.end()) {
        cut->second.finding.vertices = std::move(vertices);
        cut->second.finding.triangles = std::move(triangles);
        continue;
      }
      const Side& s = chain.front();
      auto& found =
          add("off_border", Severity::fault, std::move(vertices),
              fmt::format("{} one triangle each and {} not on the tile's border, the first from ({}, {}) to "
                          "({}, {}): a gap, or a border off 0 and {}",
                          counted(chain.size(), "edge has", "edges have"), chain.size() == 1 ? "is" : "are",
                          t_.u[s.a], t_.v[s.a], t_.u[s.b], t_.v[s.b], kTileSteps));
      found.finding.at = (at(s.a) + at(s.b)) * 0.5;
      found.finding.triangles = std::move(triangles);
    }
  }

  void places(const TileBounds& bounds) {
    const TileEcef earth(bounds);
    const double east_step = (bounds.east - bounds.west) * kRadiansPerDegree * kWgs84SemiMajorM / kTileSteps;
    const double north_step =
        (bounds.north - bounds.south) * kRadiansPerDegree * kWgs84SemiMajorM / kTileSteps;
    const double slack = kSphereSlackM + length({east_step, north_step, t_.height_step_m()}) / 2;
    const Vec3 middle =
        earth.at((bounds.west + bounds.east) / 2, (bounds.south + bounds.north) / 2,
                 (static_cast<double>(t_.min_height_m) + static_cast<double>(t_.max_height_m)) / 2);
    Ids outside;
    double farthest = -std::numeric_limits<double>::infinity(), reach = 0;
    std::uint32_t farthest_at = 0;
    for (std::uint32_t i = 0; i < n_; ++i) {
      if (!in_range(i)) continue;
      const Vec2 place = place_deg(bounds, i);
      const Vec3 p = earth.at(place.x, place.y, t_.height_m(i));
      reach = std::max(reach, length(p - middle));
      const double beyond = length(p - t_.sphere_center) - t_.sphere_radius_m;
      if (beyond > slack) outside.push_back(i);
      if (beyond > farthest) {
        farthest = beyond;
        farthest_at = i;
      }
    }
    if (!outside.empty()) {
      auto text = fmt::format("{} outside the header's ball of {:.6g} m; the farthest, {}, by {:.6g} m",
                              counted(outside.size(), "vertex lies", "vertices lie"), t_.sphere_radius_m,
                              farthest_at, farthest);
      auto& found = add("sphere", Severity::fault, std::move(outside), std::move(text));
      found.finding.at = at(farthest_at);
      found.finding.gap_m = farthest;
    }
    if (const double off = length(t_.center - middle); reach > 0 && off > reach) {
      auto& found =
          add("center", Severity::hazard, {},
              fmt::format("the header's center is {:.6g} m from the tile's middle, farther than any vertex "
                          "({:.6g} m)",
                          off, reach));
      found.finding.distance_m = off;
    }
  }

  [[nodiscard]] Vec2 place_deg(const TileBounds& b, std::uint32_t i) const {
    return {b.west + (b.east - b.west) * t_.u[i] / kTileSteps,
            b.south + (b.north - b.south) * t_.v[i] / kTileSteps};
  }

  void normals(const std::optional<TileBounds>& bounds) {
    const auto normals_number = std::uint8_t{1};
    const bool promised =
        std::find(t_.extensions.begin(), t_.extensions.end(), normals_number) != t_.extensions.end();
    if (t_.normals.size() != n_ && (promised || !t_.normals.empty())) {
      add("normal", Severity::fault, {},
          fmt::format("{} for {}", counted(t_.normals.size(), "normal", "normals"),
                      counted(n_, "vertex", "vertices")));
    }
    std::optional<TileEcef> earth;
    if (bounds) earth.emplace(*bounds);
    Ids zero, down;
    for (std::uint32_t i = 0; i < std::min(n_, t_.normals.size()); ++i) {
      const Vec3 normal = t_.normals[i];
      if (!(length(normal) > 0)) {
        zero.push_back(i);
      } else if (earth && in_range(i)) {
        const Vec2 place = place_deg(*bounds, i);
        if (dot(normal, earth->up(place.x, place.y)) < -kNormalStep) down.push_back(i);
      }
    }
    const auto tell = [&](Severity severity, Ids ids, std::string_view one, std::string_view many) {
      if (ids.empty()) return;
      auto text =
          fmt::format("{}; the first is that of vertex {}", counted(ids.size(), one, many), ids.front());
      add("normal", severity, std::move(ids), std::move(text));
    };
    tell(Severity::fault, std::move(zero), "normal has no direction", "normals have no direction");
    tell(Severity::hazard, std::move(down), "normal points into the ground", "normals point into the ground");
  }

  // Two bytes place a normal within 1/50; a wall's may seem to lean over by that much.
  static constexpr double kNormalStep = 0.02;

  const QuantizedMesh& t_;
  const std::size_t n_;
  Ids bad_triangles_;
  std::vector<std::uint8_t> used_;
  bool header_is_finite_ = true;
  std::vector<std::pair<std::pair<TileSide, TileSide>, TileFinding>> missing_corners_;
  std::vector<TileFinding> out_;
};

}  // namespace

std::vector<TileFinding> check_tile(const QuantizedMesh& tile, const std::optional<TileBounds>& bounds_deg) {
  return TileCheck(tile).run(bounds_deg);
}

}  // namespace plumbline::oracle
