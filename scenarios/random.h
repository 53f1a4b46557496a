// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace plumbline {

/// The house's one generator: SplitMix64 (Steele, Lea & Flood, OOPSLA 2014). Its sequence is specified, so
/// the same seed gives the same terrain with every compiler and library; standard distributions do not
/// promise that.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// A named stream of the same seed: independent draws for independent purposes.
  Random(std::uint64_t seed, std::string_view stream);

  /// The next 64 bits.
  std::uint64_t bits();
  /// Uniform in [0, 1), a multiple of 2⁻⁵³.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in [0, n) without bias. Requires: n > 0.
  std::uint64_t below(std::uint64_t n);

 private:
  std::uint64_t state_;
};

/// A hash of lattice point (i, j) and seed, for noise that does not depend on the order of evaluation.
std::uint64_t lattice_hash(std::uint64_t seed, std::int64_t i, std::int64_t j);

}  // namespace plumbline
