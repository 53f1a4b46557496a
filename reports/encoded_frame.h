// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "properties/verdict/verdict.h"

namespace plumbline::reports {

/// The pictures of one frame as PNG files: encoded once, for the image folder and for the page.
struct EncodedFrame {
  std::string run;
  int frame = 0;
  double threshold_px = 0;
  std::string mesh, error, reference;  ///< bytes of a PNG file
};

std::vector<EncodedFrame> encode(std::span<const verdict::FramePictures> pictures);

/// report_html() from pictures that are encoded already.
std::string page_html(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing,
                      std::span<const EncodedFrame> frames, const std::string& command);

}  // namespace plumbline::reports
