// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "reports/check_words.h"
#include "reports/digest.h"

namespace plumbline::reports {
namespace {

using oracle::FindingCode;
using verdict::CheckedMesh;
using verdict::CheckVerdict;

constexpr std::size_t kHeadlineCodes = 3;

/// Covered exactly once, edge to edge: a vertex that nobody uses takes nothing from that.
bool clean(const CheckedMesh& mesh) {
  return mesh.triangles > 0 && mesh.conformity.total() == mesh.conformity.unused_vertex;
}

/// "two.ply" of one, "3 of 4 meshes" of several.
std::string which(const CheckVerdict& verdict, const std::vector<const CheckedMesh*>& meshes) {
  if (verdict.meshes.size() == 1) return meshes.front()->file;
  if (meshes.size() == 2 && verdict.meshes.size() == 2) return "both meshes";
  return meshes.size() == verdict.meshes.size()
             ? fmt::format("all {} meshes", meshes.size())
             : fmt::format("{} of {} meshes", meshes.size(), verdict.meshes.size());
}

std::vector<const CheckedMesh*> those(const CheckVerdict& verdict, auto&& wanted) {
  std::vector<const CheckedMesh*> out;
  for (const CheckedMesh& mesh : verdict.meshes)
    if (wanted(mesh)) out.push_back(&mesh);
  return out;
}

/// "2 open seams, worst gap +4.2 m between a.ply and b.ply at 1, 2, 3"
std::string open_seams(const CheckVerdict& verdict) {
  const std::size_t count = seam_totals(verdict).faulty();
  std::string out = fmt::format("{} open seam{}", count, count == 1 ? "" : "s");
  const verdict::SeamVerdict* worst = nullptr;
  for (const verdict::SeamVerdict& seam : verdict.seams)
    if (is_faulty(seam) &&
        (worst == nullptr || std::fabs(seam.largest_gap_m) > std::fabs(worst->largest_gap_m)))
      worst = &seam;
  const std::string pair = fmt::format("between {} and {}", mesh_name(verdict, worst->mesh),
                                       mesh_name(verdict, worst->other_mesh));
  if (worst->largest_gap_m == 0)
    return fmt::format("{} without a height gap, the first {} ({})", out, pair,
                       counted_code(FindingCode::t_junction, worst->t_junctions));
  return fmt::format("{}, worst gap {} {} at {}; a skirt of {} below every border would cover all", out,
                     signed_metres(worst->largest_gap_m), pair, place_words(worst->largest_at),
                     sufficient_metres(sufficient_skirt_m(verdict)));
}

bool matches_otherwise(const CheckVerdict& verdict) {
  return verdict.terrain && !verdict.terrain->better_match.empty();
}

std::string declared_headline(const CheckVerdict& verdict) {
  if (verdict.terrain && verdict.terrain->declared_m) {
    const verdict::TerrainVerdict& terrain = *verdict.terrain;
    if (terrain.declared_at_samples && terrain.declared_certain && terrain.declared_everywhere)
      return fmt::format("the declared {} holds", metres(*terrain.declared_m));
    if (terrain.declared_at_samples && terrain.declared_certain)
      return fmt::format(
          "the declared {} holds as far as the DEM is unambiguous (with its cells split as said, {} at {})",
          metres(*terrain.declared_m), metres(terrain.vertical_m.max), place_words(terrain.at));
    return fmt::format(
        "the declared {} does not hold{}: {} at {}", metres(*terrain.declared_m),
        terrain.declared_at_samples ? " between samples" : "",
        metres(terrain.declared_at_samples ? terrain.vertical_m.certain_max : terrain.vertical_m.max),
        place_words(terrain.declared_at_samples ? terrain.certain_at : terrain.at));
  }
  if (verdict.reference && verdict.reference->declared_m) {
    const double bound = *verdict.reference->declared_m;
    if (verdict.reference->declared_holds) return fmt::format("the declared {} holds", metres(bound));
    if (!verdict.reference->declared_broken)
      return fmt::format("the declared {} is undecided", metres(bound));
    return fmt::format("the declared {} does not hold: {} or more", metres(bound),
                       metres(verdict.reference->likeness.hausdorff().least_m));
  }
  return {};
}

/// "2 corner_missing, 1 sphere": of the listed ones, in their order.
std::string kinds_of(const CheckVerdict& verdict, const CodeGroup& group) {
  std::vector<std::pair<std::string, std::size_t>> kinds;
  for (const std::size_t i : group.listed) {
    const std::string& kind = verdict.findings[i].finding.kind;
    const auto known = std::ranges::find(kinds, kind, &std::pair<std::string, std::size_t>::first);
    if (known == kinds.end()) {
      kinds.emplace_back(kind, 1);
    } else {
      ++known->second;
    }
  }
  std::vector<std::string> out;
  for (const auto& [kind, count] : kinds) out.push_back(fmt::format("{} {}", count, kind));
  return fmt::format("{}", fmt::join(out, ", "));
}

/// "12 cracks (the worst gap +4.2 m at 1, 2, 3), 1 hole": worst first; a place for the very worst, unless a
/// seam's was told. What the headline says otherwise is left out.
std::string code_words(const CheckVerdict& verdict, bool hazards, bool seams_told) {
  std::vector<std::string> parts;
  std::size_t left = 0;
  for (const CodeGroup& group : group_findings(verdict)) {
    const bool told = (seams_told && group.between_meshes &&
                       (group.code == FindingCode::crack || group.code == FindingCode::t_junction)) ||
                      (group.code == FindingCode::declared_error && !declared_headline(verdict).empty()) ||
                      (group.code == FindingCode::misplaced && matches_otherwise(verdict));
    if (group.hazard != hazards || told) continue;
    if (parts.size() == kHeadlineCodes) {
      ++left;
      continue;
    }
    parts.push_back((group.exact ? "" : "at least ") + counted_code(group.code, group.count));
    if (group.code == FindingCode::skirt_visible && verdict.image)
      parts.back() += fmt::format(" ({} of {} pixels)", verdict.image->skirt_px, verdict.image->mesh_px);
    if (group.code == FindingCode::tile_encoding) {
      parts.back() += fmt::format(" ({})", kinds_of(verdict, group));
      continue;
    }
    if (parts.size() > 1 || seams_told || group.listed.empty()) continue;
    const verdict::CheckFinding& worst = verdict.findings[group.listed.front()];
    const std::string size = size_words(worst.finding);
    std::string where = fmt::format("{}{}at {}",
                                    group.count == 1 ? ""
                                    : size.empty()   ? "the first "
                                                     : "the worst ",
                                    size.empty() ? "" : size + " ", place_words(worst.at));
    if (verdict.meshes.size() > 1 && worst.mesh != verdict::kNoMesh) where += " in " + whose(verdict, worst);
    parts.back() += fmt::format(" ({})", where);
  }
  std::string out = fmt::format("{}", fmt::join(parts, ", "));
  if (left > 0) out += fmt::format(" and {} more kind{}", left, left == 1 ? "" : "s");
  return out;
}

}  // namespace

std::vector<std::string> proved_sentences(const CheckVerdict& verdict) {
  std::vector<std::string> out;
  const auto surfaces = those(verdict, [](const CheckedMesh& m) { return m.terrain && clean(m); });
  if (!surfaces.empty()) {
    std::set<std::string> domains;
    for (const CheckedMesh* mesh : surfaces) domains.insert(mesh->domain);
    // Why it is held to that was said before.
    std::string domain = domains.size() == 1 && !domains.begin()->empty() ? *domains.begin() : "its domain";
    domain = domain.substr(0, domain.find(','));
    const std::string where =
        verdict.meshes.size() == 1 ? std::string() : fmt::format("in {}, ", which(verdict, surfaces));
    out.push_back(fmt::format(
        "{}every point of {} is covered exactly once, edge to edge, at equal heights, decided exactly.",
        where, domain));
  }
  const auto objects = those(verdict, [](const CheckedMesh& m) { return !m.terrain && clean(m); });
  if (!objects.empty())
    out.push_back(
        fmt::format("in {}, every edge has at most two triangles, which agree on its direction, and every "
                    "vertex one fan; no "
                    "triangle is without area, none is there twice, decided exactly.",
                    which(verdict, objects)));
  const auto apart = those(verdict, [](const CheckedMesh& m) {
    return !m.terrain && clean(m) && m.self_intersections_judged && m.self_intersections == 0;
  });
  if (!apart.empty())
    out.push_back(
        fmt::format("in {}, no two triangles meet elsewhere than in a corner or an edge they share, decided "
                    "exactly.",
                    which(verdict, apart)));
  if (const SeamTotals totals = seam_totals(verdict); totals.watertight > 0)
    out.push_back(fmt::format(
        "along {} of {} shared borders the two meshes meet edge to edge at equal heights, decided exactly.",
        totals.watertight, verdict.seams.size()));
  return out;
}

std::string subject_words(const CheckVerdict& verdict) {
  if (verdict.meshes.empty()) return "no mesh";
  if (verdict.meshes.size() == 1) return verdict.meshes.front().file;
  return fmt::format("{} and {} more", verdict.meshes.front().file, verdict.meshes.size() - 1);
}

std::string headline_words(const CheckVerdict& verdict) {
  std::vector<std::string> parts;
  if (matches_otherwise(verdict))
    parts.push_back(fmt::format("matches the DEM if {}", verdict.terrain->better_match));
  const bool open = seam_totals(verdict).faulty() > 0;
  if (open) parts.push_back(open_seams(verdict));
  const std::string faults = code_words(verdict, false, open);
  if (!faults.empty()) parts.push_back(faults);
  const std::string declared = declared_headline(verdict);
  if (!declared.empty()) parts.push_back(declared);
  if (faults.empty() && !open) {
    if (verdict.meshes.empty()) parts.emplace_back("nothing was judged");
    const auto surfaces = those(verdict, [](const CheckedMesh& m) { return m.terrain; });
    const auto proved = those(verdict, clean);
    // What is wrong comes first.
    if (!proved.empty() && proved.size() == verdict.meshes.size())
      parts.insert(verdict.sound ? parts.begin() : parts.end(),
                   surfaces.size() == proved.size()
                       ? verdict.seams.empty() ? "no crack, hole, overlap or fold"
                                               : "no mesh has a crack, hole, overlap or fold inside"
                       : "no fault in how the triangles hang together");
    if (!verdict.seams.empty()) parts.push_back("seams: " + seam_totals_words(seam_totals(verdict)));
  }
  if (const std::string hazards = code_words(verdict, true, true); !hazards.empty()) {
    // Where they alone make it faulty (--strict), they come first.
    const bool alone =
        !verdict.sound && !open && faults.empty() && declared.empty() && !matches_otherwise(verdict);
    parts.insert(alone ? parts.begin() : parts.end(), "hazards: " + hazards);
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::vector<std::string> next_steps(const CheckVerdict& verdict) {
  std::vector<std::string> out;
  if (matches_otherwise(verdict))
    out.push_back(fmt::format(
        "First of all: the mesh matches {} if {}. Mend that, and check again: until then the error "
        "below says little.",
        verdict.terrain->file, verdict.terrain->better_match));
  const bool open = seam_totals(verdict).open > 0;
  for (const CodeGroup& group : group_findings(verdict)) {
    if (group.code == FindingCode::misplaced && matches_otherwise(verdict)) continue;
    const std::string_view remedy = code_remedy(group.code);
    if (remedy.empty()) continue;
    out.push_back(fmt::format("{} ({}{}{})", remedy, group.hazard ? "hazard: " : "",
                              group.exact ? "" : "at least ", counted_code(group.code, group.count)));
  }
  if (open)
    if (const std::string advice = skirt_advice(verdict); !advice.empty()) out.push_back(advice);
  return out;
}

std::vector<DeclaredWords> declared_words(const verdict::TerrainVerdict& terrain) {
  if (!terrain.declared_m) return {};
  const auto said = [](bool holds) { return holds ? "it holds" : "it is broken"; };
  const auto word = [](bool holds) { return holds ? "holds" : "broken"; };
  return {{terrain.declared_at_samples, word(terrain.declared_at_samples),
           fmt::format("At the DEM's samples {}: the largest error there is {}, at {}.",
                       said(terrain.declared_at_samples), metres(terrain.samples_max_m),
                       place_words(terrain.samples_at))},
          {terrain.declared_certain, word(terrain.declared_certain),
           fmt::format("Between samples, whichever way the DEM's cells are split, {}: {} is certain, at {}.",
                       said(terrain.declared_certain), metres(terrain.vertical_m.certain_max),
                       place_words(terrain.certain_at))},
          {terrain.declared_everywhere, word(terrain.declared_everywhere),
           fmt::format(
               "Everywhere, with the DEM read as it is said here, {}: the largest error is {}, at {}.",
               said(terrain.declared_everywhere), metres(terrain.vertical_m.max), place_words(terrain.at))}};
}

std::vector<DeclaredWords> declared_words(const verdict::ReferenceVerdict& reference) {
  if (!reference.declared_m) return {};
  const oracle::CertifiedDistance distance = reference.likeness.hausdorff();
  const std::string interval = fmt::format("the largest distance lies between {} and {}",
                                           metres(distance.least_m), metres(distance.most_m));
  if (reference.declared_holds)
    return {
        {true, "holds", fmt::format("The declared {} holds: {}.", metres(*reference.declared_m), interval)}};
  return {{false, reference.declared_broken ? "broken" : "undecided",
           fmt::format("The declared {} {}: {}.", metres(*reference.declared_m),
                       reference.declared_broken ? "is broken" : "is neither proved nor broken", interval)}};
}

}  // namespace plumbline::reports
