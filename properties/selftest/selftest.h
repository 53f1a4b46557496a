// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "properties/faults/judges.h"
#include "properties/verdict/selftest_score.h"

/// The oracles put to the test: faults of every kind planted at random places of the methods' meshes and of
/// foreign ones, and random sound meshes without any (ORACLES, "Why the oracles can be believed", 1 and 3).
namespace plumbline::selftest {

struct Request {
  std::size_t faults = 10000;  ///< at least so many are planted; 0: one round
  std::size_t clean = 2000;    ///< random sound meshes
  std::uint64_t seed = 1;
  int jobs = 0;  ///< threads; 0: one a core. No byte of the score depends on it.
  /// Done and wanted, meshes of both kinds together; from any thread.
  std::function<void(std::size_t done, std::size_t total)> progress;
  const std::atomic<bool>* cancelled = nullptr;
};

/// Faults and clean meshes of the brief form that every `plumbline run` takes and reports.
Request brief_request();

verdict::SelftestScore run_selftest(const Request& request, const faults::Judges& judges);
verdict::SelftestScore run_selftest(const Request& request);

}  // namespace plumbline::selftest
