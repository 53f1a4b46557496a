// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// P0 (TABLES). E. Yusov, V. Turlapov, GraphiCon 2006, figures 6–8: triangles of ATL beside those of QUADTin
// for pictures that look alike. At what equality the pairs were made the paper does not say; here it is the
// same measured p99 of O3's displacement, and two other readings stand beside it.
#include "properties/tables/p0.h"

#include <cmath>

#include <fmt/format.h>

#include "properties/tables/search.h"

namespace plumbline::tables {
namespace {

/// A search for an error ends this near to it, relative: counts then differ by about as much, a tenth of a
/// percent, far less than from view to view.
constexpr double kErrorTolerance = 1e-3;
/// The coherent frame: the camera moves by this share of the terrain's width towards what it looks at.
constexpr double kStepWidths = 0.01;
/// 2·512²: the paper counts the grid of 512 × 512 vertices as so many cells.
constexpr double kFullPublished = 2.0 * 512 * 512;

struct Published {
  const char* row;
  const char* atl;
  const char* atl_percent;
  const char* quadtin;  ///< "": no figure
  const char* quadtin_percent;
  const char* visited_percent;  ///< "от 1.3% до 7.3%": the ends of the range
};
constexpr Published kPublished[] = {
    {"6", "38 530", "7.3", "", "", "7.3"},
    {"7", "20 569", "3.9", "23 510", "4.6", ""},
    {"8", "6 983", "1.3", "7 420", "1.4", "1.3"},
};

constexpr const char* kAtl = "ATL triangles";
constexpr const char* kAtlShare = "ATL share of full";
constexpr const char* kP99 = "ATL displacement p99";
constexpr const char* kMax = "ATL displacement max";
constexpr const char* kUncovered = "ATL pixels without mesh";
constexpr const char* kQuadtin = "QUADTin triangles, same p99";
constexpr const char* kQuadtinP99 = "QUADTin displacement p99";
constexpr const char* kQuadtinShare = "QUADTin share of full";
constexpr const char* kRatio = "QUADTin : ATL, same p99";
constexpr const char* kRatioMax = "QUADTin : ATL, same max";
constexpr const char* kRatioTau = "QUADTin : ATL, same τ";
constexpr const char* kVisited = "ATL nodes visited";
constexpr const char* kEvaluated = "ATL errors evaluated";

double full_triangles(SampleBlock block) { return 2.0 * (block.columns - 1) * (block.rows - 1); }

std::optional<double> percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// The opponent over the same picture.
class Opponent {
 public:
  Opponent(LodMethod& method, const Ground& ground, const Camera& camera, const oracle::PixelHits& hits,
           const Workshop& workshop)
      : method_(method), ground_(ground), camera_(camera), hits_(hits), workshop_(workshop) {}

  double triangles_at(double threshold_px) {
    workshop_.check();
    method_.reset();
    method_.set_threshold_px(threshold_px);
    method_.update(camera_, frame_);
    return static_cast<double>(frame_.mesh.triangles.size());
  }

  struct Match {
    double triangles = 0, error_px = 0;
  };
  /// Triangles where `figure` of the displacement is the goal, and the figure that was reached: over steps it
  /// jumps.
  Match triangles_at_error(double goal_px, double start_px, double oracle::PixelFigure::*figure) {
    const auto error_px = [&](double threshold_px) {
      triangles_at(threshold_px);
      return ground_.displacement_px(camera_, hits_, frame_.mesh).*figure;
    };
    const Found found = search({goal_px, start_px, false, kErrorTolerance}, error_px);
    return {triangles_at(found.x), found.value};
  }

