// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

/// The one list of the faults planted in the methods (algorithms/mutant.h).
namespace plumbline::mutants {

struct Mutant {
  std::string_view name;    ///< as PLUMBLINE_MUTANT has it
  std::string_view method;  ///< full id of the variant it is hunted in: one that promises what it breaks
  std::string_view slip;    ///< what the implementer did
  std::string_view killer;  ///< the law or oracle that finds it first
};

std::span<const Mutant> mutant_list();

}  // namespace plumbline::mutants
