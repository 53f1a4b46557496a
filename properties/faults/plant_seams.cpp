// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/predicates.h"
#include "properties/faults/planting.h"
#include "properties/faults/seam_faults.h"

namespace plumbline::faults {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec2 plan(const Vec3& p) { return {p.x, p.y}; }

const SeamEdge& any_edge(const Halves& halves, Random& random) {
  return halves.seam[random.below(halves.seam.size())];
}

/// A step up or down, never none.
double moved(double z, Step step, Random& random) {
  const double way = random.below(2) == 0 ? 1 : -1;
  if (step == Step::ulp) return std::nextafter(z, way * kInfinity);
  return z + way * (step == Step::millimetre ? 0.001 : 1);
}

/// Moves all vertices at a place.
void move_to(Mesh& mesh, const Vec3& from, const Vec3& to) {
  for (Vec3& p : mesh.positions) {
    if (p == from) p = to;
  }
}

/// The mean of a gap of the least numbers there are (an ulp at height 0) may round to none.
constexpr double kVanishing = 0x1p-1000;

/// What one gap must be.
struct Wanted {
  Vec2 at;
  double gap_m = 0;     ///< first less second
  double within_m = 0;  ///< what its figure may be rounded by
  bool t_junction = false;
  bool covered = false;
};

std::optional<Tally> judge(const Wanted& wanted, const std::optional<oracle::Seam>& seam) {
  if (!seam) return tally(false, false, false, false, false);
  const int sign = wanted.gap_m > 0 ? 1 : wanted.gap_m < 0 ? -1 : 0;
  bool size = false, place = false;
  for (const oracle::SeamGap& gap : seam->gaps) {
    const bool same = gap.sign == sign && std::fabs(gap.gap_m - wanted.gap_m) <= wanted.within_m &&
                      gap.t_junction == wanted.t_junction && gap.covered == wanted.covered;
    size |= same;
    place |= same && plan(gap.at) == wanted.at;
  }
  const std::size_t uncovered = wanted.covered ? 0 : 1;
  const bool counts = seam->uncovered == uncovered && seam->t_junctions == (wanted.t_junction ? 1u : 0u) &&
                      (std::fabs(wanted.gap_m) <= kVanishing || seam->mean_abs_gap_m > 0);
  return tally(false, !seam->gaps.empty(), size && counts, place, seam->gaps.size() > 1);
}

/// A vertex of the second half, moved up or down.
std::optional<Tally> lift(const Judges& judges, const Halves& halves, Random& random, Step step) {
  const Vec3 p = any_edge(halves, random).at[random.below(2)];
  Vec3 q = p;
  q.z = moved(p.z, step, random);
  Mesh second = halves.second;
  move_to(second, p, q);
  return judge({plan(p), p.z - q.z}, judges.seam(judges.border(halves.first), judges.border(second)));
}

/// An edge of the seam split in the first half only.
std::optional<Tally> split(const Judges& judges, const Halves& halves, Random& random, SplitHeight height) {
  const SeamEdge& edge = any_edge(halves, random);
  const auto& [a, b] = edge.at;
  Vec3 middle = a + (b - a) * 0.5;
  if (!oracle::inside_segment(plan(a), plan(b), plan(middle))) return std::nullopt;
  if (height == SplitHeight::ulp) middle.z = std::nextafter(middle.z, kInfinity);
  if (height == SplitHeight::metre) middle.z += random.below(2) == 0 ? 1 : -1;
  const oracle::HeightGap gap = oracle::height_gap(a, b, middle);
  if ((gap.sign == 0) != (height == SplitHeight::flat)) return std::nullopt;
  Mesh first = halves.first;
  auto& corners = first.triangles[edge.first];
  while (!(first.positions[corners[0]] == a && first.positions[corners[1]] == b))
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  const auto v = static_cast<std::uint32_t>(first.positions.size());
  first.positions.push_back(middle);
  const std::uint32_t to = corners[1], apex = corners[2];
  corners[1] = v;
  first.triangles.push_back({v, to, apex});
  Wanted wanted{plan(middle), gap.metres};
  wanted.t_junction = true;
  wanted.within_m = height == SplitHeight::metre ? 0x1p-50 * (std::fabs(a.z) + std::fabs(b.z) + 1) : 0;
  return judge(wanted, judges.seam(judges.border(first), judges.border(halves.second)));
}

/// A vertex of the second half drawn back from the seam: a slit as wide as that, or less in a corner.
std::optional<Tally> draw_back(const Judges& judges, const Halves& halves, Random& random) {
  const SeamEdge& edge = any_edge(halves, random);
  const Vec3 p = edge.at[0];
  double shortest = kInfinity;
  for (const SeamEdge& other : halves.seam) {
    if (other.at[0] != p && other.at[1] != p) continue;
    const Vec2 d = plan(other.at[1]) - plan(other.at[0]);
    shortest = std::min(shortest, std::sqrt(d.x * d.x + d.y * d.y));
  }
  const Vec2 d = plan(edge.at[1]) - plan(p);
  const double length = std::sqrt(d.x * d.x + d.y * d.y), width = shortest / 16;
  Vec3 q = p;  // to the right, which is the second's side
  q.x += d.y / length * width;
  q.y -= d.x / length * width;
  // Where the seam turns, that may lead along the seam: a T-junction, and no slit.
  for (const SeamEdge& other : halves.seam) {
    if (oracle::inside_segment(plan(other.at[0]), plan(other.at[1]), plan(q))) return std::nullopt;
  }
  Mesh second = halves.second;
  move_to(second, p, q);
  const auto slit = judges.slit(judges.border(second), judges.border(halves.first), 2 * width);
  if (!slit) return tally(false, false, false, false, false);
  return tally(false, true, slit->width > 0 && slit->width <= width * (1 + 0x1p-20),
               plan(slit->at) == plan(q), slit->vertices > 1);
}

/// The second half a metre too high at one vertex, with walls down from all of the seam: there exactly to the
/// first half, or an ulp less.
std::optional<Tally> hang_skirt(const Judges& judges, const Halves& halves, Random& random, bool reaches) {
  const Vec3 p = any_edge(halves, random).at[random.below(2)];
  const Vec3 top = p + Vec3{0, 0, 1};
  Mesh second = halves.second;
  for (const SeamEdge& edge : halves.seam) {
    std::array<std::uint32_t, 2> ends{}, feet{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3& end = edge.at[1 - k];  // as the second's triangle runs
      for (const std::uint32_t v : second.triangles[edge.second]) {
        if (second.positions[v] == end) ends[k] = v;
      }
      Vec3 foot = end;
      foot.z = end != p ? end.z - 1 : reaches ? end.z : std::nextafter(end.z, kInfinity);
      feet[k] = static_cast<std::uint32_t>(second.positions.size());
      second.positions.push_back(foot);
    }
    second.triangles.push_back({ends[1], ends[0], feet[0]});
    second.triangles.push_back({ends[1], feet[0], feet[1]});
  }
  // The corners, not the foot that stands at the same place.
  for (std::size_t v = 0; v < halves.second.positions.size(); ++v) {
    if (second.positions[v] == p) second.positions[v] = top;
  }
  Wanted wanted{plan(p), p.z - top.z};
  wanted.covered = reaches;
  return judge(wanted, judges.seam(judges.border(halves.first), judges.border(second)));
}

/// Heights as steps of a tile's range, the second half's counted from the top: the same rationals.
std::optional<Tally> quantize(const Judges& judges, const Halves& halves, Random& random, bool fault) {
  oracle::Border first = judges.border(halves.first), second = judges.border(halves.second);
  double low = kInfinity, high = -kInfinity;
  for (const auto* border : {&first, &second}) {
    for (const oracle::BorderEdge& edge : border->edges) {
      for (const oracle::ExactHeight& h : edge.height) {
        low = std::min(low, h.low);
        high = std::max(high, h.low);
      }
    }
  }
  if (!(low < high)) return std::nullopt;
  constexpr double kSteps = oracle::ExactHeight::kSteps;
  const auto step_of = [&](double z) {
    return static_cast<std::uint32_t>(std::floor((z - low) / (high - low) * kSteps + 0.5));
  };
  const Vec3 p = any_edge(halves, random).at[random.below(2)];
  const bool upwards = step_of(p.z) == 0 || (step_of(p.z) < kTileSteps && random.below(2) == 0);
  for (oracle::BorderEdge& edge : first.edges) {
    for (oracle::ExactHeight& h : edge.height) h = {low, high, step_of(h.low), 0};
  }
  for (oracle::BorderEdge& edge : second.edges) {
    for (std::size_t k = 0; k < 2; ++k) {
      std::uint32_t step = step_of(edge.height[k].low);
      if (fault && edge.plan[k] == plan(p)) step += upwards ? 1u : -1u;
      edge.height[k] = {high, low, static_cast<std::uint32_t>(kTileSteps) - step, 0};
    }
  }
  const auto seam = judges.seam(first, second);
  if (!fault) return tally(true, !seam || !seam->watertight(), false, false, false);
  const double step_m = (high - low) / kSteps;
  // Figures far above the rounding of the heights that they are made of are taken in double
  // (oracle/seams.cpp).
  const double within_m = 0x1p-46 * (std::fabs(low) + std::fabs(high));
  return judge({plan(p), upwards ? -step_m : step_m, within_m}, seam);
}

/// Nothing but the cut.
std::optional<Tally> cut(const Judges& judges, const Halves& halves, Random& /*random*/) {
  const oracle::Border first = judges.border(halves.first), second = judges.border(halves.second);
  const auto seam = judges.seam(first, second);
  double shortest = kInfinity;
  for (const SeamEdge& edge : halves.seam) {
    const Vec2 d = plan(edge.at[1]) - plan(edge.at[0]);
    shortest = std::min(shortest, std::sqrt(d.x * d.x + d.y * d.y));
  }
  const bool slit = judges.slit(first, second, shortest / 4) || judges.slit(second, first, shortest / 4);
  return tally(true, !seam || !seam->watertight() || seam->mean_abs_gap_m != 0, false, false, slit);
}

}  // namespace

