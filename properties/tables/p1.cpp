// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// P1 (TABLES). Yu, Zuo & Li, section 4: the tolerances of Table 1, and Table 2's triangles before and after
// on four sets of regular points. Not said there, and decided here: the terrain, where the viewer stands,
// which of Table 1's two columns Table 2 used, how long a step is.
#include "properties/tables/p1.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "oracle/conformity.h"
#include "oracle/shape.h"
#include "properties/tables/search.h"

namespace plumbline::tables {
namespace {

/// The fit ends this near to the published count, relative: ten triangles.
constexpr double kCountTolerance = 1e-3;
/// Steps that are flown, metres, and how often.
struct Steps {
  double step_m;
  int frames;
  const char* name;
};
constexpr Steps kSteps[] = {{1, 20, "vertices reset in a step of 1 m"},
                            {10, 20, "vertices reset in a step of 10 m"},
                            {100, 5, "vertices reset in a step of 100 m"}};

constexpr const char* kFull = "triangles before";
constexpr const char* kAfter = "triangles after";
constexpr const char* kRemain = "share that remains";
constexpr const char* kDelta = "greatest δ in use";
constexpr const char* kScreen = "greatest screen error";
constexpr const char* kFolds = "fold-overs and degenerate triangles";
constexpr const char* kSlivers = "slivers";
constexpr const char* kSliversDeep = "slivers at depth 10";
constexpr const char* kRefused = "refused by depth, of the qualifying";
constexpr const char* kRefusedAll = "refused by depth, of all edges";

struct Printed {
  const char *full, *after, *delta;
};
constexpr Printed kPrinted[] = {{"19 705", "9 523", "1.0"},
                                {"27 848", "12 704", "1.3"},
                                {"53 161", "26 307", "1.5"},
                                {"132 849", "60 231", "1.5"}};

std::string row_of(std::size_t k) {
  return k < std::size(kPrinted) ? kPrinted[k].full : fmt::format("set {}", k + 1);
}

/// Table 1, both columns: the printed tolerances of levels 1 to 4.
struct PrintedLevel {
  const char *by_pixel, *equal;
};
constexpr PrintedLevel kPrintedLevels[] = {
    {"0.46", "0.46"}, {"1.17", "0.98"}, {"2.54", "1.95"}, {"5.86", "3.91"}};

ring_tin::Rings equal_rings() {
  ring_tin::Rings rings;
  rings.delta_px = {0, 1, 1, 1, 1};
  return rings;
}

tin::Tin scaled(tin::Tin network, double factor) {
  for (Vec3& p : network.mesh.positions) p.z *= factor;
  return network;
}

Camera viewer(Vec2 p) { return make_camera({p.x, p.y, 0}, {p.x, p.y + 1, 0}, 60, 1280, 720); }

double percent_of(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

/// The simplified set, seen from its middle.
struct Simplified {
  ring_tin::RingTin method;
  LodFrame frame;
  Simplified(const ring_tin::Settings& settings, const TrimmedTin& set, double relief) : method(settings) {
    method.prepare_tin(scaled(set.tin, relief), set.domain);
    method.update(viewer(set.middle), frame);
  }
};

/// Equation (1) with the distance by which the rings are made: the greatest f·|deviation|/d over the vertices
/// that are not drawn, pixels.
double screen_error_px(const Simplified& simplified, Vec2 viewpoint, const oracle::RayDevice& device) {
  const oracle::RaySurface surface(device, simplified.frame.mesh);
  const std::vector<Vec3>& points = simplified.method.full_tin().mesh.positions;
  double greatest = 0;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (simplified.method.collapses().is_live(v)) continue;
    const std::optional<double> height_m = surface.height_at({points[v].x, points[v].y});
    const double distance_m =
        std::max(std::abs(points[v].x - viewpoint.x), std::abs(points[v].y - viewpoint.y));
    if (height_m) greatest = std::max(greatest, std::abs(*height_m - points[v].z) * kP1FocalPx / distance_m);
  }
  return greatest;
}

double slivers(const LodFrame& frame) { return static_cast<double>(oracle::shape(frame.mesh).slivers); }

}  // namespace

const std::vector<P1View>& p1_views() {
  static const std::vector<P1View> views{{"published, depth 6", ring_tin::Variant::published, 6},
                                         {"published, depth 4", ring_tin::Variant::published, 4},
                                         {"guarded, depth 6", ring_tin::Variant::guarded, 6}};
  return views;
}

Table p1_table(const P1Settings& settings) {
  Table table;
  table.id = "P1";
  table.title = "TIN in nested rings: tolerances, and triangles that remain of four sets of regular points";
  table.source =
      "Yu, Zuo & Li, A view-dependent dynamic multi-resolution terrain model of TIN, section 4, tables 1 and "
      "2";
  table.protocol = {
      "Table 1 is recomputed: δ·D/f with the ring's outer distance D and f = 512 px.",
      "Table 2: regular points 10 m apart, so many points of the outline left out, evenly, that the Delaunay "
      "triangulation has exactly the published count. The viewer stands in the middle; δ by pixel. The paper "
      "names depth caps from 4 to 6.",
      "Fitted: the factor on the stand-in's heights at which the first set has the published count. The "
      "other "
      "sets take the same factor: predictions.",
      "A stand-in gives the shape of the relief alone: its samples are taken as 10 m apart.",
      "Screen error: equation (1), f·|deviation|/d, of the vertices that are left out, d as the rings "
      "measure it. "
      "The paper's column is what its δ allow, and no measurement.",
      "Vertices reset: of all, per step, the viewer walking north through the middle. The paper says 8 % at "
      "5 "
      "levels and not for what step. Slivers: quality below 0.05 in plan.",
  };
  table.notes = {
      "Table 1 prints 0.46 at level 1, in both columns: 250·1.0/512 is 0.488, so 0.49 is meant.",
      "The text says that d is a ring's mean distance; Table 1 is computed with the outer one.",
      "1.3 px in the second row is no misprint: seen from the middle, 590 m reach ring 3 only. 1.0 px in the "
      "first fits the column of equal δ, or a set that ends inside of 250 m; 1.5 px in the third fits a "
      "viewer "
      "who stands more than 1 km from an end of it.",
      "Frames a second are not compared: they are those of the machine that drew.",
  };
  const auto add = [&](const std::string& row, const char* name, const char* unit, int decimals, Kind kind,
                       const char* printed, std::optional<double> recomputed) {
    table.figures.push_back({row, name, unit, decimals, kind, printed, recomputed});
  };
  for (std::size_t i = 1; i <= std::size(kPrintedLevels); ++i) {
    const int level = static_cast<int>(i);
    add(fmt::format("level {}", i), "Δh by pixel", "m", 3, Kind::derived, kPrintedLevels[i - 1].by_pixel,
        ring_tin::Rings{}.tolerance_m(level, 1, kP1FocalPx));
    add(fmt::format("level {}", i), "Δh at δ = 1", "m", 3, Kind::derived, kPrintedLevels[i - 1].equal,
        equal_rings().tolerance_m(level, 1, kP1FocalPx));
  }
  for (std::size_t k = 0; k < settings.sets.size(); ++k) {
    const PointSet& set = settings.sets[k];
    const Printed printed = k < std::size(kPrinted) ? kPrinted[k] : Printed{"", "", ""};
    const auto count = [](std::size_t triangles) { return static_cast<double>(triangles); };
    add(row_of(k), kFull, "", 0, Kind::derived, printed.full, std::nullopt);
    add(row_of(k), kAfter, "", 0, k == 0 ? Kind::fitted : Kind::predicted, printed.after, std::nullopt);
    add(row_of(k), kRemain, "%", 1, Kind::derived, "", 100 * count(set.remain) / count(set.triangles));
    add(row_of(k), kDelta, "px", 1, Kind::derived, printed.delta, std::nullopt);
    add(row_of(k), kScreen, "px", 1, Kind::measured, "", std::nullopt);
    add(row_of(k), kFolds, "", 0, Kind::measured, "", std::nullopt);
    add(row_of(k), kSlivers, "", 0, Kind::measured, "", std::nullopt);
    add(row_of(k), kSliversDeep, "", 0, Kind::measured, "", std::nullopt);
    add(row_of(k), kRefused, "%", 1, Kind::predicted, "10", std::nullopt);
    add(row_of(k), kRefusedAll, "%", 1, Kind::predicted, "10", std::nullopt);
    for (const Steps& steps : kSteps) {
      add(row_of(k), steps.name, "%", 2, Kind::measured, "8", std::nullopt);
    }
  }
  return table;
}

std::size_t p1_steps(const P1Settings& settings) { return 1 + settings.sets.size(); }

Trial p1_trial(const Table& table, const P1Settings& settings, const Terrain& terrain, const P1View& view,
               const Workshop& workshop) {
  Trial trial;
  trial.terrain = terrain.id;
  trial.view = view.name;
  for (int level = 1; level <= static_cast<int>(std::size(kPrintedLevels)); ++level) {
    const std::string row = fmt::format("level {}", level);
    put(table, trial, row, "Δh by pixel", ring_tin::Rings{}.tolerance_m(level, 1, kP1FocalPx));
    put(table, trial, row, "Δh at δ = 1", equal_rings().tolerance_m(level, 1, kP1FocalPx));
  }

  Terrain shape = terrain;
  shape.spacing_m = kP1SpacingM;
  double relief = 1;
  for (std::size_t k = 0; k < settings.sets.size(); ++k) {
    const PointSet& wanted = settings.sets[k];
    const TrimmedTin set = trimmed_tin(shape, wanted);
    ring_tin::Settings as_published = p1_settings(view.variant, wanted.levels);
    as_published.depth_cap = view.depth_cap;
    if (k == 0) {
      const auto remaining = [&](double factor) {
        workshop.check();
        return static_cast<double>(Simplified(as_published, set, factor).frame.mesh.triangles.size());
      };
      const Found found = search({static_cast<double>(wanted.remain), 1, false, kCountTolerance}, remaining);
      relief = found.x;
      trial.fits.push_back({"factor on heights", "", relief, row_of(0), kAfter,
                            static_cast<double>(wanted.remain), found.value});
      workshop.step();
    }
    Simplified simplified(as_published, set, relief);
    const double full = static_cast<double>(set.tin.mesh.triangles.size());
    const double after = static_cast<double>(simplified.frame.mesh.triangles.size());
    const ring_tin::Statistics first = simplified.method.statistics();
    put(table, trial, row_of(k), kFull, full);
    put(table, trial, row_of(k), kAfter, after);
    put(table, trial, row_of(k), kRemain, percent_of(after, full));
    int coarsest = 0;
    for (std::uint32_t v = 0; v < set.tin.mesh.positions.size(); ++v) {
      coarsest = std::max(coarsest, simplified.method.level(v));
    }
    put(table, trial, row_of(k), kDelta, as_published.rings.delta_px[static_cast<std::size_t>(coarsest)]);
    put(table, trial, row_of(k), kScreen, screen_error_px(simplified, set.middle, workshop.device));
    const oracle::ConformityCounts counts =
        oracle::check_conformity(simplified.frame.mesh, simplified.frame.domain).counts;
    put(table, trial, row_of(k), kFolds, static_cast<double>(counts.fold_over + counts.degenerate));
    put(table, trial, row_of(k), kSlivers, slivers(simplified.frame));
    ring_tin::Settings deep = as_published;
    deep.depth_cap = 10;
    put(table, trial, row_of(k), kSliversDeep, slivers(Simplified(deep, set, relief).frame));
    const auto refused = static_cast<double>(first.refused_depth);
    put(table, trial, row_of(k), kRefused, percent_of(refused, static_cast<double>(first.qualifying)));
    put(table, trial, row_of(k), kRefusedAll,
        percent_of(refused, static_cast<double>(simplified.method.prepared().adjacency.edges().size())));
    for (const Steps& steps : kSteps) {
      workshop.check();
      const Vec2 start{set.middle.x, set.middle.y - steps.step_m * steps.frames / 2};
      simplified.method.reset();
      simplified.method.update(viewer(start), simplified.frame);
      double restored = 0;
      for (int n = 1; n <= steps.frames; ++n) {
        simplified.method.update(viewer({start.x, start.y + steps.step_m * n}), simplified.frame);
        restored += static_cast<double>(simplified.method.statistics().vertices_reset);
      }
      put(table, trial, row_of(k), steps.name,
          percent_of(restored / steps.frames, static_cast<double>(set.tin.mesh.positions.size())));
    }
    workshop.step();
  }
  return trial;
}

}  // namespace plumbline::tables
