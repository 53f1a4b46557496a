// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "oracle/image.h"
#include "properties/harness/flight.h"
#include "properties/harness/run_suite.h"
#include "scenarios/mesh_source.h"
#include "scenarios/suite.h"

namespace plumbline {

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

/// Loads terrains and meshes and prepares every method that takes them. Throws InputError for what cannot be
/// read or taken, and for a method or mesh that nothing in the suite is for.
Stage set_up(const Suite& suite, const RunOptions& options, const oracle::RayDevice& device);

/// A subject is a terrain or, after these, a mesh, counted through the suite.
Subject kind_of(const Suite& suite, std::size_t subject);
const std::string& id_of(const Suite& suite, std::size_t subject);
std::string run_id(const Suite& suite, std::size_t subject, std::size_t trajectory, const Entry& entry);

/// A clone for one flight.
std::unique_ptr<LodMethod> new_flyer(const Stage& stage, std::size_t subject, const Entry& entry);

}  // namespace plumbline
