// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Laws of M2, a TIN under edge collapse in rings (METHODS M2). Each recomputes from positions and options
// what the method keeps.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "algorithms/ring_tin/ring_tin.h"
#include "properties/laws/trial.h"
#include "scenarios/error.h"

namespace plumbline::properties {
namespace {

using ring_tin::CollapseMap;
using ring_tin::RingTin;

bool is_ring_tin(const MethodChoice& choice) { return choice.method->id == "ring_tin"; }

const RingTin& as_ring_tin(const LodMethod& method) {
  const auto* tin = dynamic_cast<const RingTin*>(&method);
  if (tin == nullptr) throw InputError("the method collapses no edges; the laws of M2 speak of ring_tin");
  return *tin;
}

/// Options as given, or the description's.
OptionValue option(const LawInput& input, const std::string& name) {
  if (const auto given = input.options.find(name); given != input.options.end()) return given->second;
  for (const OptionDescription& known : find_method("ring_tin").method->options) {
    if (known.name == name) return known.default_value;
  }
  throw InputError(fmt::format("ring_tin has no option {}", name));
}

std::vector<double> numbers(const LawInput& input, const std::string& name) {
  std::istringstream words(std::get<std::string>(option(input, name)));
  std::vector<double> out;
  for (double number = 0; words >> number;) out.push_back(number);
  return out;
}

/// What a vertex may deviate where it stands, metres: Δh_i = δ_i·τ·d_i/f (equation 1 turned round).
class Tolerance {
 public:
  Tolerance(const LawInput& input, const Camera& camera)
      : eye_(camera.position), half_m_(numbers(input, "rings_m")), delta_px_(numbers(input, "delta_px")) {
    const double focal_px = std::get<double>(option(input, "focal_px"));
    per_metre_ = input.threshold_px / (focal_px > 0 ? focal_px : camera.kappa_px);
    mean_ = std::get<bool>(option(input, "mean_distance"));
  }
  [[nodiscard]] std::size_t ring(Vec3 p) const {
    const double away = std::max(std::fabs(p.x - eye_.x), std::fabs(p.y - eye_.y));
    std::size_t ring = 0;
    while (ring + 1 < half_m_.size() && away > half_m_[ring]) ++ring;
    return ring;
  }
  [[nodiscard]] double at(Vec3 p) const {
    const std::size_t ring = this->ring(p);
    const double inner = ring == 0 ? 0 : half_m_[ring - 1];
    return delta_px_[ring] * per_metre_ * (mean_ ? (inner + half_m_[ring]) / 2 : half_m_[ring]);
  }

