// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/instrument.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "scenarios/portable_math.h"

namespace plumbline {
namespace {

/// A place for a part: origin and right-handed unit axes; a turned part turns around w.
struct Place {
  Vec3 origin, u, v, w;
  [[nodiscard]] Vec3 at(double x, double y, double z) const { return origin + u * x + v * y + w * z; }
};

Place on_panel(double x, double z) { return {{x, -0.4, z}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}; }
Place upright(Vec3 origin) { return {origin, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

using Circle = std::vector<Vec2>;

Circle circle(std::size_t segments) {
  Circle points(segments);
  for (std::size_t s = 0; s < segments; ++s) {
    const double angle = 2 * kPi * static_cast<double>(s) / static_cast<double>(segments);
    points[s] = {exact_cos(angle), exact_sin(angle)};
  }
  return points;
}

class Workshop {
 public:
  Mesh mesh;

  /// A turned part: rings of (radius, height), lowest first, closed by a point on the axis at either end.
  /// Every second column of a knurled part stands out by `knurl` of its radius, but not on the end rings; the
  /// end points stand `cap_m` beyond their rings.
  void lathe(const Place& place, const std::vector<Vec2>& rings, std::size_t segments, double knurl = 0,
             double cap_m = 0) {
    const Circle round = circle(segments);
    const auto base = count();
    mesh.positions.push_back(place.at(0, 0, rings.front().y - cap_m));
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t s = 0; s < segments; ++s) {
        const bool ridge = s % 4 < 2 && r > 0 && r + 1 < rings.size();
        const double radius = rings[r].x * (ridge ? 1 + knurl : 1);
        mesh.positions.push_back(place.at(radius * round[s].x, radius * round[s].y, rings[r].y));
      }
    }
    mesh.positions.push_back(place.at(0, 0, rings.back().y + cap_m));
    const auto top = count() - 1;
    const auto index = [&](std::size_t r, std::size_t s) {
      return base + 1 + static_cast<std::uint32_t>(r * segments + s % segments);
    };
    for (std::size_t s = 0; s < segments; ++s) {
      mesh.triangles.push_back({base, index(0, s + 1), index(0, s)});
      for (std::size_t r = 0; r + 1 < rings.size(); ++r)
        quad(index(r, s), index(r, s + 1), index(r + 1, s + 1), index(r + 1, s));
      mesh.triangles.push_back({index(rings.size() - 1, s), index(rings.size() - 1, s + 1), top});
    }
  }

  void torus(const Place& place, double ring_m, double tube_m, std::size_t around, std::size_t across) {
    const Circle big = circle(around), small = circle(across);
    const auto base = count();
    for (std::size_t i = 0; i < around; ++i) {
      for (std::size_t j = 0; j < across; ++j) {
        const double r = ring_m + tube_m * small[j].x;
        mesh.positions.push_back(place.at(r * big[i].x, r * big[i].y, tube_m * small[j].y));
      }
    }
    const auto index = [&](std::size_t i, std::size_t j) {
      return base + static_cast<std::uint32_t>((i % around) * across + j % across);
    };
    for (std::size_t i = 0; i < around; ++i) {
      for (std::size_t j = 0; j < across; ++j)
        quad(index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }

  /// A box of half sides `half` around the place's origin, cut into `cells` along each side; edges rounded.
  void box(const Place& place, Vec3 half, std::array<int, 3> cells, double rounding_m = 0) {
    std::map<std::tuple<int, int, int>, std::uint32_t> made;
    const auto corner = [&](std::array<int, 3> at) {
      const auto [slot, is_new] = made.try_emplace({at[0], at[1], at[2]}, count());
      if (is_new) {
        const std::array<double, 3> sides{half.x, half.y, half.z};
        std::array<double, 3> p{}, inner{};
        for (std::size_t k = 0; k < 3; ++k) {
          p[k] = sides[k] * (2.0 * at[k] / cells[k] - 1);
          inner[k] = std::clamp(p[k], rounding_m - sides[k], sides[k] - rounding_m);
        }
        if (rounding_m > 0) {
          const Vec3 out = normalized({p[0] - inner[0], p[1] - inner[1], p[2] - inner[2]}) * rounding_m;
          p = {inner[0] + out.x, inner[1] + out.y, inner[2] + out.z};
        }
        mesh.positions.push_back(place.at(p[0], p[1], p[2]));
      }
      return slot->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t s = (axis + 1) % 3, t = (axis + 2) % 3;
      for (int i = 0; i < cells[s]; ++i) {
        for (int j = 0; j < cells[t]; ++j) {
          for (const int side : {0, cells[axis]}) {
            const auto at = [&](int a, int b) {
              std::array<int, 3> index{};
              index[axis] = side;
              index[s] = a;
              index[t] = b;
              return corner(index);
            };
            const auto p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), o = at(i, j + 1);
            if (side > 0) {
              quad(p, q, r, o);
            } else {
              quad(p, o, r, q);
            }
          }
        }
      }
    }
  }

 private:
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(mesh.positions.size()); }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
};

/// Rings from (radius, low) to (radius, high), rounded at the top: a knob, a screw's head, a foot.
std::vector<Vec2> turned(double radius_m, double low_m, double high_m, int rings, double narrowing) {
  std::vector<Vec2> profile;
  for (int r = 0; r < rings; ++r) {
    const double t = static_cast<double>(r) / (rings - 1);
    profile.push_back({radius_m * (1 - narrowing * t * t), low_m + (high_m - low_m) * t});
  }
  return profile;
}

void dial(Workshop& shop, double x, double z, double needle_deg) {
  const Place place = on_panel(x, z);
  shop.torus({place.at(0, 0, 0.02), place.u, place.v, place.w}, 0.14, 0.014, 64, 12);
  shop.lathe(place,
             {{0.132, 0.001}, {0.132, 0.006}, {0.1, 0.007}, {0.07, 0.008}, {0.04, 0.009}, {0.015, 0.02}}, 64);
  const auto spoke = [&](double deg, double from, double to, double thick, std::array<int, 3> cells) {
    const double c = exact_cos(deg * kRadiansPerDegree), s = exact_sin(deg * kRadiansPerDegree);
    const double middle = (from + to) / 2;
    shop.box({place.at(c * middle, s * middle, 0.014), place.u * c + place.v * s, place.v * c - place.u * s,
              place.w},
             {(to - from) / 2, thick, 0.002}, cells);
  };
  for (int tick = 0; tick < 24; ++tick)
    spoke(-30 + tick * 240.0 / 23, 0.1, tick % 6 == 0 ? 0.128 : 0.118, 0.0015, {2, 1, 1});
  spoke(needle_deg, 0.018, 0.095, 0.003, {12, 2, 2});
}

}  // namespace

Mesh instrument_mesh() {
  Workshop shop;
  shop.box(upright({0, 0, 0}), {1, 0.4, 0.6}, {60, 24, 36}, 0.06);
  for (int k = 0; k < 6; ++k) dial(shop, -0.75 + 0.4 * (k % 3), 0.3 - 0.4 * (k / 3), 20 + 25 * k);
  for (int k = 0; k < 8; ++k) {
    shop.lathe(on_panel(-0.8 + 0.15 * k, -0.42), turned(0.05, 0.002, 0.07, 16, 0.25), 96, 0.06);
  }
  for (int k = 0; k < 12; ++k) {
    const double x = -0.9 + 0.36 * (k % 6);
    shop.lathe(on_panel(x, k < 6 ? 0.52 : -0.52), turned(0.018, 0.001, 0.012, 8, 0.6), 24);
  }
  for (int k = 0; k < 14; ++k) {
    shop.box({{0.65, -0.41, 0.42 - 0.05 * k}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0.25, 0.008, 0.012},
             {40, 2, 2}, 0.004);
  }
  for (int k = 0; k < 4; ++k) {
    shop.lathe(
        {{k % 2 == 0 ? -0.8 : 0.8, k / 2 == 0 ? -0.25 : 0.25, -0.6}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
        turned(0.07, 0.002, 0.08, 8, 0.3), 32);
  }
  shop.torus({{0, 0, 0.82}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 0.18, 0.03, 96, 24);
  shop.lathe(upright({0.85, 0.2, 0.6}), turned(0.02, 0.002, 0.9, 60, 0.7), 48);
  // The rod's tip takes what is left: two cones, base to base.
  const std::size_t left = kInstrumentTriangles - std::min(kInstrumentTriangles, shop.mesh.triangles.size());
  if (left < 6 || left % 2 != 0) throw std::logic_error("the instrument's parts leave no tip");
  shop.lathe(upright({0.85, 0.2, 1.53}), {{0.02, 0}}, left / 2, 0, 0.02);
  return std::move(shop.mesh);
}

}  // namespace plumbline
