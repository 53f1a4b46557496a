// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include <fmt/format.h>

#include "reports/check_report.h"
#include "reports/check_words.h"
#include "reports/digest.h"
#include "reports/json_text.h"
#include "reports/wrapped_text.h"

namespace plumbline::reports {
namespace {

using verdict::CheckedMesh;
using verdict::CheckVerdict;
using verdict::SeamState;
using verdict::SeamVerdict;

/// How many entries of each list a brief text shows.
constexpr std::size_t kMeshes = 6, kFindingsOfACode = 4, kTileKinds = 10, kCodes = 8, kOpenSeams = 6,
                      kCoveredSeams = 3, kWatertightSeams = 2, kNotes = 12;

class CheckText {
 public:
  CheckText(const CheckVerdict& verdict, Listing listing) : verdict_(verdict), listing_(listing) {}

  std::string write() {
    const std::string words = headline_words(verdict_);
    text_.line(0, fmt::format("{}: {}{}{}", subject_words(verdict_), verdict_.sound ? "SOUND" : "FAULTY",
                              words.empty() ? "" : ": ", words));
    looked_at();
    for (const std::string& sentence : proved_sentences(verdict_)) text_.line(0, "Proved: " + sentence);
    if (verdict_.terrain && !verdict_.terrain->better_match.empty()) terrain(*verdict_.terrain);
    findings();
    seams();
    if (verdict_.terrain && verdict_.terrain->better_match.empty()) terrain(*verdict_.terrain);
    if (verdict_.reference) reference(*verdict_.reference);
    if (verdict_.image) image(*verdict_.image);
    shape();
    notes();
    return valid_utf8(text_.take());
  }

 private:
  [[nodiscard]] std::size_t cap(std::size_t brief) const {
    return listing_ == Listing::full ? std::numeric_limits<std::size_t>::max() : brief;
  }
  void more(std::size_t indent, std::size_t left, std::string_view of = {}) {
    if (left > 0) text_.line(indent, fmt::format("… and {} more{}", left, of));
  }

  static std::string how_held(const CheckedMesh& mesh) {
    return mesh.terrain
               ? fmt::format("as terrain, held to {}", mesh.domain.empty() ? "its domain" : mesh.domain)
               : "as an object in space";
  }

  void looked_at() {
    const auto counts = [](std::size_t triangles, std::size_t vertices) {
      return fmt::format("{} triangles, {} vertices", triangles, vertices);
    };
    if (verdict_.meshes.size() == 1) {
      const CheckedMesh& mesh = verdict_.meshes.front();
      text_.line(0, fmt::format("Looked at {} ({}): {}, {}.", mesh.file, mesh.format,
                                counts(mesh.triangles, mesh.vertices), how_held(mesh)));
    } else {
      std::size_t triangles = 0, vertices = 0;
      std::map<std::string, std::size_t> ways;
      for (const CheckedMesh& mesh : verdict_.meshes) {
        triangles += mesh.triangles;
        vertices += mesh.vertices;
        ++ways[fmt::format("{}, {}", mesh.format, how_held(mesh))];
      }
      text_.line(0,
                 fmt::format("Looked at {} meshes: {}", verdict_.meshes.size(), counts(triangles, vertices)));
      const bool alike = ways.size() == 1;
      const bool few = verdict_.meshes.size() <= kMeshes || listing_ == Listing::full;
      if (alike || !few)
        for (const auto& [way, count] : ways)
          text_.line(2, fmt::format("{}{}", alike ? "each " : fmt::format("{} of them ", count), way));
      if (few)
        for (const CheckedMesh& mesh : verdict_.meshes)
          text_.line(2, fmt::format("{}: {}{}", mesh.file, counts(mesh.triangles, mesh.vertices),
                                    alike ? "" : fmt::format(", {}, {}", mesh.format, how_held(mesh))));
    }
    skirts();
    if (!verdict_.frame.empty()) text_.line(0, fmt::format("x, y, z: {}.", verdict_.frame));
  }

