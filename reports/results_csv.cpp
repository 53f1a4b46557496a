// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <string_view>

#include "reports/json_text.h"
#include "reports/report.h"

namespace plumbline::reports {
namespace {

/// RFC 4180: quoted where a comma, a quote or a line break stands inside; quotes are doubled.
std::string csv_field(std::string_view text) {
  const std::string clean = valid_utf8(text);
  if (clean.find_first_of(",\"\r\n") == std::string::npos) return clean;
  std::string out = "\"";
  for (const char c : clean) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string csv_number(double value) { return std::isfinite(value) ? number_text(value) : std::string(); }

/// Whether anything stands behind a figure of this frame; if not, its cell stays empty.
bool was_judged(std::string_view figure, const verdict::FrameVerdict& frame) {
  if (!verdict::was_asked(frame.subject, figure)) return false;
  if (figure == "displacement_px.uncovered_px") return true;
  if (figure.starts_with("displacement_px.")) return frame.image.displacement_px.count > 0;
  if (figure.starts_with("parallax_px.")) return frame.image.parallax_px.count > 0;
  if (figure.starts_with("depth_rel.")) return frame.image.depth_rel.count > 0;
  if (figure.starts_with("pop_px.")) return frame.pop_px.count > 0;
  if (figure.starts_with("vertical_m.")) return frame.vertical_m.area_m2 > 0;
  if (figure == "stability.revisit_share") return frame.stability.revisit;
  if (figure == "economy.excess") return frame.economy.needed > 0;
  if (figure.starts_with("economy.")) return frame.economy.slack_judged;
  if (figure == "projected_area") return frame.space.area_judged;
  if (figure == "self_intersection" || figure.starts_with("hausdorff_m.") ||
      figure.starts_with("normal_deg."))
    return frame.space.judged;
  return true;
}

void add_frame(std::string& out, const verdict::RunVerdict& run, const verdict::FrameVerdict& frame) {
  out += csv_field(run.id) + ',' + csv_field(run.terrain) + ',' + csv_field(run.trajectory) + ',' +
         csv_field(run.method) + ',' + csv_number(run.threshold_px) + ',' + std::to_string(frame.index);
  for (const double coordinate : {frame.camera.position.x, frame.camera.position.y, frame.camera.position.z})
    out += ',' + csv_number(coordinate);
  out += ',' + std::to_string(frame.vertices);
  // The figures of a trajectory of one frame are that frame's.
  const verdict::RunSummary alone = verdict::summarize({frame});
  for (const verdict::Figure& figure : verdict::figures()) {
    out += ',';
    if (was_judged(figure.path, frame)) out += csv_number(figure.value(alone));
  }
  const verdict::CounterFigures& counters = frame.counters;
  for (const std::uint64_t counter :
       {counters.visited, counters.evaluated, counters.split, counters.merged, counters.entered,
        counters.left, counters.nodes, counters.drawn, counters.tiles})
    out += ',' + std::to_string(counter);
  out += "\r\n";
}

}  // namespace

std::string results_csv(const verdict::SuiteVerdict& verdict) {
  std::string out =
      "run,terrain,trajectory,method,threshold_px,frame,position_x_m,position_y_m,position_z_m,vertices";
  for (const verdict::Figure& figure : verdict::figures()) out += ',' + std::string(figure.path);
  out += ",visited,evaluated,split,merged,entered,left,nodes,drawn,tiles\r\n";
  for (const verdict::RunVerdict& run : verdict.runs)
    for (const verdict::FrameVerdict& frame : run.frames) add_frame(out, run, frame);
  return out;
}

}  // namespace plumbline::reports
