// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/digest.h"
#include "reports/picture.h"

namespace plumbline::reports {
namespace {

constexpr Rgb kViridis[] = {{68, 1, 84},    {72, 24, 106},  {71, 45, 123},  {66, 64, 134},  {59, 82, 139},
                            {51, 99, 141},  {44, 114, 142}, {38, 130, 142}, {33, 145, 140}, {31, 159, 136},
                            {39, 173, 129}, {61, 188, 116}, {92, 200, 99},  {129, 211, 77}, {170, 220, 50},
                            {213, 226, 26}, {253, 231, 37}};

constexpr Rgb kPaper{255, 255, 255};
constexpr Rgb kInk{33, 37, 41};
constexpr int kMapWidthPx = 640;  ///< small difference maps are enlarged to about this
constexpr double kBarEnd = 2;     ///< the bar ends at this many τ

Rgb mix(Rgb a, Rgb b, double share) {
  Rgb out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(std::lround(a[c] + (static_cast<double>(b[c]) - a[c]) * share));
  return out;
}

/// Letters grow with the picture, to stay legible when a page shows it small.
int text_scale(int picture_width) { return std::max(1, picture_width / 320); }

Rgb heat(float displacement_px, double threshold_px) {
  if (std::isnan(displacement_px)) return kNotJudged;
  const double share = static_cast<double>(displacement_px) / (kBarEnd * threshold_px);
  return share > 1 ? kOverBar : viridis(share);
}

struct BarTick {
  double share = 0;  ///< of the bar
  std::string label;
  bool strong = false;  ///< drawn through the bar
};

/// A colour bar with its ticks; `beyond`: the end for what the bar does not reach.
template <class Colour>
void draw_bar(Picture& picture, int top, Colour colour, std::optional<Rgb> beyond,
              std::span<const BarTick> ticks) {
  const int scale = text_scale(picture.width);
  const int margin = 8 * scale;
  const int bar_top = top + 4 * scale, bar_bottom = bar_top + 8 * scale;
  const int beyond_width = beyond ? 14 * scale : 0;
  const int left = margin, right = std::max(left + 1, picture.width - margin - beyond_width);
  for (int x = left; x < right; ++x)
    picture.fill(x, bar_top, x + 1, bar_bottom, colour(static_cast<double>(x - left) / (right - left)));
  if (beyond) picture.fill(right, bar_top, right + beyond_width, bar_bottom, *beyond);

  const int text_top = bar_bottom + 4 * scale;
  int free_from = 0;  // labels that would run into their neighbour are left out
  for (const BarTick& tick : ticks) {
    const int middle = left + static_cast<int>(std::lround(tick.share * (right - left)));
    const int thickness = tick.strong ? std::max(2, scale) : std::max(1, scale / 2);
    const int from = tick.strong ? bar_top - 3 * scale : bar_bottom;
    picture.fill(middle - thickness / 2, from, middle - thickness / 2 + thickness, bar_bottom + 3 * scale,
                 kInk);
    const int width = text_width(tick.label, scale);
    const int edge = 2 * scale;
    const int x = std::clamp(middle - width / 2, edge, std::max(edge, picture.width - width - edge));
    if (x < free_from) continue;
    draw_text(picture, x, text_top, tick.label, scale, kInk);
    free_from = x + width + 4 * scale;
  }
}

/// Below zero blue, at zero white, above red: ColorBrewer's RdBu (Brewer, 2003), safe for colour-blind eyes.
Rgb diverging(double share) {
  constexpr Rgb kBelow[] = {{247, 247, 247}, {146, 197, 222}, {67, 147, 195}, {33, 102, 172}, {5, 48, 97}};
  constexpr Rgb kAbove[] = {{247, 247, 247}, {244, 165, 130}, {214, 96, 77}, {178, 24, 43}, {103, 0, 31}};
  const double place = std::clamp(std::fabs(share), 0.0, 1.0) * 4;
  const auto below = std::min(static_cast<std::size_t>(place), std::size_t{3});
  const auto& side = share < 0 ? kBelow : kAbove;
  return mix(side[below], side[below + 1], place - static_cast<double>(below));
}

/// A ring around (x, y), light between dark, to be seen on any colour.
void draw_ring(Picture& picture, double x, double y, double radius) {
  const double width = std::max(1.0, radius / 4);
  const int reach = static_cast<int>(std::ceil(radius + 2 * width));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const double off = std::fabs(std::sqrt(static_cast<double>(dx * dx + dy * dy)) - radius) / width;
      const int px = static_cast<int>(x) + dx, py = static_cast<int>(y) + dy;
      if (off < 1.5) picture.fill(px, py, px + 1, py + 1, off < 0.6 ? kPaper : kInk);
    }
}

}  // namespace

