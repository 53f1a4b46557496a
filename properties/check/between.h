// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "properties/check/examination.h"

namespace plumbline::checking {

/// Normals of tiles are kept in two bytes, which turns each by up to 0.95 degrees: two that were one may
/// differ by twice that.
inline constexpr double kNormalSeamDeg = 2;

/// Two subjects side by side.
struct Pair {
  std::uint32_t first = 0, second = 0;
  double height_unit_m = 1;
  double quantum_m = 0;   ///< gaps up to this are their height quantization
  bool must_meet = true;  ///< false: tiles of different levels, which no format promises to meet
  /// From the plan of the comparison to the files' coordinates; empty: the frame's.
  std::function<Vec3(Vec3)> to_file = {};
};

/// Enters a seam into the verdict: its table, the least skirts, the worst gaps as findings.
void report_seam(Examination& exam, const Pair& pair, const oracle::Seam& seam);
void list_gaps(Examination& exam, const Pair& pair, const oracle::Seam& seam);
void judge_normals(Examination& exam, const Pair& pair, const oracle::Seam& seam);

/// Seams between quantized tiles of equal and neighbouring levels, and the balance of levels.
void judge_tiles_between(Examination& exam);

}  // namespace plumbline::checking
