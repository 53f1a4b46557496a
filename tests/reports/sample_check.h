// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "oracle/finding_picture.h"
#include "properties/verdict/check_verdict.h"
#include "tests/reports/sample_verdict.h"

/// Made-up verdicts of `plumbline check`: what its reports are developed and tested on. Nothing was judged
/// for them.
namespace plumbline::sample {

inline verdict::CheckedMesh checked_mesh(std::string file, Vec3 low, Vec3 high) {
  verdict::CheckedMesh mesh;
  mesh.file = std::move(file);
  mesh.format = "PLY";
  mesh.domain = "the rectangle of its box";
  mesh.triangles = 2;
  mesh.vertices = 4;
  mesh.box = {low, high};
  mesh.shape = {0.866, 0.9, 45, 0, 2, 1.5, 2};
  mesh.shortest_edge_m = 10;
  mesh.median_edge_m = 10;
  return mesh;
}

/// One square of two triangles.
inline verdict::CheckVerdict sound_check() {
  verdict::CheckVerdict out;
  out.frame = "the file's own, z up";
  out.meshes.push_back(checked_mesh("two.ply", {0, 0, 1}, {10, 10, 3}));
  return out;
}

inline verdict::CheckFinding check_finding(oracle::FindingCode code, std::string kind, std::uint32_t mesh,
                                           Vec3 frame_at, Vec3 at) {
  verdict::CheckFinding out;
  out.finding.code = code;
  out.finding.kind = std::move(kind);
  out.finding.at = frame_at;
  out.mesh = mesh;
  out.at = at;
  return out;
}

/// columns × rows tiles of 1000 m; places in the file are degrees. Seams to the east and to the north: the
/// first is open, every seventh covered, every thirteenth open, the rest watertight.
inline verdict::CheckVerdict tiles_check(int columns = 2, int rows = 2) {
  verdict::CheckVerdict out;
  out.frame = "metres east and north of 7.03125, 46.0546875, and heights";
  const auto in_file = [](Vec3 p) { return Vec3{7.03125 + p.x / 77000, 46.0546875 + p.y / 111000, p.z}; };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      verdict::CheckedMesh tile = checked_mesh(fmt::format("9/{}/{}.terrain", 533 + column, 383 + row),
                                               {1000.0 * column, 1000.0 * row, 400},
                                               {1000.0 * column + 1000, 1000.0 * row + 1000, 900});
      tile.format = "quantized-mesh";
      tile.domain = "its tile's rectangle";
      tile.triangles = 8192;
      tile.vertices = 4225;
      tile.shape = {0.02, 0.71, 1.5, 3, 8, 5.9, 3};
      tile.shortest_edge_m = 4.25;
      tile.median_edge_m = 22;
      tile.skirt = {512, 10.5, 1, false};
      out.meshes.push_back(std::move(tile));
    }
  const auto add = [&](int first, int second, Vec3 at) {
    verdict::SeamVerdict seam;
    const auto n = out.seams.size();
    seam.mesh = static_cast<std::uint32_t>(first);
    seam.other_mesh = static_cast<std::uint32_t>(second);
    seam.length_m = 1000;
    seam.quantum_m = 0.02;
    seam.normal_max_deg = static_cast<double>(n % 5);
    seam.level = seam.other_level = 9;
    if (n == 0 || n % 13 == 0) {
      seam.state = verdict::SeamState::open;
      seam.t_junctions = 8;
      seam.cracks = 12;
      seam.largest_gap_m = -12.25 / static_cast<double>(1 + n);
      seam.mean_gap_m = -0.5;
      seam.mean_abs_gap_m = 0.75;
      seam.least_skirt_other_m = -seam.largest_gap_m;
      seam.least_skirt_m = seam.least_skirt_other_m / 4;
    } else if (n == 1 || n % 7 == 0) {
      seam.state = verdict::SeamState::covered_by_skirt;
      seam.cracks = 3;
      seam.largest_gap_m = 1.5;
      seam.mean_gap_m = 0.125;
      seam.mean_abs_gap_m = 0.125;
      seam.least_skirt_m = 1.5;
    }
    seam.largest_at = in_file(at);
    out.meshes[seam.mesh].least_skirt_m = std::max(out.meshes[seam.mesh].least_skirt_m, seam.least_skirt_m);
    out.meshes[seam.other_mesh].least_skirt_m =
        std::max(out.meshes[seam.other_mesh].least_skirt_m, seam.least_skirt_other_m);
    out.conformity.crack += seam.cracks;
    out.conformity.t_junction += seam.t_junctions;
    if (seam.state == verdict::SeamState::open) {
      out.sound = false;
      verdict::CheckFinding crack =
          check_finding(oracle::FindingCode::crack, "t_vertex", seam.mesh, at, in_file(at));
      crack.other_mesh = seam.other_mesh;
      crack.finding.gap_m = seam.largest_gap_m;
      crack.finding.vertices = {12, 40};
      crack.message = fmt::format(
          "Sky shows through a gap of {:.3g} m where the border of one tile passes a vertex "
          "of the other.",
          -seam.largest_gap_m);
      out.findings.push_back(std::move(crack));
    }
    out.seams.push_back(seam);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int here = row * columns + column;
      if (column + 1 < columns) add(here, here + 1, {1000.0 * (column + 1), 1000.0 * row + 480, 812.5});
      if (row + 1 < rows) add(here, here + columns, {1000.0 * column + 250, 1000.0 * (row + 1), 640.25});
    }
  verdict::CheckFinding hazard =
      check_finding(oracle::FindingCode::t_junction, "", 0, {300, 400, 500}, in_file({300, 400, 500}));
  hazard.finding.severity = oracle::Severity::hazard;
  hazard.message =
      "A vertex lies inside its neighbour's edge at equal height: a rasteriser shows pixels there.";
  out.findings.push_back(std::move(hazard));
  out.meshes[0].conformity.t_junction = 1;
  ++out.conformity.t_junction;
  out.findings_total = out.findings.size();
  out.notes.emplace_back("layer.json declares 'tms': row 0 is the southernmost.");
  return out;
}

