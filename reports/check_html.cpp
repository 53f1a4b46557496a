// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include <fmt/format.h>

#include "reports/check_page.h"
#include "reports/check_page_parts.h"
#include "reports/check_report.h"
#include "reports/check_words.h"
#include "reports/digest.h"
#include "reports/escape.h"
#include "reports/page_template.h"
#include "reports/picture.h"

namespace plumbline::reports {
namespace {

using verdict::CheckedMesh;
using verdict::CheckPictures;
using verdict::CheckSpot;
using verdict::CheckVerdict;
using verdict::SeamState;
using verdict::SeamVerdict;

/// Rows of a table that are shown at once, and that a page holds at all; the rest is in check.json.
constexpr std::size_t kRowsShown = 25, kRowsHeld = 400;

/// A file's name as part of a link: its own percent signs are no escapes.
std::string link_to(std::string_view file) {
  std::string out;
  for (const char c : file) out += c == '%' ? "%25" : std::string(1, c);
  return markup_escape(out);
}

/// A clause as a sentence.
std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string state_tag(SeamState state) {
  const char* style = state == SeamState::open               ? "bad"
                      : state == SeamState::covered_by_skirt ? "warn"
                                                             : "good";
  return fmt::format("<span class=\"tag {}\">{}</span>", style, verdict::seam_state_name(state));
}

/// A table whose later rows are folded away. `rows`: finished <tr> elements.
std::string table(std::string_view head, const std::vector<std::string>& rows, std::size_t total) {
  const auto part = [&](std::span<const std::string> some) {
    return fmt::format(
        "<div class=\"scroll\"><table><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n", head,
        fmt::join(some, ""));
  };
  const std::span<const std::string> all(rows);
  std::string out = part(all.first(std::min(rows.size(), kRowsShown)));
  if (rows.size() > kRowsShown)
    out += fmt::format("<details><summary>{} more</summary>\n{}</details>\n", rows.size() - kRowsShown,
                       part(all.subspan(kRowsShown)));
  if (total > rows.size())
    out += fmt::format("<p class=\"left\">And {} that are not on this page{}.</p>\n", total - rows.size(),
                       rows.size() < kRowsHeld ? "" : "; check.json has all that are listed");
  return out;
}

class CheckPage {
 public:
  CheckPage(const CheckVerdict& verdict, const CheckPictures& pictures, const CheckImages& images)
      : verdict_(verdict), pictures_(pictures), images_(images), groups_(group_findings(verdict)) {
    for (const CheckSpot& spot : pictures.spots) spots_[spot.finding].push_back(&spot);
  }

  std::string write(const std::string& command) {
    head();
    map();
    findings();
    seams();
    measured();
    meshes();
    notes();
    definitions();
    repeat(command);
    return page();
  }

 private:
  void open(std::string_view id, std::string_view title, std::string_view lead = {}) {
    nav_ += fmt::format("<a href=\"#{}\">{}</a>\n", id, title);
    body_ += fmt::format("<section id=\"{}\"><h2>{}</h2>\n", id, title);
    if (!lead.empty()) body_ += fmt::format("<p class=\"lead\">{}</p>\n", lead);
  }
  void close() { body_ += "</section>\n"; }

  [[nodiscard]] std::string title() const {
    return fmt::format("{}: {}", subject_words(verdict_), verdict_.sound ? "sound" : "faulty");
  }

  [[nodiscard]] std::string page() const {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<div id=\"page\">\n"
        "<p class=\"brand\"><b>plumbline</b> check</p>\n{}<nav>\n{}</nav>\n{}"
        "<footer>plumbline {}. The same as text, JSON and SARIF: check.txt, check.json, "
        "check.sarif.</footer>\n"
        "</div>\n</body>\n</html>\n",
        markup_escape(title()), kCheckStyle, head_, nav_, body_, PLUMBLINE_VERSION);
  }

