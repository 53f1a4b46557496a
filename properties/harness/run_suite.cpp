// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The main job: methods × terrains × trajectories × thresholds. One task is a flight's camera path over one
// terrain; all methods and thresholds fly it side by side, so that the reference is looked at once a frame
// for all of them.
#include "properties/harness/run_suite.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "properties/harness/flight.h"
#include "properties/harness/gates.h"
#include "properties/harness/machine.h"
#include "properties/harness/mesh_dump.h"
#include "properties/harness/pictures.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One method and threshold of the suite, in its order.
struct Entry {
  const MethodSpec* spec = nullptr;
  std::size_t spec_index = 0;
  double threshold_px = 0;
};

/// The suite with everything loaded that runs share.
struct Stage {
  const Suite* suite = nullptr;
  /// [terrain][k]: as far as methods represent it; k = 0 is the whole terrain.
  std::vector<std::vector<std::unique_ptr<TerrainStage>>> grounds;
  std::vector<std::vector<std::size_t>> ground_of;                ///< [terrain][spec]: its k
  std::vector<MethodSpec> specs;                                  ///< those that the options keep
  std::vector<Entry> entries;                                     ///< spec × threshold
  std::vector<std::vector<std::unique_ptr<LodMethod>>> prepared;  ///< [terrain][spec]
  std::vector<std::vector<double>> prepare_s;                     ///< [terrain][spec]
  std::vector<std::vector<std::vector<Camera>>> cameras;          ///< [terrain][trajectory][frame]

  [[nodiscard]] const Terrain& terrain(std::size_t t) const { return grounds[t].front()->terrain; }
  [[nodiscard]] const TerrainStage& ground(std::size_t t, std::size_t spec) const {
    return *grounds[t][ground_of[t][spec]];
  }
};

std::unique_ptr<TerrainStage> make_ground(Terrain terrain, const oracle::RayDevice& device) {
  auto ground = std::make_unique<TerrainStage>();
  ground->terrain = std::move(terrain);
  ground->reference = reference_mesh(ground->terrain);
  ground->surface = std::make_unique<oracle::RaySurface>(device, ground->reference);
  return ground;
}

/// The place among `grounds` of a terrain cut to `block`; added if it is new.
std::size_t ground_for(std::vector<std::unique_ptr<TerrainStage>>& grounds, SampleBlock block,
                       const oracle::RayDevice& device) {
  for (std::size_t k = 0; k < grounds.size(); ++k) {
    if (grounds[k]->terrain.columns == block.columns && grounds[k]->terrain.rows == block.rows) return k;
  }
  grounds.push_back(make_ground(cropped(grounds.front()->terrain, block.columns, block.rows), device));
  return grounds.size() - 1;
}

/// The suite's methods that are wanted, in the suite's order.
std::vector<MethodSpec> kept_methods(const Suite& suite, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return suite.methods;
  for (const std::string& id : wanted) {
    if (std::any_of(suite.methods.begin(), suite.methods.end(),
                    [&](const MethodSpec& spec) { return spec.id == id; })) {
      continue;
    }
    find_method(id);  // an unknown method has its own, clearer message
    throw InputError(
        fmt::format("--methods: {} is not in suite {}; add a [[method]] with this id", id, suite.name));
  }
  std::vector<MethodSpec> kept;
  for (const MethodSpec& spec : suite.methods) {
    if (std::find(wanted.begin(), wanted.end(), spec.id) != wanted.end()) kept.push_back(spec);
  }
  return kept;
}

std::string run_id(const Suite& suite, std::size_t terrain, std::size_t trajectory, const Entry& entry) {
  std::string method = entry.spec->id;
  std::replace(method.begin(), method.end(), ':', '-');  // run ids name folders, on every file system
  return fmt::format("{}.{}.{}.{}", suite.terrains[terrain].id, suite.trajectories[trajectory].id, method,
                     entry.threshold_px);
}

