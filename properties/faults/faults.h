// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/conformity.h"
#include "scenarios/mesh.h"
#include "scenarios/random.h"

/// Defects to plant in sound meshes, so that the conformity oracle proves itself (ORACLES, "Why the oracles
/// can be believed", 1): it must report exactly what was planted, at its place, and nothing else.
namespace plumbline::faults {

/// A finding that a planted fault must cause. Its place is told by witnesses, not by a distance: the finding
/// must name all of these vertices and triangles (indices into the faulty mesh).
struct ExpectedFinding {
  oracle::FindingCode code{};
  std::string kind;  ///< the finding's kind, exactly
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> triangles;
};

struct FaultKind {
  std::string_view name;
  std::string_view what;
  bool sound = false;  ///< a harmless twin: nothing must be found
};

/// The catalogue, in a fixed order.
const std::vector<FaultKind>& fault_kinds();

struct PlantedFault {
  std::string_view kind;
  Mesh mesh;
  PlanDomain domain;
  std::vector<ExpectedFinding> expected;  ///< empty for a sound twin
};

/// Plants one fault of the kind at a random place of a sound mesh (one on which check_conformity finds
/// nothing). Nothing if the mesh has no place for it, such as no edge whose midpoint is a double. Throws
/// InputError for an unknown kind.
std::optional<PlantedFault> plant(std::string_view kind, const Mesh& sound, const PlanDomain& domain,
                                  Random& random);

struct Score {
  std::size_t planted = 0;       ///< findings expected
  std::size_t found = 0;         ///< of those, reported with all their witnesses
  std::size_t misplaced = 0;     ///< of those, reported, but with other witnesses
  std::size_t false_alarms = 0;  ///< reported findings that nothing was planted for
  [[nodiscard]] bool perfect() const { return found == planted && misplaced == 0 && false_alarms == 0; }
};
Score score(const PlantedFault& fault, const oracle::ConformityReport& report);

}  // namespace plumbline::faults
