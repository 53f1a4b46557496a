// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What findings mean, in words for whoever made the mesh.
#include <cmath>

#include <fmt/format.h>

#include "properties/check/examination.h"

namespace plumbline::checking {

using oracle::Finding;
using oracle::FindingCode;

std::string length_text(double metres) {
  const double size = std::fabs(metres);
  if (size == 0) return "0 m";
  if (!std::isfinite(size)) return fmt::format("{} m", metres);
  if (size >= 1000) return fmt::format("{:.4g} km", metres / 1000);
  if (size >= 1) return fmt::format("{:.3g} m", metres);
  if (size >= 1e-6) return fmt::format("{:.3g} mm", metres * 1e3);
  return fmt::format("{:.3g} m", metres);
}

std::string sufficient_length_text(double metres) {
  // Three digits, the last rounded up: a skirt a little too short is none.
  double unit = 1e-9;
  while (unit * 1000 < metres) unit *= 10;
  return length_text(std::ceil(metres / unit - 1e-9) * unit);
}

namespace {

std::string area_text(double m2) {
  if (m2 >= 1e5) return fmt::format("{:.3g} km²", m2 / 1e6);
  return m2 >= 1000 ? fmt::format("{:.0f} m²", m2) : fmt::format("{:.3g} m²", m2);
}

std::string crack_message(const Finding& finding, double unit_m) {
  const std::string gap = length_text(std::fabs(finding.gap_m) * unit_m);
  if (finding.kind == "cliff")
    return fmt::format("the surface steps by {}, and a wall closes the step: no daylight, but a cliff", gap);
  if (finding.kind == "t_vertex")
    return fmt::format("a vertex stands {} {} the edge that it lies on in plan; daylight shows through", gap,
                       finding.gap_m > 0 ? "above" : "below");
  return fmt::format("two edges coincide in plan and differ in height by {}; daylight shows through", gap);
}

}  // namespace

std::string finding_message(const Finding& finding, double unit_m) {
  const double area = finding.area_m2 * unit_m * unit_m;
  switch (finding.code) {
    case FindingCode::crack:
      return crack_message(finding, unit_m);
    case FindingCode::t_junction:
      return "a vertex lies inside another triangle's edge, at its height: no gap in exact arithmetic, but "
             "a rasteriser shows pixels through it";
    case FindingCode::hole:
      return fmt::format("nothing covers {} that the mesh encloses", area_text(area));
    case FindingCode::overlap:
      return fmt::format("{} are covered more than once", area_text(area));
    case FindingCode::outline:
      return finding.kind == "extra"
                 ? fmt::format("{} lie outside of the outline, up to {} away", area_text(area),
                               length_text(finding.distance_m * unit_m))
                 : fmt::format("{} inside of the outline are not covered, up to {} from it", area_text(area),
                               length_text(finding.distance_m * unit_m));
    case FindingCode::fold_over:
      return finding.kind == "reversed"
                 ? "the triangle is wound clockwise: back-face culling hides it"
                 : fmt::format("the surface folds over itself here ({} in plan)", area_text(area));
    case FindingCode::degenerate:
      return finding.kind == "repeated_index" ? "the triangle names one vertex twice: it shows nothing"
                                              : "the triangle has no area: it shows nothing";
    case FindingCode::duplicate:
      return "the triangle is there twice: the two flicker, or shade twice";
    case FindingCode::non_manifold:
      return finding.kind == "vertex" ? "the triangles at this vertex form several fans"
                                      : "more than two triangles, or two the same way round, share this edge";
    case FindingCode::unused_vertex:
      return "no triangle uses this vertex";
    case FindingCode::bad_index:
      return "the triangle names a vertex that does not exist";
    case FindingCode::non_finite:
      return "a coordinate is infinite or not a number; its triangles show anything";
    case FindingCode::self_intersection:
      return fmt::format("triangles {} and {} cut through each other", finding.triangles.at(0),
                         finding.triangles.at(1));
    case FindingCode::nothing_judged:
      return "the borders are too many to tell holes and overlaps: check fewer meshes, or smaller ones, at a "
             "time";
    default:
      return std::string(oracle::finding_name(finding.code));
  }
}

verdict::CheckFinding as_check_finding(const Finding& finding, const Subject& subject, std::uint32_t index,
                                       const Frame& frame) {
  verdict::CheckFinding out;
  out.finding = finding;
  out.mesh = index;
  const double unit = frame.unit_m;
  if (subject.tile) {
    const Vec2 step = subject.tile->metres_per_step;
    out.finding.area_m2 *= step.x * step.y;
    // What the format says of a tile is in metres already.
    if (finding.code != FindingCode::tile_encoding) out.finding.distance_m *= std::sqrt(step.x * step.y);
    out.at = finding.at;  // a tile whose path does not say where it lies has its lattice alone
    if (subject.tile->placed) {
      const Vec2 deg = subject.tile->grid.position_deg(subject.tile->address, finding.at.x, finding.at.y);
      out.at = {deg.x, deg.y, finding.at.z};
    }
    out.message = finding_message(out.finding, 1);
    return out;
  }
  out.at = frame.to_file(finding.at);
  out.message = finding_message(finding, unit);
  out.finding.gap_m *= unit;
  out.finding.area_m2 *= unit * unit;
  out.finding.distance_m *= unit;
  return out;
}

}  // namespace plumbline::checking
