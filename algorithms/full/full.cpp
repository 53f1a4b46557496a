// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// full: the full-resolution grid, every frame. Role: zero error, the ceiling in triangles (METHODS, reference
// methods).
//
// The mesh is the project's declared reference surface (each cell split from its (i, j) to its (i+1, j+1)
// corner), so it has no paper. It is built once in prepare() and copied into every frame. Promises:
// everything that holds when the camera is not looked at. Not promised: symmetric, since a mirror turns the
// diagonals.
#include <cstdint>
#include <numeric>
#include <utility>

#include "algorithms/registry.h"

namespace plumbline {
namespace {

/// The full mesh of a bintree: diagonals alternate, so that every inner sample has four or eight neighbours.
/// A cell whose i + j is even keeps the diagonal of the reference.
void alternate_diagonals(const Terrain& terrain, Mesh& mesh) {
  std::size_t first = 0;  // of the cell's two triangles
  for (int j = 0; j + 1 < terrain.rows; ++j) {
    for (int i = 0; i + 1 < terrain.columns; ++i, first += 2) {
      if ((i + j) % 2 == 0) continue;
      const auto [a, b, c] = mesh.triangles[first];
      const std::uint32_t d = mesh.triangles[first + 1][2];
      mesh.triangles[first] = {a, b, d};
      mesh.triangles[first + 1] = {b, c, d};
    }
  }
}

class Full final : public LodMethod {
 public:
  explicit Full(bool alternating) : alternating_(alternating) {}

  void prepare(const Terrain& terrain) override {
    LodFrame made;
    made.mesh = reference_mesh(terrain);
    if (alternating_) alternate_diagonals(terrain, made.mesh);
    made.vertex_keys.resize(made.mesh.positions.size());
    std::iota(made.vertex_keys.begin(), made.vertex_keys.end(), std::uint64_t{0});
    made.domain = full_domain(terrain);
    whole_ = std::make_shared<const LodFrame>(std::move(made));
  }
  // Nothing is decided, so the counters stay 0.
  void update(const Camera&, LodFrame& frame) override { frame = *whole_; }
  void reset() override {}
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override { return std::make_unique<Full>(*this); }

 private:
  bool alternating_;
  std::shared_ptr<const LodFrame> whole_;
};

}  // namespace

MethodDescription describe_full() {
  using enum Promise;
  return {
      .id = "full",
      .title = "Full-resolution grid",
      .citation = "none: the declared reference surface itself (METHODS, notation)",
      .section = "reference",
      .variants =
          {{"",
            "every sample, every frame",
            {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero,
             threshold_blind, camera_blind}},
           {"alternating",
            "every sample, diagonals alternating as in a bintree: the floor under the bintree methods' error",
            {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero,
             threshold_blind, camera_blind}}},
      .options = {},
      .claims = {},
      .make = [](std::string_view variant,
                 const Options&) { return std::make_unique<Full>(variant == "alternating"); },
  };
}

}  // namespace plumbline
