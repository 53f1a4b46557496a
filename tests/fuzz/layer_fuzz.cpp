// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// layer.json, and its ranges against a folder of a few tiles.
#include <cstdint>

#include "scenarios/tiles/tile_set.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  const std::string_view json(reinterpret_cast<const char*>(data), size);
  const auto layer = fuzz::accepted([&] { return parse_tile_layer(json, "layer.json"); });
  if (!layer) return 0;
  constexpr std::size_t kShortestRange = 40;  // {"startX":0,"startY":0,"endX":0,"endY":0}
  fuzz::require(layer->available.size() * kShortestRange <= size, "ranges are bounded by the file's size");
  fuzz::require(layer->advertises || layer->available.empty(), "who says nothing advertises nothing");
  TileSet set;
  set.layer = *layer;
  std::uint64_t tiles = 0;
  for (const TileAddress& address : {TileAddress{0, 0, 0}, {1, 1, 1}, {2, 0, 3}, {2, 3, 0}, {9, 300, 200}}) {
    if (set.layer.grid.contains(address)) set.tiles.push_back({address, ""});
  }
  tiles = set.tiles.size();
  const TileAvailability found = compare_availability(set);
  fuzz::require(found.missing <= found.advertised, "what is missing was advertised");
  fuzz::require(found.first_missing.size() <= found.missing, "listed tiles are counted");
  if (layer->advertises)
    fuzz::require(found.advertised - found.missing + found.unadvertised == tiles,
                  "every tile is advertised or not");
  for (const TileAddress& address : found.first_missing)
    fuzz::require(find_tile(set, address) == nullptr, "what is missing is not there");
  return 0;
}
