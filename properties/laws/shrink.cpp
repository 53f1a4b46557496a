// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Shrinking: what may be taken away from a counterexample, and RapidCheck's walk down the tree of that.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <rapidcheck.h>

#include "properties/laws/generators.h"
#include "properties/laws/trial.h"
#include "scenarios/error.h"

namespace plumbline::properties {
namespace {

/// Collects candidates; only those that are simpler stay.
class Candidates {
 public:
  explicit Candidates(const LawInput& from) : from_(from), limit_(complexity(from)) {}
  /// A copy of the input, changed by `change`.
  template <typename F>
  void try_change(F&& change) {
    LawInput candidate = from_;
    change(candidate);
    if (complexity(candidate) < limit_) inputs_.push_back(std::move(candidate));
  }
  std::vector<LawInput> take() { return std::move(inputs_); }

 private:
  const LawInput& from_;
  std::vector<double> limit_;
  std::vector<LawInput> inputs_;
};

void shift(LawInput& input, Vec3 by) {
  for (CameraPose& pose : input.poses) pose = {pose.position - by, pose.look_at - by};
}

/// The window of columns × rows samples from (i0, j0), every `step`-th; cameras keep their place over it.
void cut(LawInput& input, int i0, int j0, int columns, int rows, int step) {
  const Terrain whole = input.terrain;
  Terrain& part = input.terrain;
  part.columns = columns;
  part.rows = rows;
  part.spacing_m = whole.spacing_m * step;
  part.heights_m.clear();
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) part.heights_m.push_back(whole.z(i0 + i * step, j0 + j * step));
  }
  shift(input, {i0 * whole.spacing_m, j0 * whole.spacing_m, 0});
}

/// The largest second difference of a sample along x and y, metres: about the error it makes where it is left
/// out.
double second_difference_m(const Terrain& terrain, std::size_t k) {
  const int i = static_cast<int>(k) % terrain.columns, j = static_cast<int>(k) / terrain.columns;
  double result = 0;
  if (i > 0 && i + 1 < terrain.columns) {
    result = std::fabs(terrain.z(i, j) - (terrain.z(i - 1, j) + terrain.z(i + 1, j)) / 2);
  }
  if (j > 0 && j + 1 < terrain.rows) {
    result = std::max(result, std::fabs(terrain.z(i, j) - (terrain.z(i, j - 1) + terrain.z(i, j + 1)) / 2));
  }
  return result;
}

/// Sets the threshold to what sample k is worth by a little more, in three digits. A simpler height or camera
/// alone would often lose the counterexample, since what was decided by little is then decided by much.
void retune(LawInput& input, std::size_t k) {
  const CameraPose& pose = input.poses.back();
  if (pose.position == pose.look_at) return;
  const Camera camera =
      make_camera(pose.position, pose.look_at, input.fov_y_deg, input.width_px, input.height_px);
  const int i = static_cast<int>(k) % input.terrain.columns, j = static_cast<int>(k) / input.terrain.columns;
  const double depth_m = camera.depth(input.terrain.point(i, j));
  const double error_m = second_difference_m(input.terrain, k);
  if (!(depth_m > 0 && error_m > 0)) return;
  constexpr double kLittle = 0.984375;
  double threshold_px = error_m * camera.kappa_px / depth_m * kLittle, unit = 1;
  while (threshold_px * unit < 100 && unit < 1e12) unit *= 10;
  threshold_px = std::round(threshold_px * unit) / unit;
  if (threshold_px > 0) input.threshold_px = threshold_px;
}

std::size_t most_curved_sample(const Terrain& terrain) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < terrain.heights_m.size(); ++k) {
    if (second_difference_m(terrain, k) > second_difference_m(terrain, best)) best = k;
  }
  return best;
}

void smaller_terrains(const LawInput& input, Candidates& candidates) {
  const int columns = input.terrain.columns, rows = input.terrain.rows;
  // Sides 2ᵃ·m + 1 with m = 1, 2, 3 cover squares and rows of clusters.
  const auto sides = [](int longest) {
    std::vector<int> result;
    for (int side = 3; side <= longest; ++side) {
      int cells = side - 1;
      while (cells % 2 == 0) cells /= 2;
      // One less than now, for methods that take any size.
      if (cells <= 3 || side + 1 == longest) result.push_back(side);
    }
    return result;
  };
  for (const int c : sides(columns)) {
    for (const int r : sides(rows)) {
      if (c == columns && r == rows) continue;
      // Windows at every offset where there are few, at multiples of half a window where there are many.
      const int step_i = columns <= 9 ? 1 : std::max(1, (c - 1) / 2);
      const int step_j = rows <= 9 ? 1 : std::max(1, (r - 1) / 2);
      for (int j0 = 0; j0 + r <= rows; j0 += step_j) {
        for (int i0 = 0; i0 + c <= columns; i0 += step_i) {
          candidates.try_change([&](LawInput& smaller) { cut(smaller, i0, j0, c, r, 1); });
        }
      }
    }
  }
  if (columns > 3 && rows > 3) {
    candidates.try_change(
        [&](LawInput& smaller) { cut(smaller, 0, 0, (columns + 1) / 2, (rows + 1) / 2, 2); });
  }
}

