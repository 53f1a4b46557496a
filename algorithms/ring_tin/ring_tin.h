// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "algorithms/lod_method.h"
#include "algorithms/ring_tin/collapse_map.h"
#include "algorithms/ring_tin/prepared_tin.h"
#include "algorithms/ring_tin/rings.h"
#include "algorithms/ring_tin/vertex_levels.h"

namespace plumbline::ring_tin {

enum class Variant { published, fixpoint, guarded };

struct Settings {
  Variant variant = Variant::published;
  Rings rings;
  int depth_cap = 6;
  double focal_px = 0;             ///< f; 0: the camera's κ
  bool leave_whole_trees = false;  ///< §3.2, case 1 read as "no handling" also for a finer ring (M2.S7)
  PointChoice points;
  std::filesystem::path database;  ///< empty: nothing is stored
};

/// What one update did, beyond LodFrame's counters.
struct Statistics {
  std::uint64_t changed = 0;         ///< vertices whose ring changed
  std::uint64_t trees_reset = 0;     ///< of two vertices or more
  std::uint64_t vertices_reset = 0;  ///< restored with them
  std::uint64_t collapses = 0;
  std::uint64_t candidates = 0;  ///< edges that were scanned
  std::uint64_t qualifying =
      0;  ///< of these: active, Δh below the tolerance, no border triangle at the start
  std::uint64_t refused_depth = 0, refused_road = 0, refused_fold = 0;  ///< of the qualifying
};

/// METHODS M2; roles, formulas and departures at the head of ring_tin.cpp.
class RingTin final : public LodMethod {
 public:
  explicit RingTin(Settings settings) : settings_(std::move(settings)) {}

  void prepare(const Terrain& terrain) override;
  /// The same for a TIN that comes from elsewhere. `covered`: the plan region of its triangles.
  void prepare_tin(tin::Tin network, PlanDomain covered);
  void update(const Camera& camera, LodFrame& frame) override;
  void reset() override;
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override;

  /// Other rings from the next frame on: all vertices are levelled anew (§4: "at any moment").
  void set_rings(const Rings& rings) { settings_.rings = rings; }

  /// For laws and tests. Requires: prepared.
  [[nodiscard]] const tin::Tin& full_tin() const { return prepared_->tin; }
  [[nodiscard]] const PreparedTin& prepared() const { return *prepared_; }
  [[nodiscard]] const CollapseMap& collapses() const { return flight_->map; }
  [[nodiscard]] int level(std::uint32_t v) const { return flight_->levels.level(v); }
  /// Δh_i of the last frame, metres, by level.
  [[nodiscard]] const std::vector<double>& tolerances_m() const { return flight_->tolerances_m; }
  [[nodiscard]] const Statistics& statistics() const { return flight_->statistics; }
  /// Edges of the present mesh that would collapse but for `refusal`; asks every active edge.
  [[nodiscard]] std::uint64_t count_refused(CollapseMap::Refusal refusal);

 private:
  /// What one flight remembers.
  struct Flight {
    CollapseMap map;
    VertexLevels levels;
    Rings rings;                        ///< of the last frame
    std::vector<double> tolerances_m;   ///< of the last frame
    std::vector<std::uint8_t> touched;  ///< by vertex: its ring changed, or its tree was reset, in this frame
    Statistics statistics;
    Flight(const PreparedTin& prepared, int depth_cap);
  };

  void adopt(std::shared_ptr<const PreparedTin> prepared);
  [[nodiscard]] bool asks_reset(std::uint32_t v) const;
  void scan(const std::vector<std::uint32_t>& touched);
  void repeat(const std::vector<std::uint32_t>& touched);
  bool try_collapse(std::uint32_t edge);
  void emit(LodFrame& frame);

  Settings settings_;
  std::shared_ptr<const PreparedTin> prepared_;
  std::unique_ptr<Flight> flight_;
  std::vector<std::uint8_t> earlier_level_;  ///< leave_whole_trees only
  std::vector<std::uint32_t> number_;        ///< scratch of emit
};

}  // namespace plumbline::ring_tin
