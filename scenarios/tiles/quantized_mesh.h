// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/vec.h"

namespace plumbline {

/// Lattice steps across a tile, and from the least to the greatest height of its header.
inline constexpr std::int32_t kTileSteps = 32767;

enum class TileSide { west, south, east, north };
/// In the order of the file's edge lists, and their names.
inline constexpr std::array<TileSide, 4> kTileSides{TileSide::west, TileSide::south, TileSide::east,
                                                    TileSide::north};
std::string_view tile_side_name(TileSide side);

/// A terrain tile of the format quantized-mesh-1.0 as its file has it: what the format forbids, but what can
/// be decoded, is kept, for oracle/tile_conformance.h to judge.
struct QuantizedMesh {
  Vec3 center;  ///< of the tile; as all places of the header Earth-centred, Earth-fixed (WGS84), metres
  float min_height_m = 0, max_height_m = 0;  ///< above the ellipsoid
  Vec3 sphere_center;                        ///< of the ball that holds the tile
  double sphere_radius_m = 0;
  Vec3 horizon_occlusion;  ///< unit: the ellipsoid's semi-axes

  /// Per vertex, in lattice steps: from the west, from the south, above min_height_m. [0, kTileSteps] if
  /// sound; a running sum beyond 32 bits is kept as the nearest value of 32 bits.
  std::vector<std::int32_t> u, v, height;
  /// Counter-clockwise from above. A code above the high-water mark makes an index that is too large: the
  /// difference modulo 2³².
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::array<std::vector<std::uint32_t>, 4> edges;  ///< by TileSide: the vertices on that side, as listed

  /// Unit vectors, Earth-centred; empty: no such extension. One a vertex if sound.
  std::vector<Vec3> normals;
  std::string water_mask;                ///< bytes of the extension; empty: none
  std::string metadata;                  ///< JSON, not looked into; empty: none
  std::vector<std::uint8_t> extensions;  ///< numbers of all that the file has, in its order
  std::size_t trailing_bytes = 0;        ///< that belong to nothing, inside and behind extensions

  [[nodiscard]] std::size_t vertices() const { return u.size(); }
  /// Metres of one step of height.
  [[nodiscard]] double height_step_m() const {
    return (static_cast<double>(max_height_m) - static_cast<double>(min_height_m)) / kTileSteps;
  }
  /// Above the ellipsoid; exact up to the rounding of its two multiplications and its sum, and exactly
  /// max_height_m at the top of the lattice. Requires: vertex < vertices().
  [[nodiscard]] double height_m(std::size_t vertex) const {
    const double low = static_cast<double>(min_height_m), high = static_cast<double>(max_height_m);
    return height[vertex] == kTileSteps ? high : low + (high - low) * height[vertex] / kTileSteps;
  }
};

/// Decodes a tile (github.com/CesiumGS/quantized-mesh, README.md), gzipped or not. Memory is bounded by the
/// bytes (at most twelve times as many, for two bytes make a normal; and scenarios/gzip.h), whatever their
/// counts say. Throws InputError, one line with `name`, the byte (of the inflated tile) and the part, if the
/// bytes end inside a part.
QuantizedMesh parse_quantized_mesh(std::string_view bytes, std::string_view name);
QuantizedMesh read_quantized_mesh(const std::filesystem::path& path);

/// The tile's bytes, not gzipped; indices of 32 bits from 65537 vertices on, as the format has it. The
/// extensions follow by their numbers: normals (rounded to two bytes each), water mask, metadata; each if it
/// is not empty. Decoding gives the same tile again (normals: rounded). Requires: u, v and height have one
/// length; neighbouring values differ by at most 32767; triangles name vertices in high-water order. Throws
/// std::invalid_argument for what the format cannot say.
std::string encode_quantized_mesh(const QuantizedMesh& tile);

/// The same tile with its vertices in order of first use, which is what high-water marks ask for; unused
/// vertices follow. Indices beyond the vertices stay.
QuantizedMesh in_high_water_order(const QuantizedMesh& tile);

}  // namespace plumbline