Rgb viridis(double share) {
  const double last = static_cast<double>(std::size(kViridis) - 1);
  const double place = std::clamp(share, 0.0, 1.0) * last;
  const auto below = std::min(static_cast<std::size_t>(place), std::size(kViridis) - 2);
  return mix(kViridis[below], kViridis[below + 1], place - static_cast<double>(below));
}

int bar_height_px(int picture_width) { return 26 * text_scale(picture_width); }

Picture heat_map(const Raster& displacement_px, double threshold_px) {
  Picture out(displacement_px.width, displacement_px.height + bar_height_px(displacement_px.width), kPaper);
  for (int y = 0; y < displacement_px.height; ++y)
    for (int x = 0; x < displacement_px.width; ++x)
      out.set(x, y, heat(displacement_px.at(x, y), threshold_px));
  std::vector<BarTick> ticks;  // each half τ
  for (int tick = 0; tick <= 4; ++tick) {
    const std::string number = short_number(tick / 4.0 * kBarEnd * threshold_px);
    ticks.push_back({tick / 4.0, tick == 2 ? fmt::format("tau = {} px", number) : number, tick == 2});
  }
  draw_bar(out, displacement_px.height, viridis, kOverBar, ticks);
  return out;
}

Picture difference_map(const Raster& metres) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < metres.values.size(); ++i)
    if (std::isfinite(metres.values[i]) &&
        (!worst || std::fabs(metres.values[i]) > std::fabs(metres.values[*worst])))
      worst = i;
  const double most = worst ? std::fabs(static_cast<double>(metres.values[*worst])) : 0;
  const int zoom = std::max(1, kMapWidthPx / std::max(metres.width, metres.height));
  const int width = metres.width * zoom, height = metres.height * zoom;
  Picture out(width, height + bar_height_px(width), kPaper);
  for (int y = 0; y < metres.height; ++y)
    for (int x = 0; x < metres.width; ++x) {
      const double value = static_cast<double>(metres.at(x, y));
      const double share = most > 0 ? value / most : 0;
      out.fill(x * zoom, y * zoom, (x + 1) * zoom, (y + 1) * zoom,
               std::isfinite(value) ? diverging(share) : kNotJudged);
    }
  if (most > 0) {
    const auto columns = static_cast<std::size_t>(metres.width);
    Picture map(width, height, kPaper);  // the ring ends where the map does
    std::copy_n(out.rgb.begin(), map.rgb.size(), map.rgb.begin());
    draw_ring(map, (static_cast<double>(*worst % columns) + 0.5) * zoom,
              (static_cast<double>(*worst / columns) + 0.5) * zoom, std::max(6.0, width / 64.0));
    std::ranges::copy(map.rgb, out.rgb.begin());
  }
  std::vector<BarTick> ticks;
  for (int tick = 0; tick <= 4; ++tick) {
    const double value = most * (tick / 2.0 - 1);
    const std::string number = (value > 0 ? "+" : "") + short_number(value);
    ticks.push_back({tick / 4.0, tick == 4 ? number + " m" : number, tick == 2});
  }
  draw_bar(
      out, height, [](double share) { return diverging(2 * share - 1); }, std::nullopt, ticks);
  return out;
}

Picture shaded_picture(const Raster& shade) {
  constexpr Rgb kShadow{38, 44, 38}, kLight{236, 228, 204};
  Picture out(shade.width, shade.height, kSky);
  for (int y = 0; y < shade.height; ++y)
    for (int x = 0; x < shade.width; ++x) {
      const float value = shade.at(x, y);
      if (!std::isnan(value))
        out.set(x, y, mix(kShadow, kLight, std::clamp(static_cast<double>(value), 0.0, 1.0)));
    }
  return out;
}

}  // namespace plumbline::reports
