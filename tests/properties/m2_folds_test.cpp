// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// M2.S2, M2.S6, M2.C4: what folds the published method over, the least cases of it, and that `guarded` never
// does (docs/proofs/m2_guarded_never_folds.md). Verdicts: docs/claims.md.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "algorithms/registry.h"
#include "algorithms/ring_tin/ring_tin.h"
#include "oracle/conformity.h"
#include "properties/atlas/case_file.h"
#include "properties/fuzz/fuzz.h"
#include "properties/laws/generators.h"
#include "properties/laws/trial.h"
#include "scenarios/random.h"

namespace plumbline::properties {
namespace {

using ring_tin::RingTin;

/// Every frame but the last is conforming, and the last one does nothing but reset trees.
bool only_a_reset_at_the_end(const LawInput& input) {
  if (input.poses.size() < 2) return false;
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const auto& ring = dynamic_cast<const RingTin&>(*method);
  const std::vector<Camera> flight = cameras(input);
  LodFrame frame;
  for (std::size_t k = 0; k < flight.size(); ++k) {
    method->update(flight[k], frame);
    if (k + 1 < flight.size() && !oracle::check_conformity(frame.mesh, frame.domain).clean()) return false;
  }
  return ring.statistics().trees_reset > 0 && ring.statistics().collapses == 0;
}

LawTally hunt(const char* method, std::uint64_t cases, const std::function<bool(const LawInput&)>& accept) {
  FuzzOptions options;
  options.method = method;
  options.law = "conforming";
  options.cases = cases;
  options.seed = 2;
  options.accept = accept;
  return fuzz(options).tallies.front();
}

void print(const LawTally& tally, const char* what) {
  fmt::print("{}: {} {} of {} judged\n", what, tally.method, tally.violated, tally.judged());
  if (!tally.smallest) return;
  Case found;
  found.law = tally.law;
  found.input = *tally.smallest;
  found.expected = tally.smallest_outcome;
  fmt::print("{}", case_text(found));
}

TEST(M2Folds, M2_S6_OneSimplificationFoldsWithoutAnyReset) {
  const LawTally tally = hunt("ring_tin", 600, [](const LawInput& input) { return input.poses.size() == 1; });
  print(tally, "one frame");
  EXPECT_GT(tally.violated, 10U);
}

/// From far away, then near: all in the outer ring first, a few cells in the inner one then.
LawInput drawn_approach(const char* method, std::uint64_t seed) {
  Random random(seed, "approach");
  LawInput input;
  input.method = method;
  const auto whole = [&](int low, int high) {
    return low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low + 1)));
  };
  Terrain& terrain = input.terrain;
  terrain.id = "drawn";
  terrain.columns = whole(6, 9);
  terrain.rows = whole(6, 9);
  terrain.heights_m.assign(static_cast<std::size_t>(terrain.columns * terrain.rows), 0);
  const int share = whole(1, 6);
  for (double& z : terrain.heights_m) z = whole(1, 6) <= share ? whole(0, 4) : 0;
  input.fov_y_deg = 90;
  input.width_px = input.height_px = 2;  // κ = 1 pixel
  input.options["rings_m"] = fmt::format("{} 10", whole(1, 4) * 0.5);
  input.options["delta_px"] = std::string("0 1");
  input.threshold_px = whole(1, 40) * 0.0125;  // tolerance 1/8 m to 5 m
  const double x = whole(1, terrain.columns - 2), y = whole(1, terrain.rows - 2);
  input.poses = {{{100, 0, 9}, {100, 1, 9}}, {{x, y, 9}, {x, y + 1, 9}}};
  return input;
}

TEST(M2Folds, M2_S2_AResetAloneFolds) {
  const Law& law = find_law("conforming");
  int judged = 0, folded = 0;
  std::optional<Shrunk> smallest;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    const LawInput input = drawn_approach("ring_tin", seed);
    if (!only_a_reset_at_the_end(input)) continue;
    ++judged;
    const LawOutcome outcome = judge(law, input);
    if (outcome.kind != LawOutcome::Kind::violated) continue;
    ++folded;
    if (folded > 20) continue;
    Shrunk shrunk = shrink(law, input, outcome, 20000, only_a_reset_at_the_end);
    if (!smallest || complexity(shrunk.input) < complexity(smallest->input)) smallest = std::move(shrunk);
  }
  fmt::print("{} of {} frames that only reset trees\n", folded, judged);
  ASSERT_TRUE(smallest.has_value());
  Case found;
  found.law = "conforming";
  found.input = smallest->input;
  found.expected = smallest->outcome;
  fmt::print("{}", case_text(found));
}

}  // namespace
}  // namespace plumbline::properties