const std::vector<SeamFault>& seam_faults() {
  static const std::vector<SeamFault> list = [] {
    const auto lifted = [](std::string_view name, std::string_view what, Step step) {
      return SeamFault{name, what, false, [step](const Judges& judges, const Halves& halves, Random& random) {
                         return lift(judges, halves, random, step);
                       }};
    };
    const auto junction = [](std::string_view name, std::string_view what, SplitHeight height) {
      return SeamFault{name, what, false,
                       [height](const Judges& judges, const Halves& halves, Random& random) {
                         return split(judges, halves, random, height);
                       }};
    };
    const auto skirt = [](std::string_view name, std::string_view what, bool reaches) {
      return SeamFault{name, what, false,
                       [reaches](const Judges& judges, const Halves& halves, Random& random) {
                         return hang_skirt(judges, halves, random, reaches);
                       }};
    };
    const auto lattice = [](std::string_view name, std::string_view what, bool fault) {
      return SeamFault{name, what, !fault,
                       [fault](const Judges& judges, const Halves& halves, Random& random) {
                         return quantize(judges, halves, random, fault);
                       }};
    };
    return std::vector<SeamFault>{
        lifted("seam_vertex_moved_ulp", "a border vertex of one mesh an ulp up or down: one gap, to the bit",
               Step::ulp),
        lifted("seam_vertex_moved_1mm", "the same, by a millimetre", Step::millimetre),
        lifted("seam_vertex_moved_1m", "the same, by a metre", Step::metre),
        junction("seam_t_vertex_flat", "a border edge split in one mesh only, at the exact midpoint",
                 SplitHeight::flat),
        junction("seam_t_vertex_ulp", "the same, one ulp off the edge", SplitHeight::ulp),
        junction("seam_t_vertex_1m", "the same, a metre off the edge", SplitHeight::metre),
        {"seam_vertex_drawn_back", "a border vertex moved away from the other mesh: a slit of that width",
         false, draw_back},
        skirt("seam_skirt_just_deep_enough",
              "a gap of a metre, and a skirt that ends on the lower mesh: covered", true),
        skirt("seam_skirt_short_ulp", "the same, the skirt one ulp shorter: open", false),
        lattice("seam_step_off_by_one", "heights on an integer lattice, one of them a step off", true),
        lattice("seam_lattices_agree", "the same heights on two different lattices: sound", false),
        {"seam_sound", "a mesh cut in two: watertight, and no slit", true, cut},
    };
  }();
  return list;
}

}  // namespace plumbline::faults
