// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/random.h"

namespace plumbline {
namespace {

constexpr std::array<PlacingName, 8> kNames{{
    {"crs",
     "the DEM's own coordinates: easting and northing in metres, or longitude and latitude in degrees"},
    {"crs_units", "easting and northing in the CRS's own unit, where that is not the metre"},
    {"local", "metres east and north of the south-west sample: plumbline's local frame"},
    {"samples",
     "columns, and rows counted downwards from the north-west sample: as martini and delatin write"},
    {"samples_up", "columns, and rows counted upwards from the south-west sample"},
    {"samples_scaled", "as samples, times the spacing in metres"},
    {"centred", "metres east and north of the middle of the DEM"},
    {"fit", "the mesh's box stretched over the DEM's samples"},
}};

/// A coordinate of a mesh and the anchor are each the result of a handful of roundings, and so is the
/// quotient.
constexpr double kPlacingRounding = 0x1p-50;

double to_sample(double coordinate, double anchor, double sample, double step) {
  const double quotient = (coordinate - anchor) / step;
  const double at = sample + quotient;
  const double nearest = std::nearbyint(at);
  const double rounding =
      kPlacingRounding * ((std::fabs(coordinate) + std::fabs(anchor)) / std::fabs(step) + std::fabs(sample));
  return std::fabs(at - nearest) <= rounding ? nearest : at;
}

Placing make(std::string_view name, std::string words, Vec2 anchor, Vec2 sample, Vec2 step) {
  return {std::string(name), std::move(words), anchor, sample, step};
}

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
};

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// What the guess looks at.
struct Evidence {
  Box box;
  std::vector<Vec3> vertices;  // some
  double twice_plan_area = 0;  // signed: positive where triangles run counter-clockwise in x and y
};

Evidence gather(std::span<const Mesh* const> meshes) {
  Evidence evidence;
  std::size_t count = 0;
  for (const Mesh* mesh : meshes) count += mesh->positions.size();
  const std::vector<std::size_t> chosen = spread_indices(count, kPlacingVertices);
  auto next = chosen.begin();
  std::size_t first = 0;
  for (const Mesh* mesh : meshes) {
    for (const Vec3& p : mesh->positions) {
      if (!finite(p)) continue;
      evidence.box.low = {std::min(evidence.box.low.x, p.x), std::min(evidence.box.low.y, p.y)};
      evidence.box.high = {std::max(evidence.box.high.x, p.x), std::max(evidence.box.high.y, p.y)};
    }
    for (; next != chosen.end() && *next < first + mesh->positions.size(); ++next) {
      const Vec3& p = mesh->positions[*next - first];
      if (finite(p)) evidence.vertices.push_back(p);
    }
    first += mesh->positions.size();
    for (const auto& corners : mesh->triangles) {
      if (std::max({corners[0], corners[1], corners[2]}) >= mesh->positions.size()) continue;
      const Vec3& a = mesh->positions[corners[0]];
      const Vec3& b = mesh->positions[corners[1]];
      const Vec3& c = mesh->positions[corners[2]];
      const double twice_area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      if (std::isfinite(twice_area)) evidence.twice_plan_area += twice_area;
    }
  }
  return evidence;
}

struct Fit {
  double rms_m = std::numeric_limits<double>::infinity();
  std::size_t vertices = 0;
};

Fit fit_of(const Dem& dem, const Placing& placing, const Evidence& evidence) {
  double squares = 0;
  Fit fit;
  for (const Vec3& vertex : evidence.vertices) {
    const Vec3 p = placing.to_samples(vertex);
    const std::optional<double> height = height_where_data_m(dem.samples, dem.has_data, {p.x, p.y});
    if (!height) continue;
    squares += (p.z - *height) * (p.z - *height);
    ++fit.vertices;
  }
  if (fit.vertices > 0) fit.rms_m = std::sqrt(squares / static_cast<double>(fit.vertices));
  return fit;
}

/// How the meshes' box lies to the DEM's: the better the larger.
enum class Lie { stretched, apart, overlaps, inside, same };

struct Candidate {
  Placing placing;
  Lie lie = Lie::apart;
  double common_share = 0;  // intersection over union
};

Candidate weigh(const Dem& dem, const Placing& placing, const Box& box) {
  const Vec3 a = placing.to_samples({box.low.x, box.low.y, 0});
  const Vec3 b = placing.to_samples({box.high.x, box.high.y, 0});
  const Vec2 low{std::min(a.x, b.x), std::min(a.y, b.y)}, high{std::max(a.x, b.x), std::max(a.y, b.y)};
  Candidate candidate{placing};
  const Vec2 east_north = dem.file_high, west_south = dem.file_low;
  const double m = kBoxMarginSamples;
  const auto near = [m](double x, double y) { return std::fabs(x - y) <= m; };
  const double width = std::min(high.x, east_north.x) - std::max(low.x, west_south.x);
  const double depth = std::min(high.y, east_north.y) - std::max(low.y, west_south.y);
  if (width >= 0 && depth >= 0) {
    const double common = width * depth;
    const double all = (high.x - low.x) * (high.y - low.y) +
                       (east_north.x - west_south.x) * (east_north.y - west_south.y) - common;
    candidate.common_share = common / all;
    if (candidate.common_share > 0) candidate.lie = Lie::overlaps;
  }
  if (low.x >= west_south.x - m && low.y >= west_south.y - m && high.x <= east_north.x + m &&
      high.y <= east_north.y + m) {
    candidate.lie = Lie::inside;
  }
  if (near(low.x, west_south.x) && near(low.y, west_south.y) && near(high.x, east_north.x) &&
      near(high.y, east_north.y)) {
    candidate.lie = Lie::same;
  }
  if (placing.name == "fit") candidate.lie = Lie::stretched;
  return candidate;
}

struct Guess {
  Candidate candidate;
  Fit fit;
  bool by_heights = false;  // several placings were possible by the box, and this one fits best
};

Guess guess(const Dem& dem, const std::vector<Placing>& all, const Evidence& evidence) {
  std::vector<Candidate> candidates;
  for (const Placing& placing : all) candidates.push_back(weigh(dem, placing, evidence.box));
  // A sliver of common ground is no reason to lay a mesh there.
  constexpr double kLeastShare = 0.1;
  for (Candidate& c : candidates) {
    if (c.lie == Lie::overlaps && c.common_share < kLeastShare) c.lie = Lie::apart;
  }
  const auto rank = [](const Candidate& c) {  // `stretched` is better than nothing in common
    return c.lie == Lie::apart ? -1 : static_cast<int>(c.lie);
  };
  int best_rank = -2;
  double best_share = 0;
  for (const Candidate& c : candidates) {
    if (rank(c) > best_rank) best_share = 0;
    best_rank = std::max(best_rank, rank(c));
    if (rank(c) == best_rank) best_share = std::max(best_share, c.common_share);
  }
  std::optional<Guess> best;
  bool several = false;
  double least_rms_m = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    // A mesh of unit size lies inside nearly every DEM: `fit` may compete, by heights.
    const bool competes = c.lie == Lie::stretched && best_rank < static_cast<int>(Lie::same);
    if (!competes && (rank(c) != best_rank || (c.lie == Lie::overlaps && c.common_share < best_share)))
      continue;
    const Fit fit = fit_of(dem, c.placing, evidence);
    least_rms_m = std::min(least_rms_m, fit.rms_m);
    if (!best) {
      best = Guess{c, fit};
      continue;
    }
    const Placing& chosen = best->candidate.placing;
    const bool same = c.placing.anchor == chosen.anchor && c.placing.sample == chosen.sample &&
                      c.placing.step == chosen.step;
    several = several || !same;
    constexpr double kDecided = 0.5;
    const bool winding_agrees = !c.placing.mirrors() || evidence.twice_plan_area < 0;
    if (fit.rms_m < kDecided * best->fit.rms_m && winding_agrees) best = Guess{c, fit};
  }
  best->by_heights = several && best->fit.vertices > 0 && best->fit.rms_m <= least_rms_m;
  return *best;
}

