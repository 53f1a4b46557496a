// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/faults/faults.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "properties/faults/planting.h"
#include "scenarios/error.h"

namespace plumbline::faults {
namespace {

using Plant = std::function<bool(const Planting&)>;

struct Entry {
  FaultKind kind;
  Plant plant;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list{
      {{"corner_lifted_ulp",
        "one triangle's corner gets its own vertex, one ulp higher: a crack on each shared edge"},
       [](const Planting& p) { return detach_upwards(p, Step::ulp); }},
      {{"corner_lifted_1mm", "the same, by a millimetre"},
       [](const Planting& p) { return detach_upwards(p, Step::millimetre); }},
      {{"corner_lifted_1m", "the same, by a metre"},
       [](const Planting& p) { return detach_upwards(p, Step::metre); }},
      {{"corner_withdrawn_ulp", "one triangle's corner gets its own vertex, one ulp inwards in plan: a hole"},
       [](const Planting& p) { return detach_inwards(p, Step::ulp); }},
      {{"corner_withdrawn_1mm", "the same, by a millimetre"},
       [](const Planting& p) { return detach_inwards(p, Step::millimetre); }},
      {{"corner_withdrawn_1m", "the same, by a metre"},
       [](const Planting& p) { return detach_inwards(p, Step::metre); }},
      {{"vertex_moved_softly", "an inner vertex moved, all its triangles still counter-clockwise: sound",
        true},
       move_softly},
      {{"vertex_moved_over", "an inner vertex moved across its neighbours: its turned triangles fold over"},
       move_over_neighbour},
      {{"vertices_merged", "two neighbours made one: the two triangles between them degenerate"},
       merge_vertices},
      {{"vertex_nan", "a coordinate that is not finite"}, break_vertex},
      {{"vertex_unused", "a vertex that no triangle names"}, leave_vertex},
      {{"border_shifted_in", "a vertex of a straight border moved inwards: outline missing"},
       [](const Planting& p) { return shift_border(p, false); }},
      {{"border_shifted_out", "a vertex of a straight border moved outwards: outline extra"},
       [](const Planting& p) { return shift_border(p, true); }},
      {{"border_slid", "a vertex moved along a straight border: sound", true}, slide_border},
      {{"triangle_dropped", "a triangle left out: a hole, or outline missing at the border"}, drop_triangle},
      {{"triangle_doubled", "a triangle twice"}, double_triangle},
      {{"triangle_flipped", "a triangle wound clockwise"}, flip_triangle},
      {{"triangle_flat", "an added triangle over three collinear vertices"}, flatten_triangle},
      {{"triangle_over", "an added small triangle above another: an overlap"}, cover_triangle},
      {{"index_bad", "a triangle that names a vertex that is not there"}, break_index},
      {{"edge_split_flat", "an edge split on one side only, at the exact midpoint: a T-junction"},
       [](const Planting& p) { return split_edge(p, SplitHeight::flat); }},
      {{"edge_split_ulp", "the same, one ulp off the edge: a crack"},
       [](const Planting& p) { return split_edge(p, SplitHeight::ulp); }},
      {{"edge_split_1m", "the same, a metre off the edge"},
       [](const Planting& p) { return split_edge(p, SplitHeight::metre); }},
      {{"level_off_by_one",
        "the triangles on one side of a straight edge pair no longer know the vertex between"},
       coarsen_one_side},
      {{"block_stale", "a rectangular patch with heights from elsewhere: a crack on each edge around it"},
       [](const Planting& p) { return cut_patch(p, true); }},
      {{"block_seam", "a rectangular patch with vertices of its own at the same positions: sound", true},
       [](const Planting& p) { return cut_patch(p, false); }},
  };
  return list;
}

/// Random places tried before a kind is given up for this mesh.
constexpr int kAttempts = 64;

bool contains_all(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
  return std::all_of(some.begin(), some.end(),
                     [&all](auto v) { return std::find(all.begin(), all.end(), v) != all.end(); });
}

}  // namespace

const std::vector<FaultKind>& fault_kinds() {
  static const std::vector<FaultKind> kinds = [] {
    std::vector<FaultKind> list;
    for (const Entry& entry : entries()) list.push_back(entry.kind);
    return list;
  }();
  return kinds;
}

std::optional<PlantedFault> plant(std::string_view kind, const Mesh& sound, const PlanDomain& domain,
                                  Random& random) {
  const auto entry = std::find_if(entries().begin(), entries().end(),
                                  [kind](const Entry& e) { return e.kind.name == kind; });
  if (entry == entries().end()) {
    throw InputError(fmt::format("unknown fault kind '{}'; see the catalogue of planted faults", kind));
  }
  if (sound.triangles.empty()) return std::nullopt;
  const Sites sites(sound);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    PlantedFault fault{entry->kind.name, sound, domain, {}};
    if (entry->plant({sound, sites, random, fault})) return fault;
  }
  return std::nullopt;
}

Score score(const PlantedFault& fault, const oracle::ConformityReport& report) {
  Score result;
  result.planted = fault.expected.size();
  std::vector<bool> taken(report.findings.size());
  // First those at their places, then of the rest those of the right kind elsewhere.
  std::vector<const ExpectedFinding*> missed;
  const auto take = [&](const ExpectedFinding& expected, bool in_place) {
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const oracle::Finding& finding = report.findings[i];
      if (taken[i] || finding.code != expected.code || finding.kind != expected.kind) continue;
      if (in_place && (!contains_all(finding.vertices, expected.vertices) ||
                       !contains_all(finding.triangles, expected.triangles)))
        continue;
      taken[i] = true;
      return true;
    }
    return false;
  };
  for (const ExpectedFinding& expected : fault.expected) {
    if (take(expected, true)) {
      ++result.found;
    } else {
      missed.push_back(&expected);
    }
  }
  for (const ExpectedFinding* expected : missed) {
    if (take(*expected, false)) ++result.misplaced;
  }
  result.false_alarms = static_cast<std::size_t>(std::count(taken.begin(), taken.end(), false));
  return result;
}

}  // namespace plumbline::faults
