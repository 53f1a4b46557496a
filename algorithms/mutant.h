// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Faults planted in the methods, to measure whether laws and oracles would find an implementer's slip.
///
/// PLUMBLINE_MUTANT(name) is false; only in the library that tests/mutants builds of the same sources (with
/// PLUMBLINE_MUTANTS defined) it asks whether the mutant of that name is switched on. What each mutant stands
/// for is listed in tests/mutants/mutant_list.cpp; a test holds the hooks to that list. Hooks stand in .cpp
/// files only: an inline function with one would be two functions of one name where both builds meet.
#ifdef PLUMBLINE_MUTANTS

#include <cstdint>
#include <string_view>

namespace plumbline::mutants {

/// FNV-1a; tests/mutants checks that no two names of the list share a number.
constexpr std::uint64_t number_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// The mutant that is switched on; 0: none. Written between trials only.
extern std::uint64_t switched_on;

}  // namespace plumbline::mutants

#define PLUMBLINE_MUTANT(name) (::plumbline::mutants::switched_on == ::plumbline::mutants::number_of(#name))

#else

#define PLUMBLINE_MUTANT(name) false

#endif
