// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include "scenarios/suite.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto suite = fuzz::accepted([&] { return parse_suite(text, "a/suite.toml"); });
  const auto again = fuzz::accepted([&] { return parse_suite(text, "a/suite.toml"); });
  fuzz::require(suite == again, "a second reading gives the same suite");
  if (!suite) return 0;
  fuzz::require(!suite->methods.empty() && !suite->trajectories.empty() &&
                    !(suite->terrains.empty() && suite->meshes.empty()),
                "a suite has something to fly, with and around");
  for (const MethodSpec& method : suite->methods) {
    fuzz::require(!method.thresholds_px.empty(), "a method has thresholds");
    for (const double threshold_px : method.thresholds_px)
      fuzz::require(threshold_px > 0 && threshold_px <= 1e6, "thresholds are positive and bounded");
  }
  for (const TerrainSource& terrain : suite->terrains)
    fuzz::require(terrain.samples.size() <= size, "samples are bounded by the file's size");
  return 0;
}
