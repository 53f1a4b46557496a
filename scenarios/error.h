// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace plumbline {

/// Something the user gave cannot be used: a file, a key, a number, an option. The program answers with one line
/// and exit status 2. The message says what is wrong, where, and how to mend it; it holds no line break.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumbline
