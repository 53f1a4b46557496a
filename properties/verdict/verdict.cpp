// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/verdict/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::verdict {
namespace {

/// Whether `value` is the worse of two maxima: larger, or not a number where the other is one.
bool worse(double value, double than) { return value > than || (std::isnan(value) && !std::isnan(than)); }
void raise(double& maximum, double value) {
  if (worse(value, maximum)) maximum = value;
}

void add(oracle::ConformityCounts& sum, const oracle::ConformityCounts& counts) {
  sum.crack += counts.crack;
  sum.t_junction += counts.t_junction;
  sum.fold_over += counts.fold_over;
  sum.degenerate += counts.degenerate;
  sum.hole += counts.hole;
  sum.overlap += counts.overlap;
  sum.outline += counts.outline;
  sum.non_manifold += counts.non_manifold;
  sum.duplicate += counts.duplicate;
  sum.non_finite += counts.non_finite;
  sum.bad_index += counts.bad_index;
  sum.unused_vertex += counts.unused_vertex;
}

void add(CounterFigures& sum, const CounterFigures& counters) {
  sum.visited += counters.visited;
  sum.evaluated += counters.evaluated;
  sum.split += counters.split;
  sum.merged += counters.merged;
  sum.entered += counters.entered;
  sum.left += counters.left;
  sum.nodes = std::max(sum.nodes, counters.nodes);
  sum.drawn += counters.drawn;
  sum.tiles += counters.tiles;
}

/// Mean and root mean square of frames, each weighted by how much was judged in it.
class Pool {
 public:
  void add(double mean, double rms, double weight) {
    if (weight == 0) return;
    weight_ += weight;
    sum_ += mean * weight;
    squares_ += rms * rms * weight;
  }
  [[nodiscard]] double mean() const { return weight_ == 0 ? 0 : sum_ / weight_; }
  [[nodiscard]] double rms() const { return weight_ == 0 ? 0 : std::sqrt(squares_ / weight_); }

 private:
  double weight_ = 0, sum_ = 0, squares_ = 0;
};

/// Pools one per-pixel figure of all frames.
class PixelPool {
 public:
  void add(const oracle::PixelFigure& figure) {
    if (figure.count == 0) return;
    raise(worst_.max, figure.max);
    raise(worst_.p999, figure.p999);
    raise(worst_.p99, figure.p99);
    worst_.count += figure.count;
    pool_.add(figure.mean, figure.rms, static_cast<double>(figure.count));
  }
  [[nodiscard]] oracle::PixelFigure figure() const {
    oracle::PixelFigure all = worst_;
    all.mean = pool_.mean();
    all.rms = pool_.rms();
    return all;
  }

