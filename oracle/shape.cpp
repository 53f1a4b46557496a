// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/shape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "scenarios/portable_math.h"

namespace plumbline::oracle {
namespace {

/// 4·√3, rounded; a literal, so that no library computes it.
constexpr double kEquilateralFactor = 6.928203230275509;

/// Squares of lengths inside this range neither overflow nor lose digits to underflow.
constexpr double kLeastSquare = 0x1p-900;
constexpr double kGreatestSquare = 0x1p900;

struct PlanShape {
  double quality = 0;
  /// The least angle is atan2(rise, run): opposite to the shortest side, so run > 0 unless all sides are 0.
  double rise = 0, run = 0;
};

PlanShape plan_shape(Vec2 side_a, Vec2 side_b) {
  const Vec2 side_c = side_b - side_a;
  const double aa = side_a.x * side_a.x + side_a.y * side_a.y;
  const double bb = side_b.x * side_b.x + side_b.y * side_b.y;
  const double cc = side_c.x * side_c.x + side_c.y * side_c.y;
  const double sum = aa + bb + cc;
  const double twice_area = std::fabs(side_a.x * side_b.y - side_a.y * side_b.x);
  PlanShape shape;
  shape.quality = sum > 0 ? 0.5 * kEquilateralFactor * twice_area / sum : 0;
  shape.rise = twice_area;
  shape.run = 0.5 * sum - std::min({aa, bb, cc});  // law of cosines: (l₂² + l₃² − l₁²) / 2
  return shape;
}

PlanShape plan_shape(const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec2 to_b{b.x - a.x, b.y - a.y};
  Vec2 to_c{c.x - a.x, c.y - a.y};
  const double square = to_b.x * to_b.x + to_b.y * to_b.y + to_c.x * to_c.x + to_c.y * to_c.y;
  if (!(square >= kLeastSquare && square <= kGreatestSquare)) {
    // Shape does not depend on size: bring the size to about 1, by a power of two so that no digit changes.
    // Halves first, since a difference may overflow as well.
    to_b = {0.5 * b.x - 0.5 * a.x, 0.5 * b.y - 0.5 * a.y};
    to_c = {0.5 * c.x - 0.5 * a.x, 0.5 * c.y - 0.5 * a.y};
    const double reach =
        std::max({std::fabs(to_b.x), std::fabs(to_b.y), std::fabs(to_c.x), std::fabs(to_c.y)});
    if (reach == 0) return {};
    const int exponent = -std::ilogb(reach);
    to_b = {std::scalbn(to_b.x, exponent), std::scalbn(to_b.y, exponent)};
    to_c = {std::scalbn(to_c.x, exponent), std::scalbn(to_c.y, exponent)};
  }
  return plan_shape(to_b, to_c);
}

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Counts fans: the vertices that all triangles of the running fan have in common.
class FanCounter {
 public:
  void add(const std::array<std::uint32_t, 3>& triangle) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < common_count_; ++k) {
      const std::uint32_t v = common_[k];
      if (v == triangle[0] || v == triangle[1] || v == triangle[2]) common_[kept++] = v;
    }
    common_count_ = kept;
    if (kept > 0) return;
    common_ = triangle;
    common_count_ = 3;
    ++fans_;
  }
  [[nodiscard]] std::size_t fans() const { return fans_; }

 private:
  std::array<std::uint32_t, 3> common_{};
  std::size_t common_count_ = 0;
  std::size_t fans_ = 0;
};

}  // namespace

ShapeReport shape(const Mesh& mesh) {
  ShapeReport report;
  std::vector<std::uint32_t> valence(mesh.positions.size(), 0);
  FanCounter fans;
  std::size_t judged = 0;
  double quality_sum = 0;
  double least_quality = std::numeric_limits<double>::infinity();
  double least_tangent = std::numeric_limits<double>::infinity();
  PlanShape sharpest;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const std::size_t count = mesh.positions.size();
    if (triangle[0] >= count || triangle[1] >= count || triangle[2] >= count) continue;
    const Vec3& a = mesh.positions[triangle[0]];
    const Vec3& b = mesh.positions[triangle[1]];
    const Vec3& c = mesh.positions[triangle[2]];
    if (!finite(a) || !finite(b) || !finite(c)) continue;
    ++judged;
    for (const std::uint32_t v : triangle) ++valence[v];
    fans.add(triangle);

    const PlanShape plan = plan_shape(a, b, c);
    quality_sum += plan.quality;
    if (plan.quality < least_quality) {
      least_quality = plan.quality;
      report.worst_triangle = t;
    }
    if (plan.quality < kSliverQuality) ++report.slivers;
    const double tangent = plan.run > 0 ? plan.rise / plan.run : 0;
    if (tangent < least_tangent) {
      least_tangent = tangent;
      sharpest = plan;
    }
  }
  if (judged == 0) return report;

  report.min_quality = least_quality;
  report.mean_quality = quality_sum / static_cast<double>(judged);
  report.least_angle_deg =
      least_tangent > 0 ? exact_atan2(sharpest.rise, sharpest.run) / kRadiansPerDegree : 0;
  std::size_t used = 0;
  for (const std::uint32_t v : valence) {
    used += v > 0 ? 1 : 0;
    report.max_valence = std::max<std::size_t>(report.max_valence, v);
  }
  report.mean_valence = 3 * static_cast<double>(judged) / static_cast<double>(used);
  report.mean_fan_length = static_cast<double>(judged) / static_cast<double>(fans.fans());
  return report;
}

