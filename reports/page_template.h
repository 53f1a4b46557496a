// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace plumbline::reports {

/// The report page with its style and script, bundled from reports/page when the library is built. Where
/// `<!--data:NAME-->` stands (title, facts, results, timing), a report puts its own.
extern const std::string_view kPageTemplate;

}  // namespace plumbline::reports