 private:
  oracle::PixelFigure worst_;
  Pool pool_;
};

void summarize_image(const std::vector<FrameVerdict>& frames, RunSummary& all) {
  PixelPool displacement, parallax, depth, pop;
  Pool over_threshold;
  double worst_p99 = -1;
  for (const FrameVerdict& frame : frames) {
    const oracle::ImageError& image = frame.image;
    displacement.add(image.displacement_px);
    parallax.add(image.parallax_px);
    depth.add(image.depth_rel);
    pop.add(frame.pop_px);
    over_threshold.add(image.over_threshold, 0, static_cast<double>(image.displacement_px.count));
    all.image.uncovered_px += image.uncovered_px;
    all.image.silhouette_pixels += image.silhouette_pixels;
    raise(all.image.silhouette_max_px, image.silhouette_max_px);
    const bool mesh = frame.subject == Subject::mesh;
    const bool any =
        mesh ? image.depth_rel.count + image.silhouette_pixels > 0 : image.displacement_px.count > 0;
    const double error_px = mesh ? image.silhouette_max_px : image.displacement_px.p99;
    if (any && worse(error_px, worst_p99)) {
      worst_p99 = error_px;
      all.worst_frame = frame.index;
    }
  }
  all.image.displacement_px = displacement.figure();
  all.image.parallax_px = parallax.figure();
  all.image.depth_rel = depth.figure();
  all.image.over_threshold = over_threshold.mean();
  all.pop_px = pop.figure();
}

void summarize_vertical(const std::vector<FrameVerdict>& frames, oracle::VerticalError& all) {
  Pool pool;
  for (const FrameVerdict& frame : frames) {
    const oracle::VerticalError& vertical = frame.vertical_m;
    if (vertical.area_m2 == 0) continue;
    if (all.area_m2 == 0 || worse(vertical.max, all.max)) {
      all.max = vertical.max;
      all.at = vertical.at;
    }
    if (all.area_m2 == 0 || worse(vertical.certain_max, all.certain_max)) {
      all.certain_max = vertical.certain_max;
      all.certain_at = vertical.certain_at;
    }
    if (all.area_m2 == 0 || worse(vertical.samples_max, all.samples_max)) {
      all.samples_max = vertical.samples_max;
      all.samples_at = vertical.samples_at;
    }
    all.area_m2 += vertical.area_m2;
    pool.add(vertical.mean, vertical.rms, vertical.area_m2);
  }
  all.mean = pool.mean();
  all.rms = pool.rms();
}

void summarize_shape(const std::vector<FrameVerdict>& frames, oracle::ShapeReport& all) {
  Pool quality, valence;
  double triangles = 0, fans = 0;
  for (const FrameVerdict& frame : frames) {
    if (frame.triangles == 0) continue;
    const oracle::ShapeReport& shape = frame.shape;
    const auto weight = static_cast<double>(frame.triangles);
    all.min_quality = triangles == 0 ? shape.min_quality : std::min(all.min_quality, shape.min_quality);
    all.least_angle_deg =
        triangles == 0 ? shape.least_angle_deg : std::min(all.least_angle_deg, shape.least_angle_deg);
    all.slivers += shape.slivers;
    all.max_valence = std::max(all.max_valence, shape.max_valence);
    quality.add(shape.mean_quality, 0, weight);
    valence.add(shape.mean_valence, 0, static_cast<double>(frame.vertices));
    triangles += weight;
    if (shape.mean_fan_length > 0) fans += weight / shape.mean_fan_length;
  }
  all.mean_quality = quality.mean();
  all.mean_valence = valence.mean();
  all.mean_fan_length = fans == 0 ? 0 : triangles / fans;
}

void summarize_stability(const std::vector<FrameVerdict>& frames, StabilitySummary& all) {
  oracle::RecoveryWatch recovery, lag;
  for (const FrameVerdict& frame : frames) {
    const StabilityFigures& stability = frame.stability;
    recovery.next(stability.cut, stability.under_threshold);
    lag.next(stability.cut, stability.settled);
    all.toggles += stability.toggles;
    all.jitter_vertices = std::max(all.jitter_vertices, stability.jitter_vertices);
    raise(all.jitter_px, stability.jitter_px);
    raise(all.path_share, stability.path_share);
    raise(all.path_px, stability.path_px);
    all.revisits += stability.revisit ? 1 : 0;
    raise(all.revisit_share, stability.revisit_share);
  }
  all.cuts = recovery.cuts();
  all.recovery_frames = recovery.most_frames();
  all.unrecovered = recovery.unrecovered();
  all.lag_frames = lag.most_frames();
  all.unsettled = lag.unrecovered();
}

void summarize_economy(const std::vector<FrameVerdict>& frames, EconomySummary& all) {
  for (const FrameVerdict& frame : frames) {
    const EconomyFigures& economy = frame.economy;
    if (economy.slack_judged) {
      ++all.slack_frames;
      all.slack.vertices += economy.slack.vertices;
      all.slack.removable += economy.slack.removable;
      all.slack.in_view += economy.slack.in_view;
      all.slack.removable_in_view += economy.slack.removable_in_view;
      all.slack.not_judged += economy.slack.not_judged;
    }
    if (economy.needed > 0) {
      ++all.excess_frames;
      all.drawn += static_cast<double>(frame.triangles);
      all.needed += economy.needed;
    }
  }
}

void summarize_space(const std::vector<FrameVerdict>& frames, SpaceSummary& all) {
  for (const FrameVerdict& frame : frames) {
    const SpaceFigures& space = frame.space;
    if (space.area_judged) {
      ++all.area_frames;
      raise(all.projected_area, std::fabs(space.projected_area));
    }
    if (!space.judged) continue;
    ++all.frames;
    raise(all.hausdorff_m.least_m, space.likeness.hausdorff().least_m);
    raise(all.hausdorff_m.most_m, space.likeness.hausdorff().most_m);
    raise(all.normal_max_deg, space.likeness.normal_max_deg);
    raise(all.normal_mean_deg, space.likeness.normal_mean_deg);
    raise(all.turned_share, space.likeness.turned_share);
    all.self_intersections += space.self_intersections;
  }
}

/// A figure of no frame is no number, so that no gate can pass over it.
double or_nan(bool any, double value) { return any ? value : std::numeric_limits<double>::quiet_NaN(); }

template <auto Count>
double conformity(const RunSummary& summary) {
  return static_cast<double>(summary.conformity.*Count);
}
template <auto Member>
double vertical(const RunSummary& summary) {
  return summary.vertical_m.*Member;
}
template <auto Member>
double displacement(const RunSummary& summary) {
  return summary.image.displacement_px.*Member;
}

template <auto Member>
double parallax(const RunSummary& summary) {
  return summary.image.parallax_px.*Member;
}
template <auto Member>
double stability(const RunSummary& summary) {
  return static_cast<double>(summary.stability.*Member);
}

using Counts = oracle::ConformityCounts;
using Stability = StabilitySummary;
using Vertical = oracle::VerticalError;
using Pixels = oracle::PixelFigure;

constexpr Figure kFigures[] = {
    {"triangles", "count", [](const RunSummary& s) { return s.triangles; }},
    {"triangles_max", "count", [](const RunSummary& s) { return static_cast<double>(s.triangles_max); }},
    {"crack", "count", conformity<&Counts::crack>},
    {"t_junction", "count", conformity<&Counts::t_junction>},
    {"fold_over", "count", conformity<&Counts::fold_over>},
    {"degenerate", "count", conformity<&Counts::degenerate>},
    {"hole", "count", conformity<&Counts::hole>},
    {"overlap", "count", conformity<&Counts::overlap>},
    {"outline", "count", conformity<&Counts::outline>},
    {"non_manifold", "count", conformity<&Counts::non_manifold>},
    {"duplicate", "count", conformity<&Counts::duplicate>},
    {"non_finite", "count", conformity<&Counts::non_finite>},
    {"bad_index", "count", conformity<&Counts::bad_index>},
    {"unused_vertex", "count", conformity<&Counts::unused_vertex>},
    {"visible_cracks", "count", [](const RunSummary& s) { return static_cast<double>(s.visible_cracks); }},
    {"largest_gap_m", "m", [](const RunSummary& s) { return s.largest_gap_m; }},
    {"largest_gap_px", "px", [](const RunSummary& s) { return s.largest_gap_px; }},
    {"nothing_judged", "frames", [](const RunSummary& s) { return static_cast<double>(s.nothing_judged); }},
    {"vertical_m.max", "m", vertical<&Vertical::max>},
    {"vertical_m.certain_max", "m", vertical<&Vertical::certain_max>},
    {"vertical_m.rms", "m", vertical<&Vertical::rms>},
    {"vertical_m.mean", "m", vertical<&Vertical::mean>},
    {"displacement_px.max", "px", displacement<&Pixels::max>},
    {"displacement_px.p999", "px", displacement<&Pixels::p999>},
    {"displacement_px.p99", "px", displacement<&Pixels::p99>},
    {"displacement_px.rms", "px", displacement<&Pixels::rms>},
    {"displacement_px.mean", "px", displacement<&Pixels::mean>},
    {"displacement_px.over_threshold", "share", [](const RunSummary& s) { return s.image.over_threshold; }},
    {"displacement_px.uncovered_px", "px",
     [](const RunSummary& s) { return static_cast<double>(s.image.uncovered_px); }},
    {"parallax_px.max", "px", parallax<&Pixels::max>},
    {"parallax_px.p999", "px", parallax<&Pixels::p999>},
    {"parallax_px.p99", "px", parallax<&Pixels::p99>},
    {"parallax_px.rms", "px", parallax<&Pixels::rms>},
    {"parallax_px.mean", "px", parallax<&Pixels::mean>},
    {"depth_rel.max", "ratio", [](const RunSummary& s) { return s.image.depth_rel.max; }},
    {"depth_rel.p99", "ratio", [](const RunSummary& s) { return s.image.depth_rel.p99; }},
    {"silhouette_px.pixels", "px",
     [](const RunSummary& s) { return static_cast<double>(s.image.silhouette_pixels); }},
    {"silhouette_px.max", "px", [](const RunSummary& s) { return s.image.silhouette_max_px; }},
    {"pop_px.max", "px", [](const RunSummary& s) { return s.pop_px.max; }},
    {"pop_px.p99", "px", [](const RunSummary& s) { return s.pop_px.p99; }},
    {"stability.cuts", "count", stability<&Stability::cuts>},
    {"stability.recovery_frames", "frames", stability<&Stability::recovery_frames>},
    {"stability.unrecovered", "count", stability<&Stability::unrecovered>},
    {"stability.lag_frames", "frames", stability<&Stability::lag_frames>},
    {"stability.unsettled", "count", stability<&Stability::unsettled>},
    {"stability.toggles", "count", stability<&Stability::toggles>},
    {"stability.jitter_vertices", "count", stability<&Stability::jitter_vertices>},
    {"stability.jitter_px", "px", stability<&Stability::jitter_px>},
    {"stability.path_share", "share", stability<&Stability::path_share>},
    {"stability.path_px", "px", stability<&Stability::path_px>},
    {"stability.revisit_share", "share", stability<&Stability::revisit_share>},
    {"economy.excess", "ratio",
     [](const RunSummary& s) {
       return or_nan(s.economy.excess_frames > 0, s.economy.drawn / s.economy.needed);
     }},
    {"economy.slack", "share",
     [](const RunSummary& s) { return or_nan(s.economy.slack_frames > 0, s.economy.slack.share()); }},
    {"economy.slack_in_view", "share",
     [](const RunSummary& s) { return or_nan(s.economy.slack_frames > 0, s.economy.slack.share_in_view()); }},
    {"self_intersection", "count",
     [](const RunSummary& s) {
       return or_nan(s.space.frames > 0, static_cast<double>(s.space.self_intersections));
     }},
    {"hausdorff_m.least", "m",
     [](const RunSummary& s) { return or_nan(s.space.frames > 0, s.space.hausdorff_m.least_m); }},
    {"hausdorff_m.most", "m",
     [](const RunSummary& s) { return or_nan(s.space.frames > 0, s.space.hausdorff_m.most_m); }},
    {"normal_deg.max", "degrees",
     [](const RunSummary& s) { return or_nan(s.space.frames > 0, s.space.normal_max_deg); }},
    {"normal_deg.mean", "degrees",
     [](const RunSummary& s) { return or_nan(s.space.frames > 0, s.space.normal_mean_deg); }},
    {"normal_deg.turned_share", "share",
     [](const RunSummary& s) { return or_nan(s.space.frames > 0, s.space.turned_share); }},
    {"projected_area", "share",
     [](const RunSummary& s) { return or_nan(s.space.area_frames > 0, s.space.projected_area); }},
    {"shape.slivers", "count", [](const RunSummary& s) { return static_cast<double>(s.shape.slivers); }},
    {"shape.min_quality", "quality", [](const RunSummary& s) { return s.shape.min_quality; }},
};

}  // namespace

