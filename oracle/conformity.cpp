// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// O1. Decided exactly, in the doubles as given: every finding, its sort, its place and its witnesses (plain
// double where its sign is certain, CGAL's exact predicates and arrangement elsewhere). Only measured: gaps,
// areas and distances, which are rounded. Not verified here: heights against a terrain (O2), anything about a
// picture (O3).
#include "oracle/conformity.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "oracle/conformity_parts.h"
#include "oracle/predicates.h"

namespace plumbline::oracle {
namespace {

using namespace detail;

class Check {
 public:
  Check(const Mesh& mesh, const PlanDomain& domain, bool outline_is_free = false)
      : mesh_(mesh), domain_(domain), outline_is_free_(outline_is_free) {}

  ConformityReport run() {
    survey_ = survey(mesh_);
    report_.exact_orientations = survey_.exact_orientations;
    if (!survey_.plain()) mark_survey();
    IndexMatch match = match_by_index(mesh_, treatment_);
    bool settled = false;
    if (!match.crowded.empty() || !survey_.negative.empty()) {
      set_aside();
      settled = true;
      match = match_by_index(mesh_, treatment_);
    }
    Seams seams = close_seams(mesh_, domain_, match.left_over, excused_edges_, excused_vertices_, settled,
                              report_.findings);
    if (seams.suspects_duplicates) {
      set_aside();
      match = match_by_index(mesh_, treatment_);
      seams = close_seams(mesh_, domain_, match.left_over, excused_edges_, excused_vertices_, true,
                          report_.findings);
    }
    report_.left_over_edges = match.left_over.size();
    if (treatment_.empty()) {
      std::vector<LooseEdge>& loose = report_.loose_edges.emplace();
      loose.reserve(match.left_over.size());
      for (const EdgeUse& use : match.left_over) loose.push_back({use.from, use.to, use.triangle});
    }
    report_.counts.t_junction = seams.t_junctions;
    report_.counts.crack = seams.cracks;
    if (seams.residual.needs_regions) find_regions(mesh_, seams.residual, outline_is_free_, report_.findings);
    report_input();
    report_triangles();
    report_crowded(match.crowded);
    finish();
    return std::move(report_);
  }

 private:
  bool known(std::uint32_t v) const {
    return v < mesh_.positions.size() &&
           !std::binary_search(survey_.non_finite.begin(), survey_.non_finite.end(), v);
  }

  /// Leaves broken triangles out, and remembers what borders them: their absence is not another finding.
  void mark_survey() {
    treatment_.assign(mesh_.triangles.size(), kNormal);
    for (const auto* broken : {&survey_.bad_index, &survey_.touching_non_finite}) {
      for (const std::uint32_t t : *broken) {
        treatment_[t] = kLeftOut;
        const auto& c = mesh_.triangles[t];
        std::vector<std::uint32_t> sound;
        std::copy_if(c.begin(), c.end(), std::back_inserter(sound), [this](auto v) { return known(v); });
        if (sound.size() == 1) excused_vertices_.push_back(sound[0]);
        for (std::size_t i = 0; i + 1 < sound.size(); ++i) {
          for (std::size_t j = i + 1; j < sound.size(); ++j) {
            excused_edges_.push_back({std::min(sound[i], sound[j]), std::max(sound[i], sound[j])});
          }
        }
      }
    }
    for (const std::uint32_t t : survey_.repeated) treatment_[t] = kLeftOut;
    for (const std::uint32_t t : survey_.collinear) treatment_[t] = kSilent;
    std::sort(excused_edges_.begin(), excused_edges_.end());
    excused_edges_.erase(std::unique(excused_edges_.begin(), excused_edges_.end()), excused_edges_.end());
  }

