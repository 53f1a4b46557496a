// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The meshes against what they stand for: a DEM, a finer mesh, the picture that a camera takes.
#include "properties/check/against.h"

#include <algorithm>
#include <cmath>
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

void against_reference(Examination& exam, std::vector<verdict::CheckFinding>& findings) {
  const CheckRequest& request = exam.request;
  if (exam.subjects.size() != 1 || exam.subjects[0].tile)
    throw InputError("--reference compares one mesh with another; give one mesh");
  Subject& subject = exam.subjects[0];
  Mesh reference = welded(triangulate(read_mesh_file(request.reference)));
  for (Vec3& p : reference.positions) p = exam.frame.from_file(p);
  const Mesh mesh = welded(subject.mesh);
  if (reference.triangles.empty())
    throw InputError(fmt::format("{}: the reference has no triangle", one_line(request.reference.string())));
  if (!all_finite(reference) || !all_finite(mesh)) {
    exam.verdict.notes.emplace_back(
        "distances from the reference were not judged: a coordinate is not finite, or an index is bad");
    return;
  }
  Vec3 low = reference.positions.front(), high = low;
  for (const Vec3& p : reference.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double unit = exam.frame.unit_m;
  double within = kWithinShare * length(high - low) / 2;
  if (request.declared_m) within = std::min(within, *request.declared_m / unit / 100);
  if (!(within > 0)) within = kWithinShare;
  const auto likeness = oracle::compare_in_space(mesh, reference, within);
  if (!likeness) {
    exam.verdict.notes.emplace_back(
        "distances from the reference were not judged: one of the two meshes is no oriented manifold");
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
