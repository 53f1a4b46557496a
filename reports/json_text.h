// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace plumbline::reports {

/// Keys keep the order in which they are entered.
using Json = nlohmann::ordered_json;

/// The fewest digits that read back as the same double; "null" if it is not finite; negative zero is "0".
std::string number_text(double value);

/// A JSON text that diffs well: containers down to `expand` levels below the root are spread over lines if
/// they hold containers themselves, everything else stands on one line. Ends with a line break.
std::string json_text(const Json& value, int expand);

/// `text` with every byte that is not UTF-8 replaced by U+FFFD.
std::string valid_utf8(std::string_view text);

}  // namespace plumbline::reports
