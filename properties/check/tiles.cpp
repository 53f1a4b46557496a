// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quantized-mesh tiles: neighbours of equal and of neighbouring levels against each other, levels against
// their neighbours'; the skirts that a client adds.
#include "properties/check/tiles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "properties/check/between.h"
#include "scenarios/error.h"

namespace plumbline::checking {
namespace {

using oracle::FindingCode;
using oracle::Severity;

/// A tile's place, with y from the south: what neighbours are found by.
using Key = std::tuple<int, std::uint32_t, std::uint32_t>;

/// Level 0 of CesiumJS's terrain: a quarter of the equator over 65 samples, metres; divided by the number of
/// tiles around the world.
constexpr double kCesiumLevelZeroErrorM = 2 * 77067.34;
constexpr double kCesiumSkirtErrors = 5;

class TileSeams {
 public:
  explicit TileSeams(Examination& exam) : exam_(exam) {
    for (std::uint32_t k = 0; k < exam.subjects.size(); ++k) {
      const Subject& subject = exam.subjects[k];
      if (!subject.tile || !subject.tile->placed) continue;
      const TilePlace& tile = *subject.tile;
      if (!by_place_.try_emplace({tile.level, tile.x, tile.y}, k).second)
        exam.verdict.notes.push_back(
            fmt::format("{} is there twice: neighbours were held against the first", subject.facts.name));
    }
  }

  void judge() {
    for (const auto& entry : by_place_) {
      const std::uint32_t k = entry.second;
      for (const TileSide side : kTileSides) {
        // Each pair of one level once: from the west and from the south.
        if (side == TileSide::east || side == TileSide::north) {
          if (const auto other = beside(k, side)) compare(k, *other, side);
        }
        for (const std::uint32_t child : children_beside(k, side)) compare(k, child, side);
      }
    }
    judge_balance();
    report_lattice();
    if (columns_between_levels_ > 0)
      exam_.verdict.notes.push_back(
          fmt::format("{} of the borders between levels run along a column and were not compared: with "
                      "EPSG:3857 latitude "
                      "runs evenly inside a tile only, so places on them agree at the tiles' corners alone",
                      columns_between_levels_));
  }

 private:
  const TilePlace& tile(std::uint32_t k) const { return *exam_.subjects[k].tile; }

  std::optional<std::uint32_t> at(Key key) const {
    const auto found = by_place_.find(key);
    return found == by_place_.end() ? std::nullopt : std::optional(found->second);
  }

  /// The place beyond a side; the world closes at the antimeridian, and ends at the poles.
  std::optional<Key> place_beside(const TilePlace& t, TileSide side) const {
    std::int64_t x = t.x, y = t.y;
    if (side == TileSide::east) x += 1;
    if (side == TileSide::west) x -= 1;
    if (side == TileSide::north) y += 1;
    if (side == TileSide::south) y -= 1;
    if (y < 0 || y >= std::int64_t{1} << t.level) return std::nullopt;
    const std::int64_t columns = static_cast<std::int64_t>(t.columns);
    return Key{t.level, static_cast<std::uint32_t>((x + columns) % columns), static_cast<std::uint32_t>(y)};
  }
  std::optional<std::uint32_t> beside(std::uint32_t k, TileSide side) const {
    const auto place = place_beside(tile(k), side);
    return place ? at(*place) : std::nullopt;
  }

  std::vector<std::uint32_t> children_beside(std::uint32_t k, TileSide side) const {
    std::vector<std::uint32_t> out;
    const auto place = place_beside(tile(k), side);
    if (!place) return out;
    const auto [level, x, y] = *place;
    for (const std::uint32_t i : {0u, 1u}) {
      const std::uint32_t column = 2 * x + (side == TileSide::east ? 0 : side == TileSide::west ? 1 : i);
      const std::uint32_t row = 2 * y + (side == TileSide::north ? 0 : side == TileSide::south ? 1 : i);
      if (const auto child = at({level + 1, column, row})) out.push_back(*child);
    }
    return out;
  }

  /// The border on one side, in steps of `finest`, relative to the south-west corner of `origin`; `turns`
  /// times around the world to the east.
  oracle::Border side_of(std::uint32_t k, TileSide side, int finest, const TilePlace& origin,
                         double turns) const {
    const TilePlace& t = tile(k);
    const auto steps = [&](const TilePlace& of) {
      return std::ldexp(kTileSteps, finest - of.level);  // width of a tile
    };
    Vec2 base{t.x * steps(t) - origin.x * steps(origin), t.y * steps(t) - origin.y * steps(origin)};
    base.x += turns * static_cast<double>(t.columns) * steps(t);
    const double scale = std::ldexp(1.0, finest - t.level);
    const auto on_side = [&](Vec2 p) {
      switch (side) {
        case TileSide::west:
          return p.x == 0;
        case TileSide::east:
          return p.x == kTileSteps;
        case TileSide::south:
          return p.y == 0;
        case TileSide::north:
          return p.y == kTileSteps;
      }
      return false;
    };
    oracle::Border out;
    constexpr double inf = std::numeric_limits<double>::infinity();
    out.low = {inf, inf};
    out.high = {-inf, -inf};
    for (oracle::BorderEdge edge : exam_.subjects[k].border.edges) {
      if (!on_side(edge.plan[0]) || !on_side(edge.plan[1])) continue;
      for (Vec2& p : edge.plan) {
        p = p * scale + base;
        out.low = {std::min(out.low.x, p.x), std::min(out.low.y, p.y)};
        out.high = {std::max(out.high.x, p.x), std::max(out.high.y, p.y)};
      }
      out.edges.push_back(edge);
    }
    return out;
  }

