// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/check_words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reports/digest.h"

namespace plumbline::reports {
namespace {

using oracle::FindingCode;
using verdict::CheckVerdict;
using verdict::SeamVerdict;

/// How a person speaks of a code, and what he does about it.
struct CodeWords {
  FindingCode code;
  std::string_view one, many, remedy;
};
constexpr CodeWords kCodeWords[] = {
    {FindingCode::bad_index, "bad index", "bad indices",
     "Mend the writer: these triangles name vertices that do not exist, and a reader may crash on them."},
    {FindingCode::non_finite, "non-finite vertex", "non-finite vertices",
     "Find where a NaN or an infinity comes in (no-data samples, a division by zero) and leave these "
     "vertices "
     "out."},
    {FindingCode::tile_encoding, "tile encoding fault", "tile encoding faults",
     "Mend the tile writer: clients decode something else than was meant, or cull what should be drawn."},
    {FindingCode::nothing_judged, "question with nothing to judge", "questions with nothing to judge",
     "Give it something to judge: nothing was looked at there, so nothing was proved."},
    {FindingCode::degenerate, "triangle without area", "triangles without area",
     "Drop the triangles without area: they break normals, collision and every later simplification."},
    {FindingCode::duplicate, "duplicate triangle", "duplicate triangles", "Write each triangle once."},
    {FindingCode::non_manifold, "non-manifold place", "non-manifold places",
     "Give each sheet vertices of its own where several meet, or drop the surplus triangle."},
    {FindingCode::unused_vertex, "unused vertex", "unused vertices",
     "Drop the vertices that no triangle names, or find the triangles that were lost."},
    {FindingCode::fold_over, "fold-over", "fold-overs",
     "Turn 'reversed' triangles round; where the surface is 'folded', refuse the step that moved a vertex "
     "across an edge."},
    {FindingCode::sliver, "sliver", "slivers",
     "Bound the shape of triangles: slivers shade badly and lose their plane in single precision."},
    {FindingCode::self_intersection, "self-intersection", "self-intersections",
     "Refuse the step that pushes the surface through itself."},
    {FindingCode::t_junction, "T-junction", "T-junctions",
     "Split the edge at that vertex, or drop the vertex: a rasteriser shows pixels through it."},
    {FindingCode::crack, "crack", "cracks",
     "Give both sides the same vertices and heights along their border, or hang a skirt deep enough."},
    {FindingCode::hole, "hole", "holes", "Fill the hole: no triangle covers that region."},
    {FindingCode::overlap, "overlap", "overlaps",
     "Cover each place once: two surfaces flicker where they overlap."},
    {FindingCode::outline, "departure from the outline", "departures from the outline",
     "Let the mesh end where its outline does, or say which outline was meant."},
    {FindingCode::slit, "slit", "slits",
     "Let both sides end on the same line in plan: sky shows between their borders."},
    {FindingCode::border_normal, "border with two normals", "borders with two normals",
     "Compute the normals of border vertices from both sides: light shows the seam."},
    {FindingCode::misplaced, "misplaced mesh", "misplaced meshes",
     "Mend the order of rows, the order of axes or the offset before anything else: the mesh fits its DEM "
     "elsewhere."},
    {FindingCode::declared_error, "false error bound", "false error bounds",
     "State the bound that holds, or refine where the declared one is broken."},
    {FindingCode::law_violated, "broken law", "broken laws", "See the law's page."},
    {FindingCode::level_gap, "gap of levels", "gaps of levels",
     "Refine the coarser neighbour until levels differ by one at most."},
    {FindingCode::error_over_threshold, "place over the threshold", "places over the threshold",
     "Refine there, or state a larger threshold."},
    {FindingCode::uncovered, "uncovered region", "uncovered regions",
     "Cover what the picture shows: there the reference has a surface and the mesh none."},
    {FindingCode::skirt_visible, "visible skirt", "visible skirts",
     "Shorten the skirt, or close the seam behind it: from this camera its wall is seen."},
};

const CodeWords* words_of(FindingCode code) {
  const auto* found = std::ranges::find(kCodeWords, code, &CodeWords::code);
  return found == std::end(kCodeWords) ? nullptr : found;
}

const oracle::FindingDescription* catalogue_entry(FindingCode code) {
  const auto& catalogue = oracle::finding_catalogue();
  const auto found = std::ranges::find(catalogue, code, &oracle::FindingDescription::code);
  return found == catalogue.end() ? nullptr : &*found;
}

/// How often a code was met, whatever the list holds; nothing if nobody counts it.
std::optional<std::size_t> complete_count(const CheckVerdict& verdict, FindingCode code) {
  if (!verdict.totals.empty()) {
    const auto known = verdict.totals.find(code);
    return known == verdict.totals.end() ? 0 : known->second;
  }
  if (code == FindingCode::tile_encoding) return verdict.tile_faults;
  if (code == FindingCode::t_junction) return std::nullopt;  // its count has T-vertices with a gap, too
  for (const FindingColumn& column : finding_columns())
    if (column.name == oracle::finding_name(code)) return verdict.conformity.*column.count;
  return std::nullopt;
}

/// Codes that were counted and are not in the capped list.
void add_unlisted(const CheckVerdict& verdict, std::vector<CodeGroup>& groups) {
  for (const oracle::FindingDescription& entry : oracle::finding_catalogue()) {
    const std::size_t count = complete_count(verdict, entry.code).value_or(0);
    if (count == 0) continue;
    if (std::ranges::find(groups, entry.code, &CodeGroup::code) != groups.end()) continue;
    CodeGroup group;
    group.code = entry.code;
    group.count = count;
    group.hazard = entry.code == FindingCode::unused_vertex;
    group.between_meshes = false;
    groups.push_back(std::move(group));
  }
}

double largest_gap(const SeamVerdict& seam) { return std::fabs(seam.largest_gap_m); }

double skirt_needed(const SeamVerdict& seam) {
  return std::max(seam.least_skirt_m, seam.least_skirt_other_m);
}

}  // namespace

std::string code_name(FindingCode code) {
  return catalogue_entry(code) != nullptr ? std::string(oracle::finding_name(code))
                                          : fmt::format("finding_{}", static_cast<int>(code));
}

std::string code_link(FindingCode code) {
  return catalogue_entry(code) != nullptr ? oracle::finding_section(code) : std::string();
}

std::string_view code_definition(FindingCode code) {
  const oracle::FindingDescription* entry = catalogue_entry(code);
  return entry == nullptr ? std::string_view() : entry->definition;
}

std::string counted_code(FindingCode code, std::size_t count) {
  const CodeWords* words = words_of(code);
  if (words == nullptr) return fmt::format("{} {}", count, code_name(code));
  return fmt::format("{} {}", count, count == 1 ? words->one : words->many);
}

std::string_view code_remedy(FindingCode code) {
  const CodeWords* words = words_of(code);
  return words == nullptr ? std::string_view() : words->remedy;
}

std::vector<CodeGroup> group_findings(const CheckVerdict& verdict) {
  std::vector<CodeGroup> groups;
  for (std::size_t i = 0; i < verdict.findings.size(); ++i) {
    const verdict::CheckFinding& finding = verdict.findings[i];
    auto group = std::ranges::find(groups, finding.finding.code, &CodeGroup::code);
    if (group == groups.end()) {
      CodeGroup fresh;
      fresh.code = finding.finding.code;
      group = groups.insert(groups.end(), std::move(fresh));
    }
    group->listed.push_back(i);
    group->hazard = group->hazard && finding.finding.severity == oracle::Severity::hazard;
    group->between_meshes = group->between_meshes && finding.other_mesh != verdict::kNoMesh;
  }
  const bool capped = verdict.findings_total > verdict.findings.size();
  for (CodeGroup& group : groups) {
    const auto complete = capped ? complete_count(verdict, group.code) : std::nullopt;
    group.count = std::max(group.listed.size(), complete.value_or(0));
    group.exact = !capped || complete.has_value();
  }
  if (capped) add_unlisted(verdict, groups);
  std::stable_partition(groups.begin(), groups.end(), [](const CodeGroup& group) { return !group.hazard; });
  return groups;
}

bool is_faulty(const SeamVerdict& seam) {
  const bool rounding = seam.t_junctions == 0 && verdict::is_rounding(seam, seam.largest_gap_m);
  return seam.state == verdict::SeamState::open && seam.must_meet && !rounding;
}

SeamTotals seam_totals(const CheckVerdict& verdict) {
  SeamTotals totals;
  for (const SeamVerdict& seam : verdict.seams) {
    if (seam.state == verdict::SeamState::watertight) ++totals.watertight;
    if (seam.state == verdict::SeamState::covered_by_skirt) ++totals.covered;
    if (seam.state != verdict::SeamState::open) continue;
    ++totals.open;
    if (!seam.must_meet) {
      ++totals.between_levels;
    } else if (!is_faulty(seam)) {
      ++totals.rounding;
    }
  }
  return totals;
}

std::string seam_totals_words(const SeamTotals& totals) {
  std::string out = fmt::format("{} watertight, {} covered by a skirt, {} open", totals.watertight,
                                totals.covered, totals.open);
  std::vector<std::string> excused;
  if (totals.between_levels > 0) excused.push_back(fmt::format("{} between levels", totals.between_levels));
  if (totals.rounding > 0)
    excused.push_back(fmt::format("{} by no more than the rounding of heights", totals.rounding));
  if (!excused.empty()) out += fmt::format(" ({})", fmt::join(excused, ", "));
  return out;
}

const SeamVerdict* worst_seam(const CheckVerdict& verdict) {
  const auto worst = std::ranges::max_element(verdict.seams, {}, largest_gap);
  return worst == verdict.seams.end() || largest_gap(*worst) == 0 ? nullptr : &*worst;
}

double sufficient_skirt_m(const CheckVerdict& verdict) {
  double depth = 0;
  for (const SeamVerdict& seam : verdict.seams) depth = std::max(depth, skirt_needed(seam));
  for (const verdict::CheckedMesh& mesh : verdict.meshes) depth = std::max(depth, mesh.least_skirt_m);
  return depth;
}

std::string skirt_advice(const CheckVerdict& verdict) {
  const double depth = sufficient_skirt_m(verdict);
  if (!(depth > 0)) return {};
  std::string out = fmt::format("A skirt of {} below every border covers every gap between meshes",
                                sufficient_metres(depth));
  const auto worst = std::ranges::max_element(verdict.seams, {}, skirt_needed);
  if (worst != verdict.seams.end() && skirt_needed(*worst) > 0)
    out += fmt::format("; the worst pair is {} and {}", mesh_name(verdict, worst->mesh),
                       mesh_name(verdict, worst->other_mesh));
  return out + ".";
}

std::string mesh_name(const CheckVerdict& verdict, std::uint32_t mesh) {
  if (mesh >= verdict.meshes.size()) return "?";
  return verdict.meshes[mesh].name.empty() ? verdict.meshes[mesh].file : verdict.meshes[mesh].name;
}

std::string whose(const CheckVerdict& verdict, const verdict::CheckFinding& finding) {
  if (finding.mesh == verdict::kNoMesh && finding.other_mesh == verdict::kNoMesh) return {};
  std::string out = mesh_name(verdict, finding.mesh);
  if (finding.other_mesh != verdict::kNoMesh) out += " | " + mesh_name(verdict, finding.other_mesh);
  return out;
}

std::string place_words(Vec3 at) { return fmt::format("{:.10g}, {:.10g}, {:.7g}", at.x, at.y, at.z); }
std::string place_words(Vec2 at) { return fmt::format("{:.10g}, {:.10g}", at.x, at.y); }

std::string metres(double value) { return short_number(value) + " m"; }
std::string sufficient_number(double value) {
  // Three digits, the last rounded up: a skirt a little too short is none.
  double unit = 1e-9;
  while (unit * 1000 < value) unit *= 10;
  return value >= 1000 ? short_number(std::ceil(value)) : short_number(std::ceil(value / unit - 1e-9) * unit);
}
std::string sufficient_metres(double value) { return sufficient_number(value) + " m"; }
std::string signed_metres(double value) { return (value > 0 ? "+" : "") + metres(value); }

std::string size_words(const oracle::Finding& finding) {
  std::vector<std::string> parts;
  const bool tile = finding.code == FindingCode::tile_encoding;
  if (finding.gap_m != 0)
    parts.push_back(tile ? metres(finding.gap_m) + " out" : "gap " + signed_metres(finding.gap_m));
  if (finding.gap_px != 0)
    parts.push_back(fmt::format("{} px in the picture", short_number(std::fabs(finding.gap_px))));
  if (finding.area_m2 != 0) parts.push_back(fmt::format("{} m²", short_number(finding.area_m2)));
  if (finding.distance_m != 0) {
    const std::string distance = metres(finding.distance_m);
    parts.push_back(finding.code == FindingCode::misplaced        ? "RMS " + distance
                    : finding.code == FindingCode::declared_error ? distance + " off"
                    : finding.code == FindingCode::slit           ? distance + " wide"
                                                                  : distance + " away");
  }
  if (finding.visibility == oracle::Visibility::visible) parts.emplace_back("visible");
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string message_words(const verdict::CheckFinding& finding) {
  if (!finding.message.empty()) return finding.message;
  const std::string size = size_words(finding.finding);
  return fmt::format("{}{}{}.", counted_code(finding.finding.code, 1),
                     finding.finding.kind.empty() ? "" : fmt::format(" ({})", finding.finding.kind),
                     size.empty() ? "" : ": " + size);
}

double size_of(const oracle::Finding& finding) {
  for (const double size : {std::fabs(finding.gap_m), finding.area_m2, finding.distance_m})
    if (size > 0) return size;
  return 0;
}

}  // namespace plumbline::reports
