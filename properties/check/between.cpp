// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that should fit together: seams, slits, overlaps and holes between them.
#include "properties/check/between.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace plumbline::checking {
namespace {

using oracle::Finding;
using oracle::FindingCode;
using oracle::Severity;
using verdict::SeamState;

/// A border that follows its neighbour's within this share of its own median edge was meant to meet it.
constexpr double kSlitShare = 0.25;

/// Pairs of subjects (tiles have a way of their own) whose boxes in plan meet or nearly do, in order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours(const std::vector<Subject>& subjects,
                                                                const std::vector<double>& reach) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t k = 0; k < subjects.size(); ++k) {
    const Subject& subject = subjects[k];
    if (subject.facts.terrain && !subject.tile && !subject.border.edges.empty()) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return subjects[a].border.low.x < subjects[b].border.low.x;
  });
  const double widest = reach.empty() ? 0 : *std::max_element(reach.begin(), reach.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const oracle::Border& a = subjects[order[i]].border;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const oracle::Border& b = subjects[order[j]].border;
      if (b.low.x > a.high.x + widest) break;
      const double within = std::max(reach[order[i]], reach[order[j]]);
      if (b.low.x > a.high.x + within || b.low.y > a.high.y + within || a.low.y > b.high.y + within) continue;
      out.emplace_back(std::min(order[i], order[j]), std::max(order[i], order[j]));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

double median_border_edge(const oracle::Border& border) {
  std::vector<double> lengths;
  for (const oracle::BorderEdge& edge : border.edges) {
    const Vec2 d = edge.plan[1] - edge.plan[0];
    lengths.push_back(std::sqrt(d.x * d.x + d.y * d.y));
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>((lengths.size() - 1) / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

class Between {
 public:
  explicit Between(Examination& exam) : exam_(exam) {}

  void judge() {
    std::vector<double> reach;
    for (const Subject& subject : exam_.subjects)
      reach.push_back(kSlitShare * median_border_edge(subject.border));
    for (const auto& [a, b] : neighbours(exam_.subjects, reach)) {
      const auto seam = oracle::compare_borders(exam_.subjects[a].border, exam_.subjects[b].border);
      if (seam) {
        report_seam(exam_, {a, b, exam_.frame.unit_m, 0, true}, *seam);
        if (!(seam->length > 0)) continue;
      }
      look_for_slit(a, b, std::min(reach[a], reach[b]), seam.has_value());
    }
    judge_cover();
    look_for_loners();
  }

 private:
  void look_for_slit(std::uint32_t a, std::uint32_t b, double within, bool meet_elsewhere) {
    const auto& first = exam_.subjects[a].border;
    const auto& second = exam_.subjects[b].border;
    auto slit = oracle::find_slit(first, second, within);
    std::uint32_t of = a;
    if (auto other = oracle::find_slit(second, first, within);
        other && (!slit || other->width > slit->width)) {
      slit = other;
      of = b;
    }
    if (!slit) return;
    Finding finding;
    finding.code = FindingCode::slit;
    finding.severity = meet_elsewhere && slit->vertices < 2 ? Severity::hazard : Severity::fault;
    finding.at = slit->at;
    finding.distance_m = slit->width;
    finding.vertices = {slit->vertex};
    verdict::CheckFinding out = as_check_finding(finding, exam_.subjects[of], of, exam_.frame);
    out.other_mesh = of == a ? b : a;
    out.message = fmt::format(
        "{} border {} within {} of the other mesh's border without meeting it; a slit (or an overlap) of "
        "that width shows",
        slit->vertices, slit->vertices == 1 ? "vertex passes" : "vertices pass",
        length_text(out.finding.distance_m));
    exam_.between.push_back(std::move(out));
  }

  /// Meshes of which no border meets another's: a gap wider than what a slit is looked for in would pass
  /// unseen.
  void look_for_loners() {
    std::vector<bool> met(exam_.subjects.size(), false);
    for (const verdict::SeamVerdict& seam : exam_.verdict.seams) met[seam.mesh] = met[seam.other_mesh] = true;
    for (const verdict::CheckFinding& found : exam_.between) {
      if (found.mesh != verdict::kNoMesh && found.other_mesh != verdict::kNoMesh)
        met[found.mesh] = met[found.other_mesh] = true;
    }
    std::vector<std::uint32_t> loners;
    std::size_t meshes = 0;
    for (std::uint32_t k = 0; k < exam_.subjects.size(); ++k) {
      if (!exam_.subjects[k].facts.terrain || exam_.subjects[k].tile) continue;
      ++meshes;
      if (!met[k]) loners.push_back(k);
    }
    if (meshes < 2 || loners.empty()) return;
    verdict::CheckFinding found;
    found.finding.code = FindingCode::nothing_judged;
    found.finding.kind = "no_neighbour";
    found.finding.severity = Severity::hazard;
    found.mesh = loners.front();
    const verdict::Extent& box = exam_.subjects[found.mesh].facts.box;
    found.finding.at = box.low;
    found.at = exam_.frame.to_file(box.low);
    found.message = fmt::format(
        "{} of {} meshes share no border with another, this the first: if they should fit together, there is "
        "a gap; "
        "nothing was compared",
        loners.size(), meshes);
    exam_.between.push_back(std::move(found));
  }

  static bool is_told(const Subject& subject, const verdict::CheckFinding& found) {
    return std::any_of(subject.findings.begin(), subject.findings.end(), [&](const auto& told) {
      return told.finding.code == found.finding.code && told.finding.at.x == found.finding.at.x &&
             told.finding.at.y == found.finding.at.y && told.finding.area_m2 == found.finding.area_m2;
    });
  }

  /// The first other mesh whose box holds the place.
  [[nodiscard]] std::uint32_t other_below(std::uint32_t mesh, Vec3 at,
                                          const std::vector<std::uint32_t>& of) const {
    for (const std::uint32_t k : of) {
      const verdict::Extent& box = exam_.subjects[k].facts.box;
      if (k != mesh && at.x >= box.low.x && at.x <= box.high.x && at.y >= box.low.y && at.y <= box.high.y)
        return k;
    }
    return verdict::kNoMesh;
  }

  /// A hole of one mesh is none where others fill it edge to edge: then no edge of its rim is left over in
  /// the sum.
  void drop_filled_holes(const Mesh& all, const oracle::ConformityReport& report,
                         const std::vector<std::uint32_t>& of, const std::vector<std::size_t>& first_vertex) {
    const auto is_hole = [](const verdict::CheckFinding& found) {
      return found.finding.code == FindingCode::hole && !found.finding.vertices.empty();
    };
    const bool any = std::any_of(of.begin(), of.end(), [&](std::uint32_t k) {
      return std::any_of(exam_.subjects[k].findings.begin(), exam_.subjects[k].findings.end(), is_hole);
    });
    if (!any) return;
    std::vector<std::uint32_t> triangle_of(all.triangles.size());
    std::iota(triangle_of.begin(), triangle_of.end(), 0u);
    Mesh plan = all;  // what stands higher or lower fills it as well: the seam tells
    for (Vec3& p : plan.positions) p.z = 0;
    const oracle::Border border = oracle::border_of(plan, {plan, std::move(triangle_of), {}}, {}, &report);
    std::vector<std::array<std::uint32_t, 2>> left;
    for (const oracle::BorderEdge& edge : border.edges) left.push_back(edge.vertices);
    std::sort(left.begin(), left.end());
    for (std::size_t i = 0; i < of.size(); ++i) {
      Subject& subject = exam_.subjects[of[i]];
      const auto base = static_cast<std::uint32_t>(first_vertex[i]);
      const auto is_filled = [&](const verdict::CheckFinding& found) {
        if (!is_hole(found)) return false;
        const std::vector<std::uint32_t>& rim = found.finding.vertices;  // ascending
        return std::none_of(rim.begin(), rim.end(), [&](std::uint32_t v) {
          auto edge = std::lower_bound(left.begin(), left.end(), std::array<std::uint32_t, 2>{v + base, 0});
          for (; edge != left.end() && (*edge)[0] == v + base; ++edge) {
            if ((*edge)[1] >= base && std::binary_search(rim.begin(), rim.end(), (*edge)[1] - base))
              return true;
          }
          return false;
        });
      };
      const std::size_t filled = std::erase_if(subject.findings, is_filled);
      subject.facts.conformity.hole -= filled;
      if (filled > 0) subject.facts.domain += " with the meshes that fill its holes";
    }
  }

  /// Overlaps and holes that no single mesh has: the sum of all meshes, its outline free.
  void judge_cover() {
    std::size_t triangles = 0, meshes = 0;
    Mesh all;
    std::vector<std::size_t> first_vertex, first_triangle;
    std::vector<std::uint32_t> of;
    for (std::uint32_t k = 0; k < exam_.subjects.size(); ++k) {
      const Subject& subject = exam_.subjects[k];
      if (!subject.facts.terrain || subject.tile) continue;
      const Mesh& surface = subject.sheet.surface;
      if (all.positions.size() + surface.positions.size() > std::numeric_limits<std::uint32_t>::max() / 2)
        return;
      first_vertex.push_back(all.positions.size());
      first_triangle.push_back(all.triangles.size());
      of.push_back(k);
      const auto base = static_cast<std::uint32_t>(all.positions.size());
      all.positions.insert(all.positions.end(), surface.positions.begin(), surface.positions.end());
      for (auto t : surface.triangles) {
        for (std::uint32_t& v : t) v = v < surface.positions.size() ? v + base : 0xffffffffu;
        all.triangles.push_back(t);
      }
      triangles += surface.triangles.size();
      ++meshes;
    }
    if (meshes < 2 || triangles == 0) return;
    const oracle::ConformityReport report = oracle::check_conformity_without_outline(all);
    drop_filled_holes(all, report, of, first_vertex);
    const auto owner = [&](const std::vector<std::size_t>& starts, std::size_t index) {
      return static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), index) -
                                      starts.begin()) -
             1;
    };
    for (Finding finding : report.findings) {
      if (finding.code != FindingCode::hole && finding.code != FindingCode::overlap &&
          finding.code != FindingCode::nothing_judged && finding.code != FindingCode::duplicate)
        continue;
      std::vector<std::size_t> owners;
      for (const std::uint32_t v : finding.vertices) owners.push_back(owner(first_vertex, v));
      for (const std::uint32_t t : finding.triangles) owners.push_back(owner(first_triangle, t));
      std::sort(owners.begin(), owners.end());
      owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
      const std::uint32_t a = owners.empty() ? of[0] : of[owners[0]];
      // Indices of the sum mean nothing to anybody.
      finding.vertices.clear();
      finding.triangles.clear();
      verdict::CheckFinding out = as_check_finding(finding, exam_.subjects[a], a, exam_.frame);
      if (owners.size() > 1) {
        out.other_mesh = of[owners[1]];
      } else if (finding.code != FindingCode::nothing_judged) {
        // Of meshes that lie on each other the rim of what they share may be one's alone. What the one has by
        // itself it has told.
        if (is_told(exam_.subjects[a], out)) continue;
        out.other_mesh = other_below(a, finding.at, of);
      }
      if (finding.code == FindingCode::hole) ++exam_.verdict.conformity.hole;
      if (finding.code == FindingCode::overlap) ++exam_.verdict.conformity.overlap;
      if (finding.code == FindingCode::duplicate) ++exam_.verdict.conformity.duplicate;
      exam_.between.push_back(std::move(out));
    }
  }

  Examination& exam_;
};

std::string pair_of(const Examination& exam, const Pair& pair) {
  return fmt::format("{} and {}", exam.subjects[pair.first].facts.name,
                     exam.subjects[pair.second].facts.name);
}

std::string gap_message(const Examination& exam, const Pair& pair, const oracle::SeamGap& gap, double gap_m) {
  const std::string& first = exam.subjects[pair.first].facts.name;
  const std::string& second = exam.subjects[pair.second].facts.name;
  if (gap.sign == 0)
    return fmt::format(
        "{} has a vertex here that {} lacks; at the edge's height, but a rasteriser shows pixels "
        "through it{}",
        gap.of_first ? first : second, gap.of_first ? second : first,
        gap.covered ? ", of which a skirt hides most" : "");
  const std::string& higher = gap.sign > 0 ? first : second;
  const std::string& lower = gap.sign > 0 ? second : first;
  const std::string tail = gap.covered ? "its skirt hides the gap"
                                       : fmt::format("a skirt of {} below the border of {} would hide it",
                                                     sufficient_length_text(std::fabs(gap_m)), higher);
  const std::string why = gap.t_junction
                              ? fmt::format(" at a vertex that {} lacks", gap.of_first ? second : first)
                              : std::string();
  return fmt::format("{} stands {} above {}{}; {}", higher, length_text(std::fabs(gap_m)), lower, why, tail);
}

/// How many gaps of one seam are listed; the counts are complete.
constexpr std::size_t kGapsListed = 4;

}  // namespace