/// A mesh over its DEM, whose maker declared a bound that is true at the samples only, seen from a camera.
inline verdict::CheckVerdict terrain_check() {
  verdict::CheckVerdict out = sound_check();
  out.sound = false;
  out.meshes[0].file = "maps/hill & dale.glb";
  out.meshes[0].format = "glTF";
  out.meshes[0].conformity.hole = 1;
  out.conformity.hole = 1;
  verdict::CheckFinding hole = check_finding(oracle::FindingCode::hole, "", 0, {6, 4, 2}, {500006, 4, 2});
  hole.finding.area_m2 = 4.5;
  hole.finding.visibility = oracle::Visibility::visible;
  hole.finding.loop = {{5, 3}, {8, 3}, {5, 6}};
  out.findings.push_back(hole);
  verdict::CheckFinding declared =
      check_finding(oracle::FindingCode::declared_error, "between_samples", 0, {2, 7, 3}, {500002, 7, 3});
  declared.finding.distance_m = 3.25;
  declared.message = "The mesh lies 3.25 m from its DEM, where 2.5 m were declared.";
  out.findings.push_back(declared);
  out.findings_total = 2;
  verdict::TerrainVerdict terrain;
  terrain.file = "hill.tif";
  terrain.reading = "11 x 11 samples, 1 m apart, rows from the north, cells split by the rising diagonal";
  terrain.placing = "by its own coordinates (guessed)";
  terrain.vertical_m = {3.25, 3, 0.5, 0.25, {2, 7}, {2, 6.5}, 95.5};
  terrain.at = {500002, 7};
  terrain.certain_at = {500002, 6.5};
  terrain.samples_max_m = 2.25;
  terrain.samples_at = {500002, 6};
  terrain.judged_share = 0.955;
  terrain.diagonal_ambiguity_m = 0.75;
  terrain.declared_m = 2.5;
  terrain.declared_certain = terrain.declared_everywhere = false;
  out.terrain = terrain;
  verdict::ImageVerdict image;
  image.camera.position = {500000, -20, 12.5};
  image.camera.width_px = 640;
  image.camera.height_px = 360;
  image.against_terrain = true;
  image.image.displacement_px = pixels(4, 61000);
  image.image.over_threshold = 0.125;
  image.image.uncovered_px = 17;
  image.image.silhouette_pixels = 40;
  image.image.silhouette_max_px = 2.5;
  image.visible_findings = 1;
  image.mesh_px = 61017;
  out.image = image;
  out.notes.emplace_back("y is up, as glTF has it; --up says otherwise.");
  return out;
}