Stage set_up(const Suite& suite, const RunOptions& options, const oracle::RayDevice& device) {
  Stage stage;
  stage.suite = &suite;
  stage.specs = kept_methods(suite, options.methods);
  // Cheap refusals first: a misspelt method should not wait for a raster to load.
  std::vector<std::unique_ptr<LodMethod>> makers;
  for (std::size_t s = 0; s < stage.specs.size(); ++s) {
    makers.push_back(make_method(stage.specs[s].id, stage.specs[s].options));
    for (const double tau : stage.specs[s].thresholds_px) stage.entries.push_back({&stage.specs[s], s, tau});
  }
  std::vector<Terrain> terrains;
  for (const TerrainSource& source : suite.terrains) terrains.push_back(load_terrain(source));
  for (Terrain& loaded : terrains) {
    std::vector<std::unique_ptr<TerrainStage>> grounds;
    grounds.push_back(make_ground(std::move(loaded), device));
    const Terrain& terrain = grounds.front()->terrain;
    std::vector<std::vector<Camera>> flights;
    for (const TrajectorySpec& spec : suite.trajectories) {
      flights.push_back(make_trajectory(spec, terrain, suite.fov_y_deg, suite.width_px, suite.height_px));
    }
    stage.cameras.push_back(std::move(flights));
    std::vector<std::unique_ptr<LodMethod>> prepared;
    std::vector<double> seconds;
    std::vector<std::size_t> ground_of;
    for (const std::unique_ptr<LodMethod>& maker : makers) {
      std::unique_ptr<LodMethod> method = maker->clone();
      const Clock::time_point start = Clock::now();
      method->prepare(terrain);
      seconds.push_back(seconds_since(start));
      ground_of.push_back(ground_for(grounds, method->reference(terrain), device));
      prepared.push_back(std::move(method));
    }
    stage.grounds.push_back(std::move(grounds));
    stage.ground_of.push_back(std::move(ground_of));
    stage.prepared.push_back(std::move(prepared));
    stage.prepare_s.push_back(std::move(seconds));
  }
  return stage;
}

std::unique_ptr<LodMethod> new_flyer(const Stage& stage, std::size_t terrain, const Entry& entry) {
  std::unique_ptr<LodMethod> flyer = stage.prepared[terrain][entry.spec_index]->clone();
  flyer->set_threshold_px(entry.threshold_px);
  return flyer;
}

verdict::TerrainFacts terrain_facts(const Terrain& terrain) {
  return {terrain.id,
          terrain.columns,
          terrain.rows,
          terrain.spacing_m,
          terrain.lowest_m(),
          terrain.highest_m(),
          oracle::diagonal_ambiguity_m(terrain)};
}

/// What the tasks share while they run; every task writes its own slots only.
struct Progress {
  const RunOptions& options;
  std::size_t total = 0;
  std::atomic<std::size_t> done{0};

  void step() {
    const std::size_t now = ++done;
    if (options.progress) options.progress(now, total);
  }
  [[nodiscard]] bool cancelled() const { return options.cancelled != nullptr && options.cancelled->load(); }
};

/// The frames of a flight, as far as its cameras tell: which of them have the same one.
std::vector<FrameScene> scenes_of(const std::vector<Camera>& cameras) {
  const auto bits = [](const Camera& c) {
    return std::array{c.position.x, c.position.y, c.position.z, c.forward.x, c.forward.y,
                      c.forward.z,  c.up.x,       c.up.y,       c.up.z};
  };
  std::map<decltype(bits(Camera{})), std::size_t> first;
  std::vector<FrameScene> scenes(cameras.size());
  for (std::size_t f = 0; f < cameras.size(); ++f) {
    scenes[f].index = static_cast<int>(f);
    scenes[f].camera = cameras[f];
    const auto [place, fresh] = first.try_emplace(bits(cameras[f]), f);
    if (fresh) continue;
    scenes[f].first_visit = static_cast<int>(place->second);
    scenes[place->second].comes_again = true;
  }
  return scenes;
}

/// Mean depth of what a picture shows, metres, summed pixel by pixel; +∞ where it shows nothing.
double mean_depth(const oracle::PixelHits& hits) {
  double sum_m = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < hits.triangle.size(); ++k) {
    if (hits.triangle[k] == oracle::PixelHits::kNoHit) continue;
    sum_m += hits.depth_m[k];
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::infinity() : sum_m / static_cast<double>(count);
}

