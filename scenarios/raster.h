// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace plumbline {

/// One number a pixel, rows from the top: values[y * width + x].
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<float> values;

  Raster() = default;
  Raster(int w, int h, float fill)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  /// The value of pixel (x, y). Requires: inside.
  [[nodiscard]] float at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

}  // namespace plumbline