  void set_aside() {
    treatment_.resize(mesh_.triangles.size(), kNormal);
    duplicates_ = find_duplicates(mesh_, treatment_, survey_.negative);
    for (const Duplicate& d : duplicates_) treatment_[d.extra] = kLeftOut;
    const auto is_extra = [this](std::uint32_t t) {
      return std::binary_search(duplicates_.begin(), duplicates_.end(), Duplicate{t, 0},
                                [](const Duplicate& a, const Duplicate& b) { return a.extra < b.extra; });
    };
    std::erase_if(survey_.negative, is_extra);
    std::erase_if(survey_.collinear, is_extra);
    if (survey_.negative.empty()) return;
    turned_ = find_turned(mesh_, treatment_, survey_.negative);
    for (std::size_t i = 0; i < turned_.size(); ++i) {
      if (turned_[i]) treatment_[survey_.negative[i]] |= kTurned;
    }
  }

  Finding about_triangle(FindingCode code, std::uint32_t t) const {
    Finding finding;
    finding.code = code;
    const auto& c = mesh_.triangles[t];
    finding.triangles = {t};
    finding.vertices.assign(c.begin(), c.end());
    // The place is the first of its sound corners along x, then y, then z.
    bool placed = false;
    for (const std::uint32_t v : c) {
      if (!known(v)) continue;
      const Vec3& p = mesh_.positions[v];
      const Vec3& q = finding.at;
      if (!placed || std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z}) finding.at = p;
      placed = true;
    }
    return finding;
  }

  void add(Finding finding) { report_.findings.push_back(std::move(finding)); }

  void report_input() {
    for (const std::uint32_t t : survey_.bad_index) add(about_triangle(FindingCode::bad_index, t));
    report_non_finite();
    for (const std::uint32_t v : survey_.unused) {
      Finding finding;
      finding.code = FindingCode::unused_vertex;
      finding.severity = Severity::hazard;
      finding.at = mesh_.positions[v];
      finding.vertices = {v};
      add(std::move(finding));
    }
  }

