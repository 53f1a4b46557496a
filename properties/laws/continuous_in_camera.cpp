// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Law: for every terrain, flight and threshold, an update that merges and does not split, with the camera of
// the update before, leaves the surface as it was. Source: METHODS M1.C4 ("the mesh just before equals the
// mesh just after, as a point set"). The camera stands still between the two, so what changes is the merging
// alone.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "oracle/image.h"
#include "properties/laws/trial.h"

namespace plumbline::properties {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

/// The triangles by place, each from its least corner on: equal lists are equal surfaces.
std::vector<Corners> by_place(const Mesh& mesh) {
  std::vector<Corners> out;
  out.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[triangle[k]];
      corners[k] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    out.push_back(corners);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// The largest vertical gap at a vertex of `points` that lies under or over `surface`.
void widen(const Mesh& points, const oracle::RaySurface& surface, double& gap_m, Vec3& at) {
  for (const Vec3& p : points.positions) {
    const std::optional<double> z = surface.height_at({p.x, p.y});
    if (z && std::fabs(*z - p.z) > std::fabs(gap_m)) {
      gap_m = *z - p.z;
      at = p;
    }
  }
}

/// Interpolated heights are rounded a few times each; relative to the largest height on the terrain.
constexpr double kInterpolationRounding = 0x1p-46;

LawOutcome check(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const std::vector<Camera> flight = cameras(input);
  const LodFrame before = fly(*method, flight);
  LodFrame after;
  method->update(flight.back(), after);
  if (after.counters.split > 0) return vacuous("the second update splits: the claim is about merging");
  if (after.counters.merged == 0) return vacuous("nothing merges");
  if (by_place(before.mesh) == by_place(after.mesh)) return held();

  static thread_local const oracle::RayDevice device;
  const oracle::RaySurface old_surface(device, before.mesh);
  const oracle::RaySurface new_surface(device, after.mesh);
  double gap_m = 0;
  Vec3 at = flight.back().position;
  widen(before.mesh, new_surface, gap_m, at);
  widen(after.mesh, old_surface, gap_m, at);
  const double largest = std::max(std::fabs(input.terrain.lowest_m()), std::fabs(input.terrain.highest_m()));
  if (std::fabs(gap_m) <= largest * kInterpolationRounding) return held();
  oracle::Finding finding = law_finding("merge_is_seen", at);
  finding.gap_m = gap_m;
  std::string what = fmt::format("merging {} nodes moves the surface by {:.6g} m at ({:.6g}, {:.6g}, {:.6g})",
                                 after.counters.merged, std::fabs(gap_m), at.x, at.y, at.z);
  if (const double depth_m = flight.back().depth(at); depth_m > 0) {
    finding.gap_px = std::fabs(gap_m) * flight.back().kappa_px / depth_m;
    what += fmt::format(" = {:.6g} px = {:.4g} tau", finding.gap_px, finding.gap_px / input.threshold_px);
  }
  return violated(std::move(what), std::move(finding));
}

}  // namespace

Law law_continuous_in_camera() {
  return {
      .id = "continuous_in_camera",
      .statement =
          "for every terrain, flight and threshold an update that only merges, with the camera of the "
          "update before, leaves the surface as it was",
      .source = "METHODS M1.C4",
      .applies = [](const MethodChoice& choice) { return choice.promises(Promise::continuous_in_camera); },
      .promised = [](const MethodChoice& choice) { return choice.promises(Promise::continuous_in_camera); },
      .check = check};
}

}  // namespace plumbline::properties
