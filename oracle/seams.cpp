// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Decided exactly: which points of one border lie on the other (predicates.h), which of the two is the higher
// there, whether a skirt reaches down to the lower. Only measured: sizes of gaps, means, lengths, angles.
// Not decided here: what happens inside either mesh (O1), and whether anybody sees it (O3).
#include "oracle/seams.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <CGAL/Exact_rational.h>

#include "oracle/conformity_parts.h"
#include "oracle/plan_weld.h"
#include "oracle/point_tree.h"
#include "oracle/predicates.h"
#include "oracle/segment_tree.h"
#include "scenarios/portable_math.h"

namespace plumbline::oracle {
namespace {

using detail::kNone;
using detail::PointTable;
using detail::PointTree;
using Rational = CGAL::Exact_rational;

Rational exact(const ExactHeight& h) {
  Rational out = Rational(h.low) - Rational(h.drop);
  if (h.step != 0) out += (Rational(h.high) - Rational(h.low)) * Rational(static_cast<int>(h.step)) / 32767;
  return out;
}

/// A point of an edge: the exact share of the way from its first end, as numerator and denominator.
struct Along {
  const BorderEdge* edge = nullptr;
  int end = -1;  ///< 0 or 1: at that end; -1: between
  Vec2 p;

  [[nodiscard]] bool by_x() const {
    const Vec2 d = edge->plan[1] - edge->plan[0];
    return std::fabs(d.x) >= std::fabs(d.y);
  }
  template <class Number>
  [[nodiscard]] Number share() const {
    const bool x = by_x();
    const auto pick = [x](Vec2 q) { return Number(x ? q.x : q.y); };
    return (pick(p) - pick(edge->plan[0])) / (pick(edge->plan[1]) - pick(edge->plan[0]));
  }
};

double rounded(const std::array<ExactHeight, 2>& heights, const Along& at) {
  if (at.end >= 0) return heights[static_cast<std::size_t>(at.end)].metres();
  const double a = heights[0].metres(), b = heights[1].metres();
  return a + (b - a) * at.share<double>();
}

Rational exact(const std::array<ExactHeight, 2>& heights, const Along& at) {
  if (at.end >= 0) return exact(heights[static_cast<std::size_t>(at.end)]);
  const Rational a = exact(heights[0]), b = exact(heights[1]);
  return a + (b - a) * at.share<Rational>();
}

double size_of(const std::array<ExactHeight, 2>& heights) {
  double size = 0;
  for (const ExactHeight& h : heights) size += std::fabs(h.low) + std::fabs(h.high) + std::fabs(h.drop);
  return size;
}

struct Difference {
  double metres = 0;
  int sign = 0;
};

/// A value of `rounded` errs by less than this share of the heights that it is made of: a dozen roundings.
constexpr double kHeightBound = 0x1p-48;
/// Where the difference is not this many times the bound, it is computed exactly: its digits should be right,
/// not its sign alone.
constexpr double kDigitsToSpare = 0x1p20;

/// Height of one edge minus height of the other.
Difference difference(const std::array<ExactHeight, 2>& first, const Along& at,
                      const std::array<ExactHeight, 2>& second, const Along& other) {
  if (at.end >= 0 && other.end >= 0 &&
      first[static_cast<std::size_t>(at.end)] == second[static_cast<std::size_t>(other.end)])
    return {0, 0};
  const double bound = kHeightBound * (size_of(first) + size_of(second));
  const double metres = rounded(first, at) - rounded(second, other);
  if (std::fabs(metres) > bound * kDigitsToSpare) return {metres, metres > 0 ? 1 : -1};
  const Rational gap = exact(first, at) - exact(second, other);
  const int sign = CGAL::sign(gap);
  double out = CGAL::to_double(gap);
  if (out == 0 && sign != 0) out = sign * std::numeric_limits<double>::denorm_min();
  return {out, sign};
}

/// Integrals over [0, 1] of a linear function and of its size.
double mean_of(double a, double b) { return 0.5 * a + 0.5 * b; }
double mean_abs_of(double a, double b) {
  if ((a >= 0) == (b >= 0) || a == 0 || b == 0) return 0.5 * std::fabs(a) + 0.5 * std::fabs(b);
  const double p = std::fabs(a), q = std::fabs(b);
  return (p * p + q * q) / (2 * (p + q));
}

struct PlanEdge {
  std::uint32_t u = 0, v = 0;  // points, in the edge's direction
  const BorderEdge* edge = nullptr;
};

struct Piece {
  std::uint64_t key = 0;  // smaller point, larger point
  const BorderEdge* edge = nullptr;
  bool upwards = false;
};

class Comparison {
 public:
  Comparison(const Border& first, const Border& second, Vec2 metres_per_unit)
      : metres_per_unit_(metres_per_unit), table_(64) {
    const Vec2 low{std::max(first.low.x, second.low.x), std::max(first.low.y, second.low.y)};
    const Vec2 high{std::min(first.high.x, second.high.x), std::min(first.high.y, second.high.y)};
    sides_[0] = near(first, low, high);
    sides_[1] = near(second, low, high);
  }