  void head() {
    const std::string words = headline_words(verdict_);
    head_ = fmt::format(
        "<header class=\"verdict{}\"><span class=\"stamp\">{}</span><div><h1>{}</h1>\n<p>{}</p>\n",
        verdict_.sound ? "" : " fail", verdict_.sound ? "sound" : "faulty",
        markup_escape(subject_words(verdict_)), markup_escape(words));
    const std::vector<std::string> steps = next_steps(verdict_);
    if (!steps.empty()) {
      head_ += "<p class=\"next\">What to do next</p>\n<ol>\n";
      for (const std::string& step : steps) head_ += fmt::format("<li>{}</li>\n", markup_escape(step));
      head_ += "</ol>\n";
    }
    std::size_t triangles = 0, vertices = 0;
    for (const CheckedMesh& mesh : verdict_.meshes) {
      triangles += mesh.triangles;
      vertices += mesh.vertices;
    }
    head_ += "<dl class=\"facts\">\n" + fact("Meshes", std::to_string(verdict_.meshes.size())) +
             fact("Triangles", std::to_string(triangles)) + fact("Vertices", std::to_string(vertices)) +
             fact("x, y, z", verdict_.frame) + "</dl>\n</div></header>\n";
    const std::vector<std::string> proved = proved_sentences(verdict_);
    if (proved.empty()) return;
    open("proved", "Proved");
    body_ += "<ul class=\"plain\">\n";
    for (const std::string& sentence : proved)
      body_ += fmt::format("<li>{}</li>\n", markup_escape(capital(sentence)));
    body_ += "</ul>\n";
    close();
  }

  static std::string swatch(std::string_view shape, std::string_view words) {
    return fmt::format(
        "<span><svg class=\"plan\" viewBox=\"0 0 26 14\" aria-hidden=\"true\">{}</svg>{}</span>\n", shape,
        words);
  }

  void map() {
    if (verdict_.meshes.size() == 1 && verdict_.findings.empty()) return;  // one empty box
    const std::string drawing = plan_svg(verdict_);
    if (drawing.empty()) return;
    open("map", "Where");
    const bool plain = verdict_.meshes.size() == 1;
    body_ += fmt::format("<div class=\"frame{}\">\n", plain ? " small" : "") + drawing +
             "<div class=\"legend\">\n";
    const SeamTotals totals = seam_totals(verdict_);
    const auto line = [](std::string_view style) {
      return fmt::format("<path class=\"seam {}\" d=\"M1 7H25\"/>", style);
    };
    if (totals.open > 0) body_ += swatch(line("open"), fmt::format("{} open", totals.open));
    if (totals.covered > 0)
      body_ += swatch(line("covered"), fmt::format("{} covered by a skirt", totals.covered));
    if (totals.watertight > 0)
      body_ += swatch(line("watertight"), fmt::format("{} watertight", totals.watertight));
    const auto listed = [&](oracle::Severity severity) {
      return std::ranges::any_of(verdict_.findings,
                                 [&](const auto& one) { return one.finding.severity == severity; });
    };
    if (listed(oracle::Severity::fault))
      body_ +=
          swatch("<circle class=\"fault\" cx=\"13\" cy=\"7\" r=\"6\"/>", "a fault, the larger the worse");
    if (listed(oracle::Severity::hazard))
      body_ += swatch("<circle class=\"hazard\" cx=\"13\" cy=\"7\" r=\"5\"/>", "a hazard");
    if (verdict_.meshes.size() > kPlanBoxes)
      body_ += "<span>Each cell has the colour of the worst seam in it; point at it for counts.</span>\n";
    body_ += "</div></div>\n";
    close();
  }

  void findings() {
    if (groups_.empty()) return;
    const std::size_t total = std::max(verdict_.findings_total, verdict_.findings.size());
    open("findings", "Findings",
         total > verdict_.findings.size()
             ? fmt::format("{}, worst first; the worst {} are listed.", total, verdict_.findings.size())
             : fmt::format("{}, worst first.", total));
    for (const CodeGroup& group : groups_) findings(group);
    close();
  }

