// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Station 5 of check_conformity: regions that are covered wrongly.
//
// The pieces that did not cancel form closed curves. Around any point, their winding number is the coverage
// there minus what the domain promises there. An exact arrangement of these pieces (CGAL, exact
// constructions) and of the promised outline has faces on which both are constant. Faces at fault of one
// class that share an edge are one region, and one finding.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <CGAL/Arr_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include "oracle/conformity_parts.h"
#include "oracle/predicates.h"
#include "oracle/segment_tree.h"

namespace plumbline::oracle::detail {
namespace {

/// Beyond so many pieces, or pairs of pieces whose boxes meet, an arrangement would take more than some ten
/// seconds or a gigabyte. Then each connected tangle of pieces is one finding, of kind "tangled".
constexpr std::size_t kMostArranged = std::size_t{1} << 18;
constexpr std::size_t kMostMeetings = std::size_t{1} << 20;
constexpr std::size_t kMostComparisons = std::size_t{1} << 28;

double finite(double figure) { return std::isfinite(figure) ? figure : std::numeric_limits<double>::max(); }

enum class Fault { none, missing, overlap, extra };

Fault judge(int coverage, int promised) {
  if (promised != 1) return coverage >= 1 ? Fault::extra : Fault::none;
  if (coverage <= 0) return Fault::missing;
  return coverage >= 2 ? Fault::overlap : Fault::none;
}

/// Without a promise: what is covered once or lies outside is right.
Fault judge_freely(int coverage, bool outside) {
  if (coverage >= 2) return Fault::overlap;
  return coverage == 1 || (coverage == 0 && outside) ? Fault::none : Fault::missing;
}

struct FaceLabel {
  int excess = 0, promised = 0;
  bool reached = false;
  Fault fault = Fault::none;
  std::uint32_t region = kNone;
};

/// Exact by lazy evaluation: intervals first, rationals where those cannot tell.
using LazyKernel = CGAL::Exact_predicates_exact_constructions_kernel;
/// Rationals throughout. CGAL 5.5's lazy constructions fail where a product overflows the intervals.
using RationalKernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
/// Coordinates within 2^±kLazyExponent (or zero): products of three of them and their errors stay normal
/// doubles.
constexpr int kLazyExponent = 300;

struct KeepFirst {  // pieces never overlap, so nothing is ever merged
  std::uint32_t operator()(std::uint32_t a, std::uint32_t) const { return a; }
};
/// One region while it is put together.
struct Region {
  Fault fault = Fault::none;
  double area_m2 = 0;
  std::vector<std::vector<Vec2>> loops;
  std::size_t outer = 0;  // of the loops: the boundary to show
  bool on_outline = false, excused = false;
  double distance_m = 0;
  std::vector<std::uint32_t> vertices, triangles;
  Vec3 at;
  bool at_vertex = false, placed = false;
};

template <typename Kernel>
class RegionFinder {
  using SegmentTraits = CGAL::Arr_segment_traits_2<Kernel>;
  using Traits = CGAL::Arr_curve_data_traits_2<SegmentTraits, std::uint32_t, KeepFirst>;
  using Arrangement = CGAL::Arrangement_2<Traits, CGAL::Arr_face_extended_dcel<Traits, FaceLabel>>;
  using Curve = typename Traits::X_monotone_curve_2;
  using Halfedge = typename Arrangement::Halfedge_handle;
  using Face = typename Arrangement::Face_handle;

 public:
  RegionFinder(const Mesh& mesh, const Residual& residual, bool outline_is_free,
               std::vector<Finding>& findings)
      : mesh_(mesh),
        residual_(residual),
        free_(outline_is_free),
        findings_(findings),
        outline_(promised_sides(residual)) {}

  void find() {
    if (too_tangled()) {
      if (free_) {
        report_not_judged();
        return;
      }
      report_tangles();
      return;
    }
    arrange();
    label();
    gather();
    for (Region& region : regions_) report(region);
  }

