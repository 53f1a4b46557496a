// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace plumbline {

/// The value of type T that lies at `offset`, least significant byte first (`big`: most significant).
/// Requires: its bytes lie inside.
template <class T>
T value_at(std::string_view bytes, std::size_t offset, bool big = false) {
  std::array<char, sizeof(T)> copy{};
  std::memcpy(copy.data(), bytes.data() + offset, sizeof(T));
  if (big != (std::endian::native == std::endian::big)) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// Appends the value's bytes, least significant first.
template <class T>
void append_little_endian(std::string& out, T value) {
  auto copy = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(copy.begin(), copy.end());
  out.append(copy.data(), copy.size());
}

}  // namespace plumbline
