// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// line_grid: whole rows and columns of the terrain, dense where it is rough and the camera is near.
#include <algorithm>
#include <cmath>

#include "cli/program.h"

using namespace plumbline;

class LineGrid final : public LodMethod {
 public:
  void prepare(const Terrain& t) override {
    terrain_ = &t;
    for (const bool row : {false, true}) {
      const auto z = [&](int k, int n) { return row ? t.z(n, k) : t.z(k, n); };
      const int lines = row ? t.rows : t.columns, samples = row ? t.columns : t.rows;
      std::vector<double>& m = errors_m_[row];
      m.assign(lines, HUGE_VAL);  // the rim stays; line k: how far off the middle of lines k ± s
      for (int k = 1, s = 1; k + s < lines; ++k, s = k & -k)
        for (int n = 0; n < samples; ++n)
          m[k] = std::max(n > 0 ? m[k] : 0, std::abs(z(k, n) - (z(k - s, n) + z(k + s, n)) / 2));
    }
  }
  void update(const Camera& camera, LodFrame& frame) override {
    frame = {{}, {}, full_domain(*terrain_), {}};
    const std::vector<int> columns = kept(errors_m_[0], camera.kappa_px, camera.position.x);
    const auto width = static_cast<std::uint32_t>(columns.size());
    for (const int j : kept(errors_m_[1], camera.kappa_px, camera.position.y))
      for (const int i : columns) {
        const auto at = static_cast<std::uint32_t>(frame.mesh.positions.size());
        frame.mesh.positions.push_back(terrain_->point(i, j));
        frame.vertex_keys.push_back(terrain_->index(i, j));
        if (i == 0 || j == 0) continue;
        frame.mesh.triangles.push_back({at - width - 1, at - width, at});  // counter-clockwise
        frame.mesh.triangles.push_back({at - width - 1, at, at - 1});
      }
  }
  void reset() override {}  // nothing is kept from frame to frame
  std::unique_ptr<LodMethod> clone() const override { return std::make_unique<LineGrid>(*this); }

 private:
  std::vector<int> kept(const std::vector<double>& m, double kappa_px, double x_m) const {
    std::vector<int> lines;
    for (int k = 0; k < std::ssize(m); ++k)
      if (kappa_px * m[k] > threshold_px() * std::abs(k * terrain_->spacing_m - x_m)) lines.push_back(k);
    return lines;
  }
  const Terrain* terrain_ = nullptr;
  std::vector<double> errors_m_[2];  // of columns and rows
};

int main(int argc, char** argv) {
  using enum Promise;
  MethodDescription own{.id = "line_grid", .title = "Rows and columns by their error over distance"};
  own.variants = {{"", "", {conforming, covers_domain, monotone_in_tau, idempotent, path_independent}}};
  own.make = [](auto, const Options&) { return std::make_unique<LineGrid>(); };
  return run_program(argc, argv, {own});
}
