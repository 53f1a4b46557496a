// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Decided exactly: which points of one border lie on the other (predicates.h), which of the two is the higher
// there, whether a skirt reaches down to the lower. Only measured: sizes of gaps, means, lengths, angles.
// Not decided here: what happens inside either mesh (O1), and whether anybody sees it (O3).
#include "oracle/seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

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

/// A point of an edge.
struct Along {
  const BorderEdge* edge = nullptr;
  int end = -1;  ///< 0 or 1: at that end; -1: between
  Vec2 p;

  /// How far from end 0 towards end 1, and from end 1 towards end 0, as shares: the same digits whichever way
  /// the edge runs.
  template <class Number>
  [[nodiscard]] std::array<Number, 2> shares() const {
    const Vec2 d = edge->plan[1] - edge->plan[0];
    const bool x = std::fabs(d.x) >= std::fabs(d.y);
    const auto pick = [x](Vec2 q) { return Number(x ? q.x : q.y); };
    const Number from = pick(edge->plan[0]), to = pick(edge->plan[1]), at = pick(p), all = to - from;
    return {(at - from) / all, (to - at) / all};
  }
};

/// Not a number where the edge is too long for double.
double rounded(const std::array<ExactHeight, 2>& heights, const Along& at) {
  if (at.end >= 0) return heights[static_cast<std::size_t>(at.end)].metres();
  const double a = heights[0].metres(), b = heights[1].metres();
  const auto [share, rest] = at.shares<double>();
  if (!(share + rest > 0.5)) return std::numeric_limits<double>::quiet_NaN();
  return a == b ? a : a * rest + b * share;
}

Rational exact(const std::array<ExactHeight, 2>& heights, const Along& at) {
  if (at.end >= 0) return exact(heights[static_cast<std::size_t>(at.end)]);
  const Rational a = exact(heights[0]), b = exact(heights[1]);
  return a + (b - a) * at.shares<Rational>()[0];
}

