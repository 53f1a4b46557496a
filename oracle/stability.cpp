// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/stability.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plumbline::oracle {

std::size_t ToggleWatch::next(int frame, std::span<const std::uint64_t> entered,
                              std::span<const std::uint64_t> left) {
  // A vertex cannot enter and leave at once, so the changes are one sorted list.
  std::vector<std::uint64_t> changed;
  changed.reserve(entered.size() + left.size());
  std::merge(entered.begin(), entered.end(), left.begin(), left.end(), std::back_inserter(changed));

  std::size_t toggles = 0;
  std::vector<Change> kept;
  kept.reserve(recent_.size() + changed.size());
  auto old = recent_.begin();
  for (const std::uint64_t key : changed) {
    for (; old != recent_.end() && old->key < key; ++old) {
      if (frame - old->frame < kToggleFrames) kept.push_back(*old);
    }
    if (old != recent_.end() && old->key == key) {
      if (frame - old->frame <= kToggleFrames) ++toggles;
      ++old;
    }
    kept.push_back({key, frame});
  }
  for (; old != recent_.end(); ++old) {
    if (frame - old->frame < kToggleFrames) kept.push_back(*old);
  }
  recent_ = std::move(kept);
  return toggles;
}

KeyDifference compare_keys(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
  std::size_t common = 0;
  auto other = b.begin();
  for (const std::uint64_t key : a) {
    while (other != b.end() && *other < key) ++other;
    if (other != b.end() && *other == key) ++common;
  }
  return {a.size() + b.size() - 2 * common, a.size() + b.size() - common};
}

Camera jittered(const Camera& camera, double mean_depth_m) {
  Camera out = camera;
  double turn_px = kJitterPx;
  if (std::isfinite(mean_depth_m)) {
    turn_px = kJitterPx / 2;
    out.position = camera.position + camera.right() * (kJitterPx / 2 / camera.kappa_px * mean_depth_m);
  }
  // A turn by the angle whose tangent is turn_px/κ; `up` stays orthogonal to the new direction.
  out.forward = normalized(camera.forward + camera.right() * (turn_px / camera.kappa_px));
  return out;
}

double median_step_m(std::span<const Camera> flight) {
  std::vector<double> steps_m;
  for (std::size_t f = 1; f < flight.size(); ++f) {
    steps_m.push_back(length(flight[f].position - flight[f - 1].position));
  }
  if (steps_m.empty()) return 0;
  const auto middle = steps_m.begin() + static_cast<std::ptrdiff_t>((steps_m.size() - 1) / 2);
  std::nth_element(steps_m.begin(), middle, steps_m.end());
  return *middle;
}

bool is_cut(const Camera& before, const Camera& now, double mean_depth_m, double median_step_m) {
  const double step_m = length(now.position - before.position);
  if (step_m > kCutShareOfDepth * mean_depth_m && step_m > kCutTimesMedianStep * median_step_m) return true;
  // cos of the horizontal field of view, from the tangent of its half.
  const double half = before.width_px * 0.5 / before.kappa_px;
  return dot(before.forward, now.forward) < (1 - half * half) / (1 + half * half);
}

void RecoveryWatch::next(bool cut, bool good) {
  if (cut) {
    ++cuts_;
    if (waiting_) ++given_up_;
    waiting_ = true;
    frames_since_ = 0;
  }
  if (!waiting_) return;
  if (good) {
    waiting_ = false;
    return;
  }
  ++frames_since_;
  most_frames_ = std::max(most_frames_, frames_since_);
}

}  // namespace plumbline::oracle
