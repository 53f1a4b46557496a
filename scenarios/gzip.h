// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace plumbline {

/// Whether the bytes begin as a gzip member does (RFC 1952: magic, deflate, no reserved flag).
bool is_gzip(std::string_view bytes);

struct Inflated {
  std::string bytes;
  std::size_t rest = 0;  ///< compressed bytes behind the gzip member, which nothing asks for
};

/// House limits on what comes out of one gzip member: kMostInflation bytes for each that went in, but
/// kFreeInflated in any case, and kMostInflated in no case. Terrain tiles take 2 to 10, flat ones some 50;
/// deflate itself could reach 1032.
inline constexpr std::size_t kMostInflation = 256;
inline constexpr std::size_t kFreeInflated = std::size_t{1} << 20U;
inline constexpr std::size_t kMostInflated = std::size_t{1} << 28U;

/// Inflates the gzip member that `bytes` begin with; memory grows with what comes out. Throws InputError,
/// which begins with `name`, for damaged or cut data and for more than the limits.
Inflated gunzip(std::string_view bytes, std::string_view name);

}  // namespace plumbline