void report_seam(Examination& exam, const Pair& pair, const oracle::Seam& seam) {
  Subject& first = exam.subjects[pair.first];
  Subject& second = exam.subjects[pair.second];
  const double unit = pair.height_unit_m;
  verdict::SeamVerdict out;
  out.mesh = pair.first;
  out.other_mesh = pair.second;
  out.state = seam.watertight()     ? SeamState::watertight
              : seam.uncovered == 0 ? SeamState::covered_by_skirt
                                    : SeamState::open;
  out.length_m = seam.length * (first.tile ? 1 : unit);
  out.t_junctions = seam.t_junctions;
  out.cracks = seam.cracks;
  out.largest_gap_m = seam.largest_gap_m * unit;
  out.mean_gap_m = seam.mean_gap_m * unit;
  out.mean_abs_gap_m = seam.mean_abs_gap_m * unit;
  out.least_skirt_m = seam.first_over_second_m * unit;
  out.least_skirt_other_m = seam.second_over_first_m * unit;
  out.quantum_m = pair.quantum_m;
  out.normal_max_deg = seam.normals > 0 ? seam.normal_max_deg : std::numeric_limits<double>::quiet_NaN();
  out.largest_at = pair.to_file ? pair.to_file(seam.largest_at) : exam.frame.to_file(seam.largest_at);
  out.must_meet = pair.must_meet;
  if (first.tile) out.level = first.tile->level;
  if (second.tile) out.other_level = second.tile->level;
  exam.verdict.seams.push_back(out);
  first.facts.least_skirt_m = std::max(first.facts.least_skirt_m, out.least_skirt_m);
  second.facts.least_skirt_m = std::max(second.facts.least_skirt_m, out.least_skirt_other_m);
  // Between levels vertices miss each other by construction: what a skirt hides there is no defect.
  const bool levels = out.level != out.other_level;
  for (const oracle::SeamGap& gap : seam.gaps) {
    if (!pair.must_meet || (levels && gap.covered)) continue;
    exam.verdict.conformity.t_junction += gap.t_junction;
    exam.verdict.conformity.crack += gap.sign != 0;
  }
  list_gaps(exam, pair, seam);
  judge_normals(exam, pair, seam);
}

