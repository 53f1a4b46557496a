// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/harness/suite_stage.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

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

bool takes(const MethodSpec& spec, Subject subject) {
  return subject == Subject::terrain || find_method(spec.id).method->takes_objects;
}

/// Whether a list of ids, which if empty stands for all, asks for this one.
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

}  // namespace

Subject kind_of(const Suite& suite, std::size_t subject) {
  return subject < suite.terrains.size() ? Subject::terrain : Subject::mesh;
}

const std::string& id_of(const Suite& suite, std::size_t subject) {
  const std::size_t terrains = suite.terrains.size();
  return subject < terrains ? suite.terrains[subject].id : suite.meshes[subject - terrains].id;
}

std::string run_id(const Suite& suite, std::size_t subject, std::size_t trajectory, const Entry& entry) {
  return plumbline::run_id(id_of(suite, subject), suite.trajectories[trajectory].id, entry.spec->id,
                           entry.threshold_px);
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

}  // namespace plumbline
