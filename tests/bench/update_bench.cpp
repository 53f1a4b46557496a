// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cost of the methods on a fractal terrain of 1025 × 1025 samples, each as a ratio to a floor measured in the
// same run:
//   update   one coherent frame of about 20 000 triangles (`full`: all of them) against copying that frame's
//            mesh once, positions and indices
//   prepare  against one memcpy of the heights
// --brief: a terrain of 257 × 257, few repetitions.
#include <cstring>

#include <fmt/format.h>

#include "tests/bench/update_support.h"

namespace plumbline::bench {
namespace {

void run(const std::string& id, const Terrain& terrain, int repetitions) {
  const std::vector<Camera> flight = short_flight(terrain);
  const auto method = make_method(id);
  std::vector<double> copy(terrain.heights_m.size());
  const double heights_s = least_seconds(21, [&] {
    std::memcpy(copy.data(), terrain.heights_m.data(), copy.size() * sizeof(double));
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
  });
  const double prepare_s = least_seconds(std::min(repetitions, 7), [&] { method->prepare(terrain); });
  if (!find_method(id).promises(Promise::threshold_blind)) {
    method->set_threshold_px(threshold_for_budget(*method, flight.front()));
  }
  const UpdateCost cost = time_updates(*method, flight, repetitions_of(id, repetitions));
  fmt::print("{:<28}{:>10.0f}{:>11.3f}{:>11.4f}{:>9.1f}{:>12.1f}{:>11.2f}{:>9.1f}\n", id, cost.triangles,
             cost.update_s * 1e3, cost.copy_s * 1e3, cost.update_s / cost.copy_s, prepare_s * 1e3,
             heights_s * 1e3, prepare_s / heights_s);
}

}  // namespace
}  // namespace plumbline::bench

int main(int count, char** arguments) {
  using namespace plumbline::bench;
  const bool brief = count > 1 && std::string(arguments[1]) == "--brief";
  const plumbline::Terrain terrain = fractal_terrain(brief ? 257 : 1025);
  fmt::print("{:<28}{:>10}{:>11}{:>11}{:>9}{:>12}{:>11}{:>9}\n", "method", "triangles", "update ms",
             "copy ms", "ratio", "prepare ms", "memcpy ms", "ratio");
  for (const std::string& id : all_method_ids()) run(id, terrain, brief ? 2 : 31);
  return 0;
}