void list_gaps(Examination& exam, const Pair& pair, const oracle::Seam& seam) {
  const double unit = pair.height_unit_m;
  const std::optional<TilePlace>&tile = exam.subjects[pair.first].tile,
        &other = exam.subjects[pair.second].tile;
  const bool levels = tile && other && tile->level != other->level;
  const auto is_rounding = [&](const oracle::SeamGap& gap) {
    return gap.sign != 0 && std::fabs(gap.gap_m) * unit <= pair.quantum_m * verdict::kQuantumSlack;
  };
  // Rounding explains that two heights of one place differ, not that one of them is missing.
  const auto is_fault = [&](const oracle::SeamGap& gap) {
    return pair.must_meet && !gap.covered && !(is_rounding(gap) && !gap.t_junction);
  };
  std::vector<const oracle::SeamGap*> worst;
  for (const oracle::SeamGap& gap : seam.gaps) {
    if (!(levels && gap.covered && gap.sign == 0)) worst.push_back(&gap);
  }
  std::stable_sort(worst.begin(), worst.end(), [&](const auto* a, const auto* b) {
    if (is_fault(*a) != is_fault(*b)) return is_fault(*a);
    return std::fabs(a->gap_m) > std::fabs(b->gap_m);
  });
  if (!pair.must_meet) {
    // Tiles of two levels have T-junctions by construction, and gaps wherever the ground is not flat: the
    // worst says what there is to say.
    worst.resize(std::min<std::size_t>(worst.size(), 1));
    if (!worst.empty() && worst.front()->sign == 0) worst.clear();
  }
  for (std::size_t k = kGapsListed; k < worst.size(); ++k) {
    ++exam.verdict.findings_total;
    ++exam.verdict.totals[worst[k]->sign == 0 ? FindingCode::t_junction : FindingCode::crack];
  }
  for (std::size_t k = 0; k < std::min(worst.size(), kGapsListed); ++k) {
    const oracle::SeamGap& gap = *worst[k];
    verdict::CheckFinding found;
    Finding& finding = found.finding;
    finding.code = gap.sign == 0 ? FindingCode::t_junction : FindingCode::crack;
    const bool rounding = is_rounding(gap);
    if (gap.sign != 0)
      finding.kind = gap.t_junction ? "t_vertex" : rounding ? "quantization" : "height_mismatch";
    finding.severity = is_fault(gap) ? Severity::fault : Severity::hazard;
    finding.gap_m = gap.gap_m * unit;
    finding.at = gap.at;
    const bool vertex_of_second = gap.t_junction && !gap.of_first;
    found.mesh = vertex_of_second ? pair.second : pair.first;
    found.other_mesh = vertex_of_second ? pair.first : pair.second;
    finding.vertices = {gap.vertex};
    finding.triangles = {vertex_of_second ? gap.other_triangle : gap.triangle};
    found.at = pair.to_file ? pair.to_file(gap.at) : exam.frame.to_file(gap.at);
    found.message = gap_message(exam, pair, gap, finding.gap_m);
    if (rounding)
      found.message += fmt::format("; the gap is no more than the rounding of the two tiles' heights ({})",
                                   length_text(pair.quantum_m));
    if (!pair.must_meet)
      found.message += "; tiles of two levels meet nowhere by themselves: --skirt says what the client adds";
    exam.between.push_back(std::move(found));
  }
}