  void findings(const CodeGroup& group) {
    body_ += fmt::format(
        "<h3 id=\"code-{0}\"><span class=\"code\">{0}</span> <a href=\"#what-{0}\">{1}</a> <span "
        "class=\"count\">{2}{3}</span>{4}</h3>\n<p class=\"lead\">{5}</p>\n",
        static_cast<int>(group.code), code_name(group.code), group.exact ? "" : "at least ",
        group.count == 1 ? std::string("once") : fmt::format("{} times", group.count),
        group.hazard ? " <span class=\"tag warn\">hazard</span>" : "",
        markup_escape(code_remedy(group.code)));
    std::string cards;
    std::vector<std::string> rows;
    std::size_t shown = 0;
    for (const std::size_t i : group.listed) {
      const auto spots = spots_.find(i);
      if (spots != spots_.end()) ++shown;
      if (spots != spots_.end())
        for (const CheckSpot* spot : spots->second) cards += card(*spot, verdict_.findings[i]);
      if (rows.size() < kRowsHeld) rows.push_back(row(verdict_.findings[i]));
    }
    if (!cards.empty()) body_ += "<div class=\"spots\">\n" + cards + "</div>\n";
    if (shown < group.count && !rows.empty())
      body_ += table("<th>mesh</th><th>kind</th><th>at x, y, z</th><th>size</th><th>what follows</th>", rows,
                     group.count);
  }

  [[nodiscard]] std::string card(const CheckSpot& spot, const verdict::CheckFinding& finding) const {
    std::string picture, link;
    if (!spot.picture_svg.empty())
      picture = fmt::format("<img src=\"{}\" alt=\"{}\">\n", data_uri("image/svg+xml", spot.picture_svg),
                            markup_escape(message_words(finding)));
    if (!spot_glb(verdict_, spot).empty())
      link = fmt::format("<span class=\"where\"><a href=\"spots/{0}\">{1}</a></span>",
                         link_to(spot_file(spot)), markup_escape(spot_file(spot)));
    return fmt::format(
        "<figure class=\"spot\">{}<figcaption><b>{}</b> <span class=\"where\">{} at {}</span>{}</figcaption>"
        "</figure>\n",
        picture, markup_escape(message_words(finding)), markup_escape(whose(verdict_, finding)),
        place_words(finding.at), link);
  }

  [[nodiscard]] std::string row(const verdict::CheckFinding& finding) const {
    return fmt::format(
        "<tr><td class=\"name\">{}</td><td>{}</td><td class=\"place\">{}</td><td>{}</td><td class=\"wrap\">{}"
        "</td></tr>\n",
        markup_escape(whose(verdict_, finding)), markup_escape(finding.finding.kind), place_words(finding.at),
        markup_escape(size_words(finding.finding)), markup_escape(finding.message));
  }

  void seams() {
    if (verdict_.seams.empty()) return;
    open("seams", "Seams",
         fmt::format(
             "{} border{} that two meshes share: {}. Gaps are signed: the first mesh's height minus the "
             "second's.",
             verdict_.seams.size(), verdict_.seams.size() == 1 ? "" : "s",
             seam_totals_words(seam_totals(verdict_))));
    if (const std::string advice = skirt_advice(verdict_); !advice.empty())
      body_ += fmt::format("<p class=\"lead\">{}</p>\n", markup_escape(advice));
    const bool levels = std::ranges::any_of(verdict_.seams, [](const auto& s) { return s.level >= 0; });
    const bool normals =
        std::ranges::any_of(verdict_.seams, [](const auto& s) { return std::isfinite(s.normal_max_deg); });
    std::vector<std::string> rows;
    for (const SeamState state : {SeamState::open, SeamState::covered_by_skirt, SeamState::watertight})
      for (const SeamVerdict& one : verdict_.seams)
        if (one.state == state && rows.size() < kRowsHeld) rows.push_back(seam(one, levels, normals));
    body_ +=
        table(fmt::format(
                  "<th>state</th><th>meshes</th>{}<th class=\"n\">length (m)</th><th class=\"n\">largest gap "
                  "(m)</th><th class=\"n\">mean (m)</th><th>at x, y, z</th><th class=\"n\">cracks</th><th "
                  "class=\"n\">T-junctions</th><th class=\"n\">skirts that suffice (m)</th>{}",
                  levels ? "<th>levels</th>" : "", normals ? "<th class=\"n\">normals (°)</th>" : ""),
              rows, verdict_.seams.size());
    close();
  }

