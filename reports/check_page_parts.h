// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "properties/verdict/check_verdict.h"
#include "reports/encoded_frame.h"

/// Pieces of check.html.
namespace plumbline::reports {

/// "data:image/png;base64,…"
std::string data_uri(std::string_view type, std::string_view bytes);
/// An entry of a list of facts; empty if there is nothing to say.
std::string fact(std::string_view name, std::string_view value);

/// What was measured, below the heading of its section. Pictures are bytes of PNG files; none if empty.
std::string terrain_part(const verdict::TerrainVerdict& terrain, const std::string& error_map,
                         const verdict::Extent& map_box);
std::string reference_part(const verdict::ReferenceVerdict& reference);
std::string image_part(const verdict::ImageVerdict& image, const std::optional<EncodedFrame>& pictures);

}  // namespace plumbline::reports
