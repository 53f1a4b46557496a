// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "properties/faults/judges.h"
#include "scenarios/random.h"

/// Faults for the oracles that measure (O2 to O7): each is planted with a size and a place that are known in
/// closed form, and the oracle must report that size, there, and nothing elsewhere.
namespace plumbline::faults {

/// What became of planted faults.
struct Tally {
  std::size_t faults = 0;        ///< meshes (scenes, flights) with one fault planted; sound twins count too
  std::size_t expected = 0;      ///< findings or figures that the faults must cause
  std::size_t found = 0;         ///< of those, reported with the right size at the right place
  std::size_t misplaced = 0;     ///< reported, but with wrong witnesses or at another place
  std::size_t false_alarms = 0;  ///< reported, though nothing was planted that causes it
  [[nodiscard]] bool perfect() const { return found == expected && misplaced == 0 && false_alarms == 0; }
  Tally& operator+=(const Tally& other);
};

struct MeasuredFault {
  std::string_view oracle;  ///< "O2 vertical error", …
  std::string_view name;
  std::string_view what;
  bool sound = false;  ///< a harmless twin: nothing must be reported
  /// One trial in a random scene; nothing if the scene drawn has no place for it.
  std::function<std::optional<Tally>(const Judges&, Random&, const MakeSolid&)> trial;
};

/// The catalogue, in the order of the oracles.
const std::vector<MeasuredFault>& measured_faults();

// Its parts, one file each.
std::vector<MeasuredFault> height_faults();   ///< O2
std::vector<MeasuredFault> picture_faults();  ///< O3, O4
std::vector<MeasuredFault> flight_faults();   ///< O5
std::vector<MeasuredFault> solid_faults();    ///< O6, O7
std::vector<MeasuredFault> tile_faults();     ///< terrain tiles against their format
std::vector<MeasuredFault> placed_faults();   ///< meshes that lie wrongly over a terrain

/// The tally of a trial that planted one fault (or its sound twin). `reported`: the oracle said something;
/// `size`, `place`: it is what was planted, where it was planted; `elsewhere`: it reported besides.
Tally tally(bool sound, bool reported, bool size, bool place, bool elsewhere);

}  // namespace plumbline::faults