  static TileSide opposite(TileSide side) {
    switch (side) {
      case TileSide::west:
        return TileSide::east;
      case TileSide::east:
        return TileSide::west;
      case TileSide::south:
        return TileSide::north;
      case TileSide::north:
        break;
    }
    return TileSide::south;
  }

  void compare(std::uint32_t a, std::uint32_t b, TileSide side) {
    const TilePlace &first = tile(a), &second = tile(b);
    const bool along_a_column = side == TileSide::east || side == TileSide::west;
    if (first.grid.projection == TileProjection::mercator && along_a_column && first.level != second.level) {
      ++columns_between_levels_;
      return;
    }
    const int finest = std::max(first.level, second.level);
    // Beyond the antimeridian lies the world's other end.
    const double turns = side == TileSide::east && first.x == first.columns - 1 ? 1
                         : side == TileSide::west && first.x == 0               ? -1
                                                                                : 0;
    const oracle::Border ours = side_of(a, side, finest, first, 0);
    const oracle::Border theirs = side_of(b, opposite(side), finest, first, turns);
    const double scale = std::ldexp(1.0, first.level - finest);
    const auto seam = oracle::compare_borders(ours, theirs, first.metres_per_step * scale);
    if (!seam) return;  // one of them does not reach the side: its own finding
    const TileGrid grid = first.grid;
    const TileAddress address = first.address;
    const Vec2 step{scale, scale};
    Pair pair{a,
              b,
              1,
              first.quantum_m() * 0.5 + second.quantum_m() * 0.5,
              first.level == second.level || exam_.request.skirt_m || exam_.request.cesium_skirt,
              [grid, address, step](Vec3 p) {
                const Vec2 deg = grid.position_deg(address, p.x * step.x, p.y * step.y);
                return Vec3{deg.x, deg.y, p.z};
              }};
    report_seam(exam_, pair, *seam);
    look_for_near_misses(pair, *seam, ours, theirs);
  }

  /// Vertices that miss their partner by the rounding of one lattice step: the middle of a tile's side is no
  /// place of its lattice, and two writers may round one place to different steps.
  void look_for_near_misses(const Pair& pair, const oracle::Seam& seam, const oracle::Border& ours,
                            const oracle::Border& theirs) {
    const double reach = std::ldexp(1.0, std::abs(tile(pair.first).level - tile(pair.second).level));
    std::set<std::pair<double, double>> corners[2];
    for (const oracle::BorderEdge& edge : ours.edges) corners[0].insert({edge.plan[0].x, edge.plan[0].y});
    for (const oracle::BorderEdge& edge : theirs.edges) corners[1].insert({edge.plan[0].x, edge.plan[0].y});
    for (const oracle::BorderEdge& edge : ours.edges) corners[0].insert({edge.plan[1].x, edge.plan[1].y});
    for (const oracle::BorderEdge& edge : theirs.edges) corners[1].insert({edge.plan[1].x, edge.plan[1].y});
    const auto near = [&](const std::set<std::pair<double, double>>& points, const Vec3& p) {
      const auto from = points.lower_bound({p.x - reach, p.y - reach});
      for (auto it = from; it != points.end() && it->first <= p.x + reach; ++it) {
        if (std::fabs(it->second - p.y) <= reach) return true;
      }
      return false;
    };
    std::size_t count = 0;
    const oracle::SeamGap* first = nullptr;
    for (const oracle::SeamGap& gap : seam.gaps) {
      if (!gap.t_junction || !near(corners[gap.of_first ? 1 : 0], gap.at)) continue;
      if (first == nullptr) first = &gap;
      ++count;
    }
    if (first == nullptr) return;
    const bool levels = tile(pair.first).level != tile(pair.second).level;
    if (levels && lattice_borders_++ > 0) {
      lattice_vertices_ += count;
      return;
    }
    verdict::CheckFinding found;
    found.finding.code = FindingCode::slit;
    found.finding.kind = "lattice";
    found.finding.severity = Severity::hazard;
    found.finding.at = first->at;
    found.finding.vertices = {first->vertex};
    found.mesh = first->of_first ? pair.first : pair.second;
    found.other_mesh = first->of_first ? pair.second : pair.first;
    found.at = pair.to_file(first->at);
    if (levels) {
      lattice_ = std::move(found);
      lattice_vertices_ = count;
      return;
    }
    found.message =
        fmt::format("{} the other tile's by one lattice step: the two writers rounded one place differently",
                    vertices_miss(count));
    exam_.between.push_back(std::move(found));
  }