  [[nodiscard]] std::string seam(const SeamVerdict& seam, bool levels, bool normals) const {
    const bool gap = seam.largest_gap_m != 0;
    const auto number = [](const std::string& text) { return fmt::format("<td class=\"n\">{}</td>", text); };
    const auto signed_number = [](double value) { return (value > 0 ? "+" : "") + short_number(value); };
    std::string out = fmt::format("<tr><td>{}</td><td class=\"name\">{}<br>{}</td>", state_tag(seam.state),
                                  markup_escape(mesh_name(verdict_, seam.mesh)),
                                  markup_escape(mesh_name(verdict_, seam.other_mesh)));
    if (levels)
      out += seam.level < 0 ? "<td></td>" : fmt::format("<td>{}, {}</td>", seam.level, seam.other_level);
    out += number(short_number(seam.length_m)) + number(gap ? signed_number(seam.largest_gap_m) : "0") +
           number(gap ? signed_number(seam.mean_gap_m) : "0") +
           fmt::format("<td class=\"place\">{}</td>", gap ? place_words(seam.largest_at) : "") +
           number(std::to_string(seam.cracks)) + number(std::to_string(seam.t_junctions)) +
           number(gap ? fmt::format("{}, {}", sufficient_number(seam.least_skirt_m),
                                    sufficient_number(seam.least_skirt_other_m))
                      : "");
    if (normals) out += number(short_number(seam.normal_max_deg));
    return out + "</tr>\n";
  }

  void measured() {
    if (verdict_.terrain) {
      open("terrain", "Against the DEM", markup_escape(verdict_.terrain->file));
      body_ += terrain_part(*verdict_.terrain, images_.error_map, pictures_.error_map_box);
      close();
    }
    if (verdict_.reference) {
      open("reference", "Against the reference", markup_escape(verdict_.reference->file));
      body_ += reference_part(*verdict_.reference);
      close();
    }
    if (verdict_.image) {
      const Camera& camera = verdict_.image->camera;
      open("camera", "From the camera",
           fmt::format("At {}, {} x {} pixels, {}° high.", place_words(camera.position), camera.width_px,
                       camera.height_px, short_number(camera.fov_y_deg)));
      body_ += image_part(*verdict_.image, images_.camera);
      close();
    }
  }

  void meshes() {
    if (verdict_.meshes.empty()) return;
    std::vector<const CheckedMesh*> order;
    for (const CheckedMesh& mesh : verdict_.meshes) order.push_back(&mesh);
    std::ranges::stable_sort(order, std::greater{},
                             [](const CheckedMesh* mesh) { return mesh->conformity.total(); });
    const bool skirts = std::ranges::any_of(verdict_.meshes, [](const CheckedMesh& mesh) {
      return mesh.skirt.triangles > 0 || mesh.skirt.stated || mesh.least_skirt_m > 0;
    });
    std::vector<std::string> rows;
    for (const CheckedMesh* mesh : std::span(order).first(std::min(order.size(), kRowsHeld)))
      rows.push_back(row(*mesh, skirts));
    open("meshes", "Meshes",
         "What was looked at, those with findings inside first. Quality is 1 for an equilateral triangle.");
    body_ +=
        table(fmt::format(
                  "<th>mesh</th><th>format</th><th>held to</th><th class=\"n\">triangles</th><th class=\"n\">"
                  "vertices</th><th class=\"n\">findings inside</th><th class=\"n\">least quality</th><th "
                  "class=\"n\">slivers</th><th class=\"n\">shortest edge (m)</th><th class=\"n\">median "
                  "(m)</th>{}",
                  skirts ? "<th class=\"n\">skirt has (m)</th><th class=\"n\">needs (m)</th>" : ""),
              rows, verdict_.meshes.size());
    close();
  }

