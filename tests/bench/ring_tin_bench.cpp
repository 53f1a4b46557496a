// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cost of M2's coherent frame on the paper's largest TIN (132 849 triangles, 10 m apart) when the viewer
// steps 1 m: against simplifying the same TIN from scratch at the same place (a first frame), in the same
// run. Of each frame the time is that of `update`, with the writing of its mesh; the share of that is shown
// too. Forward along the grid, whole columns change rings every tenth step; along a slanted way they do so
// bit by bit.
// --brief: few frames.
#include <algorithm>
#include <ctime>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "tests/bench/update_support.h"
#include "tests/properties/m2_support.h"

namespace plumbline::bench {
namespace {

/// Processor time of this thread: what a frame costs, whatever else the machine is doing.
template <class Call>
double cpu_seconds(Call&& call) {
  const auto now = [] {
    std::timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
  };
  const double start = now();
  call();
  return now() - start;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run(ring_tin::Variant variant, const char* name, const m2::TrimmedTin& t, double relief_m, Vec2 step,
         int frames) {
  ring_tin::RingTin method(m2::settings(variant));
  const double prepare_s = cpu_seconds([&] { method.prepare_tin(t.tin, t.domain); });
  LodFrame frame;
  const Vec2 start = t.middle - step * (frames / 2.0);
  const auto seconds = [&](Vec2 at) { return cpu_seconds([&] { method.update(m2::camera_at(at), frame); }); };
  std::vector<double> scratch_s, step_s, still_s;
  for (int k = 0; k < 3; ++k) {
    method.reset();
    scratch_s.push_back(seconds(start));
  }
  std::uint64_t changed = 0, reset = 0;
  for (int k = 1; k <= frames; ++k) {
    step_s.push_back(seconds(start + step * static_cast<double>(k)));
    changed += method.statistics().changed;
    reset += method.statistics().vertices_reset;
    still_s.push_back(seconds(start + step * static_cast<double>(k)));
  }
  const double from_scratch = median(scratch_s);
  const double mean = std::accumulate(step_s.begin(), step_s.end(), 0.0) / frames;
  const double worst = *std::max_element(step_s.begin(), step_s.end());
  fmt::print(
      "{:<10}{:>8.0f}{:>10}{:>11.1f}{:>12.1f}{:>9.2f}{:>9.2f}{:>9.2f}{:>8.2f}{:>8.2f}{:>9.1f}{:>9.1f}\n",
      name, relief_m, frame.mesh.triangles.size(), prepare_s * 1e3, from_scratch * 1e3, mean * 1e3,
      worst * 1e3, median(still_s) * 1e3, 100 * mean / from_scratch, 100 * worst / from_scratch,
      static_cast<double>(changed) / frames, static_cast<double>(reset) / frames);
}

}  // namespace
}  // namespace plumbline::bench

int main(int count, char** arguments) {
  using namespace plumbline;
  const bool brief = count > 1 && std::string(arguments[1]) == "--brief";
  const int frames = brief ? 20 : 200;
  fmt::print("{:<10}{:>8}{:>10}{:>11}{:>12}{:>9}{:>9}{:>9}{:>8}{:>8}{:>9}{:>9}\n", "variant", "relief m",
             "triangles", "prepare ms", "scratch ms", "step ms", "worst ms", "still ms", "step %", "worst %",
             "changed", "reset");
  for (const double relief_m : {60.0, 1000.0}) {
    const m2::TrimmedTin t = m2::trimmed_tin(m2::relief(relief_m), m2::kTable2.back());
    for (const auto& [variant, name] : {std::pair{ring_tin::Variant::published, "published"},
                                        std::pair{ring_tin::Variant::fixpoint, "fixpoint"},
                                        std::pair{ring_tin::Variant::guarded, "guarded"}}) {
      bench::run(variant, name, t, relief_m, {0, 1}, frames);
      bench::run(variant, name, t, relief_m, {0.8, 0.6}, frames);
    }
  }
  return 0;
}
