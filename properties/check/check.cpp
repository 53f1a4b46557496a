// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/check/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "properties/check/examination.h"
#include "properties/check/tiles.h"

namespace plumbline {
namespace checking {
namespace {

using oracle::FindingCode;
using oracle::Severity;
using verdict::CheckFinding;

/// What explains the rest comes first: a mesh laid wrong over its DEM makes every other figure meaningless.
int rank(const CheckFinding& found) {
  const FindingCode code = found.finding.code;
  const int severity = found.finding.severity == Severity::fault ? 0 : 100;
  constexpr std::array kOrder{
      FindingCode::misplaced,     FindingCode::tile_encoding, FindingCode::bad_index,
      FindingCode::non_finite,    FindingCode::crack,         FindingCode::slit,
      FindingCode::hole,          FindingCode::overlap,       FindingCode::fold_over,
      FindingCode::outline,       FindingCode::t_junction,    FindingCode::self_intersection,
      FindingCode::non_manifold,  FindingCode::duplicate,     FindingCode::degenerate,
      FindingCode::declared_error};
  const auto place = std::find(kOrder.begin(), kOrder.end(), code);
  return severity + static_cast<int>(place - kOrder.begin());
}

double size(const CheckFinding& found) {
  return std::max({std::fabs(found.finding.gap_m), found.finding.area_m2, found.finding.distance_m});
}

void add_counts(oracle::ConformityCounts& sum, const oracle::ConformityCounts& c) {
  sum.crack += c.crack;
  sum.t_junction += c.t_junction;
  sum.fold_over += c.fold_over;
  sum.degenerate += c.degenerate;
  sum.hole += c.hole;
  sum.overlap += c.overlap;
  sum.outline += c.outline;
  sum.non_manifold += c.non_manifold;
  sum.duplicate += c.duplicate;
  sum.non_finite += c.non_finite;
  sum.bad_index += c.bad_index;
  sum.unused_vertex += c.unused_vertex;
}

/// A T-junction without a gap is a hazard for the mesh's maker to know, and still no sound mesh: a rasteriser
/// shows pixels through it, unless a skirt stands behind.
bool makes_faulty(const CheckFinding& found, bool strict) {
  if (found.finding.severity == Severity::fault || strict) return true;
  return found.finding.code == FindingCode::t_junction && found.other_mesh == verdict::kNoMesh;
}

void gather(Examination& exam, std::vector<CheckFinding> more) {
  verdict::CheckVerdict& verdict = exam.verdict;
  std::vector<CheckFinding> all;
  for (std::uint32_t k = 0; k < exam.subjects.size(); ++k) {
    Subject& subject = exam.subjects[k];
    add_counts(verdict.conformity, subject.facts.conformity);
    for (CheckFinding& found : subject.findings) {
      found.mesh = k;
      all.push_back(std::move(found));
    }
    subject.findings.clear();
  }
  for (auto* list : {&exam.between, &more}) {
    for (CheckFinding& found : *list) all.push_back(std::move(found));
    list->clear();
  }
  for (const CheckFinding& found : all) {
    verdict.sound = verdict.sound && !makes_faulty(found, exam.request.strict);
    verdict.tile_faults += found.finding.code == FindingCode::tile_encoding;
    ++verdict.totals[found.finding.code];
  }
  // Of pairs, which may be many more than triangles, only those to list were kept.
  for (const Subject& subject : exam.subjects) {
    const std::size_t pairs = subject.facts.self_intersections;
    if (pairs <= kListedOfACode) continue;
    verdict.totals[FindingCode::self_intersection] += pairs - kListedOfACode;
    verdict.findings_total += pairs - kListedOfACode;
  }
  // Tiles were judged on their lattice; the frame of the check is longitude and latitude.
  for (CheckFinding& found : all) {
    if (found.mesh != verdict::kNoMesh && exam.subjects[found.mesh].tile &&
        exam.subjects[found.mesh].tile->placed)
      found.finding.at = found.at;
  }
  verdict.findings_total += all.size();
  std::stable_sort(all.begin(), all.end(), [](const CheckFinding& a, const CheckFinding& b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return size(a) > size(b);
  });
  std::map<std::pair<std::uint32_t, int>, std::size_t> listed;
  for (CheckFinding& found : all) {
    if (listed[{found.mesh, static_cast<int>(found.finding.code)}]++ < kListedOfACode)
      verdict.findings.push_back(std::move(found));
  }
}

/// What an object leaves open, and what was not judged of it.
void tell_objects(Examination& exam) {
  for (const Subject& subject : exam.subjects) {
    if (!subject.facts.terrain && subject.open_edges > 0)
      exam.verdict.notes.push_back(
          fmt::format("{} is not closed: {} edge{} of one triangle alone: a hole, or a sheet",
                      subject.facts.name, subject.open_edges, subject.open_edges == 1 ? "" : "s"));
    if (subject.inside_out)
      exam.verdict.notes.push_back(
          fmt::format("{} is closed and its triangles face inwards: back-face culling shows its far side",
                      subject.facts.name));
    if (subject.facts.terrain || subject.facts.self_intersections_judged) continue;
    exam.verdict.notes.push_back(
        fmt::format("{}: self-intersections were not judged: {}", subject.facts.name,
                    subject.facts.triangles > kMostIntersected
                        ? fmt::format("more than {} triangles", kMostIntersected)
                        : "it is no oriented manifold; what makes it none is told by itself"));
  }
}

}  // namespace
}  // namespace checking

CheckOutcome check(const CheckRequest& request) {
  using namespace checking;
  std::optional<tbb::global_control> limit;
  if (request.jobs > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(request.jobs));
  Examination exam{request, {}, {}, {}, {}};
  load(exam);
  // Each by itself: what threads do in which order nobody sees.
  tbb::parallel_for(std::size_t{0}, exam.subjects.size(),
                    [&](std::size_t k) { judge_inside(exam.subjects[k], exam); });
  tell_objects(exam);
  apply_stated_skirts(exam);
  judge_between(exam);
  CheckOutcome out;
  std::vector<verdict::CheckFinding> more = judge_against(exam, out.pictures);
  gather(exam, std::move(more));
  for (checking::Subject& subject : exam.subjects) exam.verdict.meshes.push_back(subject.facts);
  if (request.pictures) out.pictures.spots = make_spots(exam);
  out.verdict = std::move(exam.verdict);
  return out;
}

}  // namespace plumbline