/// Flies all entries along one trajectory over one terrain. `runs` and `timings` have one slot an entry.
void fly(const Stage& stage, std::size_t terrain, std::size_t trajectory, const oracle::RayDevice& device,
         verdict::RunVerdict* runs, verdict::RunTiming* timings, Progress& progress) {
  const std::vector<std::unique_ptr<TerrainStage>>& grounds = stage.grounds[terrain];
  const std::vector<Camera>& cameras = stage.cameras[terrain][trajectory];
  std::vector<std::unique_ptr<Flight>> flights;
  for (std::size_t e = 0; e < stage.entries.size(); ++e) {
    flights.push_back(std::make_unique<Flight>(new_flyer(stage, terrain, stage.entries[e]),
                                               stage.ground(terrain, stage.entries[e].spec_index), device));
  }
  std::vector<FrameScene> scenes = scenes_of(cameras);
  double mean_depth_m = std::numeric_limits<double>::infinity();  // of what the frame before saw
  const double step_m = oracle::median_step_m(cameras);
  for (std::size_t f = 0; f < cameras.size() && !progress.cancelled(); ++f) {
    std::vector<oracle::PixelHits> seen;
    for (const auto& ground : grounds) seen.push_back(ground->surface->look(cameras[f]));
    scenes[f].cut = f > 0 && oracle::is_cut(cameras[f - 1], cameras[f], mean_depth_m, step_m);
    mean_depth_m = mean_depth(seen.front());
    scenes[f].mean_depth_m = mean_depth_m;
    // Isolated: a worker that waits here must not pick up another trajectory and keep two in memory.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, flights.size(), [&](std::size_t e) {
        const Clock::time_point start = Clock::now();
        FrameScene scene = scenes[f];
        scene.reference_hits = &seen[stage.ground_of[terrain][stage.entries[e].spec_index]];
        runs[e].frames.push_back(flights[e]->next(scene));
        timings[e].update_ms.push_back(flights[e]->last_update_ms());
        timings[e].oracle_s += seconds_since(start) - flights[e]->last_update_ms() * 1e-3;
        if (progress.options.mesh_folder) {
          dump_mesh(*progress.options.mesh_folder, runs[e].id, static_cast<int>(f), flights[e]->frame().mesh);
        }
        progress.step();
      });
    });
  }
  for (std::size_t e = 0; e < flights.size(); ++e) runs[e].summary = verdict::summarize(runs[e].frames);
}

/// A frame of one run, by the run's place in the suite.
struct Scene {
  const verdict::RunVerdict* run = nullptr;
  int frame = 0;
  std::size_t flight = 0, entry = 0;
};

/// What to show of a method over a terrain: the frame with the widest visible crack or, where there is none,
/// the frame with the largest p99 displacement at the method's middle threshold; the first among equals.
Scene worst_scene(const Stage& stage, const verdict::SuiteVerdict& verdict, std::size_t terrain,
                  std::size_t spec) {
  std::vector<std::size_t> mine;
  for (std::size_t e = 0; e < stage.entries.size(); ++e) {
    if (stage.entries[e].spec_index == spec) mine.push_back(e);
  }
  const std::size_t flights = stage.suite->trajectories.size();
  Scene widest, farthest;
  double gap_px = 0;
  for (std::size_t k = 0; k < flights; ++k) {
    for (const std::size_t e : mine) {
      const verdict::RunVerdict& run = verdict.runs[(terrain * flights + k) * stage.entries.size() + e];
      for (const verdict::FrameVerdict& frame : run.frames) {
        if (frame.largest_gap_px > gap_px) {
          gap_px = frame.largest_gap_px;
          widest = {&run, frame.index, k, e};
        }
      }
      if (e != mine[mine.size() / 2] || run.frames.empty()) continue;
      if (farthest.run == nullptr ||
          run.summary.image.displacement_px.p99 > farthest.run->summary.image.displacement_px.p99) {
        farthest = {&run, run.summary.worst_frame, k, e};
      }
    }
  }
  return widest.run != nullptr ? widest : farthest;
}

