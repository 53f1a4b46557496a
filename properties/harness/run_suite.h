// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/verdict/verdict.h"
#include "scenarios/suite.h"

namespace plumbline {

/// Which methods of the suite to fly, and how.
struct RunOptions {
  int jobs = 0;                                      ///< 0: as many as the machine has cores
  std::vector<std::string> methods;                  ///< keep only these of the suite (full ids); empty: all
  std::string isa;                                   ///< Embree's instruction set, "" for the best
  std::optional<std::filesystem::path> mesh_folder;  ///< write <run>/<frame>.ply there
  bool pictures = true;
  std::function<void(std::size_t done, std::size_t total)>
      progress;                                  ///< frames judged; called from any thread
  const std::atomic<bool>* cancelled = nullptr;  ///< polled between frames
};

/// What a flown suite gives: for results.json, for timing.json, for images/.
struct SuiteOutcome {
  verdict::SuiteVerdict verdict;
  verdict::SuiteTiming timing;
  std::vector<verdict::FramePictures> pictures;  ///< for each terrain and method its worst frame
};

/// Flies every method over every terrain, trajectory and threshold of the suite and judges each frame with
/// every oracle. The verdict depends on the suite alone, never on jobs, build or machine. Throws InputError
/// for a terrain that cannot be read or a method that cannot take it.
SuiteOutcome run_suite(const Suite& suite, const RunOptions& options);

}  // namespace plumbline