  void skirts() {
    std::size_t hung = 0, stated = 0;
    double least = std::numeric_limits<double>::infinity(), share = 1;
    for (const CheckedMesh& mesh : verdict_.meshes) {
      if (mesh.skirt.stated) ++stated;
      if (!(mesh.skirt.border_share > 0) && !mesh.skirt.stated) continue;  // walls elsewhere are no skirt
      ++hung;
      least = std::min(least, mesh.skirt.least_depth_m);
      share = std::min(share, mesh.skirt.border_share);
    }
    if (hung == 0) return;
    text_.line(2, fmt::format("skirts: {} of {} meshes have one{}, at least {} deep, along {}", hung,
                              verdict_.meshes.size(),
                              stated == 0 ? "" : fmt::format(" ({} as you said, not in the file)", stated),
                              metres(least),
                              share >= 1 ? std::string("all of the border")
                                         : fmt::format("{:.1f} % of the border or more", 100 * share)));
  }

  void findings() {
    const std::vector<CodeGroup> groups = group_findings(verdict_);
    if (groups.empty()) return;
    const std::size_t total = std::max(verdict_.findings_total, verdict_.findings.size());
    text_.heading(fmt::format("Findings, worst first ({}{})", total,
                              total > verdict_.findings.size()
                                  ? fmt::format("; the worst {} are listed", verdict_.findings.size())
                                  : ""));
    for (const CodeGroup& group : std::span(groups).first(std::min(groups.size(), cap(kCodes)))) {
      const std::string link = code_link(group.code);
      text_.line(2, fmt::format("{} {}{}, {}{}{}", static_cast<int>(group.code), code_name(group.code),
                                group.hazard ? " (hazard)" : "", group.exact ? "" : "at least ",
                                group.count == 1 ? std::string("once") : fmt::format("{} times", group.count),
                                link.empty() ? "" : ": " + link));
      std::size_t shown = 0;
      std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
      std::set<std::string> kinds;
      const bool by_kind = group.code == oracle::FindingCode::tile_encoding;
      const std::size_t most = cap(by_kind ? kTileKinds : kFindingsOfACode);
      for (const std::size_t i : group.listed) {
        if (shown == most) break;
        const verdict::CheckFinding& one = verdict_.findings[i];
        // Of one seam the worst place is enough to begin with.
        if (listing_ == Listing::brief && one.other_mesh != verdict::kNoMesh &&
            !pairs.insert(std::minmax(one.mesh, one.other_mesh)).second)
          continue;
        if (listing_ == Listing::brief && by_kind && !kinds.insert(one.finding.kind).second) continue;
        finding(one);
        ++shown;
      }
      more(4, group.count - shown);
    }
    more(2, groups.size() - std::min(groups.size(), cap(kCodes)), " codes");
  }

  void finding(const verdict::CheckFinding& finding) {
    std::vector<std::string> parts;
    if (const std::string mesh = whose(verdict_, finding); !mesh.empty()) parts.push_back(mesh);
    if (!finding.finding.kind.empty()) parts.push_back(finding.finding.kind);
    if (const std::string size = size_words(finding.finding); !size.empty()) parts.push_back(size);
    text_.line(4, fmt::format("at {}: {}", place_words(finding.at), fmt::join(parts, ", ")), 4);
    if (!finding.message.empty()) text_.line(6, finding.message, 0);
  }

  void seams() {
    if (verdict_.seams.empty()) return;
    text_.heading(
        fmt::format("Seams: {} shared border{}: {} (gaps: height of the first mesh minus the second)",
                    verdict_.seams.size(), verdict_.seams.size() == 1 ? "" : "s",
                    seam_totals_words(seam_totals(verdict_))));
    for (const auto& [state, brief] :
         {std::pair{SeamState::open, kOpenSeams}, std::pair{SeamState::covered_by_skirt, kCoveredSeams},
          std::pair{SeamState::watertight, kWatertightSeams}}) {
      const bool dull = state == SeamState::watertight && verdict_.seams.size() > kCoveredSeams;
      const std::size_t most = dull && listing_ == Listing::brief ? 0 : cap(brief);
      std::size_t seen = 0;
      for (const SeamVerdict& one : verdict_.seams)
        if (one.state == state && ++seen <= most) seam(one);
      more(2, seen - std::min(seen, most), fmt::format(" {}", verdict::seam_state_name(state)));
    }
    const std::string advice = skirt_advice(verdict_);
    const SeamVerdict* worst = worst_seam(verdict_);
    if (worst != nullptr && advice.empty())
      text_.line(2, fmt::format("Worst pair: {} and {}, {} apart at {}.", mesh_name(verdict_, worst->mesh),
                                mesh_name(verdict_, worst->other_mesh),
                                metres(std::fabs(worst->largest_gap_m)), place_words(worst->largest_at)));
    if (!advice.empty()) text_.line(2, advice);
  }