std::vector<verdict::FramePictures> draw_worst(const Stage& stage, const verdict::SuiteVerdict& verdict,
                                               const oracle::RayDevice& device) {
  std::vector<PictureOrder> orders;
  for (std::size_t t = 0; t < stage.grounds.size(); ++t) {
    for (std::size_t s = 0; s < stage.specs.size(); ++s) {
      const Scene scene = worst_scene(stage, verdict, t, s);
      if (scene.run == nullptr) continue;
      orders.push_back({scene.run->id, scene.run->threshold_px, scene.frame, &stage.ground(t, s),
                        &stage.cameras[t][scene.flight], [&stage, t, entry = scene.entry] {
                          return new_flyer(stage, t, stage.entries[entry]);
                        }});
    }
  }
  std::vector<verdict::FramePictures> pictures(orders.size());
  tbb::parallel_for(std::size_t{0}, orders.size(),
                    [&](std::size_t k) { pictures[k] = draw(orders[k], device); });
  return pictures;
}

SuiteOutcome run_in_arena(const Suite& suite, const RunOptions& options, int jobs) {
  const Clock::time_point start = Clock::now();
  const oracle::RayDevice device(options.isa);
  const Stage stage = set_up(suite, options, device);

  SuiteOutcome outcome;
  verdict::SuiteVerdict& verdict = outcome.verdict;
  verdict.suite = suite.name;
  verdict.width_px = suite.width_px;
  verdict.height_px = suite.height_px;
  verdict.fov_y_deg = suite.fov_y_deg;
  for (std::size_t t = 0; t < stage.grounds.size(); ++t) {
    verdict.terrains.push_back(terrain_facts(stage.terrain(t)));
  }

  const std::size_t flights = suite.trajectories.size();
  const std::size_t tasks = stage.grounds.size() * flights;
  const std::size_t entries = stage.entries.size();
  verdict.runs.resize(tasks * entries);
  outcome.timing.runs.resize(tasks * entries);
  Progress progress{options};
  for (std::size_t task = 0; task < tasks; ++task) {
    const std::size_t t = task / flights;
    const std::size_t k = task % flights;
    progress.total += entries * stage.cameras[t][k].size();
    for (std::size_t e = 0; e < entries; ++e) {
      verdict::RunVerdict& run = verdict.runs[task * entries + e];
      run.id = run_id(suite, t, k, stage.entries[e]);
      run.terrain = suite.terrains[t].id;
      run.trajectory = suite.trajectories[k].id;
      run.method = stage.entries[e].spec->id;
      run.threshold_px = stage.entries[e].threshold_px;
      outcome.timing.runs[task * entries + e].run = run.id;
      outcome.timing.runs[task * entries + e].prepare_s = stage.prepare_s[t][stage.entries[e].spec_index];
    }
  }

  tbb::parallel_for(
      std::size_t{0}, tasks,
      [&](std::size_t task) {
        if (progress.cancelled()) return;
        fly(stage, task / flights, task % flights, device, &verdict.runs[task * entries],
            &outcome.timing.runs[task * entries], progress);
      },
      tbb::simple_partitioner{});

  verdict.interrupted = progress.cancelled();
  if (options.pictures && !verdict.interrupted) outcome.pictures = draw_worst(stage, verdict, device);
  if (verdict.interrupted) {
    // Only whole flights count; a run cut short would look like a shorter one that passed.
    std::size_t kept = 0;
    for (std::size_t r = 0; r < verdict.runs.size(); ++r) {
      const std::size_t task = r / entries;
      if (verdict.runs[r].frames.size() != stage.cameras[task / flights][task % flights].size()) continue;
      if (kept != r) {
        verdict.runs[kept] = std::move(verdict.runs[r]);
        outcome.timing.runs[kept] = std::move(outcome.timing.runs[r]);
      }
      ++kept;
    }
    verdict.runs.resize(kept);
    outcome.timing.runs.resize(kept);
  }
  verdict.gates = judge_gates(suite.gates, verdict.runs);
  verdict.vacuous = find_vacuous(verdict.runs);

  outcome.timing.machine = machine_name();
  outcome.timing.compiler = compiler_name();
  outcome.timing.build_type = build_type();
  outcome.timing.jobs = jobs;
  outcome.timing.total_s = seconds_since(start);
  return outcome;
}

}  // namespace

SuiteOutcome run_suite(const Suite& suite, const RunOptions& options) {
  const int jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  SuiteOutcome outcome;
  // Lifts the library's own limit: more jobs than cores are for the user to ask for, and for tests of
  // determinism.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena arena(jobs);
  arena.execute([&] { outcome = run_in_arena(suite, options, jobs); });
  return outcome;
}

}  // namespace plumbline