std::string names_of(const std::vector<Placing>& all) {
  std::string names;
  for (const Placing& placing : all) names += (names.empty() ? "" : ", ") + placing.name;
  return names;
}

std::string guess_in_words(const Guess& guess, const std::vector<Placing>& all) {
  const Lie lie = guess.candidate.lie;
  std::string reason = lie == Lie::same       ? "its box is the DEM's"
                       : lie == Lie::inside   ? "its box lies inside the DEM's"
                       : lie == Lie::overlaps ? "so it shares most ground with the DEM"
                                              : "no other brings it over the DEM with heights that fit";
  if (guess.by_heights && lie != Lie::stretched) reason += " and its heights fit no worse than otherwise";
  std::string others;
  for (const Placing& placing : all) {
    if (placing.name != guess.candidate.placing.name) others += (others.empty() ? "" : ", ") + placing.name;
  }
  return fmt::format("guessed, since {}; say --placing otherwise ({})", reason, others);
}

void settle(LaidDem& laid, const Fit& fit, const Evidence& evidence, const std::string& why) {
  laid.vertices = fit.vertices;
  laid.rms_m = fit.vertices > 0 ? fit.rms_m : 0;
  const double laid_area = laid.placing.mirrors() ? -evidence.twice_plan_area : evidence.twice_plan_area;
  laid.turned = laid_area < 0;
  laid.words = fmt::format("{}: {}{}", laid.placing.name, laid.placing.words, why);
  if (laid.turned) {
    laid.words += "; laid so its triangles run clockwise seen from above, and were turned over to be judged";
  }
}

}  // namespace

