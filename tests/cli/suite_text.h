// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plumbline::testing_cli {

/// A suite of one small flight, in parts, so that a test can spoil exactly one of them. The defaults are
/// sound and take well under a second.
struct SuiteText {
  std::string suite = "name = \"tiny\"\nviewport = [64, 48]\nfov_y_deg = 60\n";
  std::string terrain = "id = \"hills\"\ngenerator = \"fbm\"\nseed = 3\nsize = 17\nspacing_m = 10\n";
  std::string trajectory = "id = \"down\"\nkind = \"nadir\"\nframes = 2\n";
  std::string method = "id = \"restricted_quadtree\"\nthresholds_px = [2]\n";
  std::string gate = "crack = 0\n";

  [[nodiscard]] std::string text() const {
    return "[suite]\n" + suite + "[[terrain]]\n" + terrain + "[[trajectory]]\n" + trajectory +
           "[[method]]\n" + method + "[gate]\n" + gate;
  }
};

}  // namespace plumbline::testing_cli