  std::optional<Seam> run() {
    if (sides_[0].empty() || sides_[1].empty()) return std::nullopt;
    for (std::uint32_t k = 0; k < table_.size(); ++k) points_.push_back({table_[k].x, table_[k].y});
    const std::vector<Piece> ours = pieces(0), theirs = pieces(1);
    auto other = theirs.begin();
    for (const Piece& piece : ours) {
      while (other != theirs.end() && other->key < piece.key) ++other;
      for (auto it = other; it != theirs.end() && it->key == piece.key; ++it) {
        if (it->upwards == piece.upwards) continue;  // on the same side: they overlap, which O1 tells
        meet(piece, *it);
        break;
      }
    }
    if (seam_.length == 0 && places_.empty()) return std::nullopt;
    finish();
    return std::move(seam_);
  }

 private:
  std::vector<PlanEdge> near(const Border& border, Vec2 low, Vec2 high) {
    std::vector<PlanEdge> out;
    for (const BorderEdge& edge : border.edges) {
      const Vec2 a = edge.plan[0], b = edge.plan[1];
      if (std::max(a.x, b.x) < low.x || std::min(a.x, b.x) > high.x || std::max(a.y, b.y) < low.y ||
          std::min(a.y, b.y) > high.y)
        continue;
      out.push_back({table_.number({a.x, a.y, 0}), table_.number({b.x, b.y, 0}), &edge});
    }
    return out;
  }

  /// The edges of one side, cut at the other side's points.
  std::vector<Piece> pieces(std::size_t side) {
    std::vector<std::uint32_t> ends;
    for (const PlanEdge& e : sides_[1 - side]) ends.insert(ends.end(), {e.u, e.v});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const PointTree tree(points_, std::move(ends));
    std::vector<Piece> out;
    std::vector<std::uint32_t> stops;
    for (const PlanEdge& e : sides_[side]) {
      stops.assign(1, e.u);
      tree.inside(points_[e.u], points_[e.v], stops);
      stops.push_back(e.v);
      for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        const std::uint32_t p = stops[k], q = stops[k + 1];
        out.push_back({std::uint64_t{std::min(p, q)} << 32 | std::max(p, q), e.edge, p < q});
      }
    }
    std::stable_sort(out.begin(), out.end(), [](const Piece& a, const Piece& b) { return a.key < b.key; });
    return out;
  }

  Along along(const BorderEdge& edge, std::uint32_t point) const {
    const Vec2 p = points_[point];
    return {&edge, p == edge.plan[0] ? 0 : p == edge.plan[1] ? 1 : -1, p};
  }

