// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which tables there are, and who does what when: trials over small terrains run side by side, the large ones
// and everything that is gauged run alone, one after the other.
#include "properties/tables/make_tables.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "properties/harness/gauge.h"
#include "scenarios/error.h"
#include "scenarios/instrument.h"
#include "scenarios/nearest.h"

namespace plumbline::tables {
namespace {

/// A table on its way: a slot for every trial, stand-in by stand-in.
struct Sheet {
  Sheet(Table empty, std::size_t stand_ins, std::size_t views_of_each)
      : table(std::move(empty)), views(views_of_each), trials(stand_ins * views_of_each) {
    table.stand_ins.resize(stand_ins);
  }
  [[nodiscard]] bool whole() const {
    return std::all_of(trials.begin(), trials.end(), [](const auto& trial) { return trial.has_value(); });
  }

  Table table;
  std::size_t views;
  std::vector<std::optional<Trial>> trials;
};

using RunTrial = std::function<Trial(const Table&, const Terrain&, std::size_t view)>;

/// All trials of one table over terrains of one size.
struct Small {
  Sheet* sheet = nullptr;
  const std::vector<StandInSource>* stand_ins = nullptr;
  int size = 0;
  RunTrial run;
};

class Maker {
 public:
  Maker(const TableSettings& settings, const Workshop& workshop) : settings_(settings), workshop_(workshop) {}

  /// Small tables: every trial is a task of its own and loads its own terrain, which is cheap.
  void run_side_by_side(const std::vector<Small>& tables) {
    struct Task {
      const Small* small;
      std::size_t stand_in, view;
    };
    std::vector<Task> tasks;
    for (const Small& small : tables) {
      for (std::size_t s = 0; s < small.stand_ins->size(); ++s) {
        for (std::size_t v = 0; v < small.sheet->views; ++v) tasks.push_back({&small, s, v});
      }
    }
    tbb::parallel_for(
        std::size_t{0}, tasks.size(),
        [&](std::size_t k) {
          const auto [small, s, v] = tasks[k];
          workshop_.check();
          const StandInSource& stand_in = (*small->stand_ins)[s];
          const Terrain terrain = load_stand_in(stand_in, small->size);
          Sheet& sheet = *small->sheet;
          if (v == 0) sheet.table.stand_ins[s] = describe_stand_in(terrain, stand_in.origin);
          sheet.trials[s * sheet.views + v] = small->run(sheet.table, terrain, v);
        },
        tbb::simple_partitioner{});
  }

  /// P4: a task a mesh and contour rule.
  void run_meshes(Sheet& sheet) {
    const std::vector<MeshStandIn>& meshes = settings_.p4.meshes;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      StandIn& stand_in = sheet.table.stand_ins[m];
      stand_in.id = meshes[m].id;
      stand_in.origin = meshes[m].origin;
      stand_in.triangles = meshes[m].mesh.triangles.size();
    }
    tbb::parallel_for(
        std::size_t{0}, sheet.trials.size(),
        [&](std::size_t k) {
          sheet.trials[k] = p4_trial(sheet.table, settings_.p4, meshes[k / sheet.views],
                                     p4_views()[k % sheet.views], workshop_);
        },
        tbb::simple_partitioner{});
  }

  /// P2: preprocessing gauged, and table 2, which is too large to have two of in memory.
  void run_alone(Sheet& own, Sheet& fitted, std::vector<Timing>& timings) {
    const P2Settings& p2 = settings_.p2;
    for (std::size_t s = 0; s < settings_.stand_ins.size(); ++s) {
      const StandInSource& stand_in = settings_.stand_ins[s];
      {
        const Terrain terrain = load_stand_in(stand_in, p2.whole_size);
        gauge_preparation(p2.whole, terrain, "P2.1", kTable1Preprocessing, timings);
      }
      workshop_.check();
      const Terrain terrain = load_stand_in(stand_in, p2.tiled_size);
      gauge_preparation(p2.dependent, terrain, "P2.2", kDependentPreprocessing, timings);
      workshop_.check();
      std::vector<Fit> fits;
      {
        const std::unique_ptr<LodMethod> method =
            gauge_preparation(p2.tiled, terrain, "P2.2", kTable2Preprocessing, timings);
        fits.push_back(p2_fit_distance(p2, terrain, *method, workshop_));
        retreat(own, s, terrain, *method, fits);
      }
      fits.push_back(p2_fit_relief(p2, terrain, fits[0].value, workshop_));
      const Terrain scaled = with_relief(terrain, fits[1].value);
      retreat(fitted, s, scaled, *prepared(p2.tiled, scaled), fits);
    }
  }

