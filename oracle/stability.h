// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scenarios/camera.h"

/// O5, stability: what flickers, lags behind the camera, or depends on the way (ORACLES O5). Vertices are
/// known by their identities alone, so nothing here has a tolerance.
namespace plumbline::oracle {

/// A vertex that comes back (or goes again) within so many frames toggles (ORACLES O5).
inline constexpr int kToggleFrames = 10;

/// Counts vertices that toggle along a flight: in–out–in, or out–in–out, the second change at most
/// kToggleFrames frames after the first. A vertex that changes every frame toggles every frame. Holds only
/// what changed in the last kToggleFrames frames.
class ToggleWatch {
 public:
  /// The changes against the frame before, each sorted and without repeats. What stands in the first frame
  /// has not entered. Frames must come in order. Returns how many of these changes are a toggle's second.
  std::size_t next(int frame, std::span<const std::uint64_t> entered, std::span<const std::uint64_t> left);

 private:
  struct Change {
    std::uint64_t key;
    int frame;
  };
  std::vector<Change> recent_;  ///< by key; of each vertex the latest change
};

/// How two sets of vertices differ.
struct KeyDifference {
  std::size_t differing = 0;  ///< in one of them only
  std::size_t all = 0;        ///< in either
  /// 0: the same; 1: nothing in common. Two empty sets are the same.
  [[nodiscard]] double share() const {
    return all == 0 ? 0.0 : static_cast<double>(differing) / static_cast<double>(all);
  }
};
/// Both sorted, without repeats.
KeyDifference compare_keys(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b);

/// How far the picture moves under `jittered`, pixels (ORACLES O5): far less than any eye or threshold knows.
inline constexpr double kJitterPx = 0.01;
/// The camera moved to the right and turned to the right, each so that what stands at `mean_depth_m` in the
/// middle of the picture moves by half of kJitterPx: what depends on the place and what depends on the
/// direction are both shaken. Without a depth (+∞) it turns only, by all of it.
Camera jittered(const Camera& camera, double mean_depth_m);

/// A step is a cut if it is longer than this share of the mean depth in view: a camera that is carried
/// halfway to what it saw leaves little to be coherent with …
inline constexpr double kCutShareOfDepth = 0.5;
/// … and so many times longer than the flight's median step: what every frame does is how it flies.
inline constexpr double kCutTimesMedianStep = 4;
/// The median (nearest rank) of the distances between successive cameras, metres; 0 without any.
double median_step_m(std::span<const Camera> flight);
/// Whether the camera was cut from `before` to `now`: a step beyond both limits (`mean_depth_m`: mean depth
/// of what `before` saw, metres; +∞ where it saw nothing), or a turn by more than the picture's width, so
/// that the two pictures share nothing.
bool is_cut(const Camera& before, const Camera& now, double mean_depth_m, double median_step_m);

/// Frames until something is good again after each cut.
class RecoveryWatch {
 public:
  /// Frames must come in order.
  void next(bool cut, bool good);
  [[nodiscard]] std::size_t cuts() const { return cuts_; }
  /// The most frames that any cut was followed by before it was good: 0 if every first frame was. Where it
  /// never was, the frames there were (at least so many would have been needed).
  [[nodiscard]] int most_frames() const { return most_frames_; }
  /// Cuts after which it was not good in any frame up to the next cut, or the end.
  [[nodiscard]] std::size_t unrecovered() const { return given_up_ + (waiting_ ? 1 : 0); }

 private:
  std::size_t cuts_ = 0, given_up_ = 0;
  int frames_since_ = 0, most_frames_ = 0;
  bool waiting_ = false;
};

}  // namespace plumbline::oracle
