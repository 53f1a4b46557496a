// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "properties/tables/p0.h"
#include "properties/tables/p1.h"
#include "properties/tables/p2.h"
#include "properties/tables/p4.h"
#include "properties/tables/stage.h"
#include "properties/verdict/paper_table.h"

namespace plumbline::tables {

/// Everything that decides the figures. The defaults are the published sizes; tests take lesser ones.
struct TableSettings {
  Picture picture;
  std::vector<StandInSource> stand_ins;
  P0Settings p0;
  P1Settings p1;
  P2Settings p2;
  P4Settings p4;
};

/// One real terrain, read from `real_terrain` (anything that GDAL opens), and one fractal.
TableSettings published_settings(const std::filesystem::path& real_terrain);

/// A paper whose tables this build reproduces.
struct ReproducedPaper {
  std::string id;  ///< "P0"
  std::string summary;
  std::string section;  ///< in TABLES and METHODS
};
const std::vector<ReproducedPaper>& reproduced_papers();

/// The papers that are asked for, in order and once each; none named: all that there are. Throws InputError
/// for a name that is no paper's, and for one whose tables this build does not reproduce.
std::vector<std::string> choose_tables(const std::vector<std::string>& names);

struct MakeOptions {
  int jobs = 0;                                                       ///< 0: as many as the machine has cores
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< figures; called from any thread
  const std::atomic<bool>* cancelled = nullptr;
};

struct TablesOutcome {
  std::vector<Table> tables;  ///< whole ones only
  Timings timings;
  bool interrupted = false;
};

/// Runs the protocols of `papers` (as choose_tables gives them). The tables depend on the settings alone,
/// never on jobs, build or machine. Throws InputError for a terrain that cannot be read or that a method
/// cannot take.
TablesOutcome make_tables(const std::vector<std::string>& papers, const TableSettings& settings,
                          const MakeOptions& options);

}  // namespace plumbline::tables
