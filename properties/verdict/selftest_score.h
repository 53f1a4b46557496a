// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plumbline::verdict {

/// How the oracles did on one kind of planted fault.
struct KindScore {
  std::string oracle;            ///< "O1 conformity", …
  std::string kind;              ///< the fault's name
  std::string what;              ///< in words
  bool sound = false;            ///< a harmless twin: nothing must be found
  std::size_t faults = 0;        ///< meshes or scenes with one fault each
  std::size_t expected = 0;      ///< findings that they must cause
  std::size_t found = 0;         ///< of those, at their places
  std::size_t misplaced = 0;     ///< of those, reported elsewhere
  std::size_t false_alarms = 0;  ///< findings that nothing was planted for
  [[nodiscard]] bool perfect() const { return found == expected && misplaced == 0 && false_alarms == 0; }
};

/// Faults planted in the meshes of one method, or of nobody's.
struct MakerScore {
  std::string name;
  std::size_t faults = 0;  ///< 0: none of its meshes drawn was sound enough to plant in
};

/// What `plumbline selftest` prints. No clocks, no host facts: same seed and counts, same bytes.
struct SelftestScore {
  std::uint64_t seed = 0;
  std::vector<KindScore> kinds;        ///< in the catalogue's order
  std::size_t clean_meshes = 0;        ///< random sound meshes, nothing planted
  std::size_t clean_false_alarms = 0;  ///< findings on them
  std::vector<MakerScore> makers;      ///< of the meshes that conformity (O1) was tried on
  bool interrupted = false;

  /// Sums over the kinds of one oracle; of all with an empty name.
  [[nodiscard]] KindScore total(const std::string& oracle = "") const;
  /// The oracles, in the order of the kinds.
  [[nodiscard]] std::vector<std::string> oracles() const;
  /// Faults that are none: planted ones without the sound twins.
  [[nodiscard]] std::size_t planted() const;
  /// Everything found at its place, no false alarm, and no kind without a fault (never vacuous).
  [[nodiscard]] bool perfect() const;
};

}  // namespace plumbline::verdict
