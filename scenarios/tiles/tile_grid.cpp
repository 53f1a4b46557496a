// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/tiles/tile_grid.h"

#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "scenarios/portable_math.h"

namespace plumbline {
namespace {

constexpr double kMercatorRadiusM = 6378137;
constexpr double kEuler = 2.718281828459045;

std::optional<std::uint32_t> plain_number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  if (!whole || (text.size() > 1 && text.front() == '0')) return std::nullopt;
  return value;
}

double power_of_two(int exponent) {
  return static_cast<double>(std::uint64_t{1} << static_cast<unsigned>(exponent));
}

/// Degrees of latitude at `t` of Mercator's square, counted from −1 in the south to 1 in the north.
double mercator_latitude_deg(double t) {
  const double grown = exact_pow(kEuler, t * kPi);
  return exact_atan2((grown - 1 / grown) / 2, 1) / kRadiansPerDegree;
}

}  // namespace

std::string tile_name(const TileAddress& address) {
  return fmt::format("{}/{}/{}", address.level, address.x, address.y);
}

std::optional<TileAddress> tile_address(const std::filesystem::path& path) {
  if (path.extension() != ".terrain") return std::nullopt;
  const auto column = path.parent_path();
  const auto level = plain_number(column.parent_path().filename().string());
  const auto x = plain_number(column.filename().string());
  const auto y = plain_number(path.stem().string());
  if (!level || !x || !y || *level > kDeepestTileLevel) return std::nullopt;
  return TileAddress{static_cast<int>(*level), *x, *y};
}

bool TileGrid::contains(const TileAddress& address) const {
  return address.level >= 0 && address.level <= kDeepestTileLevel && address.x < columns(address.level) &&
         address.y < rows(address.level);
}

std::uint32_t TileGrid::row_from_south(const TileAddress& address) const {
  return scheme == TileScheme::tms ? address.y : rows(address.level) - 1 - address.y;
}

TileBounds TileGrid::bounds_projected(const TileAddress& address) const {
  const double half = projection == TileProjection::geographic ? 180 : kPi * kMercatorRadiusM;
  const double bottom = projection == TileProjection::geographic ? 90 : half;
  const double step = 2 * half / columns(address.level);  // a power of two: tiles' sides are exact multiples
  const std::uint32_t row = row_from_south(address);
  return {address.x * step - half, row * step - bottom, (address.x + 1.0) * step - half,
          (row + 1.0) * step - bottom};
}

TileBounds TileGrid::bounds_deg(const TileAddress& address) const {
  if (projection == TileProjection::geographic) return bounds_projected(address);
  const double count = columns(address.level);
  const std::uint32_t row = row_from_south(address);
  return {address.x * 360.0 / count - 180, mercator_latitude_deg(2 * row / count - 1),
          (address.x + 1.0) * 360 / count - 180, mercator_latitude_deg(2 * (row + 1.0) / count - 1)};
}

std::optional<TileAddress> TileGrid::neighbour(const TileAddress& address, TileSide side) const {
  TileAddress out = address;
  const std::uint32_t width = columns(address.level), height = rows(address.level);
  if (side == TileSide::west) {
    out.x = address.x == 0 ? width - 1 : address.x - 1;
  } else if (side == TileSide::east) {
    out.x = address.x + 1 == width ? 0 : address.x + 1;
  } else {
    const bool up = (side == TileSide::north) == (scheme == TileScheme::tms);
    if (address.y == (up ? height - 1 : 0)) return std::nullopt;
    out.y = up ? address.y + 1 : address.y - 1;
  }
  return out;
}

std::optional<TileAddress> TileGrid::parent(const TileAddress& address) {
  if (address.level == 0) return std::nullopt;
  return TileAddress{address.level - 1, address.x / 2, address.y / 2};
}

std::array<TileAddress, 4> TileGrid::children(const TileAddress& address) const {
  const std::uint32_t south = scheme == TileScheme::tms ? 0 : 1;
  const auto child = [&](std::uint32_t east, std::uint32_t y) {
    return TileAddress{address.level + 1, 2 * address.x + east, 2 * address.y + y};
  };
  return {child(0, south), child(1, south), child(0, 1 - south), child(1, 1 - south)};
}

Vec2 TileGrid::position_deg(const TileAddress& address, double u, double v) const {
  // Steps first: places on the lattice are whole numbers, and halving for a level rounds nothing.
  const auto along = [&](std::uint32_t tile, double step, double world) {
    return (static_cast<double>(tile) * kTileSteps + step) * world / kTileSteps / power_of_two(address.level);
  };
  if (projection == TileProjection::geographic)
    return {along(address.x, u, 180) - 180, along(row_from_south(address), v, 180) - 90};
  const TileBounds b = bounds_deg(address);
  const double latitude = v == kTileSteps ? b.north : b.south + (b.north - b.south) * v / kTileSteps;
  return {along(address.x, u, 360) - 180, latitude};
}

Vec2 TileGrid::lattice(const TileAddress& address, std::int32_t u, std::int32_t v, int finest) const {
  const double scale = power_of_two(finest - address.level);
  return {(static_cast<double>(address.x) * kTileSteps + u) * scale,
          (static_cast<double>(row_from_south(address)) * kTileSteps + v) * scale};
}

double TileGrid::lattice_width(int finest) const { return static_cast<double>(columns(finest)) * kTileSteps; }

}  // namespace plumbline
