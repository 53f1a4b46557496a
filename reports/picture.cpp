// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/picture.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <png.h>

namespace plumbline::reports {
namespace {

std::size_t offset(const Picture& picture, int x, int y) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
          static_cast<std::size_t>(x)) *
         3;
}

}  // namespace

Picture::Picture(int w, int h, Rgb colour)
    : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {
  fill(0, 0, w, h, colour);
}

void Picture::set(int x, int y, Rgb colour) {
  std::ranges::copy(colour, rgb.begin() + static_cast<std::ptrdiff_t>(offset(*this, x, y)));
}

Rgb Picture::at(int x, int y) const {
  const std::size_t i = offset(*this, x, y);
  return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

void Picture::fill(int x0, int y0, int x1, int y1, Rgb colour) {
  for (int y = std::max(0, y0); y < std::min(height, y1); ++y)
    for (int x = std::max(0, x0); x < std::min(width, x1); ++x) set(x, y, colour);
}

std::string png_bytes(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(fmt::format("libpng: {}", image.message));
  bytes.resize(size);
  return bytes;
}

}  // namespace plumbline::reports
