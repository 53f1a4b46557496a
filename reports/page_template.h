// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace plumbline::reports {

/// The report page with its style and script, bundled from reports/page when the library is built. Where
/// `<!--data:NAME-->` stands (title, facts, results, timing), a report puts its own.
extern const std::string_view kPageTemplate;

/// The style of check.html: the report page's, and what is its own.
extern const std::string_view kCheckStyle;

/// docs/images/findings, by code.
struct FindingPicture {
  int code;
  std::string_view svg;
};
extern const std::span<const FindingPicture> kFindingPictures;

}  // namespace plumbline::reports
