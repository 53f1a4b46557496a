// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/check/examination.h"
#include "scenarios/tiles/tile_set.h"

namespace plumbline::checking {

/// A quantized-mesh tile to read.
struct TileSource {
  std::filesystem::path path;
  std::string name;                    ///< as the verdict calls it
  std::optional<TileAddress> address;  ///< none: its path does not tell; judged by itself alone
  TileGrid grid;
  std::filesystem::path root;  ///< the folder of the set that it belongs to
};

/// The tiles of a folder with its layer.json. Tiles that it advertises and does not hold, or that lie
/// nowhere, are findings, what else the folder gets wrong goes to the notes. Throws InputError if no tile is
/// left.
void add_tile_folder(const std::filesystem::path& folder, std::vector<TileSource>& tiles,
                     std::vector<std::string>& notes, std::vector<verdict::CheckFinding>& findings);
/// One file. A layer.json three folders up says which grid it belongs to; without, EPSG:4326 in TMS order.
/// `layers`: what has been read of layer.json files so far.
void add_tile_file(const std::filesystem::path& file, std::vector<TileSource>& tiles,
                   std::vector<std::string>& notes,
                   std::map<std::filesystem::path, std::optional<TileGrid>>& layers);
/// Reads and holds it to its format (findings 103). Throws InputError for what cannot be decoded.
Subject read_tile(const TileSource& source);

/// Sets TilePlace::drawn, and says so if that leaves tiles out.
void choose_drawn(Examination& exam);

/// Puts the exact heights of a tile's lattice onto its border.
void quantize_border(Subject& subject);

/// What is said once where tiles come without a layer.json.
inline constexpr const char* kNoLayer =
    "no layer.json beside the tiles: they are taken for EPSG:4326 in TMS order (rows from the south)";

/// Skirts that the client adds (CheckRequest::skirt_m, cesium_skirt), below every border edge. Requires:
/// judge_inside has been by.
void apply_stated_skirts(Examination& exam);

/// CesiumJS hangs a skirt of five times the level's geometric error below each tile
/// (GlobeSurfaceTile, CesiumTerrainProvider: 77 067.34 m at level 0 of two tiles, twice that of one, halved
/// with each level).
double cesium_skirt_m(const TileGrid& grid, int level);

}  // namespace plumbline::checking