  /// One finding for each vertex, with the triangles that it takes with it.
  void report_non_finite() {
    if (survey_.non_finite.empty()) return;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> uses;
    for (const std::uint32_t t : survey_.touching_non_finite) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        if (!known(v)) uses.emplace_back(v, t);
      }
    }
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    auto it = uses.begin();
    for (const std::uint32_t v : survey_.non_finite) {
      Finding finding;
      finding.code = FindingCode::non_finite;
      finding.vertices = {v};
      while (it != uses.end() && it->first < v) ++it;
      for (; it != uses.end() && it->first == v; ++it) finding.triangles.push_back(it->second);
      const Vec3& p = mesh_.positions[v];
      if (std::isfinite(p.x) && std::isfinite(p.y)) {
        finding.at = {p.x, p.y, std::isfinite(p.z) ? p.z : 0};
      } else if (!finding.triangles.empty()) {
        finding.at = about_triangle(FindingCode::non_finite, finding.triangles.front()).at;
      }
      add(std::move(finding));
    }
  }

  void report_triangles() {
    for (const std::uint32_t t : survey_.repeated) {
      Finding finding = about_triangle(FindingCode::degenerate, t);
      finding.kind = "repeated_index";
      add(std::move(finding));
    }
    for (const std::uint32_t t : survey_.collinear) {
      Finding finding = about_triangle(FindingCode::degenerate, t);
      finding.kind = "collinear";
      add(std::move(finding));
    }
    for (const Duplicate& d : duplicates_) {
      Finding finding = about_triangle(FindingCode::duplicate, d.extra);
      finding.triangles.push_back(d.kept);
      add(std::move(finding));
    }
    for (std::size_t i = 0; i < survey_.negative.size(); ++i) {
      Finding finding = about_triangle(FindingCode::fold_over, survey_.negative[i]);
      finding.kind = turned_[i] ? "reversed" : "folded";
      const auto& c = mesh_.triangles[survey_.negative[i]];
      const auto plan = [&](std::uint32_t v) { return Vec2{mesh_.positions[v].x, mesh_.positions[v].y}; };
      finding.area_m2 = std::fabs(plan_area_m2(std::array{plan(c[0]), plan(c[1]), plan(c[2])}));
      add(std::move(finding));
    }
  }

  /// Edges with a third triangle, or two on one side, after the triangles with findings of their own were set
  /// aside.
  void report_crowded(const std::vector<VertexPair>& crowded) {
    if (crowded.empty()) return;
    std::vector<EdgeUse> uses = uses_of(mesh_, treatment_, crowded);
    std::erase_if(uses, [](const EdgeUse& use) { return use.silent; });
    const auto edge = [](const EdgeUse& use) {
      return VertexPair{std::min(use.from, use.to), std::max(use.from, use.to)};
    };
    std::stable_sort(uses.begin(), uses.end(),
                     [&edge](const EdgeUse& a, const EdgeUse& b) { return edge(a) < edge(b); });
    for (std::size_t i = 0; i < uses.size();) {
      Finding finding;
      finding.code = FindingCode::non_manifold;
      const VertexPair pair = edge(uses[i]);
      std::size_t upwards = 0, end = i;
      for (; end < uses.size() && edge(uses[end]) == pair; ++end) {
        upwards += uses[end].from == pair.from;
        finding.triangles.push_back(uses[end].triangle);
      }
      const std::size_t downwards = end - i - upwards;
      i = end;
      if (upwards < 2 && downwards < 2) continue;
      finding.vertices = {pair.from, pair.to};
      const Vec3& p = mesh_.positions[pair.from];
      const Vec3& q = mesh_.positions[pair.to];
      finding.at = std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z} ? p : q;
      add(std::move(finding));
    }
  }

  void finish() {
    ConformityCounts& counts = report_.counts;
    for (Finding& finding : report_.findings) {
      finding.at = finding.at + Vec3{};  // -0 becomes 0
      switch (finding.code) {
        case FindingCode::fold_over:
          ++counts.fold_over;
          break;
        case FindingCode::degenerate:
          ++counts.degenerate;
          break;
        case FindingCode::hole:
          ++counts.hole;
          break;
        case FindingCode::overlap:
          ++counts.overlap;
          break;
        case FindingCode::outline:
          ++counts.outline;
          break;
        case FindingCode::non_manifold:
          ++counts.non_manifold;
          break;
        case FindingCode::duplicate:
          ++counts.duplicate;
          break;
        case FindingCode::non_finite:
          ++counts.non_finite;
          break;
        case FindingCode::bad_index:
          ++counts.bad_index;
          break;
        case FindingCode::unused_vertex:
          ++counts.unused_vertex;
          break;
        case FindingCode::crack:
          report_.largest_gap_m = std::max(report_.largest_gap_m, std::fabs(finding.gap_m));
          break;
        default:
          break;  // T-junctions were counted where they were found
      }
    }
    std::sort(report_.findings.begin(), report_.findings.end(), [](const Finding& a, const Finding& b) {
      if (a.code != b.code) return a.code < b.code;
      if (a.at.x != b.at.x) return a.at.x < b.at.x;
      if (a.at.y != b.at.y) return a.at.y < b.at.y;
      if (a.at.z != b.at.z) return a.at.z < b.at.z;
      if (a.vertices != b.vertices) return a.vertices < b.vertices;
      if (a.triangles != b.triangles) return a.triangles < b.triangles;
      return a.area_m2 < b.area_m2;
    });
  }

  const Mesh& mesh_;
  const PlanDomain& domain_;
  bool outline_is_free_;
  ConformityReport report_;
  Survey survey_;
  std::vector<std::uint8_t> treatment_;  // empty: all normal
  std::vector<VertexPair> excused_edges_;
  std::vector<std::uint32_t> excused_vertices_;
  std::vector<Duplicate> duplicates_;
  std::vector<bool> turned_;  // of survey_.negative
};

}  // namespace

std::size_t ConformityCounts::total() const {
  return crack + t_junction + fold_over + degenerate + hole + overlap + outline + non_manifold + duplicate +
         non_finite + bad_index + unused_vertex;
}

ConformityReport check_conformity(const Mesh& mesh, const PlanDomain& domain) {
  return Check(mesh, domain).run();
}

ConformityReport check_conformity_without_outline(const Mesh& mesh) { return Check(mesh, {}, true).run(); }

}  // namespace plumbline::oracle
