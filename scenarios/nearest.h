// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline {

/// Levenshtein distance: the fewest insertions, deletions and replacements of bytes that turn `a` into `b`.
/// Only the first 64 bytes of each are looked at, so that a hostile name costs nothing.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the least edit distance from `name`; of equals, the first. Empty if there are no
/// candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "unknown <what> '<name>'; did you mean '<nearest>'?", for an InputError. `name` may hold anything.
std::string unknown_name(std::string_view what, std::string_view name,
                         const std::vector<std::string>& candidates);

}  // namespace plumbline
