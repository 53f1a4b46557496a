// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/random.h"

namespace plumbline {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;

constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view stream) : state_(seed) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a of the stream's name
  for (const char c : stream) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  state_ = mix(seed + kGolden) ^ hash;
}

std::uint64_t Random::bits() {
  state_ += kGolden;
  return mix(state_);
}

std::uint64_t Random::below(std::uint64_t n) {
  // Rejection of the last partial block keeps every value equally likely.
  const std::uint64_t limit = (0 - n) % n;
  for (;;) {
    const std::uint64_t value = bits();
    if (value >= limit) return value % n;
  }
}

std::uint64_t lattice_hash(std::uint64_t seed, std::int64_t i, std::int64_t j) {
  std::uint64_t h = mix(seed + kGolden);
  h = mix(h ^ (static_cast<std::uint64_t>(i) * 0xd6e8feb86659fd93));
  return mix(h ^ (static_cast<std::uint64_t>(j) * 0xa0761d6478bd642f));
}

}  // namespace plumbline