  void meet(const Piece& ours, const Piece& theirs) {
    const std::array<std::uint32_t, 2> ends{static_cast<std::uint32_t>(ours.key >> 32),
                                            static_cast<std::uint32_t>(ours.key)};
    std::array<double, 2> gap{};
    for (std::size_t k = 0; k < 2; ++k) gap[k] = look(*ours.edge, *theirs.edge, ends[k]);
    const Vec2 d = points_[ends[1]] - points_[ends[0]];
    const double x = d.x * metres_per_unit_.x, y = d.y * metres_per_unit_.y;
    const double length = std::sqrt(x * x + y * y);
    seam_.length += length;
    seam_.mean_gap_m += length * mean_of(gap[0], gap[1]);
    seam_.mean_abs_gap_m += length * mean_abs_of(gap[0], gap[1]);
  }

  /// One end of a common piece; its gap. A place is kept once, with its greatest gap (borders that touch
  /// themselves come by a point twice).
  double look(const BorderEdge& ours, const BorderEdge& theirs, std::uint32_t point) {
    const Along at = along(ours, point), other = along(theirs, point);
    const Difference gap = difference(ours.height, at, theirs.height, other);
    if (at.end >= 0 && other.end >= 0) compare_normals(ours, at, theirs, other);
    const bool t_junction = (at.end >= 0) != (other.end >= 0);
    auto [slot, is_new] = places_.try_emplace(point);
    Place& place = slot->second;
    // An interior point of one piece's edge may be an end of the next: a vertex counts if any piece has it.
    place.ours |= at.end >= 0;
    place.theirs |= other.end >= 0;
    if (!is_new && !(std::fabs(gap.metres) > std::fabs(place.gap.gap_m))) return gap.metres;
    SeamGap& out = place.gap;
    out.gap_m = gap.metres;
    out.sign = gap.sign;
    const double z = std::max(rounded(ours.height, at), rounded(theirs.height, other));
    out.at = {points_[point].x, points_[point].y, z};
    out.of_first = t_junction && at.end >= 0;
    const bool use_ours = at.end >= 0;
    const BorderEdge& host = use_ours ? ours : theirs;
    const int end = use_ours ? at.end : other.end;
    out.vertex = host.vertices[static_cast<std::size_t>(std::max(end, 0))];
    out.triangle = ours.triangle;
    out.other_triangle = theirs.triangle;
    out.covered = covered(ours, at, theirs, other, gap.sign);
    return gap.metres;
  }

  static bool covered(const BorderEdge& ours, const Along& at, const BorderEdge& theirs, const Along& other,
                      int sign) {
    if (sign == 0) return ours.has_skirt || theirs.has_skirt;
    const BorderEdge& higher = sign > 0 ? ours : theirs;
    const BorderEdge& lower = sign > 0 ? theirs : ours;
    if (!higher.has_skirt) return false;
    const Along& above = sign > 0 ? at : other;
    const Along& below = sign > 0 ? other : at;
    return difference(higher.foot, above, lower.height, below).sign <= 0;
  }

  void compare_normals(const BorderEdge& ours, const Along& at, const BorderEdge& theirs,
                       const Along& other) {
    const Vec3 n = ours.normal[static_cast<std::size_t>(at.end)];
    const Vec3 m = theirs.normal[static_cast<std::size_t>(other.end)];
    if (n == Vec3{} || m == Vec3{}) return;
    ++seam_.normals;
    const Vec3 c = cross(n, m);
    // Compared by tangent, so that only the largest is turned into an angle.
    const double sine = std::sqrt(dot(c, c)), cosine = dot(n, m);
    const bool larger = sine * largest_cosine_ > cosine * largest_sine_;
    if (seam_.normals > 1 && !larger) return;
    largest_sine_ = sine;
    largest_cosine_ = cosine;
    const Along& here = at;
    seam_.normal_at = {here.p.x, here.p.y, rounded(ours.height, at)};
  }