void judge_normals(Examination& exam, const Pair& pair, const oracle::Seam& seam) {
  if (seam.normals == 0 || !(seam.normal_max_deg > kNormalSeamDeg)) return;
  verdict::CheckFinding found;
  found.finding.code = FindingCode::border_normal;
  found.finding.severity = Severity::hazard;
  found.finding.at = seam.normal_at;
  found.mesh = pair.first;
  found.other_mesh = pair.second;
  found.at = pair.to_file ? pair.to_file(seam.normal_at) : exam.frame.to_file(seam.normal_at);
  found.message = fmt::format(
      "the normals of {} differ by {:.3g} degrees at a vertex that both have; the "
      "border shows as a line of light",
      pair_of(exam, pair), seam.normal_max_deg);
  exam.between.push_back(std::move(found));
}

void judge_between(Examination& exam) {
  Between(exam).judge();
  judge_tiles_between(exam);
  std::stable_sort(exam.verdict.seams.begin(), exam.verdict.seams.end(),
                   [](const verdict::SeamVerdict& a, const verdict::SeamVerdict& b) {
                     if (a.state != b.state) return a.state > b.state;
                     if (a.must_meet != b.must_meet) return a.must_meet;
                     return std::fabs(a.largest_gap_m) > std::fabs(b.largest_gap_m);
                   });
}

}  // namespace plumbline::checking
