// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "properties/verdict/comparison.h"

namespace plumbline::reports {

/// For people: a headline, then an aligned table of at most kRowsForPeople differences, worst first.
std::string compare_text(const verdict::Comparison& comparison);
inline constexpr std::size_t kRowsForPeople = 200;

/// For a comment on a pull request: GitHub-flavoured Markdown of at most kCommentBytes bytes, with the first
/// kRowsOpen differences open and as many of the others as fit folded away. Names are shown as text whatever
/// they hold.
std::string compare_md(const verdict::Comparison& comparison);
inline constexpr std::size_t kRowsOpen = 60;
inline constexpr std::size_t kCommentBytes = 65'000;  ///< GitHub takes 65 536 characters

/// All of it as JSON, schema "plumbline.compare/1".
std::string compare_json(const verdict::Comparison& comparison);

}  // namespace plumbline::reports