double metres(const std::array<ExactHeight, 2>& heights, const Along& at) {
  const double z = rounded(heights, at);
  return std::isnan(z) ? CGAL::to_double(exact(heights, at)) : z;
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

/// A value of `rounded` errs by less than this share of the heights that it is made of: a dozen roundings;
/// and, where those underflow, by less than the least normal number.
constexpr double kHeightBound = 0x1p-48;
constexpr double kHeightUnderflow = 0x1p-1022;
/// Where the difference is not this many times the bound, it is computed exactly: its digits should be right,
/// not its sign alone.
constexpr double kDigitsToSpare = 0x1p20;

/// Height of one edge minus height of the other.
Difference difference(const std::array<ExactHeight, 2>& first, const Along& at,
                      const std::array<ExactHeight, 2>& second, const Along& other) {
  constexpr double most = std::numeric_limits<double>::max();
  if (at.end >= 0 && other.end >= 0) {
    const ExactHeight& a = first[static_cast<std::size_t>(at.end)];
    const ExactHeight& b = second[static_cast<std::size_t>(other.end)];
    if (a == b) return {0, 0};
    // A difference of two doubles is rounded once, and zero only if they are equal.
    if (a.plain() && b.plain())
      return {std::clamp(a.low - b.low, -most, most), (a.low > b.low) - (a.low < b.low)};
  }
  const double bound = kHeightBound * (size_of(first) + size_of(second)) + kHeightUnderflow;
  const double gap = rounded(first, at) - rounded(second, other);
  if (std::fabs(gap) > bound * kDigitsToSpare) return {std::clamp(gap, -most, most), gap > 0 ? 1 : -1};
  const Rational precise = exact(first, at) - exact(second, other);
  const int sign = CGAL::sign(precise);
  double out = std::clamp(CGAL::to_double(precise), -most, most);
  if (out == 0 && sign != 0) out = sign * std::numeric_limits<double>::denorm_min();
  return {out, sign};
}

/// Integrals over [0, 1] of a linear function and of its size.
double mean_of(double a, double b) { return 0.5 * a + 0.5 * b; }
double mean_abs_of(double a, double b) {
  if ((a >= 0) == (b >= 0) || a == 0 || b == 0) return 0.5 * std::fabs(a) + 0.5 * std::fabs(b);
  const double p = std::fabs(a), q = std::fabs(b);
  return 0.5 * p * (p / (p + q)) + 0.5 * q * (q / (p + q));
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
    std::vector<std::uint32_t> all(points_.size());
    std::iota(all.begin(), all.end(), 0u);
    const PointTree tree(points_, std::move(all));
    const std::vector<Piece> ours = pieces(0, tree), theirs = pieces(1, tree);
    auto other = theirs.begin();
    for (const Piece& piece : ours) {
      while (other != theirs.end() && other->key < piece.key) ++other;
      for (auto it = other; it != theirs.end() && it->key == piece.key; ++it) {
        if (it->upwards == piece.upwards) continue;  // on the same side: they overlap, which O1 tells
        meet(piece, *it);
        break;
      }
    }
    if (stretches_.empty()) return std::nullopt;
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

  /// The edges of one side, cut at the points of both: a border that touches itself may have a vertex in its
  /// own edge, and the other side's edge is cut there.
  std::vector<Piece> pieces(std::size_t side, const PointTree& tree) const {
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
    Vec2 low = points_[ends[0]], high = points_[ends[1]];
    if (before_in_plan(high, low)) std::swap(low, high);
    const double x = (high.x - low.x) * metres_per_unit_.x, y = (high.y - low.y) * metres_per_unit_.y;
    const double length = std::sqrt(x * x + y * y);
    stretches_.push_back({low, high, length, mean_of(gap[0], gap[1]), mean_abs_of(gap[0], gap[1])});
  }

  /// One end of a common piece; its gap.
  double look(const BorderEdge& ours, const BorderEdge& theirs, std::uint32_t point) {
    const Along at = along(ours, point), other = along(theirs, point);
    const Difference gap = difference(ours.height, at, theirs.height, other);
    // Another edge's vertex, of a border that touches itself: no place of these two.
    if (at.end < 0 && other.end < 0) return gap.metres;
    auto [slot, is_new] = places_.try_emplace(point);
    Place& place = slot->second;
    if (at.end >= 0 && other.end >= 0)
      compare_normals(ours.normal[static_cast<std::size_t>(at.end)],
                      theirs.normal[static_cast<std::size_t>(other.end)], place);
    // An interior point of one piece's edge may be an end of the next: a vertex counts if any piece has it.
    if (at.end >= 0 && place.vertices[0] == kNone)
      place.vertices[0] = ours.vertices[static_cast<std::size_t>(at.end)];
    if (other.end >= 0 && place.vertices[1] == kNone)
      place.vertices[1] = theirs.vertices[static_cast<std::size_t>(other.end)];
    // A skirt may end here: what is open beside one of the pieces is open.
    if (!covered(ours, at, theirs, other, gap.sign))
      (gap.sign == 0 ? place.open_touch : place.open_gap) = true;
    // A place is kept once, with its greatest gap (borders that touch themselves come by a point twice).
    const double more = is_new ? 1 : std::fabs(gap.metres) - std::fabs(place.gap.metres);
    if (more > 0) {
      place.gap = gap;
      place.z = std::max(metres(ours.height, at), metres(theirs.height, other));
    }
    if (more >= 0) {
      place.triangle = more > 0 ? ours.triangle : std::min(place.triangle, ours.triangle);
      place.other_triangle = more > 0 ? theirs.triangle : std::min(place.other_triangle, theirs.triangle);
    }
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

  /// The angle between two normals as its sine and cosine, so that only the largest is turned into an angle.
  struct Turn {
    double sine = 0, cosine = 1;
    [[nodiscard]] bool exceeds(const Turn& other) const {
      const double more = sine * other.cosine - cosine * other.sine;
      return more > 0 || (more == 0 && cosine < 0 && other.cosine > 0);
    }
  };

  struct Place {
    Difference gap;
    double z = 0;
    std::array<std::uint32_t, 2> vertices{kNone, kNone};
    std::uint32_t triangle = 0, other_triangle = 0;
    bool open_gap = false, open_touch = false;
    bool has_normals = false;
    Turn turn;
  };

  static void compare_normals(const Vec3& n, const Vec3& m, Place& place) {
    if (!(dot(n, n) > 0) || !(dot(m, m) > 0)) return;  // none
    const Vec3 c = cross(n, m);
    const Turn turn{std::sqrt(dot(c, c)), dot(n, m)};
    if (!std::isfinite(turn.sine) || !std::isfinite(turn.cosine)) return;
    if (!place.has_normals || turn.exceeds(place.turn)) place.turn = turn;
    place.has_normals = true;
  }

  void finish() {
    std::vector<std::pair<Vec2, const Place*>> order;
    for (const auto& [point, place] : places_) order.emplace_back(points_[point], &place);
    std::sort(order.begin(), order.end(),
              [](const auto& a, const auto& b) { return before_in_plan(a.first, b.first); });
    Turn largest;
    for (const auto& [p, place] : order) {
      if (place->has_normals && (seam_.normals++ == 0 || place->turn.exceeds(largest))) {
        largest = place->turn;
        seam_.normal_at = {p.x, p.y, place->z};
      }
      add_gap(p, *place);
    }
    if (seam_.normals > 0)
      seam_.normal_max_deg = exact_atan2(largest.sine, largest.cosine) / kRadiansPerDegree;
    // In plan order: the sums depend neither on the order of triangles nor on which mesh comes first.
    std::sort(stretches_.begin(), stretches_.end(), [](const Stretch& a, const Stretch& b) {
      if (a.low != b.low) return before_in_plan(a.low, b.low);
      if (a.high != b.high) return before_in_plan(a.high, b.high);
      return a.mean_abs < b.mean_abs;
    });
    for (const Stretch& s : stretches_) {
      seam_.length += s.length;
      seam_.mean_gap_m += s.length * s.mean;
      seam_.mean_abs_gap_m += s.length * s.mean_abs;
    }
    if (!(seam_.length > 0)) return;
    seam_.mean_gap_m /= seam_.length;
    seam_.mean_abs_gap_m /= seam_.length;
  }

  void add_gap(Vec2 p, const Place& place) {
    SeamGap gap;
    gap.t_junction = (place.vertices[0] == kNone) != (place.vertices[1] == kNone);
    gap.sign = place.gap.sign;
    if (!gap.t_junction && gap.sign == 0) return;
    gap.at = {p.x, p.y, place.z};
    gap.gap_m = place.gap.metres;
    gap.of_first = gap.t_junction && place.vertices[0] != kNone;
    gap.vertex = place.vertices[0] != kNone ? place.vertices[0] : place.vertices[1];
    gap.triangle = place.triangle;
    gap.other_triangle = place.other_triangle;
    gap.covered = gap.sign == 0 ? !place.open_touch : !place.open_gap;
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

  struct Stretch {
    Vec2 low, high;
    double length = 0, mean = 0, mean_abs = 0;
  };

  Vec2 metres_per_unit_;
  PointTable table_;
  std::array<std::vector<PlanEdge>, 2> sides_;
  std::vector<Vec2> points_;
  std::map<std::uint32_t, Place> places_;
  std::vector<Stretch> stretches_;
  Seam seam_;
};

}  // namespace

std::optional<Seam> compare_borders(const Border& first, const Border& second, Vec2 metres_per_unit) {
  return Comparison(first, second, metres_per_unit).run();
}

namespace {

/// The cosine and sine that still count as along and as beside: within 26 degrees. Borders that were meant to
/// meet part by less; where the sides of meshes meet in a corner, they part by more.
constexpr double kAlong = 0.9;
/// What is as near as the nearest, but for rounding.
constexpr double kAsNear = 1 + 0x1p-20;

/// Whether an edge's end p, off the other border, has the segment beside it and runs against it. Beyond the
/// segment's ends it does not: there are the corners that meshes share. One that runs the same way is the far
/// side of a strip that is thinner than a slit may be.
bool beside(const BorderEdge& edge, Vec2 p, const detail::PlanSegment& segment) {
  const Vec2 d = edge.plan[1] - edge.plan[0], s = segment.b - segment.a;
  const double edge2 = d.x * d.x + d.y * d.y, segment2 = s.x * s.x + s.y * s.y;
  const double along = d.x * s.x + d.y * s.y;
  if (!(along < 0) || !(along * along >= kAlong * kAlong * edge2 * segment2)) return false;
  const Vec2 off = detail::SegmentTree::offset(segment, p);
  const double across = off.x * s.y - off.y * s.x;
  return across * across >= kAlong * kAlong * (off.x * off.x + off.y * off.y) * segment2;
}

}  // namespace

std::optional<Slit> find_slit(const Border& first, const Border& second, double within) {
  const auto in_box = [&](Vec2 p) {
    return p.x >= second.low.x - within && p.x <= second.high.x + within && p.y >= second.low.y - within &&
           p.y <= second.high.y + within;
  };
  /// A vertex of the first border: one of its edges, and which end.
  struct Corner {
    const BorderEdge* edge = nullptr;
    std::size_t end = 0;
  };
  std::vector<Corner> corners;
  std::vector<Vec2> points;
  for (const BorderEdge& edge : first.edges) {
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      if (!in_box(edge.plan[end])) continue;
      corners.push_back({&edge, end});
      points.push_back(edge.plan[end]);
    }
  }
  if (corners.empty()) return std::nullopt;
  // Exactly on the other border: at one of its vertices, or inside one of its edges.
  std::vector<std::uint32_t> members(points.size()), touched;
  std::iota(members.begin(), members.end(), 0u);
  const PointTree tree(points, std::move(members));
  PointTable known(second.edges.size() * 2);
  std::vector<detail::PlanSegment> segments;
  for (const BorderEdge& edge : second.edges) {
    tree.inside(edge.plan[0], edge.plan[1], touched);
    for (const Vec2 p : edge.plan) known.number({p.x, p.y, 0});
    segments.push_back({edge.plan[0], edge.plan[1]});
  }
  const std::size_t vertices_of_second = known.size();
  std::vector<bool> on(points.size(), false);
  for (const std::uint32_t k : touched) on[k] = true;
  const detail::SegmentTree near(std::move(segments));
  std::optional<Slit> out;
  std::vector<bool> counted;  // by number in `known`
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::uint32_t number = known.number({points[k].x, points[k].y, 0});
    counted.resize(known.size(), false);
    if (on[k] || number < vertices_of_second || counted[number]) continue;
    const double width = near.distance(points[k]);
    if (!(width < within)) continue;
    bool misses = false;
    near.visit_within(points[k], width * kAsNear, [&](const detail::PlanSegment& segment) {
      misses |= beside(*corners[k].edge, points[k], segment);
    });
    if (!misses) continue;
    counted[number] = true;
    if (!out) out.emplace();
    ++out->vertices;
    if (!(width > out->width) && out->vertices > 1) continue;
    out->width = width;
    out->at = {points[k].x, points[k].y, corners[k].edge->height[corners[k].end].metres()};
    out->vertex = corners[k].edge->vertices[corners[k].end];
  }
  return out;
}

}  // namespace plumbline::oracle
