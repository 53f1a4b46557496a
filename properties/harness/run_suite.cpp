// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The main job: methods × subjects (terrains, then meshes) × trajectories × thresholds, as far as a
// trajectory flies around that kind of subject and a method takes it. One task is a flight's camera path
// around one subject; all methods and thresholds fly it side by side, so that the reference is looked at once
// a frame for all of them.
#include "properties/harness/run_suite.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "properties/harness/flight.h"
#include "properties/harness/gates.h"
#include "properties/harness/machine.h"
#include "properties/harness/mesh_dump.h"
#include "properties/harness/pictures.h"
#include "properties/harness/suite_stage.h"
#include "properties/verdict/economy.h"
#include "scenarios/expected_file.h"

namespace plumbline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
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

verdict::MeshFacts mesh_facts(const ObjectScene& scene) {
  verdict::MeshFacts facts;
  facts.id = scene.id;
  facts.objects = scene.objects.size();
  facts.triangles = scene.whole.triangles.size();
  facts.vertices = scene.whole.positions.size();
  facts.center = scene.center;
  facts.radius_m = scene.radius_m;
  facts.object_radius_m = scene.object_radius_m;
  return facts;
}

/// A camera path around one subject, with the entries that fly it; their runs stand in a row.
struct Task {
  std::size_t subject = 0, trajectory = 0;
  std::vector<std::size_t> entries;
  std::size_t first_run = 0;
};

