// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// uniform_grid: every 2ᵏ-th sample, with the largest k whose error in pixels is within the threshold.
#include <algorithm>
#include <cmath>

#include "cli/program.h"

using namespace plumbline;

class UniformGrid final : public LodMethod {
 public:
  void prepare(const Terrain& terrain) override {
    // Steps that divide both sides: coarse diagonals lie on fine ones, so the error is largest at a sample.
    const int east = terrain.columns - 1, north = terrain.rows - 1;
    for (int step = 1; east % step == 0 && north % step == 0; step *= 2) {
      Terrain coarse{"", east / step + 1, north / step + 1, step * terrain.spacing_m, {}};
      LodFrame& frame = frames_.emplace_back();
      for (int j = 0; j <= north; j += step) {
        for (int i = 0; i <= east; i += step) {
          coarse.heights_m.push_back(terrain.z(i, j));
          frame.vertex_keys.push_back(terrain.index(i, j));
        }
      }
      frame.mesh = reference_mesh(coarse);
      frame.domain = full_domain(terrain);
      double error_m = step == 1 ? 0 : errors_m_.back();  // never falls with k: no larger τ draws more
      for (const Vec3& p : reference_mesh(terrain).positions)
        error_m = std::max(error_m, std::abs(p.z - coarse.surface_height_m(p.x, p.y)));
      errors_m_.push_back(error_m);
    }
    highest_m_ = terrain.highest_m();
  }
  void update(const Camera& camera, LodFrame& frame) override {
    const double distance_m = camera.position.z - highest_m_;  // or more, to all of the ground
    std::size_t k = errors_m_.size() - 1;
    while (k > 0 && camera.kappa_px * errors_m_[k] > threshold_px() * distance_m) --k;
    frame = frames_[k];
  }
  void reset() override {}  // nothing is kept from frame to frame
  std::unique_ptr<LodMethod> clone() const override { return std::make_unique<UniformGrid>(*this); }

 private:
  std::vector<LodFrame> frames_;  // [k]: every 2ᵏ-th sample
  std::vector<double> errors_m_;  // [k]: of frames_[k], metres
  double highest_m_ = 0;
};

int main(int argc, char** argv) {
  using enum Promise;
  MethodDescription own;
  own.id = "uniform_grid";
  own.title = "Every 2^k-th sample of each row and column";
  own.variants = {
      {"", "", {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero}}};
  own.make = [](auto, const Options&) { return std::make_unique<UniformGrid>(); };
  return run_program(argc, argv, {own});
}
