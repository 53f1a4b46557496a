// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/decimation/decimation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::decimation {

std::size_t triangles_for(double triangles_at_1px, double threshold_px, std::size_t full) {
  constexpr std::size_t kLeast = 2;  // a rectangle's
  const double wanted = std::floor(triangles_at_1px / threshold_px);
  if (!(wanted < static_cast<double>(full))) return full;
  return std::min(full, std::max(kLeast, static_cast<std::size_t>(wanted)));
}

OptionDescription triangles_at_1px_option() {
  return {"triangles_at_1px", "triangles at a threshold of 1 px; at τ px this number is divided by τ",
          kTrianglesAt1px};
}

double read_triangles_at_1px(const std::string& method, const Options& options) {
  const double value = option_number(options, "triangles_at_1px", kTrianglesAt1px);
  if (!(value >= 2 && value <= 1e9))
    throw InputError(fmt::format("{}: option triangles_at_1px = {} is not inside [2, 10^9]", method, value));
  return value;
}

void require_sound_indices(const Mesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError(fmt::format("the position of vertex {} is not finite", v));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= mesh.positions.size())
        throw InputError(
            fmt::format("triangle {} names vertex {} of {} vertices", t, v, mesh.positions.size()));
    }
  }
}

void ViewIndependent::prepare(const Terrain& terrain) {
  if (terrain.columns < 2 || terrain.rows < 2)
    throw InputError(fmt::format("{}: the terrain has no cell; give at least 2 x 2 samples", name_));
  auto prepared = std::make_shared<Prepared>();
  prepared->objects.push_back(make_(reference_mesh(terrain), true));
  prepared->full = prepared->objects[0]->full_triangles();
  prepared->domain = full_domain(terrain);
  prepared_ = std::move(prepared);
}

void ViewIndependent::prepare_objects(const std::vector<Mesh>& objects) {
  auto prepared = std::make_shared<Prepared>();
  for (std::size_t o = 0; o < objects.size(); ++o) {
    try {
      prepared->objects.push_back(make_(objects[o], false));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: object {}: {}", name_, o, error.what()));
    }
    prepared->full += prepared->objects.back()->full_triangles();
  }
  prepared_ = std::move(prepared);
}

LodFrame ViewIndependent::assemble(const Prepared& prepared, std::size_t triangles) {
  LodFrame frame;
  frame.domain = prepared.domain;
  for (std::size_t o = 0; o < prepared.objects.size(); ++o) {
    const Simplifier& object = *prepared.objects[o];
    // Fewer than 2^32 triangles each: the product stays below 2^64.
    const std::size_t share = prepared.full == 0 ? 0 : triangles * object.full_triangles() / prepared.full;
    const Decimated part = object.at(share);
    const auto base = static_cast<std::uint32_t>(frame.mesh.positions.size());
    frame.mesh.positions.insert(frame.mesh.positions.end(), part.mesh.positions.begin(),
                                part.mesh.positions.end());
    for (const auto& [a, b, c] : part.mesh.triangles)
      frame.mesh.triangles.push_back({base + a, base + b, base + c});
    for (const std::uint64_t key : part.keys) frame.vertex_keys.push_back((std::uint64_t{o} << 32) + key);
  }
  return frame;
}

void ViewIndependent::update(const Camera&, LodFrame& frame) {
  const std::size_t triangles = triangles_for(triangles_at_1px_, threshold_px(), prepared_->full);
  std::shared_ptr<const LodFrame> shown;
  {
    // Who comes second waits for the first: the mesh is made once.
    const std::lock_guard<std::mutex> guard(prepared_->lock);
    auto& made = prepared_->made[triangles];
    if (!made) made = std::make_shared<const LodFrame>(assemble(*prepared_, triangles));
    shown = made;
  }
  frame = *shown;  // the counters stay 0: nothing is decided
}

}  // namespace plumbline::decimation
