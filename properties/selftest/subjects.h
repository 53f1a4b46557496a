// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/faults/sound_meshes.h"

namespace plumbline::selftest {

/// Something that makes meshes in plan: a method's frames, or nobody's method.
struct Subject {
  std::string name;
  /// A random mesh; nothing if this frame of a method that does not promise conforming meshes is not sound
  /// by itself.
  std::function<std::optional<faults::Surface>(Random&)> make;
};

/// Foreign meshes first, then every built-in variant that takes a terrain. Not a user's own: the score is the
/// oracles', and the same beside whatever methods they judge.
const std::vector<Subject>& fault_subjects();

/// A closed mesh of a general shape: a pebble, or what a method that takes objects draws of it.
Mesh random_solid(Random& random);

/// Small meshes that are sound by construction or by promise, cheap ones far more often than methods' frames.
faults::Surface clean_mesh(std::size_t number, Random& random);

}  // namespace plumbline::selftest
