// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tiles of quantized-mesh-1.0, gzipped or not, and the oracle that holds them to their format.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "oracle/tile_conformance.h"
#include "scenarios/gzip.h"
#include "scenarios/tiles/quantized_mesh.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace plumbline;

/// Everything that the tile says, but its normals, which encoding rounds.
bool same(const QuantizedMesh& a, const QuantizedMesh& b) {
  const auto numbers = [](const QuantizedMesh& t) {
    std::vector<std::uint64_t> out;
    for (const double x :
         {t.center.x, t.center.y, t.center.z, static_cast<double>(t.min_height_m),
          static_cast<double>(t.max_height_m), t.sphere_center.x, t.sphere_center.y, t.sphere_center.z,
          t.sphere_radius_m, t.horizon_occlusion.x, t.horizon_occlusion.y, t.horizon_occlusion.z})
      out.push_back(std::bit_cast<std::uint64_t>(x));
    return out;
  };
  return numbers(a) == numbers(b) && a.u == b.u && a.v == b.v && a.height == b.height &&
         a.triangles == b.triangles && a.edges == b.edges && a.normals.size() == b.normals.size() &&
         a.water_mask == b.water_mask && a.metadata == b.metadata;
}

void require_bounded(const QuantizedMesh& tile, std::size_t bytes) {
  std::size_t least = 6 * tile.vertices() + 6 * tile.triangles.size() + 2 * tile.normals.size() +
                      tile.water_mask.size() + tile.metadata.size() + tile.trailing_bytes;
  for (const auto& edge : tile.edges) least += 2 * edge.size();
  fuzz::require(least <= bytes, "memory is bounded by the tile's size");
  fuzz::require(tile.u.size() == tile.v.size() && tile.u.size() == tile.height.size(),
                "a vertex has three numbers");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto read = [](std::string_view from) {
    return fuzz::accepted([&] { return parse_quantized_mesh(from, "a.terrain"); });
  };
  const auto tile = read(bytes);
  const auto again = read(bytes);
  fuzz::require(tile.has_value() == again.has_value(), "a second reading comes to the same verdict");
  if (!tile) return 0;
  fuzz::require(same(*tile, *again), "a second reading gives the same tile");
  require_bounded(*tile, is_gzip(bytes) ? std::max(kFreeInflated, kMostInflation * size) : size);

  const TileBounds bounds{7, 46, 8, 47};
  const auto blind = oracle::check_tile(*tile, std::nullopt);
  const auto placed = oracle::check_tile(*tile, bounds);
  fuzz::require(placed.size() == oracle::check_tile(*tile, bounds).size(), "a tile is judged alike twice");
  fuzz::require(blind.size() <= placed.size(), "bounds only add questions");
  try {
    const auto back = read(encode_quantized_mesh(*tile));
    fuzz::require(back.has_value() && same(*tile, *back), "what is encoded decodes to the same tile");
  } catch (const std::invalid_argument&) {
    return 0;  // what the format cannot say: a running sum that was cut off
  }
  return 0;
}
