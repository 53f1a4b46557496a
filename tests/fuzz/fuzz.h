// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "scenarios/error.h"

/// What every fuzz target asks of a reader, beyond that it neither crashes nor hangs.
namespace plumbline::fuzz {

/// Ends the program, in every build, if `holds` is false: the fuzzer keeps the input.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", what);
  std::abort();
}

/// What `read` returns; nothing if it refuses its input with a message that is one line and not empty.
/// Anything else that it throws ends the program.
template <class Read>
auto accepted(Read&& read) -> std::optional<decltype(read())> {
  try {
    return std::forward<Read>(read)();
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    require(!message.empty(), "a refusal says why");
    require(std::none_of(message.begin(), message.end(),
                         [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }),
            "a refusal is one line without control characters");
    constexpr std::size_t kLongestLine = 2000;
    require(message.size() <= kLongestLine, "a refusal can be read");
    return std::nullopt;
  }
}

}  // namespace plumbline::fuzz