 private:
  void retreat(Sheet& sheet, std::size_t stand_in, const Terrain& terrain, const LodMethod& method,
               const std::vector<Fit>& fits) {
    sheet.table.stand_ins[stand_in] = describe_stand_in(terrain, settings_.stand_ins[stand_in].origin);
    for (std::size_t v = 0; v < sheet.views; ++v) {
      sheet.trials[stand_in * sheet.views + v] =
          p2_trial2(sheet.table, terrain, method, p2_retreats()[v], fits[0].value, fits, workshop_);
    }
  }
  std::unique_ptr<LodMethod> gauge_preparation(const MethodUse& use, const Terrain& terrain,
                                               const std::string& table, const std::string& paper,
                                               std::vector<Timing>& timings) {
    Timing timing;
    timing.table = table;
    timing.terrain = terrain.id;
    timing.what = fmt::format("preprocessing, {}, {} x {} samples", use.id, terrain.columns, terrain.rows);
    timing.paper = paper;
    std::unique_ptr<LodMethod> method;
    const Cost cost = gauge([&] { method = prepared(use, terrain); });
    timing.wall_s = cost.wall_s;
    timing.cpu_s = cost.cpu_s;
    timing.peak_mb = cost.peak_mb;
    timings.push_back(timing);
    return method;
  }

  const TableSettings& settings_;
  const Workshop& workshop_;
};

/// Interrupted: what is whole is kept.
TablesOutcome make(const std::vector<std::string>& papers, const TableSettings& settings,
                   const Workshop& workshop) {
  const auto asked = [&](const char* paper) {
    return std::find(papers.begin(), papers.end(), paper) != papers.end();
  };
  // Cheap refusals first: a file that cannot be read should not wait for other terrains' trials. P4 needs
  // none.
  const bool terrains = papers != std::vector<std::string>{"P4"};
  if (terrains)
    for (const StandInSource& stand_in : settings.stand_ins) load_stand_in(stand_in, 2);
  const std::size_t stand_ins = settings.stand_ins.size();
  std::vector<StandInSource> p0_stand_ins = settings.stand_ins;
  p0_stand_ins.insert(p0_stand_ins.end(), settings.p0.more_stand_ins.begin(),
                      settings.p0.more_stand_ins.end());
  std::vector<Sheet> sheets;
  if (asked("P0")) sheets.emplace_back(p0_table(settings.picture), p0_stand_ins.size(), p0_views().size());
  const std::size_t p1 = sheets.size();
  if (asked("P1")) sheets.emplace_back(p1_table(settings.p1), stand_ins, p1_views().size());
  const std::size_t p2 = sheets.size();
  if (asked("P2")) {
    sheets.emplace_back(p2_table1(settings.p2, settings.picture), stand_ins, p2_views().size());
    for (const Relief relief : {Relief::own, Relief::fitted}) {
      sheets.emplace_back(p2_table2(settings.p2, settings.picture, relief), stand_ins, p2_retreats().size());
    }
  }
  const std::size_t p4 = sheets.size();
  if (asked("P4")) sheets.emplace_back(p4_table(), settings.p4.meshes.size(), p4_views().size());
  std::vector<Small> small;
  if (asked("P0")) {
    small.push_back({sheets.data(), &p0_stand_ins, settings.p0.size,
                     [&](const Table& t, const Terrain& terrain, std::size_t v) {
                       return p0_trial(t, settings.p0, terrain, p0_views()[v], workshop);
                     }});
  }
  if (asked("P1")) {
    small.push_back({&sheets[p1], &settings.stand_ins, settings.p1.size,
                     [&](const Table& t, const Terrain& terrain, std::size_t v) {
                       return p1_trial(t, settings.p1, terrain, p1_views()[v], workshop);
                     }});
  }
  if (asked("P2")) {
    small.push_back({&sheets[p2], &settings.stand_ins, settings.p2.whole_size,
                     [&](const Table& t, const Terrain& terrain, std::size_t v) {
                       return p2_trial1(t, settings.p2, terrain, p2_views()[v], workshop);
                     }});
  }

  TablesOutcome outcome;
  Maker maker(settings, workshop);
  try {
    maker.run_side_by_side(small);
    if (asked("P4")) maker.run_meshes(sheets[p4]);
    if (asked("P2")) maker.run_alone(sheets[p2 + 1], sheets[p2 + 2], outcome.timings.entries);
  } catch (const Interrupted&) {
    outcome.interrupted = true;
  }
  for (Sheet& sheet : sheets) {
    if (!sheet.whole()) continue;
    for (std::optional<Trial>& trial : sheet.trials) sheet.table.trials.push_back(std::move(*trial));
    outcome.tables.push_back(std::move(sheet.table));
  }
  return outcome;
}

std::size_t steps_of(const std::vector<std::string>& papers, const TableSettings& settings) {
  const std::size_t stand_ins = settings.stand_ins.size();
  std::size_t steps = 0;
  for (const std::string& paper : papers) {
    if (paper == "P0")
      steps += (stand_ins + settings.p0.more_stand_ins.size()) * p0_views().size() * kP0Steps;
    if (paper == "P1") steps += stand_ins * p1_views().size() * p1_steps(settings.p1);
    if (paper == "P4") steps += settings.p4.meshes.size() * p4_views().size() * p4_steps();
    if (paper == "P2") steps += stand_ins * (p2_views().size() * kP2Table1Steps + kP2Table2Steps);
  }
  return steps;
}

}  // namespace

