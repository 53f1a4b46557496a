// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/raster.h"

namespace plumbline::reports {

using Rgb = std::array<std::uint8_t, 3>;

/// 8-bit sRGB, rows from the top, three bytes a pixel.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  Picture() = default;
  Picture(int w, int h, Rgb fill);
  void set(int x, int y, Rgb colour);
  [[nodiscard]] Rgb at(int x, int y) const;
  void fill(int x0, int y0, int x1, int y1, Rgb colour);  ///< [x0, x1) × [y0, y1), clipped
};

/// Shades of terrain on a plain sky. A shade outside [0, 1] is clamped; NaN is sky.
Picture shaded_picture(const Raster& shade);

/// Displacement as colour, with a colour bar below the picture (height bar_height_px). The bar runs evenly
/// from 0 to 2τ and marks τ; what is above 2τ is red, what was not judged grey. Colours: viridis (van der
/// Walt and Smith, 2015), which is perceptually uniform and safe for colour-blind eyes, from 17 evenly spaced
/// entries, linearly interpolated.
Picture heat_map(const Raster& displacement_px, double threshold_px);
int bar_height_px(int picture_width);

/// Signed differences in metres as colour: blue below zero, white, red above, evenly from −m to m, the
/// largest size in the raster, with a colour bar below (height bar_height_px of the picture's width). Where
/// that is attained first, a ring stands; what is not finite is grey. Small rasters are enlarged by a whole
/// factor.
Picture difference_map(const Raster& metres);

/// The colour of `share` of the bar: [0, 1] in viridis.
Rgb viridis(double share);

inline constexpr Rgb kSky{232, 236, 240};
inline constexpr Rgb kNotJudged{205, 208, 212};
inline constexpr Rgb kOverBar{214, 39, 40};

/// Draws text with its upper left corner at (x, y), clipped, letters `scale` × (5 × 7) pixels and `scale`
/// apart. Knows what glyph_known() says; anything else is a blank.
void draw_text(Picture& picture, int x, int y, std::string_view text, int scale, Rgb colour);
int text_width(std::string_view text, int scale);
bool glyph_known(char letter);

/// A PNG file of the picture: 8-bit RGB, no time, same bytes for the same picture and compression library.
std::string png_bytes(const Picture& picture);

}  // namespace plumbline::reports
