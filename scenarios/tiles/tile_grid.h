// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "scenarios/tiles/quantized_mesh.h"
#include "scenarios/vec.h"

namespace plumbline {

/// Deepest level that is read: places on the lattice below it take 42 bits, so that their differences and
/// products of a place with a height step are exact in double. A lattice step is 0.02 mm there.
inline constexpr int kDeepestTileLevel = 25;

/// A tile as its path names it; ordered by level, x, y.
struct TileAddress {
  int level = 0;
  std::uint32_t x = 0, y = 0;
  friend auto operator<=>(const TileAddress&, const TileAddress&) = default;
};
/// "9/533/383".
std::string tile_name(const TileAddress& address);
/// From the last three components, "…/9/533/383.terrain": plain numbers without sign or leading zeros, the
/// level up to kDeepestTileLevel; none otherwise.
std::optional<TileAddress> tile_address(const std::filesystem::path& path);

/// What the tiles divide.
enum class TileProjection {
  geographic,  ///< EPSG:4326: two tiles at level 0, side by side
  mercator,    ///< EPSG:3857: one tile at level 0
};
/// From where rows are counted.
enum class TileScheme {
  tms,  ///< y counts from the south
  xyz,  ///< y counts from the north ("slippyMap")
};

/// A tile's rectangle, degrees.
struct TileBounds {
  double west = 0, south = 0, east = 0, north = 0;
  friend bool operator==(const TileBounds&, const TileBounds&) = default;
};

/// Which tile lies where. Every function but `contains` requires an address of the grid.
struct TileGrid {
  TileProjection projection = TileProjection::geographic;
  TileScheme scheme = TileScheme::tms;

  /// Requires: level in [0, kDeepestTileLevel].
  [[nodiscard]] std::uint32_t columns(int level) const {
    return (projection == TileProjection::geographic ? 2U : 1U) << static_cast<unsigned>(level);
  }
  [[nodiscard]] static std::uint32_t rows(int level) { return 1U << static_cast<unsigned>(level); }
  /// Whether there is such a tile.
  [[nodiscard]] bool contains(const TileAddress& address) const;
  /// y counted from the south, whatever the scheme.
  [[nodiscard]] std::uint32_t row_from_south(const TileAddress& address) const;

  /// In degrees of longitude and latitude. Tiles that touch have the same bits on their common side.
  [[nodiscard]] TileBounds bounds_deg(const TileAddress& address) const;
  /// In the projection's own unit: degrees, or metres of Mercator (sphere of 6378137 m).
  [[nodiscard]] TileBounds bounds_projected(const TileAddress& address) const;

  /// The tile of the same level beyond that side. The world closes at the antimeridian; there is none beyond
  /// the poles (Mercator: 85.05°).
  [[nodiscard]] std::optional<TileAddress> neighbour(const TileAddress& address, TileSide side) const;
  /// None above level 0.
  [[nodiscard]] static std::optional<TileAddress> parent(const TileAddress& address);
  /// South-west, south-east, north-west, north-east. Requires: level < kDeepestTileLevel.
  [[nodiscard]] std::array<TileAddress, 4> children(const TileAddress& address) const;

  /// Longitude (x) and latitude (y), degrees, of a place on the tile's lattice; both run evenly from bound to
  /// bound, with Mercator, too, as the format says. Equal places of the geographic lattice, also of tiles of
  /// different levels, get the same bits. Any u and v: the lattice goes on outside the tile.
  [[nodiscard]] Vec2 position_deg(const TileAddress& address, double u, double v) const;

  /// The same place in steps of level `finest`'s lattice, x east of the western edge of the world, y north of
  /// its southern one: whole numbers, exact. Two tiles' places are equal if and only if these are, with two
  /// exceptions for the caller: x = lattice_width is x = 0 again; and with Mercator, where latitude runs
  /// evenly only inside a tile, rows of different levels agree at the tiles' borders alone. Requires:
  /// address.level ≤ finest ≤ kDeepestTileLevel.
  [[nodiscard]] Vec2 lattice(const TileAddress& address, std::int32_t u, std::int32_t v, int finest) const;
  [[nodiscard]] double lattice_width(int finest) const;
};

}  // namespace plumbline
