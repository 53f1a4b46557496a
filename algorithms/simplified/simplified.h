// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/lod_method.h"
#include "algorithms/registry.h"

/// What the view-independent simplifiers share: the whole mesh is simplified once per triangle count, and
/// every camera gets the same.
namespace plumbline::simplified {

/// Simplifies to `triangles`, or to as few as the library reaches. Borders stay where they are. The result
/// indexes the full mesh's vertices, used or not; they may have moved. Throws InputError for a mesh that it
/// cannot take.
using Simplify = std::function<Mesh(const Mesh& full, std::size_t triangles)>;

struct Settings {
  double triangles_at_1px = 20000;
};

/// Triangles that a threshold grants: triangles_at_1px / τ, at least 2, at most `full`. The error of a
/// piecewise linear approximation falls as its triangles rise, one to one, so this makes a threshold of twice
/// the pixels a mesh of about twice the error.
std::size_t triangle_count(const Settings& settings, double threshold_px, std::size_t full);

/// The option `triangles` as both simplifiers have it, and its reading. Throws InputError unless it lies in
/// [2, 10⁹].
OptionDescription triangles_option();
Settings read_settings(const std::string& method, const Options& options);

/// A method over such a library. A vertex's key is its index in the full mesh: of a terrain the sample's, of
/// objects counted through all of them. Clones share what was simplified; any of them may be the first to ask
/// for a count, and the others wait.
std::unique_ptr<LodMethod> make_simplified(Simplify simplify, const Settings& settings);

}  // namespace plumbline::simplified
