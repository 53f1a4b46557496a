// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// compare_borders beside a slow route that shares no code with it (every pair of edges, in rationals, by the
// definition), beside check_conformity on the two meshes put together, and beside itself under everything
// that must not change a figure.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/conformity.h"
#include "oracle/seams.h"
#include "scenarios/random.h"
#include "tests/oracle/border_support.h"

namespace plumbline::oracle {
namespace {

using test::chain;
using test::Post;
using ::testing::SizeIs;

Seam seam_of(const Border& first, const Border& second) {
  const auto seam = compare_borders(first, second);
  EXPECT_TRUE(seam) << "they share no stretch";
  return seam.value_or(Seam{});
}

// What must not change anything.

struct Scene {
  Border first, second;
};
/// Off the axes, with everything in it: T-vertices of both, gaps of both signs, skirts, a common vertex.
Scene askew() {
  const auto at = [](double k, double z, double skirt_m = 0) { return Post{{8 + 3 * k, 1 + k, z}, skirt_m}; };
  return {chain({at(0, 1, 1), at(2, 2.5, 1), at(3, 7), at(8, -2)}),
          chain({at(9, 0), at(6, 1, 0.5), at(3, 7.5, 3), at(1, 1, 3), at(0, 1)})};
}

/// Everything but places and meshes' numbers.
std::vector<double> figures(const Seam& seam, double sign, double unit) {
  std::vector<double> all{static_cast<double>(seam.t_junctions),
                          static_cast<double>(seam.cracks),
                          static_cast<double>(seam.uncovered),
                          static_cast<double>(seam.gaps.size()),
                          sign > 0 ? seam.first_over_second_m / unit : seam.second_over_first_m / unit,
                          sign > 0 ? seam.second_over_first_m / unit : seam.first_over_second_m / unit,
                          sign * seam.largest_gap_m / unit};
  return all;
}

TEST(Seams, SymmetriesScalesAndShiftsMoveThePlacesAlong) {
  const Scene scene = askew();
  const Seam seam = seam_of(scene.first, scene.second);
  EXPECT_EQ(seam.t_junctions, 4u);
  EXPECT_EQ(seam.cracks, 5u);
  for (int number = 0; number < 8; ++number) {
    for (const double scale : {1.0, 0x1p-40, 0x1p60}) {
      // As far from the origin as coordinates about the Earth's middle are.
      for (const Vec3 shift : {Vec3{}, Vec3{6378137, -4190208.125, 0}}) {
        test::Move move = test::symmetry(number);
        move.scale = scale;
        if (scale == 1) move.shift = shift;
        const Seam there = seam_of(test::moved(scene.first, move), test::moved(scene.second, move));
        EXPECT_EQ(figures(there, 1, scale), figures(seam, 1, 1)) << move.name();
        EXPECT_DOUBLE_EQ(there.length / scale, seam.length);
        EXPECT_DOUBLE_EQ(there.mean_gap_m / scale, seam.mean_gap_m);
        EXPECT_DOUBLE_EQ(there.mean_abs_gap_m / scale, seam.mean_abs_gap_m);
        std::vector<std::array<double, 5>> ours, theirs;
        for (const SeamGap& g : seam.gaps)
          ours.push_back({move(g.at).x, move(g.at).y, move(g.at).z, g.gap_m * scale, g.covered ? 1.0 : 0.0});
        for (const SeamGap& g : there.gaps)
          theirs.push_back({g.at.x, g.at.y, g.at.z, g.gap_m, g.covered ? 1.0 : 0.0});
        std::sort(ours.begin(), ours.end());
        std::sort(theirs.begin(), theirs.end());
        EXPECT_EQ(theirs, ours) << move.name();
      }
    }
  }
}

TEST(Seams, SwappedMeshesChangeTheSignAlone) {
  const Scene scene = askew();
  const Seam seam = seam_of(scene.first, scene.second), back = seam_of(scene.second, scene.first);
  EXPECT_EQ(figures(back, -1, 1), figures(seam, 1, 1));
  EXPECT_EQ(back.mean_gap_m, -seam.mean_gap_m);
  EXPECT_EQ(back.mean_abs_gap_m, seam.mean_abs_gap_m);
  ASSERT_THAT(back.gaps, SizeIs(seam.gaps.size()));
  for (std::size_t k = 0; k < back.gaps.size(); ++k) {
    EXPECT_EQ(back.gaps[k].at, seam.gaps[k].at);
    EXPECT_EQ(back.gaps[k].gap_m, -seam.gaps[k].gap_m);
    EXPECT_EQ(back.gaps[k].sign, -seam.gaps[k].sign);
    EXPECT_EQ(back.gaps[k].covered, seam.gaps[k].covered);
    EXPECT_EQ(back.gaps[k].triangle, seam.gaps[k].other_triangle);
    if (seam.gaps[k].t_junction) {
      EXPECT_NE(back.gaps[k].of_first, seam.gaps[k].of_first);
      EXPECT_EQ(back.gaps[k].vertex, seam.gaps[k].vertex);
    }
  }
}

TEST(Seams, TheOrderOfEdgesDoesNotMatter) {
  const Scene scene = askew();
  const Seam seam = seam_of(scene.first, scene.second);
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    Scene other = scene;
    for (Border* border : {&other.first, &other.second}) {
      const auto order = test::random_order(border->edges.size(), random);
      const auto edges = border->edges;
      for (std::size_t k = 0; k < order.size(); ++k) border->edges[k] = edges[order[k]];
    }
    const Seam there = seam_of(other.first, other.second);
    EXPECT_EQ(figures(there, 1, 1), figures(seam, 1, 1));
    EXPECT_EQ(there.mean_gap_m, seam.mean_gap_m);
    EXPECT_EQ(there.mean_abs_gap_m, seam.mean_abs_gap_m);
    for (std::size_t k = 0; k < seam.gaps.size(); ++k) {
      EXPECT_EQ(there.gaps.at(k).at, seam.gaps[k].at);
      EXPECT_EQ(there.gaps[k].gap_m, seam.gaps[k].gap_m);
      EXPECT_EQ(there.gaps[k].vertex, seam.gaps[k].vertex);
    }
  }
}

// The slow route.

using Rational = CGAL::Exact_rational;

Rational exact(const ExactHeight& h) {
  return Rational(h.low) - Rational(h.drop) +
         (Rational(h.high) - Rational(h.low)) * Rational(static_cast<int>(h.step)) / 32767;
}

/// Gaps of one place, of a border that touches itself: which of two is the greater, doubles may not tell.
constexpr double kSameSize = 1e-13;

struct SlowPlace {
  Rational gap = 0;
  bool ours = false, theirs = false, open_gap = false, open_touch = false;
  bool ambiguous = false;  ///< the greatest two are of one size
  std::vector<double> angles_deg;
};
struct SlowSeam {
  std::map<std::pair<double, double>, SlowPlace> places;
  double length = 0, mean = 0, mean_abs = 0, size = 0;  ///< sums; `size` of all heights
};

/// How far along edge e the point p of its line is, as a share.
Rational share(const BorderEdge& e, Vec2 p) {
  const Rational dx = Rational(e.plan[1].x) - Rational(e.plan[0].x),
                 dy = Rational(e.plan[1].y) - Rational(e.plan[0].y);
  return ((Rational(p.x) - Rational(e.plan[0].x)) * dx + (Rational(p.y) - Rational(e.plan[0].y)) * dy) /
         (dx * dx + dy * dy);
}
bool on_line(const BorderEdge& e, Vec2 p) {
  const Rational dx = Rational(e.plan[1].x) - Rational(e.plan[0].x),
                 dy = Rational(e.plan[1].y) - Rational(e.plan[0].y);
  return dx * (Rational(p.y) - Rational(e.plan[0].y)) == dy * (Rational(p.x) - Rational(e.plan[0].x));
}
Rational height(const std::array<ExactHeight, 2>& h, const Rational& t) {
  return exact(h[0]) + (exact(h[1]) - exact(h[0])) * t;
}
Rational size(const Rational& r) { return r < 0 ? Rational(-r) : r; }

void meet(const BorderEdge& e, const BorderEdge& f, SlowSeam& seam) {
  if (!on_line(e, f.plan[0]) || !on_line(e, f.plan[1])) return;
  const Rational t0 = share(e, f.plan[1]), t1 = share(e, f.plan[0]);
  if (t0 > t1) return;  // on the same side
  if (t0 >= 1 || t1 <= 0) return;
  const Vec2 low = t0 > 0 ? f.plan[1] : e.plan[0], high = t1 < 1 ? f.plan[0] : e.plan[1];
  std::array<Rational, 2> gaps;
  for (const std::size_t k : {0u, 1u}) {
    const Vec2 p = k == 0 ? low : high;
    const Rational s = share(e, p), t = share(f, p);
    const Rational gap = height(e.height, s) - height(f.height, t);
    gaps[k] = gap;
    SlowPlace& place = seam.places[{p.x, p.y}];
    const bool ours = s == 0 || s == 1, theirs = t == 0 || t == 1;
    place.ours |= ours;
    place.theirs |= theirs;
    bool covered = e.has_skirt || f.has_skirt;
    if (gap > 0) covered = e.has_skirt && height(e.foot, s) <= height(f.height, t);
    if (gap < 0) covered = f.has_skirt && height(f.foot, t) <= height(e.height, s);
    if (!covered) (gap == 0 ? place.open_touch : place.open_gap) = true;
    const double more = CGAL::to_double(size(gap) - size(place.gap));
    if (std::fabs(more) < kSameSize && gap != place.gap) {
      place.ambiguous = true;
    } else if (more > 0) {
      place.ambiguous = false;
    }
    if (more > 0) place.gap = gap;
    if (!ours || !theirs) continue;
    const Vec3 n = e.normal[s == 0 ? 0 : 1], m = f.normal[t == 0 ? 0 : 1];
    if (n == Vec3{} || m == Vec3{}) continue;
    place.angles_deg.push_back(std::acos(std::clamp(dot(n, m), -1.0, 1.0)) * 57.29577951308232);
  }
  const double length = std::hypot(high.x - low.x, high.y - low.y);
  const Rational p = size(gaps[0]), q = size(gaps[1]);
  const bool crosses = gaps[0] * gaps[1] < 0;
  seam.length += length;
  seam.mean += length * CGAL::to_double((gaps[0] + gaps[1]) / 2);
  seam.mean_abs +=
      length * CGAL::to_double(crosses ? Rational((p * p + q * q) / (2 * (p + q))) : Rational((p + q) / 2));
  for (const auto* h : {&e.height, &f.height}) {
    for (const ExactHeight& one : *h) seam.size += std::fabs(one.low) + std::fabs(one.high) + one.drop;
  }
}

SlowSeam slow_seam(const Border& first, const Border& second) {
  SlowSeam seam;
  for (const BorderEdge& e : first.edges) {
    for (const BorderEdge& f : second.edges) meet(e, f, seam);
  }
  return seam;
}

/// Edges along a few lines that cross in lattice points: the first border's one way, the second's mostly the
/// other way, cut differently, with heights that are mostly the same. Either border may touch itself.
class BorderMaker {
 public:
  BorderMaker(Random& random, const test::Move& move) : random_(random), move_(move) {}

