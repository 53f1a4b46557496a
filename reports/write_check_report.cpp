// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "reports/check_page.h"
#include "reports/check_report.h"
#include "reports/check_words.h"
#include "reports/escape.h"
#include "reports/figures_json.h"
#include "reports/glb.h"
#include "reports/picture.h"
#include "scenarios/whole_file.h"

namespace plumbline::reports {
namespace {

namespace fs = std::filesystem;

constexpr const char* kErrorMap = "check.error_map.png";
constexpr const char* kCamera[] = {"check.camera.mesh.png", "check.camera.error.png",
                                   "check.camera.reference.png"};

/// Linear RGB: a plain grey, and a red that stands out from it in any light.
constexpr std::array<double, 3> kSurface{0.45, 0.5, 0.52}, kMarked{0.75, 0.02, 0.02};

/// As spots are named, "01-crack-….glb": what else lies there is the user's.
bool is_spot(const fs::path& path) {
  const std::string name = path.filename().string();
  const auto digit = [&](std::size_t k) { return name[k] >= '0' && name[k] <= '9'; };
  return path.extension() == ".glb" && name.size() > 3 && digit(0) && digit(1) && name[2] == '-';
}

/// Those of an earlier check in the same folder would pass for this one's.
void remove_old(const fs::path& out) {
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(out / "spots", error))
    if (is_spot(entry.path())) old.push_back(entry.path());
  old.push_back(out / "images" / kErrorMap);
  for (const char* name : kCamera) old.push_back(out / "images" / name);
  for (const fs::path& path : old) fs::remove(path, error);
}

}  // namespace

std::string spot_file(const verdict::CheckSpot& spot) { return file_stem(spot.name) + ".glb"; }

std::string spot_glb(const verdict::CheckVerdict& verdict, const verdict::CheckSpot& spot) {
  std::vector<bool> marked(spot.mesh.triangles.size(), false);
  for (const std::uint32_t t : spot.marked)
    if (t < marked.size()) marked[t] = true;
  GlbPart surface{"surface", kSurface, {}}, witnesses{"witnesses", kMarked, {}};
  for (std::uint32_t t = 0; t < marked.size(); ++t) (marked[t] ? witnesses : surface).triangles.push_back(t);
  Json extras = Json::object();
  if (spot.finding < verdict.findings.size()) {
    const verdict::CheckFinding& finding = verdict.findings[spot.finding];
    extras = {{"code", static_cast<int>(finding.finding.code)},
              {"name", code_name(finding.finding.code)},
              {"message", message_words(finding)},
              {"mesh", whose(verdict, finding)},
              {"at", xyz(finding.at)},
              {"frame_at", xyz(finding.finding.at)}};
  }
  return glb_bytes(spot.name, spot.mesh, {surface, witnesses}, extras);
}

CheckImages encode(const verdict::CheckPictures& pictures) {
  CheckImages out;
  if (!pictures.error_map_m.values.empty()) out.error_map = png_bytes(difference_map(pictures.error_map_m));
  if (pictures.camera) out.camera = encode(std::span(&*pictures.camera, 1)).front();
  return out;
}

void write_check_report(const verdict::CheckVerdict& verdict, const verdict::CheckPictures& pictures,
                        const fs::path& out, const std::string& command) {
  write_whole_file(out / "check.json", check_json(verdict));
  write_whole_file(out / "check.sarif", check_sarif(verdict));
  write_whole_file(out / "check.txt", check_text(verdict, Listing::full));
  remove_old(out);
  for (const verdict::CheckSpot& spot : pictures.spots)
    if (const std::string glb = spot_glb(verdict, spot); !glb.empty())
      write_whole_file(out / "spots" / spot_file(spot), glb);
  const CheckImages images = encode(pictures);
  if (!images.error_map.empty()) write_whole_file(out / "images" / kErrorMap, images.error_map);
  if (images.camera) {
    const std::array pictures_taken{&images.camera->mesh, &images.camera->error, &images.camera->reference};
    for (std::size_t k = 0; k < pictures_taken.size(); ++k)
      if (!pictures_taken[k]->empty()) write_whole_file(out / "images" / kCamera[k], *pictures_taken[k]);
  }
  // Last: who finds a page finds what it speaks of.
  write_whole_file(out / "check.html", check_page(verdict, pictures, images, command));
}

}  // namespace plumbline::reports
