// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The meshes against what they stand for: a DEM, a finer mesh, the picture that a camera takes.
#include "properties/check/against.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "oracle/likeness.h"
#include "scenarios/error.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline::checking {
namespace {

using oracle::FindingCode;

/// How finely distances in space are certified, as a share of the reference's half diagonal.
constexpr double kWithinShare = 1e-3;
/// And this finely where a declared bound stays undecided. Where surfaces coincide but are cut into triangles
/// differently, the search halves triangles along every edge until they are that small: 20 000 take half a
/// minute.
constexpr double kFinestShare = 0x1p-12;
/// And no finer than this share of the largest coordinate: a few thousand times the rounding of doubles.
constexpr double kResolution = 0x1p-40;

bool all_finite(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      if (v >= count) return false;
      const Vec3& p = mesh.positions[v];
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
  });
}

void add_unjudged(std::vector<verdict::CheckFinding>& findings, std::string why) {
  verdict::CheckFinding found;
  found.mesh = 0;
  found.finding.code = FindingCode::nothing_judged;
  found.finding.kind = "reference";
  found.message = "distances from the reference were not judged: " + std::move(why);
  findings.push_back(std::move(found));
}

void against_reference(Examination& exam, std::vector<verdict::CheckFinding>& findings) {
  const CheckRequest& request = exam.request;
  if (exam.subjects.size() != 1 || exam.subjects[0].tile)
    throw InputError("--reference compares one mesh with another; give one mesh");
  Subject& subject = exam.subjects[0];
  Mesh reference = welded(triangulate(read_mesh_file(request.reference)));
  for (Vec3& p : reference.positions) p = exam.frame.from_file(p);
  if (exam.frame.turned) {
    for (auto& t : reference.triangles) std::swap(t[1], t[2]);
  }
  const Mesh mesh = welded(subject.mesh);
  if (reference.triangles.empty())
    throw InputError(fmt::format("{}: the reference has no triangle", one_line(request.reference.string())));
  if (!all_finite(reference) || !all_finite(mesh)) {
    add_unjudged(findings, "a coordinate is not finite, or an index is bad");
    return;
  }
  Vec3 low = reference.positions.front(), high = low;
  for (const Vec3& p : reference.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double unit = exam.frame.unit_m;
  const double half = length(high - low) / 2;
  double farthest = 0;
  for (const Mesh* one : std::array{static_cast<const Mesh*>(&reference), &mesh}) {
    for (const Vec3& p : one->positions)
      farthest = std::max({farthest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  const double finest = std::max(kFinestShare * half, kResolution * farthest);
  double within = std::max({kWithinShare * half, finest, std::numeric_limits<double>::min()});
  std::optional<oracle::Likeness> likeness;
  while (true) {
    likeness = oracle::compare_in_space(mesh, reference, within);
    if (!likeness || !request.declared_m || !(within > finest)) break;
    const oracle::CertifiedDistance distance = likeness->hausdorff();
    if (distance.most_m * unit <= *request.declared_m || distance.least_m * unit > *request.declared_m) break;
    within = finest;  // undecided: once more, as finely as goes
  }
  if (!likeness) {
    add_unjudged(findings, "one of the two meshes is no oriented manifold, or has no area");
    return;
  }
  verdict::ReferenceVerdict& out = exam.verdict.reference.emplace();
  out.file = request.reference.generic_string();
  out.likeness = *likeness;
  for (oracle::CertifiedDistance* d : {&out.likeness.to_mesh, &out.likeness.from_mesh}) {
    d->least_m *= unit;
    d->most_m *= unit;
  }
  out.declared_m = request.declared_m;
  if (!out.declared_m) return;
  const oracle::CertifiedDistance distance = out.likeness.hausdorff();
  out.declared_holds = distance.most_m <= *out.declared_m;
  out.declared_broken = distance.least_m > *out.declared_m;
  if (!out.declared_holds && !out.declared_broken) {
    add_unjudged(findings, fmt::format("whether {} hold is undecided: the largest lies between {} and {}",
                                       length_text(*out.declared_m), length_text(distance.least_m),
                                       length_text(distance.most_m)));
    return;
  }
  if (!out.declared_broken) return;
  verdict::CheckFinding found;
  found.mesh = 0;
  found.finding.code = FindingCode::declared_error;
  found.finding.kind = "reference";
  found.finding.distance_m = distance.least_m;
  found.finding.at = oracle::farthest_vertex(mesh, reference);
  found.at = exam.frame.to_file(found.finding.at);
  found.message = fmt::format("the mesh and its reference are at least {} apart; {} were declared",
                              length_text(distance.least_m), length_text(*out.declared_m));
  findings.push_back(std::move(found));
}

}  // namespace

std::vector<verdict::CheckFinding> judge_against(Examination& exam, verdict::CheckPictures& pictures) {
  std::vector<verdict::CheckFinding> findings;
  if (exam.request.declared_m && exam.request.terrain.empty() && exam.request.reference.empty())
    throw InputError("--declared: against what? Give --terrain DEM or --reference MESH");
  Stage stage;
  if (!exam.request.terrain.empty()) against_terrain(exam, stage, findings, pictures);
  if (!exam.request.reference.empty()) against_reference(exam, findings);
  if (exam.request.camera) against_camera(exam, stage, findings, pictures);
  return findings;
}

}  // namespace plumbline::checking
