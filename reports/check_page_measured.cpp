// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "reports/check_page_parts.h"
#include "reports/check_words.h"
#include "reports/digest.h"
#include "reports/escape.h"

namespace plumbline::reports {
namespace {

std::string tag(bool good, std::string_view word) {
  return fmt::format("<span class=\"tag {}\">{}</span>", good ? "good" : "bad", word);
}

std::string bounds(const std::vector<DeclaredWords>& all) {
  if (all.empty()) return {};
  std::string out = "<ul class=\"bounds\">\n";
  for (const DeclaredWords& words : all)
    out += fmt::format("<li>{}<span>{}</span></li>\n", tag(words.holds, words.word),
                       markup_escape(words.sentence));
  return out + "</ul>\n";
}

}  // namespace

std::string data_uri(std::string_view type, std::string_view bytes) {
  return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string fact(std::string_view name, std::string_view value) {
  return value.empty() ? std::string()
                       : fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, markup_escape(value));
}

std::string terrain_part(const verdict::TerrainVerdict& terrain, const std::string& error_map,
                         const verdict::Extent& map_box) {
  std::string out;
  if (!terrain.better_match.empty())
    out += fmt::format(
        "<p class=\"alarm\">The mesh matches if {}. Mend that first: what follows was "
        "measured without it.</p>\n",
        markup_escape(terrain.better_match));
  const oracle::VerticalError& error = terrain.vertical_m;
  const bool any = error.area_m2 > 0;
  std::string facts = "<dl class=\"facts\">\n";
  if (any)
    facts +=
        fact("Largest vertical error", fmt::format("{} at {}", metres(error.max), place_words(terrain.at))) +
        fact("Certain, whichever way the DEM's cells are split",
             fmt::format("{} at {}", metres(error.certain_max), place_words(terrain.certain_at))) +
        fact("RMS, mean", fmt::format("{}, {}", metres(error.rms), metres(error.mean))) +
        fact("At the samples alone",
             fmt::format("{} at {}", metres(terrain.samples_max_m), place_words(terrain.samples_at)));
  facts += fact("Judged",
                any ? fmt::format("{} % of the mesh's plan area", short_number(100 * terrain.judged_share, 4))
                    : "nothing: no plan area in common") +
           fact("The DEM's own ambiguity between samples", metres(terrain.diagonal_ambiguity_m)) +
           fact("Read as", terrain.reading) + fact("Laid over it", terrain.placing) + "</dl>\n";
  if (terrain.declared_m) {
    out += fmt::format("<h3>The declared bound of {}</h3>\n", metres(*terrain.declared_m));
    out += bounds(declared_words(terrain));
  }
  if (error_map.empty()) return out + facts;
  return out +
         fmt::format(
             "<div class=\"two\"><figure class=\"frame picture-wide\"><img src=\"{}\" alt=\"Error map\">"
             "<figcaption>Mesh minus DEM, metres, north up: blue where the mesh lies too low, red where too "
             "high, "
             "grey where nothing was judged. From {} to {}. The ring marks the largest that this grid hits."
             "</figcaption></figure>\n{}</div>\n",
             data_uri("image/png", error_map), place_words(Vec2{map_box.low.x, map_box.low.y}),
             place_words(Vec2{map_box.high.x, map_box.high.y}), facts);
}

std::string reference_part(const verdict::ReferenceVerdict& reference) {
  const oracle::Likeness& likeness = reference.likeness;
  const auto interval = [](oracle::CertifiedDistance distance) {
    return fmt::format("{} to {}", short_number(distance.least_m), metres(distance.most_m));
  };
  return bounds(declared_words(reference)) + "<dl class=\"facts\">\n" +
         fact("Hausdorff distance, certified", interval(likeness.hausdorff())) +
         fact("Of the reference from the mesh", interval(likeness.to_mesh)) +
         fact("Of the mesh from the reference", interval(likeness.from_mesh)) +
         fact("Normals differ, mean and largest",
              fmt::format("{}°, {}°", short_number(likeness.normal_mean_deg),
                          short_number(likeness.normal_max_deg))) +
         fact("Turned over", fmt::format("{} % of the area", short_number(100 * likeness.turned_share))) +
         "</dl>\n";
}

std::string image_part(const verdict::ImageVerdict& image, const std::optional<EncodedFrame>& pictures) {
  const oracle::PixelFigure& px = image.image.displacement_px;
  std::string out = "<dl class=\"facts\">\n" +
                    fact("Pixels that see the mesh", std::to_string(image.mesh_px)) +
                    fact("A skirt's wall before anything else", fmt::format("{} pixels", image.skirt_px)) +
                    fact("Findings that are visible", std::to_string(image.visible_findings));
  if (image.against_terrain)
    out += fact("Displacement: 99 %, largest, RMS",
                px.count == 0 ? "nothing was judged"
                              : fmt::format("{} px, {} px, {} px", short_number(px.p99), short_number(px.max),
                                            short_number(px.rms))) +
           fact("Over the threshold",
                fmt::format("{} % of {} pixels", short_number(100 * image.image.over_threshold), px.count)) +
           fact("Without a mesh below", fmt::format("{} pixels", image.image.uncovered_px)) +
           fact("Silhouette", fmt::format("{} pixels differ, by up to {} px", image.image.silhouette_pixels,
                                          short_number(image.image.silhouette_max_px)));
  out += "</dl>\n";
  if (pictures) {
    out += "<div class=\"triptych\"><div>\n";
    for (const auto& [png, words] :
         {std::pair{&pictures->mesh, "the mesh, with its edges"}, std::pair{&pictures->error, "displacement"},
          std::pair{&pictures->reference, "the reference"}}) {
      if (png->empty()) continue;
      out += fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                         data_uri("image/png", *png), words, words);
    }
    out += "</div></div>\n";
  }
  return out;
}

}  // namespace plumbline::reports