  std::pair<Border, Border> make() {
    static constexpr std::array<std::array<int, 4>, 7> kLines{
        {{0, 0, 1, 0}, {0, 0, 0, 1}, {0, 3, 2, 1}, {6, 0, -1, 1}, {0, 0, 1, 1}, {1, 7, 1, 0}, {7, 1, 0, 1}}};
    std::pair<Border, Border> out;
    for (const auto& line : kLines) {
      if (random_.below(3) == 0) continue;
      line_ = line;
      slope_ = static_cast<double>(random_.below(3)) - 1;
      for (double& z : ground_) z = static_cast<double>(random_.below(64)) / 8;
      plane_ = random_.below(2) == 0;
      add(out.first, false);
      add(out.second, random_.below(8) != 0);
    }
    for (Border* border : {&out.first, &out.second}) *border = test::moved(*border, move_);
    return out;
  }

 private:
  bool chance(std::uint64_t in) { return random_.below(in) == 0; }

  ExactHeight at(int k) {
    double z = plane_ ? 2 + slope_ * k : ground_[static_cast<std::size_t>(k)];
    switch (random_.below(12)) {
      case 0:
        z = std::nextafter(z, 100);
        break;
      case 1:
        z -= 0.001;
        break;
      case 2:
        z += random_.between(-3, 3);
        break;
      case 3:
        return {-2, 14, static_cast<std::uint32_t>(random_.below(32768)), 0};
      case 4:
        return {z - 4, z + 32763, 4, 0};  // the same height on a lattice
      case 5:
        return {z + 1, z + 1, 0, 1};
      default:
        break;
    }
    return {z, z, 0, 0};
  }

