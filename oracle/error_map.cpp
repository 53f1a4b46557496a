// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/error_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/predicates.h"
#include "scenarios/dem.h"

namespace plumbline::oracle {
namespace {

using Triangle = std::array<Vec3, 3>;

/// The triangles that can be judged, each starting at its southmost, then westmost corner.
template <class Visit>
void for_each_triangle(const Mesh& mesh, Visit visit) {
  const std::size_t count = mesh.positions.size();
  for (const auto& corners : mesh.triangles) {
    if (std::max({corners[0], corners[1], corners[2]}) >= count) continue;
    Triangle t{mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]};
    if (!std::all_of(t.begin(), t.end(), [](const Vec3& p) {
          return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        })) {
      continue;
    }
    if (orientation({t[0].x, t[0].y}, {t[1].x, t[1].y}, {t[2].x, t[2].y}).value <= 0) continue;
    std::rotate(
        t.begin(),
        std::min_element(t.begin(), t.end(),
                         [](const Vec3& p, const Vec3& q) { return p.y != q.y ? p.y < q.y : p.x < q.x; }),
        t.end());
    visit(t);
  }
}

/// Where a horizontal line crosses a triangle: both ends, west first.
struct Section {
  Vec2 west, east;  // x, and the height there
};

std::optional<Section> section(const Triangle& t, double y) {
  std::optional<Section> found;
  const auto meet = [&](double x, double z) {
    if (!found) found = Section{{x, z}, {x, z}};
    if (x < found->west.x) found->west = {x, z};
    if (x > found->east.x) found->east = {x, z};
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& p = t[k];
    const Vec3& q = t[(k + 1) % 3];
    if (p.y == y) meet(p.x, p.z);
    if ((p.y < y && q.y > y) || (p.y > y && q.y < y)) {
      const double share = (y - p.y) / (q.y - p.y);
      meet(p.x + share * (q.x - p.x), p.z + share * (q.z - p.z));
    }
  }
  return found;
}

/// Pixels along one side, and where their centres stand.
struct Pixels {
  double low, size;
  int count;
  [[nodiscard]] double centre(int k) const { return low + (k + 0.5) * size; }
  /// The first pixel whose centre is not before `x`, and the last one whose centre is not beyond.
  [[nodiscard]] int first(double x) const { return bounded(std::ceil((x - low) / size - 0.5), 0, count); }
  [[nodiscard]] int last(double x) const {
    return bounded(std::floor((x - low) / size - 0.5), -1, count - 1);
  }

 private:
  static int bounded(double k, int least, int most) {
    return static_cast<int>(std::clamp(k, static_cast<double>(least), static_cast<double>(most)));
  }
};

}  // namespace

ErrorMap vertical_error_map(const Mesh& mesh, const Terrain& terrain, std::span<const std::uint8_t> has_data,
                            int longest_px, Vec2 step) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ErrorMap map;
  map.low = {kInfinity, kInfinity};
  map.high = {-kInfinity, -kInfinity};
  for_each_triangle(mesh, [&](const Triangle& t) {
    for (const Vec3& p : t) {
      map.low = {std::min(map.low.x, p.x), std::min(map.low.y, p.y)};
      map.high = {std::max(map.high.x, p.x), std::max(map.high.y, p.y)};
    }
  });
  map.low = {std::max(map.low.x, 0.0), std::max(map.low.y, 0.0)};
  map.high = {std::min(map.high.x, terrain.width_m()), std::min(map.high.y, terrain.depth_m())};
  if (!(map.high.x > map.low.x && map.high.y > map.low.y)) return {};

  const double width = (map.high.x - map.low.x) * step.x, depth = (map.high.y - map.low.y) * step.y;
  const double longest = std::max(width, depth);
  const auto pixels = [&](double side) {
    return std::max(1, static_cast<int>(std::lround(longest_px * (side / longest))));
  };
  const Pixels across{map.low.x, (map.high.x - map.low.x) / pixels(width), pixels(width)};
  const Pixels up{map.low.y, (map.high.y - map.low.y) / pixels(depth), pixels(depth)};
  map.error_m = Raster(across.count, up.count, std::numeric_limits<float>::quiet_NaN());

  for_each_triangle(mesh, [&](const Triangle& t) {
    const int south = up.first(t[0].y), north = up.last(std::max(t[1].y, t[2].y));
    for (int row = south; row <= north; ++row) {
      const double y = up.centre(row);
      const std::optional<Section> line = section(t, y);
      if (!line) continue;
      float* const values =
          map.error_m.values.data() + static_cast<std::ptrdiff_t>(up.count - 1 - row) * across.count;
      const double length = line->east.x - line->west.x;
      for (int column = across.first(line->west.x); column <= across.last(line->east.x); ++column) {
        const double x = across.centre(column);
        const std::optional<double> ground =
            height_where_data_m(terrain, has_data, {x / terrain.spacing_m, y / terrain.spacing_m});
        if (!ground) continue;
        const double share = length > 0 ? std::clamp((x - line->west.x) / length, 0.0, 1.0) : 0;
        const auto error = static_cast<float>(line->west.y + share * (line->east.y - line->west.y) - *ground);
        float& shown = values[column];
        const float size = std::fabs(error), before = std::fabs(shown);
        if (std::isnan(shown) || size > before || (size == before && error > shown)) shown = error;
      }
    }
  });
  return map;
}

}  // namespace plumbline::oracle