/// An object against a finer one; no plan, so nothing of one.
inline verdict::CheckVerdict object_check() {
  verdict::CheckVerdict out = sound_check();
  verdict::CheckedMesh& mesh = out.meshes[0];
  mesh.file = "bunny.obj";
  mesh.format = "OBJ";
  mesh.terrain = false;
  mesh.domain.clear();
  mesh.triangles = 5000;
  mesh.vertices = 2502;
  mesh.self_intersections_judged = true;
  verdict::ReferenceVerdict reference;
  reference.file = "bunny_full.obj";
  reference.likeness.to_mesh = {0.75, 0.8125};
  reference.likeness.from_mesh = {0.5, 0.5625};
  reference.likeness.normal_max_deg = 31.5;
  reference.likeness.normal_mean_deg = 4.25;
  reference.declared_m = 1;
  out.reference = reference;
  return out;
}

/// A sheet of `cells` × `cells` squares at a place where floats are coarse; the triangles in the middle
/// marked.
inline verdict::CheckSpot check_spot(std::string name, std::size_t finding, int cells = 4) {
  verdict::CheckSpot spot;
  spot.name = std::move(name);
  spot.finding = finding;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x)
      spot.mesh.positions.push_back(
          {4400000.25 + 5 * x, 612345.5 + 5 * y, 812 + 0.125 * ((x * x + 3 * y) % 7)});
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      if (x == cells / 2 && y == cells / 2)
        for (std::uint32_t k = 0; k < 2; ++k)
          spot.marked.push_back(static_cast<std::uint32_t>(spot.mesh.triangles.size()) + k);
      spot.mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      spot.mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return spot;
}

/// A spot for each finding, an error map with a gap, and a camera's pictures if the verdict has a camera.
inline verdict::CheckPictures check_pictures(const verdict::CheckVerdict& check) {
  verdict::CheckPictures out;
  for (std::size_t i = 0; i < check.findings.size() && i < 6; ++i) {
    const std::string kind(oracle::finding_name(check.findings[i].finding.code));
    verdict::CheckSpot spot = check_spot(fmt::format("{:02}-{}", i + 1, kind), i);
    oracle::Finding local = check.findings[i].finding;
    local.triangles = spot.marked;
    local.vertices.clear();
    local.loop.clear();
    local.at = spot.mesh.positions[12];
    spot.picture_svg = oracle::finding_picture({spot.mesh, {}, {&local, 1}, true, {}});
    out.spots.push_back(std::move(spot));
  }
  if (check.terrain) {
    out.error_map_m = Raster(48, 40, 0);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 48; ++x) {
        const double wave = 2 * std::sin(x * 0.21) * std::cos(y * 0.17) + (x == 33 && y == 9 ? -3.25 : 0);
        out.error_map_m.values[static_cast<std::size_t>(y) * 48 + static_cast<std::size_t>(x)] =
            x + y < 9 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(wave);
      }
    out.error_map_box = check.meshes[0].box;
  }
  if (check.image) out.camera = frame_pictures(check.meshes[0].file, 1, 640, 360);
  return out;
}

}  // namespace plumbline::sample