  void add(Border& border, bool backwards) {
    std::vector<int> stops;
    for (int k = 0; k <= 8; ++k) {
      if (!chance(3)) stops.push_back(k);
    }
    if (stops.size() < 2) return;
    std::vector<ExactHeight> heights;
    std::vector<Vec3> normals;
    static const std::vector<Vec3> kNormals{{0, 0, 1}, {0, 0.6, 0.8}, {1, 0, 0}, {0, 0, -1}, {}, {0, 0, 1}};
    const auto base = static_cast<std::uint32_t>(2 * border.edges.size());
    for (const int k : stops) {
      heights.push_back(at(k));
      normals.push_back(kNormals[random_.below(kNormals.size())]);
    }
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      if (chance(6)) continue;
      BorderEdge edge;
      edge.triangle = base + static_cast<std::uint32_t>(i);
      edge.has_skirt = chance(2);
      const double deep = static_cast<double>(random_.below(4));
      for (const std::size_t e : {std::size_t{0}, std::size_t{1}}) {
        const std::size_t at_stop = i + (backwards ? 1 - e : e);
        edge.plan[e] = {static_cast<double>(line_[0] + line_[2] * stops[at_stop]),
                        static_cast<double>(line_[1] + line_[3] * stops[at_stop])};
        edge.height[e] = chance(40) ? at(stops[at_stop]) : heights[at_stop];
        edge.foot[e] = edge.height[e];
        edge.foot[e].drop += deep;
        edge.normal[e] = normals[at_stop];
        edge.vertices[e] = base + static_cast<std::uint32_t>(at_stop);
      }
      border.edges.push_back(edge);
    }
  }