  static std::string row(const CheckedMesh& mesh, bool skirts) {
    const bool hung = mesh.skirt.triangles > 0 || mesh.skirt.stated;
    const bool any = mesh.triangles > 0;
    std::string out = fmt::format(
        "<tr><td class=\"name\">{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td><td "
        "class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td>",
        markup_escape(mesh.file), markup_escape(mesh.format),
        mesh.terrain ? markup_escape(mesh.domain) : "object in space", mesh.triangles, mesh.vertices,
        mesh.conformity.total(), mesh.terrain && any ? short_number(mesh.shape.min_quality) : "—",
        mesh.terrain ? std::to_string(mesh.shape.slivers) : "—",
        any ? short_number(mesh.shortest_edge_m) : "—", any ? short_number(mesh.median_edge_m) : "—");
    if (skirts)
      out += fmt::format("<td class=\"n\">{}{}</td><td class=\"n\">{}</td>",
                         hung ? short_number(mesh.skirt.least_depth_m) : "—",
                         mesh.skirt.stated ? " (as said)" : "", sufficient_number(mesh.least_skirt_m));
    return out + "</tr>\n";
  }

  void notes() {
    if (verdict_.notes.empty()) return;
    open("notes", "Notes", "What was guessed, how to say otherwise, and what was not judged.");
    body_ += "<ul class=\"plain\">\n";
    for (const std::string& note : verdict_.notes) body_ += fmt::format("<li>{}</li>\n", markup_escape(note));
    body_ += "</ul>\n";
    close();
  }

  /// Of the codes that occur, in their order, with the catalogue's picture.
  void definitions() {
    if (groups_.empty()) return;
    std::vector<CodeGroup> groups = groups_;
    std::ranges::sort(groups, {}, &CodeGroup::code);
    open("definitions", "What the findings mean");
    body_ += "<dl class=\"definitions\">\n";
    for (const CodeGroup& group : groups) {
      const int code = static_cast<int>(group.code);
      const auto picture = std::ranges::find(kFindingPictures, code, &FindingPicture::code);
      std::string drawing;
      if (picture != kFindingPictures.end())
        drawing = fmt::format("<div class=\"example\"><img src=\"{}\" alt=\"An example\"></div>",
                              data_uri("image/svg+xml", picture->svg));
      std::string definition = markup_escape(code_definition(group.code));
      if (definition.empty()) definition = markup_escape(code_remedy(group.code));
      const std::string link = code_link(group.code);
      body_ += fmt::format("<dt id=\"what-{0}\"><span class=\"code\">{0}</span> {1}</dt><dd>{2}{3}{4}</dd>\n",
                           code, code_name(group.code), definition,
                           link.empty() ? "" : fmt::format(" <code>{}</code>", markup_escape(link)), drawing);
    }
    body_ += "</dl>\n";
    close();
  }

  void repeat(const std::string& command) {
    std::string line = command;
    if (line.empty()) {
      line = "plumbline check";
      for (const CheckedMesh& mesh :
           std::span(verdict_.meshes).first(std::min(verdict_.meshes.size(), kRowsShown)))
        line += " " + shell_word(mesh.path.empty() ? mesh.file : mesh.path);
      if (verdict_.meshes.size() > kRowsShown) line += " …";
    }
    open("repeat", "How to repeat it");
    body_ += fmt::format("<pre>{}</pre>\n", markup_escape(line));
    close();
  }

  const CheckVerdict& verdict_;
  const CheckPictures& pictures_;
  const CheckImages& images_;
  std::vector<CodeGroup> groups_;
  std::map<std::size_t, std::vector<const CheckSpot*>> spots_;
  std::string head_, nav_, body_;
};

}  // namespace

std::string check_page(const CheckVerdict& verdict, const CheckPictures& pictures, const CheckImages& images,
                       const std::string& command) {
  return CheckPage(verdict, pictures, images).write(command);
}

std::string check_html(const CheckVerdict& verdict, const CheckPictures& pictures,
                       const std::string& command) {
  return check_page(verdict, pictures, encode(pictures), command);
}

}  // namespace plumbline::reports