Vec3 Placing::to_samples(Vec3 point) const {
  return {to_sample(point.x, anchor.x, sample.x, step.x), to_sample(point.y, anchor.y, sample.y, step.y),
          point.z};
}

Vec2 Placing::from_samples(Vec2 point) const {
  return {anchor.x + (point.x - sample.x) * step.x, anchor.y + (point.y - sample.y) * step.y};
}

std::span<const PlacingName> placing_names() { return kNames; }

std::vector<Placing> placings(const Dem& dem, Vec2 low, Vec2 high, double unit_m) {
  std::vector<Placing> all;
  const Vec2 north_west{dem.file_low.x, dem.file_high.y};
  const Vec2 metres{dem.metres_x / unit_m, dem.metres_y / unit_m};  // in the mesh's unit
  if (dem.georeferenced) {
    Vec2 origin = dem.origin;
    std::string words = dem.geographic ? "x is the longitude and y the latitude, degrees"
                                       : "x is the easting and y the northing, metres";
    if (dem.geographic) {
      constexpr double kTurn = 360;
      const double middle = dem.to_crs({0.5 * (dem.samples.columns - 1), 0}).x;
      const double turns = std::nearbyint((0.5 * (low.x + high.x) - middle) / kTurn);
      if (std::fabs(turns) == 1) {
        origin.x += turns * kTurn;
        words += ", counted 360 apart from the DEM's";
      }
    }
    all.push_back(make("crs", words, origin, {0, 0}, {dem.step_x, dem.step_y}));
    if (dem.crs_unit_m != 1) {
      all.push_back(
          make("crs_units",
               fmt::format("x is the easting and y the northing, in the CRS's unit of {} m", dem.crs_unit_m),
               dem.origin * (1 / dem.crs_unit_m), {0, 0},
               {dem.step_x / dem.crs_unit_m, dem.step_y / dem.crs_unit_m}));
    }
  }
  if (!dem.geographic) {
    all.push_back(
        make("local", "x and y are metres east and north of the south-west sample", {0, 0}, {0, 0}, metres));
  }
  if (!dem.resampled) {
    all.push_back(make("samples",
                       "x is the column and y the row, counted downwards from the north-west sample", {0, 0},
                       north_west, {1, -1}));
    all.push_back(make("samples_up",
                       "x is the column and y the row, counted upwards from the south-west sample", {0, 0},
                       dem.file_low, {1, 1}));
  }
  if (!dem.geographic) {
    all.push_back(make("samples_scaled", "x and y are metres east and south of the north-west sample", {0, 0},
                       north_west, {metres.x, -metres.y}));
    all.push_back(make("centred", "x and y are metres east and north of the middle", {0, 0},
                       (dem.file_low + dem.file_high) * 0.5, metres));
  }
  if (!dem.resampled && high.x > low.x && high.y > low.y) {
    const Vec2 last{static_cast<double>(dem.samples.columns - 1), static_cast<double>(dem.samples.rows - 1)};
    all.push_back(make("fit", "its box in plan is stretched over the DEM's samples", low, {0, 0},
                       {(high.x - low.x) / last.x, (high.y - low.y) / last.y}));
  }
  return all;
}

