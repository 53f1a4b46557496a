// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/verdict/selftest_score.h"

#include <algorithm>

namespace plumbline::verdict {

KindScore SelftestScore::total(const std::string& oracle) const {
  KindScore sum;
  sum.oracle = oracle;
  for (const KindScore& kind : kinds) {
    if (!oracle.empty() && kind.oracle != oracle) continue;
    sum.faults += kind.faults;
    sum.expected += kind.expected;
    sum.found += kind.found;
    sum.misplaced += kind.misplaced;
    sum.false_alarms += kind.false_alarms;
  }
  return sum;
}

std::vector<std::string> SelftestScore::oracles() const {
  std::vector<std::string> names;
  for (const KindScore& kind : kinds) {
    if (std::find(names.begin(), names.end(), kind.oracle) == names.end()) names.push_back(kind.oracle);
  }
  return names;
}

std::size_t SelftestScore::planted() const {
  std::size_t faults = 0;
  for (const KindScore& kind : kinds) faults += kind.sound ? 0 : kind.faults;
  return faults;
}

bool SelftestScore::perfect() const {
  return !interrupted && !kinds.empty() && clean_false_alarms == 0 &&
         std::all_of(kinds.begin(), kinds.end(),
                     [](const KindScore& kind) { return kind.perfect() && kind.faults > 0; });
}

}  // namespace plumbline::verdict