RunSummary summarize(const std::vector<FrameVerdict>& frames) {
  RunSummary all;
  all.frames = frames.size();
  if (frames.empty()) return all;
  all.subject = frames.front().subject;
  all.worst_frame = frames.front().index;
  all.triangles_min = frames.front().triangles;
  double triangles = 0, vertices = 0;
  for (const FrameVerdict& frame : frames) {
    triangles += static_cast<double>(frame.triangles);
    vertices += static_cast<double>(frame.vertices);
    all.triangles_min = std::min(all.triangles_min, frame.triangles);
    all.triangles_max = std::max(all.triangles_max, frame.triangles);
    add(all.conformity, frame.conformity);
    all.visible_cracks += frame.visible_cracks;
    raise(all.largest_gap_m, frame.largest_gap_m);
    raise(all.largest_gap_px, frame.largest_gap_px);
    all.nothing_judged += frame.nothing_judged;
    add(all.counters, frame.counters);
  }
  all.triangles = triangles / static_cast<double>(frames.size());
  all.vertices = vertices / static_cast<double>(frames.size());
  summarize_image(frames, all);
  summarize_vertical(frames, all.vertical_m);
  summarize_shape(frames, all.shape);
  summarize_stability(frames, all.stability);
  summarize_economy(frames, all.economy);
  summarize_space(frames, all.space);
  return all;
}

