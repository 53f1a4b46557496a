// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "properties/verdict/verdict.h"

/// Made-up verdicts of plausible size: what reports are developed and tested on. No method was flown for
/// them.
namespace plumbline::sample {

/// How a made-up method behaves: triangles per 1/τ, error per τ, T-vertices per frame.
struct Behaviour {
  std::string id;
  std::vector<double> thresholds_px;
  double triangles, error, update_ms;
  int t_vertices;
};

inline const std::vector<Behaviour>& behaviours() {
  static const std::vector<Behaviour> all{
      {"full", {1}, 524288, 0, 0.02, 0},
      {"restricted_quadtree", {1, 2, 4}, 42000, 0.71, 3.1, 0},
      {"block_bintree", {1, 2, 4}, 30500, 0.83, 0.9, 3},
  };
  return all;
}

/// Runs from 0.75 to 1.25 along a trajectory, differently for each seed.
inline double wave(int frame, int frames, int seed) {
  return 1 + 0.25 * std::sin(6.283 * frame / frames * (1 + seed % 3) + seed);
}

inline oracle::PixelFigure pixels(double p99, std::size_t count) {
  return {p99 * 1.9, p99 * 1.4, p99, p99 * 0.4, p99 * 0.28, count};
}

inline oracle::Finding t_vertex(Vec3 at, double gap_m, double gap_px, oracle::Visibility visibility) {
  oracle::Finding finding;
  finding.code = oracle::FindingCode::crack;
  finding.kind = "t_vertex";
  finding.at = at;
  finding.gap_m = gap_m;
  finding.gap_px = gap_px;
  finding.vertices = {412, 977, 1033};
  finding.triangles = {2051};
  finding.visibility = visibility;
  return finding;
}

inline verdict::FrameVerdict frame(const Behaviour& behaviour, double threshold_px, int index, int frames,
                                   int seed) {
  verdict::FrameVerdict out;
  const double swing = wave(index, frames, seed);
  const double error = behaviour.error * threshold_px * swing;
  out.index = index;
  out.camera.position = {900.0 + 35.5 * index, 1200 - 12.25 * index, 640 + 80 * swing};
  out.triangles = behaviour.error == 0 ? static_cast<std::size_t>(behaviour.triangles)
                                       : static_cast<std::size_t>(behaviour.triangles / threshold_px * swing);
  out.vertices = out.triangles / 2 + 3;
  out.vertical_m = {error * 1.7, error * 1.2, error * 0.3, error * 0.2, {812.5, 640}, {800, 632.25}, 9.2e7};
  out.image.displacement_px = pixels(error, 611000);
  out.image.depth_rel = pixels(error * 1e-3, 611000);
  out.image.over_threshold = error > threshold_px ? 0.013 * swing : 0;
  out.image.silhouette_pixels = static_cast<std::size_t>(error * 40);
  out.image.silhouette_max_px = error * 1.1;
  if (index > 0) out.pop_px = pixels(error * 0.8, 611000);
  out.shape = {0.31, 0.82, 18.4, 0, 8, 5.98, 0, 3.2};
  out.counters = {out.triangles * 2, out.triangles, 140, 133, 210, 190};
  const int t_vertices = static_cast<int>(behaviour.t_vertices * (swing > 1.05 ? threshold_px : 0));
  out.conformity.crack = static_cast<std::size_t>(t_vertices);
  out.conformity.t_junction = static_cast<std::size_t>(t_vertices + behaviour.t_vertices);
  out.visible_cracks = static_cast<std::size_t>(t_vertices / 3);
  for (int k = 0; k < std::min(t_vertices, 3); ++k)
    out.findings.push_back(t_vertex({1312.5 + 90 * k, 2205.0 - 7 * index, 381.25}, (k - 1.5) * swing,
                                    0.9 * k * swing,
                                    k == 0 ? oracle::Visibility::occluded : oracle::Visibility::visible));
  if (!out.findings.empty()) {
    out.largest_gap_m = 1.5 * swing;
    out.largest_gap_px = 0.9 * static_cast<double>(out.findings.size() - 1) * swing;
  }
  return out;
}

struct SampleSize {
  std::vector<std::string> terrains{"jacksboro", "canyon"};
  std::vector<std::string> trajectories{"approach", "orbit", "skim", "teleport"};
  int frames = 40;
};

inline void add_gates(verdict::SuiteVerdict& suite, const verdict::RunVerdict& run) {
  const double crack = verdict::figure_value(run.summary, "crack");
  const double p99 = verdict::figure_value(run.summary, "displacement_px.p99");
  suite.gates.push_back({"crack == 0", run.id, "== 0", crack, crack == 0});
  suite.gates.push_back({"displacement_px.p99 <= 1 tau", run.id,
                         fmt::format("<= 1 tau ({} px)", run.threshold_px), p99, p99 <= run.threshold_px});
}

inline verdict::SuiteVerdict suite_verdict(const SampleSize& size = {}) {
  verdict::SuiteVerdict out;
  out.suite = "default";
  out.width_px = 1280;
  out.height_px = 720;
  out.fov_y_deg = 60;
  for (const std::string& terrain : size.terrains)
    out.terrains.push_back({terrain, 513, 513, 90.5, 246, 1077.5, 3.25});
  int seed = 0;
  for (const std::string& terrain : size.terrains)
    for (const std::string& trajectory : size.trajectories) {
      ++seed;
      for (const Behaviour& behaviour : behaviours())
        for (const double threshold_px : behaviour.thresholds_px) {
          verdict::RunVerdict run;
          run.id = fmt::format("{}.{}.{}.{}", terrain, trajectory, behaviour.id, threshold_px);
          run.terrain = terrain;
          run.trajectory = trajectory;
          run.method = behaviour.id;
          run.threshold_px = threshold_px;
          for (int f = 0; f < size.frames; ++f)
            run.frames.push_back(frame(behaviour, threshold_px, f, size.frames, seed));
          run.summary = verdict::summarize(run.frames);
          add_gates(out, run);
          out.runs.push_back(std::move(run));
        }
    }
  return out;
}

inline verdict::SuiteTiming suite_timing(const verdict::SuiteVerdict& suite) {
  verdict::SuiteTiming out{"x86-64, 2 cores", "gcc 12.2", "Release", 2, 61.25, {}};
  for (const verdict::RunVerdict& run : suite.runs) {
    verdict::RunTiming timing{run.id, 0.41, {}, 2.2};
    for (const Behaviour& behaviour : behaviours())
      if (behaviour.id == run.method)
        for (const verdict::FrameVerdict& one : run.frames)
          timing.update_ms.push_back(behaviour.update_ms * wave(one.index, 40, 7) /
                                     std::sqrt(run.threshold_px));
    out.runs.push_back(std::move(timing));
  }
  return out;
}

/// Rolling ground below a sky, with a mesh's lines, and a displacement that grows to the horizon and beyond 2
/// τ.
inline verdict::FramePictures frame_pictures(const std::string& run, double threshold_px, int width,
                                             int height) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  verdict::FramePictures out{run,
                             12,
                             threshold_px,
                             Raster(width, height, nan),
                             Raster(width, height, nan),
                             Raster(width, height, nan)};
  for (int x = 0; x < width; ++x) {
    const double horizon =
        height * (0.3 + 0.06 * std::sin(x * 9.0 / width) + 0.03 * std::sin(x * 31.0 / width));
    for (int y = static_cast<int>(horizon); y < height; ++y) {
      const double near = (y - horizon + 1) / (height - horizon);
      const double u = (x - 0.5 * width) / width / near, v = 1 / near;
      const double shade = 0.55 + 0.25 * std::sin(u * 5 + v) + 0.15 * std::sin(v * 7 - u * 3);
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const bool line =
          std::fabs(u * 4 - std::round(u * 4)) < 0.02 * v || std::fabs(v * 3 - std::round(v * 3)) < 0.01 * v;
      out.reference.values[i] = static_cast<float>(shade);
      out.shaded.values[i] = static_cast<float>(line ? shade * 0.4 : shade);
      out.displacement_px.values[i] =
          static_cast<float>(threshold_px * (0.5 + 0.5 * std::sin(u * 12) * std::sin(v * 12)) *
                             (0.2 + 2.4 * (1 - near) * (1 - near)));
    }
  }
  return out;
}

}  // namespace plumbline::sample
