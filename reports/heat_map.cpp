// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

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
constexpr double kBarEnd = 2;  ///< the bar ends at this many τ

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

/// The bar, its red end for what is beyond it, ticks each half τ, and τ itself marked through the bar.
void draw_bar(Picture& picture, int top, double threshold_px) {
  const int scale = text_scale(picture.width);
  const int margin = 8 * scale;
  const int bar_top = top + 4 * scale, bar_bottom = bar_top + 8 * scale;
  const int red_width = 14 * scale;
  const int left = margin, right = std::max(left + 1, picture.width - margin - red_width);
  for (int x = left; x < right; ++x)
    picture.fill(x, bar_top, x + 1, bar_bottom, viridis(static_cast<double>(x - left) / (right - left)));
  picture.fill(right, bar_top, right + red_width, bar_bottom, kOverBar);

  const int text_top = bar_bottom + 4 * scale;
  int free_from = 0;  // labels that would run into their neighbour are left out
  const auto label = [&](int middle, const std::string& text) {
    const int width = text_width(text, scale);
    const int x = std::clamp(middle - width / 2, 0, std::max(0, picture.width - width));
    if (x < free_from) return;
    draw_text(picture, x, text_top, text, scale, kInk);
    free_from = x + width + 4 * scale;
  };
  for (int tick = 0; tick <= 4; ++tick) {
    const double share = tick / 4.0;
    const int x = left + static_cast<int>(std::lround(share * (right - left)));
    const bool is_threshold = tick == 2;
    const int thickness = is_threshold ? std::max(2, scale) : std::max(1, scale / 2);
    const int from = is_threshold ? bar_top - 3 * scale : bar_bottom;
    picture.fill(x - thickness / 2, from, x - thickness / 2 + thickness, bar_bottom + 3 * scale, kInk);
    const std::string number = short_number(share * kBarEnd * threshold_px);
    label(x, is_threshold ? "tau = " + number + " px" : number);
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
  draw_bar(out, displacement_px.height, threshold_px);
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