 private:
  Vec3 eye_;
  std::vector<double> half_m_, delta_px_;
  double per_metre_ = 0;
  bool mean_ = false;
};

/// A triangle at a vertex: its other corners, counter-clockwise, and its number.
using Corner = CollapseMap::Corner;

/// How far `from` stands off the mesh once it has collapsed to `to`, metres; +∞: it does not lie in the new
/// triangles.
double collapse_error_m(const std::vector<Vec3>& at, const std::vector<Corner>& star, std::uint32_t from,
                        std::uint32_t to) {
  const Vec3 p = at[from], a = at[to];
  std::optional<std::uint32_t> chosen;
  double error = std::numeric_limits<double>::infinity();
  for (const Corner& corner : star) {
    if (corner.next == to || corner.after == to || (chosen && *chosen < corner.triangle)) continue;
    const Vec3 b = at[corner.next], c = at[corner.after];
    const int whole = tin::plan_orientation(a, b, c);
    if (whole == 0 || tin::plan_orientation(p, b, c) == -whole || tin::plan_orientation(a, p, c) == -whole ||
        tin::plan_orientation(a, b, p) == -whole) {
      continue;
    }
    // Barycentric coordinates from areas.
    const auto area = [](Vec3 u, Vec3 v, Vec3 w) {
      return (v.x - u.x) * (w.y - u.y) - (v.y - u.y) * (w.x - u.x);
    };
    const double z = (area(p, b, c) * a.z + area(a, p, c) * b.z + area(a, b, p) * c.z) / area(a, b, c);
    chosen = corner.triangle;
    error = std::fabs(z - p.z);
  }
  return error;
}

/// Errors are rounded otherwise here; relative to the largest height.
constexpr double kRounding = 0x1p-36;
double doubt_m(const Terrain& terrain) {
  return std::max(std::fabs(terrain.lowest_m()), std::fabs(terrain.highest_m())) * kRounding;
}

LawOutcome check_prices(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const RingTin& m2 = as_ring_tin(*method);
  const ring_tin::PreparedTin& prepared = m2.prepared();
  const std::vector<Vec3>& at = prepared.tin.mesh.positions;
  std::vector<std::vector<Corner>> stars(at.size());
  for (std::uint32_t t = 0; t < prepared.tin.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = prepared.tin.mesh.triangles[t];
    stars[a].push_back({b, c, t});
    stars[b].push_back({c, a, t});
    stars[c].push_back({a, b, t});
  }
  const double doubt = doubt_m(input.terrain);
  bool some = false;
  const auto& edges = prepared.adjacency.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::uint8_t start = prepared.prices.start[e];
    const std::uint32_t from = edges[e][start], to = edges[e][1u - start];
    const double own = collapse_error_m(at, stars[from], from, to);
    const double other = collapse_error_m(at, stars[to], to, from);
    const double kept = prepared.prices.error_m[e];
    some = some || (kept > doubt && std::isfinite(kept));
    const bool as_own = own == kept || std::fabs(own - kept) <= doubt;
    if (as_own && own <= other + doubt) continue;
    oracle::Finding finding = law_finding("edge_error", at[from]);
    finding.gap_m = std::isfinite(own) ? own - kept : 0;
    return violated(
        fmt::format("edge ({}, {}) to ({}, {}) has error {} m; its collapse moves the surface by {} m, the "
                    "opposite one by {} m",
                    at[from].x, at[from].y, at[to].x, at[to].y, kept, own, other),
        std::move(finding));
  }
  return some ? held() : vacuous("no edge has an error");
}

LawOutcome check_collapses(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const RingTin& m2 = as_ring_tin(*method);
  const std::vector<Vec3>& at = m2.full_tin().mesh.positions;
  const tin::Adjacency& adjacency = m2.prepared().adjacency;
  const int cap = static_cast<int>(std::get<double>(option(input, "depth_cap")));
  const bool whole_trees = std::get<bool>(option(input, "leave_whole_trees"));
  const bool fixpoint = input.method.ends_with(":fixpoint");
  const bool guarded = input.method.ends_with(":guarded");
  const double doubt = doubt_m(input.terrain);
  std::vector<std::uint8_t> gone(at.size(), 0);
  std::vector<Corner> from_star, to_star;
  std::vector<std::uint32_t> members;
  LodFrame frame;
  std::size_t removed = 0;
  for (const Camera& camera : cameras(input)) {
    method->update(camera, frame);
    const CollapseMap& map = m2.collapses();
    const Tolerance tolerance(input, camera);
    for (std::uint32_t v = 0; v < at.size(); ++v) {
      if (m2.level(v) != static_cast<int>(tolerance.ring(at[v]))) {
        return violated(fmt::format("vertex ({}, {}) is at level {}, but in ring {}", at[v].x, at[v].y,
                                    m2.level(v), tolerance.ring(at[v])),
                        law_finding("level", at[v]));
      }
      if (map.is_live(v)) {
        members.clear();
        map.members(v, members);
        const int depth = map.depth(v);
        if (depth <= cap && (depth == 1) == (members.size() == 1) &&
            members.size() <= std::size_t{1} << static_cast<unsigned>(depth - 1)) {
          continue;
        }
        return violated(fmt::format("vertex ({}, {}) stands for {} vertices at depth {}, with a cap of {}",
                                    at[v].x, at[v].y, members.size(), depth, cap),
                        law_finding("depth", at[v]));
      }
      ++removed;
      if (adjacency.is_border_vertex(v)) {
        return violated(fmt::format("vertex ({}, {}) on the border has collapsed", at[v].x, at[v].y),
                        law_finding("border_collapsed", at[v]));
      }
      const double error = map.error_m(map.removed_by(v)), allowed = tolerance.at(at[v]);
      if (error <= allowed + doubt || whole_trees) continue;
      oracle::Finding finding = law_finding("collapse_over_tolerance", at[v]);
      finding.gap_m = error;
      return violated(
          fmt::format("vertex ({}, {}) collapsed with an error of {} m, where its ring allows {} m", at[v].x,
                      at[v].y, error, allowed),
          std::move(finding));
    }
    // What must have been tried: in `fixpoint` every edge. In the others one scan need not be enough: only
    // edges at vertices that this update returned to zero, around which nothing of higher index, and so
    // later, collapsed.
    const auto as_scanned = [&](std::uint32_t e, std::uint32_t live) {
      const auto earlier = [&](std::uint32_t v) {
        members.clear();
        map.members(v, members);
        return std::all_of(members.begin(), members.end(),
                           [&](std::uint32_t m) { return map.is_live(m) || map.removed_by(m) < e; });
      };
      std::vector<std::uint32_t> tree;
      map.members(live, tree);
      return std::all_of(tree.begin(), tree.end(), [&](std::uint32_t m) {
        const auto triangles = adjacency.triangles_at(m);
        return std::all_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
          const auto& corners = m2.full_tin().mesh.triangles[t];
          return std::all_of(corners.begin(), corners.end(), earlier);
        });
      });
    };
    const auto& edges = adjacency.edges();
    for (std::uint32_t e = 0; e < edges.size() && m2.full_tin().roads.empty(); ++e) {
      if (!map.is_active(e)) continue;
      const std::uint32_t u = map.rep(edges[e][0]), w = map.rep(edges[e][1]);
      if (!fixpoint && (gone[u] + gone[w] == 0 || !as_scanned(e, u) || !as_scanned(e, w))) continue;
      map.star(u, from_star);
      map.star(w, to_star);
      const double forth = collapse_error_m(at, from_star, u, w), back = collapse_error_m(at, to_star, w, u);
      if (std::isfinite(forth) && std::fabs(forth - back) <= doubt) continue;  // rounding chooses the end
      const std::uint32_t from = back < forth ? w : u;
      const std::uint32_t to = back < forth ? u : w;
      const std::vector<Corner>& star = back < forth ? to_star : from_star;
      if (!fixpoint && gone[from] == 0) continue;
      if (tolerance.ring(at[from]) == 0) continue;  // level 0 is never simplified (METHODS M2, rings)
      const double error = std::min(forth, back), allowed = tolerance.at(at[from]);
      const bool at_border = adjacency.is_border_vertex(from) ||
                             std::any_of(star.begin(), star.end(), [&](const Corner& corner) {
                               return adjacency.joined_on_border(corner.next, corner.after);
                             });
      const bool folds = std::any_of(star.begin(), star.end(), [&](const Corner& corner) {
        return corner.next != to && corner.after != to &&
               tin::plan_orientation(at[to], at[corner.next], at[corner.after]) <= 0;
      });
      if (!(error < allowed - doubt) || at_border || std::max(map.depth(u), map.depth(w)) + 1 > cap ||
          (guarded && folds)) {
        continue;
      }
      oracle::Finding finding = law_finding("collapse_left_out", at[from]);
      finding.gap_m = error;
      return violated(
          fmt::format("edge ({}, {}) to ({}, {}) is left, though its collapse moves the surface by {} m, and "
                      "{} m are allowed",
                      at[from].x, at[from].y, at[to].x, at[to].y, error, allowed),
          std::move(finding));
    }
    for (std::uint32_t v = 0; v < at.size(); ++v) gone[v] = map.is_live(v) ? 0 : 1;
  }
  return removed > 0 ? held() : vacuous("nothing collapsed");
}

}  // namespace

Law law_ring_prices_are_distances() {
  return {.id = "M2_prices_are_distances",
          .statement =
              "for every terrain, an edge's error at full resolution is how far its cheaper collapse moves "
              "the surface "
              "at the vertex that goes",
          .source = "METHODS M2 (error of an edge, 2.1)",
          .applies = is_ring_tin,
          .promised = is_ring_tin,
          .check = check_prices};
}

Law law_ring_collapses_within_tolerance() {
  return {.id = "M2_C3_collapses_within_tolerance",
          .statement =
              "for every terrain, flight and threshold, each removed vertex was worth less than its ring's "
              "tolerance, no "
              "tree is deeper than the cap, and no edge that was to be tried is left though it qualifies",
          .source = "METHODS M2 (2.2, 3.1, 3.2), M2.C3, M2.C5",
          .applies = is_ring_tin,
          .promised = is_ring_tin,
          .check = check_collapses};
}

}  // namespace plumbline::properties