  void seam(const SeamVerdict& seam) {
    const std::string first = mesh_name(verdict_, seam.mesh), second = mesh_name(verdict_, seam.other_mesh);
    text_.line(2, fmt::format(
                      "{}: {} | {}, {}{}", verdict::seam_state_name(seam.state), first, second,
                      metres(seam.length_m),
                      seam.level < 0 ? "" : fmt::format(", levels {} and {}", seam.level, seam.other_level)));
    if (seam.largest_gap_m != 0)
      text_.line(6,
                 fmt::format("largest gap {} at {}; mean {}, of the size {}; {}, {}",
                             signed_metres(seam.largest_gap_m), place_words(seam.largest_at),
                             signed_metres(seam.mean_gap_m), metres(seam.mean_abs_gap_m),
                             counted_code(oracle::FindingCode::crack, seam.cracks),
                             counted_code(oracle::FindingCode::t_junction, seam.t_junctions)),
                 0);
    else if (seam.t_junctions > 0)
      text_.line(6, fmt::format("{} at equal heights",
                                counted_code(oracle::FindingCode::t_junction, seam.t_junctions)));
    std::vector<std::string> parts;
    if (seam.largest_gap_m != 0 && verdict::is_rounding(seam, seam.largest_gap_m))
      parts.push_back(
          fmt::format("one step of the tiles' heights is {}: the gap is no more than their rounding",
                      metres(seam.quantum_m)));
    std::vector<std::string> skirts;
    if (seam.least_skirt_m > 0)
      skirts.push_back(fmt::format("{} on {}", sufficient_metres(seam.least_skirt_m), first));
    if (seam.least_skirt_other_m > 0)
      skirts.push_back(fmt::format("{} on {}", sufficient_metres(seam.least_skirt_other_m), second));
    if (!skirts.empty()) parts.push_back(fmt::format("skirts that suffice: {}", fmt::join(skirts, ", ")));
    if (seam.normal_max_deg > 0)
      parts.push_back(fmt::format("normals differ by up to {}°", short_number(seam.normal_max_deg)));
    if (!parts.empty()) text_.line(6, fmt::format("{}", fmt::join(parts, "; ")), 0);
  }

  void terrain(const verdict::TerrainVerdict& terrain) {
    text_.heading(fmt::format("Against {}", terrain.file));
    if (!terrain.better_match.empty())
      text_.line(2, fmt::format("MATCHES IF {}: mend that first; what follows was measured without it.",
                                terrain.better_match));
    if (!terrain.reading.empty()) text_.line(2, "read as: " + terrain.reading);
    if (!terrain.placing.empty()) text_.line(2, "laid over it: " + terrain.placing);
    if (!(terrain.vertical_m.area_m2 > 0)) return text_.line(2, "nothing was judged: no plan area in common");
    text_.line(2, fmt::format("largest vertical error {} at {}; certain, whichever way the DEM's cells are "
                              "split: {} at {}",
                              metres(terrain.vertical_m.max), place_words(terrain.at),
                              metres(terrain.vertical_m.certain_max), place_words(terrain.certain_at)));
    text_.line(2, fmt::format("RMS {}, mean {}; at the samples alone up to {} at {}",
                              metres(terrain.vertical_m.rms), metres(terrain.vertical_m.mean),
                              metres(terrain.samples_max_m), place_words(terrain.samples_at)));
    text_.line(
        2, fmt::format("judged: {} % of the mesh's plan area; the DEM's own ambiguity between samples "
                       "is {}",
                       short_number(100 * terrain.judged_share, 4), metres(terrain.diagonal_ambiguity_m)));
    if (!terrain.declared_m) return;
    text_.line(2, fmt::format("The declared bound of {}:", metres(*terrain.declared_m)));
    for (const DeclaredWords& words : declared_words(terrain)) text_.line(4, words.sentence);
  }