  Random& random_;
  test::Move move_;
  std::array<int, 4> line_{};
  double slope_ = 0;
  bool plane_ = false;
  std::array<double, 9> ground_{};
};

TEST(SeamsRoute, EveryFigureAgreesWithEveryPairOfEdges) {
  Random random(11, "borders");
  std::size_t seams = 0, junctions = 0, cracks = 0, tiny = 0, both = 0, normals = 0, covered = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    test::Move move;
    if (trial % 3 == 1) move.shift = {6378137.25, -3e6, 0};
    if (trial % 3 == 2) move.scale = 0x1p-12;
    const auto [first, second] = BorderMaker(random, move).make();
    const SlowSeam slow = slow_seam(first, second);
    const auto seam = compare_borders(first, second);
    ASSERT_EQ(seam.has_value(), slow.length > 0) << trial;
    if (!seam) continue;
    ++seams;
    const double bound = 0x1p-48 * slow.size;
    auto gap = seam->gaps.begin();
    std::size_t compared = 0;
    double angle = 0, largest = 0;
    for (const auto& [at, place] : slow.places) {
      const int sign = CGAL::sign(place.gap);
      const bool junction = place.ours != place.theirs;
      if (!place.angles_deg.empty()) {
        ++compared;
        angle = std::max(angle, *std::max_element(place.angles_deg.begin(), place.angles_deg.end()));
      }
      if (!junction && sign == 0) continue;
      ASSERT_NE(gap, seam->gaps.end()) << trial;
      EXPECT_EQ(gap->at.x, at.first);
      EXPECT_EQ(gap->at.y, at.second);
      EXPECT_EQ(gap->t_junction, junction) << trial;
      EXPECT_EQ(gap->of_first, junction && place.ours);
      EXPECT_EQ(gap->covered, sign == 0 ? !place.open_touch : !place.open_gap) << trial;
      if (!place.ambiguous) {
        EXPECT_EQ(gap->sign, sign) << trial;
        EXPECT_NEAR(gap->gap_m, CGAL::to_double(place.gap), bound);
      }
      EXPECT_EQ(gap->sign, gap->gap_m > 0 ? 1 : gap->gap_m < 0 ? -1 : 0);
      largest = std::max(largest, std::fabs(CGAL::to_double(place.gap)));
      junctions += junction;
      cracks += sign != 0;
      both += junction && sign != 0;
      tiny += sign != 0 && std::fabs(gap->gap_m) < bound;
      covered += gap->covered;
      ++gap;
    }
    EXPECT_EQ(gap, seam->gaps.end()) << trial;
    EXPECT_EQ(seam->normals, compared);
    EXPECT_NEAR(seam->normal_max_deg, angle, 1e-5) << "an arc cosine beside an arc tangent";
    normals += compared;
    EXPECT_NEAR(seam->length, slow.length, 0x1p-50 * slow.length);
    EXPECT_NEAR(seam->mean_gap_m * seam->length, slow.mean, bound * slow.length);
    EXPECT_NEAR(seam->mean_abs_gap_m * seam->length, slow.mean_abs, bound * slow.length);
    EXPECT_NEAR(std::fabs(seam->largest_gap_m), largest, bound);
  }
  // Everything was there to be judged.
  EXPECT_GT(seams, 5000u);
  EXPECT_GT(junctions, 20000u);
  EXPECT_GT(cracks, 10000u);
  EXPECT_GT(both, 5000u);
  EXPECT_GT(tiny, 500u);
  EXPECT_GT(normals, 5000u);
  EXPECT_GT(covered, 5000u);
}