void simpler_heights(const LawInput& input, Candidates& candidates) {
  const Terrain& terrain = input.terrain;
  const auto change_all = [&](auto&& change) {
    candidates.try_change([&](LawInput& simpler) {
      for (int j = 0; j < terrain.rows; ++j) {
        for (int i = 0; i < terrain.columns; ++i) {
          double& z = simpler.terrain.heights_m[terrain.index(i, j)];
          z = change(i, j, z);
        }
      }
    });
  };
  change_all([](int, int, double) { return 0.0; });
  // A unit cell: the whole scene scaled, then its heights whole again.
  for (const bool make_whole : {true, false}) {
    candidates.try_change([&](LawInput& simpler) {
      const double scale = 1 / simpler.terrain.spacing_m;
      simpler.terrain.spacing_m = 1;
      scale_lengths(simpler, scale);
      for (double& z : simpler.terrain.heights_m) z = make_whole ? std::round(z * scale) : z * scale;
      for (CameraPose& pose : simpler.poses) {
        pose = {pose.position * scale, pose.look_at * scale};
        if (!make_whole) continue;
        for (Vec3* p : {&pose.position, &pose.look_at})
          *p = {std::round(p->x), std::round(p->y), std::round(p->z)};
      }
      if (make_whole) retune(simpler, most_curved_sample(simpler.terrain));
    });
  }
  // Down to the ground: heights and cameras sink together.
  for (const double level : {terrain.lowest_m(), terrain.highest_m(), terrain.z(0, 0)}) {
    candidates.try_change([&](LawInput& simpler) {
      for (double& z : simpler.terrain.heights_m) z -= level;
      shift(simpler, {0, 0, level});
    });
  }
  for (int j0 = 0; j0 < terrain.rows; ++j0) {
    change_all([&](int, int j, double z) { return j == j0 ? 0.0 : z; });
  }
  for (int i0 = 0; i0 < terrain.columns; ++i0) {
    change_all([&](int i, int, double z) { return i == i0 ? 0.0 : z; });
  }
  change_all([](int, int, double z) { return std::trunc(z / 2); });
  change_all([](int, int, double z) { return std::trunc(z); });
  change_all([](int, int, double z) { return z - (z > 0 ? 1 : z < 0 ? -1 : 0); });
  if (terrain.heights_m.size() > 300) return;  // sample by sample only once the terrain is small
  for (std::size_t k = 0; k < terrain.heights_m.size(); ++k) {
    const double z = terrain.heights_m[k];
    for (const double simpler_z : {0.0, std::trunc(z / 2), std::trunc(z * 0.9), z - 1, z + 1}) {
      candidates.try_change([&](LawInput& simpler) { simpler.terrain.heights_m[k] = simpler_z; });
      candidates.try_change([&](LawInput& simpler) {
        simpler.terrain.heights_m[k] = simpler_z;
        retune(simpler, most_curved_sample(simpler.terrain));
      });
    }
  }
}

/// `x` with fewer digits: a multiple of 10ⁿ (n may be negative, as a division, to stay decimal).
double rounded(double x, int n) {
  double power = 1;
  for (int k = 0; k < std::abs(n); ++k) power *= 10;
  return n >= 0 ? std::round(x / power) * power : std::round(x * power) / power;
}

void simpler_cameras(const LawInput& input, Candidates& candidates) {
  const std::size_t curved = most_curved_sample(input.terrain);
  const auto change_pose = [&](auto&& change) {
    candidates.try_change([&](LawInput& simpler) { change(simpler.poses.back()); });
    candidates.try_change([&](LawInput& simpler) {
      change(simpler.poses.back());
      retune(simpler, curved);
    });
  };
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    for (Vec3 CameraPose::*end : {&CameraPose::position, &CameraPose::look_at}) {
      change_pose([&](CameraPose& pose) { pose.*end.*axis = 0; });
      for (int n = 4; n >= 0; --n)
        change_pose([&](CameraPose& pose) { pose.*end.*axis = rounded(pose.*end.*axis, n); });
      change_pose([&](CameraPose& pose) { pose.*end.*axis = std::trunc(pose.*end.*axis / 2); });
      for (const double by : {-1.0, 1.0}) change_pose([&](CameraPose& pose) { pose.*end.*axis += by; });
    }
    change_pose([&](CameraPose& pose) { pose.look_at.*axis = pose.position.*axis; });
    // Both ends together: the view direction stays.
    for (const double fraction : {1.0, 0.5, 0.1}) {
      change_pose([&](CameraPose& pose) {
        const double by = std::trunc(pose.position.*axis * fraction);
        pose.position.*axis -= by;
        pose.look_at.*axis -= by;
      });
    }
  }
  change_pose([](CameraPose& pose) {  // straight down
    pose.look_at = {pose.position.x, pose.position.y, 0};
  });
  // The threshold goes along with κ, so that κ/τ stays near what it was.
  const auto kappa_px = [](const LawInput& in) {
    return make_camera({0, 0, 0}, {0, 1, 0}, in.fov_y_deg, in.width_px, in.height_px).kappa_px;
  };
  for (const int side : {2, 200}) {
    candidates.try_change([&](LawInput& simpler) {
      simpler.fov_y_deg = 90;
      simpler.width_px = simpler.height_px = side;
      simpler.threshold_px *= kappa_px(simpler) / kappa_px(input);
    });
  }
  if (!(input.threshold_px > 1e-12 && input.threshold_px < 1e12)) return;
  for (int n = 3; n >= -12; --n) {
    for (const double by : {0.0, 1.0, -1.0}) {  // to the nearest, and one step to either side
      double step = 1;
      for (int k = 0; k < std::abs(n); ++k) step = n > 0 ? step * 10 : step / 10;
      const double threshold_px = rounded(input.threshold_px + by * step, n);
      if (threshold_px > 0) {
        candidates.try_change([&](LawInput& simpler) { simpler.threshold_px = threshold_px; });
      }
    }
  }
}

