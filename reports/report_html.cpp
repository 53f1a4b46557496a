// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "reports/digest.h"
#include "reports/encoded_frame.h"
#include "reports/escape.h"
#include "reports/json_text.h"
#include "reports/page_template.h"
#include "reports/picture.h"
#include "reports/report.h"

namespace plumbline::reports {
namespace {

std::string data_uri(const std::string& png) { return "data:image/png;base64," + base64(png); }

/// What the page needs besides the two JSON files.
Json facts_json(const verdict::SuiteVerdict& verdict, std::span<const EncodedFrame> frames,
                const std::string& command) {
  const VerdictWords words = verdict_in_words(verdict);
  Json out = {
      {"plumbline", PLUMBLINE_VERSION}, {"command", command.empty() ? "plumbline run SUITE.toml" : command},
      {"headline", words.headline},     {"sentences", words.sentences},
      {"catalogue", Json::array()},     {"pictures", Json::array()}};
  for (const oracle::FindingDescription& entry : oracle::finding_catalogue())
    out["catalogue"].push_back(
        {{"code", static_cast<int>(entry.code)}, {"name", entry.name}, {"definition", entry.definition}});
  for (const EncodedFrame& frame : frames)
    out["pictures"].push_back({{"run", frame.run},
                               {"frame", frame.frame},
                               {"threshold_px", frame.threshold_px},
                               {"mesh", data_uri(frame.mesh)},
                               {"error", data_uri(frame.error)},
                               {"reference", data_uri(frame.reference)}});
  return out;
}

/// Fills the template in one pass, so that no value is taken for a mark.
std::string fill(std::string_view page, const std::map<std::string_view, std::string>& values) {
  constexpr std::string_view kOpen = "<!--data:", kClose = "-->";
  std::string out;
  for (std::size_t from = 0;;) {
    const std::size_t mark = page.find(kOpen, from);
    out += page.substr(from, mark - from);
    if (mark == std::string_view::npos) return out;
    const std::size_t name = mark + kOpen.size(), end = page.find(kClose, name);
    const auto value = values.find(page.substr(name, end - name));
    if (value == values.end())
      throw std::logic_error("the report page asks for data that a report does not have");
    out += value->second;
    from = end + kClose.size();
  }
}

}  // namespace

namespace {
/// Nothing for a picture that was not taken.
std::string shaded_png(const Raster& shade) {
  return shade.values.empty() ? std::string() : png_bytes(shaded_picture(shade));
}
}  // namespace

std::vector<EncodedFrame> encode(std::span<const verdict::FramePictures> pictures) {
  std::vector<EncodedFrame> out;
  for (const verdict::FramePictures& frame : pictures)
    out.push_back({frame.run, frame.frame, frame.threshold_px, shaded_png(frame.shaded),
                   frame.displacement_px.values.empty()
                       ? std::string()
                       : png_bytes(heat_map(frame.displacement_px, frame.threshold_px)),
                   shaded_png(frame.reference)});
  return out;
}

std::string page_html(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing,
                      std::span<const EncodedFrame> frames, const std::string& command) {
  const std::string title = fmt::format("{}: {}", verdict.suite, verdict.pass() ? "pass" : "fail");
  return fill(kPageTemplate, {{"title", markup_escape(title)},
                              {"facts", script_safe_json(json_text(facts_json(verdict, frames, command), 1))},
                              {"results", script_safe_json(results_json(verdict))},
                              {"timing", script_safe_json(timing_json(timing))}});
}

std::string report_html(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing,
                        std::span<const verdict::FramePictures> pictures, const std::string& command) {
  return page_html(verdict, timing, encode(pictures), command);
}

}  // namespace plumbline::reports
