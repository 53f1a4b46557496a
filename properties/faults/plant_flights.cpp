// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faults for O5: flights as plain data, with one instability amid steady change.
#include <algorithm>
#include <utility>

#include "properties/faults/measured_faults.h"

namespace plumbline::faults {
namespace {

constexpr int kFrames = 60;
constexpr std::uint64_t kOthers = 20;  ///< vertices that change once and then rest

/// One vertex changes twice, `apart` frames apart, among others that change once.
std::optional<Tally> change_twice(const Judges& judges, Random& random, int apart) {
  const bool sound = apart > oracle::kToggleFrames;
  std::vector<FrameChange> flight(kFrames);
  const auto frame_below = [&](int n) {
    return static_cast<std::size_t>(1 + random.below(static_cast<std::uint64_t>(n - 1)));
  };
  const auto change = [&](std::size_t frame, bool enter, std::uint64_t key) {
    (enter ? flight[frame].entered : flight[frame].left).push_back(key);
  };
  const std::uint64_t restless = random.below(kOthers + 1);
  const std::size_t first = frame_below(kFrames - apart);
  const std::size_t second = first + static_cast<std::size_t>(apart);
  const bool enters = random.below(2) == 0;
  for (std::uint64_t key = 0; key <= kOthers; ++key) {
    if (key != restless) {
      change(frame_below(kFrames), random.below(2) == 0, key);
      continue;
    }
    change(first, enters, key);
    change(second, !enters, key);
  }
  const std::vector<std::size_t> toggles = judges.toggles(flight);
  std::size_t all = 0;
  for (const std::size_t count : toggles) all += count;
  if (sound) return tally(true, all > 0, false, false, false);
  const std::size_t here = toggles[second];
  return tally(false, all > 0, all >= 1, here == 1, all > 1);
}

std::optional<Tally> toggle(const Judges& judges, Random& random) {
  return change_twice(judges, random, 1 + static_cast<int>(random.below(oracle::kToggleFrames)));
}

std::optional<Tally> steady_change(const Judges& judges, Random& random) {
  return change_twice(judges, random, oracle::kToggleFrames + 1 + static_cast<int>(random.below(20)));
}

/// Several cuts in a flight that is good but for the frames after one of them.
std::optional<Tally> cuts(const Judges& judges, Random& random, int bad_frames) {
  std::vector<std::pair<bool, bool>> flight(kFrames, {false, true});
  for (int k = 0; k < 3; ++k) flight[static_cast<std::size_t>(5 + 18 * k)].first = true;
  const auto late = static_cast<std::size_t>(5 + 18 * static_cast<int>(random.below(3)));
  for (int k = 0; k < bad_frames; ++k) flight[late + static_cast<std::size_t>(k)].second = false;
  const int frames = judges.recovery(flight);
  return tally(bad_frames == 0, frames > 0, frames == bad_frames, true, false);
}

std::optional<Tally> late_recovery(const Judges& judges, Random& random) {
  return cuts(judges, random, 1 + static_cast<int>(random.below(15)));
}

std::optional<Tally> ready_recovery(const Judges& judges, Random& random) { return cuts(judges, random, 0); }

/// The meshes of two flights to one camera: alike but for some vertices, as with hysteresis.
std::optional<Tally> two_ways(const Judges& judges, Random& random, std::size_t strangers) {
  std::vector<std::uint64_t> one, other;
  for (std::uint64_t key = 0; one.size() < 200; key += 1 + random.below(5)) {
    one.push_back(key);
    other.push_back(key);
  }
  for (std::size_t k = 0; k < strangers; ++k) {
    auto& keys = random.below(2) == 0 ? one : other;
    keys.push_back(10'000 + k);
  }
  const std::size_t differing = judges.keys(one, other);
  return tally(strangers == 0, differing > 0, differing == strangers, true, false);
}

std::optional<Tally> hysteresis(const Judges& judges, Random& random) {
  return two_ways(judges, random, 1 + random.below(20));
}

std::optional<Tally> no_hysteresis(const Judges& judges, Random& random) {
  return two_ways(judges, random, 0);
}

/// None of these needs a closed mesh.
template <std::optional<Tally> (*plant)(const Judges&, Random&)>
std::optional<Tally> trial(const Judges& judges, Random& random, const MakeSolid& /*solid*/) {
  return plant(judges, random);
}

}  // namespace

std::vector<MeasuredFault> flight_faults() {
  constexpr auto kOracle = "O5 stability";
  return {
      {kOracle, "vertex_toggles", "a vertex changes twice within ten frames: counted, in that frame", false,
       trial<toggle>},
      {kOracle, "vertex_changes", "a vertex changes twice, eleven frames apart or more", true,
       trial<steady_change>},
      {kOracle, "recovers_late", "bad frames after one of three cuts: how many", false, trial<late_recovery>},
      {kOracle, "recovers_at_once", "three cuts, each good at once", true, trial<ready_recovery>},
      {kOracle, "ways_differ", "two flights to one camera that end in other vertices: how many", false,
       trial<hysteresis>},
      {kOracle, "ways_agree", "two flights that end in the same vertices", true, trial<no_hysteresis>},
  };
}

}  // namespace plumbline::faults
