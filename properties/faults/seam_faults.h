// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "properties/faults/halves.h"
#include "properties/faults/judges.h"
#include "properties/faults/measured_faults.h"

/// Faults between two meshes that should fit together: the halves of any sound mesh.
namespace plumbline::faults {

struct SeamFault {
  std::string_view name;
  std::string_view what;
  bool sound = false;  ///< a harmless twin: nothing must be reported
  /// Nothing if the place drawn does not do.
  std::function<std::optional<Tally>(const Judges&, const Halves&, Random&)> trial;
};

/// The catalogue, in a fixed order.
const std::vector<SeamFault>& seam_faults();

}  // namespace plumbline::faults