  void finish() {
    std::vector<std::pair<Vec2, Place>> order;
    for (auto& [point, place] : places_) order.emplace_back(points_[point], place);
    std::sort(order.begin(), order.end(),
              [](const auto& a, const auto& b) { return before_in_plan(a.first, b.first); });
    for (auto& [p, place] : order) {
      SeamGap& gap = place.gap;
      gap.t_junction = place.ours != place.theirs;
      if (!gap.t_junction && gap.sign == 0) continue;
      seam_.t_junctions += gap.t_junction;
      seam_.cracks += gap.sign != 0;
      seam_.uncovered += !gap.covered;
      if (std::fabs(gap.gap_m) > std::fabs(seam_.largest_gap_m)) {
        seam_.largest_gap_m = gap.gap_m;
        seam_.largest_at = gap.at;
      }
      seam_.first_over_second_m = std::max(seam_.first_over_second_m, gap.gap_m);
      seam_.second_over_first_m = std::max(seam_.second_over_first_m, -gap.gap_m);
      seam_.gaps.push_back(gap);
    }
    if (seam_.length > 0) {
      seam_.mean_gap_m /= seam_.length;
      seam_.mean_abs_gap_m /= seam_.length;
    }
    if (seam_.normals > 0)
      seam_.normal_max_deg = exact_atan2(largest_sine_, largest_cosine_) / kRadiansPerDegree;
  }

  struct Place {
    SeamGap gap;
    bool ours = false, theirs = false;
  };

  Vec2 metres_per_unit_;
  PointTable table_;
  std::array<std::vector<PlanEdge>, 2> sides_;
  std::vector<Vec2> points_;
  std::map<std::uint32_t, Place> places_;
  double largest_sine_ = 0, largest_cosine_ = 1;
  Seam seam_;
};

}  // namespace

std::optional<Seam> compare_borders(const Border& first, const Border& second, Vec2 metres_per_unit) {
  return Comparison(first, second, metres_per_unit).run();
}

std::optional<Slit> find_slit(const Border& first, const Border& second, double within) {
  const auto in_box = [&](Vec2 p) {
    return p.x >= second.low.x - within && p.x <= second.high.x + within && p.y >= second.low.y - within &&
           p.y <= second.high.y + within;
  };
  std::vector<const BorderEdge*> edges;
  for (const BorderEdge& edge : first.edges) {
    if (in_box(edge.plan[0])) edges.push_back(&edge);
  }
  if (edges.empty()) return std::nullopt;
  std::vector<detail::PlanSegment> segments;
  std::vector<Vec2> points;
  for (const BorderEdge& edge : second.edges) segments.push_back({edge.plan[0], edge.plan[1]});
  for (const BorderEdge* edge : edges) points.push_back(edge->plan[0]);
  // Exactly on the other border: at one of its vertices, or inside one of its edges.
  std::vector<std::uint32_t> members(points.size()), touched;
  for (std::uint32_t k = 0; k < members.size(); ++k) members[k] = k;
  const PointTree tree(points, members);
  PointTable corners(second.edges.size() * 2);
  for (const BorderEdge& edge : second.edges) {
    tree.inside(edge.plan[0], edge.plan[1], touched);
    for (const Vec2 p : edge.plan) corners.number({p.x, p.y, 0});
  }
  const std::size_t known = corners.size();
  std::vector<bool> on(points.size(), false);
  for (const std::uint32_t k : touched) on[k] = true;
  const detail::SegmentTree near(std::move(segments));
  std::optional<Slit> out;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (on[k] || corners.number({points[k].x, points[k].y, 0}) < known) continue;
    const double width = near.distance(points[k]);
    if (!(width < within)) continue;
    if (!out) out.emplace();
    ++out->vertices;
    if (!(width > out->width) && out->vertices > 1) continue;
    out->width = width;
    out->at = {points[k].x, points[k].y, edges[k]->height[0].metres()};
    out->vertex = edges[k]->vertices[0];
  }
  return out;
}

}  // namespace plumbline::oracle
