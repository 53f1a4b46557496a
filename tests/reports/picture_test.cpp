// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/picture.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "reports/digest.h"

namespace plumbline::reports {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Picture decode(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    ADD_FAILURE() << image.message;
    return {};
  }
  EXPECT_EQ(image.format & PNG_FORMAT_FLAG_ALPHA, 0u);
  image.format = PNG_FORMAT_RGB;
  Picture out(static_cast<int>(image.width), static_cast<int>(image.height), {});
  if (png_image_finish_read(&image, nullptr, out.rgb.data(), 0, nullptr) == 0) ADD_FAILURE() << image.message;
  return out;
}

TEST(Png, DecodesToTheSamePicture) {
  Picture picture(37, 21, {1, 2, 3});
  picture.fill(5, 5, 30, 15, {200, 100, 0});
  picture.set(36, 20, {255, 255, 255});
  const std::string bytes = png_bytes(picture);
  const Picture read = decode(bytes);
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 21);
  EXPECT_EQ(read.rgb, picture.rgb);
  EXPECT_EQ(bytes, png_bytes(picture));
  EXPECT_EQ(bytes.find("tIME"), std::string::npos) << "a date has no place in a picture";
}

TEST(Viridis, EndsMiddleAndOrder) {
  EXPECT_EQ(viridis(0), (Rgb{68, 1, 84}));
  EXPECT_EQ(viridis(1), (Rgb{253, 231, 37}));
  EXPECT_EQ(viridis(-3), viridis(0));
  EXPECT_EQ(viridis(7), viridis(1));
  // Perceived lightness rises all along: that is what makes it readable.
  double before = -1;
  for (int i = 0; i <= 64; ++i) {
    const Rgb colour = viridis(i / 64.0);
    const double luma = 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
    EXPECT_GT(luma, before) << i;
    before = luma;
  }
}

TEST(HeatMap, ColoursByMultiplesOfTheThreshold) {
  Raster displacement(320, 4, 0);
  displacement.values[1] = 2;     // τ: the middle of the bar
  displacement.values[2] = 4;     // 2 τ: its end
  displacement.values[3] = 4.1f;  // beyond
  displacement.values[4] = kNan;
  const Picture picture = heat_map(displacement, 2);
  EXPECT_EQ(picture.at(0, 0), viridis(0));
  EXPECT_EQ(picture.at(1, 0), viridis(0.5));
  EXPECT_EQ(picture.at(2, 0), viridis(1));
  EXPECT_EQ(picture.at(3, 0), kOverBar);
  EXPECT_EQ(picture.at(4, 0), kNotJudged);
}

TEST(HeatMap, BarMarksTheThreshold) {
  const Picture picture = heat_map(Raster(640, 10, 0), 1.5);
  EXPECT_EQ(picture.width, 640);
  EXPECT_EQ(picture.height, 10 + bar_height_px(640));
  // Between ticks the bar's row runs through viridis and ends in red; at its middle stands the dark mark of
  // τ.
  const int row = 10 + 16;
  EXPECT_EQ(picture.at(16, row), viridis(0));
  int dark = 0, red = 0;
  for (int x = 0; x < 640; ++x) {
    if (picture.at(x, row) == (Rgb{33, 37, 41})) {
      ++dark;
      EXPECT_NEAR(x, 16 + (640 - 16 - 16 - 28) / 2, 2);
    }
    red += picture.at(x, row) == kOverBar ? 1 : 0;
  }
  EXPECT_GE(dark, 2);
  EXPECT_EQ(red, 28);
}

TEST(HeatMap, TinyPicturesAndExtremeThresholdsAreDrawn) {
  for (const int width : {1, 7, 63}) {
    const Picture picture = heat_map(Raster(width, 1, 1), 1e-9);
    EXPECT_EQ(picture.at(0, 0), kOverBar);
    EXPECT_EQ(decode(png_bytes(picture)).width, width);
  }
}

TEST(Glyphs, EveryLabelOfTheBarCanBeDrawn) {
  for (const double threshold : {1e-9, 0.001, 0.3, 0.5, 1.0, 1.5, 2.0, 1e9, 3.3e20})
    for (const double share : {0.0, 0.5, 1.0, 1.5, 2.0})
      for (const char letter : "tau = px" + short_number(share * threshold))
        EXPECT_TRUE(glyph_known(letter)) << letter;
  EXPECT_FALSE(glyph_known('Q'));
}

TEST(Text, IsDrawnWhereAskedAndClipped) {
  Picture picture(20, 10, {});
  draw_text(picture, 18, 2, "88", 1, {255, 0, 0});
  EXPECT_EQ(picture.at(19, 2), (Rgb{255, 0, 0}));
  EXPECT_EQ(picture.at(17, 2), (Rgb{0, 0, 0}));
  EXPECT_EQ(text_width("88", 2), 22);
  EXPECT_EQ(text_width("", 2), 0);
}

TEST(ShadedPicture, SkyAndShades) {
  Raster shade(3, 1, kNan);
  shade.values[1] = 0;
  shade.values[2] = 5;
  const Picture picture = shaded_picture(shade);
  EXPECT_EQ(picture.at(0, 0), kSky);
  EXPECT_LT(picture.at(1, 0)[1], 60);
  EXPECT_GT(picture.at(2, 0)[1], 220) << "clamped, not wrapped";
}

}  // namespace
}  // namespace plumbline::reports
