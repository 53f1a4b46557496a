// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/lod_method.h"

#include "scenarios/error.h"

namespace plumbline {

void LodMethod::prepare_objects(const std::vector<Mesh>& /*objects*/) {
  throw InputError(
      "the method takes terrains only, no objects (plumbline list methods says which take them)");
}

}  // namespace plumbline