TableSettings published_settings(const std::filesystem::path& real_terrain) {
  TableSettings settings;
  StandInSource real;
  real.source.id = one_line(real_terrain.stem().string());
  if (real.source.id == "fbm" || real.source.id == "terraced") real.source.id = "terrain";  // taken below
  real.source.file = real_terrain;
  real.source.holes = HolePolicy::fill;
  real.origin = "a real terrain, resampled bilinearly: smooth between its own samples";
  StandInSource fractal;
  fractal.source.id = "fbm";
  fractal.source.generator = "fbm";
  fractal.source.spacing_m = 10;  // at the generator's own relief: mountains 10 km wide and 1150 m high
  fractal.origin = "generator fbm, seed 1: fractal down to two samples";
  settings.stand_ins = {real, fractal};
  StandInSource terraced = fractal;
  terraced.source.id = "terraced";
  terraced.height_classes = 12;  // as many as a physical map's legend has, about
  terraced.origin = "the same fractal in 12 height classes: the paper's Africa was restored from a map";
  settings.p0.more_stand_ins = {terraced};
  settings.p4.meshes = {
      {"instrument", "made for this table: casing, dials, knobs, screws, grille", instrument_mesh()}};
  return settings;
}

const std::vector<ReproducedPaper>& reproduced_papers() {
  static const std::vector<ReproducedPaper> papers{
      {"P0", "triangles of ATL (haar_quadtree) beside QUADTin's, figures 6 to 8", "TABLES P0, M1"},
      {"P1", "triangles that ring_tin leaves of four point sets, and its tolerances, tables 1 and 2",
       "TABLES P1, M2"},
      {"P2", "isolated division at three thresholds, and along a retreat, tables 1 and 2", "TABLES P2, M3"},
      {"P4", "an instrument's vertex tree brought to 5 381 triangles and down its ladder", "TABLES P4, M5"},
  };
  return papers;
}

std::vector<std::string> choose_tables(const std::vector<std::string>& names) {
  std::vector<std::string> there;
  for (const ReproducedPaper& paper : reproduced_papers()) there.push_back(paper.id);
  const std::vector<std::string> known{"P0", "P1", "P2", "P3", "P4"};
  const auto holds = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (const std::string& name : names) {
    if (!holds(known, name)) throw InputError(unknown_name("table", name, known));
    if (holds(there, name)) continue;
    throw InputError(fmt::format("tables: {} is not reproduced by this build; ask for {}", name,
                                 fmt::join(there, " or ")));
  }
  if (!names.empty()) std::erase_if(there, [&](const std::string& paper) { return !holds(names, paper); });
  return there;
}

TablesOutcome make_tables(const std::vector<std::string>& papers, const TableSettings& settings,
                          const MakeOptions& options) {
  const int jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  const Stopwatch stopwatch;
  const oracle::RayDevice device;
  const std::size_t total = steps_of(papers, settings);
  std::atomic<std::size_t> done{0};
  Workshop workshop{device, settings.picture, {}, options.cancelled};
  workshop.figure_done = [&] {
    const std::size_t now = ++done;
    if (options.progress) options.progress(now, total);
  };
  TablesOutcome outcome;
  tbb::task_arena arena(jobs);
  arena.execute([&] { outcome = make(papers, settings, workshop); });
  outcome.timings.jobs = jobs;
  outcome.timings.total_s = stopwatch.elapsed_s();
  outcome.timings.process_peak_mb = process_peak_mb();
  return outcome;
}

}  // namespace plumbline::tables
