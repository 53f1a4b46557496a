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
#include "properties/verdict/economy.h"
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
  std::vector<ObjectScene> scenes;  ///< of the suite's meshes; subject s is scene s - terrains
  /// [subject][k]: as far as methods represent it; k = 0 is the whole.
  std::vector<std::vector<std::unique_ptr<TerrainStage>>> grounds;
  std::vector<std::vector<std::size_t>> ground_of;                ///< [subject][spec]: its k
  std::vector<MethodSpec> specs;                                  ///< those that the options keep
  std::vector<Entry> entries;                                     ///< spec × threshold
  std::vector<std::vector<std::unique_ptr<LodMethod>>> prepared;  ///< [subject][spec]; null: takes no mesh
  std::vector<std::vector<double>> prepare_s;                     ///< [subject][spec]
  std::vector<std::vector<std::vector<Camera>>> cameras;  ///< [subject][trajectory][frame]; empty: not flown

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

std::unique_ptr<TerrainStage> make_ground(const ObjectScene& scene, const oracle::RayDevice& device) {
  auto ground = std::make_unique<TerrainStage>();
  ground->subject = Subject::mesh;
  ground->reference = scene.whole;
  ground->surface = std::make_unique<oracle::RaySurface>(device, ground->reference);
  return ground;
}

Subject kind_of(const Suite& suite, std::size_t subject) {
  return subject < suite.terrains.size() ? Subject::terrain : Subject::mesh;
}

const std::string& id_of(const Suite& suite, std::size_t subject) {
  const std::size_t terrains = suite.terrains.size();
  return subject < terrains ? suite.terrains[subject].id : suite.meshes[subject - terrains].id;
}

bool takes(const MethodSpec& spec, Subject subject) {
  return subject == Subject::terrain || find_method(spec.id).method->takes_objects;
}

/// Whether an empty list, which stands for all, or a list of ids asks for this one.
bool chosen(const std::vector<std::string>& ids, const std::string& id) {
  return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// A method that nothing in the suite is for, or a mesh that no method takes, would be left out silently.
void refuse_idle(const Suite& suite, const std::vector<MethodSpec>& kept) {
  if (suite.meshes.empty()) return;
  if (suite.terrains.empty()) {
    for (const MethodSpec& spec : kept) {
      if (takes(spec, Subject::mesh)) continue;
      throw InputError(fmt::format("method {} takes terrains only, and suite {} has none; leave it out",
                                   spec.id, suite.name));
    }
  }
  if (std::none_of(suite.methods.begin(), suite.methods.end(),
                   [](const MethodSpec& spec) { return takes(spec, Subject::mesh); })) {
    throw InputError(fmt::format(
        "no method of suite {} takes meshes; add a [[method]] that does, as vertex_tree", suite.name));
  }
}

std::string run_id(const Suite& suite, std::size_t subject, std::size_t trajectory, const Entry& entry) {
  std::string method = entry.spec->id;
  std::replace(method.begin(), method.end(), ':', '-');  // run ids name folders, on every file system
  return fmt::format("{}.{}.{}.{}", id_of(suite, subject), suite.trajectories[trajectory].id, method,
                     entry.threshold_px);
}

/// One scene of objects with its flights, and every method that takes it prepared.
void add_objects(Stage& stage, ObjectScene loaded, const std::vector<std::unique_ptr<LodMethod>>& makers,
                 const oracle::RayDevice& device) {
  const Suite& suite = *stage.suite;
  stage.scenes.push_back(std::move(loaded));
  const ObjectScene& scene = stage.scenes.back();
  std::vector<std::unique_ptr<TerrainStage>> grounds;
  grounds.push_back(make_ground(scene, device));
  std::vector<std::vector<Camera>> flights;
  for (const TrajectorySpec& spec : suite.trajectories) {
    flights.emplace_back();
    if (spec.around != Subject::mesh) continue;
    flights.back() = make_trajectory(spec, scene, suite.fov_y_deg, suite.width_px, suite.height_px);
  }
  std::vector<std::unique_ptr<LodMethod>> prepared(makers.size());
  std::vector<double> seconds(makers.size(), 0.0);
  for (std::size_t s = 0; s < makers.size(); ++s) {
    if (!takes(stage.specs[s], Subject::mesh) || !chosen(stage.specs[s].subjects, scene.id)) continue;
    prepared[s] = makers[s]->clone();
    const Clock::time_point start = Clock::now();
    try {
      prepared[s]->prepare_objects(scene.objects);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("mesh '{}': {} cannot take it: {}", scene.id, stage.specs[s].id, error.what()));
    }
    seconds[s] = seconds_since(start);
  }
  stage.grounds.push_back(std::move(grounds));
  stage.cameras.push_back(std::move(flights));
  stage.ground_of.emplace_back(makers.size(), 0);
  stage.prepared.push_back(std::move(prepared));
  stage.prepare_s.push_back(std::move(seconds));
}

Stage set_up(const Suite& suite, const RunOptions& options, const oracle::RayDevice& device) {
  Stage stage;
  stage.suite = &suite;
  stage.specs = kept_methods(suite, options.methods);
  refuse_idle(suite, stage.specs);
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
      flights.emplace_back();
      if (spec.around != Subject::terrain) continue;
      flights.back() = make_trajectory(spec, terrain, suite.fov_y_deg, suite.width_px, suite.height_px);
    }
    stage.cameras.push_back(std::move(flights));
    std::vector<std::unique_ptr<LodMethod>> prepared;
    std::vector<double> seconds;
    std::vector<std::size_t> ground_of;
    for (std::size_t s = 0; s < makers.size(); ++s) {
      if (!chosen(stage.specs[s].subjects, terrain.id)) {
        prepared.emplace_back();
        seconds.push_back(0);
        ground_of.push_back(0);
        continue;
      }
      std::unique_ptr<LodMethod> method = makers[s]->clone();
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
  for (const MeshSource& source : suite.meshes) add_objects(stage, load_objects(source), makers, device);
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
        if (stage.prepared[subject][stage.entries[e].spec_index] == nullptr) continue;
        if (!chosen(stage.entries[e].spec->trajectories, stage.suite->trajectories[k].id)) continue;
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
