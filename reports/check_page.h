// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "properties/verdict/check_verdict.h"
#include "reports/encoded_frame.h"

namespace plumbline::reports {

/// A check's pictures as PNG files: encoded once, for the image folder and for the page.
struct CheckImages {
  std::string error_map;  ///< bytes; empty: none
  std::optional<EncodedFrame> camera;
};
CheckImages encode(const verdict::CheckPictures& pictures);

/// check_html() from pictures that are encoded already.
std::string check_page(const verdict::CheckVerdict& verdict, const verdict::CheckPictures& pictures,
                       const CheckImages& images, const std::string& command);

/// The name of a spot's file below spots/.
std::string spot_file(const verdict::CheckSpot& spot);

/// All meshes in plan as an SVG for the page (whose style colours it): boxes of meshes, seams by state, the
/// worst findings as circles by size. Above kPlanBoxes meshes, cells with the worst state in each.
inline constexpr std::size_t kPlanBoxes = 2500;
std::string plan_svg(const verdict::CheckVerdict& verdict);

}  // namespace plumbline::reports