// The two meshes put together, before check_conformity.

/// A fan from `apex` over a chain of posts that runs along x = 0: to the north if the apex lies in the west.
Mesh fan(Vec3 apex, std::vector<Post> posts) {
  if (apex.x > 0) std::reverse(posts.begin(), posts.end());
  Mesh mesh;
  mesh.positions.push_back(apex);
  for (std::uint32_t k = 0; k < posts.size(); ++k) {
    mesh.positions.push_back(posts[k].at);
    if (k > 0) mesh.triangles.push_back({0, k, k + 1});
  }
  return mesh;
}

Mesh together(Mesh a, const Mesh& b) {
  const auto base = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (auto t : b.triangles) {
    for (std::uint32_t& v : t) v += base;
    a.triangles.push_back(t);
  }
  return a;
}

TEST(SeamsRoute, ConformityFindsTheSameOnBothMeshesTogether) {
  Random random(12, "fans");
  std::size_t junctions = 0, cracks = 0, clean = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::array<std::vector<Post>, 2> posts;
    const bool same_stops = random.below(3) == 0;
    for (std::size_t side = 0; side < 2; ++side) {
      for (int y = 0; y <= 8; ++y) {
        const bool stop = y == 0 || y == 8 || (same_stops ? y % 2 == 0 : random.below(2) == 0);
        double z = 3 + 0.25 * y * (8 - y) * (same_stops ? 1 : 0);
        const auto odd = random.below(6);
        if (odd == 0 && trial % 4 != 0) z = std::nextafter(z, 0);
        if (odd == 1 && trial % 4 != 0) z += random.between(-1, 1);
        if (stop) posts[side].push_back({{0, static_cast<double>(y), z}});
      }
    }
    const Mesh west = fan({-3, 4, 0}, posts[0]), east = fan({3, 4, 0}, posts[1]);
    const auto border = [](const Mesh& mesh) { return border_of(mesh, take_walls_off(mesh), {}); };
    const Seam seam = seam_of(border(west), border(east));
    const ConformityReport report = check_conformity_without_outline(together(west, east));
    // A place of two equal edges is one gap in the seam; in O1 each of the edges is one crack.
    std::set<std::pair<double, double>> t_places, crack_places;
    for (const Finding& finding : report.findings) {
      ASSERT_TRUE(finding.code == FindingCode::crack || finding.code == FindingCode::t_junction);
      if (finding.kind == "t_vertex") t_places.insert({finding.at.x, finding.at.y});
    }
    EXPECT_EQ(report.counts.t_junction, seam.t_junctions) << trial;
    std::size_t of_junctions = 0, gaps = 0;
    for (const SeamGap& gap : seam.gaps) {
      EXPECT_EQ(gap.t_junction, t_places.contains({gap.at.x, gap.at.y}));
      of_junctions += gap.t_junction && gap.sign != 0;
      gaps += gap.sign != 0;
    }
    const auto t_cracks = std::count_if(report.findings.begin(), report.findings.end(), [](const Finding& f) {
      return f.code == FindingCode::crack && f.kind == "t_vertex";
    });
    EXPECT_EQ(static_cast<std::size_t>(t_cracks), of_junctions) << trial;
    EXPECT_EQ(report.counts.crack > 0, gaps > 0) << trial;
    EXPECT_EQ(seam.watertight(), report.clean());
    EXPECT_NEAR(report.largest_gap_m, std::fabs(seam.largest_gap_m), 1e-13);
    junctions += seam.t_junctions;
    cracks += seam.cracks;
    clean += seam.watertight();
  }
  EXPECT_GT(junctions, 5000u);
  EXPECT_GT(cracks, 3000u);
  EXPECT_GT(clean, 100u);
}

}  // namespace
}  // namespace plumbline::oracle