/// Whether the law is violated in the way that is being shrunk.
std::optional<LawOutcome> violated_alike(const Law& law, const LawInput& input, const LawOutcome& like,
                                         const std::function<bool(const LawInput&)>& accept) {
  try {
    if (accept && !accept(input)) return std::nullopt;
    LawOutcome outcome = judge(law, input);
    if (outcome.kind != LawOutcome::Kind::violated) return std::nullopt;
    if (outcome.finding.has_value() != like.finding.has_value()) return std::nullopt;
    if (outcome.finding && outcome.finding->code != like.finding->code) return std::nullopt;
    return outcome;
  } catch (const InputError&) {
    return std::nullopt;  // a size or camera that nobody takes
  }
}

}  // namespace

std::vector<double> complexity(const LawInput& input) {
  double samples_not_0 = 0, heights = 0, characters = 0, largest = 0;
  for (const double z : input.terrain.heights_m) {
    samples_not_0 += z != 0 ? 1 : 0;
    heights += std::fabs(z);
  }
  const auto count = [&](double x) {
    characters += static_cast<double>(fmt::format("{}", x).size());
    largest = std::max(largest, std::fabs(x));
  };
  for (const CameraPose& pose : input.poses) {
    for (const Vec3 p : {pose.position, pose.look_at}) {
      for (const double x : {p.x, p.y, p.z}) count(x);
    }
  }
  const double coordinates = largest;
  count(input.threshold_px);
  count(input.fov_y_deg);
  count(input.height_px);
  count(input.width_px);
  count(input.terrain.spacing_m);
  return {static_cast<double>(input.poses.size()),
          static_cast<double>(input.terrain.heights_m.size()),
          static_cast<double>(input.options.size()),
          samples_not_0,
          heights,
          characters,
          coordinates};
}

std::vector<LawInput> simpler_inputs(const LawInput& input) {
  Candidates candidates(input);
  if (input.poses.size() > 1) {
    candidates.try_change(
        [](LawInput& simpler) { simpler.poses.erase(simpler.poses.begin(), simpler.poses.end() - 1); });
    for (std::size_t k = 0; k < input.poses.size(); ++k) {
      candidates.try_change([&](LawInput& simpler) {
        simpler.poses.erase(simpler.poses.begin() + static_cast<std::ptrdiff_t>(k));
      });
    }
  }
  smaller_terrains(input, candidates);
  if (!input.options.empty()) {
    candidates.try_change([](LawInput& simpler) { simpler.options.clear(); });
    for (const auto& [name, value] : input.options) {
      candidates.try_change([&, &option = name](LawInput& simpler) { simpler.options.erase(option); });
    }
  }
  simpler_heights(input, candidates);
  simpler_cameras(input, candidates);
  return candidates.take();
}

Shrunk shrink(const Law& law, const LawInput& input, const LawOutcome& outcome, std::uint64_t trials_max,
              const std::function<bool(const LawInput&)>& accept) {
  Shrunk best{input, outcome, 0};
  auto node = rc::shrinkable::shrinkRecur(
      input, [](const LawInput& from) { return rc::seq::fromContainer(simpler_inputs(from)); });
  for (bool descended = true; descended;) {
    descended = false;
    auto children = node.shrinks();
    while (best.trials < trials_max) {
      const auto child = children.next();
      if (!child) break;
      ++best.trials;
      LawInput candidate = child->value();
      if (auto found = violated_alike(law, candidate, outcome, accept)) {
        best.input = std::move(candidate);
        best.outcome = std::move(*found);
        node = *child;
        descended = true;
        break;
      }
    }
  }
  return best;
}

}  // namespace plumbline::properties
