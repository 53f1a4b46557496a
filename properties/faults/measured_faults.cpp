// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/faults/measured_faults.h"

#include <utility>

namespace plumbline::faults {

Tally& Tally::operator+=(const Tally& other) {
  faults += other.faults;
  expected += other.expected;
  found += other.found;
  misplaced += other.misplaced;
  false_alarms += other.false_alarms;
  return *this;
}

const std::vector<MeasuredFault>& measured_faults() {
  static const std::vector<MeasuredFault> list = [] {
    std::vector<MeasuredFault> all;
    for (auto& part :
         {height_faults(), picture_faults(), flight_faults(), solid_faults(), tile_faults(), placed_faults()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return list;
}

Tally tally(bool sound, bool reported, bool size, bool place, bool elsewhere) {
  Tally result;
  result.faults = 1;
  if (sound) {
    result.false_alarms = reported || elsewhere ? 1 : 0;
    return result;
  }
  result.expected = 1;
  if (reported && size && place) {
    result.found = 1;
  } else if (reported && size) {
    result.misplaced = 1;
  } else if (reported) {
    result.false_alarms = 1;  // of a size that nothing here has
  }
  if (elsewhere) ++result.false_alarms;
  return result;
}

}  // namespace plumbline::faults
