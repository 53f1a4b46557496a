// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <memory>
#include <string>

#include <fmt/format.h>

#include "algorithms/registry.h"
#include "cli/commands.h"
#include "oracle/finding.h"
#include "properties/laws/law.h"
#include "properties/peers/peer_table.h"
#include "properties/tables/make_tables.h"
#include "scenarios/error.h"
#include "scenarios/nearest.h"
#include "scenarios/terrain_source.h"
#include "scenarios/trajectory.h"

namespace plumbline::cli {
namespace {

void line(const std::string& name, const std::string& summary, const std::string& source = {}) {
  fmt::print("  {:<34} {}{}\n", name, summary, source.empty() ? "" : fmt::format("  [{}]", source));
}

void list_methods() {
  fmt::print("methods\n");
  for (const MethodDescription& method : registered_methods()) {
    for (const VariantDescription& variant : method.variants) {
      const bool published = variant.name.empty();
      line(published ? method.id : fmt::format("{}:{}", method.id, variant.name),
           published ? method.title : variant.summary, method.section);
    }
  }
}

void list_terrains() {
  fmt::print("terrains (generators; `file` takes anything that GDAL opens, `points` surveyed points)\n");
  for (const GeneratorDescription& generator : terrain_generators()) line(generator.name, generator.summary);
  fmt::print("meshes (generators; `file` takes PLY, OBJ, OFF, STL, GLB and glTF)\n");
  for (const MeshGenerator& generator : mesh_generators()) line(generator.name, generator.summary);
}

void list_trajectories() {
  fmt::print("trajectories\n");
  for (const TrajectoryKind& kind : trajectory_kinds()) line(kind.name, kind.summary);
  fmt::print("trajectories around a mesh (around = \"mesh\")\n");
  for (const TrajectoryKind& kind : trajectory_kinds_around_mesh()) line(kind.name, kind.summary);
}

void list_laws() {
  fmt::print("laws\n");
  for (const properties::Law& law : properties::all_laws()) line(law.id, law.statement, law.source);
}

/// In the order of ORACLES, then what `check` asks besides; each is named after its header in oracle/.
constexpr struct Oracle {
  const char *name, *judges, *source;
} kOracles[] = {
    {"conformity", "covers its domain once, edge to edge, at equal heights; exact", "ORACLES O1"},
    {"vertical", "sup-norm, RMS and mean of the height error over the whole overlay, not sampled",
     "ORACLES O2"},
    {"image", "displacement, depth, silhouette and popping in pixels, a ray for each", "ORACLES O3"},
    {"economy", "how many vertices the scene does not need at the same threshold", "ORACLES O4"},
    {"stability", "what toggles, lags behind a cut, trembles, or depends on the way flown", "ORACLES O5"},
    {"shape", "triangle quality, least angle, slivers, valence", "ORACLES O6"},
    {"soundness", "objects: indices, finite coordinates, triangles without area, manifold edges; exact",
     "ORACLES O7"},
    {"likeness", "objects: self-intersections (exact), certified distances in space, normals", "ORACLES O7"},
    {"border", "where a mesh ends, exactly as its file has it, and the skirts that hang there", "check"},
    {"seams", "between two meshes: cracks and T-junctions on the common border, exact, and what skirts hide",
     "check"},
    {"placement", "a mesh that lies flipped, transposed, shifted or scaled over its DEM", "check"},
    {"tile_conformance", "one quantized-mesh tile against its format", "check"},
};

void list_oracles() {
  fmt::print("oracles\n");
  for (const Oracle& oracle : kOracles) line(oracle.name, oracle.judges, oracle.source);
  fmt::print("findings\n");
  for (const oracle::FindingDescription& finding : oracle::finding_catalogue()) {
    line(fmt::format("{} {}", static_cast<int>(finding.code), finding.name), std::string(finding.definition));
  }
}

void list_tables() {
  fmt::print("tables\n");
  for (const tables::ReproducedPaper& paper : tables::reproduced_papers()) {
    line(paper.id, paper.summary, paper.section);
  }
}

/// Judges nine meshes first, so it is not part of the list of everything.
void list_peers() { fmt::print("{}", peers::peer_table_markdown()); }

void list(const std::string& what) {
  struct Shelf {
    const char* name;
    void (*print)();
  };
  static constexpr Shelf kShelves[] = {
      {"methods", list_methods}, {"terrains", list_terrains}, {"trajectories", list_trajectories},
      {"laws", list_laws},       {"oracles", list_oracles},   {"tables", list_tables},
      {"peers", list_peers}};
  std::vector<std::string> names;
  bool found = false;
  for (const Shelf& shelf : kShelves) {
    names.emplace_back(shelf.name);
    if ((what.empty() && shelf.print != list_peers) || what == shelf.name) {
      shelf.print();
      found = true;
    }
  }
  if (!found) throw InputError(unknown_name("list", what, names));
}

}  // namespace

void add_list(CLI::App& program, int& status) {
  auto what = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("list", "What there is, one line each");
  command->add_option("what", *what,
                      "methods, terrains, trajectories, laws, oracles, tables or peers (the fault table "
                      "beside CGAL); default: "
                      "all but peers");
  command->callback([what, &status] {
    list(*what);
    status = kPass;
  });
}

}  // namespace plumbline::cli
