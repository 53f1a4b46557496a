// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quantized-mesh tiles: which there are, each as a subject, held to its format.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "oracle/tile_conformance.h"
#include "properties/check/tiles.h"
#include "scenarios/error.h"
#include "scenarios/portable_math.h"
#include "scenarios/tiles/ecef.h"
#include "scenarios/whole_file.h"

namespace plumbline::checking {
namespace {

namespace fs = std::filesystem;
using oracle::FindingCode;
using oracle::Severity;

/// A tile's place, with y from the south: what neighbours are found by.
using Key = std::tuple<int, std::uint32_t, std::uint32_t>;

Vec2 metres_per_step(const TileBounds& bounds) {
  const double middle = 0.5 * (bounds.south + bounds.north) * kRadiansPerDegree;
  const double per_degree = kWgs84SemiMajorM * kRadiansPerDegree;
  return {(bounds.east - bounds.west) * per_degree * exact_cos(middle) / kTileSteps,
          (bounds.north - bounds.south) * per_degree / kTileSteps};
}

}  // namespace

void add_tile_folder(const fs::path& folder, std::vector<TileSource>& tiles, std::vector<std::string>& notes,
                     std::vector<verdict::CheckFinding>& findings) {
  const TileSet set = read_tile_set(folder);
  for (const std::string& note : set.layer.notes) notes.push_back(note);
  for (const TileFile& file : set.tiles)
    tiles.push_back({file.path, tile_name(file.address) + ".terrain", file.address, set.layer.grid, folder});
  if (set.tiles.empty())
    throw InputError(fmt::format(
        "{}: no tile lies where the grid has a place for it (level/x/y.terrain, numbers without leading "
        "zeros), the first that does not: {}",
        one_line(folder.generic_string()), one_line(set.misplaced.front().generic_string())));
  if (!set.misplaced.empty()) {
    verdict::CheckFinding& found = findings.emplace_back();
    found.finding.code = FindingCode::tile_encoding;
    found.finding.kind = "misplaced_tile";
    found.finding.severity = Severity::hazard;
    found.file = set.misplaced.front().generic_string();
    found.message = fmt::format("{} file{} in no place of the grid, the first: {}; clients never ask for {}",
                                set.misplaced.size(), set.misplaced.size() == 1 ? " lies" : "s lie",
                                found.file, set.misplaced.size() == 1 ? "it" : "them");
  }
  const TileAvailability availability = compare_availability(set);
  if (availability.missing > 0) {
    verdict::CheckFinding& found = findings.emplace_back();
    found.finding.code = FindingCode::tile_encoding;
    found.finding.kind = "missing_tile";
    found.file = (folder / "layer.json").generic_string();
    std::string first;
    if (!availability.first_missing.empty()) {
      const TileAddress& address = availability.first_missing.front();
      const Vec2 middle = set.layer.grid.position_deg(address, kTileSteps * 0.5, kTileSteps * 0.5);
      found.at = {middle.x, middle.y, 0};
      first = ", the first: " + tile_name(address);
    }
    found.message = fmt::format(
        "{} of {} tiles that layer.json advertises {} not there{}; clients ask for {} and "
        "get nothing",
        availability.missing, availability.advertised, availability.missing == 1 ? "is" : "are", first,
        availability.missing == 1 ? "it" : "them");
  }
  if (availability.unadvertised > 0)
    notes.push_back(
        fmt::format("{} tiles are there that layer.json does not advertise, the first: {}; clients never "
                    "ask for them",
                    availability.unadvertised, tile_name(availability.first_unadvertised.front())));
}

void add_tile_file(const fs::path& file, std::vector<TileSource>& tiles, std::vector<std::string>& notes,
                   std::map<fs::path, std::optional<TileGrid>>& layers) {
  TileSource source{file, file.generic_string(), tile_address(file), {}, {}};
  if (!source.address) {
    notes.push_back(
        fmt::format("{} does not say where it lies: its path does not end in "
                    "level/x/y.terrain, so it is judged by itself alone",
                    file.generic_string()));
  } else {
    source.name = tile_name(*source.address) + ".terrain";
    source.root = fs::absolute(file).parent_path().parent_path().parent_path();
    const fs::path layer = source.root / "layer.json";
    const auto [known, is_new] = layers.try_emplace(layer);
    std::error_code error;
    if (is_new && fs::is_regular_file(layer, error))
      known->second = parse_tile_layer(read_whole_file(layer, "layer.json"), layer.generic_string()).grid;
    if (known->second) {
      source.grid = *known->second;
    } else if (std::find(notes.begin(), notes.end(), kNoLayer) == notes.end()) {
      notes.emplace_back(kNoLayer);
    }
    if (!source.grid.contains(*source.address))
      throw InputError(fmt::format("{}: the grid has no such tile; level, column and row must fit",
                                   one_line(file.generic_string())));
  }
  tiles.push_back(std::move(source));
}

void choose_drawn(Examination& exam) {
  std::set<Key> there;
  for (const Subject& subject : exam.subjects) {
    if (!subject.tile || !subject.tile->placed) continue;
    there.insert({subject.tile->level, subject.tile->x, subject.tile->y});
  }
  std::size_t covered = 0, in_part = 0;
  for (Subject& subject : exam.subjects) {
    if (!subject.tile || !subject.tile->placed) continue;
    TilePlace& tile = *subject.tile;
    std::size_t children = 0;
    for (const std::uint32_t i : {0u, 1u}) {
      for (const std::uint32_t j : {0u, 1u})
        children += there.count({tile.level + 1, 2 * tile.x + i, 2 * tile.y + j});
    }
    tile.drawn = children == 0;
    covered += children > 0;
    in_part += children > 0 && children < 4;
  }
  if (covered == 0) return;
  std::string note =
      fmt::format("{} tile{} deeper ones above {}: heights and pictures speak of the deepest tiles", covered,
                  covered == 1 ? " has" : "s have", covered == 1 ? "it" : "them");
  if (in_part > 0)
    note +=
        fmt::format("; {} of {} over a part only, and the rest of that was not looked at", in_part, covered);
  exam.verdict.notes.push_back(std::move(note));
}

Subject read_tile(const TileSource& source) {
  const QuantizedMesh tile = read_quantized_mesh(source.path);
  Subject subject;
  subject.facts.file = source.name;
  subject.facts.path = source.path.generic_string();
  subject.facts.format = "quantized-mesh";
  TilePlace& place = subject.tile.emplace();
  place.low_m = static_cast<double>(tile.min_height_m);
  place.high_m = static_cast<double>(tile.max_height_m);
  std::optional<TileBounds> bounds;
  if (source.address) {
    bounds = source.grid.bounds_deg(*source.address);
    place.placed = true;
    place.grid = source.grid;
    place.address = *source.address;
    place.level = source.address->level;
    place.x = source.address->x;
    place.y = source.grid.row_from_south(*source.address);
    place.columns = source.grid.columns(place.level);
    place.metres_per_step = metres_per_step(*bounds);
  }
  for (std::size_t k = 0; k < tile.vertices(); ++k) {
    const double height = tile.height_m(k);
    subject.mesh.positions.push_back(
        {static_cast<double>(tile.u[k]), static_cast<double>(tile.v[k]), height});
    if (source.address) {
      const Vec2 deg = source.grid.position_deg(*source.address, tile.u[k], tile.v[k]);
      subject.places.push_back({deg.x, deg.y, height});
    }
    place.steps.push_back(tile.height[k]);
  }
  subject.mesh.triangles = tile.triangles;
  if (tile.normals.size() == tile.vertices()) subject.normals = tile.normals;
  for (const oracle::TileFinding& found : oracle::check_tile(tile, bounds)) {
    verdict::CheckFinding out = as_check_finding(found.finding, subject, verdict::kNoMesh, {});
    out.message = found.text;
    subject.findings.push_back(std::move(out));
  }
  return subject;
}

void quantize_border(Subject& subject) {
  const TilePlace& tile = *subject.tile;
  if (!std::isfinite(tile.low_m) || !std::isfinite(tile.high_m)) return;  // reported, and no number
  for (oracle::BorderEdge& edge : subject.border.edges) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int32_t step = tile.steps[edge.vertices[k]];
      if (step < 0 || step > kTileSteps) continue;  // out of range: reported, and compared as decoded
      edge.height[k] = {tile.low_m, tile.high_m, static_cast<std::uint32_t>(step), 0};
    }
  }
}

}  // namespace plumbline::checking
