// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace plumbline::compare {

/// Keys in alphabetical order: looking one up among many is quick, whatever a file brings.
using Json = nlohmann::json;

/// Parses a JSON text that may be hostile. The array `frames` of each of `runs` is not kept: in its place
/// stands a hash of its values, as an unsigned number. Throws InputError that names `file` if the text is not
/// JSON, ends early, or nests deeper than 64 levels.
Json read_json(std::string_view text, const std::string& file);

}  // namespace plumbline::compare
