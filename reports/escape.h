// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace plumbline::reports {

/// `text` for an element or an attribute of XML and HTML. Characters that XML 1.0 forbids become U+FFFD.
std::string markup_escape(std::string_view text);

/// `text` for a cell of a Markdown table: one line, bars and backticks escaped.
std::string markdown_cell(std::string_view text);

/// A JSON text for `<script type="application/json">`: `<` is written \u003c, so that neither "</script" nor
/// "<!--" can occur. Inside JSON `<` stands in strings only, so the value stays the same.
std::string script_safe_json(std::string_view json);

/// A run's id as part of a file name: every byte but ASCII letters, digits, '.', '_', '-' becomes %XX, as
/// does a leading
/// '.'. So no id leaves the folder, and different ids have different names.
std::string file_stem(std::string_view id);

/// As one has to type it: in quotes if a shell would read more than the word in it.
std::string shell_word(const std::string& word);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace plumbline::reports
