// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Expectation files, for a suite of eight runs.
#include <cstdint>

#include "scenarios/expected_file.h"
#include "tests/fuzz/fuzz.h"

namespace {

const plumbline::Suite& suite() {
  static const plumbline::Suite once = plumbline::parse_suite(R"([suite]
name = "s"
[[terrain]]
id = "hills"
samples = [[0, 1], [2, 3]]
[[trajectory]]
id = "skim"
kind = "skim"
frames = 2
[[trajectory]]
id = "spin"
kind = "spin"
frames = 2
[[method]]
id = "full"
thresholds_px = [1, 2.5]
[[method]]
id = "block_bintree:tri_cull"
thresholds_px = [1, 2.5]
)",
                                                              "suite.toml");
  return once;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto read = [&] { return parse_expected(text, "e.toml", suite()); };
  const auto expected = fuzz::accepted(read);
  fuzz::require(expected == fuzz::accepted(read), "a second reading gives the same entries");
  if (!expected) return 0;
  static const std::vector<std::string> ids = possible_run_ids(suite());
  for (const Expectation& entry : *expected)
    fuzz::require(std::any_of(ids.begin(), ids.end(),
                              [&](const std::string& id) { return run_matches(entry.run, id); }),
                  "an entry speaks of some run");
  return 0;
}