 private:
  static std::vector<PlanSegment> promised_sides(const Residual& residual) {
    std::vector<PlanSegment> sides;
    for (const ResidualSegment& s : residual.segments) {
      if (s.promised != 0) sides.push_back({residual.points[s.from], residual.points[s.to]});
    }
    return sides;
  }

  bool too_tangled() const {
    if (residual_.segments.size() > kMostArranged) return true;
    struct Box {
      double low_x, high_x, low_y, high_y;
    };
    std::vector<Box> boxes;
    for (const ResidualSegment& s : residual_.segments) {
      const Vec2 a = residual_.points[s.from], b = residual_.points[s.to];
      boxes.push_back({a.x, b.x, std::min(a.y, b.y), std::max(a.y, b.y)});
    }
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
      return std::array{a.low_x, a.high_x, a.low_y, a.high_y} <
             std::array{b.low_x, b.high_x, b.low_y, b.high_y};
    });
    std::size_t meetings = 0, comparisons = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low_x <= boxes[i].high_x; ++j) {
        meetings += boxes[j].low_y <= boxes[i].high_y && boxes[i].low_y <= boxes[j].high_y;
        ++comparisons;
      }
      if (meetings > kMostMeetings || comparisons > kMostComparisons) return true;
    }
    return false;
  }

  void arrange() {
    points_.reserve(residual_.points.size());
    for (const Vec2 p : residual_.points) points_.emplace_back(p.x, p.y);
    std::vector<Curve> curves;
    curves.reserve(residual_.segments.size());
    for (std::uint32_t i = 0; i < residual_.segments.size(); ++i) {
      const ResidualSegment& s = residual_.segments[i];
      curves.emplace_back(typename SegmentTraits::X_monotone_curve_2(points_[s.from], points_[s.to]), i);
    }
    CGAL::insert(arrangement_, curves.begin(), curves.end());
  }

  const ResidualSegment& segment(Halfedge edge) const { return residual_.segments[edge->curve().data()]; }

  template <typename Visit>
  static void each_edge_of(Face face, Visit&& visit) {
    const auto walk = [&visit](typename Arrangement::Ccb_halfedge_circulator start) {
      auto edge = start;
      do visit(Halfedge(edge));
      while (++edge != start);
    };
    for (auto it = face->outer_ccbs_begin(); it != face->outer_ccbs_end(); ++it) walk(*it);
    for (auto it = face->inner_ccbs_begin(); it != face->inner_ccbs_end(); ++it) walk(*it);
  }

  /// Winding numbers, from the unbounded face inwards.
  void label() {
    std::vector<Face> queue{arrangement_.unbounded_face()};
    queue.front()->data().reached = true;
    while (!queue.empty()) {
      const Face face = queue.back();
      queue.pop_back();
      const FaceLabel here = face->data();
      each_edge_of(face, [&](Halfedge edge) {
        FaceLabel& there = edge->twin()->face()->data();
        if (there.reached) return;
        const int sign = edge->direction() == CGAL::ARR_LEFT_TO_RIGHT ? -1 : 1;
        const ResidualSegment& s = segment(edge);
        there.excess = here.excess + sign * s.excess;
        there.promised = here.promised + sign * s.promised;
        const int coverage = there.excess + there.promised;
        there.fault = free_ ? judge_freely(coverage, edge->twin()->face()->is_unbounded())
                            : judge(coverage, there.promised);
        there.reached = true;
        queue.push_back(edge->twin()->face());
      });
    }
  }

  void gather() {
    for (auto face = arrangement_.faces_begin(); face != arrangement_.faces_end(); ++face) {
      if (face->data().fault == Fault::none || face->data().region != kNone) continue;
      const auto id = static_cast<std::uint32_t>(regions_.size());
      const Fault fault = face->data().fault;
      regions_.emplace_back();
      regions_.back().fault = fault;
      std::vector<Face> members{face};
      face->data().region = id;
      for (std::size_t i = 0; i < members.size(); ++i) {
        each_edge_of(members[i], [&](Halfedge edge) {
          const Face next = edge->twin()->face();
          if (next->data().fault != fault || next->data().region != kNone) return;
          next->data().region = id;
          members.push_back(next);
        });
      }
      std::vector<Halfedge> border;
      for (const Face member : members) {
        each_edge_of(member, [&](Halfedge edge) {
          note(edge, regions_[id]);
          if (edge->twin()->face()->data().region != id) border.push_back(edge);
        });
      }
      trace(border, id);
    }
  }

  /// What one edge of a region's faces tells about the region.
  void note(Halfedge edge, Region& region) const {
    const ResidualSegment& s = segment(edge);
    region.excused |= s.excused;
    region.on_outline |= s.promised != 0;
    if (s.triangle != kNone) region.triangles.push_back(s.triangle);
    for (const std::uint32_t p : {s.from, s.to}) {
      if (points_[p] != edge->target()->point()) continue;
      region.excused |= residual_.excused[p];
      place(region, p);
    }
  }

  void place(Region& region, std::uint32_t point) const {
    const Vec2 at = residual_.points[point];
    const std::uint32_t vertex = residual_.vertex[point];
    const bool is_vertex = vertex != kNone;
    if (is_vertex) region.vertices.push_back(vertex);
    const bool better = !region.placed || (is_vertex && !region.at_vertex) ||
                        (is_vertex == region.at_vertex && before_in_plan(at, {region.at.x, region.at.y}));
    if (!better) return;
    region.at = is_vertex ? mesh_.positions[vertex] : Vec3{at.x, at.y, 0};
    region.at_vertex = is_vertex;
    region.placed = true;
  }

  void trace(const std::vector<Halfedge>& border, std::uint32_t id) {
    Region& region = regions_[id];
    // A face's border edges come in a fixed order, but each loop is entered where it was met first.
    CGAL::Unique_hash_map<Halfedge, bool> walked(false);
    const auto inside = [id](Face face) { return face->data().region == id; };
    for (const Halfedge start : border) {
      if (walked[start]) continue;
      std::vector<Vec2> loop;
      Halfedge edge = start;
      do {
        walked[edge] = true;
        loop.push_back(end_of(edge));
        if (region.fault == Fault::extra || region.fault == Fault::missing)
          measure(edge, loop.back(), region);
        edge = edge->next();
        while (inside(edge->twin()->face())) edge = edge->twin()->next();
      } while (edge != start);
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), before_in_plan), loop.end());
      region.loops.push_back(std::move(loop));
    }
    region.area_m2 = plan_area_m2(region.loops);
    double greatest = -1;
    for (std::size_t i = 0; i < region.loops.size() && region.loops.size() > 1; ++i) {
      const double area = plan_area_m2(region.loops[i]);
      if (area > greatest) region.outer = i;
      greatest = std::max(greatest, area);
    }
  }

  /// Evaluates lazy numbers fully first: their interval's middle would depend on what was asked of them
  /// before.
  static double to_double(const LazyKernel::FT& x) { return CGAL::to_double(x.exact()); }
  static double to_double(const RationalKernel::FT& x) { return CGAL::to_double(x); }

  /// The plan point where an edge ends: the given doubles, or the rounded crossing of two pieces.
  Vec2 end_of(Halfedge edge) const {
    const auto& p = edge->target()->point();
    const ResidualSegment& s = segment(edge);
    for (const std::uint32_t end : {s.from, s.to}) {
      if (points_[end] == p) return residual_.points[end];
    }
    return {to_double(p.x()), to_double(p.y())};
  }

  void measure(Halfedge edge, Vec2 corner, Region& region) const {
    if (segment(edge).promised != 0 || segment(edge->next()).promised != 0) return;  // on the outline
    region.distance_m = std::max(region.distance_m, outline_.distance(corner));
  }

  void report(Region& region) {
    const bool at_border =
        region.fault == Fault::extra || (region.fault == Fault::missing && region.on_outline);
    if (region.fault == Fault::missing && region.excused) return;
    Finding finding;
    if (at_border) {
      finding.code = FindingCode::outline;
      finding.kind = region.fault == Fault::extra ? "extra" : "missing";
      finding.distance_m = finite(region.distance_m);
    } else {
      finding.code = region.fault == Fault::missing ? FindingCode::hole : FindingCode::overlap;
    }
    finding.at = region.at;
    finding.area_m2 = finite(std::max(0.0, region.area_m2));
    if (!region.loops.empty()) finding.loop = std::move(region.loops[region.outer]);
    for (auto* list : {&region.vertices, &region.triangles}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    finding.vertices = std::move(region.vertices);
    finding.triangles = std::move(region.triangles);
    findings_.push_back(std::move(finding));
  }

  /// Without a promised outline the borders themselves are residual: what is a tangle there, nobody can tell.
  void report_not_judged() {
    Finding finding;
    finding.code = FindingCode::nothing_judged;
    finding.kind = "outline";
    Region region;
    for (const ResidualSegment& s : residual_.segments) place(region, s.from);
    finding.at = region.at;
    findings_.push_back(std::move(finding));
  }

  /// For residuals that are too many for an arrangement: one finding for each set of pieces that hang
  /// together by their ends. Its code says what outweighs there; its area is that excess, integrated.
  void report_tangles() {
    std::vector<std::uint32_t> parent(residual_.points.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&parent](std::uint32_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (const ResidualSegment& s : residual_.segments) {
      if (s.excess != 0) parent[root(s.from)] = root(s.to);
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order;  // (tangle, segment)
    for (std::uint32_t i = 0; i < residual_.segments.size(); ++i) {
      if (residual_.segments[i].excess != 0) order.emplace_back(root(residual_.segments[i].from), i);
    }
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size();) {
      const std::uint32_t tangle = order[i].first;
      const Vec2 origin = residual_.points[residual_.segments[order[i].second].from];
      Region region;
      double twice = 0;
      for (; i < order.size() && order[i].first == tangle; ++i) {
        const ResidualSegment& s = residual_.segments[order[i].second];
        const Vec2 a = residual_.points[s.from] - origin, b = residual_.points[s.to] - origin;
        twice += s.excess * (a.x * b.y - a.y * b.x);
        region.excused |= s.excused || residual_.excused[s.from] || residual_.excused[s.to];
        region.on_outline |= s.promised != 0;
        if (s.triangle != kNone) region.triangles.push_back(s.triangle);
        for (const std::uint32_t p : {s.from, s.to}) {
          place(region, p);
          region.distance_m = std::max(region.distance_m, outline_.distance(residual_.points[p]));
        }
      }
      region.fault = twice > 0 ? Fault::overlap : Fault::missing;
      if (region.on_outline && twice > 0) region.fault = Fault::extra;
      region.area_m2 = std::fabs(0.5 * twice);
      const std::size_t before = findings_.size();
      report(region);
      if (findings_.size() > before) findings_.back().kind = "tangled";
    }
  }

  const Mesh& mesh_;
  const Residual& residual_;
  bool free_;
  std::vector<Finding>& findings_;
  SegmentTree outline_;
  std::vector<typename Kernel::Point_2> points_;
  Arrangement arrangement_;
  std::vector<Region> regions_;
};

}  // namespace

void find_regions(const Mesh& mesh, const Residual& residual, bool outline_is_free,
                  std::vector<Finding>& findings) {
  const bool moderate = std::all_of(residual.points.begin(), residual.points.end(), [](Vec2 p) {
    const auto fits = [](double c) { return c == 0 || std::abs(std::ilogb(c)) <= kLazyExponent; };
    return fits(p.x) && fits(p.y);
  });
  if (moderate) {
    RegionFinder<LazyKernel>(mesh, residual, outline_is_free, findings).find();
  } else {
    RegionFinder<RationalKernel>(mesh, residual, outline_is_free, findings).find();
  }
}

}  // namespace plumbline::oracle::detail