  static std::string vertices_miss(std::size_t count) {
    return fmt::format("{} {}", count, count == 1 ? "vertex misses" : "vertices miss");
  }

  /// Between levels it is so wherever a side is halved: told once, with the first place.
  void report_lattice() {
    if (!lattice_) return;
    lattice_->message = fmt::format(
        "{} the other tile's by one lattice step or less, on {} border{} between levels, here for one: the "
        "middle of a "
        "side, 16383.5, is no place of the coarser lattice",
        vertices_miss(lattice_vertices_), lattice_borders_, lattice_borders_ == 1 ? "" : "s");
    exam_.between.push_back(std::move(*lattice_));
  }

  /// A client draws the deepest tiles that there are: beside a tile without children lies one of its own
  /// level, or an ancestor of that place. Two levels apart or more is what renderers' stitching does not
  /// expect.
  void judge_balance() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> told;
    for (const auto& [key, k] : by_place_) {
      if (has_children(key)) continue;
      for (const TileSide side : kTileSides) {
        auto place = place_beside(tile(k), side);
        int apart = 0;
        while (place && !at(*place) && std::get<0>(*place) > 0) {
          const auto [level, x, y] = *place;
          place = Key{level - 1, x / 2, y / 2};
          ++apart;
        }
        if (!place || apart < 2) continue;
        const auto other = at(*place);
        if (!other || !told.insert({k, *other}).second) continue;
        compare(*other, k, opposite(side));  // which is what a client draws, whatever it should
        verdict::CheckFinding found;
        found.finding.code = FindingCode::level_gap;
        found.finding.severity = Severity::hazard;
        found.mesh = k;
        found.other_mesh = *other;
        const TilePlace& t = tile(k);
        const Vec2 middle{side == TileSide::east   ? kTileSteps
                          : side == TileSide::west ? 0
                                                   : kTileSteps * 0.5,
                          side == TileSide::north   ? kTileSteps
                          : side == TileSide::south ? 0
                                                    : kTileSteps * 0.5};
        const Vec2 deg = t.grid.position_deg(t.address, middle.x, middle.y);
        found.at = {deg.x, deg.y, t.low_m};
        found.finding.at = {middle.x, middle.y, t.low_m};
        found.message = fmt::format(
            "{} and {} are the deepest tiles on the two sides of this border, {} levels apart; renderers "
            "expect "
            "neighbours one level apart, and skirts are sized for that",
            exam_.subjects[k].facts.name, exam_.subjects[*other].facts.name, apart);
        exam_.between.push_back(std::move(found));
      }
    }
  }

  bool has_children(const Key& key) const {
    const auto [level, x, y] = key;
    for (const std::uint32_t i : {0u, 1u}) {
      for (const std::uint32_t j : {0u, 1u}) {
        if (at({level + 1, 2 * x + i, 2 * y + j})) return true;
      }
    }
    return false;
  }

  Examination& exam_;
  std::map<Key, std::uint32_t> by_place_;
  /// Near misses between levels: the first, how many vertices, on how many borders.
  std::optional<verdict::CheckFinding> lattice_;
  std::size_t lattice_vertices_ = 0, lattice_borders_ = 0;
  std::size_t columns_between_levels_ = 0;
};

}  // namespace

double cesium_skirt_m(const TileGrid& grid, int level) {
  const double error_m = kCesiumLevelZeroErrorM / grid.columns(0);
  return std::ldexp(kCesiumSkirtErrors * error_m, -level);
}

void apply_stated_skirts(Examination& exam) {
  const CheckRequest& request = exam.request;
  if (!request.skirt_m && !request.cesium_skirt) return;
  for (Subject& subject : exam.subjects) {
    if (!subject.facts.terrain) continue;
    double depth_m = request.skirt_m.value_or(0);
    if (request.cesium_skirt) {
      if (!subject.tile || !subject.tile->placed)
        throw InputError(fmt::format("--skirt cesium: {} has no level; give the skirt's height in metres",
                                     subject.facts.file));
      depth_m = cesium_skirt_m(subject.tile->grid, subject.tile->level);
    }
    subject.facts.skirt.stated = true;
    if (!(depth_m > 0)) continue;
    // What hangs in the file hangs there still: the deeper of the two hides.
    const double drop = depth_m / (subject.tile ? 1 : exam.frame.unit_m);
    for (oracle::BorderEdge& edge : subject.border.edges) {
      for (std::size_t k = 0; k < 2; ++k) {
        oracle::ExactHeight foot = edge.height[k];
        foot.drop = drop;
        if (!edge.has_skirt || foot.metres() < edge.foot[k].metres()) edge.foot[k] = foot;
      }
      edge.has_skirt = true;
    }
    verdict::SkirtFigures& skirt = subject.facts.skirt;
    skirt.least_depth_m = skirt.border_share == 1 ? std::max(skirt.least_depth_m, depth_m) : depth_m;
    skirt.border_share = 1;
  }
}

void judge_tiles_between(Examination& exam) { TileSeams(exam).judge(); }

}  // namespace plumbline::checking
