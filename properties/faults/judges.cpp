// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/faults/judges.h"

#include <memory>
#include <utility>

#include "oracle/soundness.h"

namespace plumbline::faults {

Judges real_judges() {
  const auto device = std::make_shared<const oracle::RayDevice>();
  Judges judges;
  judges.conformity = oracle::check_conformity;
  judges.vertical = oracle::vertical_error;
  judges.picture = [device](const Camera& camera, const Mesh& reference, const Mesh& mesh,
                            double threshold_px) {
    const oracle::RaySurface ground(*device, reference), surface(*device, mesh);
    oracle::ImageMaps maps;
    PictureVerdict verdict;
    verdict.error = oracle::image_error(camera, ground, ground.look(camera), surface, surface.look(camera),
                                        threshold_px, &maps);
    verdict.displacement_px = std::move(maps.displacement_px);
    return verdict;
  };
  judges.slack = [device](const Camera& camera, const Mesh& reference, const Mesh& mesh,
                          double threshold_px) {
    const oracle::RaySurface ground(*device, reference), surface(*device, mesh);
    SlackVerdict verdict;
    verdict.slack =
        oracle::measure_slack(camera, ground, ground.look(camera), surface, threshold_px, &verdict.removable);
    return verdict;
  };
  judges.toggles = [](std::span<const FrameChange> flight) {
    oracle::ToggleWatch watch;
    std::vector<std::size_t> toggles;
    for (const FrameChange& change : flight)
      toggles.push_back(watch.next(static_cast<int>(toggles.size()), change.entered, change.left));
    return toggles;
  };
  judges.recovery = [](std::span<const std::pair<bool, bool>> flight) {
    oracle::RecoveryWatch watch;
    for (const auto& frame : flight) watch.next(frame.first, frame.second);
    return watch.most_frames();
  };
  judges.keys = [](std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
    return oracle::compare_keys(a, b).differing;
  };
  judges.shape = oracle::shape;
  judges.soundness = oracle::check_soundness;
  judges.intersections = oracle::self_intersections;
  judges.likeness = oracle::compare_in_space;
  judges.border = [](const Mesh& mesh) {
    return oracle::border_of(mesh, oracle::take_walls_off(mesh), std::span<const Vec3>{});
  };
  judges.seam = [](const oracle::Border& a, const oracle::Border& b) {
    return oracle::compare_borders(a, b);
  };
  judges.slit = oracle::find_slit;
  judges.tile = [](const QuantizedMesh& tile, const TileBounds& bounds) {
    return oracle::check_tile(tile, bounds);
  };
  judges.placement = [](std::span<const Vec3> vertices, const Terrain& terrain) {
    return oracle::recognise_misplacement(vertices, terrain);
  };
  return judges;
}

}  // namespace plumbline::faults