  void reference(const verdict::ReferenceVerdict& reference) {
    const oracle::Likeness& likeness = reference.likeness;
    const auto interval = [](oracle::CertifiedDistance distance) {
      return fmt::format("{} to {}", short_number(distance.least_m), metres(distance.most_m));
    };
    text_.heading(fmt::format("Against {}", reference.file));
    text_.line(2, fmt::format("Hausdorff distance, certified: {} (of the reference from the mesh {}, of the "
                              "mesh from the reference {})",
                              interval(likeness.hausdorff()), interval(likeness.to_mesh),
                              interval(likeness.from_mesh)));
    text_.line(2, fmt::format("normals differ by {}° on average, {}° at most; turned over: {} % of the area",
                              short_number(likeness.normal_mean_deg), short_number(likeness.normal_max_deg),
                              short_number(100 * likeness.turned_share)));
    for (const DeclaredWords& words : declared_words(reference)) text_.line(2, words.sentence);
  }

  void image(const verdict::ImageVerdict& image) {
    const Camera& camera = image.camera;
    text_.heading(fmt::format("Seen from {}, {} x {} pixels, {}° high", place_words(camera.position),
                              camera.width_px, camera.height_px, short_number(camera.fov_y_deg)));
    text_.line(2, fmt::format("{} pixels see the mesh, {} of them a skirt's wall; visible findings: {}",
                              image.mesh_px, image.skirt_px, image.visible_findings));
    if (!image.against_terrain) return;
    const oracle::PixelFigure& px = image.image.displacement_px;
    if (px.count == 0)
      return text_.line(2, "displacement: no pixel sees both surfaces, so nothing was judged");
    text_.line(2,
               fmt::format("displacement: 99 % of {} pixels within {} px, largest {} px, RMS {} px; over the "
                           "threshold {} %; without a mesh below {} px",
                           px.count, short_number(px.p99), short_number(px.max), short_number(px.rms),
                           short_number(100 * image.image.over_threshold), image.image.uncovered_px));
    text_.line(2, fmt::format("silhouette: {} pixels differ, by up to {} px", image.image.silhouette_pixels,
                              short_number(image.image.silhouette_max_px)));
  }

  void shape() {
    std::size_t slivers = 0, surfaces = 0;
    const CheckedMesh *thinnest = nullptr, *shortest = nullptr;
    for (const CheckedMesh& mesh : verdict_.meshes) {
      if (mesh.triangles == 0) continue;
      if (shortest == nullptr || mesh.shortest_edge_m < shortest->shortest_edge_m) shortest = &mesh;
      if (!mesh.terrain) continue;
      ++surfaces;
      slivers += mesh.shape.slivers;
      if (thinnest == nullptr || mesh.shape.min_quality < thinnest->shape.min_quality) thinnest = &mesh;
    }
    if (shortest == nullptr) return;
    const auto named = [&](const CheckedMesh* mesh) {
      return verdict_.meshes.size() == 1 ? std::string() : " in " + mesh->file;
    };
    std::string line = "Shape: ";
    if (surfaces > 0)
      line += fmt::format("{} sliver{}, least quality {}{}, least angle {}°; ",
                          slivers == 0 ? "no" : std::to_string(slivers), slivers == 1 ? "" : "s",
                          short_number(thinnest->shape.min_quality), named(thinnest),
                          short_number(thinnest->shape.least_angle_deg));
    line += fmt::format("shortest edge {}{}, median {}.", metres(shortest->shortest_edge_m), named(shortest),
                        metres(shortest->median_edge_m));
    if (!verdict_.findings.empty() || !verdict_.seams.empty() || verdict_.terrain || verdict_.reference ||
        verdict_.image)
      return text_.heading(line);
    text_.line(0, line);
  }

  void notes() {
    if (verdict_.notes.empty()) return;
    text_.heading("Notes");
    const std::size_t shown = std::min(verdict_.notes.size(), cap(kNotes));
    for (const std::string& note : std::span(verdict_.notes).first(shown)) text_.line(2, "- " + note);
    more(2, verdict_.notes.size() - shown);
  }

  const CheckVerdict& verdict_;
  Listing listing_;
  WrappedText text_;
};

}  // namespace

std::string check_text(const CheckVerdict& verdict, Listing listing) {
  return CheckText(verdict, listing).write();
}

}  // namespace plumbline::reports
