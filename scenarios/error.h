// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace plumbline {

/// Something the user gave cannot be used: a file, a key, a number, an option. The program answers with one
/// line and exit status 2. The message says what is wrong, where, and how to mend it; it holds no line break.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `text` fit for an error line: every run of white space and control characters becomes one blank, and what
/// is longer than `longest` bytes is cut, at a character of UTF-8, and ends in "...".
std::string one_line(std::string_view text, std::size_t longest = 300);

}  // namespace plumbline