LaidDem lay_over_dem(const DemRequest& request, std::string_view name, std::span<const Mesh* const> meshes,
                     double unit_m) {
  const Evidence evidence = gather(meshes);
  if (evidence.box.empty()) throw InputError("no mesh has a finite vertex to lay over the DEM; give one");
  const Vec2 low = evidence.box.low, high = evidence.box.high;
  LaidDem laid;
  laid.dem = read_dem(request);
  const bool metric_wanted =
      laid.dem.geographic && (name == "local" || name == "centred" || name == "samples_scaled");
  if (metric_wanted) laid.dem = resampled_dem(request);
  std::vector<Placing> all = placings(laid.dem, low, high, unit_m);
  if (name != "guess") {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Placing& placing) { return placing.name == name; });
    const bool known = std::any_of(kNames.begin(), kNames.end(),
                                   [&](const PlacingName& known_name) { return known_name.name == name; });
    if (found == all.end()) {
      throw InputError(fmt::format("--placing {}: {}; say guess or one of {}", one_line(name, 40),
                                   known ? "this DEM and mesh have none" : "there is no such placing",
                                   names_of(all)));
    }
    laid.placing = *found;
    settle(laid, fit_of(laid.dem, laid.placing, evidence), evidence, ", as said");
    return laid;
  }
  laid.guessed = true;
  Guess best = guess(laid.dem, all, evidence);
  if (laid.dem.geographic && best.candidate.lie < Lie::inside) {
    // Metres over a graticule: only the local frame could explain them.
    try {
      Dem metric = resampled_dem(request);
      const std::vector<Placing> in_metres = placings(metric, low, high, unit_m);
      const Guess other = guess(metric, in_metres, evidence);
      if (other.candidate.lie >= Lie::inside) {
        laid.dem = std::move(metric);
        best = other;
        all = in_metres;
      }
    } catch (const InputError&) {
      // Too large for a local frame: then no mesh is in it.
    }
  }
  laid.placing = best.candidate.placing;
  settle(laid, best.fit, evidence, ", " + guess_in_words(best, all));
  return laid;
}

Mesh laid_over(const Mesh& mesh, const Placing& placing, bool turned) {
  Mesh laid = mesh;
  for (Vec3& p : laid.positions) p = placing.to_samples(p);
  if (turned) {
    for (auto& corners : laid.triangles) std::swap(corners[1], corners[2]);
  }
  return laid;
}

std::vector<std::size_t> spread_indices(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  chosen.reserve(std::min(count, most));
  if (count <= most) {
    for (std::size_t k = 0; k < count; ++k) chosen.push_back(k);
    return chosen;
  }
  Random random(0, "spread");
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t from = k * count / most, to = (k + 1) * count / most;
    chosen.push_back(from + static_cast<std::size_t>(random.below(to - from)));
  }
  return chosen;
}

}  // namespace plumbline
