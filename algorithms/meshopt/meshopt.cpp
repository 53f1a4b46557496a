// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/meshopt/meshopt.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <meshoptimizer.h>

namespace plumbline::meshopt {
namespace {

class Simplify final : public decimation::Simplifier {
 public:
  Simplify(const Mesh& mesh, bool keep_border)
      : full_(mesh), options_(keep_border ? unsigned{meshopt_SimplifyLockBorder} : 0U) {
    // The library computes in floats: counted from the box's corner they lose less.
    Vec3 low = full_.positions.empty() ? Vec3{} : full_.positions[0];
    for (const Vec3& p : full_.positions)
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    floats_.reserve(3 * full_.positions.size());
    for (const Vec3& p : full_.positions) {
      for (const double d : {p.x - low.x, p.y - low.y, p.z - low.z}) floats_.push_back(static_cast<float>(d));
    }
  }
  [[nodiscard]] std::size_t full_triangles() const override { return full_.triangles.size(); }
  [[nodiscard]] decimation::Decimated at(std::size_t triangles) const override {
    std::vector<unsigned> indices;
    indices.reserve(3 * full_.triangles.size());
    for (const auto& t : full_.triangles) indices.insert(indices.end(), t.begin(), t.end());
    if (triangles < full_.triangles.size()) {
      // The count alone decides: no error is too large.
      constexpr float kAnyError = std::numeric_limits<float>::max();
      std::vector<unsigned> fewer(indices.size());
      fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(), floats_.data(),
                                    full_.positions.size(), 3 * sizeof(float), 3 * triangles, kAnyError,
                                    options_, nullptr));
      indices = std::move(fewer);
    }
    constexpr std::uint32_t kUnused = 0xffffffff;
    std::vector<std::uint32_t> index(full_.positions.size(), kUnused);
    for (const unsigned v : indices) index[v] = 0;
    decimation::Decimated out;
    for (std::uint32_t v = 0; v < index.size(); ++v) {
      if (index[v] == kUnused) continue;
      index[v] = static_cast<std::uint32_t>(out.mesh.positions.size());
      out.mesh.positions.push_back(full_.positions[v]);
      out.keys.push_back(v);
    }
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3)
      out.mesh.triangles.push_back({index[indices[k]], index[indices[k + 1]], index[indices[k + 2]]});
    return out;
  }

 private:
  Mesh full_;
  std::vector<float> floats_;  // x, y, z of each vertex from the low corner of the mesh's box, metres
  unsigned options_;
};

}  // namespace

std::shared_ptr<const decimation::Simplifier> make_simplifier(const Mesh& mesh, bool keep_border) {
  decimation::require_sound_indices(mesh);
  return std::make_shared<const Simplify>(mesh, keep_border);
}

}  // namespace plumbline::meshopt