std::vector<Task> tasks_of(const Stage& stage) {
  std::vector<Task> tasks;
  std::size_t runs = 0;
  for (std::size_t subject = 0; subject < stage.grounds.size(); ++subject) {
    for (std::size_t k = 0; k < stage.suite->trajectories.size(); ++k) {
      if (stage.cameras[subject][k].empty()) continue;
      Task task{subject, k, {}, runs};
      for (std::size_t e = 0; e < stage.entries.size(); ++e) {
        const std::vector<std::string>& flights = stage.entries[e].spec->trajectories;
        const bool asked = flights.empty() || std::find(flights.begin(), flights.end(),
                                                        stage.suite->trajectories[k].id) != flights.end();
        if (asked && stage.prepared[subject][stage.entries[e].spec_index] != nullptr)
          task.entries.push_back(e);
      }
      runs += task.entries.size();
      if (!task.entries.empty()) tasks.push_back(std::move(task));
    }
  }
  return tasks;
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

/// Flies all entries of a task. `runs` and `timings` have one slot an entry.
void fly(const Stage& stage, const Task& task, const oracle::RayDevice& device, verdict::RunVerdict* runs,
         verdict::RunTiming* timings, Progress& progress) {
  const std::size_t subject = task.subject;
  const std::vector<std::unique_ptr<TerrainStage>>& grounds = stage.grounds[subject];
  const std::vector<Camera>& cameras = stage.cameras[subject][task.trajectory];
  std::vector<std::unique_ptr<Flight>> flights;
  for (const std::size_t e : task.entries) {
    flights.push_back(std::make_unique<Flight>(new_flyer(stage, subject, stage.entries[e]),
                                               stage.ground(subject, stage.entries[e].spec_index), device));
  }
  std::vector<FrameScene> scenes = scenes_of(cameras);
  for (FrameScene& scene : scenes) scene.asks_all = scene.index % stage.suite->slack_every == 0;
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
        const Entry& entry = stage.entries[task.entries[e]];
        scene.reference_hits = &seen[stage.ground_of[subject][entry.spec_index]];
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

double error_px(const verdict::RunVerdict& run) {
  const oracle::ImageError& image = run.summary.image;
  return run.subject == Subject::mesh ? image.silhouette_max_px : image.displacement_px.p99;
}

/// What to show of a method over a terrain: the frame with the widest visible crack or, where there is none,
/// the frame with the largest p99 displacement (mesh: silhouette distance) at the method's middle threshold;
/// the first among equals.
Scene worst_scene(const Stage& stage, const std::vector<Task>& tasks, const verdict::SuiteVerdict& verdict,
                  std::size_t subject, std::size_t spec) {
  std::vector<std::size_t> mine;
  for (std::size_t e = 0; e < stage.entries.size(); ++e) {
    if (stage.entries[e].spec_index == spec) mine.push_back(e);
  }
  Scene widest, farthest;
  double gap_px = 0;
  for (const Task& task : tasks) {
    if (task.subject != subject) continue;
    const std::size_t k = task.trajectory;
    for (std::size_t place = 0; place < task.entries.size(); ++place) {
      const std::size_t e = task.entries[place];
      if (stage.entries[e].spec_index != spec) continue;
      const verdict::RunVerdict& run = verdict.runs[task.first_run + place];
      for (const verdict::FrameVerdict& frame : run.frames) {
        if (frame.largest_gap_px > gap_px) {
          gap_px = frame.largest_gap_px;
          widest = {&run, frame.index, k, e};
        }
      }
      if (e != mine[mine.size() / 2] || run.frames.empty()) continue;
      if (farthest.run == nullptr || error_px(run) > error_px(*farthest.run)) {
        farthest = {&run, run.summary.worst_frame, k, e};
      }
    }
  }
  return widest.run != nullptr ? widest : farthest;
}

std::vector<verdict::FramePictures> draw_worst(const Stage& stage, const std::vector<Task>& tasks,
                                               const verdict::SuiteVerdict& verdict,
                                               const oracle::RayDevice& device) {
  std::vector<PictureOrder> orders;
  for (std::size_t t = 0; t < stage.grounds.size(); ++t) {
    for (std::size_t s = 0; s < stage.specs.size(); ++s) {
      const Scene scene = worst_scene(stage, tasks, verdict, t, s);
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

/// What may be asked of these runs: nothing is expected of methods that were left out, nor of flights that an
/// interruption kept from being made.
std::vector<Expectation> expected_of(const Suite& suite, const RunOptions& options,
                                     const verdict::SuiteVerdict& verdict) {
  if (options.methods.empty() && !verdict.interrupted) return suite.expected;
  std::vector<std::string> ids;
  if (verdict.interrupted) {
    for (const verdict::RunVerdict& run : verdict.runs) ids.push_back(run.id);
  } else {
    ids = possible_run_ids(suite, options.methods);
  }
  std::vector<Expectation> kept;
  for (const Expectation& one : suite.expected) {
    if (std::any_of(ids.begin(), ids.end(), [&](const std::string& id) { return run_matches(one.run, id); }))
      kept.push_back(one);
  }
  return kept;
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
  for (std::size_t t = 0; t < suite.terrains.size(); ++t) {
    verdict.terrains.push_back(terrain_facts(stage.terrain(t)));
  }
  for (const ObjectScene& scene : stage.scenes) verdict.meshes.push_back(mesh_facts(scene));

  const std::vector<Task> tasks = tasks_of(stage);
  Progress progress{options};
  for (const Task& task : tasks) {
    progress.total += task.entries.size() * stage.cameras[task.subject][task.trajectory].size();
    for (const std::size_t e : task.entries) {
      const Entry& entry = stage.entries[e];
      verdict::RunVerdict& run = verdict.runs.emplace_back();
      run.id = run_id(suite, task.subject, task.trajectory, entry);
      run.subject = kind_of(suite, task.subject);
      run.terrain = id_of(suite, task.subject);
      run.trajectory = suite.trajectories[task.trajectory].id;
      run.method = entry.spec->id;
      run.threshold_px = entry.threshold_px;
      verdict::RunTiming& timing = outcome.timing.runs.emplace_back();
      timing.run = run.id;
      timing.prepare_s = stage.prepare_s[task.subject][entry.spec_index];
    }
  }

  tbb::parallel_for(
      std::size_t{0}, tasks.size(),
      [&](std::size_t k) {
        if (progress.cancelled()) return;
        fly(stage, tasks[k], device, &verdict.runs[tasks[k].first_run],
            &outcome.timing.runs[tasks[k].first_run], progress);
      },
      tbb::simple_partitioner{});

  verdict.interrupted = progress.cancelled();
  if (options.pictures && !verdict.interrupted) outcome.pictures = draw_worst(stage, tasks, verdict, device);
  if (verdict.interrupted) {
    // Only whole flights count; a run cut short would look like a shorter one that passed.
    std::size_t kept = 0;
    std::vector<std::size_t> frames;
    for (const Task& task : tasks)
      frames.insert(frames.end(), task.entries.size(), stage.cameras[task.subject][task.trajectory].size());
    for (std::size_t r = 0; r < verdict.runs.size(); ++r) {
      if (verdict.runs[r].frames.size() != frames[r]) continue;
      if (kept != r) {
        verdict.runs[kept] = std::move(verdict.runs[r]);
        outcome.timing.runs[kept] = std::move(outcome.timing.runs[r]);
      }
      ++kept;
    }
    verdict.runs.resize(kept);
    outcome.timing.runs.resize(kept);
  }
  verdict::add_excess(verdict, suite.yardstick);
  verdict.gates = judge_gates(suite.gates, verdict.runs, expected_of(suite, options, verdict));
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
