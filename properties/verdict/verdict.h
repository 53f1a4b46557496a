// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/conformity.h"
#include "oracle/economy.h"
#include "oracle/image.h"
#include "oracle/likeness.h"
#include "oracle/shape.h"
#include "oracle/stability.h"
#include "oracle/vertical.h"
#include "properties/verdict/selftest_score.h"
#include "scenarios/camera.h"
#include "scenarios/raster.h"
#include "scenarios/trajectory.h"

/// What a run found out, as plain data: the only thing that reports see.
namespace plumbline::verdict {

/// Work and change of one frame; `entered` and `left` count vertices against the frame before. `nodes`,
/// `drawn` and `tiles` are 0 for a method that has none.
struct CounterFigures {
  std::uint64_t visited = 0, evaluated = 0, split = 0, merged = 0, entered = 0, left = 0;
  std::uint64_t nodes = 0, drawn = 0, tiles = 0;
};

/// O5 of one frame. A *fresh start* is the same method, reset, at the same camera.
struct StabilityFigures {
  bool cut = false;                 ///< the camera was cut to this frame
  bool under_threshold = false;     ///< p99 displacement ≤ τ, or nothing to judge
  bool settled = false;             ///< the mesh is a fresh start's, or its p99 is not above a fresh start's
  std::size_t toggles = 0;          ///< vertices that came back, or went again, within kToggleFrames frames
  std::size_t jitter_vertices = 0;  ///< that enter or leave when the picture moves by kJitterPx
  double jitter_px = 0;             ///< largest displacement between the meshes before and after that
  double path_share = 0;            ///< of vertices in which the mesh differs from a fresh start's
  double path_px = 0;               ///< largest displacement between the two
  bool revisit = false;             ///< an earlier frame of the flight had this camera, bit for bit
  double revisit_share = 0;         ///< of vertices in which the mesh differs from the first such frame's
};

/// O5 over a trajectory: sums of toggles, worst frames, and frames after cuts (RecoveryWatch).
struct StabilitySummary {
  std::size_t cuts = 0;
  int recovery_frames = 0;      ///< until under τ again
  std::size_t unrecovered = 0;  ///< cuts after which it never was
  int lag_frames = 0;           ///< until settled
  std::size_t unsettled = 0;
  std::size_t toggles = 0;
  std::size_t jitter_vertices = 0;
  double jitter_px = 0;
  double path_share = 0, path_px = 0;
  std::size_t revisits = 0;
  double revisit_share = 0;
};

/// O4 of one frame. *Needed* is what the suite's yardstick draws at the same camera and the same measured p99
/// displacement (economy.h).
struct EconomyFigures {
  bool slack_judged = false;  ///< slack is measured in some frames only, for its price
  oracle::Slack slack;
  double needed = 0;  ///< triangles; 0: not known
};

/// O4 over a trajectory: vertices and triangles of all frames that were judged, so long frames weigh more.
struct EconomySummary {
  std::size_t slack_frames = 0;
  oracle::Slack slack;
  std::size_t excess_frames = 0;
  double drawn = 0, needed = 0;  ///< triangles of these frames
};

/// O7 of one frame of a general mesh. What is costly is measured in some frames only, as slack is.
struct SpaceFigures {
  bool judged = false;  ///< likeness and self-intersections were
  oracle::Likeness likeness;
  std::size_t self_intersections = 0;  ///< pairs of triangles
  bool area_judged = false;
  double projected_area = 0;  ///< signed, share of the reference's pixels
};

/// O7 over a trajectory: the worst frames; pairs are summed.
struct SpaceSummary {
  std::size_t frames = 0;  ///< in which likeness was judged
  oracle::CertifiedDistance hausdorff_m;
  double normal_max_deg = 0, normal_mean_deg = 0, turned_share = 0;
  std::size_t self_intersections = 0;
  std::size_t area_frames = 0;
  double projected_area = 0;  ///< largest |share|
};

/// What the oracles say of one frame.
struct FrameVerdict {
  int index = 0;
  Subject subject = Subject::terrain;  ///< what is asked: was_asked()
  Camera camera;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  oracle::ConformityCounts conformity;
  std::size_t visible_cracks = 0;  ///< cracks (with a gap) that show in the picture
  double largest_gap_m = 0;
  double largest_gap_px = 0;  ///< over visible cracks
  /// 1 if no pixel showed anything to judge (finding 110), else 0. Looking away is no fault of the method,
  /// but whatever the frame's picture says of it is said of nothing.
  std::size_t nothing_judged = 0;
  oracle::VerticalError vertical_m;
  oracle::ImageError image;
  oracle::PixelFigure pop_px;  ///< count 0 on the first frame
  oracle::ShapeReport shape;
  StabilityFigures stability;
  EconomyFigures economy;
  SpaceFigures space;
  CounterFigures counters;
  std::vector<oracle::Finding> findings;  ///< the worst few, capped at kFindingsListed; counts are complete
  static constexpr std::size_t kFindingsListed = 8;
};

/// Over a trajectory: counts are summed; max, p999, p99 and gaps are the worst frame's; rms and mean pool all
/// pixels (vertical: all frames' areas); over_threshold pools pixels; triangles and vertices are means, with
/// the extremes; nodes is the largest.
struct RunSummary {
  std::size_t frames = 0;
  Subject subject = Subject::terrain;
  double triangles = 0, vertices = 0;
  std::size_t triangles_min = 0, triangles_max = 0;
  oracle::ConformityCounts conformity;
  std::size_t visible_cracks = 0;
  double largest_gap_m = 0, largest_gap_px = 0;
  std::size_t nothing_judged = 0;  ///< frames
  oracle::VerticalError vertical_m;
  oracle::ImageError image;
  oracle::PixelFigure pop_px;
  oracle::ShapeReport shape;
  StabilitySummary stability;
  EconomySummary economy;
  SpaceSummary space;
  CounterFigures counters;
  /// Index of the frame with the largest p99 displacement, of a mesh: with the largest silhouette distance;
  /// the first among equals.
  int worst_frame = 0;
};

/// A run's figures over its trajectory, by the rules above. A frame without judged pixels, area or triangles
/// carries no weight in a mean; a figure that is not a number stays one, so that no gate can pass over it.
/// Sums in frame order.
RunSummary summarize(const std::vector<FrameVerdict>& frames);

/// A figure of a run that a gate may limit, a chart may draw and a table may list.
struct Figure {
  std::string_view
      path;  ///< "crack", "displacement_px.p99": the key in results.json (conformity's counts stand alone)
  std::string_view unit;  ///< "count", "frames", "m", "px", "share", "ratio", "quality"
  double (*value)(const RunSummary&);
};
/// Every figure, in the order of results.json.
std::span<const Figure> figures();
/// Whether a figure makes sense for what is flown around. A mesh that is no height field has no plan to cover
/// and no height over a point: its plan findings, vertical_m, displacement_px and shape are not asked.
bool was_asked(Subject subject, std::string_view path);
/// One figure of a run; NaN if it was not asked. Throws InputError naming all figures if there is none of
/// that path.
double figure_value(const RunSummary& summary, std::string_view path);

/// One flight: a method at a threshold along a trajectory, frame by frame.
struct RunVerdict {
  std::string id;  ///< "<terrain or mesh>.<trajectory>.<method>.<threshold>"
  Subject subject = Subject::terrain;
  std::string terrain;  ///< id of the terrain, or of the mesh
  std::string trajectory;
  std::string method;
  double threshold_px = 0;
  std::vector<FrameVerdict> frames;
  RunSummary summary;
};

/// What was flown over.
struct TerrainFacts {
  std::string id;
  int columns = 0, rows = 0;
  double spacing_m = 0, lowest_m = 0, highest_m = 0;
  double diagonal_ambiguity_m = 0;  ///< largest gap between the two ways to split a cell
};

/// A scene of objects.
struct MeshFacts {
  std::string id;
  std::size_t objects = 0, triangles = 0, vertices = 0;  ///< of the full scene
  Vec3 center;                                           ///< of the scene's box, metres
  double radius_m = 0, object_radius_m = 0;              ///< of the balls around the scene and one object
};

/// One gate asked of one run.
struct GateVerdict {
  std::string name;   ///< "block_bintree: crack == 0"
  std::string run;    ///< run id
  std::string limit;  ///< "<= 1 tau (2 px)"
  double value = 0;
  bool pass = false;
  std::string figure{};   ///< path of what is limited
  bool expected = false;  ///< an entry of an expectation file, in place of the gates on the figure
  std::string why{};      ///< of an expectation: its reason
  std::string note{};     ///< of one that does not hold: what was expected, what was found, what to do
  /// Of an expectation: the gates that it stands in for hold, too, so it could go.
  bool needless = false;
};

/// All that results.json tells.
struct SuiteVerdict {
  std::string suite;
  std::string yardstick;  ///< the method that says how many triangles are needed; empty: none in the suite
  int width_px = 0, height_px = 0;
  double fov_y_deg = 0;
  std::vector<TerrainFacts> terrains;
  std::vector<MeshFacts> meshes;
  std::vector<RunVerdict>
      runs;  ///< terrain (then mesh), trajectory, method, threshold: the suite file's order
  std::vector<GateVerdict> gates;  ///< run order, then gate order
  std::vector<std::string>
      vacuous;             ///< oracles or runs that had nothing to judge: each is a failure (finding 110)
  SelftestScore selftest;  ///< of the oracles that judged; no kinds: it was not taken
  bool interrupted = false;
  /// Every gate holds, nothing was vacuous, nothing is missing, and the oracles passed their own test. A
  /// suite without a run has judged nothing: no pass.
  [[nodiscard]] bool pass() const;
};

/// Everything a clock measured, and on what machine.
struct RunTiming {
  std::string run;
  double prepare_s = 0;
  std::vector<double> update_ms;  ///< one a frame: processor time of the thread that updates
  double oracle_s = 0;
};
/// All that timing.json tells.
struct SuiteTiming {
  std::string machine, compiler, build_type;
  int jobs = 0;
  double total_s = 0;
  std::vector<RunTiming> runs;
};

/// The pictures of one frame of one run, all of the viewport's size.
struct FramePictures {
  std::string run;
  int frame = 0;
  double threshold_px = 0;
  Raster shaded;           ///< the method's mesh with wireframe; shade in [0, 1], NaN sky
  Raster reference;        ///< the full surface, likewise, without wireframe
  Raster displacement_px;  ///< NaN where nothing was judged; of a mesh: parallax, +∞ where only one is seen
};

}  // namespace plumbline::verdict