 private:
  LodMethod& method_;
  const Ground& ground_;
  const Camera& camera_;
  const oracle::PixelHits& hits_;
  const Workshop& workshop_;
  LodFrame frame_;
};

}  // namespace

const std::vector<P0View>& p0_views() {
  static const std::vector<P0View> views{
      {{"overview, 45° down", {0, -1, 1}}, 1.75},
      {{"oblique, 18° down", {0, -3, 1}}, 1.25},
      {{"low, 5.7° down", {0, -10, 1}}, 0.6},
  };
  return views;
}

Table p0_table(const Picture& picture) {
  Table table;
  table.id = "P0";
  table.title = "ATL (Haar vertex quadtree) beside QUADTin, 512 × 512 grid in 16 patches of 128 × 128";
  table.source =
      "E. Yusov, V. Turlapov, Dynamic terrain simplification based on Haar transform and vertices "
      "quadtree, GraphiCon 2006, appendix, figures 6–8 and section 4";
  table.protocol = {
      "Fitted: for each picture the τ at which ATL's first frame has the published count, by bisection. "
      "All else is prediction or measurement.",
      "ATL is haar_quadtree, QUADTin's stand-in the restricted quadtree. Neither culls, so that counts "
      "are of the whole terrain, as the paper's percentages are.",
      "Decided: two triangulations are equally good if the 99th percentile of O3's displacement is the "
      "same, against the samples that ATL represents, seen from the same camera. It is met as near as "
      "its jumps allow; what was reached stands below. Equal maximum and equal τ stand beside it, since "
      "the paper does not say what it held equal.",
      fmt::format(
          "Decided: the paper's cameras are unknown; three views onto the middle of the terrain, {} × {} "
          "pixels, {}° high, give a range.",
          picture.width_px, picture.height_px, picture.fov_y_deg),
      "Nodes visited and errors evaluated: of all nodes of the forest, in the top-down pass of the next "
      "frame, the camera moved by 1 % of the terrain's width towards what it looks at.",
  };
  table.notes = {
      "524 288 = 2·512² counts cells; 512 × 512 vertices have 2·511² = 522 242 triangles.",
      "Figure 7b prints 4.6 %: 23 510 of 524 288 is 4.48 %, so 4.5 is meant.",
      "Nodes visited is an identity: R roots in P patches are seen by (4R − P)/3 visits, of (4N − P)/3 "
      "nodes over N samples, so the share is that of the triangles. The paper's 1.3–7.3 % says no more "
      "than its counts. What informs is the share whose error is evaluated.",
  };
  const auto add = [&](const char* row, const char* name, const char* unit, int decimals, Kind kind,
                       const char* printed, std::optional<double> recomputed) {
    table.figures.push_back({row, name, unit, decimals, kind, printed, recomputed});
  };
  add("6a", "full triangles", "", 0, Kind::derived, "524 288", kFullPublished);
  for (const Published& p : kPublished) {
    const double atl = printed_number(p.atl);
    const bool pair = *p.quadtin != '\0';
    const double quadtin = pair ? printed_number(p.quadtin) : 0;
    const auto if_pair = [&](double value) { return pair ? std::optional(value) : std::nullopt; };
    add(p.row, kAtl, "", 0, Kind::fitted, p.atl, std::nullopt);
    add(p.row, kAtlShare, "%", 2, Kind::derived, p.atl_percent, 100 * atl / kFullPublished);
    add(p.row, kP99, "px", 2, Kind::measured, "", std::nullopt);
    add(p.row, kMax, "px", 2, Kind::measured, "", std::nullopt);
    add(p.row, kUncovered, "%", 2, Kind::measured, "", std::nullopt);
    add(p.row, kQuadtin, "", 0, pair ? Kind::predicted : Kind::measured, p.quadtin, std::nullopt);
    add(p.row, kQuadtinShare, "%", 2, Kind::derived, p.quadtin_percent,
        if_pair(100 * quadtin / kFullPublished));
    add(p.row, kQuadtinP99, "px", 2, Kind::measured, "", std::nullopt);
    add(p.row, kRatio, "", 3, pair ? Kind::predicted : Kind::measured, "", if_pair(quadtin / atl));
    add(p.row, kRatioMax, "", 3, Kind::measured, "", std::nullopt);
    add(p.row, kRatioTau, "", 3, Kind::measured, "", std::nullopt);
    add(p.row, kVisited, "%", 2, Kind::derived, p.visited_percent, std::nullopt);
    add(p.row, kEvaluated, "%", 2, Kind::measured, "", std::nullopt);
  }
  return table;
}

Trial p0_trial(const Table& table, const P0Settings& settings, const Terrain& terrain, const P0View& view,
               const Workshop& workshop) {
  Trial trial;
  trial.terrain = terrain.id;
  trial.view = view.view.name;
  const std::unique_ptr<LodMethod> atl = prepared(settings.atl, terrain);
  const std::unique_ptr<LodMethod> quadtin = prepared(settings.quadtin, terrain);
  const SampleBlock block = atl->reference(terrain);
  const Ground ground(workshop.device, terrain, block);
  const Camera camera = look_at_middle(terrain, view.view, view.widths * terrain.width_m(), workshop.picture);
  const Camera moved =
      look_at_middle(terrain, view.view, (view.widths - kStepWidths) * terrain.width_m(), workshop.picture);
  const oracle::PixelHits hits = ground.look(camera);
  const double full = full_triangles(block);
  put(table, trial, "6a", "full triangles", full);

  Opponent opponent(*quadtin, ground, camera, hits, workshop);
  LodFrame frame;
  const auto first_frame = [&](double threshold_px) {
    workshop.check();
    atl->reset();
    atl->set_threshold_px(threshold_px);
    atl->update(camera, frame);
    return static_cast<double>(frame.mesh.triangles.size());
  };
  for (std::size_t k = 0; k < settings.atl_triangles.size(); ++k) {
    const char* row = kPublished[k].row;
    const double wanted = settings.atl_triangles[k];
    const Found fitted = search({wanted, 1, true, 0}, first_frame);
    const double count = first_frame(fitted.x);
    trial.fits.push_back({"τ of ATL", "px", fitted.x, row, kAtl, wanted, count});
    put(table, trial, row, kAtl, count);
    put(table, trial, row, kAtlShare, 100 * count / full);
    const oracle::PixelFigure error = ground.displacement_px(camera, hits, frame.mesh);
    std::size_t seen = 0;
    for (const std::uint32_t triangle : hits.triangle) seen += triangle == oracle::PixelHits::kNoHit ? 0 : 1;
    put(table, trial, row, kP99, error.p99);
    put(table, trial, row, kMax, error.max);
    put(table, trial, row, kUncovered, percent(seen - error.count, seen));
    atl->update(moved, frame);  // the next frame of a flight
    put(table, trial, row, kVisited, percent(frame.counters.visited, frame.counters.nodes));
    put(table, trial, row, kEvaluated, percent(frame.counters.evaluated, frame.counters.nodes));
    workshop.step();

    const Opponent::Match same_p99 =
        opponent.triangles_at_error(error.p99, fitted.x, &oracle::PixelFigure::p99);
    put(table, trial, row, kQuadtin, same_p99.triangles);
    put(table, trial, row, kQuadtinP99, same_p99.error_px);
    put(table, trial, row, kQuadtinShare, 100 * same_p99.triangles / full);
    put(table, trial, row, kRatio, per(same_p99.triangles, count));
    workshop.step();
    const Opponent::Match same_max =
        opponent.triangles_at_error(error.max, fitted.x, &oracle::PixelFigure::max);
    put(table, trial, row, kRatioMax, per(same_max.triangles, count));
    put(table, trial, row, kRatioTau, per(opponent.triangles_at(fitted.x), count));
    workshop.step();
  }
  return trial;
}

}  // namespace plumbline::tables