std::span<const Figure> figures() { return kFigures; }

bool was_asked(Subject subject, std::string_view path) {
  const bool in_space = path == "self_intersection" || path == "projected_area" ||
                        path.starts_with("hausdorff_m.") || path.starts_with("normal_deg.");
  if (subject == Subject::terrain) return !in_space;
  constexpr std::array<std::string_view, 9> kInPlan{"crack",          "t_junction",    "fold_over",
                                                    "hole",           "overlap",       "outline",
                                                    "visible_cracks", "largest_gap_m", "largest_gap_px"};
  return std::ranges::find(kInPlan, path) == kInPlan.end() && !path.starts_with("vertical_m.") &&
         !path.starts_with("displacement_px.") && !path.starts_with("economy.") &&
         !path.starts_with("shape.");
}

double figure_value(const RunSummary& summary, std::string_view path) {
  const auto found = std::ranges::find(kFigures, path, &Figure::path);
  if (found != std::end(kFigures)) {
    return was_asked(summary.subject, path) ? found->value(summary)
                                            : std::numeric_limits<double>::quiet_NaN();
  }
  std::string known;
  for (const Figure& figure : kFigures) known += fmt::format("{}{}", known.empty() ? "" : ", ", figure.path);
  throw InputError(fmt::format("there is no figure \"{}\"; the figures are {}", path, known));
}

bool SuiteVerdict::pass() const {
  return !interrupted && vacuous.empty() && !runs.empty() && (selftest.kinds.empty() || selftest.perfect()) &&
         std::ranges::all_of(gates, [](const GateVerdict& gate) { return gate.pass; });
}

}  // namespace plumbline::verdict