namespace {

/// Calls visit(from, to, vector from one to the other) for each triangle's three edges.
template <class Visit>
void each_edge(const Mesh& mesh, bool in_space, Visit&& visit) {
  const std::size_t count = mesh.positions.size();
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a >= count || b >= count || c >= count) continue;
    Vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    if (!in_space) p.z = q.z = r.z = 0;
    visit(a, b, q - p);
    visit(b, c, r - q);
    visit(c, a, p - r);
  }
}

double square(const Vec3& d) { return d.x * d.x + d.y * d.y + d.z * d.z; }

/// Without overflow or underflow; not finite if a coordinate is not.
double length_of(const Vec3& d) {
  const double reach = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
  if (!(reach > 0) || !std::isfinite(reach)) return reach;
  const int exponent = std::ilogb(reach);
  return std::scalbn(std::sqrt(square({std::scalbn(d.x, -exponent), std::scalbn(d.y, -exponent),
                                       std::scalbn(d.z, -exponent)})),
                     exponent);
}

EdgeLengths lengths_of_any_size(const Mesh& mesh, bool in_space) {
  EdgeLengths out;
  std::vector<double> lengths;
  each_edge(mesh, in_space, [&](std::uint32_t u, std::uint32_t v, const Vec3& d) {
    const double length = length_of(d);
    if (!(length > 0) || !std::isfinite(length)) return;
    if (lengths.empty() || length < out.shortest) {
      out.shortest = length;
      out.shortest_vertices = {std::min(u, v), std::max(u, v)};
    }
    lengths.push_back(length);
  });
  if (lengths.empty()) return out;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>((lengths.size() - 1) / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  out.median = *middle;
  return out;
}

/// Positive doubles are ordered as their bits: exponent and the digits that follow name a drawer.
constexpr int kDrawerShift = 49;
std::size_t drawer(double square) { return std::bit_cast<std::uint64_t>(square) >> kDrawerShift; }

}  // namespace

EdgeLengths edge_lengths(const Mesh& mesh, bool in_space) {
  // By squares, whose order is that of lengths: counted by drawers first, so that only those of the drawer in
  // the middle are kept and sorted out.
  std::vector<std::uint32_t> drawers(drawer(std::numeric_limits<double>::infinity()) + 1, 0);
  double shortest = std::numeric_limits<double>::infinity();
  EdgeLengths out;
  bool moderate = true;
  std::size_t edges = 0;
  each_edge(mesh, in_space, [&](std::uint32_t u, std::uint32_t v, const Vec3& d) {
    const double s = square(d);
    if (!(s >= kLeastSquare && s <= kGreatestSquare)) {
      moderate = moderate && d == Vec3{};
      return;
    }
    ++edges;
    ++drawers[drawer(s)];
    if (s < shortest) {
      shortest = s;
      out.shortest_vertices = {std::min(u, v), std::max(u, v)};
    }
  });
  if (!moderate) return lengths_of_any_size(mesh, in_space);
  if (edges == 0) return out;
  std::size_t rank = (edges - 1) / 2, middle = 0;
  for (; rank >= drawers[middle]; ++middle) rank -= drawers[middle];
  std::vector<double> squares;
  squares.reserve(drawers[middle]);
  each_edge(mesh, in_space, [&](std::uint32_t, std::uint32_t, const Vec3& d) {
    const double s = square(d);
    if (drawer(s) == middle) squares.push_back(s);
  });
  std::nth_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(rank), squares.end());
  out.shortest = std::sqrt(shortest);
  out.median = std::sqrt(squares[rank]);
  return out;
}

}  // namespace plumbline::oracle
