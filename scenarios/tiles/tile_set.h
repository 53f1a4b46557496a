// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/tiles/tile_grid.h"

namespace plumbline {

/// Tiles that a layer.json advertises; ends included.
struct TileRange {
  int level = 0;
  std::uint32_t west = 0, first_y = 0, east = 0, last_y = 0;  ///< y as the scheme counts it
};

/// What a layer.json says (github.com/CesiumGS/quantized-mesh, SPECIFICATION.md).
struct TileLayer {
  TileGrid grid;
  std::optional<int> least_level, deepest_level;  ///< minzoom, maxzoom
  TileBounds bounds_deg{-180, -90, 180, 90};
  std::vector<std::string> extensions;
  /// Advertised tiles; ranges may overlap. Not `advertises`: the file says nothing about it.
  bool advertises = false;
  std::vector<TileRange> available;
  /// What was missing and is assumed, and what is not followed; a sentence each.
  std::vector<std::string> notes;
};

/// Throws InputError, one line with `name` and the place, for what is no layer.json of quantized-mesh-1.0.
/// Ranges keep the size they have in the file, whatever they span.
TileLayer parse_tile_layer(std::string_view json, std::string_view name);

/// A tile and where it is kept.
struct TileFile {
  TileAddress address;
  std::filesystem::path path;
};

/// A folder of tiles: `<level>/<x>/<y>.terrain`, with a layer.json or without.
struct TileSet {
  std::filesystem::path folder;
  TileLayer layer;
  std::vector<TileFile> tiles;  ///< of the grid, by address; nothing is read of them yet
  /// Tiles that lie in no place of the grid, by path: names that are no numbers, columns and rows that the
  /// level does not have, levels beyond kDeepestTileLevel.
  std::vector<std::filesystem::path> misplaced;
};

/// Lists the folder. Throws InputError if it is none, cannot be read, has no tile, or its layer.json is bad.
TileSet read_tile_set(const std::filesystem::path& folder);

/// The tile of the set; null if there is none.
const TileFile* find_tile(const TileSet& set, const TileAddress& address);

/// Advertised tiles against files. Counts are complete; lists hold up to kMostListed, by address (of missing
/// tiles those that a search of bounded length finds).
struct TileAvailability {
  static constexpr std::size_t kMostListed = 100;
  std::uint64_t advertised = 0;    ///< tiles in the union of the ranges
  std::uint64_t missing = 0;       ///< advertised, and no file
  std::uint64_t unadvertised = 0;  ///< files that no range holds
  std::vector<TileAddress> first_missing, first_unadvertised;
};

/// Time n·log n in ranges and files, however many tiles the ranges span. All zero if the layer advertises
/// nothing.
TileAvailability compare_availability(const TileSet& set);

}  // namespace plumbline
